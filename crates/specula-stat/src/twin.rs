//! Twins: the same formula in two precisions, compared with each other.

use specula_bsdf::Vec3;

use crate::consistency::probe;
use crate::report::Check;
use crate::rng::Rng;
use crate::subject::Subject;

/// Tolerances between twins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwinOptions {
    /// How many pairs of directions.
    pub pairs: u32,
    /// Largest relative difference: `|a - b| <= relative max(|a|, |b|) + absolute`.
    pub relative_tolerance: f64,
    /// Added to it: differences too small to matter, in 1/sr.
    pub absolute_tolerance: f64,
    /// Random views with a lower cosine of the polar angle are left out: near the nadir only
    /// facets at the horizon are visible, and `f32` has no digits for them.
    pub lowest_cos_theta: f64,
}

impl Default for TwinOptions {
    fn default() -> Self {
        Self {
            pairs: 10_000,
            relative_tolerance: 1e-3,
            absolute_tolerance: 1e-5,
            lowest_cos_theta: -0.99,
        }
    }
}

/// Checks that `eval` and `pdf` of an `f32` lobe are those of its `f64` twin.
///
/// Directions are rounded to `f32` first, so that both see the same; they reach down to the
/// horizon and up to the poles, and half of the `wi` are samples of the `f64` twin, where lobes
/// are sharp.
///
/// * `views`: values of `wo`; half of the pairs have one of them, half a random one.
#[must_use]
pub fn test(
    name: &str,
    single: &Subject,
    double: &Subject,
    views: &[Vec3<f64>],
    options: &TwinOptions,
    rng: &mut Rng,
) -> Check {
    let mut worst = 0.0_f64;
    let mut failure = None;
    for k in 0..options.pairs as usize {
        let wo = if k % 4 < 2 && !views.is_empty() {
            views[(k / 4) % views.len()]
        } else {
            probe(rng)
        };
        if wo.z < options.lowest_cos_theta {
            continue;
        }
        let wi = if k % 2 == 0 {
            probe(rng)
        } else if let Some(sampled) = double.sample_density(wo, rng.triple()) {
            sampled.wi
        } else {
            continue;
        };
        let (wo, wi) = (rounded(wo), rounded(wi));
        let [r, g, b] = single.eval(wo, wi).to_array();
        let [r2, g2, b2] = double.eval(wo, wi).to_array();
        let pdfs = (single.pdf(wo, wi), double.pdf(wo, wi));
        for (a, b) in [(r, r2), (g, g2), (b, b2), pdfs] {
            let allowed =
                options.relative_tolerance * a.abs().max(b.abs()) + options.absolute_tolerance;
            let off = (a - b).abs() / allowed;
            let off = if off.is_nan() { f64::INFINITY } else { off };
            if off > 1.0 {
                failure
                    .get_or_insert_with(|| format!("wo {wo:?}, wi {wi:?}: f32 {a:e}, f64 {b:e}"));
            }
            worst = worst.max(off);
        }
    }
    Check {
        name: format!("f32 = f64 {name}"),
        is_pass: failure.is_none(),
        p_value: None,
        detail: match failure {
            None => format!(
                "{} pairs, at most {:.0} % of the tolerance",
                options.pairs,
                100.0 * worst
            ),
            Some(text) => format!("{:.1} times the tolerance; first: {text}", worst),
        },
    }
}

/// Checks that samples of an `f32` lobe are those of its `f64` twin for the same random numbers.
///
/// Within rounding of a decision (reflect or refract, accept or reject), the two may decide
/// differently.
///
/// * `distance`: largest distance between the two directions.
/// * `share`: of the samples that may lie farther apart, such as 1e-3.
#[must_use]
pub fn samples(
    name: &str,
    single: &Subject,
    double: &Subject,
    wo: Vec3<f64>,
    [distance, share]: [f64; 2],
    sample_count: u32,
    rng: &mut Rng,
) -> Check {
    let wo = rounded(wo);
    let mut apart = 0_u32;
    for _ in 0..sample_count {
        let u = rng.triple();
        let is_near = match (single.sample(wo, u), double.sample(wo, u)) {
            (None, None) => true,
            (Some(a), Some(b)) => (a.wi - b.wi).length() <= distance,
            _ => false,
        };
        apart += u32::from(!is_near);
    }
    Check {
        name: format!("f32 samples = f64 samples {name}"),
        is_pass: f64::from(apart) <= share * f64::from(sample_count),
        p_value: None,
        detail: format!("{apart} of {sample_count} farther apart than {distance:.0e}"),
    }
}

/// The nearest direction that `f32` can hold.
fn rounded(w: Vec3<f64>) -> Vec3<f64> {
    w.cast::<f32>().cast()
}
