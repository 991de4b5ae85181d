//! Lobes out of parameters: those of a text, and those of an array.

mod compound;
mod given;
mod kinds;
mod microfacet;
mod reflectance;
mod text;

use specula_bsdf::Bsdf;
use specula_bsdf::bsdf;
use specula_bsdf::math::Real;

pub(crate) use given::{Parameter, Value};
pub(crate) use kinds::make;
pub(crate) use reflectance::metal;
pub(crate) use text::parse;

/// A lobe: what a surface does with light. `specula_lobe_free` frees it.
pub struct LobeHandle {
    single: bsdf::Lobe<f32>,
    double: bsdf::Lobe<f64>,
}

impl LobeHandle {
    /// Whether values are estimates.
    pub(crate) fn is_stochastic(&self) -> bool {
        self.double.is_stochastic()
    }

    /// Whether nothing but Dirac deltas is left.
    pub(crate) fn is_specular(&self) -> bool {
        self.double.is_specular()
    }
}

/// A precision that lobes are kept in.
pub(crate) trait Precision: Real {
    /// The lobe in it.
    fn of_pair(lobe: &LobeHandle) -> &bsdf::Lobe<Self>;
}

impl Precision for f32 {
    fn of_pair(lobe: &LobeHandle) -> &bsdf::Lobe<f32> {
        &lobe.single
    }
}

impl Precision for f64 {
    fn of_pair(lobe: &LobeHandle) -> &bsdf::Lobe<f64> {
        &lobe.double
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
        crate::lobe::LobeHandle { single, double }
    }};
}
use both;

#[cfg(test)]
mod tests;
