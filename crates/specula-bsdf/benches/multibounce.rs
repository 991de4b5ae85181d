//! Variance, cost and inverse efficiency of every model of multiple bounces.
//!
//! GGX, F = 1, f32, scalar, one thread. Geometric means over `theta_i` and `theta_o` of 30 and 60
//! degrees (the papers' i is our `wo`), azimuths opposite (forward). All models take turns in short
//! slices and the fastest slice of each counts: ratios are what matters, absolute times are the
//! machine's. Relative inverse efficiency is variance times time over that of Heitz 2016 as
//! published, in our own code.
//!
//! Instructions instead of time, whatever else the machine does: `-- count MODEL ALPHA N` evaluates
//! a model N times per pair of directions and prints nothing, to be run under
//! `valgrind --tool=callgrind` (MODEL `published` is the yardstick); `-- count-glass MODEL ALPHA N`
//! likewise for glass; `-- count-batches OF LEVEL ALPHA N` evaluates or samples (OF is `eval` or
//! `sample`) N times 1024 elements of gold in one batch (LEVEL is `baseline` or `avx2`) or one by one
//! (`scalar`). `-- batches` prints the part on batches alone.
#![allow(clippy::print_stdout, reason = "a bench reports on stdout")]

use std::hint::black_box;
use std::time::Instant;

use specula_bsdf::batch::{Colours, Directions, Level, SampleOutcome, Samples};
use specula_bsdf::bsdf::{MultibounceConductor, MultibounceDielectric};
use specula_bsdf::fresnel::Reflectance;
use specula_bsdf::math::{Stream, rgb, vec3, warp};
use specula_bsdf::multibounce::{MisPdf, MultibounceModel};
use specula_bsdf::ndf::Ggx;
use specula_bsdf::{Alpha, Bsdf, Rgb, Transport, Vec3};

const SLICES: u32 = 60;
const PER_SLICE: u32 = 3000;

fn at(degrees: f32, forward: f32) -> Vec3<f32> {
    let (s, c) = degrees.to_radians().sin_cos();
    vec3(s * forward, 0.0, c)
}

/// Sum, sum of squares and fastest time of what a model returns.
#[derive(Clone, Copy)]
struct Measured {
    sum: f64,
    squares: f64,
    ns: f64,
}

impl Measured {
    const NONE: Self = Self {
        sum: 0.0,
        squares: 0.0,
        ns: f64::INFINITY,
    };

    #[inline(never)]
    fn slice(&mut self, mut estimate: impl FnMut() -> f32) {
        let start = Instant::now();
        for _ in 0..PER_SLICE {
            let x = f64::from(black_box(estimate()));
            self.sum += x;
            self.squares += x * x;
        }
        let ns = start.elapsed().as_secs_f64() * 1e9 / f64::from(PER_SLICE);
        self.ns = self.ns.min(ns);
    }

    fn mean(&self) -> f64 {
        self.sum / f64::from(SLICES * PER_SLICE)
    }

    fn product(&self) -> f64 {
        self.variance() * self.ns
    }

    fn variance(&self) -> f64 {
        self.squares / f64::from(SLICES * PER_SLICE) - self.mean() * self.mean()
    }
}

/// `(theta_i, theta_o)`, degrees.
const PAIRS: [(f32, f32); 4] = [(30.0, 30.0), (30.0, 60.0), (60.0, 30.0), (60.0, 60.0)];

/// Geometric mean.
fn over(values: impl Iterator<Item = f64>) -> f64 {
    let (mut sum, mut n) = (0.0, 0.0);
    for v in values {
        sum += v.max(1e-300).ln();
        n += 1.0;
    }
    f64::exp(sum / n)
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    if let [_, command, model, alpha, n, ..] = &arguments[..] {
        match command.as_str() {
            "count" => return count(model, alpha, n),
            "count-glass" => return count_glass(model, alpha, n),
            _ => {}
        }
    }
    if arguments.iter().any(|a| a == "batches") {
        return batches();
    }
    if let [_, command, of, level, alpha, n, ..] = &arguments[..]
        && command == "count-batches"
    {
        return count_batches(of, level, alpha, n);
    }
    for alpha in [0.5_f32, 1.0] {
        let lobes = MultibounceModel::ALL.map(|model| {
            let white = Reflectance::Constant(Rgb::splat(1.0));
            MultibounceConductor::new(Ggx::new(Alpha::isotropic(alpha)), white, model)
        });
        let mut published = [Measured::NONE; 4];
        let mut evals = [[Measured::NONE; 4]; MultibounceModel::ALL.len()];
        let mut samples = evals;
        let mut stream = Stream::new(1);
        for _ in 0..SLICES {
            for (k, (i, o)) in PAIRS.into_iter().enumerate() {
                let (wo, wi) = (at(i, 1.0), at(o, -1.0));
                published[k].slice(|| {
                    let (wo, wi) = black_box((wo, wi));
                    lobes[0].estimate_as_heitz(wo, wi, &mut stream).r
                });
                for (lobe, (eval, sample)) in lobes.iter().zip(evals.iter_mut().zip(&mut samples)) {
                    eval[k].slice(|| {
                        let (wo, wi) = black_box((wo, wi));
                        lobe.estimate(wo, wi, &mut stream).r
                    });
                    sample[k].slice(|| {
                        let u = [stream.next(), stream.next()];
                        lobe.sample_walk(black_box(wo), u, &mut stream)
                            .map_or(0.0, |(_, weight)| weight.r)
                    });
                }
            }
        }
        println!("alpha {alpha}");
        println!(
            "  model                  mean  variance      ns  relative   sample ns  weight variance"
        );
        let yardstick = over(published.iter().map(Measured::product));
        let print = |name: &str, eval: &[Measured], sample: &[Measured]| {
            println!(
                "  {name:<19} {:>7.4} {:>9.5} {:>7.1} {:>9.3}   {:>9.1} {:>16.5}",
                over(eval.iter().map(Measured::mean)),
                over(eval.iter().map(Measured::variance)),
                over(eval.iter().map(|m| m.ns)),
                over(eval.iter().map(Measured::product)) / yardstick,
                over(sample.iter().map(|m| m.ns)),
                sample.iter().map(Measured::variance).fold(0.0, f64::max),
            );
        };
        print("heitz, as published", &published, &samples[0]);
        for (model, (eval, sample)) in MultibounceModel::ALL.iter().zip(evals.iter().zip(&samples))
        {
            print(model.name(), eval, sample);
        }
    }
    dielectrics();
}

/// Evaluates one model and nothing else.
fn count(model: &str, alpha: &str, n: &str) {
    let alpha = alpha.parse().expect("ALPHA is a number");
    let n: u32 = n.parse().expect("N is a count");
    let published = model == "published";
    let model = if published {
        MultibounceModel::Heitz2016
    } else {
        model.parse().expect("MODEL is a model's name")
    };
    let white = Reflectance::Constant(Rgb::splat(1.0));
    let lobe = MultibounceConductor::new(Ggx::new(Alpha::isotropic(alpha)), white, model);
    let mut stream = Stream::new(1);
    for (i, o) in PAIRS {
        let (wo, wi) = (at(i, 1.0), at(o, -1.0));
        for _ in 0..n {
            let (wo, wi) = black_box((wo, wi));
            black_box(if published {
                lobe.estimate_as_heitz(wo, wi, &mut stream)
            } else {
                lobe.estimate(wo, wi, &mut stream)
            });
        }
    }
}

/// As [`count`], glass.
fn count_glass(model: &str, alpha: &str, n: &str) {
    let lobe = glass(
        alpha.parse().expect("ALPHA is a number"),
        model.parse().expect("MODEL is a model's name"),
    );
    let n: u32 = n.parse().expect("N is a count");
    let mut stream = Stream::new(1);
    for (_, from, to) in SIDES {
        for (o, i) in pairs(from, to) {
            let (wo, wi) = (at(o, 1.0), at(i, -1.0));
            for _ in 0..n {
                let (wo, wi) = black_box((wo, wi));
                black_box(lobe.eval_pdf_random(wo, wi, Transport::Importance, &mut stream));
            }
        }
    }
}

/// Directions of glass, degrees from the normal outside.
const SIDES: [(&str, [f32; 2], [f32; 2]); 4] = [
    ("outside to outside", [30.0, 60.0], [30.0, 60.0]),
    ("outside to inside", [30.0, 60.0], [150.0, 120.0]),
    ("inside to outside", [150.0, 120.0], [30.0, 60.0]),
    ("inside to inside", [150.0, 120.0], [150.0, 120.0]),
];

fn glass(alpha: f32, model: MultibounceModel) -> MultibounceDielectric<f32> {
    MultibounceDielectric::new(Ggx::new(Alpha::isotropic(alpha)), 1.5_f32, model)
}

fn pairs(from: [f32; 2], to: [f32; 2]) -> [(f32, f32); 4] {
    let [a, b] = from;
    let [c, d] = to;
    [(a, c), (a, d), (b, c), (b, d)]
}

/// Glass, index 1.5: geometric means over 30 and 60 degrees from the normal at both ends.
/// Models of metals only are Specula's here and not shown; neither is the density of Hapke, which is the
/// Lambertian one.
fn dielectrics() {
    for alpha in [0.1_f32, 0.5, 1.0] {
        println!("glass, alpha {alpha}: variance, ns, variance x time relative to heitz");
        for (name, from, to) in SIDES {
            let pairs = pairs(from, to);
            let models = [
                MultibounceModel::Heitz2016,
                MultibounceModel::StratifiedBidirectional,
            ];
            let mut both = [[Measured::NONE; 4]; 2];
            let mut stream = Stream::new(2);
            for _ in 0..SLICES {
                for (model, measured) in models.into_iter().zip(&mut both) {
                    let lobe = glass(alpha, model);
                    for (measured, (o, i)) in measured.iter_mut().zip(pairs) {
                        let (wo, wi) = (at(o, 1.0), at(i, -1.0));
                        measured.slice(|| {
                            let (wo, wi) = black_box((wo, wi));
                            lobe.eval_pdf_random(wo, wi, Transport::Importance, &mut stream)
                                .0
                                .r
                        });
                    }
                }
            }
            let yardstick = over(both[0].iter().map(Measured::product));
            for (model, measured) in models.into_iter().zip(&both) {
                println!(
                    "  {name:<19} {:<8} {:>10.6} {:>7.1} {:>7.3}",
                    model.name(),
                    over(measured.iter().map(Measured::variance)),
                    over(measured.iter().map(|m| m.ns)),
                    over(measured.iter().map(Measured::product)) / yardstick,
                );
            }
        }
    }
    densities();
    batches();
}

/// Elements of gold, with streams of their own.
struct Batch {
    metal: MultibounceConductor<f32>,
    wo: Directions<Vec<f32>>,
    wi: Directions<Vec<f32>>,
    u: [Vec<f32>; 3],
    streams: Vec<Stream>,
    f_cos: Colours<Vec<f32>>,
    pdf: Vec<f32>,
    samples: Samples<Vec<f32>, Vec<SampleOutcome>>,
}

impl Batch {
    fn new(alpha: f32, n: usize) -> Self {
        let mut stream = Stream::new(5);
        let mut directions = || {
            (0..n)
                .map(|_| warp::cosine_hemisphere([stream.next(), stream.next()]))
                .collect()
        };
        let (wo, wi) = (directions(), directions());
        let gold = Reflectance::Conductor(specula_bsdf::fresnel::Conductor {
            eta: rgb(0.14, 0.37, 1.44),
            k: rgb(3.98, 2.38, 1.6),
        });
        Self {
            metal: MultibounceConductor::new(
                Ggx::new(Alpha::isotropic(alpha)),
                gold,
                MultibounceModel::StratifiedBidirectional,
            ),
            wo,
            wi,
            u: core::array::from_fn(|_| (0..n).map(|_| stream.next()).collect()),
            streams: (0..n).map(|i| Stream::new(977 * i as u64)).collect(),
            f_cos: Colours::zeroed(n),
            pdf: vec![0.0; n],
            samples: Samples::rejected(n),
        }
    }

    #[inline(never)]
    fn scalar(&mut self, samples: bool) {
        let (wo, wi) = (self.wo.as_slices(), self.wi.as_slices());
        let transport = Transport::Radiance;
        for (i, stream) in self.streams.iter_mut().enumerate() {
            let wo = black_box(element(&wo, i));
            if samples {
                let u = [self.u[0][i], self.u[1][i], self.u[2][i]];
                black_box(self.metal.sample_random(wo, u, transport, stream));
            } else {
                black_box(
                    self.metal
                        .eval_pdf_random(wo, element(&wi, i), transport, stream),
                );
            }
        }
    }

    #[inline(never)]
    fn run(&mut self, samples: bool, level: Level) {
        let (wo, wi) = (self.wo.as_slices(), self.wi.as_slices());
        let streams = &mut self.streams;
        let outcome = if samples {
            let u = [&self.u[0][..], &self.u[1], &self.u[2]];
            level.sample_random(&self.metal, wo, u, streams, self.samples.as_mut_slices())
        } else {
            let f_cos = self.f_cos.as_mut_slices();
            level.eval_pdf_random(&self.metal, wo, wi, streams, f_cos, &mut self.pdf)
        };
        outcome.expect("slices of one length");
    }
}

/// As [`count`], many elements at once.
fn count_batches(of: &str, level: &str, alpha: &str, n: &str) {
    let mut batch = Batch::new(alpha.parse().expect("ALPHA is a number"), 1024);
    let n: u32 = n.parse().expect("N is a count");
    let samples = of == "sample";
    for _ in 0..n {
        match level {
            "baseline" => batch.run(samples, Level::Baseline),
            "avx2" => batch.run(samples, Level::Avx2),
            _ => batch.scalar(samples),
        }
    }
}

/// Elements one by one and in batches, gold.
fn batches() {
    println!("batches of gold: ns of an element one by one, and how many times faster");
    println!("             alpha     n  one by one  baseline    AVX2  AVX-512");
    for samples in [false, true] {
        for alpha in [0.1, 0.5, 1.0] {
            for n in [1, 4, 8, 16, 64, 4096] {
                let mut batch = Batch::new(alpha, n);
                let mut fastest = [f64::INFINITY; 4];
                for _ in 0..SLICES {
                    for (k, fastest) in fastest.iter_mut().enumerate() {
                        // Short enough not to be interrupted.
                        let repeats = (256 / n).clamp(1, 16);
                        let start = Instant::now();
                        for _ in 0..repeats {
                            match k.checked_sub(1) {
                                None => batch.scalar(samples),
                                Some(level) => batch.run(samples, Level::ALL[level]),
                            }
                        }
                        #[allow(clippy::cast_precision_loss, reason = "a few thousand")]
                        let elements = (n * repeats) as f64;
                        *fastest = fastest.min(start.elapsed().as_secs_f64() * 1e9 / elements);
                    }
                }
                let [scalar, baseline, avx2, avx512] = fastest;
                println!(
                    "  {:<10} {alpha:>5} {n:>5} {scalar:>11.1} {:>9.2} {:>7.2} {:>8.2}",
                    if samples { "sample" } else { "eval, pdf" },
                    scalar / baseline,
                    scalar / avx2,
                    scalar / avx512,
                );
            }
        }
    }
}

/// Time of the densities for multiple importance sampling, of a metal.
fn densities() {
    println!("densities: ns, isotropic and anisotropic");
    for mis in MisPdf::ALL {
        let times = [(0.5, 0.5), (0.2, 0.8)].map(|(x, y)| {
            let white = Reflectance::Constant(Rgb::splat(1.0));
            let ndf = Ggx::new(Alpha::clamped(x, y));
            let lobe =
                MultibounceConductor::new(ndf, white, MultibounceModel::StratifiedBidirectional)
                    .with_mis_pdf(mis);
            let mut measured = Measured::NONE;
            let (wo, wi) = (at(30.0, 1.0), at(60.0, -0.9));
            for _ in 0..SLICES {
                measured.slice(|| {
                    let (wo, wi) = black_box((wo, wi));
                    lobe.pdf(wo, wi)
                });
            }
            measured.ns
        });
        println!("  {:<11} {:>6.1} {:>6.1}", mis.name(), times[0], times[1]);
    }
}

/// The vector at `i`.
#[inline(always)]
fn element(vectors: &Directions<&[f32]>, i: usize) -> Vec3<f32> {
    vec3(vectors.x[i], vectors.y[i], vectors.z[i])
}
