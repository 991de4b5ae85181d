//! Tables: what is rejected, and variances against bounded caps, for independent and for
//! stratified random numbers.

use sobol_burley::sample_4d;
use specula_bsdf::Alpha;
use specula_bsdf::math::Vec3;
use specula_bsdf::ndf::{Ggx, Masking, Ndf};
use specula_bsdf::vndf::{self, Sampler};

use super::mirror::Cone;
use super::{r2, view};

/// Radiance by direction.
type Radiance = fn(Vec3<f64>) -> f64;

const POINTS: u32 = 4096;
const SAMPLERS: [Sampler; 3] = [Sampler::Cap, Sampler::Bounded, Sampler::Exact];
const ISOTROPIC: &[(f64, f64)] = &[(0.05, 0.05), (0.1, 0.1), (0.2, 0.2), (0.4, 0.4), (0.8, 0.8)];
const ANISOTROPIC: &[(f64, f64)] = &[
    (0.05, 0.2),
    (0.05, 0.5),
    (0.05, 1.0),
    (0.1, 0.3),
    (0.1, 0.8),
    (0.2, 0.8),
    (0.2, 1.0),
    (0.3, 0.6),
    (0.6, 1.0),
];

/// Uniform, and growing with the height from 0 and from 1.
const ENVIRONMENTS: [(&str, Radiance); 3] = [
    ("uniform", |_| 1.0),
    ("cosine", |wi| wi.z),
    ("linear", |wi| 1.0 + wi.z),
];

fn alpha((x, y): (f64, f64)) -> Alpha<f64> {
    Alpha::clamped(x, y)
}

fn norms(alpha: Alpha<f64>, wo: Vec3<f64>) -> [f64; 3] {
    SAMPLERS.map(|sampler| Ggx::new(alpha).reflection_norm(sampler, wo))
}

/// Polar angles 0 to 85 degrees; azimuths over a quarter where the alphas differ.
fn views(alphas: (f64, f64)) -> Vec<Vec3<f64>> {
    let azimuths: &[f64] = if alphas.0 == alphas.1 {
        &[0.0]
    } else {
        &[0.0, 30.0, 60.0, 90.0]
    };
    let thetas = (0..18).map(|i| 5.0 * f64::from(i));
    thetas
        .flat_map(|theta| azimuths.iter().map(move |&phi| view(theta, phi)))
        .collect()
}

/// Shares of rejected reflections: means over the hemisphere of views, `1 - N_exact / N`.
pub(super) fn rejected() {
    println!("reflections rejected, %, mean over views     cap  bounded    exact");
    for alphas in [
        (0.2, 0.8),
        (0.05, 1.0),
        (0.6, 1.0),
        (1.0, 1.5),
        (0.1, 0.8),
        (0.6, 0.6),
    ] {
        let mut sums = [0.0; 3];
        for i in 0..POINTS {
            let [height, turn] = r2(i);
            let wo = view(height.acos().to_degrees(), 360.0 * turn);
            let n = norms(alpha(alphas), wo);
            let sampled = vndf::exact::sample_reflection(alpha(alphas), wo, r2(i + POINTS));
            sums[0] += 1.0 - n[2] / n[0];
            sums[1] += 1.0 - n[2] / n[1];
            sums[2] += f64::from(u8::from(sampled.is_none()));
        }
        let [cap, bounded, exact] = sums.map(|s| 100.0 * s / f64::from(POINTS));
        let name = format!("{alphas:?}");
        println!("  {name:<38} {cap:>8.1} {bounded:>8.1} {exact:>8.2}");
    }
}

/// Variances of one sample, exact over the others': geometric means over views and alphas.
///
/// The second moment is `N` times an integral that all samplers share.
pub(super) fn independent() {
    println!("variance of one sample, exact / other        uniform   cosine   linear");
    for (name, list) in [("isotropic", ISOTROPIC), ("anisotropic", ANISOTROPIC)] {
        for (other, compared) in ["cap", "bounded"].into_iter().enumerate() {
            let ratios = ENVIRONMENTS.map(|(_, radiance)| {
                geometric_mean(list, |alphas, wo| {
                    let n = norms(alpha(alphas), wo);
                    let (mean, square) = moments(alpha(alphas), wo, radiance);
                    let mine = square - mean * mean;
                    mine / (square * n[other] / n[2] - mean * mean)
                })
            });
            let [a, b, c] = ratios;
            println!("  {name:<12} / {compared:<25} {a:>8.2} {b:>8.2} {c:>8.2}");
        }
    }
}

/// Mean and mean square of the exact sampler's weight times the radiance, for a white metal.
fn moments(alpha: Alpha<f64>, wo: Vec3<f64>, radiance: Radiance) -> (f64, f64) {
    let n = vndf::exact::norm(alpha, wo);
    let (mut sum, mut squares) = (0.0, 0.0);
    for i in 0..POINTS {
        if let Some(wi) = vndf::exact::sample_reflection(alpha, wo, r2(i)) {
            let value = n * lit(alpha, wo, wi) * radiance(wi);
            sum += value;
            squares += value * value;
        }
    }
    (sum / f64::from(POINTS), squares / f64::from(POINTS))
}

fn lit(alpha: Alpha<f64>, wo: Vec3<f64>, wi: Vec3<f64>) -> f64 {
    Ggx::new(alpha).g2_over_cos(Masking::HeightCorrelated, wo, wi)
}

/// Errors of 64 Owen-scrambled Sobol points, relative to bounded caps: the exact sampler, and the
/// same density sampled by mirroring with a third number.
pub(super) fn stratified() {
    println!("mean square error of 64 Sobol points / bounded   uniform   cosine   linear");
    for (name, list) in [("isotropic", ISOTROPIC), ("anisotropic", ANISOTROPIC)] {
        let mut table = [[0.0; 3]; 2];
        for (column, (_, radiance)) in ENVIRONMENTS.into_iter().enumerate() {
            for (row, which) in [SampledBy::Exact, SampledBy::Mirrored]
                .into_iter()
                .enumerate()
            {
                table[row][column] = geometric_mean(list, |alphas, wo| {
                    let a = alpha(alphas);
                    let cone = Cone::new(a, wo);
                    let truth = moments(a, wo, radiance).0;
                    let error = |which| error(which, a, wo, &cone, radiance, truth);
                    error(which) / error(SampledBy::Bounded)
                });
            }
        }
        for (row, label) in table.into_iter().zip(["exact", "mirrored"]) {
            let [a, b, c] = row;
            println!("  {name:<12} {label:<33} {a:>8.2} {b:>8.2} {c:>8.2}");
        }
    }
}

#[derive(Clone, Copy)]
enum SampledBy {
    Exact,
    Mirrored,
    Bounded,
}

fn error(
    which: SampledBy,
    alpha: Alpha<f64>,
    wo: Vec3<f64>,
    cone: &Cone,
    radiance: Radiance,
    truth: f64,
) -> f64 {
    let (points, scrambles) = (64, 24);
    let sampler = match which {
        SampledBy::Bounded => Sampler::Bounded,
        SampledBy::Exact | SampledBy::Mirrored => Sampler::Exact,
    };
    let n = Ggx::new(alpha).reflection_norm(sampler, wo);
    let mut squares = 0.0;
    for seed in 0..scrambles {
        let mut sum = 0.0;
        for i in 0..points {
            let u = sample_4d(i, 0, seed * 7919 + 1).map(f64::from);
            let wi = match which {
                SampledBy::Bounded => vndf::bounded::sample_reflection(alpha, wo, [u[0], u[1]]),
                SampledBy::Exact => vndf::exact::sample_reflection(alpha, wo, [u[0], u[1]]),
                SampledBy::Mirrored => Some(cone.sample([u[0], u[1], u[2]])),
            };
            if let Some(wi) = wi.filter(|w| w.z > 0.0) {
                sum += n * lit(alpha, wo, wi) * radiance(wi);
            }
        }
        squares += (sum / f64::from(points) - truth).powi(2);
    }
    squares / f64::from(scrambles)
}

fn geometric_mean(list: &[(f64, f64)], ratio: impl Fn((f64, f64), Vec3<f64>) -> f64) -> f64 {
    let mut sum = 0.0;
    let mut count = 0.0;
    for &alphas in list {
        for wo in views(alphas) {
            sum += ratio(alphas, wo).ln();
            count += 1.0;
        }
    }
    f64::exp(sum / count)
}
