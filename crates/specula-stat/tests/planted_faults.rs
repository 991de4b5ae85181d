//! Tests of the tests: each fault that a BSDF or a renderer may have, planted into right code,
//! must turn the matching check red, and the check must be green without it.

mod common;
mod faults_of_colour;
mod textbook;

use std::f64::consts::PI;

use common::alpha;
use specula_bsdf::bsdf::{RoughConductor, RoughDielectric};
use specula_bsdf::fresnel::Reflectance;
use specula_bsdf::ndf::{Ggx, Masking, Ndf};
use specula_bsdf::vndf::{self, Sampler};
use specula_bsdf::{Bsdf, Rgb, Transport, Vec3};
use specula_stat::image::{NoisyImage, compare};
use specula_stat::quadrature::direction;
use specula_stat::reciprocity::Domain;
use specula_stat::twin::TwinOptions;
use specula_stat::{DirectionSample, Plan, Report, Rng, Subject, prove, twin};

const ALPHAS: (f64, f64) = (0.3, 0.6);

fn metal() -> RoughConductor<f64> {
    RoughConductor::new(
        Ggx::new(alpha(ALPHAS)),
        Reflectance::Constant(Rgb::splat(0.9)),
    )
    .with_sampler(Sampler::Cap)
}

fn view() -> Vec3<f64> {
    direction(0.5, 0.3)
}

fn half(wo: Vec3<f64>, wi: Vec3<f64>) -> Vec3<f64> {
    (wo + wi).normalize()
}

/// The right metal, as closures to be spoiled.
fn eval(wo: Vec3<f64>, wi: Vec3<f64>) -> Rgb<f64> {
    metal().eval(wo, wi, Transport::Radiance)
}

fn pdf(wo: Vec3<f64>, wi: Vec3<f64>) -> f64 {
    metal().pdf(wo, wi)
}

fn sample(wo: Vec3<f64>, u: [f64; 3]) -> Option<DirectionSample> {
    let sample = metal().sample(wo, u, Transport::Radiance)?;
    Some(DirectionSample::new(sample.wi, sample.weight))
}

fn check(subject: &Subject) -> Report {
    prove("planted", subject, &[view()], &Plan::default())
}

/// That the checks named fail. The report of the right metal passes (its own test).
fn assert_fails(report: &Report, names: &[&str]) {
    for name in names {
        assert!(
            report.failures().any(|c| c.name.starts_with(name)),
            "'{name}' did not catch it: {report}"
        );
    }
}

#[test]
fn without_a_fault_all_is_green() {
    let report = check(&Subject::new(eval, pdf, sample));
    assert!(report.is_pass(), "{report}");
    assert_eq!(report.checks.len(), 6);
}

#[test]
fn dropped_jacobian() {
    let wrong = |wo: Vec3<f64>, wi| pdf(wo, wi) * 4.0 * wo.dot(half(wo, wi)).abs();
    let report = check(&Subject::new(eval, wrong, sample));
    assert_fails(&report, &["chi-square", "integral of pdf", "weight"]);
}

#[test]
fn g1_in_place_of_g2() {
    let ggx = Ggx::new(alpha(ALPHAS));
    let wrong = |wo, u| {
        let sampled = sample(wo, u)?;
        // G2/G1 is right.
        let ratio = ggx.g1(sampled.wi) * ggx.g1(wo) / ggx.g2_correlated(wo, sampled.wi);
        Some(DirectionSample {
            weight: sampled.weight * ratio,
            ..sampled
        })
    };
    let report = check(&Subject::new(eval, pdf, wrong));
    assert_fails(&report, &["weight", "furnace"]);
}

#[test]
fn pdf_without_its_g1() {
    let ggx = Ggx::new(alpha(ALPHAS));
    let wrong = |wo, wi| pdf(wo, wi) / ggx.g1(wo);
    let report = check(&Subject::new(eval, wrong, sample));
    assert_fails(&report, &["chi-square", "integral of pdf", "weight"]);
}

#[test]
fn eta_upside_down() {
    let ggx = Ggx::new(alpha(ALPHAS));
    let right = RoughDielectric::new(ggx, 1.5);
    let flipped = RoughDielectric::new(ggx, 1.0 / 1.5);
    let radiance = Transport::Radiance;
    let plan = Plan {
        eta: 1.5,
        reciprocity: Domain::Everywhere,
        relative_tolerance: 1e-8,
        ..Plan::default()
    };
    let subject = Subject::from_bsdf(&right, radiance);
    let report = prove("right", &subject, &[view()], &plan);
    assert!(report.is_pass(), "{report}");
    // In the sampler alone.
    let subject = Subject::new(
        |wo, wi| right.eval(wo, wi, radiance),
        |wo, wi| right.pdf(wo, wi),
        |wo, u| {
            let sample = flipped.sample(wo, u, radiance)?;
            Some(DirectionSample::new(sample.wi, sample.weight))
        },
    );
    let report = prove("sampler", &subject, &[view()], &plan);
    assert_fails(&report, &["chi-square", "weight", "furnace"]);
    // Everywhere: nothing but the exchange of directions can tell.
    let subject = Subject::from_bsdf(&flipped, radiance);
    let report = prove("everywhere", &subject, &[view()], &plan);
    assert_fails(&report, &["reciprocity"]);
}

#[test]
fn a_sampler_that_takes_one_in_a_hundred_from_elsewhere() {
    let wrong = |wo, u: [f64; 3]| {
        let wi = if u[0] < 0.01 {
            direction(u[1], 2.0 * PI * u[2])
        } else {
            sample(wo, u)?.wi
        };
        Some(DirectionSample::new(wi, eval(wo, wi) / pdf(wo, wi)))
    };
    let plan = Plan {
        samples: 1_000_000,
        ..Plan::default()
    };
    let report = prove("planted", &Subject::new(eval, pdf, wrong), &[view()], &plan);
    assert_fails(&report, &["chi-square"]);
    let report = prove("right", &Subject::new(eval, pdf, sample), &[view()], &plan);
    assert!(report.is_pass(), "{report}");
}

#[test]
fn a_sampler_whose_numbers_stop_one_per_cent_short() {
    let wrong = |wo, u: [f64; 3]| sample(wo, [u[0], 0.99 * u[1], u[2]]);
    assert_fails(&check(&Subject::new(eval, pdf, wrong)), &["chi-square"]);
}

#[test]
fn weights_one_per_cent_too_large() {
    let wrong = |wo, u| {
        let sampled = sample(wo, u)?;
        Some(DirectionSample {
            weight: sampled.weight * 1.01,
            ..sampled
        })
    };
    let report = check(&Subject::new(eval, pdf, wrong));
    assert_fails(&report, &["weight", "furnace"]);
}

#[test]
fn a_nan_in_eval() {
    let wrong = |wo: Vec3<f64>, wi: Vec3<f64>| {
        let value = eval(wo, wi);
        // As a square root of a rounded-off negative number would.
        if wi.z > 0.98 { value * f64::NAN } else { value }
    };
    let report = check(&Subject::new(wrong, pdf, sample));
    assert_fails(&report, &["weight", "finite", "reciprocity", "furnace"]);
}

#[test]
fn a_nan_in_a_sample() {
    let wrong = |wo, u: [f64; 3]| {
        let sampled = sample(wo, u)?;
        let wi = if u[1] < 1e-3 {
            sampled.wi * f64::NAN
        } else {
            sampled.wi
        };
        Some(DirectionSample { wi, ..sampled })
    };
    let report = check(&Subject::new(eval, pdf, wrong));
    assert_fails(&report, &["chi-square", "weight"]);
}

#[test]
fn no_test_of_the_horizon_in_the_sampler() {
    let wrong = |wo: Vec3<f64>, u: [f64; 3]| {
        let wm = vndf::cap::sample_wm(alpha(ALPHAS), wo, [u[1], u[2]]);
        Some(DirectionSample::new(vndf::reflect(wo, wm), Rgb::splat(0.5)))
    };
    let report = check(&Subject::new(eval, pdf, wrong));
    assert_fails(
        &report,
        &["chi-square", "integral of pdf", "weight", "furnace"],
    );
}

#[test]
fn no_test_of_the_horizon_in_the_pdf() {
    let ggx = Ggx::new(alpha(ALPHAS));
    let wrong = |wo: Vec3<f64>, wi| {
        let wm = half(wo, wi);
        ggx.d_visible(wo, wm) / (4.0 * wo.dot(wm))
    };
    let report = check(&Subject::new(eval, wrong, sample));
    assert_fails(&report, &["chi-square", "integral of pdf"]);
}

#[test]
fn bounded_samples_with_the_pdf_of_caps() {
    let bounded = metal().with_sampler(Sampler::Bounded);
    let wrong = |wo, u| {
        let sample = bounded.sample(wo, u, Transport::Radiance)?;
        Some(DirectionSample::new(sample.wi, sample.weight))
    };
    let report = check(&Subject::new(eval, pdf, wrong));
    assert_fails(&report, &["chi-square", "integral of pdf", "weight"]);
}

#[test]
fn exact_samples_with_the_norm_of_bounded_caps() {
    let ggx = Ggx::new(alpha(ALPHAS));
    let right = metal().with_sampler(Sampler::Exact);
    let ratio =
        |wo| ggx.reflection_norm(Sampler::Exact, wo) / ggx.reflection_norm(Sampler::Bounded, wo);
    let sample = |wo, u| {
        let sample = right.sample(wo, u, Transport::Radiance)?;
        Some(DirectionSample::new(sample.wi, sample.weight))
    };
    let density = |wo, wi| right.pdf(wo, wi);
    let report = check(&Subject::new(eval, density, sample));
    assert!(report.is_pass(), "{report}");
    let wrong = |wo, wi| density(wo, wi) * ratio(wo);
    let report = check(&Subject::new(eval, wrong, sample));
    assert_fails(&report, &["chi-square", "integral of pdf", "weight"]);
}

/// The exact sampler moves a point whose chord has ended to the opposite chord. Here such points are
/// lost, and some more whose two chords lie on one side of the plane of incidence.
#[test]
fn exact_samples_that_stop_at_the_end_of_their_chord() {
    let right = metal().with_sampler(Sampler::Exact);
    let wrong = |wo: Vec3<f64>, u: [f64; 3]| {
        let sample = right.sample(wo, u, Transport::Radiance)?;
        let opposite = right.sample(wo, [u[0], u[1], 1.0 - u[2]], Transport::Radiance)?;
        // The same point of two opposite azimuths: one of them has changed sides.
        let side = |w: Vec3<f64>| (wo.x * w.y - wo.y * w.x) > 0.0;
        (side(sample.wi) != side(opposite.wi))
            .then(|| DirectionSample::new(sample.wi, sample.weight))
    };
    let report = check(&Subject::new(eval, |wo, wi| right.pdf(wo, wi), wrong));
    assert_fails(&report, &["chi-square"]);
}

#[test]
fn masking_of_one_direction_only() {
    let ggx = Ggx::new(alpha(ALPHAS));
    let lobe = metal().with_masking(Masking::Separable);
    let wrong = |wo, wi: Vec3<f64>| {
        let value = lobe.eval(wo, wi, Transport::Radiance);
        if wi.z > 0.0 {
            value / ggx.g1(wi)
        } else {
            value
        }
    };
    assert_fails(&check(&Subject::new(wrong, pdf, sample)), &["reciprocity"]);
}

#[test]
fn cancellation_in_f32() {
    let ggx32 = Ggx::new(common::alpha_f32((0.01, 0.01)));
    let ggx = Ggx::new(alpha((0.01, 0.01)));
    let density = |d: f64| Rgb::splat(d);
    let sample = |wo: Vec3<f64>, u: [f64; 3]| {
        let wm = vndf::cap::sample_wm(alpha((0.01, 0.01)), wo, [u[1], u[2]]);
        Some(DirectionSample::new(wm, Rgb::splat(1.0)))
    };
    let double = Subject::new(
        |wo, wm| density(ggx.d_visible(wo, wm)),
        |wo, wm| ggx.d_visible(wo, wm),
        sample,
    );
    let single = |wo: Vec3<f64>, wm: Vec3<f64>| -> f64 {
        ggx32.d_visible(wo.cast::<f32>(), wm.cast::<f32>()).into()
    };
    // The textbook's form of the visible area, which cancels below the horizon.
    let cancelling = |wo: Vec3<f64>, wm: Vec3<f64>| -> f64 {
        let w = wo.cast::<f32>();
        let (x, y) = (0.01 * w.x, 0.01 * w.y);
        let area = 0.5 * (w.z + (x * x + y * y + w.z * w.z).sqrt());
        let area = area.max(f32::MIN_POSITIVE);
        (ggx32.d(wm.cast()) * w.dot(wm.cast()).max(0.0) / area).into()
    };
    let views: Vec<_> = [0.7, -0.3, -0.9].map(|c| direction(c, 0.3)).to_vec();
    let run = |subject: &Subject| {
        let options = TwinOptions::default();
        twin::test("", subject, &double, &views, &options, &mut Rng::new(1))
    };
    let right = run(&Subject::new(|a, b| density(single(a, b)), single, sample));
    assert!(right.is_pass, "{right}");
    let wrong = run(&Subject::new(
        |a, b| density(cancelling(a, b)),
        cancelling,
        sample,
    ));
    assert!(!wrong.is_pass, "{wrong}");
}

/// A gradient of 64 x 64 pixels with noise of 20 %: estimates and their variances.
fn picture(seed: u64) -> (Vec<f64>, Vec<f64>) {
    let mut rng = Rng::new(seed);
    (0..64 * 64)
        .map(|i| {
            let value = 0.2 + f64::from(i) / 4096.0;
            // Twelve uniform random numbers make a normal one.
            let normal = (0..12).map(|_| rng.uniform()).sum::<f64>() - 6.0;
            let deviation = 0.2 * value;
            (value + deviation * normal, deviation * deviation)
        })
        .unzip()
}

/// The comparison with a right picture.
fn compare_pictures(spoil: impl Fn(&mut Vec<f64>)) -> Report {
    let (a, variance_a) = picture(1);
    let (mut b, variance_b) = picture(2);
    spoil(&mut b);
    let image = |mean, variance| {
        let width = 64;
        NoisyImage {
            width,
            mean,
            variance,
        }
    };
    compare(&image(&a, &variance_a), &image(&b, &variance_b), 8, 0.01)
}

#[test]
fn pictures_without_a_fault_are_equal() {
    let report = compare_pictures(|_| {});
    assert!(report.is_pass(), "{report}");
}

#[test]
fn one_wrong_pixel() {
    let report = compare_pictures(|b| b[20 * 64 + 31] *= 4.0);
    assert_fails(&report, &["image pixels"]);
    let report = compare_pictures(|b| b[20 * 64 + 31] = f64::NAN);
    assert_fails(&report, &["image pixels", "image tiles", "image mean"]);
}

#[test]
fn one_wrong_tile() {
    let report = compare_pictures(|b| {
        for y in 16..24 {
            for x in 40..48 {
                b[y * 64 + x] *= 1.25;
            }
        }
    });
    assert_fails(&report, &["image tiles"]);
    // What a test of pixels alone would not have seen.
    assert!(
        !report.failures().any(|c| c.name == "image pixels"),
        "{report}"
    );
}

#[test]
fn six_per_cent_too_bright_everywhere() {
    let report = compare_pictures(|b| b.iter_mut().for_each(|v| *v *= 1.06));
    assert_fails(&report, &["image mean"]);
    assert!(
        !report.failures().any(|c| c.name == "image pixels"),
        "{report}"
    );
}
