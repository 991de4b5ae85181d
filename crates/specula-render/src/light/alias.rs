//! A fixed discrete distribution, sampled in constant time.

use crate::convert::{floor_index, id, narrow};
use crate::words::Words;

/// A discrete distribution.
///
/// Source: Vose 1991, A linear algorithm for generating random numbers with a given distribution.
#[derive(Clone, Debug, Default)]
pub(super) struct AliasTable {
    bins: Vec<Bin>,
}

#[derive(Clone, Copy, Debug)]
struct Bin {
    /// Share of the bin that is its own.
    own: f32,
    /// Whom the rest belongs to.
    alias: u32,
    /// Probability of this entry.
    probability: f32,
}

impl AliasTable {
    /// A distribution in proportion to `weights`: finite, not negative. All zero: empty.
    pub(super) fn new(weights: &[f64]) -> Self {
        let sum: f64 = weights.iter().sum();
        if !(sum > 0.0 && sum.is_finite()) {
            return Self::default();
        }
        let n = weights.len() as f64;
        let mut share: Vec<f64> = weights.iter().map(|w| w / sum * n).collect();
        let mut bins: Vec<Bin> = (0..weights.len())
            .map(|i| Bin {
                own: 1.0,
                alias: id(i),
                probability: narrow(weights[i] / sum),
            })
            .collect();
        let (mut small, mut large): (Vec<usize>, Vec<usize>) =
            (0..weights.len()).partition(|&i| share[i] < 1.0);
        while let (Some(s), Some(&l)) = (small.pop(), large.last()) {
            bins[s].own = narrow(share[s]);
            bins[s].alias = id(l);
            share[l] -= 1.0 - share[s];
            if share[l] < 1.0 {
                large.pop();
                small.push(l);
            }
        }
        // What is left is 1 up to rounding, except entries of weight zero, which must stay never
        // chosen; they were paired off above unless rounding emptied `large` first.
        let heaviest = (0..weights.len())
            .max_by(|&a, &b| weights[a].total_cmp(&weights[b]))
            .map_or(0, id);
        for (bin, w) in bins.iter_mut().zip(weights) {
            if *w == 0.0 && bin.own > 0.0 {
                bin.own = 0.0;
                bin.alias = heaviest;
            }
        }
        Self { bins }
    }

    /// An entry and its probability; `None` where the table is empty.
    ///
    /// * `u`: uniform in `[0, 1)`: `u n` chooses a bin, its fraction between the bin's two entries.
    #[inline]
    pub(super) fn sample(&self, u: f64) -> Option<(u32, f32)> {
        let n = self.bins.len();
        if n == 0 {
            return None;
        }
        let along = u * n as f64;
        let at = floor_index(narrow(along)).min(n - 1);
        let bin = &self.bins[at];
        let own = narrow(along - at as f64) < bin.own;
        let chosen = if own { id(at) } else { bin.alias };
        Some((chosen, self.bins[chosen as usize].probability))
    }

    /// Probability of an entry.
    #[inline]
    pub(super) fn probability(&self, index: u32) -> f32 {
        self.bins
            .get(index as usize)
            .map_or(0.0, |bin| bin.probability)
    }
}

impl AliasTable {
    /// Bins of three words for shaders: own share, alias, probability.
    pub(super) fn flatten(&self, to: &mut Words) {
        to.constant("LIGHT_ALIAS_COUNT", id(self.bins.len()));
        to.begin("LIGHT_ALIAS");
        for bin in &self.bins {
            to.number(bin.own);
            to.id(bin.alias);
            to.number(bin.probability);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_match_the_weights() {
        let weights = [3.0, 0.0, 1.0, 0.5, 10.0, 0.0, 0.25];
        let table = AliasTable::new(&weights);
        let n = 1 << 10;
        let mut counts = [0.0_f64; 7];
        for i in 0..n * n {
            let u = (f64::from(i) + 0.5) / f64::from(n * n);
            let (chosen, p) = table.sample(u).unwrap();
            assert_eq!(p, table.probability(chosen));
            counts[chosen as usize] += 1.0 / f64::from(n * n);
        }
        let sum: f64 = weights.iter().sum();
        for (c, w) in counts.iter().zip(weights) {
            assert!((c - w / sum).abs() < 2e-3, "{counts:?}");
        }
    }

    #[test]
    fn nothing_to_choose_from_is_nothing() {
        assert!(AliasTable::new(&[]).sample(0.5).is_none());
        assert!(AliasTable::new(&[0.0, 0.0]).sample(0.5).is_none());
    }
}
