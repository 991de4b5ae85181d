//! The choice among few lights, in proportion to the importance of each.
//!
//! A tree chooses by bounds on sets of lights, of which those nearest to its root say little. Where lights are few,
//! all their importances take fewer operations than those of a tree's nodes.

use super::node::LEAST_SHARE;
use crate::convert::narrow;

/// Most lights that are chosen among by the importance of each.
pub(super) const MOST_LIGHTS: usize = 16;

/// What a light is chosen in proportion to: its importance, off 0 unless that is 0; the same for all where nothing
/// arrives from any, so that the probabilities still add up to 1.
///
/// * `total`: sum of the importances.
#[inline(always)]
pub(super) fn weight(importance: f32, total: f32) -> f32 {
    let least = LEAST_SHARE * total;
    let weight = if importance > 0.0 {
        importance.max(least)
    } else {
        0.0
    };
    if total > 0.0 { weight } else { 1.0 }
}

/// The weights of few lights for one receiver.
pub(super) struct Weights {
    weights: [f32; MOST_LIGHTS],
    count: usize,
    /// The sum of the importances.
    pub(super) total: f32,
    /// The sum of the weights.
    sum: f64,
}

impl Weights {
    /// * `count`: of lights, at most [`MOST_LIGHTS`].
    /// * `importance`: of each.
    #[inline]
    pub(super) fn new(count: usize, importance: &impl Fn(usize) -> f32) -> Self {
        let mut weights = [0.0; MOST_LIGHTS];
        for (k, weight) in weights[..count].iter_mut().enumerate() {
            *weight = importance(k);
        }
        let total = weights[..count].iter().sum();
        let mut sum = 0.0;
        for each in &mut weights[..count] {
            *each = weight(*each, total);
            sum += f64::from(*each);
        }
        Self {
            weights,
            count,
            total,
            sum,
        }
    }

    /// The place of a light; `None` where there is none.
    ///
    /// * `u`: uniform in `[0, 1)`, with more digits than `f32` has: the least share is `1e-6`.
    #[inline]
    pub(super) fn sample(&self, u: f64) -> Option<usize> {
        // Less than the last of the sums below, which is the same sum.
        let target = u * self.sum;
        let mut below = 0.0;
        self.weights[..self.count].iter().position(|&weight| {
            below += f64::from(weight);
            target < below
        })
    }

    /// Probability of the light at a place.
    #[inline]
    pub(super) fn probability(&self, k: usize) -> f32 {
        self.weights[..self.count]
            .get(k)
            .map_or(0.0, |weight| weight / narrow(self.sum))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lights_are_chosen_as_often_as_their_probabilities_say() {
        let dim = [1e-20, 3.0, 0.0, 1e-3, 5.0, 0.0];
        for importances in [&dim[..], &[0.0; 5], &[7.0], &[1e37; MOST_LIGHTS], &[]] {
            let weights = Weights::new(importances.len(), &|k| importances[k]);
            let n: u32 = 1 << 22;
            let mut counts = [0_u32; MOST_LIGHTS];
            for i in 0..n {
                if let Some(k) = weights.sample((f64::from(i) + 0.5) / f64::from(n)) {
                    counts[k] += 1;
                }
            }
            let mut sum = 0.0;
            for (k, &importance) in importances.iter().enumerate() {
                let p = f64::from(weights.probability(k));
                let found = f64::from(counts[k]) / f64::from(n);
                assert!((found - p).abs() < 1.1 / f64::from(n), "{k}: {found} {p}");
                assert_eq!(p > 0.0, importance > 0.0 || weights.total == 0.0);
                assert!(p == 0.0 || p > 0.9e-6, "{k}: {p}");
                sum += p;
            }
            assert!((sum - 1.0).abs() < 1e-6 || importances.is_empty());
            assert_eq!(weights.probability(importances.len()), 0.0);
            // Numbers next to 1 do not lead beyond the last light.
            let last = weights.sample(1.0 - f64::EPSILON);
            let expected = importances.iter().rposition(|&x| x > 0.0);
            let expected = expected.or(importances.len().checked_sub(1));
            assert_eq!(last, expected);
        }
    }
}
