//! Loops over the elements of a block: vectors where the batches of `specula-bsdf` know the lobe, else one by one.

use specula_bsdf::batch::{Colours, Directions, LengthMismatch, Level, SampleOutcome};
use specula_bsdf::bsdf::Lobe;
use specula_bsdf::math::{Real, Stream, vec3};
use specula_bsdf::{Bsdf, BsdfSample, Event, batch};

use super::How;
use super::blocks::Block;
use crate::lobe::Precision;

/// The loops of a lobe.
pub(super) struct Kernels<'a, T> {
    lobe: &'a Lobe<T>,
    how: How,
}

/// Runs `$call` with a lobe that batches know, or `$other`.
macro_rules! batched {
    ($lobe:expr, $l:ident => $call:expr, _ => $other:expr) => {
        match $lobe {
            Lobe::Lambert($l) => known($call),
            Lobe::Eon($l) => known($call),
            Lobe::DiffuseTransmission($l) => known($call),
            Lobe::SmoothConductor($l) => known($call),
            Lobe::RoughConductor($l) => known($call),
            Lobe::SmoothDielectric($l) => known($call),
            Lobe::RoughDielectric($l) => known($call),
            Lobe::ThinDielectric($l) => known($call),
            _ => $other,
        }
    };
}

/// The slices of a block are of one length.
fn known(done: Result<(), LengthMismatch>) {
    debug_assert!(done.is_ok(), "{done:?}");
}

fn directions<T>([x, y, z]: [&[T]; 3]) -> Directions<&[T]> {
    Directions { x, y, z }
}

fn colours<T>([r, g, b]: [&mut [T]; 3]) -> Colours<&mut [T]> {
    Colours { r, g, b }
}

impl<'a, T: Precision> Kernels<'a, T> {
    pub(super) fn new(lobe: &'a Lobe<T>, how: How) -> Self {
        Self { lobe, how }
    }

    /// The random numbers of an element: the same wherever it is computed.
    fn stream(&self, index: usize) -> Stream {
        // Steps of a large odd number, so that streams of neighbours do not overlap.
        let step = (index as u64).wrapping_mul(0xd134_2543_de82_ef95);
        Stream::new(self.how.seed.rotate_left(32).wrapping_add(step))
    }

    pub(super) fn eval(&self, block: Block<'_, T>) {
        let [wo, wi] = block.sources.map(directions);
        let [to, _] = block.vectors;
        let (level, transport) = (Level::best(), self.how.transport);
        if self.lobe.is_stochastic() {
            let mut densities = vec![T::ZERO; wo.x.len()];
            self.random(block.start, wo, wi, to, &mut densities);
            return;
        }
        batched!(self.lobe, l => level.eval(l, wo, wi, transport, colours(to)), _ => {
            let [r, g, b] = to;
            for i in 0..r.len() {
                let (wo, wi) = (at(wo, i), at(wi, i));
                let f = self.lobe.eval(wo, wi, transport);
                (r[i], g[i], b[i]) = (f.r, f.g, f.b);
            }
        });
    }

    pub(super) fn pdf(&self, block: Block<'_, T>) {
        let [wo, wi] = block.sources.map(directions);
        let level = Level::best();
        batched!(self.lobe, l => level.pdf(l, wo, wi, block.numbers), _ => {
            for (i, pdf) in block.numbers.iter_mut().enumerate() {
                *pdf = self.lobe.pdf(at(wo, i), at(wi, i));
            }
        });
    }

    pub(super) fn eval_pdf(&self, block: Block<'_, T>) {
        let [wo, wi] = block.sources.map(directions);
        let [to, _] = block.vectors;
        let pdf = block.numbers;
        let (level, transport) = (Level::best(), self.how.transport);
        if self.lobe.is_stochastic() {
            self.random(block.start, wo, wi, to, pdf);
            return;
        }
        batched!(self.lobe, l => level.eval_pdf(l, wo, wi, transport, colours(to), pdf), _ => {
            let [r, g, b] = to;
            for i in 0..r.len() {
                let (f, p) = self.lobe.eval_pdf(at(wo, i), at(wi, i), transport);
                (r[i], g[i], b[i], pdf[i]) = (f.r, f.g, f.b, p);
            }
        });
    }

    /// Estimates and densities of a lobe that is itself random.
    fn random(
        &self,
        start: usize,
        wo: Directions<&[T]>,
        wi: Directions<&[T]>,
        [r, g, b]: [&mut [T]; 3],
        pdf: &mut [T],
    ) {
        if let Lobe::MultibounceConductor(metal) = self.lobe {
            let mut streams: Vec<_> = (0..r.len()).map(|i| self.stream(start + i)).collect();
            let f_cos = Colours { r, g, b };
            known(Level::best().eval_pdf_random(metal, wo, wi, &mut streams, f_cos, pdf));
            return;
        }
        for i in 0..r.len() {
            let mut stream = self.stream(start + i);
            let (wo, wi) = (at(wo, i), at(wi, i));
            let (f, p) = self
                .lobe
                .eval_pdf_random(wo, wi, self.how.transport, &mut stream);
            (r[i], g[i], b[i], pdf[i]) = (f.r, f.g, f.b, p);
        }
    }

    pub(super) fn sample(&self, block: Block<'_, T>) {
        let Block {
            start,
            sources: [wo, u],
            vectors: [wi, weight],
            numbers: pdf,
            outcomes,
        } = block;
        let wo = directions(wo);
        let [x, y, z] = wi;
        let samples = batch::Samples {
            wi: Directions { x, y, z },
            weight: colours(weight),
            pdf,
            outcome: outcomes,
        };
        let (level, transport) = (Level::best(), self.how.transport);
        if let Lobe::MultibounceConductor(metal) = self.lobe {
            let n = samples.pdf.len();
            let mut streams: Vec<_> = (0..n).map(|i| self.stream(start + i)).collect();
            known(level.sample_random(metal, wo, u, &mut streams, samples));
            return;
        }
        batched!(self.lobe, l => level.sample(l, wo, u, transport, samples), _ => {
            let mut samples = samples;
            for i in 0..samples.pdf.len() {
                let mut stream = self.stream(start + i);
                let u = u.map(|u| u[i]);
                let sample = self.lobe.sample_random(at(wo, i), u, transport, &mut stream);
                store(&mut samples, i, sample);
            }
        });
    }
}

fn at<T: Real>(directions: Directions<&[T]>, i: usize) -> specula_bsdf::Vec3<T> {
    vec3(directions.x[i], directions.y[i], directions.z[i])
}

fn store<T: Real>(
    to: &mut batch::Samples<&mut [T], &mut [SampleOutcome]>,
    i: usize,
    sample: Option<BsdfSample<T>>,
) {
    let (wi, weight, pdf, outcome) = match sample {
        None => {
            let zero = specula_bsdf::Vec3::ZERO;
            (
                zero,
                specula_bsdf::Rgb::BLACK,
                T::ZERO,
                SampleOutcome::Rejected,
            )
        }
        Some(s) => {
            let outcome = match (s.event, s.specular) {
                (Event::Reflection, false) => SampleOutcome::Reflection,
                (Event::Transmission, false) => SampleOutcome::Transmission,
                (Event::Reflection, true) => SampleOutcome::SpecularReflection,
                (Event::Transmission, true) => SampleOutcome::SpecularTransmission,
            };
            (s.wi, s.weight, s.pdf, outcome)
        }
    };
    (to.wi.x[i], to.wi.y[i], to.wi.z[i]) = (wi.x, wi.y, wi.z);
    (to.weight.r[i], to.weight.g[i], to.weight.b[i]) = (weight.r, weight.g, weight.b);
    to.pdf[i] = pdf;
    to.outcome[i] = outcome;
}
