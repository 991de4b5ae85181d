//! A ray, prepared for the kernels: reciprocals for the slabs, shear for the triangles.

use super::Ray;
use super::block::{BLOCK, RayBlock};

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
        let (o, d) = (ray.origin.to_array(), ray.direction.to_array());
        let z = usize::from(greatest_axis(ray)?);
        let axes = AXES[z];
        let [x, y] = [usize::from(axes[0]), usize::from(axes[1])];
        let near_scale = d.map(|c| 1.0 / c);
        Some(Self {
            ray: *ray,
            near_scale,
            far_scale: near_scale.map(|r| r * SLACK),
            near: nearer_sides(&d),
            axes,
            sheared_origin: [o[x], o[y], o[z]],
            shear: [d[x] / d[z], d[y] / d[z], near_scale[z]],
        })
    }
}

#[inline(always)]
fn nearer_sides(direction: &[f32; 3]) -> [u8; 3] {
    let [x, y, z] = direction.map(|c| u8::from(c.is_sign_negative()));
    [x, 2 + y, 4 + z]
}

/// Components in the order that [`AXES`] has for an axis, compiled to selections.
#[inline(always)]
pub(super) fn permuted(axis: u8, [x, y, z]: [f32; 3]) -> [f32; 3] {
    let pick = |first: f32, second: f32, third: f32| match axis {
        0 => first,
        1 => second,
        _ => third,
    };
    [pick(y, z, x), pick(z, x, y), pick(x, y, z)]
}

/// The frames of sixteen rays of a block: what takes divisions is computed for all at once.
pub(super) struct FrameGroup<'a> {
    pub(super) rays: &'a RayBlock,
    first: usize,
    /// 1 over the directions.
    pub(super) reciprocal: [[f32; GROUP]; 3],
    /// The first two factors of the shear.
    pub(super) shear: [[f32; GROUP]; 2],
    /// In which the directions are greatest; [`NO_AXIS`]: the ray cannot hit.
    pub(super) axis: [u8; GROUP],
}

/// Rays of a group.
pub(super) const GROUP: usize = 16;

/// Of rays that cannot hit.
const NO_AXIS: u8 = 3;

impl<'a> FrameGroup<'a> {
    /// * `first`: index of the first ray, a multiple of [`GROUP`].
    #[inline(always)]
    pub(super) fn new(rays: &'a RayBlock, first: usize) -> Self {
        let first = first.min(BLOCK - GROUP);
        let column = |values: &[f32; BLOCK]| -> [f32; GROUP] {
            let mut column = [0.0; GROUP];
            column.copy_from_slice(&values[first..first + GROUP]);
            column
        };
        let (o, d) = (&rays.origin, &rays.direction);
        let o = [&o.x, &o.y, &o.z].map(|c| column(c));
        let d = [&d.x, &d.y, &d.z].map(|c| column(c));
        let t_max = column(&rays.t_max);
        let mut group = Self {
            rays,
            first,
            reciprocal: [[0.0; GROUP]; 3],
            shear: [[0.0; GROUP]; 2],
            axis: [NO_AXIS; GROUP],
        };
        for (reciprocal, d) in group.reciprocal.iter_mut().zip(&d) {
            for k in 0..GROUP {
                reciprocal[k] = 1.0 / d[k];
            }
        }
        for k in 0..GROUP {
            let (o, [x, y, z]) = ([o[0][k], o[1][k], o[2][k]], [d[0][k], d[1][k], d[2][k]]);
            let (axis, can_hit) = axis_of(o, [x, y, z], t_max[k]);
            group.axis[k] = if can_hit { axis } else { NO_AXIS };
            let [first, second, greatest] = permuted(axis, [x, y, z]);
            group.shear[0][k] = first / greatest;
            group.shear[1][k] = second / greatest;
        }
        group
    }

    /// Whether all rays can hit, and have the greatest component of their directions along the same axis.
    #[inline(always)]
    pub(super) fn have_one_axis(&self) -> bool {
        let mut apart = self.axis[0] == NO_AXIS;
        for k in 1..GROUP {
            apart |= self.axis[k] != self.axis[0];
        }
        !apart
    }

    /// Which rays can hit, as bits.
    #[inline(always)]
    pub(super) fn can_hit(&self) -> u32 {
        (0..GROUP).fold(0, |set, k| set | (u32::from(self.axis[k] != NO_AXIS) << k))
    }

    /// The frame of a ray of the group; `None` where it cannot hit.
    #[inline(always)]
    pub(super) fn get(&self, index: usize) -> Option<RayFrame> {
        let k = index % GROUP;
        let &axes = AXES.get(usize::from(self.axis[k]))?;
        let ray = self.rays.get((self.first + k) % BLOCK);
        let o = ray.origin.to_array();
        let near_scale = [0, 1, 2].map(|axis| self.reciprocal[axis][k]);
        let [x, y, z] = axes.map(usize::from);
        Some(RayFrame {
            ray,
            near_scale,
            far_scale: near_scale.map(|r| r * SLACK),
            near: nearer_sides(&ray.direction.to_array()),
            axes,
            sheared_origin: [o[x], o[y], o[z]],
            shear: [self.shear[0][k], self.shear[1][k], near_scale[z]],
        })
    }
}

/// Whether the directions of a group have the same signs.
///
/// * `first`: index of its first ray.
#[inline(always)]
pub(super) fn lead_to_same_sides(rays: &RayBlock, first: usize) -> bool {
    let d = &rays.direction;
    let at = |c: &[f32; BLOCK], k: usize| c[(first + k) % BLOCK].to_bits();
    let mut turned = 0;
    for k in 1..GROUP {
        turned |=
            (at(&d.x, k) ^ at(&d.x, 0)) | (at(&d.y, k) ^ at(&d.y, 0)) | (at(&d.z, k) ^ at(&d.z, 0));
    }
    turned >> 31 == 0
}

/// The axis in which the direction is greatest; `None` where the ray cannot hit.
#[inline(always)]
pub(super) fn greatest_axis(ray: &Ray) -> Option<u8> {
    let (o, d) = (ray.origin.to_array(), ray.direction.to_array());
    let (axis, can_hit) = axis_of(o, d, ray.t_max);
    can_hit.then_some(axis)
}

/// The axis in which a direction is greatest, and whether the ray can hit: it is finite, has a direction, and `t_max` is
/// positive.
#[inline(always)]
fn axis_of(o: [f32; 3], d: [f32; 3], t_max: f32) -> (u8, bool) {
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
    (axis, finite & (x.max(y).max(z) > 0.0) & (t_max > 0.0))
}
