//! What runs over the elements of a block: the batches of `specula-bsdf`.

use specula_bsdf::batch::{Any, Colours, Directions, LengthMismatch, Level, LobeBatches, Samples};
use specula_bsdf::bsdf::Transport;

use super::any_lobe::AnyLobe;
use crate::arrays::Scalar;
use crate::parallel::Block;

/// The batches of a BSDF.
pub(crate) struct Kernels<'a, T> {
    lobe: &'a AnyLobe<T>,
    transport: Transport,
    seed: u64,
}

/// Runs `$call` with the batches of a lobe, or `$other` with what else there is, one by one.
macro_rules! batches {
    ($kernels:expr, $lobe:ident => $call:expr, $any:ident => $other:expr) => {
        match $kernels.lobe {
            AnyLobe::Lobe(lobe) => {
                let $lobe = LobeBatches::new(lobe, $kernels.transport, $kernels.seed);
                $call
            }
            AnyLobe::Hair(hair) => {
                let $any = &Any(*hair);
                $other
            }
            AnyLobe::Measured(measured) => {
                let $any = &Any(&**measured);
                $other
            }
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

impl<'a, T: Scalar> Kernels<'a, T> {
    pub(crate) fn new(lobe: &'a AnyLobe<T>, transport: Transport, seed: u64) -> Self {
        Self {
            lobe,
            transport,
            seed,
        }
    }

    pub(crate) fn eval(&self, block: Block<'_, T>) {
        let [wo, wi] = block.sources.map(directions);
        let [f_cos, _] = block.vectors.map(colours);
        let (level, transport) = (Level::best(), self.transport);
        known(batches!(self,
            lobe => lobe.eval(block.start, wo, wi, f_cos),
            any => level.eval(any, wo, wi, transport, f_cos)
        ));
    }

    pub(crate) fn pdf(&self, block: Block<'_, T>) {
        let [wo, wi] = block.sources.map(directions);
        known(batches!(self,
            lobe => lobe.pdf(wo, wi, block.numbers),
            any => Level::best().pdf(any, wo, wi, block.numbers)
        ));
    }

    pub(crate) fn eval_pdf(&self, block: Block<'_, T>) {
        let [wo, wi] = block.sources.map(directions);
        let [f_cos, _] = block.vectors.map(colours);
        let (level, transport) = (Level::best(), self.transport);
        known(batches!(self,
            lobe => lobe.eval_pdf(block.start, wo, wi, f_cos, block.numbers),
            any => level.eval_pdf(any, wo, wi, transport, f_cos, block.numbers)
        ));
    }

    pub(crate) fn sample(&self, block: Block<'_, T>) {
        let [wo, u] = block.sources;
        let [[x, y, z], weight] = block.vectors;
        let wo = directions(wo);
        let samples = Samples {
            wi: Directions { x, y, z },
            weight: colours(weight),
            pdf: block.numbers,
            outcome: block.outcomes,
        };
        let (level, transport) = (Level::best(), self.transport);
        known(batches!(self,
            lobe => lobe.sample(block.start, wo, u, samples),
            any => level.sample(any, wo, u, transport, samples)
        ));
    }
}
