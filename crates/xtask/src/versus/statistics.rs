//! Distances between pictures, and the time that one renderer takes for another's error.

use specula_bsdf::Rgb;

/// Added to the squared reference in relMSE.
const REL_MSE_EPSILON: f64 = 0.01;

/// The share of the largest squared errors that the trimmed error leaves out.
pub(crate) const TRIMMED_SHARE: f64 = 0.001;

/// Mean squared errors over pixels and channels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Errors {
    /// `mean((t - r)^2)`.
    pub(crate) mse: f64,
    /// The same without the largest [`TRIMMED_SHARE`] of the squares.
    pub(crate) trimmed_mse: f64,
    /// `mean((t - r)^2 / (r^2 + 0.01))`.
    pub(crate) rel_mse: f64,
}

impl Errors {
    /// The errors of `test`, or `None` where the pictures differ in size or are empty.
    pub(crate) fn of(reference: &[Rgb<f32>], test: &[Rgb<f32>]) -> Option<Self> {
        Self::between(reference, reference, test)
    }

    /// What two halves of a reference, the mean of which is `whole`, tell of its own errors, or `None`
    /// as above: with `v` the variance of a half, that of their mean is `v / 2` and their mean squared
    /// difference `2 v`.
    pub(crate) fn of_mean(whole: &[Rgb<f32>], halves: [&[Rgb<f32>]; 2]) -> Option<Self> {
        let difference = Self::between(whole, halves[0], halves[1])?;
        Some(difference.map(|e| 0.25 * e))
    }

    /// Differences of `a` and `b`, relative ones over `base`.
    fn between(base: &[Rgb<f32>], a: &[Rgb<f32>], b: &[Rgb<f32>]) -> Option<Self> {
        if a.len() != b.len() || a.len() != base.len() || a.is_empty() {
            return None;
        }
        let mut squares = Vec::with_capacity(3 * a.len());
        let mut relative = 0.0;
        for ((base, a), b) in base.iter().zip(a).zip(b) {
            let [base, a, b] = [base, a, b].map(|c| c.to_array().map(f64::from));
            for c in 0..3 {
                let square = (a[c] - b[c]).powi(2);
                relative += square / (base[c] * base[c] + REL_MSE_EPSILON);
                squares.push(square);
            }
        }
        let count = squares.len() as f64;
        let mse = squares.iter().sum::<f64>() / count;
        Some(Self {
            mse,
            trimmed_mse: trimmed_mean(&mut squares),
            rel_mse: relative / count,
        })
    }

    /// The errors without those of the reference, which add to what is measured against it: picture and
    /// reference are independent.
    pub(crate) fn less(self, reference: Self) -> Self {
        Self {
            mse: (self.mse - reference.mse).max(0.0),
            trimmed_mse: (self.trimmed_mse - reference.trimmed_mse).max(0.0),
            rel_mse: (self.rel_mse - reference.rel_mse).max(0.0),
        }
    }

    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self {
            mse: f(self.mse),
            trimmed_mse: f(self.trimmed_mse),
            rel_mse: f(self.rel_mse),
        }
    }

    /// `[mse, trimmed_mse, rel_mse]`: the order of the tables.
    pub(crate) fn to_array(self) -> [f64; 3] {
        [self.mse, self.trimmed_mse, self.rel_mse]
    }
}

/// The mean of all but the largest [`TRIMMED_SHARE`], rounded up to a whole value.
fn trimmed_mean(values: &mut [f64]) -> f64 {
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a thousandth of a count"
    )]
    let dropped = (values.len() as f64 * TRIMMED_SHARE).ceil() as usize;
    let remaining = values.len() - dropped;
    if remaining == 0 {
        return 0.0;
    }
    values.select_nth_unstable_by(remaining, f64::total_cmp);
    values[..remaining].iter().sum::<f64>() / remaining as f64
}

/// The mean of a picture, all channels together.
pub(crate) fn mean(picture: &[Rgb<f32>]) -> f64 {
    let sum: f64 = picture
        .iter()
        .flat_map(|c| c.to_array())
        .map(f64::from)
        .sum();
    sum / (3 * picture.len().max(1)) as f64
}

/// The middle value, or the mean of the two in the middle; NaN of nothing.
pub(crate) fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    match sorted.len() {
        0 => f64::NAN,
        n if n % 2 == 1 => sorted[n / 2],
        n => 0.5 * (sorted[n / 2 - 1] + sorted[n / 2]),
    }
}

/// Our time over theirs to the same mean squared error, both errors falling as 1 over time.
///
/// ```text
/// t mse / (t' mse') = t (rmse / rmse')^2 / t'
/// ```
pub(crate) fn equal_error_ratio(specula: (f64, f64), theirs: (f64, f64)) -> f64 {
    specula.0 * specula.1 / (theirs.0 * theirs.1)
}

/// The exponent `a` of `rmse = c samples^-a` through two renders `(samples, mse)`: 1/2 for
/// independent samples.
pub(crate) fn rate(few: (f64, f64), many: (f64, f64)) -> f64 {
    0.5 * (few.1 / many.1).ln() / (many.0 / few.0).ln()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(values: &[f32]) -> Vec<Rgb<f32>> {
        values.iter().map(|&v| Rgb::splat(v)).collect()
    }

    #[test]
    fn errors_of_a_pair_by_hand() {
        let (r, t) = (grey(&[0.0, 1.0]), grey(&[0.1, 0.8]));
        let e = Errors::of(&r, &t).unwrap();
        assert!((e.mse - 0.025).abs() < 1e-8, "{e:?}");
        // One of the six values goes: one of the two larger.
        assert!((e.trimmed_mse - 0.022).abs() < 1e-8, "{e:?}");
        let relative = 0.5 * (0.01 / 0.01 + 0.04 / 1.01);
        assert!((e.rel_mse - relative).abs() < 1e-7, "{e:?}");
        assert_eq!(Errors::of(&r, &t[..1]), None);
        assert_eq!(Errors::of(&[], &[]), None);
    }

    #[test]
    fn one_firefly_rules_the_error_but_not_the_trimmed_one() {
        let reference = grey(&[1.0; 4000]);
        let mut test = grey(&[1.1; 4000]);
        test[17] = Rgb::splat(1000.0);
        let e = Errors::of(&reference, &test).unwrap();
        assert!(e.mse > 200.0, "{e:?}");
        assert!((e.trimmed_mse - 0.01).abs() < 1e-6, "{e:?}");
    }

    #[test]
    fn means_and_medians() {
        let colour = Rgb {
            r: 1.0,
            g: 2.0,
            b: 6.0,
        };
        assert_eq!(mean(&[colour; 4]), 3.0);
        assert_eq!(median(&[3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(&[4.0, 1.0, 2.0, 3.0]), 2.5);
        assert!(median(&[]).is_nan());
    }

    #[test]
    fn half_the_root_mean_square_in_equal_time_is_a_quarter_of_the_time() {
        assert_eq!(equal_error_ratio((3.0, 0.25), (3.0, 1.0)), 0.25);
        assert_eq!(equal_error_ratio((2.0, 1.0), (4.0, 1.0)), 0.5);
    }

    #[test]
    fn independent_samples_converge_at_one_half() {
        assert!((rate((16.0, 0.4), (64.0, 0.1)) - 0.5).abs() < 1e-12);
        assert!((rate((16.0, 0.64), (64.0, 0.04)) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn two_halves_tell_the_error_of_their_mean() {
        // Halves 0.2 apart, as where each is off by 0.1 one way or the other.
        let e = Errors::of_mean(&grey(&[1.0; 9]), [&grey(&[0.9; 9]), &grey(&[1.1; 9])]).unwrap();
        assert!((e.mse - 0.01).abs() < 1e-7, "{e:?}");
        assert!((e.rel_mse - 0.01 / 1.01).abs() < 1e-7, "{e:?}");
        let measured = Errors::of(&grey(&[1.0; 9]), &grey(&[1.2; 9])).unwrap();
        assert!((measured.less(e).mse - 0.03).abs() < 1e-6);
        assert_eq!(e.less(measured).mse, 0.0);
    }
}
