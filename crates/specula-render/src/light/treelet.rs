//! Nodes of the light tree in groups whose importances for one receiver are computed at once.
//!
//! A treelet holds the three levels below a node: 2 + 4 + 8 nodes, one in each lane of a vector. A walk through the
//! tree takes three steps for each treelet.

#![allow(
    clippy::needless_range_loop,
    reason = "an index below the arrays' length is what the compiler makes vectors of"
)]

use std::collections::VecDeque;

use specula_bsdf::Vec3;
use specula_bsdf::math::vec3;

use super::node::{Node, share};
use crate::codes::NONE;
use crate::convert::id;

/// Lanes of a vector, of which two have no node.
const LANES: usize = 16;
/// Nodes whose children are in the same treelet.
const INNER: usize = 6;
/// Nodes of the last level.
const LAST: usize = 8;
/// Most treelets of a tree, those nearest to its root: 3 MiB.
const MOST: usize = 4096;

/// Importances of a treelet's nodes: the root's children first, then the children of each in turn.
pub(super) type Importances = [f32; LANES];

/// The nodes on three levels below one.
#[derive(Clone, Debug)]
pub(super) struct Treelet {
    centre: [[f32; LANES]; 3],
    radius: [f32; LANES],
    inverse_square: [f32; LANES],
    axis: [[f32; LANES]; 3],
    cos_o: [f32; LANES],
    sin_o: [f32; LANES],
    cos_e: [f32; LANES],
    intensity: [f32; LANES],
    /// 1 where lights have two sides, else 0.
    two_sided: [f32; LANES],
    /// The treelet below each node of the last level, or [`NONE`].
    below: [u32; LAST],
}

impl Treelet {
    /// * `nodes`: the tree's.
    /// * `slots`: indices of the treelet's nodes, where there are any.
    fn new(nodes: &[Node], slots: &[Option<usize>; LANES]) -> Self {
        let each = |of: fn(&Node) -> f32| slots.map(|at| at.map_or(0.0, |at| of(&nodes[at])));
        Self {
            centre: [
                each(|n| n.centre.x),
                each(|n| n.centre.y),
                each(|n| n.centre.z),
            ],
            radius: each(|n| n.radius),
            inverse_square: each(|n| n.inverse_square),
            axis: [each(|n| n.axis.x), each(|n| n.axis.y), each(|n| n.axis.z)],
            cos_o: each(|n| n.cos_o),
            sin_o: each(|n| n.sin_o),
            cos_e: each(|n| n.cos_e),
            intensity: each(|n| n.intensity),
            two_sided: each(|n| f32::from(u8::from(n.two_sided))),
            below: [NONE; LAST],
        }
    }

    /// [`Node::importance_at`] of all nodes.
    #[inline(always)]
    pub(super) fn importances(&self, point: Vec3<f32>, normal: Vec3<f32>) -> Importances {
        let mut importances = [0.0; LANES];
        for k in 0..LANES {
            let lane = |v: &[[f32; LANES]; 3]| vec3(v[0][k], v[1][k], v[2][k]);
            let node = Node {
                centre: lane(&self.centre),
                radius: self.radius[k],
                inverse_square: self.inverse_square[k],
                axis: lane(&self.axis),
                cos_o: self.cos_o[k],
                sin_o: self.sin_o[k],
                cos_e: self.cos_e[k],
                intensity: self.intensity[k],
                two_sided: self.two_sided[k] > 0.0,
                leaf: false,
                link: 0,
            };
            importances[k] = node.importance_without_branches(point, normal);
        }
        importances
    }
}

/// The treelets of a tree from its root on, in the order of their depths; none where the root is a leaf.
pub(super) fn treelets(nodes: &[Node]) -> Vec<Treelet> {
    let children = |at: usize| {
        let node = &nodes[at];
        (!node.leaf).then(|| [at + 1, at + node.link as usize])
    };
    let mut made: Vec<Treelet> = Vec::new();
    // Roots, with the place of each in the treelet above.
    let mut open: VecDeque<(usize, Option<(usize, usize)>)> = VecDeque::new();
    if nodes.first().is_some_and(|root| !root.leaf) {
        open.push_back((0, None));
    }
    while let Some((root, above)) = open.pop_front() {
        let mut slots = [None::<usize>; LANES];
        for k in 0..=INNER {
            let at = if k == 0 { Some(root) } else { slots[k - 1] };
            if let Some([left, right]) = at.and_then(&children) {
                slots[2 * k] = Some(left);
                slots[2 * k + 1] = Some(right);
            }
        }
        let here = made.len();
        if let Some((treelet, place)) = above {
            made[treelet].below[place] = id(here);
        }
        made.push(Treelet::new(nodes, &slots));
        for (place, at) in slots[INNER..INNER + LAST].iter().enumerate() {
            let has_room = made.len() + open.len() < MOST;
            if let Some(at) = at.filter(|at| has_room && !nodes[*at].leaf) {
                open.push_back((at, Some((here, place))));
            }
        }
    }
    made
}

/// A walk from a tree's root down, through its treelets as far as there are any.
pub(super) struct Descent<'a> {
    treelets: &'a [Treelet],
    /// Of the left child of each place.
    shares: [f32; LANES / 2],
    treelet: usize,
    /// Of the current node, one more than its slot; 0 for the root.
    place: usize,
}

impl<'a> Descent<'a> {
    /// A walk that stands at the root.
    ///
    /// * `importances`: of the first treelet.
    #[inline(always)]
    pub(super) fn new(treelets: &'a [Treelet], importances: Importances) -> Self {
        Self {
            treelets,
            shares: shares(&importances),
            treelet: 0,
            place: 0,
        }
    }

    /// The share of the current node's left child.
    #[inline(always)]
    pub(super) fn left(&self) -> f32 {
        self.shares[self.place % (LANES / 2)]
    }

    /// Goes to a child of the current node; `false` where its children are in no treelet.
    #[inline(always)]
    pub(super) fn go(&mut self, is_left: bool, (point, normal): (Vec3<f32>, Vec3<f32>)) -> bool {
        self.place = 2 * self.place + 2 - usize::from(is_left);
        if self.place <= INNER {
            return true;
        }
        let below = self.treelets[self.treelet].below[(self.place - INNER - 1) % LAST];
        let Some(next) = self.treelets.get(below as usize) else {
            return false;
        };
        self.treelet = below as usize;
        self.place = 0;
        self.shares = shares(&next.importances(point, normal));
        true
    }
}

/// The share of each left child.
#[inline(always)]
fn shares(importances: &Importances) -> [f32; LANES / 2] {
    let mut shares = [0.0; LANES / 2];
    for k in 0..LANES / 2 {
        shares[k] = share([importances[2 * k], importances[2 * k + 1]]);
    }
    shares
}
