//! Equality of two noisy images: on the mean, on tiles and on pixels.
//!
//! A per-pixel test alone misses a bias of a few per cent that is the same everywhere; the mean
//! alone misses one wrong pixel. So: all three.

use crate::report::{Check, Report};
use crate::z_test::{equal_means, sidak, two_sided_p};

/// One channel of an image with its noise.
#[derive(Clone, Copy, Debug)]
pub struct NoisyImage<'a> {
    /// Pixels in a row.
    pub width: usize,
    /// Estimates, row by row.
    pub mean: &'a [f64],
    /// Variance of each estimate (of the pixel's mean, not of one sample).
    pub variance: &'a [f64],
}

/// Tests whether two independent renders have the same expectation, at three scales.
///
/// The pixel test takes the estimates as normally distributed: give it enough samples per pixel
/// (hundreds where the light is not smooth).
///
/// * `tile`: side of the tiles in pixels, such as 8.
/// * `significance`: chance of a false alarm over all three scales.
/// * Returns: a report of one failed check where the images differ in size, or `mean` and
///   `variance` differ in length.
#[must_use]
pub fn compare(a: &NoisyImage, b: &NoisyImage, tile: usize, significance: f64) -> Report {
    let pixels = a.mean.len();
    let is_same_size = a.width == b.width
        && [b.mean.len(), a.variance.len(), b.variance.len()] == [pixels; 3]
        && a.width > 0
        && pixels.is_multiple_of(a.width);
    let each = sidak(significance, 3);
    let mut report = Report::new("equality of two images");
    if !is_same_size {
        report.checks.push(Check {
            name: "image size".to_owned(),
            is_pass: false,
            p_value: None,
            detail: "the images differ in size, or in the lengths of their lists".to_owned(),
        });
        return report;
    }
    let all = region(a, b, 0..a.width, 0..pixels / a.width);
    report
        .checks
        .push(check("mean", &[("the image".into(), all)], each));
    let tiles = tiles(a, b, tile.max(1));
    report.checks.push(check("tiles", &tiles, each));
    let each_pixel: Vec<(String, f64)> = (0..pixels)
        .map(|i| {
            let p = equal_means((a.mean[i], a.variance[i]), (b.mean[i], b.variance[i]));
            (format!("pixel ({}, {})", i % a.width, i / a.width), p)
        })
        .collect();
    report.checks.push(check("pixels", &each_pixel, each));
    report
}

fn tiles(a: &NoisyImage, b: &NoisyImage, tile: usize) -> Vec<(String, f64)> {
    let height = a.mean.len() / a.width;
    let mut found = Vec::new();
    for y in (0..height).step_by(tile) {
        for x in (0..a.width).step_by(tile) {
            let p = region(a, b, x..(x + tile).min(a.width), y..(y + tile).min(height));
            found.push((format!("tile at ({x}, {y})"), p));
        }
    }
    found
}

/// p-value of the sums over a rectangle being equal.
fn region(
    a: &NoisyImage,
    b: &NoisyImage,
    columns: std::ops::Range<usize>,
    rows: std::ops::Range<usize>,
) -> f64 {
    let (mut apart, mut variance) = (0.0, 0.0);
    for y in rows {
        for x in columns.clone() {
            let i = y * a.width + x;
            apart += a.mean[i] - b.mean[i];
            variance += a.variance[i] + b.variance[i];
        }
    }
    if apart == 0.0 {
        1.0
    } else {
        two_sided_p(apart / variance.sqrt())
    }
}

/// The worst of many p-values against its share of the significance.
fn check(scale: &str, found: &[(String, f64)], significance: f64) -> Check {
    let threshold = sidak(significance, found.len());
    let none = (String::from("nothing"), 0.0);
    let worst = found
        .iter()
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .unwrap_or(&none);
    let failing = found.iter().filter(|(_, p)| *p < threshold).count();
    Check {
        name: format!("image {scale}"),
        is_pass: worst.1 >= threshold,
        p_value: Some(worst.1),
        detail: format!(
            "{failing} of {} beyond p = {threshold:.2e}; worst is {}, p = {:.2e}",
            found.len(),
            worst.0,
            worst.1
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Rng;

    /// A gradient with noise of relative deviation `noise`, made of 12 uniforms per pixel.
    fn gradient(seed: u64, noise: f64) -> (Vec<f64>, Vec<f64>) {
        let mut rng = Rng::new(seed);
        (0..64 * 64)
            .map(|i| {
                let true_value = 0.2 + f64::from(i) / 4096.0;
                let normal: f64 = (0..12).map(|_| rng.uniform()).sum::<f64>() - 6.0;
                let deviation = noise * true_value;
                (true_value + deviation * normal, deviation * deviation)
            })
            .unzip()
    }

    #[test]
    fn equal_images_pass() {
        let (a, va) = gradient(1, 0.2);
        let (b, vb) = gradient(2, 0.1);
        let image = |mean, variance| NoisyImage {
            width: 64,
            mean,
            variance,
        };
        let report = compare(&image(&a, &va), &image(&b, &vb), 8, 0.01);
        assert!(report.is_pass(), "{report}");
        assert_eq!(report.checks.len(), 3);
    }
    #[test]
    fn images_of_other_sizes_fail() {
        let mean = [0.5; 12];
        let image = |width, count| NoisyImage {
            width,
            mean: &mean[..count],
            variance: &mean[..count],
        };
        for (a, b) in [
            (image(3, 12), image(4, 12)),
            (image(3, 12), image(3, 9)),
            (image(5, 12), image(5, 12)),
            (image(0, 0), image(0, 0)),
        ] {
            assert!(!compare(&a, &b, 8, 0.01).is_pass());
        }
    }
}
