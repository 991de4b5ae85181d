//! Large sets of boxes, split into chunks that are built on their own: in parallel, and with little
//! memory at a time.
//!
//! Chunks are a function of the boxes alone: the tree is the same for any number of threads.

use bytemuck::Zeroable;

use super::Bounds;
use crate::sampler::hash;

/// Sets up to this size are one chunk.
pub(super) const CHUNK: usize = 1 << 16;
/// How many items a split is decided by.
const SAMPLE: usize = 1 << 14;
/// Buckets of the surface area heuristic.
const BUCKETS: usize = 32;
/// Each part of a split has at least this share of the set: bounds the number of chunks.
const LEAST_SHARE: usize = 8;

/// The box of one primitive, or of two neighbours in the input.
#[derive(Clone, Copy, Debug, Zeroable)]
pub(super) struct Item {
    pub(super) bounds: Bounds,
    /// The first one's place in the input.
    pub(super) primitive: u32,
    /// How many there are; 0 marks what is no item. Of a curve, which part it is.
    pub(super) count: u32,
}

/// Reorders `items` and cuts them into chunks, neighbours together.
pub(super) fn split(items: &mut [Item]) -> Vec<&mut [Item]> {
    if items.len() <= CHUNK {
        return vec![items];
    }
    let middle = partition(items);
    let (left, right) = items.split_at_mut(middle);
    let (mut chunks, others) = rayon::join(|| split(left), || split(right));
    chunks.extend(others);
    chunks
}

/// Splits a set in two where the surface area heuristic is least for a sample of it, or in the middle.
fn partition(items: &mut [Item]) -> usize {
    let sample = sample(items);
    let mut low = [f64::INFINITY; 3];
    let mut high = [f64::NEG_INFINITY; 3];
    for item in &sample {
        for axis in 0..3 {
            let c = item.bounds.twice_centre(axis);
            low[axis] = low[axis].min(c);
            high[axis] = high[axis].max(c);
        }
    }
    let extent: [f64; 3] = std::array::from_fn(|axis| high[axis] - low[axis]);
    // Items beyond the ends of the sample are in the first and the last bucket.
    let bucket = |item: &Item, axis: usize| {
        let along = (item.bounds.twice_centre(axis) - low[axis]) / extent[axis];
        let along = crate::convert::narrow(along * BUCKETS as f64);
        crate::convert::floor_index(along).min(BUCKETS - 1)
    };
    let mut best: Option<(f64, usize, usize)> = None;
    for axis in (0..3).filter(|&axis| extent[axis] > 0.0) {
        let mut buckets = [(Bounds::EMPTY, 0_usize); BUCKETS];
        for item in &sample {
            let (bounds, count) = &mut buckets[bucket(item, axis)];
            *bounds = bounds.union(&item.bounds);
            *count += 1;
        }
        if let Some((cost, cut)) = best_cut(&buckets, sample.len())
            && best.is_none_or(|(least, ..)| cost < least)
        {
            best = Some((cost, axis, cut));
        }
    }
    if let Some((_, axis, cut)) = best {
        let middle = front(items, |item| bucket(item, axis) < cut);
        // The sample may have been of another mind than the set.
        if middle.min(items.len() - middle) >= items.len() / LEAST_SHARE {
            return middle;
        }
    }
    let half = items.len() / 2;
    let longest = (0..3)
        .max_by(|&a, &b| extent[a].total_cmp(&extent[b]))
        .unwrap_or(0);
    items.select_nth_unstable_by(half, |a, b| {
        let [ca, cb] = [a, b].map(|i| i.bounds.twice_centre(longest));
        ca.total_cmp(&cb).then(a.primitive.cmp(&b.primitive))
    });
    half
}

/// One item of each of [`SAMPLE`] stretches, at random: items may come in turns.
fn sample(items: &[Item]) -> Vec<Item> {
    let stretch = items.len() / SAMPLE;
    if stretch < 2 {
        return items.to_vec();
    }
    let within = u32::try_from(stretch).unwrap_or(u32::MAX);
    let at = |(i, first): (u32, usize)| items[first + (hash(i) % within) as usize];
    let firsts = (0..items.len() + 1 - stretch).step_by(stretch);
    (0..).zip(firsts).map(at).collect()
}

/// The least cost and the first bucket of the second part; `None` where every cut leaves one part
/// too small.
fn best_cut(buckets: &[(Bounds, usize); BUCKETS], count: usize) -> Option<(f64, usize)> {
    let cost = |bounds: &Bounds, n: usize| bounds.half_area() * n as f64;
    let mut above = [0.0; BUCKETS];
    let (mut bounds, mut n) = (Bounds::EMPTY, 0);
    for i in (1..BUCKETS).rev() {
        bounds = bounds.union(&buckets[i].0);
        n += buckets[i].1;
        above[i] = cost(&bounds, n);
    }
    let least = count / LEAST_SHARE;
    let (mut bounds, mut n) = (Bounds::EMPTY, 0);
    let mut best = None;
    for cut in 1..BUCKETS {
        bounds = bounds.union(&buckets[cut - 1].0);
        n += buckets[cut - 1].1;
        if n < least.max(1) || count - n < least.max(1) {
            continue;
        }
        let total = cost(&bounds, n) + above[cut];
        if total.is_finite() && best.is_none_or(|(lowest, _)| total < lowest) {
            best = Some((total, cut));
        }
    }
    best
}

/// Moves what is `first` to the front; returns how many they are.
fn front(items: &mut [Item], first: impl Fn(&Item) -> bool) -> usize {
    let mut count = 0;
    for i in 0..items.len() {
        if first(&items[i]) {
            items.swap(i, count);
            count += 1;
        }
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;

    fn boxes(count: u32, at: impl Fn(u32) -> [f32; 3]) -> Vec<Item> {
        let item = |primitive| {
            let min = at(primitive);
            Item {
                bounds: Bounds {
                    min,
                    max: min.map(|x| x + 0.01),
                },
                primitive,
                count: 1,
            }
        };
        (0..count).map(item).collect()
    }

    #[test]
    fn chunks_hold_every_item_once_and_are_neither_large_nor_tiny() {
        let n = 600_000;
        let hash = |i: u32| (crate::sampler::hash(i) >> 8) as f32 / 16_777_216.0;
        let cases: [Vec<Item>; 3] = [
            boxes(n, |i| [hash(3 * i), hash(3 * i + 1), hash(3 * i + 2)]),
            // Coordinates that halve, and all at one place.
            boxes(n, |i| [0.5_f32.powi((i % 100).cast_signed()), 0.0, 0.0]),
            boxes(n, |_| [1.0; 3]),
        ];
        for mut items in cases {
            let mut seen = vec![false; n as usize];
            for chunk in split(&mut items) {
                assert!(chunk.len() <= CHUNK && chunk.len() >= CHUNK / LEAST_SHARE);
                for item in chunk {
                    let place = &mut seen[item.primitive as usize];
                    assert!(!*place);
                    *place = true;
                }
            }
            assert!(seen.iter().all(|&s| s));
        }
    }

    /// Two clouds far apart do not share a chunk.
    #[test]
    fn clusters_stay_apart() {
        let mut items = boxes(200_000, |i| {
            let x = (i / 2) as f32 * 1e-5;
            [if i % 2 == 0 { x } else { x + 1000.0 }, 0.0, 0.0]
        });
        for chunk in split(&mut items) {
            let first = chunk[0].primitive % 2;
            assert!(chunk.iter().all(|item| item.primitive % 2 == first));
        }
    }
}
