//! Binary trees to 8-wide ones at the least surface area cost.

use super::Bounds;
use super::binary::Binary;
use super::kernel::MAX_DEPTH;
use super::node::{Child, Kind, Node8, WIDTH};

/// Cost of testing a packet of triangles, relative to a node. Measured, see `benches/rays.rs`.
const PACKET_COST: f64 = 1.0;

/// A finished tree.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tree {
    /// Its root, always a node.
    pub(super) root: Child,
    pub(super) bounds: Bounds,
    /// Levels of nodes.
    pub(super) depth: usize,
}

/// Builds the tree over `items` into `nodes`. `leaf` turns items into a leaf: one item, or up to 8
/// of which `packable` is true. `items` is not empty.
pub(super) fn build(
    items: &[Bounds],
    packable: impl Fn(u32) -> bool,
    nodes: &mut Vec<Node8>,
    mut leaf: impl FnMut(&[u32]) -> Child,
) -> Tree {
    let optimised = Plan::new(Binary::optimised(items), &packable);
    if optimised.depth() <= MAX_DEPTH {
        optimised.emit(nodes, &mut leaf)
    } else {
        plant(Binary::balanced(items), packable, nodes, leaf)
    }
}

/// The same from a binary tree whose wide tree is shallow enough.
pub(super) fn plant(
    tree: Binary,
    packable: impl Fn(u32) -> bool,
    nodes: &mut Vec<Node8>,
    mut leaf: impl FnMut(&[u32]) -> Child,
) -> Tree {
    Plan::new(tree, &packable).emit(nodes, &mut leaf)
}

/// What becomes of each binary node.
///
/// `choices[n][j]` says how the subtree `n` is best cut into at most `j` wide children: into `k` of
/// its left part and `j - k` of its right one; 0 where `j - 1` children do as well. `choices[n][1]`:
/// 0 for a leaf, else the `k` of the node's own [`WIDTH`] children.
struct Plan {
    tree: Binary,
    choices: Vec<[u8; WIDTH]>,
}

impl Plan {
    /// Dynamic programming from the leaves up (Ylitie, Karras and Laine 2017, eqs. 1 to 5).
    fn new(tree: Binary, packable: &impl Fn(u32) -> bool) -> Self {
        let mut choices = vec![[0; WIDTH]; tree.0.len()];
        // Costs of the subtrees whose parent is still to come, with "all are packable". In reverse
        // preorder the left child is on top of the right one.
        let mut pending: Vec<([f64; WIDTH], bool)> = Vec::new();
        for (at, node) in tree.0.iter().enumerate().rev() {
            let area = node.bounds.half_area();
            if node.right == 0 {
                pending.push(([area * PACKET_COST; WIDTH], packable(node.item)));
                continue;
            }
            let (Some((left, left_packs)), Some((right, right_packs))) =
                (pending.pop(), pending.pop())
            else {
                unreachable!("children come before their parent in reverse preorder");
            };
            let packs = left_packs && right_packs;
            let (own, split) = best_split(&left, &right, WIDTH);
            let as_node = area + own;
            let as_leaf = area * PACKET_COST;
            let mut costs = [f64::INFINITY; WIDTH];
            if packs && node.count as usize <= WIDTH && as_leaf <= as_node {
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
            pending.push((costs, packs));
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

    /// Writes the wide nodes, siblings side by side, and the leaves.
    fn emit(&self, nodes: &mut Vec<Node8>, leaf: &mut impl FnMut(&[u32]) -> Child) -> Tree {
        let root = Child::new(Kind::Node, nodes.len());
        let (mut deepest, mut children, mut items) = (0, Vec::new(), Vec::new());
        let mut pending = vec![(0, nodes.len(), 1)];
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
                    Child::new(Kind::Node, nodes.len() - 1)
                };
                let bounds = &self.tree.0[child as usize].bounds;
                nodes[target].set(lane, bounds, reference);
            }
        }
        assert!(deepest <= MAX_DEPTH, "the traversal's stack is too small");
        Tree {
            root,
            bounds: self.tree.0[0].bounds,
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
