//! `render.compare`: how far two renders are from each other.

use serde::Deserialize;
use serde_json::json;
use specula_bsdf::Rgb;
use specula_render::picture::{self, Picture};

use super::session::Session;
use crate::{Answer, AskError};

/// Side of the blocks whose means are compared.
const BLOCK: usize = 8;
/// Added to the squared reference in relative errors, as in relMSE.
const EPSILON: f32 = 0.01;

/// `render.compare`
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Compare {
    pub(super) session: u64,
    pub(super) reference: u64,
}

impl Session {
    /// The picture so far.
    pub(super) fn picture(&self) -> Result<Picture, AskError> {
        let film = self.film().ok_or_else(|| {
            AskError::new("a render has no samples yet: advance it (render.advance)")
        })?;
        Ok(film.picture())
    }
}

/// The answer to `render.compare`.
pub(super) fn answer(reference: &Picture, test: &Picture) -> Result<Answer, AskError> {
    let errors = picture::compare(reference, test).map_err(|e| AskError::new(e.to_string()))?;
    let [width, height] = [test.width, test.height].map(|side| side as usize);
    let error: Vec<f32> = reference
        .colour
        .iter()
        .zip(&test.colour)
        .map(|(&r, &t)| relative(r, t))
        .collect();
    let value = json!({
        "rmse": errors.rmse,
        "relMse": errors.rel_mse,
        "blockRmse": block_rmse(&reference.colour, &test.colour, width),
        "flip": errors.flip,
    });
    Ok(Answer::new(value).with_f32("error", &[height, width], &error))
}

/// Relative error of a pixel: the root of its mean over channels of `(t - r)^2 / (r^2 + 0.01)`.
fn relative(r: Rgb<f32>, t: Rgb<f32>) -> f32 {
    let (r, t) = (r.to_array(), t.to_array());
    let squares = [0, 1, 2].map(|c| (t[c] - r[c]).powi(2) / (r[c] * r[c] + EPSILON));
    let mean = squares.iter().sum::<f32>() / 3.0;
    if mean.is_finite() { mean.sqrt() } else { 0.0 }
}

/// Root mean square over blocks and channels of the errors of the blocks' means, times their side: that of pixels, where
/// errors of pixels are independent. Blocks at the borders are smaller, and count by their pixels.
fn block_rmse(reference: &[Rgb<f32>], test: &[Rgb<f32>], width: usize) -> f64 {
    let columns = width.div_ceil(BLOCK);
    let rows = (reference.len() / width.max(1)).div_ceil(BLOCK);
    let mut sums = vec![([0.0; 3], 0.0); columns * rows];
    for (i, (r, t)) in reference.iter().zip(test).enumerate() {
        if !r.is_finite() || !t.is_finite() {
            continue;
        }
        let (sum, count) = &mut sums[i / width / BLOCK * columns + i % width / BLOCK];
        let (r, t) = (r.to_array(), t.to_array());
        for c in 0..3 {
            sum[c] += f64::from(t[c]) - f64::from(r[c]);
        }
        *count += 1.0;
    }
    // A block of n pixels: (mean error)^2 n is the pixels' squared error, weighed with n / 64.
    let squares =
        |(sum, count): &([f64; 3], f64)| sum.iter().map(|s| s * s / count.max(1.0)).sum::<f64>();
    let weights: f64 = sums
        .iter()
        .map(|(_, count)| count / (BLOCK * BLOCK) as f64)
        .sum();
    let total: f64 = sums
        .iter()
        .map(|s| squares(s) * s.1 / (BLOCK * BLOCK) as f64)
        .sum();
    (total / (3.0 * weights.max(f64::MIN_POSITIVE))).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_even_offset_is_seen_in_full_and_noise_as_it_is() {
        let (width, count) = (24, 24 * 19);
        let black = vec![Rgb::BLACK; count];
        let offset = block_rmse(&black, &vec![Rgb::splat(0.5); count], width);
        // A block's error is its mean's, times 8; smaller blocks count less.
        assert!(offset > 0.5 * 6.0 && offset <= 0.5 * 8.0, "{offset}");
        let sign = |i: usize| {
            if (i * 2_654_435_761) >> 7 & 1 == 0 {
                1.0
            } else {
                -1.0
            }
        };
        let noise: Vec<_> = (0..count).map(|i| Rgb::splat(sign(i))).collect();
        let noise = block_rmse(&black, &noise, width);
        assert!(noise > 0.1 && noise < 4.0, "{noise}");
        assert_eq!(block_rmse(&black, &black, width), 0.0);
    }
}
