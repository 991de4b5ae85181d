//! Distances between pictures, and the time that one renderer takes for another's error.

use specula_bsdf::Rgb;

/// Added to the squared reference in relMSE.
const REL_MSE_EPSILON: f64 = 0.01;

/// The share of the largest squared errors that the trimmed error leaves out.
pub(crate) const TRIMMED_SHARE: f64 = 0.001;

/// Side of the blocks whose means are compared, in pixels.
const BLOCK: usize = 8;

/// An error that is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Metric {
    Rmse,
    BlockRmse,
    TrimmedRmse,
    RelMse,
}

impl Metric {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Rmse => "RMSE",
            Self::BlockRmse => "block RMSE",
            Self::TrimmedRmse => "trimmed RMSE",
            Self::RelMse => "relMSE",
        }
    }
}

/// Mean squared errors over pixels and channels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Errors {
    /// `mean((t - r)^2)`.
    pub(crate) mse: f64,
    /// The same of the means of [`BLOCK`] x [`BLOCK`] pixels, times the pixels of a block: equal to `mse`
    /// for white noise. Blocks that the border cuts are left out; NaN where none is whole.
    pub(crate) block_mse: f64,
    /// As `mse`, without the largest [`TRIMMED_SHARE`] of the squares.
    pub(crate) trimmed_mse: f64,
    /// `mean((t - r)^2 / (r^2 + 0.01))`.
    pub(crate) rel_mse: f64,
}

impl Errors {
    /// The errors of `test`, or `None` where the pictures differ in size or are empty.
    pub(crate) fn of(reference: &[Rgb<f32>], test: &[Rgb<f32>], width: usize) -> Option<Self> {
        Self::between(reference, [reference, test], width)
    }

    /// What two halves of a reference, the mean of which is `whole`, tell of its own errors, or `None`
    /// as above: with `v` the variance of a half, that of their mean is `v / 2` and their mean squared
    /// difference `2 v`.
    pub(crate) fn of_mean(
        whole: &[Rgb<f32>],
        halves: [&[Rgb<f32>]; 2],
        width: usize,
    ) -> Option<Self> {
        let difference = Self::between(whole, halves, width)?;
        Some(difference.map(|e| 0.25 * e))
    }

    /// What two pictures of different seeds tell of the errors of one, relative ones over `reference`,
    /// or `None` as above: half of their mean squared difference.
    pub(crate) fn of_pair(
        reference: &[Rgb<f32>],
        pair: [&[Rgb<f32>]; 2],
        width: usize,
    ) -> Option<Self> {
        let difference = Self::between(reference, pair, width)?;
        Some(difference.map(|e| 0.5 * e))
    }

    /// Differences of `a` and `b`, relative ones over `base`.
    fn between(base: &[Rgb<f32>], [a, b]: [&[Rgb<f32>]; 2], width: usize) -> Option<Self> {
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
            block_mse: block_mse(a, b, width),
            trimmed_mse: trimmed_mean(&mut squares),
            rel_mse: relative / count,
        })
    }

    /// The errors without those of the reference, which add to what is measured against it: picture and
    /// reference are independent.
    pub(crate) fn less(self, reference: Self) -> Self {
        // Not `max`, which would make a 0 of NaN.
        let less = |all: f64, own: f64| if all < own { 0.0 } else { all - own };
        Self {
            mse: less(self.mse, reference.mse),
            block_mse: less(self.block_mse, reference.block_mse),
            trimmed_mse: less(self.trimmed_mse, reference.trimmed_mse),
            rel_mse: less(self.rel_mse, reference.rel_mse),
        }
    }

    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self {
            mse: f(self.mse),
            block_mse: f(self.block_mse),
            trimmed_mse: f(self.trimmed_mse),
            rel_mse: f(self.rel_mse),
        }
    }

    /// The mean square that a metric stands for.
    pub(crate) fn get(self, metric: Metric) -> f64 {
        match metric {
            Metric::Rmse => self.mse,
            Metric::BlockRmse => self.block_mse,
            Metric::TrimmedRmse => self.trimmed_mse,
            Metric::RelMse => self.rel_mse,
        }
    }
}

/// The mean squared difference of block means, times the pixels of a block.
fn block_mse(a: &[Rgb<f32>], b: &[Rgb<f32>], width: usize) -> f64 {
    let width = width.max(1);
    let [columns, rows] = [width, a.len() / width].map(|pixels| pixels / BLOCK);
    let mut sums = vec![[0.0; 3]; columns * rows];
    for (i, (a, b)) in a.iter().zip(b).enumerate() {
        let (column, row) = (i % width / BLOCK, i / width / BLOCK);
        if column < columns && row < rows {
            let [a, b] = [a, b].map(|c| c.to_array().map(f64::from));
            let sum: &mut [f64; 3] = &mut sums[row * columns + column];
            (0..3).for_each(|c| sum[c] += a[c] - b[c]);
        }
    }
    let squares: f64 = sums.as_flattened().iter().map(|s| s * s).sum();
    // With n the pixels of a block: n (s / n)^2.
    squares / (BLOCK * BLOCK) as f64 / sums.as_flattened().len() as f64
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
        let e = Errors::of(&r, &t, 2).unwrap();
        assert!((e.mse - 0.025).abs() < 1e-8, "{e:?}");
        // One of the six values goes: one of the two larger.
        assert!((e.trimmed_mse - 0.022).abs() < 1e-8, "{e:?}");
        let relative = 0.5 * (0.01 / 0.01 + 0.04 / 1.01);
        assert!((e.rel_mse - relative).abs() < 1e-7, "{e:?}");
        assert_eq!(Errors::of(&r, &t[..1], 1), None);
        assert_eq!(Errors::of(&[], &[], 0), None);
    }

    #[test]
    fn one_firefly_rules_the_error_but_not_the_trimmed_one() {
        let reference = grey(&[1.0; 4000]);
        let mut test = grey(&[1.1; 4000]);
        test[17] = Rgb::splat(1000.0);
        let e = Errors::of(&reference, &test, 40).unwrap();
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
        let [low, one, high] = [0.9, 1.0, 1.1].map(|v| grey(&[v; 64]));
        let e = Errors::of_mean(&one, [&low, &high], 8).unwrap();
        assert!((e.mse - 0.01).abs() < 1e-7, "{e:?}");
        assert!((e.rel_mse - 0.01 / 1.01).abs() < 1e-7, "{e:?}");
        let measured = Errors::of(&one, &grey(&[1.2; 64]), 8).unwrap();
        let left = measured.less(e);
        assert!((left.mse - 0.03).abs() < 1e-6, "{left:?}");
        assert!((left.block_mse - 64.0 * 0.03).abs() < 1e-4, "{left:?}");
        assert_eq!(
            (e.less(measured).mse, e.less(measured).block_mse),
            (0.0, 0.0)
        );
    }

    /// A picture of noise of variance 1 around `level`, which squares of `side` pixels have in common.
    fn noise(seed: u64, level: f32, [width, height]: [u64; 2], side: u64) -> Vec<Rgb<f32>> {
        let pixel = |i: u64| {
            let square = (i / width / side) * width + i % width / side;
            // SplitMix64.
            let mut z = (square + (seed << 32)).wrapping_mul(0x9E37_79B9_7F4A_7C15);
            z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
            z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
            let sign = if (z ^ (z >> 31)) & 1 == 0 { 1.0 } else { -1.0 };
            Rgb::splat(level + sign)
        };
        (0..width * height).map(pixel).collect()
    }

    #[test]
    fn block_means_tell_noise_that_pixels_have_in_common_from_white_noise() {
        let size = [256, 256];
        let flat = grey(&[5.0; 256 * 256]);
        for (side, expected) in [(1, 1.0), (2, 4.0), (8, 64.0)] {
            let e = Errors::of(&flat, &noise(1, 5.0, size, side), 256).unwrap();
            assert!((e.mse - 1.0).abs() < 1e-6, "{side}: {e:?}");
            // 1024 blocks of +-1: 4.4 % of standard deviation.
            let apart = e.block_mse / expected - 1.0;
            assert!(apart.abs() < 0.09, "{side}: {e:?}");
        }
    }

    #[test]
    fn blocks_that_the_border_cuts_are_left_out() {
        // One whole block, and a strip and a row of other differences around it.
        let (width, height) = (11, 9);
        let flat = grey(&[0.0; 99]);
        let test: Vec<_> = (0..width * height)
            .map(|i| {
                Rgb::splat(if i % width < 8 && i / width < 8 {
                    0.5
                } else {
                    9.0
                })
            })
            .collect();
        let e = Errors::of(&flat, &test, width).unwrap();
        assert!((e.block_mse - 64.0 * 0.25).abs() < 1e-9, "{e:?}");
        let none = Errors::of(&flat[..63], &test[..63], 9).unwrap();
        assert!(none.block_mse.is_nan() && none.less(none).block_mse.is_nan());
    }

    #[test]
    fn a_pair_of_seeds_tells_the_errors_of_one_picture() {
        let size = [256, 256];
        for side in [1, 8] {
            let [a, b] = [1, 2].map(|seed| noise(seed, 5.0, size, side));
            let reference = grey(&[5.0; 256 * 256]);
            let pair = Errors::of_pair(&reference, [&a, &b], 256).unwrap();
            let one = Errors::of(&reference, &a, 256).unwrap();
            for metric in [Metric::Rmse, Metric::BlockRmse, Metric::RelMse] {
                let apart = pair.get(metric) / one.get(metric) - 1.0;
                assert!(apart.abs() < 0.09, "{side}, {metric:?}: {pair:?}, {one:?}");
            }
            let same = Errors::of_pair(&reference, [&a, &a], 256).unwrap();
            assert_eq!((same.mse, same.block_mse), (0.0, 0.0));
        }
    }
}
