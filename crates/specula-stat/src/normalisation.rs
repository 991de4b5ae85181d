//! The integral of a pdf against the rate at which its sampler accepts samples.

use specula_bsdf::Vec3;

use crate::chi_square::poisson_tail;
use crate::quadrature::{Integral, Patch, Quadrature};
use crate::report::Check;
use crate::rng::Rng;
use crate::subject::Subject;
use crate::z_test::two_sided_p;

/// Integrates `pdf(wo, .)` over the sphere, cut at the horizon and at `cos_theta_edges`.
#[must_use]
pub fn integrate_pdf(
    subject: &Subject,
    wo: Vec3<f64>,
    cos_theta_edges: &[f64],
    quadrature: &Quadrature,
) -> Integral<1> {
    integrate_bands(cos_theta_edges, quadrature, |wi| [subject.pdf(wo, wi)])
}

/// Integrates over the sphere in bands, so that steps at the edges cause no error.
#[must_use]
pub fn integrate_bands<const N: usize>(
    cos_theta_edges: &[f64],
    quadrature: &Quadrature,
    f: impl Fn(Vec3<f64>) -> [f64; N],
) -> Integral<N> {
    let mut edges = vec![1.0, 0.0, -1.0];
    edges.extend(cos_theta_edges.iter().filter(|c| c.abs() < 1.0));
    edges.sort_by(|a, b| b.total_cmp(a));
    edges.dedup_by(|a, b| (*a - *b).abs() < 1e-12);
    let mut total = Integral {
        value: [0.0; N],
        error: 0.0,
        evaluations: 0,
        converged: true,
    };
    for band in edges.windows(2) {
        let patch = Patch {
            theta: [band[0].acos(), band[1].acos()],
            ..Patch::SPHERE
        };
        let part = quadrature.integrate(patch, &f);
        for (sum, value) in total.value.iter_mut().zip(part.value) {
            *sum += value;
        }
        total.error += part.error;
        total.evaluations += part.evaluations;
        total.converged &= part.converged;
    }
    total
}

/// Checks that the share of samples that lead to a direction is the integral of the pdf.
///
/// * `integral`: of the pdf, by [`integrate_pdf`].
/// * `samples`: how many samples.
#[must_use]
pub fn test(
    name: &str,
    subject: &Subject,
    wo: Vec3<f64>,
    integral: &Integral<1>,
    samples: u32,
    significance: f64,
    rng: &mut Rng,
) -> Check {
    let accepted = (0..samples)
        .filter(|_| subject.sample_density(wo, rng.triple()).is_some())
        .count();
    #[expect(clippy::cast_precision_loss, reason = "at most 2^32")]
    let accepted = accepted as f64;
    let p_value = p_value(accepted, f64::from(samples), integral);
    Check {
        name: format!("integral of pdf {name}"),
        is_pass: p_value >= significance && integral.error < 1e-3,
        p_value: Some(p_value),
        detail: format!(
            "p = {p_value:.2e}; integral {:.6} +- {:.1e}, accepted {:.6}",
            integral.value[0],
            integral.error,
            accepted / f64::from(samples)
        ),
    }
}

/// Chance of an acceptance this far from the integral.
fn p_value(accepted: f64, samples: f64, integral: &Integral<1>) -> f64 {
    let rate = integral.value[0];
    let slack = integral.error + 1e-9;
    let possible = rate >= -slack && rate <= 1.0 + slack;
    if !possible || !slack.is_finite() {
        return 0.0;
    }
    let expected = rate.clamp(0.0, 1.0) * samples;
    let variance = expected * (1.0 - expected / samples);
    if variance > 25.0 {
        let apart = ((accepted - expected).abs() - 0.5 - slack * samples).max(0.0);
        two_sided_p(apart / variance.sqrt())
    } else if expected > 0.5 * samples {
        2.0 * poisson_tail(samples - accepted, samples - expected, slack * samples)
    } else {
        2.0 * poisson_tail(accepted, expected, slack * samples)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn integral(value: f64) -> Integral<1> {
        Integral {
            value: [value],
            error: 1e-8,
            evaluations: 225,
            converged: true,
        }
    }

    #[test]
    fn counts_near_their_expectation_are_likely() {
        assert!(p_value(50_100.0, 1e5, &integral(0.5)) > 0.1);
        assert!(p_value(100_000.0, 1e5, &integral(1.0)) > 0.1);
        assert!(p_value(99_999.0, 1e5, &integral(0.999_99)) > 0.1);
        assert!(p_value(0.0, 1e5, &integral(0.0)) > 0.1);
    }

    #[test]
    fn counts_far_from_their_expectation_are_not() {
        assert!(p_value(51_000.0, 1e5, &integral(0.5)) < 1e-8);
        assert!(p_value(99_999.0, 1e5, &integral(1.0)) < 1e-2);
        assert!(p_value(99_990.0, 1e5, &integral(1.0)) < 1e-8);
        assert_eq!(p_value(100_000.0, 1e5, &integral(1.01)), 0.0);
        assert_eq!(p_value(100_000.0, 1e5, &integral(f64::NAN)), 0.0);
    }
}
