//! Differences between two pictures, by metrics and as a map.

use specula_bsdf::Rgb;

use super::{Display, Picture, PictureError, flip_map, hdr_flip_map};

/// Added to the squared reference in relMSE, so that black pixels count but do not rule.
const REL_MSE_EPSILON: f64 = 0.01;

/// The distances between a test picture and its reference.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// `sqrt(mean((t - r)^2))` over pixels and channels.
    pub rmse: f64,
    /// `mean((t - r)^2 / (r^2 + 0.01))` over pixels and channels (Rousselle et al. 2011).
    pub rel_mse: f64,
    /// `mean(|t - r|)` over pixels and channels.
    pub mae: f64,
    /// `mean(t - r)` over pixels and channels: light gained or lost.
    pub bias: f64,
    /// [`bias`](Self::bias) over the mean of the reference; 0 where that is black.
    pub rel_bias: f64,
    /// The largest `|t - r|` of any channel.
    pub max_difference: f64,
    /// `10 log10(1 / mse)` of the displayed values (clamped, sRGB-encoded); infinite where equal.
    pub psnr_db: f64,
    /// Mean LDR-FLIP of the pictures as displayed at exposure 0, clamped.
    pub flip: f64,
    /// Mean HDR-FLIP.
    pub hdr_flip: f64,
    /// HDR-FLIP of each pixel, in `[0, 1]`.
    pub flip_map: Vec<f32>,
    /// Pixels left out of all but FLIP, as one of the two is infinite or not a number there.
    pub skipped: usize,
}

/// Compares the colours of `test` with those of `reference`.
///
/// # Errors
///
/// Where the pictures differ in size or crop.
pub fn compare(reference: &Picture, test: &Picture) -> Result<Comparison, PictureError> {
    let shape = |p: &Picture| {
        let ([x, y], [w, h]) = (p.offset, p.full_resolution);
        [p.width, p.height, x, y, w, h]
    };
    if shape(reference) != shape(test) {
        return Err(PictureError::DifferentSize {
            a: shape(reference),
            b: shape(test),
        });
    }
    let (r, t) = (&reference.colour, &test.colour);
    let sums = Sums::of(r, t);
    let values = (sums.values as f64).max(1.0);
    let hdr = hdr_flip_map(r, t, reference.width);
    let mean_of = |map: &[f32]| {
        let sum: f64 = map.iter().map(|&v| f64::from(v)).sum();
        sum / (map.len() as f64).max(1.0)
    };
    let ldr = flip_map(r, t, reference.width);
    Ok(Comparison {
        rmse: (sums.squares / values).sqrt(),
        rel_mse: sums.relative_squares / values,
        mae: sums.magnitudes / values,
        bias: sums.differences / values,
        rel_bias: if sums.reference > 0.0 {
            sums.differences / sums.reference
        } else {
            0.0
        },
        max_difference: sums.largest,
        psnr_db: -10.0 * (sums.displayed_squares / values).log10(),
        flip: mean_of(&ldr),
        hdr_flip: mean_of(&hdr),
        flip_map: hdr,
        skipped: sums.skipped,
    })
}

#[derive(Default)]
struct Sums {
    values: usize,
    skipped: usize,
    reference: f64,
    differences: f64,
    magnitudes: f64,
    squares: f64,
    relative_squares: f64,
    displayed_squares: f64,
    largest: f64,
}

impl Sums {
    fn of(reference: &[Rgb<f32>], test: &[Rgb<f32>]) -> Self {
        let display = Display::default();
        let mut sums = Self::default();
        for (&r, &t) in reference.iter().zip(test) {
            if !r.is_finite() || !t.is_finite() {
                sums.skipped += 1;
                continue;
            }
            let shown = |c| display.to_rgb8(c).map(|v| f64::from(v) / 255.0);
            let (shown_r, shown_t) = (shown(r), shown(t));
            let (r, t) = (r.to_array().map(f64::from), t.to_array().map(f64::from));
            for c in 0..3 {
                let d = t[c] - r[c];
                sums.values += 1;
                sums.reference += r[c];
                sums.differences += d;
                sums.magnitudes += d.abs();
                sums.squares += d * d;
                sums.relative_squares += d * d / (r[c] * r[c] + REL_MSE_EPSILON);
                sums.displayed_squares += (shown_t[c] - shown_r[c]).powi(2);
                sums.largest = sums.largest.max(d.abs());
            }
        }
        sums
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use specula_bsdf::math::rgb;

    fn grey(value: f32) -> Picture {
        Picture::from_colour(8, 6, vec![Rgb::splat(value); 48])
    }

    #[test]
    fn equal_pictures() {
        let c = compare(&grey(0.4), &grey(0.4)).unwrap();
        assert_eq!(
            [c.rmse, c.rel_mse, c.mae, c.bias, c.flip, c.hdr_flip],
            [0.0; 6]
        );
        assert_eq!(c.psnr_db, f64::INFINITY);
    }

    #[test]
    fn a_known_offset() {
        let c = compare(&grey(0.5), &grey(0.25)).unwrap();
        assert_eq!(c.rmse, 0.25);
        assert_eq!(c.mae, 0.25);
        assert_eq!(c.bias, -0.25);
        assert_eq!(c.rel_bias, -0.5);
        assert!((c.rel_mse - 0.0625 / 0.26).abs() < 1e-12);
    }

    #[test]
    fn black_against_white_is_near_the_largest_flip() {
        let c = compare(&grey(0.0), &grey(1.0)).unwrap();
        assert!(c.flip > 0.95 && c.flip <= 1.0, "{}", c.flip);
    }

    #[test]
    fn different_crops_are_refused() {
        let mut cropped = grey(0.5);
        cropped.offset = [1, 0];
        assert!(matches!(
            compare(&grey(0.5), &cropped),
            Err(PictureError::DifferentSize { .. })
        ));
    }

    #[test]
    fn pixels_without_a_number_are_left_out_and_counted() {
        let mut broken = grey(0.5);
        broken.colour[5] = rgb(f32::NAN, 0.0, 0.0);
        broken.colour[6] = rgb(f32::INFINITY, 0.0, 0.0);
        let c = compare(&grey(0.5), &broken).unwrap();
        assert_eq!((c.skipped, c.rmse), (2, 0.0));
        assert!(c.hdr_flip.is_finite());
    }
}
