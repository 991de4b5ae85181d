//! What runs over the elements of a block: the batches of `specula-bsdf`.

use specula_bsdf::batch::{Colours, Directions, LengthMismatch, Samples};
use specula_lobes::{AnyBatches, AnyLobe};

use super::How;
use super::blocks::Block;
use crate::lobe::Precision;

/// The batches of a lobe.
pub(super) struct Kernels<'a, T>(AnyBatches<'a, T>);

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
    pub(super) fn new(lobe: &'a AnyLobe<T>, how: How) -> Self {
        Self(lobe.batches(how.transport, how.seed))
    }

    pub(super) fn eval(&self, block: Block<'_, T>) {
        let [wo, wi] = block.sources.map(directions);
        let [f_cos, _] = block.vectors.map(colours);
        known(self.0.eval(block.start, wo, wi, f_cos));
    }

    pub(super) fn pdf(&self, block: Block<'_, T>) {
        let [wo, wi] = block.sources.map(directions);
        known(self.0.pdf(wo, wi, block.numbers));
    }

    pub(super) fn eval_pdf(&self, block: Block<'_, T>) {
        let [wo, wi] = block.sources.map(directions);
        let [f_cos, _] = block.vectors.map(colours);
        known(self.0.eval_pdf(block.start, wo, wi, f_cos, block.numbers));
    }

    pub(super) fn sample(&self, block: Block<'_, T>) {
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
