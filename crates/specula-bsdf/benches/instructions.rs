//! What `cargo xtask instructions` counts under valgrind: `-- KERNEL LEVEL` runs one kernel over
//! 1024 elements inside `counted`, and prints how many those were.
//!
//! LEVEL is `scalar`, `baseline` or `avx2` (valgrind knows no AVX-512). The elements are the same in
//! every run.
#![allow(clippy::print_stdout, reason = "a bench reports on stdout")]

use std::hint::black_box;
use std::process::ExitCode;

use specula_bsdf::batch::{Alphas, Colours, Directions, Level, Lobes, SampleOutcome, Samples};
use specula_bsdf::bsdf::{
    CoatedDiffuse, Compensated, Eon, Gltf, GltfParameters, MultibounceConductor, Principled,
    PrincipledParameters, RoughConductor, RoughDielectric, SmoothConductor,
};
use specula_bsdf::energy::{EnergyModel, FmsVariant};
use specula_bsdf::fresnel::{Conductor, Reflectance};
use specula_bsdf::math::{Stream, rgb, vec3, warp};
use specula_bsdf::multibounce::MultibounceModel;
use specula_bsdf::ndf::{Beckmann, Ggx};
use specula_bsdf::vndf::{self, Sampler};
use specula_bsdf::{Alpha, Bsdf, Rgb, Transport, Vec3};

const N: usize = 1024;

/// Inputs and outputs of all kernels.
struct Data {
    wo: Directions<Vec<f32>>,
    wi: Directions<Vec<f32>>,
    u: [Vec<f32>; 3],
    sampled: Directions<Vec<f32>>,
    f_cos: Colours<Vec<f32>>,
    pdf: Vec<f32>,
    samples: Samples<Vec<f32>, Vec<SampleOutcome>>,
    alpha: Alpha<f32>,
    gold: RoughConductor<f32>,
    beckmann: RoughConductor<f32, Beckmann<f32>>,
    exact: RoughConductor<f32>,
    brushed: RoughConductor<f32>,
    glass: RoughDielectric<f32>,
    mirror: SmoothConductor<f32>,
    eon: Eon<f32>,
    coated_diffuse: CoatedDiffuse<f32>,
    gltf: Gltf<f32>,
    principled: Principled<f32>,
    turquin: Compensated<f32>,
    bounces: MultibounceConductor<f32>,
    streams: Vec<Stream>,
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
        let ggx = Ggx::new(alpha);
        Self {
            wo,
            wi,
            u: core::array::from_fn(|_| (0..N).map(|_| stream.next()).collect()),
            sampled: Directions::zeroed(N),
            f_cos: Colours::zeroed(N),
            pdf: vec![0.0; N],
            samples: Samples::rejected(N),
            alpha,
            gold: RoughConductor::new(ggx, gold).with_sampler(Sampler::Bounded),
            beckmann: RoughConductor::new(Beckmann::new(alpha), gold),
            exact: RoughConductor::new(Ggx::new(Alpha::isotropic(0.3)), gold)
                .with_sampler(Sampler::Exact),
            brushed: RoughConductor::new(ggx, gold).with_sampler(Sampler::Exact),
            glass: RoughDielectric::new(ggx, 1.5),
            mirror: SmoothConductor::new(gold),
            eon: Eon::new(Rgb::splat(0.5), 0.5),
            coated_diffuse: CoatedDiffuse::new(Some(ggx), 1.5, Rgb::splat(0.5)),
            gltf: Gltf::new(GltfParameters {
                base_colour: rgb(0.8, 0.5, 0.2),
                metallic: 0.3,
                roughness: 0.5,
                ..GltfParameters::default()
            }),
            principled: Principled::new(PrincipledParameters {
                base_colour: rgb(0.8, 0.5, 0.2),
                metallic: 0.3,
                clearcoat: 0.5,
                ..PrincipledParameters::default()
            }),
            turquin: Compensated::new(ggx, gold, EnergyModel::Turquin(FmsVariant::AverageSeries)),
            bounces: MultibounceConductor::new(
                ggx,
                gold,
                MultibounceModel::StratifiedBidirectional,
            ),
            streams: (0..N as u64).map(Stream::new).collect(),
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
            black_box(vndf::heitz::sample_reflection(alpha, element(&wo, i), u(i)));
        }),
        "cap" => all(&|i| {
            black_box(vndf::cap::sample_reflection(alpha, element(&wo, i), u(i)));
        }),
        "bounded" => all(&|i| {
            black_box(vndf::bounded::sample_reflection(
                alpha,
                element(&wo, i),
                u(i),
            ));
        }),
        "exact-unequal" => all(&|i| {
            black_box(vndf::exact::sample_reflection(alpha, element(&wo, i), u(i)));
        }),
        "pdf" => all(&|i| {
            black_box(vndf::bounded::reflection_pdf(
                alpha,
                element(&wo, i),
                element(&wi, i),
            ));
        }),
        _ => return scalar_lobe(data, kernel),
    }
    Some(())
}

fn scalar_lobe(data: &Data, kernel: &str) -> Option<()> {
    match kernel {
        "gold" => draw_each(data, &data.gold),
        "beckmann" => draw_each(data, &data.beckmann),
        "beckmann-eval" => eval_each(data, &data.beckmann),
        "gold-eval" => eval_each(data, &data.gold),
        "exact" => draw_each(data, &data.exact),
        "brushed" => draw_each(data, &data.brushed),
        "exact-eval" => eval_each(data, &data.exact),
        "glass" => draw_each(data, &data.glass),
        "glass-eval" => eval_each(data, &data.glass),
        "mirror" => draw_each(data, &data.mirror),
        "eon" => draw_each(data, &data.eon),
        "eon-eval" => eval_each(data, &data.eon),
        "coated-diffuse" => draw_each(data, &data.coated_diffuse),
        "coated-diffuse-eval" => eval_each(data, &data.coated_diffuse),
        "gltf" => draw_each(data, &data.gltf),
        "gltf-eval" => eval_each(data, &data.gltf),
        "principled" => draw_each(data, &data.principled),
        "principled-eval" => eval_each(data, &data.principled),
        "turquin" => draw_each(data, &data.turquin),
        "turquin-eval" => eval_each(data, &data.turquin),
        "bounces" => draw_each(data, &data.bounces),
        "bounces-eval" => eval_each(data, &data.bounces),
        _ => return None,
    }
    Some(())
}

fn draw_each(data: &Data, lobe: &impl Bsdf<f32>) {
    let wo = data.wo.as_slices();
    for i in 0..N {
        let u = [data.u[0][i], data.u[1][i], data.u[2][i]];
        black_box(lobe.sample(element(&wo, i), u, Transport::Radiance));
    }
}

fn eval_each(data: &Data, lobe: &impl Bsdf<f32>) {
    let (wo, wi) = (data.wo.as_slices(), data.wi.as_slices());
    for i in 0..N {
        black_box(lobe.eval_pdf(element(&wo, i), element(&wi, i), Transport::Radiance));
    }
}

fn batch(data: &mut Data, kernel: &str, level: Level) -> Option<()> {
    let (wo, wi) = (data.wo.as_slices(), data.wi.as_slices());
    let u = [&data.u[1][..], &data.u[2]];
    let alphas = Alphas::Same(data.alpha);
    let sampled = data.sampled.as_mut_slices();
    let reflect = |sampler| level.sample_reflection(sampler, alphas, wo, u, sampled);
    let outcome = match kernel {
        "heitz" => reflect(Sampler::Heitz),
        "cap" => reflect(Sampler::Cap),
        "bounded" => reflect(Sampler::Bounded),
        "exact-unequal" => reflect(Sampler::Exact),
        "pdf" => level.reflection_pdf(Sampler::Bounded, alphas, wo, wi, &mut data.pdf),
        _ => return batch_lobe(data, kernel, level),
    };
    outcome.ok()
}

fn batch_lobe(data: &mut Data, kernel: &str, level: Level) -> Option<()> {
    match kernel {
        "gold" => draw_all(data, |d| d.gold, level),
        "beckmann" => draw_all(data, |d| d.beckmann, level),
        "beckmann-eval" => eval_all(data, |d| d.beckmann, level),
        "gold-eval" => eval_all(data, |d| d.gold, level),
        "exact" => draw_all(data, |d| d.exact, level),
        "brushed" => draw_all(data, |d| d.brushed, level),
        "exact-eval" => eval_all(data, |d| d.exact, level),
        "glass" => draw_all(data, |d| d.glass, level),
        "glass-eval" => eval_all(data, |d| d.glass, level),
        "mirror" => draw_all(data, |d| d.mirror, level),
        "eon" => draw_all(data, |d| d.eon, level),
        "eon-eval" => eval_all(data, |d| d.eon, level),
        "coated-diffuse" => draw_all(data, |d| d.coated_diffuse, level),
        "coated-diffuse-eval" => eval_all(data, |d| d.coated_diffuse, level),
        "gltf" => draw_all(data, |d| d.gltf, level),
        "gltf-eval" => eval_all(data, |d| d.gltf, level),
        "principled" => draw_all(data, |d| d.principled, level),
        "principled-eval" => eval_all(data, |d| d.principled, level),
        "turquin" => draw_all(data, |d| d.turquin, level),
        "turquin-eval" => eval_all(data, |d| d.turquin, level),
        "bounces" => {
            let u = [&data.u[0][..], &data.u[1], &data.u[2]];
            let samples = data.samples.as_mut_slices();
            let (wo, streams) = (data.wo.as_slices(), &mut data.streams);
            level
                .sample_random(&data.bounces, wo, u, streams, samples)
                .ok()
        }
        "bounces-eval" => {
            let (wo, wi) = (data.wo.as_slices(), data.wi.as_slices());
            let (streams, f_cos) = (&mut data.streams, data.f_cos.as_mut_slices());
            level
                .eval_pdf_random(&data.bounces, wo, wi, streams, f_cos, &mut data.pdf)
                .ok()
        }
        "glass-pdf" => {
            let (wo, wi) = (data.wo.as_slices(), data.wi.as_slices());
            level.pdf(&data.glass, wo, wi, &mut data.pdf).ok()
        }
        _ => None,
    }
}

fn draw_all<L: Lobes<f32>>(data: &mut Data, lobe: fn(&Data) -> L, level: Level) -> Option<()> {
    let lobe = lobe(data);
    let u = [&data.u[0][..], &data.u[1], &data.u[2]];
    let samples = data.samples.as_mut_slices();
    level
        .sample(&lobe, data.wo.as_slices(), u, Transport::Radiance, samples)
        .ok()
}

fn eval_all<L: Lobes<f32>>(data: &mut Data, lobe: fn(&Data) -> L, level: Level) -> Option<()> {
    let lobe = lobe(data);
    let (wo, wi) = (data.wo.as_slices(), data.wi.as_slices());
    let f_cos = data.f_cos.as_mut_slices();
    level
        .eval_pdf(&lobe, wo, wi, Transport::Radiance, f_cos, &mut data.pdf)
        .ok()
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

/// The vector at `i`.
#[inline(always)]
fn element(vectors: &Directions<&[f32]>, i: usize) -> Vec3<f32> {
    vec3(vectors.x[i], vectors.y[i], vectors.z[i])
}
