//! Parts of materials: microfacets, metals, and maps that bend normals.

use std::sync::Arc;

use pyo3::prelude::*;
use specula::scene::Scene;
use specula::scene::scene::{
    Bump, ColourParam, ConductorFresnel, FloatParam, MicrofacetDistribution, Roughness,
    RoughnessMapping,
};
use specula_bsdf::math::Rgb;
use specula_bsdf::metals::{METALS, by_symbol};

use super::paint::{ANY, Paint, SHARE};
use crate::parameters::{Alphas, Distribution, in_range, invalid};

pub(super) type Given<'a, 'py> = Option<&'a Bound<'py, PyAny>>;

/// A map that bends normals.
#[derive(Clone)]
pub(super) enum BumpMap {
    /// Heights along the normal, in scene units.
    Heights(Arc<Paint>),
    /// Normals `2 c - 1`, and the factor on x and y.
    Normals(Arc<Paint>, f32),
}

impl BumpMap {
    /// As of a scene's material.
    pub(super) fn build(&self, scene: &mut Scene) -> Option<Bump> {
        Some(match self {
            Self::Heights(heights) => Bump::Height(heights.number(scene)),
            Self::Normals(normals, scale) => match normals.colour(scene) {
                ColourParam::Texture(map) => Bump::Normal { map, scale: *scale },
                ColourParam::Value(_) => return None,
            },
        })
    }

    /// Whether it is the very same map.
    pub(super) fn is(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Heights(a), Self::Heights(b)) => Arc::ptr_eq(a, b),
            (Self::Normals(a, s), Self::Normals(b, t)) => Arc::ptr_eq(a, b) && s == t,
            _ => false,
        }
    }
}

/// The width of microfacets: alpha, or the artist's roughness, whose square it is.
#[derive(Clone)]
enum Width {
    Alphas([f32; 2]),
    Roughness(Paint),
}

/// Microfacets of a material.
#[derive(Clone)]
pub(super) struct Facets {
    width: Width,
    distribution: MicrofacetDistribution,
}

impl Facets {
    pub(super) fn new(
        alpha: Option<Alphas>,
        roughness: Given<'_, '_>,
        distribution: &str,
        default: f32,
    ) -> PyResult<Self> {
        let width = match (alpha, roughness) {
            (Some(_), Some(_)) => {
                return Err(invalid("alpha and roughness exclude each other"));
            }
            (None, Some(given)) => Width::Roughness(Paint::new("roughness", given, SHARE)?),
            (None, None) => Width::Alphas([default; 2]),
            (Some(alphas), None) => {
                let [x, y] = match alphas {
                    Alphas::One(alpha) => [alpha; 2],
                    Alphas::Two(alphas) => alphas,
                };
                Width::Alphas([at_most_one("alpha", x)?, at_most_one("alpha", y)?])
            }
        };
        let distribution = match Distribution::named(distribution)? {
            Distribution::Ggx => MicrofacetDistribution::Ggx,
            Distribution::Beckmann => MicrofacetDistribution::Beckmann,
        };
        Ok(Self {
            width,
            distribution,
        })
    }

    pub(super) fn build(&self, scene: &mut Scene) -> Roughness {
        let smooth = Roughness::smooth();
        let (u, v, mapping) = match &self.width {
            Width::Alphas([u, v]) => (
                FloatParam::Value(*u),
                FloatParam::Value(*v),
                RoughnessMapping::Alpha,
            ),
            Width::Roughness(paint) => {
                let width = paint.number(scene);
                (width, width, RoughnessMapping::Square)
            }
        };
        Roughness {
            u,
            v,
            mapping,
            distribution: self.distribution,
            ..smooth
        }
    }
}

pub(super) fn at_most_one(name: &str, value: f64) -> PyResult<f32> {
    in_range(name, value, [0.0, 1.0]).map(single)
}

/// What a metal reflects.
#[derive(Clone)]
pub(super) enum Metal {
    Index(Paint, Paint),
    Reflectance(Paint),
    Schlick(Paint),
}

impl Metal {
    pub(super) fn new(
        metal: Option<&str>,
        eta: Given<'_, '_>,
        k: Given<'_, '_>,
        reflectance: Given<'_, '_>,
        f0: Given<'_, '_>,
    ) -> PyResult<Self> {
        match (metal, eta, k, reflectance, f0) {
            (None, None, None, None, None) => Self::measured("Au"),
            (Some(symbol), None, None, None, None) => Self::measured(symbol),
            (None, Some(eta), Some(k), None, None) => Ok(Self::Index(
                Paint::new("eta", eta, ANY)?,
                Paint::new("k", k, ANY)?,
            )),
            (None, None, None, Some(reflectance), None) => Ok(Self::Reflectance(Paint::new(
                "reflectance",
                reflectance,
                SHARE,
            )?)),
            (None, None, None, None, Some(f0)) => Ok(Self::Schlick(Paint::new("f0", f0, SHARE)?)),
            _ => Err(invalid(
                "conductor: expected one of metal, eta with k, reflectance, f0",
            )),
        }
    }

    fn measured(symbol: &str) -> PyResult<Self> {
        let Some(metal) = by_symbol(symbol) else {
            let known: Vec<_> = METALS.iter().map(|m| m.symbol).collect();
            return Err(invalid(format!(
                "no such metal: '{symbol}' (expected one of {})",
                known.join(", ")
            )));
        };
        let value = |channels: [f64; 3]| Paint::Value(Rgb::from(channels).cast());
        Ok(Self::Index(value(metal.eta), value(metal.k)))
    }

    pub(super) fn build(&self, scene: &mut Scene) -> ConductorFresnel {
        match self {
            Self::Index(eta, k) => ConductorFresnel::Index {
                eta: eta.colour(scene),
                k: k.colour(scene),
            },
            Self::Reflectance(colour) => ConductorFresnel::Reflectance(colour.colour(scene)),
            Self::Schlick(f0) => ConductorFresnel::Schlick(f0.colour(scene)),
        }
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "rounds to the nearest float"
)]
pub(super) fn single(value: f64) -> f32 {
    value as f32
}
