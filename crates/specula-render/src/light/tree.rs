//! A binary tree over the lights in the scene: choice by importance at a point.
//!
//! From the root down, either child is taken with the probability of its share of the importance of
//! both; the path to every light is stored as a trail of bits, such that the probability of a light
//! that a ray hit by chance is the same product.
//!
//! Source: Conty Estevez and Kulla 2018, section 5.4; Pharr, Jakob and Humphreys, 4th edition,
//! 12.6.3.

use super::build::{Emitter, build};
use super::node::{self, Node, Receiver};
use crate::convert::{id, words_of};
use crate::words::Words;

/// Trail of a light that is not in the tree; no trail is 64 long.
const ABSENT: u64 = u64::MAX;

/// Least share of the lesser child: rounding must not take its chance.
const LEAST_SHARE: f32 = 1e-6;

/// A distribution over lights that depends on the receiver.
#[derive(Clone, Debug, Default)]
pub(crate) struct LightTree {
    nodes: Vec<Node>,
    /// Path to every light of the scene: from the lowest bit on, 1 for right.
    trails: Vec<u64>,
}

impl LightTree {
    /// * `lights`: how many there are in the scene, in the tree or not.
    pub(super) fn new(mut emitters: Vec<Emitter>, lights: usize) -> Self {
        let nodes = build(&mut emitters);
        let mut trails = vec![ABSENT; lights];
        let mut open = vec![(0, 0, 0_u32)];
        while let Some((at, trail, depth)) = open.pop() {
            let Some(node): Option<&Node> = nodes.get(at) else {
                break;
            };
            if node.leaf {
                trails[node.link as usize] = trail;
            } else {
                open.push((at + 1, trail, depth + 1));
                open.push((at + node.link as usize, trail | 1 << depth, depth + 1));
            }
        }
        Self { nodes, trails }
    }

    /// Whether no light is in it.
    #[inline]
    pub(super) fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    pub(super) fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Nodes, and trails as lower and upper words, for shaders.
    pub(super) fn flatten(&self, to: &mut Words) {
        to.float_constant("LIGHT_TREE_LEAST_SHARE", LEAST_SHARE);
        to.float_constant("LIGHT_NODE_SLACK", node::SLACK);
        to.float_constant("LIGHT_NODE_MOST", node::MOST);
        to.constant("LIGHT_NODE_COUNT", id(self.nodes.len()));
        to.begin("LIGHT_NODES");
        for node in &self.nodes {
            node.flatten(to);
        }
        to.begin("LIGHT_TRAILS");
        for &trail in &self.trails {
            to.ids(words_of(trail));
        }
    }

    /// The importance of each node for a receiver.
    #[inline(always)]
    pub(super) fn importances(&self, receiver: &Receiver) -> impl Fn(usize) -> f32 {
        |at| self.nodes[at].importance(receiver)
    }

    /// An estimate of the irradiance by all lights: the sum over the root's children. 0 only where
    /// no light can contribute.
    #[inline]
    pub(super) fn total(&self, importance: &impl Fn(usize) -> f32) -> f32 {
        match self.nodes.first() {
            None => 0.0,
            Some(root) if root.leaf => importance(0),
            Some(_) => {
                let [a, b] = self.children(0, importance);
                a + b
            }
        }
    }

    /// A light and its probability; `None` where the tree is empty.
    ///
    /// * `importance`: of each node.
    /// * `u`: uniform in `[0, 1)`, with more digits than `f32` has: every step takes one.
    #[inline]
    pub(super) fn sample(
        &self,
        importance: &impl Fn(usize) -> f32,
        mut u: f64,
    ) -> Option<(u32, f32)> {
        let mut at = 0;
        let mut probability = 1.0;
        loop {
            let node = self.nodes.get(at)?;
            if node.leaf {
                return Some((node.link, probability));
            }
            let left = share(self.children(at, importance));
            let threshold = f64::from(left);
            let is_left = u < threshold;
            probability *= if is_left { left } else { 1.0 - left };
            at += if is_left { 1 } else { node.link as usize };
            if self.nodes.get(at).is_some_and(|next| next.leaf) {
                // No step needs its digits any more.
                continue;
            }
            u = if is_left {
                u / threshold
            } else {
                (u - threshold) / (1.0 - threshold)
            };
            u = u.min(1.0 - f64::EPSILON);
        }
    }

    /// Probability with which [`LightTree::sample`] samples a light by the same importances.
    #[inline]
    pub(super) fn probability(&self, importance: &impl Fn(usize) -> f32, light: u32) -> f32 {
        let Some(mut trail) = self.trails.get(light as usize).copied() else {
            return 0.0;
        };
        if trail == ABSENT {
            return 0.0;
        }
        let mut at = 0;
        let mut probability = 1.0;
        while !self.nodes[at].leaf {
            let left = share(self.children(at, importance));
            if trail & 1 == 0 {
                probability *= left;
                at += 1;
            } else {
                probability *= 1.0 - left;
                at += self.nodes[at].link as usize;
            }
            trail >>= 1;
        }
        probability
    }

    #[inline(always)]
    fn children(&self, at: usize, importance: &impl Fn(usize) -> f32) -> [f32; 2] {
        let right = at + self.nodes[at].link as usize;
        [at + 1, right].map(importance)
    }
}

/// Share of the first, off 0 and 1 unless one is 0 alone; a half where both are: nothing arrives
/// then, but the probabilities still add up to 1.
#[inline(always)]
fn share([a, b]: [f32; 2]) -> f32 {
    if a <= 0.0 {
        if b > 0.0 { 0.0 } else { 0.5 }
    } else if b <= 0.0 {
        1.0
    } else {
        (a / (a + b)).clamp(LEAST_SHARE, 1.0 - LEAST_SHARE)
    }
}
