//! What the suites share: views, alphas, and a runner that gathers every failure.
#![allow(dead_code, reason = "each suite uses a part")]
#![allow(clippy::print_stdout, reason = "a suite says how much it checked")]

use std::path::PathBuf;
use std::time::Instant;

use rayon::prelude::*;
use specula_bsdf::math::{Real, Rgb, Stream, Vec3};
use specula_bsdf::{Alpha, Bsdf, BsdfSample, Transport};
use specula_stat::consistency::ConsistencyOptions;
use specula_stat::quadrature::direction;
use specula_stat::twin::TwinOptions;
use specula_stat::z_test::Moments;
use specula_stat::{DirectionSample, Plan, Report, Rng, Subject, consistency, twin};

/// Tests with chance in all suites together, rounded up: they share one significance.
pub(crate) const SUITE_TESTS: usize = 16_000;

/// Cosines of the views above the horizon.
pub(crate) const ABOVE: [f64; 5] = [1.0, 0.7, 0.3, 0.05, 0.005];
/// Cosines of the views below it: backfacing shading normals.
pub(crate) const BELOW: [f64; 3] = [-0.05, -0.3, -0.9];
/// Azimuths, radians.
pub(crate) const AZIMUTHS: [f64; 2] = [0.3, 2.1];

/// Alphas along x and y.
pub(crate) const ALPHAS: [(f64, f64); 9] = [
    (0.05, 0.05),
    (0.3, 0.3),
    (0.6, 0.6),
    (1.0, 1.0),
    (0.05, 0.5),
    (0.2, 0.8),
    (0.6, 1.0),
    (1.5, 1.5),
    (1.2, 3.0),
];

/// Relative indices of refraction, inside over outside.
pub(crate) const ETAS: [f64; 4] = [1.5, 1.0 / 1.5, 1.1, 2.4];

pub(crate) fn alpha((x, y): (f64, f64)) -> Alpha<f64> {
    Alpha::clamped(x, y)
}

pub(crate) fn alpha_f32((x, y): (f64, f64)) -> Alpha<f32> {
    #[expect(clippy::cast_possible_truncation, reason = "rounding is meant")]
    Alpha::clamped(x as f32, y as f32)
}

/// At `degrees` from the normal, in the plane at `azimuth` degrees.
pub(crate) fn at(degrees: f64, azimuth: f64) -> Vec3<f64> {
    direction(degrees.to_radians().cos(), azimuth.to_radians())
}

/// Zero but for `x` in the cell of its direction.
///
/// * `rings`: of equal solid angle times cosine, on each side of the surface; those below follow those above.
/// * `sectors`: of equal azimuth.
pub(crate) fn in_cells<const CELLS: usize>(
    placed: Option<(Vec3<f64>, f64)>,
    [rings, sectors]: [usize; 2],
) -> [f64; CELLS] {
    let index = |x: f64, n: usize| {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            clippy::cast_precision_loss,
            reason = "a small index"
        )]
        let i = (x * n as f64) as usize;
        i.min(n - 1)
    };
    let mut cells = [0.0; CELLS];
    if let Some((w, x)) = placed {
        let below = if w.z < 0.0 { rings } else { 0 };
        let ring = below + index(w.x * w.x + w.y * w.y, rings);
        let turn = w.y.atan2(w.x) / core::f64::consts::TAU + 0.5;
        cells[ring * sectors + index(turn, sectors)] = x;
    }
    cells
}

/// A sample of a lobe whose values are estimates.
pub(crate) fn sampled<T: Real>(
    lobe: &impl Bsdf<T>,
    wo: Vec3<f64>,
    s: &mut Stream,
) -> Option<BsdfSample<T>> {
    let u = [s.next(), s.next(), s.next()];
    lobe.sample_random(wo.cast(), u, Transport::Radiance, s)
}

/// Every cosine at every azimuth.
pub(crate) fn views(cosines: &[f64]) -> Vec<Vec3<f64>> {
    let at = |&cos_theta: &f64| AZIMUTHS.map(|phi| direction(cos_theta, phi));
    cosines.iter().flat_map(at).collect()
}

/// Every cosine once, the azimuths in turn.
pub(crate) fn few_views(cosines: &[f64]) -> Vec<Vec3<f64>> {
    let azimuths = AZIMUTHS.iter().cycle();
    cosines
        .iter()
        .zip(azimuths)
        .map(|(&cos_theta, &phi)| direction(cos_theta, phi))
        .collect()
}

/// Above and below the horizon.
pub(crate) fn both_sides() -> Vec<f64> {
    ABOVE.into_iter().chain(BELOW).collect()
}

/// Whether a Beckmann surface shows any facet to `wo`, to the precision of values.
///
/// From below, the visible area falls as `exp(-a^2)`, `a = |cot theta| / alpha` along the view:
/// beyond `a^2 = 60` it is less than 1e-26 of the surface.
pub(crate) fn beckmann_is_visible((x, y): (f64, f64), wo: &Vec3<f64>) -> bool {
    let a = wo.z / (x * wo.x).hypot(y * wo.y);
    wo.z > 0.0 || a * a < 60.0
}

/// The plan of every suite: one Sidak correction over all of them.
pub(crate) fn plan((x, y): (f64, f64)) -> Plan {
    Plan {
        significance: 0.01,
        tests: Some(SUITE_TESTS),
        sharpness: x.min(y).min(0.3),
        plot_folder: Some(PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("chi-square")),
        ..Plan::default()
    }
}

/// A sampler alone, without a BSDF: its weight is 1 and its `eval` the pdf.
pub(crate) fn sampler<'a>(
    pdf: impl Fn(Vec3<f64>, Vec3<f64>) -> f64 + Sync + Copy + 'a,
    sample: impl Fn(Vec3<f64>, [f64; 2]) -> Option<Vec3<f64>> + Sync + 'a,
) -> Subject<'a> {
    Subject::new(
        move |wo, wi| Rgb::splat(pdf(wo, wi)),
        pdf,
        move |wo, u| sample(wo, [u[1], u[2]]).map(|wi| DirectionSample::new(wi, Rgb::splat(1.0))),
    )
}

/// Proves every case, all cores at work, and panics with the failures.
pub(crate) fn prove_all<C: Sync>(
    suite: &str,
    cases: &[C],
    proof: impl Fn(&C) -> Report + Send + Sync,
) {
    let start = Instant::now();
    let reports: Vec<Report> = cases.par_iter().map(proof).collect();
    let checks: usize = reports.iter().map(|r| r.checks.len()).sum();
    let by_chance: usize = reports.iter().map(Report::chance_checks).sum();
    println!(
        "{suite}: {checks} checks ({by_chance} by chance) in {} cases, {:.1} s",
        cases.len(),
        start.elapsed().as_secs_f64()
    );
    assert!(
        reports.iter().all(|r| !r.checks.is_empty()),
        "a case without checks"
    );
    let failures: Vec<String> = reports
        .iter()
        .flat_map(|r| r.failures().map(move |c| format!("{}: {c}", r.subject)))
        .collect();
    for failure in failures.iter().take(40) {
        println!("{failure}");
    }
    assert!(
        failures.is_empty(),
        "{suite}: {} of {checks} checks fail",
        failures.len()
    );
}

/// Moments of each of `N` values, sampled in parallel by streams of fixed seeds.
pub(crate) fn moments<const N: usize>(
    seed: u64,
    n: u64,
    sample: impl Fn(&mut Stream) -> [f64; N] + Sync,
) -> [Moments; N] {
    (0..8_u64)
        .into_par_iter()
        .map(|chunk| {
            let mut stream = Stream::new((seed << 8 | chunk).wrapping_mul(0x2545_f491_4f6c_dd1d));
            let mut sums = [Moments::default(); N];
            for _ in 0..n / 8 {
                for (m, x) in sums.iter_mut().zip(sample(&mut stream)) {
                    m.push(x);
                }
            }
            sums
        })
        .collect::<Vec<_>>()
        .into_iter()
        .fold([Moments::default(); N], |a, b| {
            core::array::from_fn(|i| a[i].merge(b[i]))
        })
}

/// The difference of two means, in standard errors.
pub(crate) fn sigmas(a: &Moments, b: &Moments) -> f64 {
    let rounding = 1e-9 * (a.mean().abs() + b.mean().abs()) + 1e-12;
    (a.mean() - b.mean()) / (a.variance_of_mean() + b.variance_of_mean() + rounding.powi(2)).sqrt()
}

/// Every pair of alphas with every item.
pub(crate) fn with_alphas<C: Copy>(items: &[C]) -> Vec<(C, (f64, f64))> {
    items
        .iter()
        .flat_map(|&item| ALPHAS.map(|alphas| (item, alphas)))
        .collect()
}

/// Holds an `f32` lobe against its `f64` twin: values over directions, samples, and the weights of
/// the `f32` lobe against its own values.
pub(crate) fn twins(
    name: &str,
    single: &(impl Bsdf<f32> + Sync),
    double: &(impl Bsdf<f64> + Sync),
    transport: Transport,
) -> Report {
    twins_from(name, single, double, transport, -1.0)
}

/// [`twins`] for views whose cosine of the polar angle is not below `lowest`.
pub(crate) fn twins_from(
    name: &str,
    single: &(impl Bsdf<f32> + Sync),
    double: &(impl Bsdf<f64> + Sync),
    transport: Transport,
    lowest: f64,
) -> Report {
    let single = Subject::from_bsdf(single, transport);
    let double = Subject::from_bsdf(double, transport);
    let mut report = Report::new(name);
    let mut rng = Rng::from_name(name);
    let mut views = views(&both_sides());
    views.retain(|wo| wo.z >= lowest);
    let mut options = TwinOptions::default();
    options.lowest_cos_theta = options.lowest_cos_theta.max(lowest);
    report
        .checks
        .push(twin::test("", &single, &double, &views, &options, &mut rng));
    for &wo in &views {
        let view = format!("wo ({:.3}, {:.3}, {:.3})", wo.x, wo.y, wo.z);
        let near = [2e-3, 1e-3];
        report.checks.push(twin::samples(
            &view, &single, &double, wo, near, 2000, &mut rng,
        ));
        let at = ConsistencyOptions {
            samples: 2000,
            relative_tolerance: 1e-2,
        };
        let f32_view = format!("f32, {view}");
        report
            .checks
            .push(consistency::samples(&f32_view, &single, wo, &at, &mut rng));
        report.checks.push(consistency::directions(
            &f32_view, &single, wo, &at, &mut rng,
        ));
    }
    report
}
