//! Equality of means: streaming moments, the two-sided z-test, and the correction for many tests.

use statrs::function::erf::erfc;

/// Count, mean and variance of a stream of values, in one pass.
///
/// Source: Welford 1962; merging after Chan, Golub and `LeVeque` 1979.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moments {
    count: f64,
    mean: f64,
    sum_of_squares: f64,
}

impl Moments {
    /// Adds one value.
    pub fn push(&mut self, x: f64) {
        self.count += 1.0;
        let before = x - self.mean;
        self.mean += before / self.count;
        self.sum_of_squares += before * (x - self.mean);
    }

    /// Adds all values of `other`.
    #[must_use]
    pub fn merge(self, other: Self) -> Self {
        let count = self.count + other.count;
        if count == 0.0 {
            return self;
        }
        let apart = other.mean - self.mean;
        Self {
            count,
            mean: self.mean + apart * other.count / count,
            sum_of_squares: self.sum_of_squares
                + other.sum_of_squares
                + apart * apart * self.count * other.count / count,
        }
    }

    /// How many values were added.
    #[must_use]
    pub fn count(&self) -> f64 {
        self.count
    }

    /// Their mean; 0 where there are none.
    #[must_use]
    pub fn mean(&self) -> f64 {
        self.mean
    }

    /// Unbiased variance of one value; infinite for fewer than two.
    #[must_use]
    pub fn variance(&self) -> f64 {
        if self.count < 2.0 {
            f64::INFINITY
        } else {
            self.sum_of_squares / (self.count - 1.0)
        }
    }

    /// Variance of the mean.
    #[must_use]
    pub fn variance_of_mean(&self) -> f64 {
        self.variance() / self.count
    }

    /// Half width of the interval that holds the true mean with probability `1 - significance`.
    #[must_use]
    pub fn half_interval(&self, significance: f64) -> f64 {
        let deviations = std::f64::consts::SQRT_2 * statrs::function::erf::erfc_inv(significance);
        deviations * self.variance_of_mean().sqrt()
    }
}

impl Extend<f64> for Moments {
    fn extend<I: IntoIterator<Item = f64>>(&mut self, values: I) {
        for x in values {
            self.push(x);
        }
    }
}

/// Probability that a standard normal number lies at least `|z|` from 0.
///
/// NaN gives 0: a mean that is not a number equals nothing.
#[must_use]
pub fn two_sided_p(z: f64) -> f64 {
    if z.is_nan() {
        0.0
    } else {
        erfc(z.abs() / std::f64::consts::SQRT_2)
    }
}

/// p-value of two independent estimates being of the same mean.
///
/// ```text
/// z = (a - b) / sqrt(var_a + var_b)
/// ```
///
/// * `a`, `b`: mean and variance of that mean. Where both variances are 0 the means must be equal.
#[must_use]
pub fn equal_means(a: (f64, f64), b: (f64, f64)) -> f64 {
    let apart = a.0 - b.0;
    if apart == 0.0 {
        1.0
    } else {
        two_sided_p(apart / (a.1 + b.1).sqrt())
    }
}

/// The significance of each of `tests` independent tests that gives the whole family
/// `significance`.
///
/// ```text
/// 1 - (1 - significance)^(1/tests)
/// ```
///
/// Source: Sidak 1967.
#[must_use]
pub fn sidak(significance: f64, tests: usize) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "far below 2^53 tests")]
    let tests = tests.max(1) as f64;
    -f64::exp_m1(f64::ln_1p(-significance) / tests)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_of_a_short_list() {
        let mut m = Moments::default();
        m.extend([1.0, 2.0, 4.0, 9.0]);
        assert!((m.mean() - 4.0).abs() < 1e-15);
        assert!((m.variance() - 38.0 / 3.0).abs() < 1e-14);
        let (mut a, mut b) = (Moments::default(), Moments::default());
        a.extend([1.0]);
        b.extend([2.0, 4.0, 9.0]);
        let merged = a.merge(b);
        assert!((merged.variance() - m.variance()).abs() < 1e-14);
        assert_eq!(Moments::default().merge(m), m);
    }

    #[test]
    fn two_sided_p_has_the_tabulated_values() {
        // Abramowitz and Stegun, table 26.1.
        for (z, p) in [
            (0.0, 1.0),
            (1.0, 0.317_310_507_9),
            (1.959_964, 0.05),
            (5.0, 5.733e-7),
        ] {
            assert!(
                (two_sided_p(z) / p - 1.0).abs() < 1e-4,
                "{z}: {}",
                two_sided_p(z)
            );
        }
        assert_eq!(two_sided_p(f64::NAN), 0.0);
    }

    #[test]
    fn half_interval_is_two_sigma_at_five_per_cent() {
        let mut m = Moments::default();
        m.extend([-1.0, 1.0].into_iter().cycle().take(10_000));
        assert!((m.half_interval(0.05) * 100.0 - 1.96).abs() < 1e-3);
    }

    #[test]
    fn sidak_undoes_the_family() {
        let each = sidak(0.01, 1000);
        assert!((1.0 - (1.0 - each).powi(1000) - 0.01).abs() < 1e-12);
        assert!((sidak(0.01, 1) - 0.01).abs() < 1e-15);
    }

    #[test]
    fn equal_means_of_exact_numbers() {
        assert_eq!(equal_means((1.0, 0.0), (1.0, 0.0)), 1.0);
        assert_eq!(equal_means((1.0, 0.0), (1.1, 0.0)), 0.0);
        assert_eq!(equal_means((f64::NAN, 1.0), (1.1, 1.0)), 0.0);
    }
}
