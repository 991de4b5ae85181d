//! Checks at each single sample and direction: `weight = f cos / pdf`, and values are finite and
//! non-negative.

use specula_bsdf::{Rgb, Vec3};

use crate::quadrature::direction;
use crate::report::Check;
use crate::rng::Rng;
use crate::subject::{DirectionSample, Subject};

/// Options of a consistency test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConsistencyOptions {
    /// How many samples to take, and how many directions to test.
    pub samples: u32,
    /// Largest relative difference between `weight` and `eval / pdf`: 1e-9 suits `f64`, 1e-3
    /// `f32` (both quotients lose digits where the half vector does).
    pub relative_tolerance: f64,
}

impl Default for ConsistencyOptions {
    fn default() -> Self {
        Self {
            samples: 10_000,
            relative_tolerance: 1e-9,
        }
    }
}

/// Checks samples of one `wo`: `wi` is a unit vector; `pdf` is positive there and what the sampler
/// says; `weight` is `eval / pdf`; where specular, `weight` is finite and non-negative.
#[must_use]
pub fn samples(
    name: &str,
    subject: &Subject,
    wo: Vec3<f64>,
    options: &ConsistencyOptions,
    rng: &mut Rng,
) -> Check {
    let mut worst = 0.0_f64;
    let mut failure = None;
    let (mut sampled_count, mut failures) = (0_u32, 0_u32);
    for _ in 0..options.samples {
        let u = rng.triple();
        let Some(sampled) = subject.sample(wo, u) else {
            continue;
        };
        sampled_count += 1;
        let (off, fault) = at_sample(subject, wo, &sampled);
        worst = worst.max(off);
        let fault =
            fault.or((off > options.relative_tolerance).then_some("weight is not eval / pdf"));
        if let Some(fault) = fault {
            failures += 1;
            failure.get_or_insert_with(|| describe(fault, subject, wo, &sampled, u));
        }
    }
    Check {
        name: format!("weight = f cos / pdf {name}"),
        is_pass: failure.is_none(),
        p_value: None,
        detail: match failure {
            None => format!("{sampled_count} samples, within {worst:.1e}"),
            Some(text) => format!("{failures} of {sampled_count} samples; first: {text}"),
        },
    }
}

/// Checks `eval` and `pdf` of one `wo` at directions all over the sphere, some of them within
/// rounding of the horizon and the poles: finite and non-negative, and the same from `eval_pdf`.
#[must_use]
pub fn directions(
    name: &str,
    subject: &Subject,
    wo: Vec3<f64>,
    options: &ConsistencyOptions,
    rng: &mut Rng,
) -> Check {
    let mut failure = None;
    for _ in 0..options.samples {
        let wi = probe(rng);
        let (value, pdf) = (subject.eval(wo, wi), subject.pdf(wo, wi));
        if !(is_sane(value) && pdf >= 0.0 && pdf.is_finite()) {
            failure = Some(format!("wo {wo:?}, wi {wi:?}: eval {value:?}, pdf {pdf}"));
            break;
        }
        let together = subject.eval_pdf(wo, wi);
        if !are_close((value, pdf), together, options.relative_tolerance) {
            failure = Some(format!(
                "wo {wo:?}, wi {wi:?}: eval {value:?}, pdf {pdf}, together {together:?}"
            ));
            break;
        }
    }
    Check {
        name: format!("finite and non-negative {name}"),
        is_pass: failure.is_none(),
        p_value: None,
        detail: failure.unwrap_or_else(|| format!("{} directions", options.samples)),
    }
}

/// A direction: two in three uniform on the sphere, the rest near the horizon or a pole, at
/// distances down to 1e-12.
pub(crate) fn probe(rng: &mut Rng) -> Vec3<f64> {
    let [kind, place, azimuth] = rng.triple();
    let sign = if rng.uniform() < 0.5 { -1.0 } else { 1.0 };
    let small = f64::powf(10.0, -12.0 * place);
    let cos_theta = match kind {
        k if k < 0.65 => place,
        k if k < 0.85 => small,
        k if k < 0.95 => 1.0 - small,
        k if k < 0.98 => 1.0,
        _ => 0.0,
    };
    direction(sign * cos_theta, 2.0 * std::f64::consts::PI * azimuth)
}

/// Whether values and densities are the same but for rounding.
fn are_close(a: (Rgb<f64>, f64), b: (Rgb<f64>, f64), tolerance: f64) -> bool {
    let all = |(value, pdf): (Rgb<f64>, f64)| [value.r, value.g, value.b, pdf];
    let mut pairs = all(a).into_iter().zip(all(b));
    pairs.all(|(a, b)| (a - b).abs() <= tolerance * a.max(b))
}

fn is_sane(colour: Rgb<f64>) -> bool {
    colour
        .to_array()
        .into_iter()
        .all(|v| v.is_finite() && v >= 0.0)
}

/// Relative difference of the weight, and what else is wrong.
fn at_sample(
    subject: &Subject,
    wo: Vec3<f64>,
    sampled: &DirectionSample,
) -> (f64, Option<&'static str>) {
    if (sampled.wi.length_squared() - 1.0).abs() > 1e-5 || !sampled.wi.is_finite() {
        return (0.0, Some("wi is not a unit vector"));
    }
    if !is_sane(sampled.weight) {
        return (0.0, Some("weight is negative or not finite"));
    }
    if sampled.is_specular {
        return (0.0, None);
    }
    let (value, pdf) = (subject.eval(wo, sampled.wi), subject.pdf(wo, sampled.wi));
    if !is_sane(value) {
        return (0.0, Some("eval is negative or not finite"));
    }
    if !(pdf > 0.0 && pdf.is_finite()) {
        return (0.0, Some("pdf is not positive at a sample"));
    }
    let mut off = sampled
        .pdf
        .map_or(0.0, |reported| (reported - pdf).abs() / pdf);
    for (weight, value) in sampled.weight.to_array().into_iter().zip(value.to_array()) {
        let quotient = value / pdf;
        // Absolute below 1e-3: a weight of 1e-12 need not have as many digits.
        let scale = weight.max(quotient).max(1e-3);
        off = off.max((weight - quotient).abs() / scale);
    }
    (off, None)
}

fn describe(
    fault: &str,
    subject: &Subject,
    wo: Vec3<f64>,
    sampled: &DirectionSample,
    u: [f64; 3],
) -> String {
    format!(
        "{fault}: wo {wo:?}, u {u:?}, {sampled:?}, eval {:?}, pdf {}",
        subject.eval(wo, sampled.wi),
        subject.pdf(wo, sampled.wi)
    )
}
