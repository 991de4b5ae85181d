//! Collapses binary trees to 8-wide ones with the least cost by surface area.

use std::collections::BinaryHeap;

use super::Bounds;
use super::binary::Binary;
use super::kernel::MAX_DEPTH;
use super::node::{Child, ChildKind, Node8, WIDTH};

/// Cost of testing a packet of triangles, relative to a node. Measured, see `benches/rays.rs`.
const PACKET_COST: f64 = 1.0;

/// Share of nodes that reinsertion tries.
pub(super) const EFFORT: f32 = 0.2;

/// A finished tree.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tree {
    /// Its root, a node unless the tree is part of a larger one.
    pub(super) root: Child,
    pub(super) bounds: Bounds,
    /// Levels of nodes.
    pub(super) depth: usize,
}

/// Builds the tree over `items` into `nodes`. `leaf` turns items into a leaf: one item, or several of
/// triangles, up to 8 of them. `items` is not empty.
///
/// * `triangles`: how many triangles an item has; 0 for what must be a leaf of its own.
pub(super) fn build(
    items: &[Bounds],
    triangles: impl Fn(u32) -> usize,
    nodes: &mut Vec<Node8>,
    mut leaf: impl FnMut(&[u32]) -> Child,
) -> Tree {
    Plan::within(items, (MAX_DEPTH, EFFORT), triangles).emit(0, nodes, &mut leaf)
}

/// The same as at most `count` trees, to be joined under others.
///
/// * `most`: levels of each, unless a balanced tree has more.
/// * `effort`: see [`Binary::optimised`].
pub(super) fn build_parts(
    items: &[Bounds],
    count: usize,
    (most, effort): (usize, f32),
    triangles: impl Fn(u32) -> usize,
    nodes: &mut Vec<Node8>,
    mut leaf: impl FnMut(&[u32]) -> Child,
) -> Vec<Tree> {
    let plan = Plan::within(items, (most, effort), triangles);
    let parts = plan.parts(count);
    parts
        .into_iter()
        .map(|at| {
            if !plan.is_leaf(at) {
                return plan.emit(at, nodes, &mut leaf);
            }
            let mut items = Vec::new();
            plan.items(at, &mut items);
            Tree {
                root: leaf(&items),
                bounds: plan.tree.0[at as usize].bounds,
                depth: 0,
            }
        })
        .collect()
}

/// The tree over trees that were built before, of at most `most` levels unless a balanced one has
/// more.
pub(super) fn join(trees: &[Tree], most: usize, nodes: &mut Vec<Node8>) -> Tree {
    let bounds: Vec<Bounds> = trees.iter().map(|tree| tree.bounds).collect();
    let deepest = trees.iter().map(|tree| tree.depth).max().unwrap_or(0);
    let plan = Plan::within(&bounds, (most, EFFORT), |_| 0);
    let above = plan.emit(0, nodes, &mut |leaf| trees[leaf[0] as usize].root);
    Tree {
        depth: above.depth + deepest,
        ..above
    }
}

/// The same from a binary tree whose wide tree is shallow enough.
#[cfg(test)]
pub(super) fn plant(
    tree: Binary,
    triangles: impl Fn(u32) -> usize,
    nodes: &mut Vec<Node8>,
    mut leaf: impl FnMut(&[u32]) -> Child,
) -> Tree {
    Plan::new(tree, &triangles).emit(0, nodes, &mut leaf)
}

/// How a binary tree is collapsed: what becomes of each of its nodes.
///
/// `choices[n][j]` says how the subtree `n` is best cut into at most `j` wide children: into `k` of
/// its left part and `j - k` of its right one; 0 where `j - 1` children do as well. `choices[n][1]`:
/// 0 for a leaf, else the `k` of the node's own [`WIDTH`] children.
struct Plan {
    tree: Binary,
    choices: Vec<[u8; WIDTH]>,
}

impl Plan {
    /// Of the best tree, or of a balanced one where that has more than `most` levels.
    fn within(
        items: &[Bounds],
        (most, effort): (usize, f32),
        triangles: impl Fn(u32) -> usize,
    ) -> Self {
        let optimised = Self::new(Binary::optimised(items, effort), &triangles);
        if optimised.depth() <= most {
            return optimised;
        }
        Self::new(Binary::balanced(items), &triangles)
    }

    /// Dynamic programming from the leaves up (Ylitie, Karras and Laine 2017, eqs. 1 to 5).
    fn new(tree: Binary, triangles: &impl Fn(u32) -> usize) -> Self {
        let mut choices = vec![[0; WIDTH]; tree.0.len()];
        // Costs of the subtrees whose parent is still to come, with how many triangles they have, 0
        // for what is no packet's. In reverse preorder the left child is on top of the right one.
        let mut pending: Vec<([f64; WIDTH], usize)> = Vec::new();
        for (at, node) in tree.0.iter().enumerate().rev() {
            let area = node.bounds.half_area();
            if node.right == 0 {
                pending.push(([area * PACKET_COST; WIDTH], triangles(node.item)));
                continue;
            }
            let (Some((left, of_left)), Some((right, of_right))) = (pending.pop(), pending.pop())
            else {
                unreachable!("children come before their parent in reverse preorder");
            };
            let count = match of_left.min(of_right) {
                0 => 0,
                _ => of_left + of_right,
            };
            let (own, split) = best_split(&left, &right, WIDTH);
            let as_node = area + own;
            let as_leaf = area * PACKET_COST;
            let mut costs = [f64::INFINITY; WIDTH];
            if (1..=WIDTH).contains(&count) && as_leaf <= as_node {
                costs[1] = as_leaf;
            } else {
                costs[1] = as_node;
                choices[at][1] = split;
            }
            for j in 2..WIDTH {
                let (cost, split) = best_split(&left, &right, j);
                costs[j] = costs[j - 1];
                if cost < costs[j] {
                    costs[j] = cost;
                    choices[at][j] = split;
                }
            }
            pending.push((costs, count));
        }
        Self { tree, choices }
    }

    /// The binary nodes that become the children of the wide node `at`.
    fn children(&self, at: u32, out: &mut Vec<u32>) {
        out.clear();
        match self.choices[at as usize][1] {
            0 => out.push(at),
            k => self.halves(at, usize::from(k), WIDTH, out),
        }
    }

    fn halves(&self, at: u32, k: usize, j: usize, out: &mut Vec<u32>) {
        self.cut(at + 1, k, out);
        self.cut(self.tree.0[at as usize].right, j - k, out);
    }

    fn cut(&self, at: u32, mut j: usize, out: &mut Vec<u32>) {
        while j > 1 {
            match self.choices[at as usize][j] {
                0 => j -= 1,
                k => return self.halves(at, usize::from(k), j, out),
            }
        }
        out.push(at);
    }

    fn is_leaf(&self, at: u32) -> bool {
        self.choices[at as usize][1] == 0
    }

    /// Levels of wide nodes.
    fn depth(&self) -> usize {
        let (mut deepest, mut children) = (0, Vec::new());
        let mut pending = vec![(0, 1)];
        while let Some((at, depth)) = pending.pop() {
            deepest = deepest.max(depth);
            self.children(at, &mut children);
            let inner = children.iter().filter(|&&c| !self.is_leaf(c));
            pending.extend(inner.map(|&c| (c, depth + 1)));
        }
        deepest
    }

    /// At most `count` subtrees that hold everything: the largest are opened first.
    fn parts(&self, count: usize) -> Vec<u32> {
        // By the bits of areas: floats that are not negative are ordered as their bits are.
        let area = |at: u32| self.tree.0[at as usize].bounds.half_area().to_bits();
        let mut open = BinaryHeap::from([(area(0), 0)]);
        let mut parts = Vec::new();
        while open.len() + parts.len() < count
            && let Some((_, at)) = open.pop()
        {
            if self.is_leaf(at) {
                parts.push(at);
            } else {
                for child in [at + 1, self.tree.0[at as usize].right] {
                    open.push((area(child), child));
                }
            }
        }
        parts.extend(open.into_iter().map(|(_, at)| at));
        // In the tree's order: what is near is written near.
        parts.sort_unstable();
        parts
    }

    /// Writes the wide nodes of the subtree `at`, siblings side by side, and the leaves.
    fn emit(
        &self,
        at: u32,
        nodes: &mut Vec<Node8>,
        leaf: &mut impl FnMut(&[u32]) -> Child,
    ) -> Tree {
        let root = Child::new(ChildKind::Node, nodes.len());
        let (mut deepest, mut children, mut items) = (0, Vec::new(), Vec::new());
        let bounds = self.tree.0[at as usize].bounds;
        let mut pending = vec![(at, nodes.len(), 1)];
        nodes.push(Node8::EMPTY);
        while let Some((at, target, depth)) = pending.pop() {
            deepest = deepest.max(depth);
            self.children(at, &mut children);
            for (lane, &child) in children.iter().enumerate() {
                let reference = if self.is_leaf(child) {
                    items.clear();
                    self.items(child, &mut items);
                    leaf(&items)
                } else {
                    pending.push((child, nodes.len(), depth + 1));
                    nodes.push(Node8::EMPTY);
                    Child::new(ChildKind::Node, nodes.len() - 1)
                };
                let bounds = &self.tree.0[child as usize].bounds;
                nodes[target].set(lane, bounds, reference);
            }
        }
        assert!(deepest <= MAX_DEPTH, "the traversal's stack is too small");
        Tree {
            root,
            bounds,
            depth: deepest,
        }
    }

    /// The items below a node, ascending.
    fn items(&self, at: u32, out: &mut Vec<u32>) {
        let first = at as usize;
        let count = self.tree.0[first].count as usize;
        let subtree = &self.tree.0[first..first + 2 * count - 1];
        out.extend(subtree.iter().filter(|n| n.right == 0).map(|n| n.item));
        out.sort_unstable();
    }
}

/// The least cost of two subtrees as at most `j` wide children, and how many the left one gets.
fn best_split(left: &[f64; WIDTH], right: &[f64; WIDTH], j: usize) -> (f64, u8) {
    let mut best = (f64::INFINITY, 1);
    for (k, split) in (1..j).zip(1..) {
        let cost = left[k] + right[j - k];
        if cost < best.0 {
            best = (cost, split);
        }
    }
    best
}
