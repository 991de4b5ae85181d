//! What bounds the rays of a coherent pack: the eight boxes of a node are tested against it at once.
#![allow(
    clippy::needless_range_loop,
    reason = "an index below the arrays' length is what the compiler makes vectors of"
)]

use super::frame::{GROUP, SLACK};
use super::kernel::Kernel;
use super::node::{Lanes, Node8, Packet8, WIDTH};
use super::pack::Column;
use super::triangle::{max, min};

/// Bounds of the origins of rays and of 1 over their directions, which lead to the same sides.
///
/// Differences and products rounded to the nearest are monotone: no ray enters a box before, or leaves it after, what is
/// computed here, to the last bit.
pub(super) struct Frustum {
    /// The arrays of [`Node8::bounds`] that the rays reach first.
    near: [usize; 3],
    /// The origin that lies farthest along the rays, and that which lies farthest back.
    origin: [[f32; 2]; 3],
    /// 1 over the directions: of the least and of the greatest absolute value, and the same with [`SLACK`].
    near_scale: [[f32; 2]; 3],
    far_scale: [[f32; 2]; 3],
}

impl Frustum {
    /// * `near`: see [`super::frame::RayFrame`], as `scale`.
    #[inline(always)]
    pub(super) fn new(near: [usize; 3], origin: &[Column; 3], scale: &[Column; 3]) -> Self {
        let mut frustum = Self {
            near,
            origin: [[0.0; 2]; 3],
            near_scale: [[0.0; 2]; 3],
            far_scale: [[0.0; 2]; 3],
        };
        for axis in 0..3 {
            let [low, high] = [origin[axis].least(), origin[axis].greatest()];
            let [least, greatest] = [scale[axis].least(), scale[axis].greatest()];
            let leads_down = near[axis] % 2 == 1;
            frustum.origin[axis] = if leads_down { [low, high] } else { [high, low] };
            let scale = if leads_down {
                [greatest, least]
            } else {
                [least, greatest]
            };
            frustum.near_scale[axis] = scale;
            frustum.far_scale[axis] = scale.map(|s| s * SLACK);
        }
        frustum
    }

    /// Which children's boxes rays may hit in `[0, t_most]`, as bits, and where the first of them may enter.
    ///
    /// Where a ray lies in a face, 0 times infinity is NaN, which bounds nothing: the greatest scale comes second, where
    /// [`min`] and [`max`] return it.
    #[inline(always)]
    pub(super) fn boxes<K: Kernel>(
        &self,
        kernel: K,
        node: &Node8,
        t_most: f32,
        entry: &mut Lanes,
    ) -> u32 {
        self.reach(kernel, &node.bounds, t_most, entry)
    }

    /// Which triangles' boxes rays may hit, likewise.
    #[inline(always)]
    pub(super) fn triangles<K: Kernel>(&self, kernel: K, packet: &Packet8, t_most: f32) -> u32 {
        let mut bounds = [Lanes::default(); 6];
        let [a, b, c] = &packet.vertices;
        for axis in 0..3 {
            for lane in 0..WIDTH {
                let [a, b, c] = [a[axis].0[lane], b[axis].0[lane], c[axis].0[lane]];
                bounds[2 * axis].0[lane] = min(a, min(b, c));
                bounds[2 * axis + 1].0[lane] = max(a, max(b, c));
            }
        }
        self.reach(kernel, &bounds, t_most, &mut Lanes::default())
    }

    #[inline(always)]
    fn reach<K: Kernel>(
        &self,
        kernel: K,
        bounds: &[Lanes; 6],
        t_most: f32,
        entry: &mut Lanes,
    ) -> u32 {
        let mut near = [0.0; WIDTH];
        let mut far = [t_most; WIDTH];
        for axis in 0..3 {
            let side = self.near[axis] % 6;
            let (nears, fars) = (&bounds[side].0, &bounds[side ^ 1].0);
            let [ahead, behind] = self.origin[axis];
            let [least, greatest] = self.near_scale[axis];
            let [least_far, greatest_far] = self.far_scale[axis];
            for lane in 0..WIDTH {
                let d = nears[lane] - ahead;
                let t = min(d * least, d * greatest);
                near[lane] = max(t, near[lane]);
                let d = fars[lane] - behind;
                let t = max(d * least_far, d * greatest_far);
                far[lane] = min(t, far[lane]);
            }
        }
        entry.0 = near;
        let (mut from, mut to) = ([1.0; GROUP], [0.0; GROUP]);
        from[..WIDTH].copy_from_slice(&near);
        to[..WIDTH].copy_from_slice(&far);
        kernel.are_at_most(&from, &to)
    }
}
