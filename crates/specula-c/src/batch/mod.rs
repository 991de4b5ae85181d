//! Lobes over arrays of a caller.

mod blocks;
mod kernels;

use specula_bsdf::Transport;

use crate::failure::Failure;
use crate::lobe::{LobeHandle, Precision};
use crate::pointers::{Caller, Source, Target};

use blocks::{Given, Must, Plan, Targets};
use kernels::Kernels;

/// How elements are computed.
#[derive(Clone, Copy)]
pub(crate) struct How {
    pub(crate) transport: Transport,
    pub(crate) seed: u64,
    /// How many threads share the work; 0: all.
    pub(crate) threads: usize,
}

/// Three arrays to read, and their stride.
pub(crate) struct ToRead<T>(pub(crate) [*const T; 3], pub(crate) usize);

/// Three arrays to write, and their stride.
pub(crate) struct ToWrite<T>(pub(crate) [*mut T; 3], pub(crate) usize);

impl<T: Precision> ToRead<T> {
    fn source<'a>(
        self,
        caller: &'a Caller,
        names: [&str; 3],
        n: usize,
    ) -> Result<Source<'a, T, 3>, Failure> {
        caller.source(names, self.0, self.1, n)
    }
}

impl<T: Precision> ToWrite<T> {
    fn target<'a>(
        self,
        caller: &'a Caller,
        names: [&str; 3],
        n: usize,
    ) -> Result<Option<Target<'a, T, 3>>, Failure> {
        caller.target(names, self.0, self.1, n).map(Some)
    }
}

fn numbers<'a, T: Precision>(
    caller: &'a Caller,
    pdf: *mut T,
    n: usize,
) -> Result<Option<Target<'a, T, 1>>, Failure> {
    caller.target(["pdf"], [pdf], 1, n).map(Some)
}

/// `wo` and `wi`, or `wo` and `u`.
pub(crate) struct Pair<T>(pub(crate) ToRead<T>, pub(crate) ToRead<T>);

impl<T: Precision> Pair<T> {
    fn directions<'a>(self, caller: &'a Caller, n: usize) -> Result<[Given<'a, T>; 2], Failure> {
        let wo = self.0.source(caller, ["wo.x", "wo.y", "wo.z"], n)?;
        let wi = self.1.source(caller, ["wi.x", "wi.y", "wi.z"], n)?;
        Ok([
            Given::new("wo", wo, Must::BeUnit),
            Given::new("wi", wi, Must::BeUnit),
        ])
    }

    fn random<'a>(self, caller: &'a Caller, n: usize) -> Result<[Given<'a, T>; 2], Failure> {
        let wo = self.0.source(caller, ["wo.x", "wo.y", "wo.z"], n)?;
        let u = self.1.source(caller, ["u.x", "u.y", "u.z"], n)?;
        Ok([
            Given::new("wo", wo, Must::BeUnit),
            Given::new("u", u, Must::BeRandom),
        ])
    }
}

const F_COS: [&str; 3] = ["f_cos.x", "f_cos.y", "f_cos.z"];

pub(crate) fn eval<T: Precision>(
    caller: &Caller,
    lobe: &LobeHandle,
    n: usize,
    pair: Pair<T>,
    how: How,
    f_cos: ToWrite<T>,
) -> Result<(), Failure> {
    let plan = Plan {
        n,
        threads: how.threads,
        given: pair.directions(caller, n)?,
        targets: Targets {
            vectors: [f_cos.target(caller, F_COS, n)?, None],
            ..Targets::default()
        },
    };
    let kernels = Kernels::new(T::of_pair(lobe), how);
    plan.run(|block| kernels.eval(block))
}

pub(crate) fn pdf<T: Precision>(
    caller: &Caller,
    lobe: &LobeHandle,
    n: usize,
    pair: Pair<T>,
    how: How,
    pdf: *mut T,
) -> Result<(), Failure> {
    let plan = Plan {
        n,
        threads: how.threads,
        given: pair.directions(caller, n)?,
        targets: Targets {
            numbers: numbers(caller, pdf, n)?,
            ..Targets::default()
        },
    };
    let kernels = Kernels::new(T::of_pair(lobe), how);
    plan.run(|block| kernels.pdf(block))
}

pub(crate) fn eval_pdf<T: Precision>(
    caller: &Caller,
    lobe: &LobeHandle,
    n: usize,
    pair: Pair<T>,
    how: How,
    (f_cos, pdf): (ToWrite<T>, *mut T),
) -> Result<(), Failure> {
    let plan = Plan {
        n,
        threads: how.threads,
        given: pair.directions(caller, n)?,
        targets: Targets {
            vectors: [f_cos.target(caller, F_COS, n)?, None],
            numbers: numbers(caller, pdf, n)?,
            outcomes: None,
        },
    };
    let kernels = Kernels::new(T::of_pair(lobe), how);
    plan.run(|block| kernels.eval_pdf(block))
}

/// Where samples are written.
pub(crate) struct SamplesToWrite<T> {
    pub(crate) wi: ToWrite<T>,
    pub(crate) weight: ToWrite<T>,
    pub(crate) pdf: *mut T,
    pub(crate) outcome: *mut u8,
}

pub(crate) fn sample<T: Precision>(
    caller: &Caller,
    lobe: &LobeHandle,
    n: usize,
    pair: Pair<T>,
    how: How,
    samples: SamplesToWrite<T>,
) -> Result<(), Failure> {
    let weights = ["weight.x", "weight.y", "weight.z"];
    let plan = Plan {
        n,
        threads: how.threads,
        given: pair.random(caller, n)?,
        targets: Targets {
            vectors: [
                samples.wi.target(caller, ["wi.x", "wi.y", "wi.z"], n)?,
                samples.weight.target(caller, weights, n)?,
            ],
            numbers: numbers(caller, samples.pdf, n)?,
            outcomes: Some(caller.target(["outcome"], [samples.outcome], 1, n)?),
        },
    };
    let kernels = Kernels::new(T::of_pair(lobe), how);
    plan.run(|block| kernels.sample(block))
}
