//! What runs over the elements of a block: the batches of `specula-bsdf`.

use specula_bsdf::batch::{Colours, Directions, LengthMismatch, Samples};
use specula_bsdf::bsdf::Transport;
use specula_lobes::{AnyBatches, AnyLobe};

use crate::arrays::Scalar;
use crate::parallel::Block;

/// The batches of a BSDF.
pub(crate) struct Kernels<'a, T>(AnyBatches<'a, T>);

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

impl<'a, T: Scalar> Kernels<'a, T> {
    pub(crate) fn new(lobe: &'a AnyLobe<T>, transport: Transport, seed: u64) -> Self {
        Self(lobe.batches(transport, seed))
    }

    pub(crate) fn eval(&self, block: Block<'_, T>) {
        let [wo, wi] = block.sources.map(directions);
        let [f_cos, _] = block.vectors.map(colours);
        known(self.0.eval(block.start, wo, wi, f_cos));
    }

    pub(crate) fn pdf(&self, block: Block<'_, T>) {
        let [wo, wi] = block.sources.map(directions);
        known(self.0.pdf(wo, wi, block.numbers));
    }

    pub(crate) fn eval_pdf(&self, block: Block<'_, T>) {
        let [wo, wi] = block.sources.map(directions);
        let [f_cos, _] = block.vectors.map(colours);
        known(self.0.eval_pdf(block.start, wo, wi, f_cos, block.numbers));
    }

    pub(crate) fn sample(&self, block: Block<'_, T>) {
        let [wo, u] = block.sources;
        let [[x, y, z], weight] = block.vectors;
        let samples = Samples {
            wi: Directions { x, y, z },
            weight: colours(weight),
            pdf: block.numbers,
            outcome: block.outcomes,
        };
        known(self.0.sample(block.start, directions(wo), u, samples));
    }
}
