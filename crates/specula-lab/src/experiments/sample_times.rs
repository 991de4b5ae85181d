//! Nanoseconds of samples and densities of the samplers, scalar and in batches, `f32`, one thread.

use std::hint::black_box;
use std::time::Instant;

use specula_bsdf::batch::{Alphas, Directions, Level};
use specula_bsdf::math::{Stream, vec3, warp};
use specula_bsdf::vndf::{self, Sampler};
use specula_bsdf::{Alpha, Vec3};

use super::stopwatch::median;

/// Elements of a run.
const COUNT: usize = 2048;

/// Views and random numbers.
pub(super) struct Inputs {
    alpha: Alpha<f32>,
    wo: Directions<Vec<f32>>,
    wi: Directions<Vec<f32>>,
    u: [Vec<f32>; 2],
}

impl Inputs {
    /// Views over the hemisphere.
    pub(super) fn all_views(alpha: Alpha<f32>, seed: u64) -> Self {
        Self::new(alpha, seed, |stream| {
            warp::cosine_hemisphere([stream.next(), stream.next()])
        })
    }

    /// One view, as often.
    pub(super) fn one_view(alpha: Alpha<f32>, theta_deg: f32, seed: u64) -> Self {
        let (sine, cosine) = theta_deg.to_radians().sin_cos();
        let wo = Vec3 {
            x: 0.6 * sine,
            y: 0.8 * sine,
            z: cosine,
        };
        Self::new(alpha, seed, |_| wo)
    }

    fn new(alpha: Alpha<f32>, seed: u64, view: impl Fn(&mut Stream) -> Vec3<f32>) -> Self {
        let mut stream = Stream::new(seed);
        let wo = (0..COUNT).map(|_| view(&mut stream)).collect();
        let wi = (0..COUNT)
            .map(|_| warp::cosine_hemisphere([stream.next(), stream.next()]))
            .collect();
        let u = [(); 2].map(|()| (0..COUNT).map(|_| stream.next()).collect());
        Self { alpha, wo, wi, u }
    }

    fn u(&self, i: usize) -> [f32; 2] {
        [self.u[0][i], self.u[1][i]]
    }
}

/// A timed run: once over all inputs.
pub(super) type Run<'a> = Box<dyn FnMut() + 'a>;

/// Sampling of a microfacet normal.
pub(super) fn normals(inputs: &Inputs, sampler: Sampler) -> Run<'_> {
    let (alpha, wo) = (inputs.alpha, inputs.wo.as_slices());
    match sampler {
        Sampler::Heitz => {
            each(move |i| vndf::heitz::sample_wm(alpha, element(&wo, i), inputs.u(i)))
        }
        _ => each(move |i| vndf::cap::sample_wm(alpha, element(&wo, i), inputs.u(i))),
    }
}

/// Sampling of a reflection.
pub(super) fn reflections(inputs: &Inputs, sampler: Sampler) -> Run<'_> {
    let (alpha, wo) = (inputs.alpha, inputs.wo.as_slices());
    match sampler {
        Sampler::Heitz => {
            each(move |i| vndf::heitz::sample_reflection(alpha, element(&wo, i), inputs.u(i)))
        }
        Sampler::Cap => {
            each(move |i| vndf::cap::sample_reflection(alpha, element(&wo, i), inputs.u(i)))
        }
        Sampler::Bounded => {
            each(move |i| vndf::bounded::sample_reflection(alpha, element(&wo, i), inputs.u(i)))
        }
        Sampler::Exact => {
            each(move |i| vndf::exact::sample_reflection(alpha, element(&wo, i), inputs.u(i)))
        }
    }
}

/// A reflection's density.
pub(super) fn densities(inputs: &Inputs, sampler: Sampler) -> Run<'_> {
    let (alpha, wo, wi) = (inputs.alpha, inputs.wo.as_slices(), inputs.wi.as_slices());
    match sampler {
        Sampler::Heitz | Sampler::Cap => {
            each(move |i| vndf::cap::reflection_pdf(alpha, element(&wo, i), element(&wi, i)))
        }
        Sampler::Bounded => {
            each(move |i| vndf::bounded::reflection_pdf(alpha, element(&wo, i), element(&wi, i)))
        }
        Sampler::Exact => {
            each(move |i| vndf::exact::reflection_pdf(alpha, element(&wo, i), element(&wi, i)))
        }
    }
}

/// Reflections, all at once with the machine's vectors.
pub(super) fn batch_reflections(inputs: &Inputs, sampler: Sampler) -> Run<'_> {
    let mut sampled = Directions::<Vec<f32>>::zeroed(COUNT);
    let (wo, u) = (inputs.wo.as_slices(), [&inputs.u[0][..], &inputs.u[1][..]]);
    Box::new(move || {
        let alphas = Alphas::Same(black_box(inputs.alpha));
        let out = sampled.as_mut_slices();
        // The lengths agree.
        let _ = black_box(Level::best().sample_reflection(sampler, alphas, wo, u, out));
        black_box(&mut sampled);
    })
}

/// Densities, all at once with the machine's vectors.
pub(super) fn batch_densities(inputs: &Inputs, sampler: Sampler) -> Run<'_> {
    let mut pdf = vec![0.0; COUNT];
    let (wo, wi) = (inputs.wo.as_slices(), inputs.wi.as_slices());
    Box::new(move || {
        let alphas = Alphas::Same(black_box(inputs.alpha));
        // The lengths agree.
        let _ = black_box(Level::best().reflection_pdf(sampler, alphas, wo, wi, &mut pdf));
        black_box(&mut pdf);
    })
}

fn each<'a, R: 'a>(work: impl Fn(usize) -> R + 'a) -> Run<'a> {
    Box::new(move || {
        for i in 0..COUNT {
            black_box(work(black_box(i)));
        }
    })
}

/// Median nanoseconds per element of each run over so many rounds, in which all take their turns.
pub(super) fn medians(runs: &mut [Run<'_>], rounds: usize) -> Vec<f64> {
    let mut times = vec![Vec::with_capacity(rounds); runs.len()];
    for _ in 0..rounds {
        for (run, times) in runs.iter_mut().zip(&mut times) {
            let begin = Instant::now();
            run();
            times.push(begin.elapsed().as_secs_f64());
        }
    }
    times
        .into_iter()
        .map(|times| 1e9 * median(times) / COUNT as f64)
        .collect()
}

/// The vector at `i`.
#[inline(always)]
fn element(vectors: &Directions<&[f32]>, i: usize) -> Vec3<f32> {
    vec3(vectors.x[i], vectors.y[i], vectors.z[i])
}
