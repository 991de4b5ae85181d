//! Means of every model of multiple bounces at a million evaluations each.
//!
//! First against the reference means (isotropic GGX, F = 1, forward in the plane): mean, standard
//! error, and standard errors from the reference, whose own error is counted. Then all unbiased
//! models against each other, over five alphas, GGX and Beckmann, F = 1 and gold: largest distance
//! of a model from the weighted mean of all, in standard errors of the difference; Wang's models,
//! which differ by design, as a ratio.
//!
//! Two minutes on two cores.
#![allow(clippy::print_stdout, reason = "an example reports on stdout")]

use rayon::prelude::*;
use specula_bsdf::bsdf::MultibounceConductor;
use specula_bsdf::fresnel::{Conductor as Index, Reflectance};
use specula_bsdf::math::{Stream, vec3};
use specula_bsdf::multibounce::MultibounceModel;
use specula_bsdf::ndf::{Beckmann, Ggx};
use specula_bsdf::vndf::VisibleNormals;
use specula_bsdf::{Alpha, Rgb, Vec3, metals};
use specula_stat::z_test::Moments;

/// `(theta_i, theta_o)` in degrees, then `(mean, error)` at alpha 0.5 and 1.
type Row = (f64, f64, (f64, f64), (f64, f64));

const REFERENCE: [Row; 6] = [
    (0.0, 0.0, (0.428_72, 9e-5), (0.366_38, 2e-4)),
    (0.0, 30.0, (0.310_09, 7e-5), (0.303_06, 1e-4)),
    (0.0, 60.0, (0.137_96, 5e-5), (0.147_79, 4e-5)),
    (30.0, 30.0, (0.459_65, 8e-5), (0.294_71, 1e-4)),
    (30.0, 60.0, (0.278_20, 6e-5), (0.152_11, 4e-5)),
    (60.0, 60.0, (0.563_73, 8e-5), (0.165_43, 4e-5)),
];

const ALPHAS: [(f64, f64); 5] = [(0.1, 0.1), (0.3, 0.3), (0.5, 0.5), (1.0, 1.0), (0.2, 0.8)];

fn at(degrees: f64, forward: f64) -> Vec3<f64> {
    let (s, c) = degrees.to_radians().sin_cos();
    vec3(s * forward, 0.0, c)
}

/// A million estimates of the blue channel, where gold's Fresnel term matters.
fn mean<N: VisibleNormals<f64> + Sync>(
    lobe: &MultibounceConductor<f64, N>,
    wo: Vec3<f64>,
    wi: Vec3<f64>,
) -> Moments {
    (0..100_u64)
        .into_par_iter()
        .map(|chunk| {
            let mut stream = Stream::new(chunk.wrapping_mul(0x2545_f491_4f6c_dd1d));
            let mut moments = Moments::default();
            moments.extend((0..10_000).map(|_| lobe.estimate(wo, wi, &mut stream).b));
            moments
        })
        .collect::<Vec<_>>()
        .into_iter()
        .fold(Moments::default(), Moments::merge)
}

fn white() -> Reflectance<f64> {
    Reflectance::Constant(Rgb::splat(1.0))
}

fn gold() -> Reflectance<f64> {
    metals::by_symbol("Au").map_or_else(white, |metal| {
        Reflectance::Conductor(Index {
            eta: Rgb::from(metal.eta),
            k: Rgb::from(metal.k),
        })
    })
}

fn main() {
    against_the_reference();
    println!("\nagainst each other: largest distance in standard errors; Wang over the mean");
    against_each_other("GGX", Ggx::new);
    against_each_other("Beckmann", Beckmann::new);
}

fn against_the_reference() {
    for model in MultibounceModel::ALL {
        for (i, o, half, one) in REFERENCE {
            for (alpha, (reference, error)) in [(0.5, half), (1.0, one)] {
                let lobe =
                    MultibounceConductor::new(Ggx::new(Alpha::isotropic(alpha)), white(), model);
                let m = mean(&lobe, at(i, 1.0), at(o, -1.0));
                let z = (m.mean() - reference) / (m.variance_of_mean() + error * error).sqrt();
                println!(
                    "{:<18} alpha {alpha:<3} {i:>2} to {o:>2}: {:.5} +- {:.5}, {z:+.2}",
                    model.name(),
                    m.mean(),
                    m.variance_of_mean().sqrt(),
                );
            }
        }
    }
}

fn against_each_other<N: VisibleNormals<f64> + Sync>(name: &str, ndf: impl Fn(Alpha<f64>) -> N) {
    let (wo, wi) = (at(30.0, 1.0), at(60.0, -1.0));
    let wi = vec3(wi.x * 0.8, wi.x * -0.6, wi.z);
    for (x, y) in ALPHAS {
        for (metal, reflectance) in [("F = 1", white()), ("gold", gold())] {
            let of = |model| {
                let lobe = MultibounceConductor::new(ndf(Alpha::clamped(x, y)), reflectance, model);
                mean(&lobe, wo, wi)
            };
            let (unbiased, biased): (Vec<MultibounceModel>, Vec<MultibounceModel>) =
                MultibounceModel::ALL
                    .into_iter()
                    .partition(|m| m.is_unbiased());
            let all: Vec<Moments> = unbiased.into_iter().map(of).collect();
            // Where no walk goes on, estimates are all the same: closed forms, equal to rounding.
            let variance = |m: &Moments| m.variance_of_mean().max(1e-24);
            let weight: f64 = all.iter().map(|m| 1.0 / variance(m)).sum();
            let centre = all.iter().map(|m| m.mean() / variance(m)).sum::<f64>() / weight;
            // The weighted mean holds each model itself: their covariance is its own variance.
            let distance =
                |m: &Moments| (m.mean() - centre).abs() / (variance(m) - 1.0 / weight).sqrt();
            let largest = all.iter().map(distance).fold(0.0, f64::max);
            let ratios: Vec<String> = biased
                .into_iter()
                .map(|model| format!("{:.3}", of(model).mean() / centre))
                .collect();
            println!(
                "{name:<8} alpha ({x}, {y}) {metal:<5}: mean {centre:.6} +- {:.6}, largest {largest:.2}, \
                 Wang {}",
                weight.sqrt().recip(),
                ratios.join(" and "),
            );
        }
    }
}
