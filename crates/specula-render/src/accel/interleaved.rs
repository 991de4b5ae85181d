//! Interleaved traversal: several rays through one tree, so that the others proceed while a node of one of them is
//! loaded from memory.
//!
//! Each ray visits the nodes that [`super::traverse`] would visit. That traversal is separate because it is faster where
//! nothing has to be loaded: its state stays in registers.

use super::Hit;
use super::block::Rays;
use super::frame::RayFrame;
use super::kernel::{EntryStack, Kernel};
use super::node::{Child, Lanes, Node8};
use super::traverse::{ClosestHit, GroupLeaves, Leaves, Scene, child_of};

/// Rays that are interleaved. Measured: `cargo xtask rays`.
const RAYS: usize = 8;
/// Bytes of a tree that the first levels of caches are assumed to hold. Measured likewise.
const IN_CACHE: usize = 4 << 20;
/// Least squared cosine between directions of coherent rays, which need nodes that are in the cache already.
const COHERENT: f32 = 0.9;

/// [`super::traverse::intersect`] of each ray; `hits` are as many, and `None`.
#[inline(always)]
pub(super) fn intersect<K: Kernel, R: Rays + ?Sized>(
    kernel: K,
    scene: &Scene,
    rays: &R,
    hits: &mut [Option<Hit>],
) {
    cast::<K, R, false>(kernel, scene, rays, |ray, best| hits[ray] = best.hit());
}

/// [`super::traverse::occluded`] of each ray; `occluded` are as many, and `false`.
#[inline(always)]
pub(super) fn occluded<K: Kernel, R: Rays + ?Sized>(
    kernel: K,
    scene: &Scene,
    rays: &R,
    occluded: &mut [bool],
) {
    cast::<K, R, true>(kernel, scene, rays, |ray, best| {
        occluded[ray] = best.hit().is_some()
    });
}

/// Whether interleaving is faster: where there is one group, larger than the caches, and the rays are incoherent.
pub(super) fn gains<R: Rays + ?Sized>(scene: &Scene, rays: &R) -> bool {
    let bytes = size_of_val(scene.nodes.as_slice()) + size_of_val(scene.packets.as_slice());
    scene.single.is_some() && bytes > IN_CACHE && !are_coherent(rays)
}

/// Whether all directions are close to the first.
fn are_coherent<R: Rays + ?Sized>(rays: &R) -> bool {
    if rays.count() == 0 {
        return true;
    }
    let axis = rays.ray(0).direction;
    let least = COHERENT * axis.length_squared();
    (0..rays.count()).all(|k| {
        let direction = rays.ray(k).direction;
        let along = direction.dot(axis);
        along > 0.0 && along * along > least * direction.length_squared()
    })
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

/// Traverses the rays, and calls `done` for each with its closest hit. Skips rays that cannot hit. Only where there is
/// one group.
///
/// * `ANY`: stops at any hit.
#[inline(always)]
fn cast<K: Kernel, R: Rays + ?Sized, const ANY: bool>(
    kernel: K,
    scene: &Scene,
    rays: &R,
    mut done: impl FnMut(usize, &ClosestHit),
) {
    let (Some(root), Some(instance)) = (scene.root, scene.single) else {
        return;
    };
    let leaves = GroupLeaves { scene, instance };
    let mut waiting = (0..rays.count()).filter_map(|index| {
        let ray = rays.ray(index);
        let frame = RayFrame::new(&ray)?;
        Some((index, frame, ClosestHit::new(ray.t_max)))
    });
    let mut in_flight: [Option<RayInFlight<K::Stack>>; RAYS] = std::array::from_fn(|_| {
        let (index, frame, best) = waiting.next()?;
        Some(RayInFlight {
            index,
            frame,
            best,
            stack: kernel.stack(),
            top: 0,
            current: root,
        })
    });
    let mut active = in_flight.iter().flatten().count();
    while active > 0 {
        for place in &mut in_flight {
            let Some(ray) = place else { continue };
            if ray.step::<K, ANY>(kernel, scene, &leaves) {
                kernel.prefetch(scene, ray.current);
                continue;
            }
            done(ray.index, &ray.best);
            if let Some((index, frame, best)) = waiting.next() {
                (ray.index, ray.frame, ray.best) = (index, frame, best);
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
        scene: &Scene,
        leaves: &GroupLeaves<'_>,
    ) -> bool {
        if self.current.is_node() {
            if self.enter::<K, ANY>(kernel, &scene.nodes[self.current.index()]) {
                return true;
            }
        } else if leaves.visit::<K, ANY>(kernel, self.current, &self.frame, &mut self.best) && ANY {
            return false;
        }
        while self.top > 0 {
            self.top -= 1;
            let entry = self.stack.get(self.top);
            if ANY || f32::from_bits((entry >> 32) as u32) <= self.best.t_cull {
                self.current = child_of(entry);
                return true;
            }
        }
        false
    }

    /// Goes to the nearest child whose box is hit and pushes the others onto the stack; `false` where none is hit.
    #[inline(always)]
    fn enter<K: Kernel<Stack = S>, const ANY: bool>(&mut self, kernel: K, node: &Node8) -> bool {
        let mut entries = Lanes::default();
        let mut mask = kernel.boxes(node, &self.frame, self.best.t_cull, &mut entries);
        if mask == 0 {
            return false;
        }
        let mut next_entry = || {
            let lane = (mask.trailing_zeros() & 7) as usize;
            mask &= mask - 1;
            let child = u64::from(node.children[lane].0);
            let entry = (u64::from(entries.0[lane].to_bits()) << 32) | child;
            (entry, mask != 0)
        };
        let base = self.top;
        let (mut nearest, mut more) = next_entry();
        while more {
            let entry;
            (entry, more) = next_entry();
            let farther = nearest.max(entry);
            nearest = nearest.min(entry);
            let mut at = self.top;
            if !ANY {
                // The farthest at the bottom.
                while at > base && self.stack.get(at - 1) < farther {
                    self.stack.set(at, self.stack.get(at - 1));
                    at -= 1;
                }
            }
            self.stack.set(at, farther);
            self.top += 1;
        }
        self.current = child_of(nearest);
        true
    }
}
