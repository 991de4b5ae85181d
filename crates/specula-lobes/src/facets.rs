//! The facets of a rough metal, for who follows light between them.

use specula_bsdf::Alpha;
use specula_bsdf::fresnel;

use crate::NamedLobe;
use crate::given::{Argument, Distribution, Given, Value};
use crate::reflectance::Reflectance;

/// Facets of metal.
#[derive(Clone, Copy, Debug)]
pub struct MetalFacets {
    /// Their alphas.
    pub alpha: Alpha<f64>,
    /// Whether their normals are Beckmann's; else GGX's.
    pub is_beckmann: bool,
    /// What each reflects.
    pub reflectance: fresnel::Reflectance<f64>,
}

impl NamedLobe {
    /// The facets of a rough metal; `None` of other kinds.
    #[must_use]
    pub fn metal_facets(&self) -> Option<MetalFacets> {
        if !matches!(self.kind.name, "conductor" | "multibounce-conductor") {
            return None;
        }
        let argument = |(name, value)| Argument {
            name,
            value: Value::of_text(value),
        };
        let arguments: Vec<_> = self.given().map(argument).collect();
        let given = Given {
            parameters: [self.kind.own, self.kind.reflectance],
            arguments: &arguments,
        };
        Some(MetalFacets {
            alpha: given.alpha("alpha").ok()??,
            is_beckmann: given.distribution().ok()? == Distribution::Beckmann,
            reflectance: Reflectance::or_white(given).ok()?.cast(),
        })
    }
}
