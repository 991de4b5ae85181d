//! The kernels of the traversal, for one node or packet: what depends on the instruction set, and the portable one.

use super::frame::{GROUP, RayFrame};
use super::node::{Child, Lanes, Node8, Packet8, WIDTH};
use super::traverse::{self, ClosestHit, GroupLeaves, Scene};
use super::triangle::{self, max, min};

/// Most levels of 8-wide nodes that a tree may have; deeper ones are rebuilt balanced.
pub(super) const MAX_DEPTH: usize = 36;

/// Size of the stack: each level leaves at most seven siblings on it, and lanes are written eight at a time.
pub(super) const STACK: usize = (WIDTH - 1) * MAX_DEPTH + WIDTH;

/// Distances and weights of the triangles of a packet.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct PacketHits {
    pub(super) t: Lanes,
    pub(super) u: Lanes,
    pub(super) v: Lanes,
}

/// Bits of distances that do not order entries of [`Kernel::push_children`].
pub(super) const KEY_BITS: u32 = 4;

/// Whether an entry's distance may be at most `t`.
#[inline(always)]
pub(super) fn is_within(entry: u64, t: f32) -> bool {
    (entry >> 32) as u32 <= t.to_bits() | ((1 << KEY_BITS) - 1)
}

/// A stack of [`STACK`] entries: the bits of the distance where a ray enters a box (not negative, so they sort as it
/// does) and below them the child.
pub(super) trait EntryStack {
    /// Writes an entry; `at < STACK`.
    fn set(&mut self, at: usize, entry: u64);
    /// Reads an entry that has been written; `at < STACK`.
    fn get(&self, at: usize) -> u64;
}

/// The operations that differ between instruction sets. All implementations agree bit for bit.
pub(super) trait Kernel: Copy {
    /// Its stack.
    type Stack: EntryStack;
    /// An empty stack.
    fn stack(self) -> Self::Stack;
    /// Prefetches what a child refers to into the cache.
    fn prefetch(self, scene: &Scene, child: Child);
    /// Which children's boxes the ray hits in `[0, t_cull]`, as bits, and where it enters them.
    fn boxes(self, node: &Node8, frame: &RayFrame, t_cull: f32, entry: &mut Lanes) -> u32;
    /// Pushes those children, the nearest last, without branches on how many they are. Returns how many entries the
    /// stack has then.
    ///
    /// * `top`: how many it has.
    fn push_children(
        self,
        node: &Node8,
        frame: &RayFrame,
        t_cull: f32,
        stack: &mut Self::Stack,
        top: usize,
    ) -> usize;
    /// Which triangles the ray hits in `(0, t_most]`, as bits, and where.
    fn triangles(
        self,
        packet: &Packet8,
        frame: &RayFrame,
        t_most: f32,
        hits: &mut PacketHits,
    ) -> u32;
    /// In which lanes `a` is at most `b`, as bits.
    fn are_at_most(self, a: &[f32; GROUP], b: &[f32; GROUP]) -> u32;
    /// [`traverse::visit_below`], compiled by itself.
    fn visit_below<const ANY: bool>(
        self,
        leaves: &GroupLeaves<'_>,
        child: Child,
        frame: &RayFrame,
        best: &mut ClosestHit,
    ) -> bool;
}

/// Plain Rust over arrays.
#[derive(Clone, Copy, Debug)]
pub(super) struct Portable;

impl EntryStack for [u64; STACK] {
    #[inline(always)]
    fn set(&mut self, at: usize, entry: u64) {
        self[at] = entry;
    }

    #[inline(always)]
    fn get(&self, at: usize) -> u64 {
        self[at]
    }
}

impl Kernel for Portable {
    type Stack = [u64; STACK];

    #[inline(always)]
    fn stack(self) -> Self::Stack {
        [0; STACK]
    }

    #[inline(always)]
    fn prefetch(self, _: &Scene, _: Child) {}

    #[inline(always)]
    fn boxes(self, node: &Node8, frame: &RayFrame, t_cull: f32, entry: &mut Lanes) -> u32 {
        // Where the ray lies in a box's face, 0 * inf is NaN: `min` and `max` then return the other operand.
        let origin = frame.ray.origin.to_array();
        let mut far = [t_cull; WIDTH];
        entry.0 = [0.0; WIDTH];
        for axis in 0..3 {
            let near_side = usize::from(frame.near[axis]);
            let (nears, fars) = (&node.bounds[near_side].0, &node.bounds[near_side ^ 1].0);
            let origin = origin[axis];
            for lane in 0..WIDTH {
                let t = (nears[lane] - origin) * frame.near_scale[axis];
                entry.0[lane] = max(t, entry.0[lane]);
                let t = (fars[lane] - origin) * frame.far_scale[axis];
                far[lane] = min(t, far[lane]);
            }
        }
        bits(|lane| entry.0[lane] <= far[lane])
    }

    #[inline(always)]
    fn push_children(
        self,
        node: &Node8,
        frame: &RayFrame,
        t_cull: f32,
        stack: &mut Self::Stack,
        mut top: usize,
    ) -> usize {
        let mut entries = Lanes::default();
        let mask = self.boxes(node, frame, t_cull, &mut entries);
        let base = top;
        for lane in (0..WIDTH).filter(|lane| mask >> lane & 1 == 1) {
            let child = u64::from(node.children[lane].0);
            let entry = (u64::from(entries.0[lane].to_bits()) << 32) | child;
            // The farthest at the bottom.
            let mut at = top;
            while at > base && stack.get(at - 1) < entry {
                stack.set(at, stack.get(at - 1));
                at -= 1;
            }
            stack.set(at, entry);
            top += 1;
        }
        top
    }

    #[inline(always)]
    fn triangles(
        self,
        packet: &Packet8,
        frame: &RayFrame,
        t_most: f32,
        hits: &mut PacketHits,
    ) -> u32 {
        // One array at a time, which compiles to vector instructions.
        let axes = frame.axes.map(usize::from);
        let sheared = |corner: &[Lanes; 3]| {
            let [mut xs, mut ys, mut zs] = [[0.0; WIDTH]; 3];
            for lane in 0..WIDTH {
                let p = axes.map(|axis| corner[axis].0[lane]);
                [xs[lane], ys[lane], zs[lane]] =
                    triangle::shear(p, frame.sheared_origin, frame.shear);
            }
            [xs, ys, zs]
        };
        let [a, b, c] = packet.vertices.each_ref().map(sheared);
        let at = |p: &[[f32; WIDTH]; 3], lane: usize| [p[0][lane], p[1][lane], p[2][lane]];
        let [mut us, mut vs, mut ws] = [[0.0; WIDTH]; 3];
        let mut inside = [false; WIDTH];
        for lane in 0..WIDTH {
            let uvw = triangle::edge_functions(at(&a, lane), at(&b, lane), at(&c, lane));
            [us[lane], vs[lane], ws[lane]] = uvw;
            inside[lane] = triangle::inside(uvw);
        }
        let mask = bits(|lane| inside[lane]);
        if mask == 0 {
            return 0;
        }
        for lane in 0..WIDTH {
            let uvw = [us[lane], vs[lane], ws[lane]];
            let z = [a[2][lane], b[2][lane], c[2][lane]];
            let (t, u, v) = triangle::distance(uvw, z, frame.shear[2]);
            (hits.t.0[lane], hits.u.0[lane], hits.v.0[lane]) = (t, u, v);
        }
        mask & bits(|lane| (hits.t.0[lane] > 0.0) & (hits.t.0[lane] <= t_most))
    }

    #[inline(always)]
    fn are_at_most(self, a: &[f32; GROUP], b: &[f32; GROUP]) -> u32 {
        (0..GROUP).fold(0, |mask, lane| {
            mask | (u32::from(a[lane] <= b[lane]) << lane)
        })
    }

    #[inline(never)]
    fn visit_below<const ANY: bool>(
        self,
        leaves: &GroupLeaves<'_>,
        child: Child,
        frame: &RayFrame,
        best: &mut ClosestHit,
    ) -> bool {
        traverse::visit_below::<Self, ANY>(self, leaves, child, frame, best)
    }
}

/// Eight conditions as bits.
#[inline(always)]
fn bits(mut f: impl FnMut(usize) -> bool) -> u32 {
    (0..WIDTH).fold(0, |mask, lane| mask | (u32::from(f(lane)) << lane))
}
