//! Intervals of confidence: of a mean of repetitions, of a ratio of efficiencies.

use specula_stat::z_test::{Moments, sidak};
use statrs::distribution::{ContinuousCDF, StudentsT};

/// Chance that some interval of a comparison misses its truth: all of them hold together at 95 %.
const SIGNIFICANCE: f64 = 0.05;

/// A figure with its interval of confidence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Interval {
    pub(super) middle: f64,
    pub(super) low: f64,
    pub(super) high: f64,
}

/// A figure, its standard error, and degrees of freedom of that.
#[derive(Clone, Copy, Debug)]
pub(super) struct Estimate {
    pub(super) value: f64,
    pub(super) error: f64,
    pub(super) freedom: f64,
}

impl Estimate {
    /// The mean of repetitions; its error is infinite where there are fewer than two.
    pub(super) fn of_mean(repetitions: impl IntoIterator<Item = f64>) -> Self {
        let mut moments = Moments::default();
        repetitions.into_iter().for_each(|x| moments.push(x));
        Self {
            value: moments.mean(),
            error: (moments.variance() / moments.count().max(1.0)).sqrt(),
            freedom: (moments.count() - 1.0).max(1.0),
        }
    }

    /// The sum with an independent one.
    ///
    /// Source: Welch 1947, for the degrees of freedom.
    pub(super) fn plus(self, other: Self) -> Self {
        let error = self.error.hypot(other.error);
        let part = |e: Self| (e.error / error).powi(4) / e.freedom;
        let parts = part(self) + part(other);
        Self {
            value: self.value + other.value,
            error,
            freedom: if parts > 0.0 { 1.0 / parts } else { 1.0 },
        }
    }

    /// With so many such intervals, each is wide enough for all to hold at 95 %.
    pub(super) fn interval(self, intervals: usize) -> Interval {
        let significance = sidak(SIGNIFICANCE, intervals.max(1));
        let half = if self.error == 0.0 {
            0.0
        } else {
            quantile(1.0 - 0.5 * significance, self.freedom) * self.error
        };
        if self.value.is_finite() && half.is_finite() {
            Interval {
                middle: self.value,
                low: self.value - half,
                high: self.value + half,
            }
        } else {
            Interval::unknown(self.value)
        }
    }
}

/// Of Student's t.
fn quantile(share: f64, freedom: f64) -> f64 {
    StudentsT::new(0.0, 1.0, freedom.clamp(1.0, 1e6))
        .map_or(f64::INFINITY, |t| t.inverse_cdf(share))
}

impl Interval {
    /// Of what is only estimated, or not even that (NaN).
    pub(super) fn unknown(middle: f64) -> Self {
        Self {
            middle,
            low: f64::NEG_INFINITY,
            high: f64::INFINITY,
        }
    }

    /// Of the number whose logarithm it is of.
    pub(super) fn exp(self) -> Self {
        Self {
            middle: self.middle.exp(),
            low: self.low.exp(),
            high: self.high.exp(),
        }
    }

    /// Of one over the number.
    pub(super) fn inverse(self) -> Self {
        Self {
            middle: 1.0 / self.middle,
            low: 1.0 / self.high,
            high: 1.0 / self.low,
        }
    }

    /// Whether it is known from both sides.
    pub(super) fn is_known(self) -> bool {
        self.middle.is_finite() && self.low.is_finite() && self.high.is_finite()
    }

    /// `0.86 [0.84, 0.88]`, with so many places.
    pub(super) fn text(self, places: usize) -> String {
        if self.is_known() {
            format!(
                "{:.places$} [{:.places$}, {:.places$}]",
                self.middle, self.low, self.high
            )
        } else if self.middle.is_finite() {
            format!("{:.places$}, uncertain without end", self.middle)
        } else {
            "unknown".to_owned()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use specula_stat::Rng;

    #[test]
    fn quantiles_are_students() {
        // Student 1908; tables of any textbook.
        for (share, freedom, expected) in [
            (0.975, 1.0, 12.706),
            (0.975, 7.0, 2.365),
            (0.995, 31.0, 2.744),
        ] {
            let found = quantile(share, freedom);
            assert!((found - expected).abs() < 1e-3, "{found} for {expected}");
        }
        assert!((quantile(0.975, f64::INFINITY) - 1.96).abs() < 1e-3);
    }

    /// Of sums of two means of normally distributed values with other variances and counts.
    #[test]
    fn intervals_hold_as_often_as_they_say() {
        let mut rng = Rng::new(5);
        let mut normal = |deviation: f64| {
            let sum: f64 = (0..12).map(|_| rng.uniform()).sum();
            deviation * (sum - 6.0)
        };
        let (mut missed, all) = (0, 4000);
        for _ in 0..all {
            let a: Vec<f64> = (0..8).map(|_| 1.0 + normal(1.0)).collect();
            let b: Vec<f64> = (0..32).map(|_| 2.0 + normal(0.5)).collect();
            let found = Estimate::of_mean(a).plus(Estimate::of_mean(b)).interval(1);
            missed += usize::from(found.low > 3.0 || found.high < 3.0);
        }
        // 200 are expected, with a deviation of 14.
        assert!((150..250).contains(&missed), "{missed} of {all}");
    }

    #[test]
    fn more_intervals_are_wider() {
        let estimate = Estimate {
            value: 1.0,
            error: 0.1,
            freedom: 20.0,
        };
        let width = |n| estimate.interval(n).high - estimate.interval(n).low;
        assert!(width(6) > 1.2 * width(1), "{} {}", width(6), width(1));
    }

    #[test]
    fn what_is_not_known_has_no_bounds() {
        for repetitions in [&[][..], &[1.0], &[1.0, f64::NAN]] {
            let found = Estimate::of_mean(repetitions.iter().copied()).interval(1);
            assert!(
                found.low == f64::NEG_INFINITY && found.high == f64::INFINITY,
                "{found:?}"
            );
            assert!(!found.is_known());
        }
        let same = Estimate::of_mean([0.0, 0.0]).interval(3);
        assert_eq!(
            same,
            Interval {
                middle: 0.0,
                low: 0.0,
                high: 0.0
            }
        );
        assert_eq!(same.exp().text(2), "1.00 [1.00, 1.00]");
    }
}
