//! Means of every model of multiple bounces at a million evaluations each, against the reference.
//!
//! Isotropic GGX, F = 1, f64, forward in the plane. Columns: mean, standard error, and standard
//! errors from the reference (whose own error is counted).
#![allow(clippy::print_stdout, reason = "an example reports on stdout")]

use rayon::prelude::*;
use specula_bsdf::fresnel::Reflectance;
use specula_bsdf::math::{Stream, vec3};
use specula_bsdf::multibounce::{Conductor, Model};
use specula_bsdf::ndf::Ggx;
use specula_bsdf::{Alpha, Rgb, Vec3};
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

fn at(degrees: f64, forward: f64) -> Vec3<f64> {
    let (s, c) = degrees.to_radians().sin_cos();
    vec3(s * forward, 0.0, c)
}

fn mean(lobe: &Conductor<f64>, wo: Vec3<f64>, wi: Vec3<f64>) -> Moments {
    (0..100_u64)
        .into_par_iter()
        .map(|chunk| {
            let mut stream = Stream::new(chunk.wrapping_mul(0x2545_f491_4f6c_dd1d));
            let mut moments = Moments::default();
            moments.extend((0..10_000).map(|_| lobe.estimate(wo, wi, &mut stream).r));
            moments
        })
        .collect::<Vec<_>>()
        .into_iter()
        .fold(Moments::default(), Moments::merge)
}

fn main() {
    for model in Model::ALL {
        for (i, o, half, one) in REFERENCE {
            for (width, (reference, error)) in [(0.5, half), (1.0, one)] {
                let white = Reflectance::Constant(Rgb::splat(1.0));
                let lobe = Conductor::new(Ggx::new(Alpha::isotropic(width)), white, model);
                let m = mean(&lobe, at(i, 1.0), at(o, -1.0));
                let z = (m.mean() - reference) / (m.variance_of_mean() + error * error).sqrt();
                println!(
                    "{:<18} alpha {width:<3} {i:>2} to {o:>2}: {:.5} +- {:.5}, {z:+.2}",
                    model.name(),
                    m.mean(),
                    m.variance_of_mean().sqrt(),
                );
            }
        }
    }
}
