//! A binary tree over the lights in the scene: choice by importance at a point. Where lights are few, a list of them
//! ([`few`](super::few)).
//!
//! From the root down, either child is taken with the probability of its share of the importance of
//! both; the path to every light is stored as a trail of bits, such that the probability of a light
//! that a ray hit by chance is the same product.
//!
//! Source: Conty Estevez and Kulla 2018, section 5.4; Pharr, Jakob and Humphreys, 4th edition,
//! 12.6.3.

use specula_bsdf::Vec3;

use super::build::{Emitter, build};
use super::few::{MOST_LIGHTS, Weights};
use super::node::{self, LEAST_SHARE, Node, Receiver, share};
use super::treelet::{Descent, Importances, Treelet, treelets};
use crate::convert::{id, words_of};
use crate::words::Words;

/// Trail of a light that is not in the tree; no trail is 64 long.
const ABSENT: u64 = u64::MAX;

/// A distribution over lights that depends on the receiver.
#[derive(Clone, Debug, Default)]
pub(crate) struct LightTree {
    /// Leaves alone where lights are few; otherwise a tree.
    nodes: Vec<Node>,
    /// The nodes nearest to the root once more, in groups.
    treelets: Vec<Treelet>,
    /// Path to every light of the scene: from the lowest bit on, 1 for right. In a list its place.
    trails: Vec<u64>,
}

impl LightTree {
    /// * `lights`: how many there are in the scene, in the tree or not.
    pub(super) fn new(mut emitters: Vec<Emitter>, lights: usize) -> Self {
        let mut nodes = build(&mut emitters);
        let mut trails = vec![ABSENT; lights];
        if emitters.len() <= MOST_LIGHTS {
            nodes.retain(|node| node.leaf);
            for (trail, node) in (0..).zip(&nodes) {
                trails[node.link as usize] = trail;
            }
            return Self {
                nodes,
                treelets: Vec::new(),
                trails,
            };
        }
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
        Self {
            treelets: treelets(&nodes),
            nodes,
            trails,
        }
    }

    /// Whether no light is in it.
    #[inline]
    pub(super) fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    pub(super) fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Whether it is a list of few lights.
    #[inline(always)]
    pub(super) fn is_list(&self) -> bool {
        self.nodes.first().is_none_or(|first| first.leaf)
    }

    /// The weights of a list's lights.
    #[inline]
    pub(super) fn weights(&self, importance: &impl Fn(usize) -> f32) -> Weights {
        Weights::new(self.nodes.len(), importance)
    }

    /// Probability of a light in a list.
    #[inline]
    pub(super) fn probability_in_list(&self, weights: &Weights, light: u32) -> f32 {
        let place = self.trails.get(light as usize).copied().unwrap_or(ABSENT);
        usize::try_from(place).map_or(0.0, |place| weights.probability(place))
    }

    /// Nodes, and trails as lower and upper words, for shaders.
    pub(super) fn flatten(&self, to: &mut Words) {
        to.float_constant("LIGHT_TREE_LEAST_SHARE", LEAST_SHARE);
        to.float_constant("LIGHT_NODE_SLACK", node::SLACK);
        to.float_constant("LIGHT_NODE_MOST", node::MOST);
        to.constant("LIGHT_NODE_COUNT", id(self.nodes.len()));
        to.constant("LIGHT_TREE_MOST_IN_LIST", id(MOST_LIGHTS));
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

    /// An estimate of the irradiance by all lights: the sum over the root's children, or over a list. 0 only where
    /// no light can contribute.
    #[inline]
    pub(super) fn total(&self, importance: &impl Fn(usize) -> f32) -> f32 {
        if self.is_list() {
            return self.weights(importance).total;
        }
        let [a, b] = self.children(0, importance);
        a + b
    }

    /// A light and its probability; `None` where the tree is empty.
    ///
    /// * `importance`: of each node.
    /// * `u`: uniform in `[0, 1)`, with more digits than `f32` has: every step takes one.
    #[inline]
    pub(super) fn sample(&self, importance: &impl Fn(usize) -> f32, u: f64) -> Option<(u32, f32)> {
        if self.is_list() {
            let weights = self.weights(importance);
            let place = weights.sample(u)?;
            return Some((self.nodes[place].link, weights.probability(place)));
        }
        self.sample_below(Choice::new(u), importance)
    }

    /// [`LightTree::sample`] from a node on.
    #[inline(always)]
    fn sample_below(
        &self,
        mut choice: Choice,
        importance: &impl Fn(usize) -> f32,
    ) -> Option<(u32, f32)> {
        loop {
            let node = self.nodes.get(choice.at)?;
            if node.leaf {
                return Some((node.link, choice.probability));
            }
            choice.step(&self.nodes, share(self.children(choice.at, importance)));
        }
    }

    /// The importances of the nodes nearest to the root; `None` of a list.
    #[inline(always)]
    pub(super) fn top(&self, at: (Vec3<f32>, Vec3<f32>)) -> Option<Importances> {
        // No closure: it would be compiled for the baseline.
        let first = self.treelets.first()?;
        Some(first.importances(at.0, at.1))
    }

    /// [`LightTree::sample`] by treelets.
    ///
    /// * `top`: of [`LightTree::top`].
    /// * `receiver`: point and normal, zero where light from every side counts.
    #[inline(always)]
    pub(super) fn sample_by_treelets(
        &self,
        top: Importances,
        receiver: (Vec3<f32>, Vec3<f32>),
        u: f64,
    ) -> Option<(u32, f32)> {
        let mut choice = Choice::new(u);
        let mut descent = self.descent(top);
        loop {
            let node = self.nodes.get(choice.at)?;
            if node.leaf {
                return Some((node.link, choice.probability));
            }
            let is_left = choice.step(&self.nodes, descent.left());
            let is_leaf = self.nodes.get(choice.at).is_none_or(|next| next.leaf);
            if !is_leaf && !descent.go(is_left, receiver) {
                let importance = |at: usize| self.nodes[at].importance_at(receiver.0, receiver.1);
                return self.sample_below(choice, &importance);
            }
        }
    }

    /// Probability with which a light is sampled for a receiver, by the tree.
    ///
    /// * `descent`: a walk through the treelets, by which it is faster.
    /// * `receiver`: point and normal, zero where light from every side counts.
    #[inline(always)]
    pub(super) fn probability(
        &self,
        mut descent: Option<Descent<'_>>,
        receiver: (Vec3<f32>, Vec3<f32>),
        light: u32,
    ) -> f32 {
        let Some(mut trail) = self.trails.get(light as usize).copied() else {
            return 0.0;
        };
        if trail == ABSENT {
            return 0.0;
        }
        let importance = |at: usize| self.nodes[at].importance_at(receiver.0, receiver.1);
        let mut at = 0;
        let mut probability = 1.0;
        while !self.nodes[at].leaf {
            let left = match &descent {
                Some(descent) => descent.left(),
                None => share(self.children(at, &importance)),
            };
            let is_left = trail & 1 == 0;
            if is_left {
                probability *= left;
                at += 1;
            } else {
                probability *= 1.0 - left;
                at += self.nodes[at].link as usize;
            }
            trail >>= 1;
            if let Some(walk) = &mut descent
                && !self.nodes[at].leaf
                && !walk.go(is_left, receiver)
            {
                descent = None;
            }
        }
        probability
    }

    /// A walk through the treelets, at the root.
    ///
    /// * `top`: of [`LightTree::top`].
    #[inline(always)]
    pub(super) fn descent(&self, top: Importances) -> Descent<'_> {
        Descent::new(&self.treelets, top)
    }

    #[inline(always)]
    fn children(&self, at: usize, importance: &impl Fn(usize) -> f32) -> [f32; 2] {
        let right = at + self.nodes[at].link as usize;
        [at + 1, right].map(importance)
    }
}

/// A choice on its way down from the root: the numbers in `low .. low + width` choose a light below the node.
///
/// There is no branch that depends on the choice, which no processor could foresee, and no division.
struct Choice {
    at: usize,
    probability: f32,
    u: f64,
    low: f64,
    width: f64,
}

impl Choice {
    #[inline(always)]
    fn new(u: f64) -> Self {
        Self {
            at: 0,
            probability: 1.0,
            u,
            low: 0.0,
            width: 1.0,
        }
    }

    /// Goes to one of the children; returns whether it is the left one.
    ///
    /// * `left`: the share of the left child.
    #[inline(always)]
    fn step(&mut self, nodes: &[Node], left: f32) -> bool {
        let step = Step::of(self.u, [self.low, self.width], left);
        let link = nodes[self.at].link as usize;
        self.probability *= step.probability;
        [self.low, self.width] = step.interval;
        self.at += if step.is_left { 1 } else { link };
        step.is_left
    }
}

/// The choice between the children of a node.
pub(super) struct Step {
    pub(super) is_left: bool,
    /// Of the child.
    pub(super) probability: f32,
    /// `low` and `width` of the numbers that choose below the child.
    pub(super) interval: [f64; 2],
}

impl Step {
    /// * `[low, width]`: the numbers that choose below the node.
    /// * `left`: the share of the left child.
    #[inline(always)]
    pub(super) fn of(u: f64, [low, width]: [f64; 2], left: f32) -> Self {
        let width_of_left = width * f64::from(left);
        let middle = low + width_of_left;
        // Rounding must not lead to a child whose share is 0.
        let is_left = ((u < middle) & (left > 0.0)) | (left >= 1.0);
        Self {
            is_left,
            probability: if is_left { left } else { 1.0 - left },
            interval: [
                if is_left { low } else { middle },
                if is_left {
                    width_of_left
                } else {
                    width - width_of_left
                },
            ],
        }
    }
}

#[cfg(test)]
mod tests {
    use specula_bsdf::math::vec3;

    use super::*;
    use crate::accel::Bounds;
    use crate::light::cone::EmissionCone;

    /// Lamps on a line, ever denser, that look up or to all sides.
    fn emitters(count: u16) -> Vec<Emitter> {
        let emitter = |i: u16| {
            let x = 8.0 / f32::from(i + 1);
            let y = f32::from(i % 7);
            Emitter {
                light: u32::from(i),
                bounds: Bounds {
                    min: [x, y, 0.0],
                    max: [x + 0.1, y + 0.1, 0.0],
                },
                cone: match i % 3 {
                    0 => EmissionCone::SPHERE,
                    k => EmissionCone::flat(vec3(0.0, 0.6, 0.8), k == 1),
                },
                intensity: f64::from(1 + i % 5),
            }
        };
        (0..count).map(emitter).collect()
    }

    #[test]
    fn treelets_choose_what_single_nodes_choose() {
        for (count, most) in [(17, 9), (900, 1000), (900, 20), (900, 1)] {
            let mut tree = LightTree::new(emitters(count), usize::from(count) + 1);
            // What lies below those that are left goes node by node.
            tree.treelets.truncate(most);
            let mut chosen = vec![0; usize::from(count)];
            for i in 0_u16..600 {
                let t = f32::from(i) / 600.0;
                let point = vec3(9.0 * t - 1.0, 6.0 * (7.0 * t).fract(), (3.0 * t).fract());
                let normal = [Vec3::ZERO, Vec3::Z, -Vec3::Y][usize::from(i % 3)];
                let importance = |at: usize| tree.nodes[at].importance_at(point, normal);
                let u = f64::from(i) * 0.618_034 % 1.0;
                let top = tree.top((point, normal)).unwrap();
                let expected = tree.sample(&importance, u);
                assert_eq!(tree.sample_by_treelets(top, (point, normal), u), expected);
                let (light, probability) = expected.unwrap();
                chosen[light as usize] += 1;
                let by_treelets =
                    |light| tree.probability(Some(tree.descent(top)), (point, normal), light);
                for light in [light, u32::from(i % (count + 1))] {
                    let p = tree.probability(None, (point, normal), light);
                    assert_eq!(by_treelets(light), p);
                }
                let p = by_treelets(light);
                assert!((p - probability).abs() <= 1e-6 * p);
            }
            let different = chosen.iter().filter(|&&n| n > 0).count();
            assert!(
                different >= usize::from(count).min(100),
                "{count}: {different}"
            );
        }
    }

    #[test]
    fn few_lights_have_no_treelets() {
        for count in [0, 1, 2, 16, 17] {
            let tree = LightTree::new(emitters(count), usize::from(count));
            assert_eq!(tree.is_list(), count <= 16);
            assert_eq!(tree.top((Vec3::ZERO, Vec3::Z)).is_none(), count <= 16);
            let nodes = if count <= 16 { count } else { 2 * count - 1 };
            assert_eq!(tree.nodes.len(), usize::from(nodes));
        }
    }
}
