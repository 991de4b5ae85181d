//! Orthonormal frames: from world to a surface's local frame and back.

use super::{Real, Vec3, vec3};

/// A right-handed orthonormal frame; `n` is the local z.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Frame<T> {
    /// Local x (along `alpha_x`).
    pub s: Vec3<T>,
    /// Local y (along `alpha_y`).
    pub t: Vec3<T>,
    /// Local z, the shading normal.
    pub n: Vec3<T>,
}

impl<T: Real> Frame<T> {
    /// A frame about the unit vector `n`, continuous but for the sign of `n.z`.
    ///
    /// Source: Duff et al. 2017, Building an Orthonormal Basis, Revisited, listing 3. Departure: a negative
    /// zero counts as positive, so that normals of walls, turned to and fro, have one frame on all devices.
    #[inline(always)]
    pub fn from_normal(n: Vec3<T>) -> Self {
        let sign = T::select(n.z < T::ZERO, -T::ONE, T::ONE);
        let a = -T::ONE / (sign + n.z);
        let b = n.x * n.y * a;
        Self {
            s: vec3(T::ONE + sign * n.x * n.x * a, sign * b, -sign * n.x),
            t: vec3(b, sign + n.y * n.y * a, -n.y),
            n,
        }
    }

    /// A frame about the unit vector `n` whose x is `tangent` made perpendicular to it; any frame
    /// about `n` where `tangent` is parallel to it or zero.
    #[inline(always)]
    pub fn from_normal_tangent(n: Vec3<T>, tangent: Vec3<T>) -> Self {
        let s = tangent - n * n.dot(tangent);
        let length_squared = s.length_squared();
        let enough = tangent.length_squared() * T::EPSILON;
        if length_squared > enough && length_squared > T::TINY {
            let s = s * (T::ONE / length_squared.sqrt());
            Self {
                s,
                t: n.cross(s),
                n,
            }
        } else {
            Self::from_normal(n)
        }
    }

    /// World to local.
    #[inline(always)]
    pub fn to_local(&self, v: Vec3<T>) -> Vec3<T> {
        vec3(self.s.dot(v), self.t.dot(v), self.n.dot(v))
    }

    /// Local to world.
    #[inline(always)]
    pub fn to_world(&self, v: Vec3<T>) -> Vec3<T> {
        self.s * v.x + self.t * v.y + self.n * v.z
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sign_of_a_zero_turns_no_frame() {
        for (x, y) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.6, -0.8_f32)] {
            let frame = |z| Frame::from_normal(vec3(x, y, z));
            let [a, b] = [frame(0.0), frame(-0.0)];
            assert_eq!((a.s, a.t), (b.s, b.t));
        }
    }
}
