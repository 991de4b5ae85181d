//! A ray, prepared for the kernels: reciprocals for the slabs, shear for the triangles.

use super::Ray;

/// Slack of the slab test, `1 + 16 u` with `u = 2^-24`.
///
/// Each slab distance `(b - o) rcp` is off by at most `3 u` of itself, which takes `6 u` (Ize 2013,
/// "Robust BVH Ray Traversal"); the rest covers the rounding of the triangle test, see
/// [`super::triangle`].
pub(super) const SLACK: f32 = 1.0 + 8.0 * f32::EPSILON;

/// The axes in the order in which rays are sheared, by that in which the direction is greatest: it is the last.
pub(super) const AXES: [[u8; 3]; 3] = [[1, 2, 0], [2, 0, 1], [0, 1, 2]];

/// A finite ray and what is computed from it once.
#[derive(Clone, Copy, Debug)]
pub(super) struct RayFrame {
    pub(super) ray: Ray,
    pub(super) origin: [f32; 3],
    /// `1 / direction`, infinite where that is 0.
    pub(super) near_scale: [f32; 3],
    /// The same with [`SLACK`].
    pub(super) far_scale: [f32; 3],
    /// Per axis the array of [`super::node::Node8::bounds`] that the ray reaches first; the other is
    /// this one `^ 1`.
    pub(super) near: [u8; 3],
    /// The two lesser axes, and the one in which the direction is greatest.
    pub(super) axes: [u8; 3],
    /// `origin` in that order.
    pub(super) sheared_origin: [f32; 3],
    /// `d[axes[0]] / d[axes[2]], d[axes[1]] / d[axes[2]], 1 / d[axes[2]]`.
    pub(super) shear: [f32; 3],
}

impl RayFrame {
    /// `None` where the ray cannot hit: not finite, without direction, or `t_max` not positive.
    #[inline(always)]
    pub(super) fn new(ray: &Ray) -> Option<Self> {
        let z = usize::from(greatest_axis(ray)?);
        let (o, d) = (ray.origin.to_array(), ray.direction.to_array());
        let axes = AXES[z];
        let [x, y] = [usize::from(axes[0]), usize::from(axes[1])];
        let near_scale = d.map(|c| 1.0 / c);
        Some(Self {
            ray: *ray,
            origin: o,
            near_scale,
            far_scale: near_scale.map(|r| r * SLACK),
            near: [
                u8::from(d[0].is_sign_negative()),
                2 + u8::from(d[1].is_sign_negative()),
                4 + u8::from(d[2].is_sign_negative()),
            ],
            axes,
            sheared_origin: [o[x], o[y], o[z]],
            shear: [d[x] / d[z], d[y] / d[z], near_scale[z]],
        })
    }
}

/// The axis in which the direction is greatest; `None` where the ray cannot hit: not finite, without
/// direction, or `t_max` not positive.
#[inline(always)]
pub(super) fn greatest_axis(ray: &Ray) -> Option<u8> {
    let (o, d) = (ray.origin.to_array(), ray.direction.to_array());
    // Infinite and NaN components make NaN, finite ones 0.
    let finite =
        (o[0] * 0.0 + o[1] * 0.0 + o[2] * 0.0) + (d[0] * 0.0 + d[1] * 0.0 + d[2] * 0.0) == 0.0;
    let [x, y, z] = d.map(f32::abs);
    // Without branches, which would be mispredicted half of the time.
    let axis = if (x > y) & (x > z) {
        0
    } else {
        2 - u8::from((y >= x) & (y > z))
    };
    let can_hit = finite & (x.max(y).max(z) > 0.0) & (ray.t_max > 0.0);
    can_hit.then_some(axis)
}
