//! Several rays in step through one tree: while what one needs next comes from memory, others go on.
//!
//! Each ray goes the way that [`super::traverse`] would take it; that walk is kept apart because it is
//! faster where nothing has to be waited for: its state stays in registers.

use super::frame::RayFrame;
use super::kernel::{EntryStack, Kernel};
use super::node::{Child, Lanes, Node8};
use super::traverse::{Best, GroupLeaves, Leaves, Scene, child_of};
use super::{Hit, Ray};

/// How many rays go in step. Measured: `cargo xtask rays`.
const RAYS: usize = 8;
/// Bytes of a tree that the caches next to the processor are taken to hold. Measured likewise.
const IN_CACHE: usize = 4 << 20;
/// Least squared cosine between directions of rays that find in the cache what the ray before them
/// needed.
const NARROW: f32 = 0.9;

/// [`super::traverse::intersect`] of each ray; `hits` are as many, and `None`.
#[inline(always)]
pub(super) fn intersect<K: Kernel>(
    kernel: K,
    scene: &Scene,
    rays: &[Ray],
    hits: &mut [Option<Hit>],
) {
    cast::<K, false>(kernel, scene, rays, |ray, best| hits[ray] = best.hit());
}

/// [`super::traverse::occluded`] of each ray; `found` are as many, and `false`.
#[inline(always)]
pub(super) fn occluded<K: Kernel>(kernel: K, scene: &Scene, rays: &[Ray], found: &mut [bool]) {
    cast::<K, true>(kernel, scene, rays, |ray, best| {
        found[ray] = best.hit().is_some()
    });
}

/// Whether rays gain by going in step: where there is one group, larger than the caches, and the rays
/// go different ways.
pub(super) fn gains(scene: &Scene, rays: &[Ray]) -> bool {
    let bytes = size_of_val(scene.nodes.as_slice()) + size_of_val(scene.packets.as_slice());
    scene.single.is_some() && bytes > IN_CACHE && !are_narrow(rays)
}

/// Whether all directions lie about the first.
fn are_narrow(rays: &[Ray]) -> bool {
    let Some(axis) = rays.first().map(|ray| ray.direction) else {
        return true;
    };
    let least = NARROW * axis.length_squared();
    rays.iter().all(|ray| {
        let along = ray.direction.dot(axis);
        along > 0.0 && along * along > least * ray.direction.length_squared()
    })
}

/// A ray on its way.
struct Traveller<S> {
    /// Index of the ray.
    ray: usize,
    frame: RayFrame,
    best: Best,
    /// See [`super::traverse`].
    stack: S,
    top: usize,
    current: Child,
}

/// `ANY`: stops at a ray's first hit. Rays that cannot hit are passed over. Only where there is one
/// group.
#[inline(always)]
fn cast<K: Kernel, const ANY: bool>(
    kernel: K,
    scene: &Scene,
    rays: &[Ray],
    mut done: impl FnMut(usize, &Best),
) {
    let (Some(root), Some(instance)) = (scene.root, scene.single) else {
        return;
    };
    let leaves = GroupLeaves { scene, instance };
    let mut waiting = rays.iter().enumerate().filter_map(|(index, ray)| {
        let frame = RayFrame::new(ray)?;
        Some((index, frame, Best::new(ray.t_max)))
    });
    let mut travellers: [Option<Traveller<K::Stack>>; RAYS] = std::array::from_fn(|_| {
        let (ray, frame, best) = waiting.next()?;
        Some(Traveller {
            ray,
            frame,
            best,
            stack: kernel.stack(),
            top: 0,
            current: root,
        })
    });
    let mut on_their_way = travellers.iter().flatten().count();
    while on_their_way > 0 {
        for place in &mut travellers {
            let Some(traveller) = place else { continue };
            if traveller.step::<K, ANY>(kernel, scene, &leaves) {
                kernel.prefetch(scene, traveller.current);
                continue;
            }
            done(traveller.ray, &traveller.best);
            if let Some((ray, frame, best)) = waiting.next() {
                (traveller.ray, traveller.frame, traveller.best) = (ray, frame, best);
                (traveller.top, traveller.current) = (0, root);
            } else {
                *place = None;
                on_their_way -= 1;
            }
        }
    }
}

impl<S: EntryStack> Traveller<S> {
    /// Deals with the current child and goes to the next; `false` where there is none.
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

    /// Goes to the nearest child that is met and leaves the others on the stack; `false` where none
    /// is.
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
