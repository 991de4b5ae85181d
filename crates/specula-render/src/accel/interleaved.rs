//! Blocks of rays through a tree, several of them interleaved, so that the others proceed while a node of one of them is
//! loaded from memory.
//!
//! Here children are pushed without branches: one that is mispredicted would throw away what has begun of the rays that
//! follow. [`super::traverse`] takes branches, as a ray alone waits for nothing but its own next node, and a guess of it
//! is often right. It is faster where nothing has to be loaded: its state stays in registers.

use super::block::{BLOCK, RayBlock};
use super::frame::{FrameGroup, GROUP, RayFrame};
use super::kernel::{EntryStack, Kernel, is_within};
use super::node::Child;
use super::traverse::{ClosestHit, GroupLeaves, Leaves, Scene, child_of};
use super::{Hit, traverse};

/// Rays that are interleaved. Measured: `cargo xtask rays`.
const RAYS: usize = 16;
/// Bytes of a tree that the first levels of caches are assumed to hold. Measured likewise.
const IN_CACHE: usize = 4 << 20;

/// [`super::traverse::intersect`] of each ray; `hits` are as many.
///
/// * `rays`: a block of them, how many they are, and as bits the groups of [`GROUP`] that are left out.
#[inline(always)]
pub(super) fn intersect<K: Kernel>(
    kernel: K,
    scene: &Scene,
    rays: (&RayBlock, usize, u32),
    hits: &mut [Option<Hit>],
) {
    cast::<K, false>(kernel, scene, rays, |ray, best| hits[ray] = best.hit());
}

/// [`super::traverse::occluded`] of each ray, likewise.
#[inline(always)]
pub(super) fn occluded<K: Kernel>(
    kernel: K,
    scene: &Scene,
    rays: (&RayBlock, usize, u32),
    occluded: &mut [bool],
) {
    cast::<K, true>(kernel, scene, rays, |ray, best| {
        occluded[ray] = best.hit().is_some();
    });
}

/// Traverses the first `n` rays of a block, and calls `done` for each with its closest hit. Skips rays that cannot hit.
///
/// * `ANY`: stops at any hit.
#[inline(always)]
fn cast<K: Kernel, const ANY: bool>(
    kernel: K,
    scene: &Scene,
    (rays, n, taken): (&RayBlock, usize, u32),
    mut done: impl FnMut(usize, &ClosestHit),
) {
    let Some(root) = scene.root else { return };
    let n = n.min(BLOCK);
    if let Some(instance) = scene.single
        && gains(scene)
    {
        let leaves = GroupLeaves { scene, instance };
        return interleave::<K, ANY>(kernel, (root, &leaves), (rays, n, taken), done);
    }
    for (group, first) in (0..n).step_by(GROUP).enumerate() {
        if taken >> group & 1 == 1 {
            continue;
        }
        let frames = FrameGroup::new(rays, first);
        for index in first..n.min(first + GROUP) {
            if let Some(frame) = frames.get(index) {
                let best = traverse::cast_frame::<K, ANY>(kernel, scene, root, &frame);
                done(index, &best);
            }
        }
    }
}

/// Whether interleaving is faster: where the tree is larger than the caches.
pub(super) fn gains(scene: &Scene) -> bool {
    let bytes = size_of_val(scene.nodes.as_slice()) + size_of_val(scene.packets.as_slice());
    bytes > IN_CACHE
}

/// The state of a ray that is being traversed.
struct RayInFlight<S> {
    /// Index of the ray.
    index: usize,
    frame: RayFrame,
    best: ClosestHit,
    /// See [`super::traverse`].
    stack: S,
    top: usize,
    current: Child,
}

/// [`cast`] of several rays at a time.
#[inline(always)]
fn interleave<K: Kernel, const ANY: bool>(
    kernel: K,
    (root, leaves): (Child, &GroupLeaves<'_>),
    (rays, n, taken): (&RayBlock, usize, u32),
    mut done: impl FnMut(usize, &ClosestHit),
) {
    let mut waiting = Waiting {
        frames: FrameGroup::new(rays, 0),
        next: 0,
        count: n,
        taken,
    };
    // Not as an array of constants: that would be written whole, with its stacks.
    let mut in_flight: [Option<RayInFlight<K::Stack>>; RAYS] = std::array::from_fn(|_| None);
    let mut active = 0;
    for place in &mut in_flight {
        if let Some((index, frame)) = waiting.next() {
            *place = Some(RayInFlight {
                index,
                best: ClosestHit::new(frame.ray.t_max),
                frame,
                stack: kernel.stack(),
                top: 0,
                current: root,
            });
            active += 1;
        }
    }
    while active > 0 {
        for place in &mut in_flight {
            let Some(ray) = place else { continue };
            if ray.step::<K, ANY>(kernel, leaves) {
                kernel.prefetch(leaves.scene, ray.current);
                continue;
            }
            done(ray.index, &ray.best);
            if let Some((index, frame)) = waiting.next() {
                ray.index = index;
                ray.best = ClosestHit::new(frame.ray.t_max);
                ray.frame = frame;
                (ray.top, ray.current) = (0, root);
            } else {
                *place = None;
                active -= 1;
            }
        }
    }
}

impl<S: EntryStack> RayInFlight<S> {
    /// Visits the current child and goes to the next one; `false` where there is none.
    #[inline(always)]
    fn step<K: Kernel<Stack = S>, const ANY: bool>(
        &mut self,
        kernel: K,
        leaves: &GroupLeaves<'_>,
    ) -> bool {
        if self.current.is_node() {
            let node = &leaves.scene.nodes[self.current.index()];
            let (stack, t_cull) = (&mut self.stack, self.best.t_cull);
            self.top = kernel.push_children(node, &self.frame, t_cull, stack, self.top);
        } else if leaves.visit::<K, ANY>(kernel, self.current, &self.frame, &mut self.best) && ANY {
            return false;
        }
        while self.top > 0 {
            self.top -= 1;
            let entry = self.stack.get(self.top);
            if ANY || is_within(entry, self.best.t_cull) {
                self.current = child_of(entry);
                return true;
            }
        }
        false
    }
}

/// Rays that are not traversed yet.
struct Waiting<'a> {
    frames: FrameGroup<'a>,
    next: usize,
    count: usize,
    /// Groups that are left out, as bits.
    taken: u32,
}

impl Waiting<'_> {
    /// The next ray that can hit, and its index.
    #[inline(always)]
    fn next(&mut self) -> Option<(usize, RayFrame)> {
        while self.next < self.count {
            let index = self.next;
            if self.taken >> (index / GROUP) & 1 == 1 {
                self.next += GROUP;
                continue;
            }
            if index > 0 && index.is_multiple_of(GROUP) {
                self.frames = FrameGroup::new(self.frames.rays, index);
            }
            self.next += 1;
            if let Some(frame) = self.frames.get(index) {
                return Some((index, frame));
            }
        }
        None
    }
}
