//! Multiple bounces between microfacets under Smith's assumption, one file per model.
//!
//! | file | model | estimates | facets |
//! |---|---|---|---|
//! | `heitz2016` | random walk with heights | the truth | metal, dielectric, diffuse |
//! | `bitterli2022` | heights integrated, hyperexponential | the truth | metal |
//! | `wang2022` | independent bounces | a model of its own | metal |
//! | `cui2023` | invariance principle, from one or both ends | the truth | metal |
//! | `stratified_bidirectional` | state without cancellation, both ends, stratified | the truth | metal, dielectric |
//!
//! All evaluate by Monte Carlo: [`Bsdf::eval_pdf_random`](crate::Bsdf::eval_pdf_random) is an
//! unbiased estimate of the model's `f cos`, and
//! [`Bsdf::sample_random`](crate::Bsdf::sample_random) samples by the walk, whose true density is not
//! known: `pdf` is that of [`MisPdf`], for the weights of multiple importance sampling. (Any
//! positive function serves there: the weights of two strategies sum to 1 whatever it is.)
//!
//! Many elements at once: [`Level::eval_pdf_random`](crate::batch::Level::eval_pdf_random) and
//! [`Level::sample_random`](crate::batch::Level::sample_random).

pub(crate) mod bitterli2022;
pub(crate) mod cui2023;
pub(crate) mod heitz2016;
pub(crate) mod interface;
pub(crate) mod mis_pdf;
mod model;
pub(crate) mod normalised;
pub(crate) mod state;
pub(crate) mod stratified_bidirectional;
pub(crate) mod walk;
pub(crate) mod wang2022;

pub use mis_pdf::{MisPdf, UnknownMisPdf};
pub use model::{MultibounceModel, UnknownMultibounceModel};

use crate::math::{Real, Stream, Vec3};

/// A stream for callers without one, seeded by the arguments of `sample` (`wo`, `u`) or `eval` (`wo`, `wi`).
pub(crate) fn seed<T: Real>(wo: Vec3<T>, others: [T; 3]) -> Stream {
    let words = wo.to_array().into_iter().chain(others);
    Stream::new(words.fold(0xcbf2_9ce4_8422_2325, |hash, x| {
        (hash ^ x.to_f64().to_bits())
            .wrapping_mul(0x9e37_79b9_7f4a_7c15)
            .rotate_left(29)
    }))
}
