//! Samplers of visible microfacet normals, one file each with its own pdf.
//!
//! | file | distribution | of | rejected (reflections below the horizon) |
//! |---|---|---|---|
//! | `heitz` | GGX | normals | 50 % at alpha 1, normal incidence |
//! | `cap` | GGX | normals | the same: another map to the same density |
//! | `bounded` | GGX | reflections only | 0 % for isotropic alpha 1 at normal incidence |
//! | `exact` | GGX | reflections only | none |
//! | `beckmann` | Beckmann | normals | fewer: its tails are short |
//!
//! All take views below the horizon (backfacing shading normals, rays inside a microsurface).

pub mod beckmann;
pub mod bounded;
pub mod cap;
pub mod exact;
pub mod heitz;
mod reflections;
mod visible_normals;

pub use reflections::Reflections;
pub use visible_normals::VisibleNormals;

use alloc::borrow::ToOwned;
use alloc::string::String;
use core::fmt;
use core::str::FromStr;

use crate::alpha::Alpha;
use crate::math::{Real, Vec3};
use crate::ndf::Ggx;

/// Which sampler samples reflections off GGX.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Sampler {
    /// Heitz 2018.
    Heitz,
    /// Spherical caps, Dupuy and Benyoub 2023.
    Cap,
    /// Bounded spherical caps, Tokuyoshi and Eto 2024.
    Bounded,
    /// Exactly the reflections above the surface: none rejected. The default at every roughness: the
    /// lowest variance of the four, at the price of some ten nanoseconds, or of seventy where the
    /// alphas differ (`docs/exact-reflection-sampling.md`).
    #[default]
    Exact,
}

impl fmt::Display for Sampler {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Heitz => "heitz",
            Self::Cap => "cap",
            Self::Bounded => "bounded",
            Self::Exact => "exact",
        })
    }
}

/// A name of no sampler.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no such sampler: '{0}' (expected heitz, cap, bounded or exact)")]
pub struct UnknownSampler(pub String);

impl FromStr for Sampler {
    type Err = UnknownSampler;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        match name {
            "heitz" => Ok(Self::Heitz),
            "cap" => Ok(Self::Cap),
            "bounded" => Ok(Self::Bounded),
            "exact" => Ok(Self::Exact),
            _ => Err(UnknownSampler(name.to_owned())),
        }
    }
}

/// `wo` mirrored about `wm`, unit for unit arguments: `2 (wo . wm) wm - wo`.
#[inline(always)]
pub fn reflect<T: Real>(wo: Vec3<T>, wm: Vec3<T>) -> Vec3<T> {
    wm * (T::TWO * wo.dot(wm)) - wo
}

/// `wo` mirrored about a vector `m` of any length.
#[inline(always)]
pub(crate) fn reflect_unnormalised<T: Real>(wo: Vec3<T>, m: Vec3<T>) -> Vec3<T> {
    let scale = T::TWO * wo.dot(m) / m.length_squared();
    Vec3 {
        x: m.x.mad(scale, -wo.x),
        y: m.y.mad(scale, -wo.y),
        z: m.z.mad(scale, -wo.z),
    }
}

/// `Some(wi)` above the horizon.
#[inline(always)]
fn above<T: Real>(wi: Vec3<T>) -> Option<Vec3<T>> {
    if wi.z > T::ZERO { Some(wi) } else { None }
}

/// `D(wm) / (4 N)` for reflections above the horizon, else 0; `norm` is `N` as numerator and
/// denominator.
///
/// `1 / (4 (wo . wm))` is the Jacobian of the half vector (Walter et al. 2007, eq. 14); its cosine
/// cancels against the visible normals'.
#[inline(always)]
pub(crate) fn reflection_density<T: Real>(
    alpha: Alpha<T>,
    wo: Vec3<T>,
    wi: Vec3<T>,
    norm: (T, T),
) -> T {
    let half = wo + wi;
    let d = Ggx::new(alpha).d_along(half, half.length_squared());
    let pdf = d * norm.1 / (T::of(4.0) * norm.0);
    T::select(wi.z > T::ZERO && half.z > T::ZERO, pdf, T::ZERO)
}

/// A direction stretched to unit roughness, with what every sampler needs of it.
#[derive(Clone, Copy)]
pub(crate) struct Stretched<T> {
    /// Unit.
    pub(crate) direction: Vec3<T>,
    /// `1 + direction.z`, without cancellation below the horizon.
    pub(crate) one_plus_z: T,
}

impl<T: Real> Stretched<T> {
    /// `wo` in the space of unit roughness.
    ///
    /// For `z < 0`, `1 + z = (x^2 + y^2) / (1 - z)`. One division serves both signs.
    #[inline(always)]
    pub(crate) fn new(alpha: Alpha<T>, wo: Vec3<T>) -> Self {
        let h = alpha.stretch(wo);
        let h2 = squared_radius(h);
        let length = (h2 + h.z * h.z).sqrt();
        let long = length + h.z.abs();
        let up = h.z >= T::ZERO;
        let factor = T::select(up, T::ONE, long);
        let inverse = T::ONE / (length * factor);
        Self {
            direction: h * (factor * inverse),
            one_plus_z: T::select(up, long, h2) * inverse,
        }
    }
}

/// `x^2 + y^2` with a floor, so that the view straight from below, which sees only facets at the
/// horizon, stays finite.
#[inline(always)]
fn squared_radius<T: Real>(h: Vec3<T>) -> T {
    (h.x * h.x + h.y * h.y).at_least(T::of(1e-24))
}
