//! FLIP: how strongly a difference shows when two pictures are flipped between on one screen.
//!
//! Source: Andersson et al. 2020, FLIP: A Difference Evaluator for Alternating Images (LDR), and
//! Andersson et al. 2021, Visualizing Errors in Rendered High Dynamic Range Images (HDR). Both are
//! symmetric in LDR; the HDR metric takes its exposures from the reference.

mod filter;
mod hdr;
mod space;

use rayon::prelude::*;
use specula_bsdf::{Rgb, math::rgb};

pub use hdr::hdr_flip_map;

use super::finite;
use filter::{Plane, edge_kernel, gaussian_kernel, point_kernel};
use space::{hunt_lab, hyab, to_ycxcz, ycxcz_to_linear};

/// Pixels per degree of visual angle: a 0.7 m wide screen of 3840 pixels seen from 0.7 m.
pub const PIXELS_PER_DEGREE: f32 = 67.0;

/// Exponent of colour differences (q_c).
const COLOUR_EXPONENT: f32 = 0.7;
/// Share of the largest colour difference (p_c) that is stretched to [`REMAPPED_SHARE`] (p_t).
const KNEE_SHARE: f32 = 0.4;
const REMAPPED_SHARE: f32 = 0.95;
/// Width of the feature detectors in degrees (w).
const FEATURE_WIDTH_DEG: f32 = 0.082;
/// Exponent of feature differences (q_f).
const FEATURE_EXPONENT: f32 = 0.5;

/// LDR-FLIP of each pixel, in `[0, 1]`: 0 no visible difference, 1 the largest there is.
///
/// ```text
/// dE = dE_c^(1 - dE_f)     (Andersson et al. 2020, eq. 15)
/// ```
///
/// * `reference`, `test`: linear RGB as displayed, row by row, `width * height` each; values outside
///   `[0, 1]` are cut off, NaN counts as 0.
///
/// # Panics
///
/// Where the lengths disagree.
#[must_use]
pub fn flip_map(reference: &[Rgb<f32>], test: &[Rgb<f32>], width: u32) -> Vec<f32> {
    assert_eq!(reference.len(), test.len(), "pictures of one size");
    if reference.is_empty() {
        return Vec::new();
    }
    let width = width as usize;
    let (a, b) = rayon::join(
        || Perceived::of(reference, width),
        || Perceived::of(test, width),
    );
    let largest = largest_colour_difference();
    let difference = |i: usize| {
        let colour = remap(hyab(a.lab[i], b.lab[i]).powf(COLOUR_EXPONENT), largest);
        let edge = (a.edge[i] - b.edge[i]).abs();
        let point = (a.point[i] - b.point[i]).abs();
        let feature = (edge.max(point) * core::f32::consts::FRAC_1_SQRT_2)
            .powf(FEATURE_EXPONENT)
            .min(1.0);
        colour.powf(1.0 - feature)
    };
    (0..reference.len())
        .into_par_iter()
        .map(difference)
        .collect()
}

/// What an observer perceives of a picture, per pixel.
struct Perceived {
    /// Hunt-adjusted L*a*b* after the contrast sensitivity filter.
    lab: Vec<[f32; 3]>,
    /// Magnitude of the first derivative of luminance.
    edge: Vec<f32>,
    /// Magnitude of the second.
    point: Vec<f32>,
}

impl Perceived {
    fn of(linear: &[Rgb<f32>], width: usize) -> Self {
        let opponent: Vec<[f32; 3]> = linear
            .par_iter()
            .map(|c| to_ycxcz(c.map(|v| finite(v.clamp(0.0, 1.0)))))
            .collect();
        let plane = |channel: usize| Plane {
            width,
            values: opponent.iter().map(|c| c[channel]).collect(),
        };
        let (luma, red_green, blue_yellow) = (plane(0), plane(1), plane(2));
        let lab = sensed_lab(&luma, &red_green, &blue_yellow);
        let (edge, point) = features(&luma);
        Self { lab, edge, point }
    }
}

/// The contrast sensitivity filters of the three opponent channels (table 1), then L*a*b*.
fn sensed_lab(luma: &Plane, red_green: &Plane, blue_yellow: &Plane) -> Vec<[f32; 3]> {
    // Widest term of any channel; it sets the support of all (the paper's r).
    let widest = gaussian_sd(0.04);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a few pixels"
    )]
    let radius = (3.0 * widest).ceil() as usize;
    let y = blur(luma, &[(1.0, 0.0047)], radius);
    let cx = blur(red_green, &[(1.0, 0.0053)], radius);
    let cz = blur(blue_yellow, &[(34.1, 0.04), (13.5, 0.025)], radius);
    y.par_iter()
        .zip(&cx)
        .zip(&cz)
        .map(|((&y, &cx), &cz)| hunt_lab(ycxcz_to_linear([y, cx, cz])))
        .collect()
}

/// Standard deviation in pixels of the term `exp(-pi^2 x^2 / b)`, x in degrees.
fn gaussian_sd(b: f32) -> f32 {
    (b / (2.0 * core::f32::consts::PI.powi(2))).sqrt() * PIXELS_PER_DEGREE
}

/// The normalised sum over `(a, b)` of `a sqrt(pi / b) exp(-pi^2 (x^2 + y^2) / b)` (eq. 4).
///
/// Each term is separable, their sum is not: terms are filtered apart and added.
fn blur(plane: &Plane, terms: &[(f32, f32)], radius: usize) -> Vec<f32> {
    let mut sum = vec![0.0; plane.values.len()];
    let mut total = 0.0;
    for &(a, b) in terms {
        let (kernel, mass) = gaussian_kernel(gaussian_sd(b), radius);
        let weight = a * (core::f32::consts::PI / b).sqrt() * mass * mass;
        total += weight;
        let filtered = plane.filtered(&kernel, &kernel);
        for (s, f) in sum.iter_mut().zip(&filtered.values) {
            *s += weight * f;
        }
    }
    for s in &mut sum {
        *s /= total;
    }
    sum
}

/// Magnitudes of edges and points in the unfiltered luminance (section 3.3).
fn features(luma: &Plane) -> (Vec<f32>, Vec<f32>) {
    let normalised = Plane {
        width: luma.width,
        // Y of YCxCz is in [-16, 100].
        values: luma.values.iter().map(|y| (y + 16.0) / 116.0).collect(),
    };
    let sd = 0.5 * FEATURE_WIDTH_DEG * PIXELS_PER_DEGREE;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a few pixels"
    )]
    let radius = (3.0 * sd).ceil() as usize;
    let (smooth, _) = gaussian_kernel(sd, radius);
    let magnitude = |kernel: &[f32]| -> Vec<f32> {
        let across = normalised.filtered(kernel, &smooth);
        let down = normalised.filtered(&smooth, kernel);
        let pairs = across.values.iter().zip(&down.values);
        pairs.map(|(x, y)| (x * x + y * y).sqrt()).collect()
    };
    (
        magnitude(&edge_kernel(sd, radius)),
        magnitude(&point_kernel(sd, radius)),
    )
}

/// The largest colour difference that a screen can show: green against blue.
fn largest_colour_difference() -> f32 {
    hyab(hunt_lab(rgb(0.0, 1.0, 0.0)), hunt_lab(rgb(0.0, 0.0, 1.0))).powf(COLOUR_EXPONENT)
}

/// Compresses large colour differences (eq. 10).
fn remap(difference: f32, largest: f32) -> f32 {
    let knee = KNEE_SHARE * largest;
    if difference < knee {
        REMAPPED_SHARE / knee * difference
    } else {
        let rest = ((difference - knee) / (largest - knee)).min(1.0);
        REMAPPED_SHARE + rest * (1.0 - REMAPPED_SHARE)
    }
}

#[cfg(test)]
mod tests;
