//! Densities for multiple importance sampling: close to that of a walk's directions, in closed
//! form.

use alloc::borrow::ToOwned;
use alloc::string::String;
use core::fmt;
use core::str::FromStr;

use super::interface::Interface;
use super::normalised;
use super::walk::Flight;
use crate::math::{Real, Vec3};
use crate::ndf::Ndf;
use crate::vndf::VisibleNormals;

/// Which density. Metals know all; at a [`Dielectric`](crate::bsdf::MultibounceDielectric) `Lambert` and `Normalised`
/// have forms of their own, over the sphere, and `Hapke` is `Lambert`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum MisPdf {
    /// Visible normals plus a Lambertian term (Heitz et al. 2016). Integrates to more than 1: a
    /// weight, not a density.
    Lambert,
    /// Visible normals plus the multiple scattering of an isotropic medium (Cui et al. 2023, eqs. 15
    /// and 16, with `H(mu) = (1 + 2 mu) / (1 + 2 mu sqrt(1 - a))`). Integrates to 0.97 to 1.71: a
    /// weight, not a density. Of reflection alone: at a dielectric it is `Lambert`.
    Hapke,
    /// Specula's: the first flight exactly, the others by maps of the sphere to the upper hemisphere.
    /// Integrates to 1.
    #[default]
    Normalised,
}

impl MisPdf {
    /// Every density.
    pub const ALL: [Self; 3] = [Self::Lambert, Self::Hapke, Self::Normalised];

    /// The name on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Lambert => "lambert",
            Self::Hapke => "hapke",
            Self::Normalised => "normalised",
        }
    }
}

impl fmt::Display for MisPdf {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A name of no density.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no such density: '{0}' (expected lambert, hapke or normalised)")]
pub struct UnknownMisPdf(pub String);

impl FromStr for MisPdf {
    type Err = UnknownMisPdf;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        Self::ALL
            .into_iter()
            .find(|mis| mis.name() == name)
            .ok_or_else(|| UnknownMisPdf(name.to_owned()))
    }
}

/// The density `mis` of a reflected `wi`, in 1/sr; 0 where `wi.z <= 0`, above 0 elsewhere.
#[inline(always)]
pub(crate) fn reflection<T: Real, N: VisibleNormals<T>>(
    mis: MisPdf,
    ndf: &N,
    wo: Vec3<T>,
    wi: Vec3<T>,
) -> T {
    reflection_of::<T, N, { normalised::SOME }>(mis, ndf, wo, wi)
}

/// [`reflection`], by these terms of the normalised density.
#[inline(always)]
pub(crate) fn reflection_of<T: Real, N: VisibleNormals<T>, const TERMS: u8>(
    mis: MisPdf,
    ndf: &N,
    wo: Vec3<T>,
    wi: Vec3<T>,
) -> T {
    if wi.z <= T::ZERO {
        return T::ZERO;
    }
    match mis {
        MisPdf::Lambert => first_facet(ndf, wo, wi) + wi.z * T::INV_PI,
        MisPdf::Hapke => {
            let alpha = ndf.alpha();
            first_facet(ndf, wo, wi) + hapke(T::HALF * (alpha.x + alpha.y), wo.z.abs(), wi.z)
        }
        MisPdf::Normalised => normalised::pdf_of::<T, N, TERMS>(ndf, wo, wi),
    }
}

/// Density of directions after the first facet, over the whole sphere: `D(wm) / (4 sigma(wo))`.
#[inline(always)]
fn first_facet<T: Real, N: Ndf<T>>(ndf: &N, wo: Vec3<T>, wi: Vec3<T>) -> T {
    let wm = wo + wi;
    let length = wm.length();
    if wm.z > T::ZERO && length > T::of(1e-6) {
        ndf.d(wm * (T::ONE / length)) / (T::of(4.0) * ndf.projected_area(wo))
    } else {
        T::ZERO
    }
}

/// Hapke 1981: all but the first scattering in a half space of albedo `a`.
///
/// ```text
/// a / (4 pi) (H(mu_o) H(mu_i) - 1) / (mu_o + mu_i),    H(mu) = (1 + 2 mu) / (1 + 2 mu sqrt(1 - a))
/// ```
#[inline(always)]
fn hapke<T: Real>(a: T, mu_o: T, mu_i: T) -> T {
    // The released code's cap; at 1 the term alone integrates to 1.6.
    let a = a.at_most(T::of(0.975));
    let root = (T::ONE - a).sqrt();
    let h = |mu: T| (T::ONE + T::TWO * mu) / (T::ONE + T::TWO * mu * root);
    // H(0) = 1: two grazing directions leave 0/0, whose limit is finite.
    let sum = (mu_o + mu_i).at_least(T::of(1e-6));
    let excess = (h(mu_o) * h(mu_i) - T::ONE).at_least(T::ZERO);
    a * T::of(0.25) * T::INV_PI * excess / sum
}

/// The share `s` of all but the first flight at a dielectric, in [`interface`].
#[inline(always)]
fn lambert_share<T: Real, N: Ndf<T>>(ndf: &N) -> T {
    let alpha = ndf.alpha();
    let a2 = alpha.x * alpha.y;
    let a4 = a2 * a2;
    (T::of(0.8) * a4 / (a4 + T::of(0.15))).at_least(T::of(0.002))
}

/// The density `mis` at a dielectric, over the sphere: the walk's first flight, which may leave on
/// either side, and a lobe for the rest.
///
/// ```text
/// Normalised:  (1 - s) phase(wo, wi) + s |wi.z| / (2 pi)          integrates to 1
/// Lambert:     phase(wo, wi) + |wi.z| / (2 pi)                    does not
/// ```
///
/// [`MisPdf::Hapke`] is defined for metals only; here it is `Lambert`.
#[inline]
pub(crate) fn interface<T: Real, N: VisibleNormals<T>>(
    mis: MisPdf,
    interface: &Interface<T, N>,
    wo: Vec3<T>,
    wi: Vec3<T>,
) -> T {
    let flight = Flight::new(&interface.ndf, -wo);
    let first = interface.phase(&flight, wi, true) + interface.phase(&flight, wi, false);
    let lobe = wi.z.abs() * T::HALF * T::INV_PI;
    match mis {
        MisPdf::Lambert | MisPdf::Hapke => first + lobe,
        MisPdf::Normalised => {
            let s = lambert_share(&interface.ndf);
            (T::ONE - s) * first + s * lobe
        }
    }
}
