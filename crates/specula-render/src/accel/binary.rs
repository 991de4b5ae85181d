//! Binary trees over boxes: obvhs's, or a balanced one where that is too deep.

use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};

use super::Bounds;
use crate::convert::narrow;

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
    /// Items whose boxes are equal at the precision of Morton codes enter it once, and have a tree of their own
    /// below: both steps would try them against each other in quadratic time. So would they all be beside an item
    /// that is a million times as large.
    ///
    /// * `effort`: the share of nodes that reinsertion tries.
    pub(super) fn optimised(items: &[Bounds], effort: f32) -> Self {
        let scaled = scaled(items);
        let runs = Runs::new(&scaled);
        let boxes: Vec<Aabb> = runs
            .first
            .iter()
            .map(|&first| &scaled[first as usize])
            .map(|b| Aabb::new(b.min.into(), b.max.into()))
            .collect();
        drop(scaled);
        let indices = (0..u32::try_from(boxes.len()).expect("counts are checked")).collect();
        let mut tree = PlocBuilder::with_capacity(boxes.len()).build(
            // Rays through a tree by a distance of 24 take as many instructions.
            PlocSearchDistance::Low,
            &boxes,
            indices,
            SortPrecision::U64,
            2,
        );
        ReinsertionOptimizer::default().run(&mut tree, effort, None);
        Self::from_obvhs(&tree, items, &runs, effort)
    }

    fn from_obvhs(tree: &Bvh2, items: &[Bounds], runs: &Runs, effort: f32) -> Self {
        let mut nodes = Vec::with_capacity(2 * items.len());
        // The node in obvhs's tree, and Specula's whose right child it becomes.
        let mut pending = vec![(0, None)];
        let mut run = Vec::new();
        while let Some((at, right_of)) = pending.pop() {
            let index = u32::try_from(nodes.len()).expect("counts are checked");
            if let Some(parent) = right_of {
                let parent: &mut BinaryNode = &mut nodes[parent];
                parent.right = index;
            }
            let node = &tree.nodes[at];
            let first = node.first_index as usize;
            if node.is_leaf() {
                let first = tree.primitive_indices[first];
                match runs.single(first) {
                    Some(item) => nodes.push(BinaryNode::leaf(item, items)),
                    None => {
                        runs.items(first, &mut run);
                        let is_all = runs.first.len() == 1;
                        graft(items, &run, (!is_all).then_some(effort), &mut nodes);
                    }
                }
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

/// Boxes within [-1, 1], so that no area overflows or vanishes whatever the unit, and rounded to the precision of
/// Morton codes of 21 bits.
fn scaled(items: &[Bounds]) -> Vec<Bounds> {
    /// Numbers of `f64` beside it are multiples of `2^-22`, which `f32` holds exactly up to 1.
    const ROUNDING: f64 = 1.5 * (1_u64 << 30) as f64;
    let all = items.iter().fold(Bounds::EMPTY, |a, b| a.union(b));
    let size = (0..3)
        .map(|a| f64::from(all.max[a]) - f64::from(all.min[a]))
        .fold(f64::MIN_POSITIVE, f64::max);
    let scale = 1.0 / size;
    let centre: [f64; 3] = std::array::from_fn(|a| all.twice_centre(a));
    let scaled = |p: [f32; 3]| {
        std::array::from_fn(|a| {
            let x = (2.0 * f64::from(p[a]) - centre[a]) * scale;
            narrow((x + ROUNDING) - ROUNDING)
        })
    };
    let scaled = |b: &Bounds| Bounds {
        min: scaled(b.min),
        max: scaled(b.max),
    };
    items.iter().map(scaled).collect()
}

/// Appends the subtree over a run: a tree at the run's own scale with `effort`, or halves where the run is all
/// there is or its boxes are the same.
fn graft(items: &[Bounds], run: &[u32], effort: Option<f32>, nodes: &mut Vec<BinaryNode>) {
    let boxes: Vec<Bounds> = run.iter().map(|&item| items[item as usize]).collect();
    let (Some(effort), false) = (effort, boxes.iter().all(|b| *b == boxes[0])) else {
        return halve(items, run, nodes);
    };
    let offset = u32::try_from(nodes.len()).expect("counts are checked");
    let own = Binary::optimised(&boxes, effort);
    nodes.extend(own.0.into_iter().map(|node| BinaryNode {
        right: match node.right {
            0 => 0,
            right => right + offset,
        },
        item: run[node.item as usize],
        ..node
    }));
}

/// Items by equal boxes, in order of the first of each.
struct Runs {
    /// The first item of every run.
    first: Vec<u32>,
    /// The next item of the same run; [`LAST`] for its last.
    next: Vec<u32>,
}

/// No item.
const LAST: u32 = u32::MAX;

impl Runs {
    fn new(items: &[Bounds]) -> Self {
        let count = u32::try_from(items.len()).expect("counts are checked");
        // A table of the last items of runs, with open addressing.
        let places = (2 * items.len()).next_power_of_two();
        let mut table = vec![LAST; places];
        let mut first = Vec::with_capacity(items.len());
        let mut next = vec![LAST; items.len()];
        for item in 0..count {
            let bounds = &items[item as usize];
            let mut place = hash(bounds) & (places - 1);
            loop {
                match table[place] {
                    LAST => {
                        first.push(item);
                        break;
                    }
                    other if items[other as usize] == *bounds => {
                        next[other as usize] = item;
                        break;
                    }
                    _ => place = (place + 1) & (places - 1),
                }
            }
            table[place] = item;
        }
        Self { first, next }
    }

    /// The item of a run that has one only.
    fn single(&self, run: u32) -> Option<u32> {
        let item = self.first[run as usize];
        (self.next[item as usize] == LAST).then_some(item)
    }

    /// The items of a run.
    fn items(&self, run: u32, out: &mut Vec<u32>) {
        out.clear();
        let mut item = self.first[run as usize];
        while item != LAST {
            out.push(item);
            item = self.next[item as usize];
        }
    }
}

/// Mixes the bits of a box's coordinates; equal boxes have equal hashes.
fn hash(bounds: &Bounds) -> usize {
    let mut run = 0_u64;
    for x in bounds.min.iter().chain(&bounds.max) {
        // -0 equals 0.
        let bits = u64::from((x + 0.0).to_bits());
        run = (run.rotate_left(5) ^ bits).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    }
    usize::try_from(run >> 32).unwrap_or(0)
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A grid of boxes, `n^2`.
    fn grid(n: u32) -> Vec<Bounds> {
        let at = |i: u32| {
            let min = [(i % n) as f32, (i / n) as f32, ((i * 7) % 5) as f32 * 0.1];
            Bounds {
                min,
                max: min.map(|x| x + 1.5),
            }
        };
        (0..n * n).map(at).collect()
    }

    fn areas(tree: &Binary) -> f64 {
        tree.0.iter().map(|node| node.bounds.half_area()).sum()
    }

    fn items(tree: &Binary) -> Vec<u32> {
        let leaves = tree.0.iter().filter(|node| node.right == 0);
        let mut items: Vec<u32> = leaves.map(|node| node.item).collect();
        items.sort_unstable();
        items
    }

    /// The tree is as good, and takes as long, as without the large box.
    #[test]
    fn small_boxes_have_their_tree_beside_a_huge_one() {
        let mut boxes = grid(60);
        let alone = areas(&Binary::optimised(&boxes, 0.2));
        for size in [1e6, 1e9, 1e20] {
            boxes.push(Bounds {
                min: [0.0; 3],
                max: [size; 3],
            });
            let tree = Binary::optimised(&boxes, 0.2);
            assert_eq!(tree.0.len(), 2 * boxes.len() - 1);
            assert!(items(&tree).into_iter().eq(0..3601));
            let huge = boxes.pop().map_or(0.0, |b| b.half_area());
            let small = tree.0.iter().map(|node| node.bounds.half_area());
            let small: f64 = small.filter(|area| *area < 0.5 * huge).sum();
            assert!(small < 1.1 * alone, "{size}: {small} beside {alone}");
        }
    }

    /// Boxes that differ by less than the rounding, and equal ones, end in halves.
    #[test]
    fn nearly_equal_boxes_end() {
        let boxes: Vec<Bounds> = (0..500)
            .map(|i: u16| Bounds {
                min: [0.0; 3],
                max: [1.0 + f32::from(i / 2) * f32::EPSILON, 1.0, 0.0],
            })
            .collect();
        let tree = Binary::optimised(&boxes, 0.2);
        assert!(items(&tree).into_iter().eq(0..500));
    }
}
