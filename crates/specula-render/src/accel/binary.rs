//! Binary trees over boxes: obvhs's, or a balanced one where that is too deep.

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
    ///
    /// * `effort`: the share of nodes that reinsertion tries. (From 0.05 to 1 the traversal's speed
    ///   differed by less than the measurements' noise.)
    pub(super) fn optimised(items: &[Bounds], effort: f32) -> Self {
        let runs = Runs::new(items);
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
            .first
            .iter()
            .map(|&first| &items[first as usize])
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
        ReinsertionOptimizer::default().run(&mut tree, effort, None);
        Self::from_obvhs(&tree, items, &runs)
    }

    fn from_obvhs(tree: &Bvh2, items: &[Bounds], runs: &Runs) -> Self {
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
                runs.items(tree.primitive_indices[first], &mut run);
                halve(items, &run, &mut nodes);
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
