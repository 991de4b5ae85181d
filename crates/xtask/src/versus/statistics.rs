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
        if reference.len() != test.len() || reference.is_empty() {
            return None;
        }
        let pairs = reference.iter().zip(test).flat_map(|(r, t)| {
            let (r, t) = (r.to_array(), t.to_array());
            [0, 1, 2].map(|c| (f64::from(r[c]), f64::from(t[c])))
        });
        let mut squares = Vec::with_capacity(3 * reference.len());
        let mut relative = 0.0;
        for (r, t) in pairs {
            let square = (t - r).powi(2);
            relative += square / (r * r + REL_MSE_EPSILON);
            squares.push(square);
        }
        let count = squares.len() as f64;
        let mse = squares.iter().sum::<f64>() / count;
        Some(Self {
            mse,
            trimmed_mse: trimmed_mean(&mut squares),
            rel_mse: relative / count,
        })
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
    let kept = values.len() - dropped;
    if kept == 0 {
        return 0.0;
    }
    values.select_nth_unstable_by(kept, f64::total_cmp);
    values[..kept].iter().sum::<f64>() / kept as f64
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
pub(crate) fn equal_error_ratio(ours: (f64, f64), theirs: (f64, f64)) -> f64 {
    ours.0 * ours.1 / (theirs.0 * theirs.1)
}

/// The exponent `a` of `rmse = c samples^-a` through two renders `(samples, mse)`: 1/2 for
/// independent samples.
///
/// Each error holds the noise of its reference, of `reference` samples: a share that is taken off as
/// if it fell with exponent 1/2.
pub(crate) fn rate(few: (f64, f64), many: (f64, f64), reference: f64) -> f64 {
    let own = |(samples, mse): (f64, f64)| mse / (1.0 + samples / reference);
    0.5 * (own(few) / own(many)).ln() / (many.0 / few.0).ln()
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
        let endless = f64::INFINITY;
        assert!((rate((16.0, 0.4), (64.0, 0.1), endless) - 0.5).abs() < 1e-12);
        assert!((rate((16.0, 0.64), (64.0, 0.04), endless) - 1.0).abs() < 1e-12);
        // 1/16 and 1/64 of a variance, each with the 1/128 of the reference.
        let noise = 1.0 / 128.0;
        let measured = [(16.0, 1.0 / 16.0 + noise), (64.0, 1.0 / 64.0 + noise)];
        assert!((rate(measured[0], measured[1], 128.0) - 0.5).abs() < 1e-12);
    }
}
