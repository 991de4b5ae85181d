//! Conversions from and to the types of mint, by which other libraries of vectors are reached.

use super::{Frame, Rgb, Vec3, rgb, vec3};

impl<T> From<mint::Vector3<T>> for Vec3<T> {
    #[inline(always)]
    fn from(v: mint::Vector3<T>) -> Self {
        vec3(v.x, v.y, v.z)
    }
}

impl<T> From<Vec3<T>> for mint::Vector3<T> {
    #[inline(always)]
    fn from(v: Vec3<T>) -> Self {
        Self {
            x: v.x,
            y: v.y,
            z: v.z,
        }
    }
}

impl<T> mint::IntoMint for Vec3<T> {
    type MintType = mint::Vector3<T>;
}

/// Columns `s`, `t` and `n`: local to world.
impl<T> From<Frame<T>> for mint::ColumnMatrix3<T> {
    #[inline(always)]
    fn from(frame: Frame<T>) -> Self {
        Self {
            x: frame.s.into(),
            y: frame.t.into(),
            z: frame.n.into(),
        }
    }
}

/// * `m`: a rotation; its columns become `s`, `t` and `n`.
impl<T> From<mint::ColumnMatrix3<T>> for Frame<T> {
    #[inline(always)]
    fn from(m: mint::ColumnMatrix3<T>) -> Self {
        Self {
            s: m.x.into(),
            t: m.y.into(),
            n: m.z.into(),
        }
    }
}

/// Mint has no colours: red, green and blue are x, y and z.
impl<T> From<Rgb<T>> for mint::Vector3<T> {
    #[inline(always)]
    fn from(c: Rgb<T>) -> Self {
        Self {
            x: c.r,
            y: c.g,
            z: c.b,
        }
    }
}

/// Mint has no colours: x, y and z are red, green and blue.
impl<T> From<mint::Vector3<T>> for Rgb<T> {
    #[inline(always)]
    fn from(v: mint::Vector3<T>) -> Self {
        rgb(v.x, v.y, v.z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_and_back_is_the_same() {
        let v = vec3(1.0_f32, -2.0, 3.0);
        assert_eq!(Vec3::from(mint::Vector3::from(v)), v);
        let c = rgb(0.1_f64, 0.2, 0.3);
        assert_eq!(Rgb::from(mint::Vector3::from(c)), c);
        let frame = Frame::from_normal(vec3(0.6_f64, 0.0, 0.8));
        let matrix = mint::ColumnMatrix3::from(frame);
        assert_eq!(Vec3::from(matrix.z), frame.n);
        assert_eq!(Frame::from(matrix), frame);
    }
}
