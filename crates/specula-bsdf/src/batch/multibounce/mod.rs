//! Rough metal with all bounces, for a batch of elements: walks in batches.
//!
//! The walk of one element is a chain that no vector shortens; the walks of different elements are
//! independent. Their states stand in batches, all at the same bounce, and what ends makes room (see
//! `walks`). Over the loop of scalar calls, f32, gold, isotropic GGX, cosine-distributed directions,
//! one thread:
//!
//! | | alpha | instructions: scalar | baseline | AVX2 | time, 4096 elements: AVX2 | AVX-512 | 64: AVX2 |
//! |---|---|---|---|---|---|---|---|
//! | eval and pdf | 0.1 | 3206 | 1618 | 641 | 4.6 | 4.9 | 3.5 |
//! | | 0.5 | 3967 | 2087 | 915 | 4.4 | 4.4 | 3.1 |
//! | | 1 | 5276 | 2877 | 1359 | 4.1 | 4.1 | 3.0 |
//! | sample | 0.1 | 1137 | 774 | 252 | 4.8 | 4.6 | 2.5 |
//! | | 0.5 | 1268 | 873 | 310 | 4.8 | 4.5 | 2.4 |
//! | | 1 | 1490 | 1031 | 400 | 4.7 | 4.6 | 2.6 |
//!
//! Instructions are for an element of 1024; times are how many times faster (`cargo bench --bench
//! multibounce -- walks`). `f64` gains 2.1 to 2.5 times with AVX2, 2.6 to 2.8 with AVX-512. A call
//! takes one or two microseconds to make room: below ten elements (eval) or twenty (sample) the
//! scalar functions are faster.
//! AVX-512 gains little over AVX2: what is left is moving walks and taking random numbers.

mod eval;
mod sample;
mod walk_states;

use self::eval::EvalWalks;
use self::sample::SampleWalks;
use self::walk_states::{Metal, WALKS};
use super::level::{Arithmetic, Level, Task};
use super::recast::{Recast, convert};
use super::slices::{Colours, Directions, LengthMismatch, SampleOutcome, Samples, check};
use crate::bsdf::{Bsdf, BsdfSample, Event, MultibounceConductor, Transport};
use crate::math::{Real, Stream};
use crate::multibounce::mis_pdf::reflection_of;
use crate::multibounce::normalised;
use crate::multibounce::walk::Facets;
use crate::multibounce::{MisPdf, MultibounceModel};
use crate::ndf::Ndf as _;

const WO: [&str; 3] = ["wo.x", "wo.y", "wo.z"];

impl Level {
    /// [`Bsdf::eval_pdf_random`] of every element: unbiased estimates of `f(wo, wi) |cos theta_i|`
    /// with all bounces, and densities for multiple importance sampling, both in 1/sr; 0 where
    /// `wi.z <= 0`.
    ///
    /// * `wo: (n, 3) T`, `wi: (n, 3) T`, `streams: (n,) Stream` `-> f_cos: (n, 3) T`, `pdf: (n,) T`
    /// * `streams`: one for each element, left where the scalar function leaves it.
    ///
    /// [`MultibounceModel::StratifiedBidirectional`] walks in batches: faster than the scalar function from some twenty elements
    /// on, four times and more for thousands (`f32`, AVX2). The other models are loops over their
    /// scalar functions.
    ///
    /// # Errors
    /// Where a slice is not as long as `f_cos.r`; nothing is written then.
    pub fn eval_pdf_random<T: Real>(
        self,
        metal: &MultibounceConductor<T>,
        wo: Directions<&[T]>,
        wi: Directions<&[T]>,
        streams: &mut [Stream],
        f_cos: Colours<&mut [T]>,
        pdf: &mut [T],
    ) -> Result<(), LengthMismatch> {
        let n = f_cos.r.len();
        check(n, f_cos.lengths(["f_cos.r", "f_cos.g", "f_cos.b"]))?;
        check(n, [("pdf", pdf.len())])?;
        check(n, wo.lengths(WO))?;
        check(n, wi.lengths(["wi.x", "wi.y", "wi.z"]))?;
        check(n, [("streams", streams.len())])?;
        let task = EvalPdf {
            metal,
            wo,
            wi,
            streams,
            f_cos,
            pdf,
        };
        match metal.model() {
            MultibounceModel::StratifiedBidirectional => self.run(task),
            _ => task.one_by_one(),
        }
        Ok(())
    }

    /// [`Bsdf::sample_random`] of every element. A walk that did not leave is [`SampleOutcome::Rejected`] with
    /// `wi`, `weight` and `pdf` all zero.
    ///
    /// * `wo: (n, 3) T`, `u: (n, 3) T` in `[0, 1)`, `streams: (n,) Stream` `-> wi: (n, 3) T`,
    ///   `weight: (n, 3) T`, `pdf: (n,) T`, `outcome: (n,) u8`
    /// * `u`: the last two sample the first facet; all else is sampled from the streams, as for
    ///   [`eval_pdf_random`](Level::eval_pdf_random).
    ///
    /// # Errors
    /// Where a slice is not as long as `wi.x`; nothing is written then.
    pub fn sample_random<T: Real>(
        self,
        metal: &MultibounceConductor<T>,
        wo: Directions<&[T]>,
        u: [&[T]; 3],
        streams: &mut [Stream],
        samples: Samples<&mut [T], &mut [SampleOutcome]>,
    ) -> Result<(), LengthMismatch> {
        let n = samples.pdf.len();
        check(n, samples.lengths())?;
        check(n, wo.lengths(WO))?;
        check(
            n,
            ["u[0]", "u[1]", "u[2]"].into_iter().zip(u.map(<[T]>::len)),
        )?;
        check(n, [("streams", streams.len())])?;
        let task = Sample {
            metal,
            wo,
            u,
            streams,
            samples,
        };
        match metal.model() {
            MultibounceModel::StratifiedBidirectional => self.run(task),
            _ => task.one_by_one(),
        }
        Ok(())
    }
}

/// Runs `$body` with `$mis` standing for a known density, and the constant `TERMS` for its terms, so that the loop in it does
/// not branch.
macro_rules! per_density {
    ($metal:expr, $mis:ident => $body:expr) => {
        match (
            $metal.mis_pdf(),
            normalised::terms($metal.facets().ndf.alpha()),
        ) {
            (MisPdf::Lambert, _) => {
                const TERMS: u8 = normalised::ALL;
                let $mis = MisPdf::Lambert;
                $body
            }
            (MisPdf::Hapke, _) => {
                const TERMS: u8 = normalised::ALL;
                let $mis = MisPdf::Hapke;
                $body
            }
            (MisPdf::Normalised, normalised::RAISED) => {
                const TERMS: u8 = normalised::RAISED;
                let $mis = MisPdf::Normalised;
                $body
            }
            (MisPdf::Normalised, _) => {
                const TERMS: u8 = normalised::ALL;
                let $mis = MisPdf::Normalised;
                $body
            }
        }
    };
}

/// The facets in the scalar of a kernel.
#[inline(always)]
fn recast<T: Real, U: Real>(metal: &MultibounceConductor<T>) -> Metal<U> {
    let Facets { ndf, reflectance } = metal.facets();
    Facets {
        ndf: ndf.recast(),
        reflectance: reflectance.recast(),
    }
}

struct EvalPdf<'a, T> {
    metal: &'a MultibounceConductor<T>,
    wo: Directions<&'a [T]>,
    wi: Directions<&'a [T]>,
    streams: &'a mut [Stream],
    f_cos: Colours<&'a mut [T]>,
    pdf: &'a mut [T],
}

impl<T: Real> EvalPdf<'_, T> {
    fn one_by_one(mut self) {
        let transport = Transport::Radiance;
        for (i, stream) in self.streams.iter_mut().enumerate() {
            let (wo, wi) = (self.wo.at(i), self.wi.at(i));
            let (value, density) = self.metal.eval_pdf_random(wo, wi, transport, stream);
            self.f_cos.set_from(i, value);
            self.pdf[i] = density;
        }
    }
}

impl<T: Real> Task for EvalPdf<'_, T> {
    #[inline(always)]
    fn run<A: Arithmetic>(mut self) {
        let n = self.pdf.len();
        let facets: Metal<A::Of<T>> = recast(self.metal);
        let mut evals = EvalWalks::<A::Of<T>>::NONE;
        let mut start = 0;
        while start < n {
            let end = n.min(start + WALKS);
            let count = end - start;
            let wo = self.wo.range(start, end).first(count);
            let wi = self.wi.range(start, end).first(count);
            let streams = &mut self.streams[start..end][..count];
            let f_cos = self.f_cos.range(start, end).first(count);
            evals.eval(&facets, wo, wi, streams, f_cos);
            let pdf = &mut self.pdf[start..end][..count];
            per_density!(self.metal, mis => for (i, pdf) in pdf.iter_mut().enumerate() {
                *pdf = convert(reflection_of::<_, _, TERMS>(mis, &facets.ndf, wo.get_as(i), wi.get_as(i)));
            });
            start = end;
        }
    }
}

struct Sample<'a, T> {
    metal: &'a MultibounceConductor<T>,
    wo: Directions<&'a [T]>,
    u: [&'a [T]; 3],
    streams: &'a mut [Stream],
    samples: Samples<&'a mut [T], &'a mut [SampleOutcome]>,
}

impl<T: Real> Sample<'_, T> {
    fn one_by_one(mut self) {
        let transport = Transport::Radiance;
        for (i, stream) in self.streams.iter_mut().enumerate() {
            let (wo, u) = (self.wo.at(i), self.u.map(|u| u[i]));
            let sample = self.metal.sample_random(wo, u, transport, stream);
            self.samples.set_from(i, sample);
        }
    }
}

impl<T: Real> Task for Sample<'_, T> {
    #[inline(always)]
    fn run<A: Arithmetic>(mut self) {
        let n = self.samples.pdf.len();
        let facets: Metal<A::Of<T>> = recast(self.metal);
        let mut walks = SampleWalks::<A::Of<T>>::NONE;
        let mut start = 0;
        while start < n {
            let end = n.min(start + WALKS);
            let count = end - start;
            let wo = self.wo.range(start, end).first(count);
            let u = [&self.u[1][start..end], &self.u[2][start..end]];
            walks.sample(&facets, wo, u, &mut self.streams[start..end]);
            let mut samples = self.samples.range(start, end).first(count);
            per_density!(self.metal, mis => for i in 0..count {
                samples.set_from(i, with_density::<_, TERMS>(mis, &facets, &walks, i));
            });
            start = end;
        }
    }
}

/// The sample of element `i` with its density; `None` where the walk did not leave.
#[inline(always)]
fn with_density<U: Real, const TERMS: u8>(
    mis: MisPdf,
    facets: &Metal<U>,
    walks: &SampleWalks<U>,
    i: usize,
) -> Option<BsdfSample<U>> {
    let (wi, weight) = (walks.wi.at(i), walks.weight.at(i));
    let pdf = reflection_of::<_, _, TERMS>(mis, &facets.ndf, walks.wo.at(i), wi);
    let is_sampled = (wi.z > U::ZERO) & (pdf > U::ZERO) & pdf.is_finite();
    is_sampled.then_some(BsdfSample {
        wi,
        weight,
        pdf,
        event: Event::Reflection,
        specular: false,
        eta: U::ONE,
    })
}
