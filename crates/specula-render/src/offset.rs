//! Where rays leave a surface, so that they neither hit it again nor skip what lies beyond.
//!
//! A hit point is known only to within rounding: `|error|` per component, a small multiple of the
//! magnitudes that were summed to compute it. A ray leaves from the point moved along the geometric
//! normal until the box of the error is cleared (Pharr, Jakob and Humphreys, Physically Based
//! Rendering, 4th edition, 6.8.6). The bound scales with the coordinates, hence the same code
//! serves scenes in millimetres and in kilometres.

use specula_bsdf::Vec3;
use specula_bsdf::math::vec3;

/// Rounding of a hit point, relative to the magnitudes behind it: 16 ulps. Interpolation costs 7
/// (gamma_7), an instance's transform 3 more; the rest covers the ray kernel, which sees the same
/// triangle in the frame of the new ray.
pub const RELATIVE_ERROR: f32 = 16.0 * f32::EPSILON;

/// The error of a point from the magnitudes behind each component.
///
/// The largest stands for all: the kernel turns the triangle into the frame of the ray, where the
/// rounding of one coordinate reaches the others. On a floor at z = 0, whose own z is exact, a
/// fifth of all rays hit the floor again without this.
#[inline]
pub(crate) fn coupled(magnitude: Vec3<f32>) -> Vec3<f32> {
    Vec3::splat(magnitude.x.max(magnitude.y).max(magnitude.z) * RELATIVE_ERROR)
}

/// A point of a surface, as rays leave it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SurfacePoint {
    pub(crate) position: Vec3<f32>,
    /// Bound on the error of each component of the position.
    pub(crate) error: Vec3<f32>,
    /// Unit geometric normal, either side.
    pub(crate) normal: Vec3<f32>,
}

impl SurfacePoint {
    /// The origin of a ray that leaves towards `direction`.
    #[inline(always)]
    pub(crate) fn ray_origin(&self, direction: Vec3<f32>) -> Vec3<f32> {
        let Self {
            position: p,
            error,
            normal,
        } = *self;
        let distance =
            normal.x.abs() * error.x + normal.y.abs() * error.y + normal.z.abs() * error.z;
        let side = if normal.dot(direction) < 0.0 {
            -distance
        } else {
            distance
        };
        vec3(
            away(p.x, normal.x * side),
            away(p.y, normal.y * side),
            away(p.z, normal.z * side),
        )
    }
}

/// `p + d`, moved on by an ulp or two where rounding may have cancelled the move.
#[inline(always)]
fn away(p: f32, d: f32) -> f32 {
    let moved = p + d;
    moved + (moved.abs() * f32::EPSILON).copysign(d)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn origins_move_to_the_side_of_the_direction_at_every_scale() {
        for scale in [1e-6_f32, 1e-3, 1.0, 1e4, 1e8] {
            let position = vec3(0.3, -0.8, 0.5) * scale;
            let normal = vec3(0.6, 0.0, 0.8);
            let from = SurfacePoint {
                position,
                error: crate::convert::abs(position) * RELATIVE_ERROR,
                normal,
            };
            for side in [1.0, -1.0] {
                let origin = from.ray_origin(normal * side + Vec3::Y);
                let d = (origin - position).dot(normal) * side;
                assert!(d > 0.0 && d < 1e-4 * scale, "{scale}: {d}");
            }
        }
    }
}
