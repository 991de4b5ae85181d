//! What `cargo xtask instructions` counts under valgrind: `-- KERNEL LEVEL` runs one kernel over
//! 1024 elements inside `counted`, and prints how many those were.
//!
//! LEVEL is `scalar`, `baseline` or `avx2` (valgrind knows no AVX-512). The elements are the same in
//! every run.
#![allow(clippy::print_stdout, reason = "a bench reports on stdout")]

use std::hint::black_box;
use std::process::ExitCode;

use specula_bsdf::batch::{Colours, Directions, Kind, Level, Samples, Widths};
use specula_bsdf::bsdf::{RoughConductor, RoughDielectric};
use specula_bsdf::fresnel::{Conductor, Reflectance};
use specula_bsdf::math::{Stream, rgb, warp};
use specula_bsdf::ndf::Ggx;
use specula_bsdf::vndf::{self, Sampler};
use specula_bsdf::{Alpha, Bsdf, Transport};

const N: usize = 1024;

/// Inputs and outputs of all kernels.
struct Data {
    wo: Directions<Vec<f32>>,
    wi: Directions<Vec<f32>>,
    u: [Vec<f32>; 3],
    drawn: Directions<Vec<f32>>,
    f_cos: Colours<Vec<f32>>,
    pdf: Vec<f32>,
    samples: Samples<Vec<f32>, Vec<Kind>>,
    alpha: Alpha<f32>,
    gold: RoughConductor<f32>,
    glass: RoughDielectric<f32>,
}

impl Data {
    fn new() -> Self {
        let mut stream = Stream::new(1);
        let mut directions = || {
            (0..N)
                .map(|_| warp::cosine_hemisphere([stream.next(), stream.next()]))
                .collect()
        };
        let (wo, wi) = (directions(), directions());
        let alpha = Alpha::clamped(0.3, 0.5);
        let gold = Reflectance::Conductor(Conductor {
            eta: rgb(0.14, 0.37, 1.44),
            k: rgb(3.98, 2.38, 1.6),
        });
        Self {
            wo,
            wi,
            u: core::array::from_fn(|_| (0..N).map(|_| stream.next()).collect()),
            drawn: Directions::zeroed(N),
            f_cos: Colours::zeroed(N),
            pdf: vec![0.0; N],
            samples: Samples::rejected(N),
            alpha,
            gold: RoughConductor::new(Ggx::new(alpha), gold).with_sampler(Sampler::Bounded),
            glass: RoughDielectric::new(Ggx::new(alpha), 1.5),
        }
    }
}

/// Runs one kernel; `None` where there is none of that name.
#[inline(never)]
fn counted(data: &mut Data, kernel: &str, level: Option<Level>) -> Option<()> {
    match level {
        Some(level) => batch(data, kernel, level),
        None => scalar(data, kernel),
    }
}

fn scalar(data: &mut Data, kernel: &str) -> Option<()> {
    let (wo, wi, alpha) = (data.wo.as_slices(), data.wi.as_slices(), data.alpha);
    let u = |i: usize| [data.u[1][i], data.u[2][i]];
    let all = |one: &dyn Fn(usize)| (0..N).for_each(|i| one(black_box(i)));
    match kernel {
        "heitz" => all(&|i| {
            black_box(vndf::heitz::sample_reflection(alpha, wo.get(i), u(i)));
        }),
        "cap" => all(&|i| {
            black_box(vndf::cap::sample_reflection(alpha, wo.get(i), u(i)));
        }),
        "bounded" => all(&|i| {
            black_box(vndf::bounded::sample_reflection(alpha, wo.get(i), u(i)));
        }),
        "pdf" => all(&|i| {
            black_box(vndf::bounded::reflection_pdf(alpha, wo.get(i), wi.get(i)));
        }),
        "gold" => all(&|i| {
            let u = [data.u[0][i], data.u[1][i], data.u[2][i]];
            black_box(data.gold.sample(wo.get(i), u, Transport::Radiance));
        }),
        "glass" => all(&|i| {
            let u = [data.u[0][i], data.u[1][i], data.u[2][i]];
            black_box(data.glass.sample(wo.get(i), u, Transport::Radiance));
        }),
        _ => return None,
    }
    Some(())
}

fn batch(data: &mut Data, kernel: &str, level: Level) -> Option<()> {
    let (wo, wi) = (data.wo.as_slices(), data.wi.as_slices());
    let u = [&data.u[0][..], &data.u[1], &data.u[2]];
    let widths = Widths::Same(data.alpha);
    let drawn = data.drawn.as_mut_slices();
    let samples = data.samples.as_mut_slices();
    let transport = Transport::Radiance;
    let reflect = |sampler| level.sample_reflection(sampler, widths, wo, [u[1], u[2]], drawn);
    let outcome = match kernel {
        "heitz" => reflect(Sampler::Heitz),
        "cap" => reflect(Sampler::Cap),
        "bounded" => reflect(Sampler::Bounded),
        "pdf" => level.reflection_pdf(Sampler::Bounded, widths, wo, wi, &mut data.pdf),
        "gold" => level.sample(&data.gold, wo, u, transport, samples),
        "glass" => level.sample(&data.glass, wo, u, transport, samples),
        "gold-eval" => {
            let f_cos = data.f_cos.as_mut_slices();
            level.eval_pdf(&data.gold, wo, wi, transport, f_cos, &mut data.pdf)
        }
        _ => return None,
    };
    outcome.ok()
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().collect();
    let [_, kernel, level, ..] = &arguments[..] else {
        // As `cargo bench` runs it, which has nothing to count.
        return ExitCode::SUCCESS;
    };
    let level = match level.as_str() {
        "scalar" => None,
        "baseline" => Some(Level::Baseline),
        "avx2" if Level::Avx2.is_available() => Some(Level::Avx2),
        _ => return ExitCode::FAILURE,
    };
    let mut data = black_box(Data::new());
    match counted(&mut data, kernel, level) {
        Some(()) => {
            println!("{N}");
            ExitCode::SUCCESS
        }
        None => ExitCode::FAILURE,
    }
}
