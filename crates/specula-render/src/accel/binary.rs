//! Binary trees over boxes: obvhs's, or a balanced one where that is too deep.

use std::collections::HashMap;

use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};

use super::Bounds;

/// A node. Its left child, if any, is the next node.
#[derive(Clone, Copy, Debug)]
pub(super) struct BinaryNode {
    pub(super) bounds: Bounds,
    /// Index of the right child; 0 for leaves.
    pub(super) right: u32,
    /// The item of a leaf; the first leaf's for others.
    pub(super) item: u32,
    /// How many leaves there are below.
    pub(super) count: u32,
}

impl BinaryNode {
    fn leaf(item: u32, items: &[Bounds]) -> Self {
        Self {
            bounds: items[item as usize],
            right: 0,
            item,
            count: 1,
        }
    }
}

/// A binary tree in preorder, one item per leaf. Never empty.
#[derive(Clone, Debug)]
pub(super) struct Binary(pub(super) Vec<BinaryNode>);

impl Binary {
    /// The best tree that obvhs builds: PLOC (Meister and Bittner 2018), then reinsertion (Meister
    /// and Bittner 2018, "Parallel Reinsertion"). `items` is not empty.
    ///
    /// Items with equal boxes enter it once and are split in halves below: reinsertion would try
    /// them against each other in quadratic time.
    pub(super) fn optimised(items: &[Bounds]) -> Self {
        let runs = equal_runs(items);
        let all = items.iter().fold(Bounds::EMPTY, |a, b| a.union(b));
        // Within [-1, 1], so that no area overflows or vanishes, whatever the unit.
        let size = (0..3)
            .map(|a| f64::from(all.max[a]) - f64::from(all.min[a]))
            .fold(f64::MIN_POSITIVE, f64::max);
        let scaled = |p: [f32; 3]| {
            let at: [f64; 3] =
                std::array::from_fn(|a| (2.0 * f64::from(p[a]) - all.twice_centre(a)) / size);
            glam::DVec3::from_array(at).as_vec3a()
        };
        let boxes: Vec<Aabb> = runs
            .iter()
            .map(|run| &items[run[0] as usize])
            .map(|b| Aabb::new(scaled(b.min), scaled(b.max)))
            .collect();
        let indices = (0..u32::try_from(boxes.len()).expect("counts are checked")).collect();
        let mut tree = PlocBuilder::with_capacity(boxes.len()).build(
            PlocSearchDistance::High,
            &boxes,
            indices,
            SortPrecision::U64,
            2,
        );
        ReinsertionOptimizer::default().run(&mut tree, reinsertion_ratio(boxes.len()), None);
        Self::from_obvhs(&tree, items, &runs)
    }

    fn from_obvhs(tree: &Bvh2, items: &[Bounds], runs: &[Vec<u32>]) -> Self {
        let mut nodes = Vec::with_capacity(2 * items.len());
        // The node in obvhs's tree, and ours whose right child it becomes.
        let mut pending = vec![(0, None)];
        while let Some((at, right_of)) = pending.pop() {
            let index = u32::try_from(nodes.len()).expect("counts are checked");
            if let Some(parent) = right_of {
                let parent: &mut BinaryNode = &mut nodes[parent];
                parent.right = index;
            }
            let node = &tree.nodes[at];
            let first = node.first_index as usize;
            if node.is_leaf() {
                let run = &runs[tree.primitive_indices[first] as usize];
                halve(items, run, &mut nodes);
            } else {
                pending.push((first + 1, Some(nodes.len())));
                pending.push((first, None));
                nodes.push(BinaryNode::leaf(0, items));
            }
        }
        Self(nodes).completed()
    }

    /// Median splits along the axis in which the centres spread most: `ceil(log2 n)` levels.
    pub(super) fn balanced(items: &[Bounds]) -> Self {
        fn split(items: &[Bounds], order: &mut [u32], nodes: &mut Vec<BinaryNode>) {
            let at = nodes.len();
            nodes.push(BinaryNode::leaf(order[0], items));
            if order.len() == 1 {
                return;
            }
            let spread = |axis: usize| {
                let centres = order.iter().map(|&i| items[i as usize].twice_centre(axis));
                let (lo, hi) = centres.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), c| {
                    (lo.min(c), hi.max(c))
                });
                hi - lo
            };
            let axis = (0..3)
                .max_by(|&a, &b| spread(a).total_cmp(&spread(b)))
                .unwrap_or(0);
            let middle = order.len() / 2;
            order.select_nth_unstable_by(middle, |&a, &b| {
                let [ca, cb] = [a, b].map(|i| items[i as usize].twice_centre(axis));
                ca.total_cmp(&cb).then(a.cmp(&b))
            });
            let (left, right) = order.split_at_mut(middle);
            split(items, left, nodes);
            nodes[at].right = u32::try_from(nodes.len()).expect("counts are checked");
            split(items, right, nodes);
        }
        let mut order: Vec<u32> =
            (0..u32::try_from(items.len()).expect("counts are checked")).collect();
        let mut nodes = Vec::with_capacity(2 * items.len());
        split(items, &mut order, &mut nodes);
        Self(nodes).completed()
    }

    /// Fills in the boxes and counts of the inner nodes, from the leaves up.
    fn completed(mut self) -> Self {
        for at in (0..self.0.len()).rev() {
            let right = self.0[at].right as usize;
            if right != 0 {
                let (l, r) = (self.0[at + 1], self.0[right]);
                let node = &mut self.0[at];
                node.bounds = l.bounds.union(&r.bounds);
                node.count = l.count + r.count;
                node.item = l.item;
            }
        }
        self
    }
}

/// The items by equal boxes, in order of the first of each.
fn equal_runs(items: &[Bounds]) -> Vec<Vec<u32>> {
    let mut runs: Vec<Vec<u32>> = Vec::with_capacity(items.len());
    let mut known = HashMap::with_capacity(items.len());
    for (item, bounds) in (0..).zip(items) {
        let key = [bounds.min, bounds.max].map(|p| p.map(f32::to_bits));
        let run = *known.entry(key).or_insert(runs.len());
        if run == runs.len() {
            runs.push(vec![item]);
        } else {
            runs[run].push(item);
        }
    }
    runs
}

/// Appends the subtree that halves `run` down to single items.
fn halve(items: &[Bounds], run: &[u32], nodes: &mut Vec<BinaryNode>) {
    let at = nodes.len();
    nodes.push(BinaryNode::leaf(run[0], items));
    if run.len() > 1 {
        let (left, right) = run.split_at(run.len() / 2);
        halve(items, left, nodes);
        nodes[at].right = u32::try_from(nodes.len()).expect("counts are checked");
        halve(items, right, nodes);
    }
}

/// Which part of the nodes reinsertion tries: less for large scenes, where it takes long. (From 0.05
/// to 1 the traversal's speed differed by less than the measurements' noise.)
fn reinsertion_ratio(items: usize) -> f32 {
    if items > 1_000_000 { 0.05 } else { 0.2 }
}
