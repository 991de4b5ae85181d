//! Nanoseconds per element of the batch functions at every level of this machine, f32, one thread.
//!
//! Every kernel takes its turn many times in short slices and the fastest slice counts, so that
//! other programs on the machine matter little; ratios matter more than times. Beside the scalar
//! code stand the targets: what C++ reaches with `-ffast-math`, vectorised by g++, on AVX-512
//! (cap 1.2, bounded 1.6, pdf 1.0, sample with pdf and gold weight 4.9) and on AVX2 (cap 1.7,
//! bounded 2.4).
#![allow(clippy::print_stdout, reason = "a bench reports on stdout")]

use std::hint::black_box;
use std::time::Instant;

use specula_bsdf::batch::{Alphas, Colours, Directions, Level, Lobes, SampleOutcome, Samples};
use specula_bsdf::bsdf::{
    CoatedDiffuse, Compensated, Eon, Lambert, RoughConductor, RoughDielectric, SmoothConductor,
};
use specula_bsdf::energy::{EnergyModel, FmsVariant};
use specula_bsdf::fresnel::{Conductor, Reflectance};
use specula_bsdf::math::{Stream, rgb, vec3, warp};
use specula_bsdf::ndf::Ggx;
use specula_bsdf::vndf::{self, Sampler};
use specula_bsdf::{Alpha, Bsdf, Rgb, Transport, Vec3};

const N: usize = 1024;
const ROUNDS: usize = 1500;

/// Inputs of every kernel.
struct Input {
    wo: Directions<Vec<f32>>,
    wi: Directions<Vec<f32>>,
    u: [Vec<f32>; 3],
}

impl Input {
    fn new() -> Self {
        let mut stream = Stream::new(1);
        let mut directions = || {
            (0..N)
                .map(|_| warp::cosine_hemisphere([stream.next(), stream.next()]))
                .collect()
        };
        let (wo, wi) = (directions(), directions());
        let u = core::array::from_fn(|_| (0..N).map(|_| stream.next()).collect());
        Self { wo, wi, u }
    }

    fn u(&self) -> [&[f32]; 3] {
        [&self.u[0], &self.u[1], &self.u[2]]
    }
}

type Kernel<'a> = (String, Box<dyn FnMut() + 'a>);

/// The fastest slice of each kernel in ns per element; the kernels take turns.
fn fastest(kernels: &mut [Kernel]) -> Vec<f64> {
    let mut best = vec![f64::INFINITY; kernels.len()];
    for _ in 0..ROUNDS {
        for ((_, kernel), best) in kernels.iter_mut().zip(&mut best) {
            let start = Instant::now();
            kernel();
            *best = best.min(start.elapsed().as_secs_f64());
        }
    }
    #[allow(clippy::cast_precision_loss, reason = "1024 elements")]
    let per_element = 1e9 / N as f64;
    best.iter().map(|s| s * per_element).collect()
}

fn gold() -> Reflectance<f32> {
    Reflectance::Conductor(Conductor {
        eta: rgb(0.14, 0.37, 1.44),
        k: rgb(3.98, 2.38, 1.6),
    })
}

fn samplers<'a>(input: &'a Input, level: Option<Level>, alpha: Alpha<f32>) -> Vec<Kernel<'a>> {
    let mut kernels: Vec<Kernel> = Vec::new();
    let (wo, wi) = (input.wo.as_slices(), input.wi.as_slices());
    let [_, u1, u2] = input.u();
    let alphas = Alphas::Same(alpha);
    for sampler in [
        Sampler::Heitz,
        Sampler::Cap,
        Sampler::Bounded,
        Sampler::Exact,
    ] {
        let mut sampled = Directions::<Vec<f32>>::zeroed(N);
        let mut pdf = vec![0.0; N];
        match level {
            Some(level) => {
                let sample = move || {
                    let out = sampled.as_mut_slices();
                    let done = level.sample_reflection(sampler, alphas, wo, [u1, u2], out);
                    black_box((done, &mut sampled)).0.expect("equal lengths");
                };
                kernels.push((format!("{sampler} sample"), Box::new(sample)));
                let density = move || {
                    let done = level.reflection_pdf(sampler, alphas, wo, wi, &mut pdf);
                    black_box((done, &mut pdf)).0.expect("equal lengths");
                };
                kernels.push((format!("{sampler} pdf"), Box::new(density)));
            }
            None => {
                let sample = move || {
                    for i in 0..N {
                        let (wo, u) = (element(&wo, i), [u1[i], u2[i]]);
                        black_box(match sampler {
                            Sampler::Heitz => vndf::heitz::sample_reflection(alpha, wo, u),
                            Sampler::Cap => vndf::cap::sample_reflection(alpha, wo, u),
                            Sampler::Bounded => vndf::bounded::sample_reflection(alpha, wo, u),
                            Sampler::Exact => vndf::exact::sample_reflection(alpha, wo, u),
                        });
                    }
                };
                kernels.push((format!("{sampler} sample"), Box::new(sample)));
                let density = move || {
                    for i in 0..N {
                        let (wo, wi) = (element(&wo, i), element(&wi, i));
                        black_box(match sampler {
                            Sampler::Heitz | Sampler::Cap => {
                                vndf::cap::reflection_pdf(alpha, wo, wi)
                            }
                            Sampler::Bounded => vndf::bounded::reflection_pdf(alpha, wo, wi),
                            Sampler::Exact => vndf::exact::reflection_pdf(alpha, wo, wi),
                        });
                    }
                };
                kernels.push((format!("{sampler} pdf"), Box::new(density)));
            }
        }
    }
    kernels
}

/// eval + pdf, and sample, of one lobe at one level or scalar.
fn lobe<'a, L>(name: &str, lobe: L, input: &'a Input, level: Option<Level>) -> [Kernel<'a>; 2]
where
    L: Lobes<f32> + Bsdf<f32> + 'a,
{
    let (wo, wi, u) = (input.wo.as_slices(), input.wi.as_slices(), input.u());
    let transport = Transport::Radiance;
    let lobe = std::rc::Rc::new(lobe);
    let mut f_cos = Colours::<Vec<f32>>::zeroed(N);
    let mut pdf = vec![0.0; N];
    let mut samples = Samples::<Vec<f32>, Vec<SampleOutcome>>::rejected(N);
    let own = lobe.clone();
    let eval = move || match level {
        Some(level) => {
            let out = f_cos.as_mut_slices();
            let done = level.eval_pdf(&*own, wo, wi, transport, out, &mut pdf);
            black_box((done, &mut f_cos, &mut pdf))
                .0
                .expect("equal lengths");
        }
        None => {
            for i in 0..N {
                black_box(own.eval_pdf(element(&wo, i), element(&wi, i), transport));
            }
        }
    };
    let sample = move || match level {
        Some(level) => {
            let done = level.sample(&*lobe, wo, u, transport, samples.as_mut_slices());
            black_box((done, &mut samples)).0.expect("equal lengths");
        }
        None => {
            for i in 0..N {
                black_box(lobe.sample(element(&wo, i), u.map(|u| u[i]), transport));
            }
        }
    };
    [
        (format!("{name} eval + pdf"), Box::new(eval)),
        (format!("{name} sample"), Box::new(sample)),
    ]
}

fn lobes(input: &Input, level: Option<Level>, ggx: Ggx<f32>) -> Vec<Kernel<'_>> {
    let colour = Rgb::splat(0.5);
    let metal = RoughConductor::new(ggx, gold());
    let bounded = metal.with_sampler(Sampler::Bounded);
    let white = RoughConductor::new(ggx, Reflectance::Constant(Rgb::WHITE));
    [
        lobe("gold, bounded,", bounded, input, level),
        lobe(
            "gold, exact,",
            metal.with_sampler(Sampler::Exact),
            input,
            level,
        ),
        lobe(
            "F = 1, bounded,",
            white.with_sampler(Sampler::Bounded),
            input,
            level,
        ),
        lobe("glass", RoughDielectric::new(ggx, 1.5), input, level),
        lobe("mirror", SmoothConductor::new(gold()), input, level),
        lobe("Lambert", Lambert::new(colour), input, level),
        lobe("EON", Eon::new(colour, 0.5), input, level),
        lobe(
            "coated diffuse",
            CoatedDiffuse::new(Some(ggx), 1.5, colour),
            input,
            level,
        ),
        lobe(
            "gold after Turquin",
            Compensated::new(ggx, gold(), EnergyModel::Turquin(FmsVariant::AverageSeries)),
            input,
            level,
        ),
    ]
    .into_iter()
    .flatten()
    .collect()
}

fn main() {
    let input = Input::new();
    let mut levels = vec![None];
    levels.extend(
        Level::ALL
            .into_iter()
            .filter(|l| l.is_available())
            .map(Some),
    );
    for alpha in [Alpha::isotropic(0.3_f32), Alpha::clamped(0.3, 0.5)] {
        let alpha = black_box(alpha);
        let mut kernels: Vec<Kernel> = Vec::new();
        for &level in &levels {
            kernels.extend(samplers(&input, level, alpha));
            kernels.extend(lobes(&input, level, Ggx::new(alpha)));
        }
        let ns = fastest(&mut kernels);
        let rows = kernels.len() / levels.len();
        println!(
            "alpha ({}, {}): ns per element, and times faster than scalar",
            alpha.x, alpha.y
        );
        print!("  {:<28} {:>8}", "", "scalar");
        levels.iter().flatten().for_each(|l| print!(" {l:>15}"));
        println!();
        for row in 0..rows {
            let scalar = ns[row];
            print!("  {:<28} {scalar:>8.2}", kernels[row].0);
            for level in 1..levels.len() {
                let ns = ns[level * rows + row];
                print!(" {ns:>8.2} {:>5.1}x", scalar / ns);
            }
            println!();
        }
        for (level, name) in levels.iter().enumerate().skip(1) {
            let at = |row: usize| ns[level * rows + row];
            let name = name.expect("the first alone is scalar");
            println!(
                "  {name}: exact / bounded {:.2}, bounded / cap {:.2}",
                at(6) / at(4),
                at(4) / at(2)
            );
        }
    }
}

/// The vector at `i`.
#[inline(always)]
fn element(vectors: &Directions<&[f32]>, i: usize) -> Vec3<f32> {
    vec3(vectors.x[i], vectors.y[i], vectors.z[i])
}
