//! Directions at the edge of what a type holds: cosines sampled by their logarithm down to 1e-38, on both sides, lights
//! opposite to the view in azimuth, beside it and anywhere, at every lobe and in both precisions. (Batches, at every
//! level: `values_are_those_of_f64_down_to_the_horizon` in specula-bsdf/tests/batch_accuracy.rs.)
#![allow(clippy::print_stdout, reason = "the suite says what it tried")]

mod common;
mod lobes;

use std::f64::consts::PI;

use rayon::prelude::*;
use specula_bsdf::bsdf::{Lobe, MultibounceConductor};
use specula_bsdf::fresnel::Reflectance;
use specula_bsdf::math::{Real, Rgb, Stream, Vec3, vec3, warp};
use specula_bsdf::multibounce::MultibounceModel;
use specula_bsdf::ndf::Ggx;
use specula_bsdf::{Alpha, Bsdf, Transport};
use specula_testing::horizon::{self, is_compared, roundings};

use lobes::{examples, row};

const ALPHAS: [(f64, f64); 8] = [
    (1e-4, 1e-4),
    (1e-3, 0.1),
    (0.1, 0.1),
    (0.5, 0.5),
    (1.0, 1.0),
    (0.05, 1.0),
    (2.0, 0.3),
    (10.0, 10.0),
];
/// Pairs of directions of each lobe.
const PAIRS: usize = 20_000;
/// Absolute tolerance, in 1/sr: losses of smooth surfaces are small differences of tables.
const ABSOLUTE: f64 = 2e-4;

fn direction(s: &mut Stream, azimuth: [f32; 2]) -> Vec3<f32> {
    horizon::direction((s.next(), s.next()), azimuth).into()
}

fn azimuth(s: &mut Stream) -> [f32; 2] {
    // A quarter of them along an axis, where a component vanishes.
    match (s.next::<f32>() * 16.0).floor() {
        0.0 => [1.0, 0.0],
        1.0 => [0.0, 1.0],
        2.0 => [-1.0, 0.0],
        3.0 => [1.0, 1e-20],
        _ => {
            let (sin, cos) = s.next::<f32>().sin_cos_turns();
            [cos, sin]
        }
    }
}

/// A view and a light.
fn pair(s: &mut Stream) -> [Vec3<f32>; 2] {
    let a = azimuth(s);
    let wo = direction(s, a);
    let b = match (s.next::<f32>() * 4.0).floor() {
        0.0 | 1.0 => a.map(|x| -x),
        2.0 => a,
        _ => azimuth(s),
    };
    [wo, direction(s, b)]
}

/// What was tried, and what was found.
#[derive(Clone, Debug, Default)]
struct Found {
    tried: usize,
    compared: usize,
    /// Largest distance to `f64`, as a share of the tolerance, and where.
    worst: (f64, String),
    faults: Vec<String>,
}

impl Found {
    fn merge(mut self, other: Self) -> Self {
        self.tried += other.tried;
        self.compared += other.compared;
        if other.worst.0 > self.worst.0 {
            self.worst = other.worst;
        }
        self.faults.extend(other.faults);
        self
    }
}

fn is_good<T: Real>(f: Rgb<T>, pdf: T) -> bool {
    let all = [f.r, f.g, f.b, pdf];
    all.into_iter().all(|x| x.is_finite() && x >= T::ZERO)
}

/// `f cos` and density, of walks too.
fn evaluate<T: Real>(lobe: &Lobe<T>, [wo, wi]: [Vec3<T>; 2]) -> (Rgb<T>, T) {
    lobe.eval_pdf_random(wo, wi, Transport::Radiance, &mut Stream::new(7))
}

/// How far `f64` values lie apart where each component of the directions is rounded once more: no `f32` knows better.
fn uncertainty(lobe: &Lobe<f64>, at: [Vec3<f64>; 2], value: [f64; 4]) -> [f64; 4] {
    let mut most = [0.0_f64; 4];
    for moved in roundings(at.map(Vec3::to_array)) {
        let (f, pdf) = evaluate(lobe, moved.map(Vec3::from));
        for (most, (a, b)) in most
            .iter_mut()
            .zip([f.r, f.g, f.b, pdf].into_iter().zip(value))
        {
            *most = most.max((a - b).abs());
        }
    }
    most
}

fn sweep(name: &str, single: &Lobe<f32>, double: &Lobe<f64>, seed: u64) -> Found {
    let mut found = Found::default();
    let mut s = Stream::new(seed);
    let is_stochastic = Bsdf::<f64>::is_stochastic(double);
    for _ in 0..if is_stochastic { PAIRS / 10 } else { PAIRS } {
        let at = pair(&mut s);
        let (f, pdf) = evaluate(single, at);
        let wide = at.map(Vec3::cast::<f64>);
        let (g, qdf) = evaluate(double, wide);
        found.tried += 1;
        if !is_good(f, pdf) || !is_good(g, qdf) {
            found.faults.push(format!(
                "{name} {at:?}: f32 {f:?} {pdf:e}, f64 {g:?} {qdf:e}"
            ));
            continue;
        }
        if is_stochastic || !is_compared(wide.map(Vec3::to_array)) {
            continue;
        }
        found.compared += 1;
        let values = [g.r, g.g, g.b, qdf];
        let uncertain = uncertainty(double, wide, values);
        let singles = [f.r, f.g, f.b, pdf].map(f64::from);
        for ((a, b), uncertain) in singles.into_iter().zip(values).zip(uncertain) {
            let off = (a - b).abs() / (1e-3 * b.abs() + 4.0 * uncertain + ABSOLUTE);
            if off > found.worst.0 {
                found.worst = (off, format!("{name} {at:?}: f32 {a:e}, f64 {b:e}"));
            }
        }
        let u = [s.next(), s.next(), s.next()];
        let sample = single.sample(at[0], u, Transport::Radiance);
        if let Some(sample) = sample.filter(|x| !is_good(x.weight, x.pdf) || !x.wi.is_finite()) {
            found
                .faults
                .push(format!("{name} {:?} {u:?}: {sample:?}", at[0]));
        }
    }
    found
}

#[test]
fn values_are_finite_and_those_of_f64_down_to_the_horizon() {
    let cases: Vec<_> = ALPHAS
        .into_iter()
        .flat_map(|alpha| {
            let singles = examples::<f32>(alpha);
            let doubles = examples::<f64>(alpha);
            singles
                .into_iter()
                .zip(doubles)
                .map(move |(s, d)| (alpha, s.lobe, d.lobe))
        })
        .collect();
    let found = cases
        .par_iter()
        .enumerate()
        .map(|(i, (alpha, single, double))| {
            let name = format!("{} ({i}) {alpha:?}", row(double));
            sweep(&name, single, double, i as u64)
        })
        .reduce(Found::default, Found::merge);
    println!(
        "{} pairs of directions, {} compared, at most {:.3} of the tolerance ({}), {} faults",
        found.tried,
        found.compared,
        found.worst.0,
        found.worst.1,
        found.faults.len()
    );
    let first: Vec<_> = found.faults.iter().take(20).collect();
    assert!(
        first.is_empty(),
        "{} faults: {first:#?}",
        found.faults.len()
    );
    assert!(found.worst.0 <= 1.0, "{:?}", found.worst);
    assert!(found.compared > 400_000, "{}", found.compared);
}

/// Walks from both ends weigh each other by cosines that the rates have too: what is seen along the horizon is bounded.
#[test]
fn bounces_seen_along_the_horizon_have_no_fireflies() {
    let white = Reflectance::Constant(Rgb::WHITE);
    for alpha in [0.1_f32, 0.5, 1.0] {
        let ggx = Ggx::new(Alpha::isotropic(alpha));
        let lobe = MultibounceConductor::new(ggx, white, MultibounceModel::default());
        for z in [1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 1e-20, 1e-30, 1e-38] {
            let wo = vec3(0.6, 0.8, z);
            let mut s = Stream::new(11);
            let count = 20_000_u16;
            let mut sum = 0.0;
            for _ in 0..count {
                let wi = warp::cosine_hemisphere([s.next(), s.next()]);
                let f_cos = lobe
                    .eval_pdf_random(wo, wi, Transport::Radiance, &mut s)
                    .0
                    .g;
                sum += f64::from(f_cos / wi.z) * PI;
            }
            let albedo = sum / f64::from(count);
            assert!(
                (0.3..1.5).contains(&albedo),
                "alpha {alpha}, cosine {z:e}: {albedo}"
            );
        }
    }
}
