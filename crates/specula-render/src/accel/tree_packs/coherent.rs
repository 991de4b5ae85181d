//! Coherent rays through a tree: what bounds all of them tells which children any of them may reach.

use super::{FEW, Lanes, Pack};
use crate::accel::frustum::Frustum;
use crate::accel::kernel::Kernel;
use crate::accel::node::{self, Child, WIDTH};
use crate::accel::pack::Column;
use crate::accel::traverse::{GroupLeaves, Scene};

/// A child of a node that waits to be tested against each ray of a coherent pack.
#[derive(Clone, Copy)]
pub(super) struct Candidate {
    /// Where the first ray may enter its box.
    near: f32,
    node: Child,
    slot: u32,
    /// Whether it is the only one of its node that rays reach: then most of them do, and a test of its box tells little.
    is_only: bool,
    lanes: Lanes,
}

impl Pack<'_> {
    /// Visits the tree with coherent rays.
    #[inline(always)]
    pub(super) fn traverse_together<K: Kernel, const ANY: bool>(
        &mut self,
        kernel: K,
        leaves: &GroupLeaves<'_>,
        root: Child,
        stack: &mut Vec<Candidate>,
    ) {
        let frustum = Frustum::new(self.near, &self.origin, &self.near_scale);
        stack.clear();
        let (mut current, mut lanes) = (root, self.frames.can_hit());
        loop {
            if current.is_node() && Lanes::count_ones(lanes) >= FEW[1] {
                self.push_candidates(kernel, leaves.scene, (current, lanes), &frustum, stack);
            } else {
                self.visit::<K, ANY>(kernel, leaves, current, lanes, Some(&frustum));
            }
            loop {
                let Some(candidate) = stack.pop() else {
                    return;
                };
                if candidate.near > self.t_most {
                    continue;
                }
                let node = &leaves.scene.nodes[candidate.node.index()];
                let slot = candidate.slot as usize % WIDTH;
                lanes = candidate.lanes;
                if !candidate.is_only {
                    let mut near = Column::ZERO;
                    let far = self.enter_box::<true>(node, slot, &mut near);
                    lanes &= kernel.are_at_most(&near.0, &far.0);
                }
                if ANY {
                    lanes &= !self.hit;
                }
                if lanes != 0 {
                    current = node.children[slot];
                    break;
                }
            }
        }
    }

    /// Pushes the children of a node that rays may reach, the farthest first.
    #[inline(always)]
    fn push_candidates<K: Kernel>(
        &self,
        kernel: K,
        scene: &Scene,
        (child, lanes): (Child, Lanes),
        frustum: &Frustum,
        stack: &mut Vec<Candidate>,
    ) {
        let node = &scene.nodes[child.index()];
        let mut entry = node::Lanes::default();
        let mut reached = frustum.boxes(kernel, node, self.t_most, &mut entry);
        let is_only = reached.is_power_of_two();
        let base = stack.len();
        while reached != 0 {
            let slot = reached.trailing_zeros();
            reached &= reached - 1;
            let at = slot as usize % WIDTH;
            kernel.prefetch(scene, node.children[at]);
            let near = entry.0[at];
            let candidate = Candidate {
                near,
                node: child,
                slot,
                is_only,
                lanes,
            };
            let mut at = stack.len();
            stack.push(candidate);
            while at > base && stack[at - 1].near < near {
                stack[at] = stack[at - 1];
                at -= 1;
            }
            stack[at] = candidate;
        }
    }
}
