//! Narrowing conversions, each with what it does at the edges.
#![allow(
    clippy::cast_possible_truncation,
    reason = "narrowing is what this module is for; every function says how it rounds"
)]

use glam::{DMat3, DMat4, DVec3};
use specula_bsdf::Vec3;
use specula_bsdf::math::vec3;

/// The nearest `f32`; infinite where too large.
#[inline(always)]
pub(crate) fn narrow(x: f64) -> f32 {
    x as f32
}

/// The integer part; 0 for NaN and below 0, saturating above.
#[inline(always)]
pub(crate) fn floor_index(x: f32) -> usize {
    x as usize
}

/// The integer part towards minus infinity, saturating; 0 for NaN.
#[inline(always)]
pub(crate) fn floor_i32(x: f32) -> i32 {
    x.floor() as i32
}

/// The integer part towards 0, saturating; 0 for NaN.
#[inline(always)]
pub(crate) fn truncated(x: f32) -> i32 {
    x as i32
}

/// `x.floor()`, but for the sign of a zero: a few instructions, where the baseline of x86-64 has none of its own.
#[inline(always)]
pub(crate) fn floor(x: f32) -> f32 {
    // From here on all floats are whole.
    const WHOLE: f32 = 8_388_608.0;
    let towards_zero = truncated(x) as f32;
    let below = if towards_zero > x {
        towards_zero - 1.0
    } else {
        towards_zero
    };
    if x.abs() < WHOLE { below } else { x }
}

/// The integer part of a number above 0, saturating.
#[inline(always)]
pub(crate) fn round_u32(x: f64) -> u32 {
    x.round() as u32
}

/// An index as the `u32` of flat arrays; saturates, which no array in memory reaches.
#[inline(always)]
pub(crate) fn id(x: usize) -> u32 {
    u32::try_from(x).unwrap_or(u32::MAX)
}

/// The lower and the upper half.
#[inline(always)]
pub(crate) fn words_of(x: u64) -> [u32; 2] {
    [x as u32, (x >> 32) as u32]
}

/// The nearest vector in `f32`.
#[inline(always)]
pub(crate) fn narrow3(v: DVec3) -> Vec3<f32> {
    vec3(v.x as f32, v.y as f32, v.z as f32)
}

/// The same vector in `f64`.
#[inline(always)]
pub(crate) fn widen3(v: Vec3<f32>) -> DVec3 {
    DVec3::new(f64::from(v.x), f64::from(v.y), f64::from(v.z))
}

/// A point moved by a transform.
pub(crate) fn transform_point(m: &DMat4, p: [f32; 3]) -> [f32; 3] {
    let q = m.transform_point3(DVec3::new(
        f64::from(p[0]),
        f64::from(p[1]),
        f64::from(p[2]),
    ));
    [q.x as f32, q.y as f32, q.z as f32]
}

/// The inverse transpose of the linear part: what normals are transformed by.
pub(crate) fn normal_matrix(m: &DMat4) -> DMat3 {
    DMat3::from_mat4(*m).inverse().transpose()
}

/// An affine map in `f32`, by columns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Affine {
    /// Images of the axes.
    pub(crate) columns: [Vec3<f32>; 3],
    /// Image of the origin.
    pub(crate) translation: Vec3<f32>,
}

impl Affine {
    /// The nearest affine map; the last row of `m` is taken for `(0, 0, 0, 1)`.
    pub(crate) fn new(m: &DMat4) -> Self {
        let linear = DMat3::from_mat4(*m);
        Self {
            columns: [
                narrow3(linear.x_axis),
                narrow3(linear.y_axis),
                narrow3(linear.z_axis),
            ],
            translation: narrow3(m.w_axis.truncate()),
        }
    }

    /// A linear map.
    pub(crate) fn linear(m: &DMat3) -> Self {
        Self {
            columns: [narrow3(m.x_axis), narrow3(m.y_axis), narrow3(m.z_axis)],
            translation: Vec3::ZERO,
        }
    }

    /// The image of a direction.
    #[inline(always)]
    pub(crate) fn vector(&self, v: Vec3<f32>) -> Vec3<f32> {
        self.columns[0] * v.x + self.columns[1] * v.y + self.columns[2] * v.z
    }

    /// The image of a point.
    #[inline(always)]
    pub(crate) fn point(&self, p: Vec3<f32>) -> Vec3<f32> {
        self.vector(p) + self.translation
    }

    /// A bound on the magnitudes summed in [`Affine::point`], per component.
    #[inline(always)]
    pub(crate) fn magnitude(&self, p: Vec3<f32>) -> Vec3<f32> {
        abs(self.columns[0]) * p.x.abs()
            + abs(self.columns[1]) * p.y.abs()
            + abs(self.columns[2]) * p.z.abs()
            + abs(self.translation)
    }
}

/// Absolute values.
#[inline(always)]
pub(crate) fn abs(v: Vec3<f32>) -> Vec3<f32> {
    vec3(v.x.abs(), v.y.abs(), v.z.abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floors_are_those_of_the_standard_library() {
        for x in [
            0.0,
            0.5,
            -0.5,
            1.0,
            -1.0,
            7.999,
            -7.001,
            1e-30,
            -1e-30,
            8_388_607.5,
            -8_388_607.5,
        ] {
            assert_eq!(floor(x), x.floor(), "{x}");
        }
        for x in [
            8_388_609.0,
            -16_777_216.0,
            3e9,
            -3e9,
            1e30,
            f32::INFINITY,
            -f32::INFINITY,
        ] {
            assert_eq!(floor(x), x, "{x}");
        }
        assert!(floor(f32::NAN).is_nan());
    }
}
