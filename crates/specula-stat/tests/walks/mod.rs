//! Proofs of lobes whose values are estimates: everything by means, whose p-values are two-sided.

use specula_bsdf::math::{Real, vec3, warp};
use specula_bsdf::{Bsdf, Transport, Vec3};
use specula_stat::normalisation::integrate_bands;
use specula_stat::quadrature::{Peak, Quadrature};
use specula_stat::z_test::{Moments, sidak, two_sided_p};
use specula_stat::{Check, Report};

use crate::common::{SUITE_TESTS, at, in_cells, moments, sampled, sigmas};

/// Estimates of each mean.
const COUNT: u64 = 40_000;
const RADIANCE: Transport = Transport::Radiance;
/// Cells of a hemisphere: rings of equal solid angle times cosine, sectors of equal azimuth.
const RINGS: usize = 3;
const SECTORS: usize = 4;
const CELLS: usize = 2 * RINGS * SECTORS;

/// Means of `f cos` by `n` estimates.
fn value<T: Real>(
    lobe: &(impl Bsdf<T> + Sync),
    wo: Vec3<f64>,
    wi: Vec3<f64>,
    seed: u64,
) -> [Moments; 3] {
    moments(seed, COUNT, |s| {
        let f_cos = lobe.eval_pdf_random(wo.cast(), wi.cast(), RADIANCE, s).0;
        f_cos.cast::<f64>().to_array()
    })
}

/// Means of the weights of samples.
fn weights<T: Real>(lobe: &(impl Bsdf<T> + Sync), wo: Vec3<f64>, seed: u64) -> [Moments; 3] {
    moments(seed, COUNT, |s| {
        sampled(lobe, wo, s).map_or([0.0; 3], |x| x.weight.cast::<f64>().to_array())
    })
}

/// One check by the least p-value of several comparisons.
fn check(name: String, comparisons: impl IntoIterator<Item = (f64, String)>) -> Check {
    let all: Vec<(f64, String)> = comparisons.into_iter().collect();
    let tests = all.len();
    let least = all.into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
    let (p, detail) = least.unwrap_or((0.0, "nothing was compared".to_owned()));
    Check {
        name,
        is_pass: p > sidak(sidak(0.01, SUITE_TESTS), tests),
        p_value: Some(p),
        detail: format!("p {p:.1e}: {detail}"),
    }
}

/// Comparison of two means, channel by channel.
fn channels(of: &str, a: [Moments; 3], b: [Moments; 3]) -> impl Iterator<Item = (f64, String)> {
    a.into_iter().zip(b).map(move |(a, b)| {
        let p = two_sided_p(sigmas(&a, &b));
        (p, format!("{of}: {} and {}", a.mean(), b.mean()))
    })
}

/// All proofs of a lobe whose values are estimates.
///
/// * `eta`: index of refraction below the surface; 1 where the lobe is black there.
pub(crate) fn prove_means(
    name: &str,
    single: &(impl Bsdf<f32> + Sync),
    double: &(impl Bsdf<f64> + Sync),
    eta: f64,
) -> Report {
    let mut report = Report::new(name);
    let transmits = eta != 1.0;
    let mut views = vec![at(15.0, 20.0), at(62.0, 200.0), at(84.0, 70.0)];
    if transmits {
        views.push(at(140.0, 30.0));
    }
    for wo in views {
        report
            .checks
            .push(samples_follow_values(double, wo, transmits));
        report.checks.push(density_is_normalised(double, wo, eta));
        report.checks.push(makes_no_light(double, wo));
        let twins = channels("weights", weights(single, wo, 63), weights(double, wo, 64));
        report
            .checks
            .push(check(format!("f32 samples {wo:?}"), twins));
    }
    let (a, b) = (at(20.0, 15.0), at(66.0, 215.0));
    report.checks.push(is_reciprocal(double, a, b, 1.0));
    report.checks.push(twin_values(single, double, a, b));
    if transmits {
        let below = at(150.0, 215.0);
        report.checks.push(is_reciprocal(double, a, below, eta));
        report.checks.push(twin_values(single, double, a, below));
    }
    report
}

/// The weights of samples, and values, put the same light into every cell of the sphere. Values are asked at samples
/// of the walk and at cosines, weighed by the balance heuristic with the lobe's density for the samples.
fn samples_follow_values(lobe: &(impl Bsdf<f64> + Sync), wo: Vec3<f64>, transmits: bool) -> Check {
    let sides = if transmits { 2.0 } else { 1.0 };
    let cosine = |wi: Vec3<f64>| wi.z.abs() / (sides * core::f64::consts::PI);
    let samples = moments(31, COUNT, |s| {
        let x = sampled(lobe, wo, s).filter(|x| !x.specular);
        in_cells::<CELLS>(x.map(|x| (x.wi, x.weight.r)), [RINGS, SECTORS])
    });
    let values = moments(32, COUNT, |s| {
        let placed = if s.next::<f64>() < 0.5 {
            let mut wi: Vec3<f64> = warp::cosine_hemisphere([s.next(), s.next()]);
            if transmits && s.next::<f64>() < 0.5 {
                wi.z = -wi.z;
            }
            let (f, pdf) = lobe.eval_pdf_random(wo, wi, RADIANCE, s);
            Some((wi, 2.0 * f.r / (pdf + cosine(wi))))
        } else {
            let x = sampled(lobe, wo, s).filter(|x| !x.specular);
            x.map(|x| (x.wi, 2.0 * x.weight.r * x.pdf / (x.pdf + cosine(x.wi))))
        };
        in_cells::<CELLS>(placed, [RINGS, SECTORS])
    });
    let cells = samples.iter().zip(&values).enumerate();
    #[expect(clippy::cast_precision_loss, reason = "far below 2^53 samples")]
    let one = 1.0 / COUNT as f64;
    let comparisons = cells.map(|(i, (a, b))| {
        // A cell where samples are rare has at least the variance of counts with weights of 1.
        let rare = b.mean() * one;
        let variance = a.variance_of_mean().max(rare) + b.variance_of_mean() + 1e-24;
        let p = two_sided_p((a.mean() - b.mean()) / variance.sqrt());
        let (a, b) = (a.mean(), b.mean());
        (p, format!("cell {i} has {a} by samples, {b} by values"))
    });
    check(format!("samples follow values {wo:?}"), comparisons)
}

/// The density for multiple importance sampling integrates to 1.
fn density_is_normalised(lobe: &impl Bsdf<f64>, wo: Vec3<f64>, eta: f64) -> Check {
    let width = 0.1;
    let mirrored = Peak {
        direction: vec3(-wo.x, -wo.y, wo.z),
        width,
    };
    let straight = Peak {
        direction: -wo,
        width,
    };
    let quadrature = Quadrature {
        relative_tolerance: 1e-5,
        peaks: vec![mirrored, straight],
        ..Quadrature::default()
    };
    let edges = [1.0, eta, 1.0 / eta].map(|e| wo.z.abs() * e);
    let integral = integrate_bands(&edges, &quadrature, |wi| [lobe.pdf(wo, wi)]).value[0];
    Check {
        name: format!("integral of pdf {wo:?}"),
        is_pass: (integral - 1.0).abs() < 1e-3,
        p_value: None,
        detail: format!("{integral}, not 1"),
    }
}

/// No channel of the mean weight is above 1.
fn makes_no_light(lobe: &(impl Bsdf<f64> + Sync), wo: Vec3<f64>) -> Check {
    // Radiance is compressed below the surface: importance is what is preserved.
    let energy = moments(5, COUNT, |s| {
        let u = [s.next(), s.next(), s.next()];
        let sample = lobe.sample_random(wo, u, Transport::Importance, s);
        sample.map_or([0.0; 3], |x| x.weight.to_array())
    });
    let over = energy.map(|m| {
        let beyond = (m.mean() - 1.0).max(0.0);
        let noise = m.variance_of_mean().sqrt() + 1e-9;
        (two_sided_p(beyond / noise), format!("albedo {}", m.mean()))
    });
    check(format!("energy {wo:?}"), over)
}

/// `f(a, b) = f(b, a)`, with the squared index of each side's medium for radiance.
fn is_reciprocal(lobe: &(impl Bsdf<f64> + Sync), a: Vec3<f64>, b: Vec3<f64>, eta: f64) -> Check {
    let scaled = |wo: Vec3<f64>, wi: Vec3<f64>, seed| {
        let index = if wo.z < 0.0 { eta } else { 1.0 };
        let scale = 1.0 / (wi.z.abs() * index * index);
        moments(seed, COUNT, |s| {
            let f_cos = lobe.eval_pdf_random(wo, wi, RADIANCE, s).0;
            (f_cos * scale).to_array()
        })
    };
    let pairs = channels("there and back", scaled(a, b, 41), scaled(b, a, 42));
    check(format!("reciprocity {a:?} {b:?}"), pairs)
}

/// Values of `f32` have the means of those of `f64`, and the same density.
fn twin_values(
    single: &(impl Bsdf<f32> + Sync),
    double: &(impl Bsdf<f64> + Sync),
    wo: Vec3<f64>,
    wi: Vec3<f64>,
) -> Check {
    let values = channels(
        "f cos",
        value(single, wo, wi, 61),
        value(double, wo, wi, 62),
    );
    let (p, q) = (
        f64::from(single.pdf(wo.cast(), wi.cast())),
        double.pdf(wo, wi),
    );
    let is_same = (p - q).abs() <= 1e-3 * q;
    let density = (f64::from(u8::from(is_same)), format!("pdf {p} and {q}"));
    check(format!("f32 values {wo:?} {wi:?}"), values.chain([density]))
}
