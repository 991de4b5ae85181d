//! The tree over lights, built from above.
//!
//! Sets are split where the surface-area orientation heuristic is least, over buckets of their
//! centres. A subtree of `n` lights takes `2 n - 1` nodes in a row, the root first, then the left
//! child's: the places of all nodes are known beforehand, and children are built in parallel with
//! the same result for any number of threads.

use specula_bsdf::Vec3;

use super::cone::EmissionCone;
use super::node::Node;
use crate::accel::Bounds;
use crate::convert::{floor_index, id, narrow};

/// Buckets per axis.
const BUCKETS: usize = 12;
/// Larger sets are only split across their longest side, which their cost prefers anyway.
const ALL_AXES_UP_TO: usize = 1024;
/// From here on sets are halved, which bounds the depth by twice this and one less.
const HALVE_FROM: u32 = 31;
/// Larger sets are split in parallel.
const PARALLEL_FROM: usize = 4096;

/// A light in the scene.
#[derive(Clone, Copy, Debug)]
pub(super) struct Emitter {
    pub(super) light: u32,
    pub(super) bounds: Bounds,
    pub(super) cone: EmissionCone,
    /// Largest radiant intensity over all directions: above 0.
    pub(super) intensity: f64,
}

/// What is summed over a set of lights.
#[derive(Clone, Copy)]
struct Set {
    bounds: Bounds,
    cone: Option<EmissionCone>,
    intensity: f64,
}

/// The nodes of a tree over `emitters`.
pub(super) fn build(emitters: &mut [Emitter]) -> Vec<Node> {
    let empty = Node::new(Vec3::ZERO, 0.0, &EmissionCone::SPHERE, 0.0, (true, 0));
    let mut nodes = vec![empty; (2 * emitters.len()).saturating_sub(1)];
    if !emitters.is_empty() {
        fill(emitters, &mut nodes, 0);
    }
    nodes
}

/// Builds the subtree over `emitters` into `nodes`, exactly as many as it takes.
fn fill(emitters: &mut [Emitter], nodes: &mut [Node], depth: u32) -> Set {
    if let [e] = emitters {
        let set = Set::EMPTY.with(e);
        nodes[0] = set.node((true, e.light));
        return set;
    }
    let middle = split(emitters, depth);
    let (left, right) = emitters.split_at_mut(middle);
    let parallel = left.len() + right.len() > PARALLEL_FROM;
    let (root, below) = nodes.split_at_mut(1);
    let (left_nodes, right_nodes) = below.split_at_mut(2 * middle - 1);
    let (a, b) = if parallel {
        rayon::join(
            || fill(left, left_nodes, depth + 1),
            || fill(right, right_nodes, depth + 1),
        )
    } else {
        (
            fill(left, left_nodes, depth + 1),
            fill(right, right_nodes, depth + 1),
        )
    };
    let set = a.union(&b);
    root[0] = set.node((false, id(2 * middle)));
    set
}

/// Reorders a set of at least two into two parts; returns the size of the first, which neither
/// empties nor takes all.
fn split(emitters: &mut [Emitter], depth: u32) -> usize {
    let half = emitters.len() / 2;
    let mut low = [f64::INFINITY; 3];
    let mut high = [f64::NEG_INFINITY; 3];
    for e in emitters.iter() {
        for axis in 0..3 {
            let c = twice_centre(&e.bounds, axis);
            low[axis] = low[axis].min(c);
            high[axis] = high[axis].max(c);
        }
    }
    let extent = [0, 1, 2].map(|axis| high[axis] - low[axis]);
    let longest = (0..3)
        .max_by(|&a, &b| extent[a].total_cmp(&extent[b]))
        .unwrap_or(0);
    if extent[longest] <= 0.0 || emitters.len() == 2 {
        return half;
    }
    let bucket = |e: &Emitter, axis: usize| {
        let at = (twice_centre(&e.bounds, axis) - low[axis]) / extent[axis];
        floor_index(narrow(at * BUCKETS as f64)).min(BUCKETS - 1)
    };
    let mut best: Option<(f64, usize, usize)> = None;
    for axis in 0..3 {
        let skipped = axis != longest && emitters.len() > ALL_AXES_UP_TO;
        if skipped || extent[axis] <= 0.0 || depth >= HALVE_FROM {
            continue;
        }
        let mut buckets = [Set::EMPTY; BUCKETS];
        for e in emitters.iter() {
            let b = &mut buckets[bucket(e, axis)];
            *b = b.with(e);
        }
        let regularity = extent[longest] / extent[axis];
        for (at, cost) in costs(&buckets).into_iter().enumerate() {
            let cost = cost * regularity;
            if cost.is_finite() && best.is_none_or(|(least, ..)| cost < least) {
                best = Some((cost, axis, at));
            }
        }
    }
    match best {
        Some((_, axis, at)) => partition(emitters, |e| bucket(e, axis) <= at),
        None => {
            emitters.select_nth_unstable_by(half, |a, b| {
                let [a, b] = [a, b].map(|e| (twice_centre(&e.bounds, longest), e.light));
                a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))
            });
            half
        }
    }
}

/// Cost of the split after every bucket but the last; infinite where one side is empty.
fn costs(buckets: &[Set; BUCKETS]) -> [f64; BUCKETS - 1] {
    let mut costs = [0.0; BUCKETS - 1];
    let (mut below, mut above) = (Set::EMPTY, Set::EMPTY);
    for i in 0..BUCKETS - 1 {
        below = below.union(&buckets[i]);
        above = above.union(&buckets[BUCKETS - 1 - i]);
        costs[i] += below.cost();
        costs[BUCKETS - 2 - i] += above.cost();
    }
    costs
}

/// Moves what is `first` to the front; returns how many they are.
fn partition(emitters: &mut [Emitter], first: impl Fn(&Emitter) -> bool) -> usize {
    let mut count = 0;
    for i in 0..emitters.len() {
        if first(&emitters[i]) {
            emitters.swap(i, count);
            count += 1;
        }
    }
    count
}

impl Set {
    const EMPTY: Self = Self {
        bounds: Bounds::EMPTY,
        cone: None,
        intensity: 0.0,
    };

    fn with(&self, e: &Emitter) -> Self {
        self.union(&Self {
            bounds: e.bounds,
            cone: Some(e.cone),
            intensity: e.intensity,
        })
    }

    fn union(&self, other: &Self) -> Self {
        Self {
            bounds: self.bounds.union(&other.bounds),
            cone: match (self.cone, other.cone) {
                (Some(a), Some(b)) => Some(a.union(&b)),
                (a, b) => a.or(b),
            },
            intensity: self.intensity + other.intensity,
        }
    }

    /// Intensity times extent times solid angle; infinite of the empty set.
    ///
    /// Source: Conty Estevez and Kulla 2018, eq. 2. Departure: the diagonal squared is added to the
    /// area, which vanishes for lights along a line.
    fn cost(&self) -> f64 {
        let Some(cone) = self.cone else {
            return f64::INFINITY;
        };
        let [x, y, z] = self.sides();
        let area = 2.0 * (x * y + y * z + z * x);
        self.intensity * cone.measure() * (area + x * x + y * y + z * z)
    }

    fn sides(&self) -> [f64; 3] {
        let b = &self.bounds;
        [0, 1, 2].map(|a| f64::from(b.max[a]) - f64::from(b.min[a]))
    }

    fn node(&self, place: (bool, u32)) -> Node {
        let cone = self.cone.unwrap_or(EmissionCone::SPHERE);
        let centre = [0, 1, 2].map(|axis| narrow(0.5 * twice_centre(&self.bounds, axis)));
        // The centre is rounded: the sphere grows by what that can move it.
        let largest = centre.iter().fold(0.0_f32, |m, c| m.max(c.abs()));
        let half_diagonal = 0.5 * self.sides().iter().map(|s| s * s).sum::<f64>().sqrt();
        let radius = narrow(half_diagonal * (1.0 + 1e-6)) + largest * f32::EPSILON;
        Node::new(Vec3::from(centre), radius, &cone, self.intensity, place)
    }
}

fn twice_centre(bounds: &Bounds, axis: usize) -> f64 {
    f64::from(bounds.min[axis]) + f64::from(bounds.max[axis])
}
