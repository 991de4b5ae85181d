//! The white furnace: the mean weight of samples against the quadrature of `f cos`.
//!
//! Single scattering loses light, so the expectation is the directional albedo `E(wo)`, not 1.

use specula_bsdf::Vec3;

use crate::normalisation::integrate_bands;
use crate::quadrature::{Integral, Quadrature};
use crate::report::Check;
use crate::rng::Rng;
use crate::subject::Subject;
use crate::z_test::{Moments, sidak, two_sided_p};

/// Directional albedo by quadrature, without Dirac deltas.
///
/// ```text
/// E(wo) = integral of f(wo, wi) |cos theta_i| dwi
/// ```
///
/// * Returns: red, green, blue.
#[must_use]
pub fn albedo(
    subject: &Subject,
    wo: Vec3<f64>,
    cos_theta_edges: &[f64],
    quadrature: &Quadrature,
) -> Integral<3> {
    integrate_bands(cos_theta_edges, quadrature, |wi| {
        subject.eval(wo, wi).to_array()
    })
}

/// Directional albedo by sampling, without Dirac deltas; rejected samples count as zero.
///
/// * Returns: moments of the weights, red, green, blue.
#[must_use]
pub fn sampled_albedo(
    subject: &Subject,
    wo: Vec3<f64>,
    samples: u32,
    rng: &mut Rng,
) -> [Moments; 3] {
    let mut moments = [Moments::default(); 3];
    for _ in 0..samples {
        let weight = subject
            .sample_density(wo, rng.triple())
            .map_or([0.0; 3], |sampled| sampled.weight.to_array());
        for (channel, w) in moments.iter_mut().zip(weight) {
            channel.push(w);
        }
    }
    moments
}

/// Checks that the mean weight of the samples is the albedo by quadrature.
///
/// A difference counts only where neither the samples' variance nor rare events that no sample met
/// explain it (`n` samples miss an event of probability `q` with probability `exp(-n q)`).
///
/// * `expected`: by [`albedo`].
#[must_use]
pub fn test(
    name: &str,
    subject: &Subject,
    wo: Vec3<f64>,
    expected: &Integral<3>,
    samples: u32,
    significance: f64,
    rng: &mut Rng,
) -> Check {
    let found = sampled_albedo(subject, wo, samples, rng);
    let mut p_value = 1.0_f64;
    for (moments, value) in found.iter().zip(expected.value) {
        let apart = ((moments.mean() - value).abs() - expected.error - 1e-7).max(0.0);
        // f64::max would hide a mean that is not a number.
        let p = if !moments.mean().is_finite() || !value.is_finite() {
            0.0
        } else if apart == 0.0 {
            1.0
        } else {
            let unseen = f64::exp(-apart * moments.count() / value.max(1.0));
            two_sided_p(apart / moments.variance_of_mean().sqrt()).max(unseen)
        };
        p_value = p_value.min(p);
    }
    let half = found[1].half_interval(0.01);
    Check {
        name: format!("furnace {name}"),
        is_pass: p_value >= sidak(significance, 3) && expected.error < 1e-3,
        p_value: Some(p_value),
        detail: format!(
            "p = {p_value:.2e}; green: sampled {:.6} +- {half:.1e}, quadrature {:.6} +- {:.1e}",
            found[1].mean(),
            expected.value[1],
            expected.error
        ),
    }
}
