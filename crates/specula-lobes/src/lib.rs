//! Lobes by name and parameters: `conductor Au alpha 0.3`, and their kinds and parameters as data.
//!
//! [`parse`] reads a line of text, [`make`] takes arguments; both return a [`NamedLobe`], which holds the lobe in both
//! precisions and says itself in its normal form. [`kinds`] lists every kind with its parameters: type, default,
//! range, choices and a line of documentation, for controls and for readers. [`AnyLobe`] is what the C interface and the
//! Python package hold: such a lobe, hair, or a measured material.
//!
//! ```
//! use specula_bsdf::Bsdf;
//!
//! let gold = specula_lobes::parse("conductor Au alpha 0.1 0.4")?;
//! assert_eq!(gold.to_string(), "conductor Au alpha 0.1,0.4");
//! assert!(!gold.double().is_stochastic());
//! # Ok::<(), specula_lobes::LobeError>(())
//! ```
#![forbid(unsafe_code)]

mod any_lobe;
mod catalogue;
mod compound;
mod facets;
mod given;
mod kind;
mod kinds;
mod microfacet;
mod normal_form;
mod parameter;
mod reflectance;
mod text;

pub use any_lobe::{AnyBatches, AnyLobe, Precision};
pub use facets::MetalFacets;
pub use given::{Argument, Value};
pub use kind::Kind;
pub use kinds::{kinds, make};
pub use parameter::{Parameter, ParameterKind};
pub use reflectance::metal;
pub use text::parse;

use specula_bsdf::Bsdf;
use specula_bsdf::bsdf::Lobe;

/// Why a text or arguments make no lobe: what is wrong, and what was expected.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct LobeError(String);

/// A lobe in both precisions.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Pair {
    single: Lobe<f32>,
    double: Lobe<f64>,
}

/// A lobe with its kind and what was given of it.
///
/// Printed, it is its normal form: the kind, a metal's symbol, then the keys that were given in the order of the
/// kind's parameters. Read again, that is the same lobe.
#[derive(Clone, Debug)]
pub struct NamedLobe {
    kind: &'static Kind,
    given: Vec<(&'static str, String)>,
    pair: Pair,
}

impl NamedLobe {
    /// Its kind.
    #[must_use]
    pub fn kind(&self) -> &'static Kind {
        self.kind
    }

    /// What was given, by key, in the order of the kind's parameters; values as a text has them.
    pub fn given(&self) -> impl Iterator<Item = (&'static str, &str)> {
        self.given.iter().map(|(key, value)| (*key, value.as_str()))
    }

    /// The lobe in single precision.
    #[must_use]
    pub fn single(&self) -> &Lobe<f32> {
        &self.pair.single
    }

    /// The lobe in double precision.
    #[must_use]
    pub fn double(&self) -> &Lobe<f64> {
        &self.pair.double
    }

    /// Whether values are estimates.
    #[must_use]
    pub fn is_stochastic(&self) -> bool {
        self.pair.double.is_stochastic()
    }

    /// Whether nothing but Dirac deltas is left.
    #[must_use]
    pub fn is_specular(&self) -> bool {
        self.pair.double.is_specular()
    }
}

/// A lobe in both precisions, by an expression that is generic over them.
macro_rules! both {
    ($T:ident => $lobe:expr) => {{
        let single = {
            type $T = f32;
            specula_bsdf::bsdf::Lobe::<f32>::from($lobe)
        };
        let double = {
            type $T = f64;
            specula_bsdf::bsdf::Lobe::<f64>::from($lobe)
        };
        crate::Pair { single, double }
    }};
}
use both;

/// The Rust of the README compiles and runs.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

#[cfg(test)]
mod tests;
