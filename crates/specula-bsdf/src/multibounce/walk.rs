//! What every walk over the facets needs: a flight with its rates, a bounce, a connection.
//!
//! The microsurface is a medium whose depth `tau = -ln C1(h) >= 0` is measured by the distribution
//! `C1` of its heights. A ray of direction `d` meets facets at the rate
//!
//! ```text
//! |Lambda(d)| = sigma(-d) / |d_z|      per unit of tau:   1 + Lambda going down, Lambda going up
//! ```
//!
//! whatever `C1` is: that is why results do not depend on the distribution of heights (Heitz et al.
//! 2016, observed; Dupuy et al. 2016 and Bitterli and d'Eon 2022, derived).
//!
//! Here the papers' directions `d` run along the light's path: `d_0 = -wo`, `d_k = wi`.

use crate::fresnel::Reflectance;
use crate::math::{Real, Rgb, Vec3};
use crate::ndf::Ndf;
use crate::vndf::VisibleNormals;

/// Bounces after which a walk ends whatever it carries. Survivors of so many are below 1e-6 of the
/// energy but for views within 1e-3 of the horizon.
pub(crate) const MAX_BOUNCES: usize = 64;

/// Least cosine of a flight: rates are finite.
pub(crate) const LEAST_COS: f64 = 1e-12;

/// A direction of travel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Flight<T> {
    /// Unit.
    pub(crate) d: Vec3<T>,
    /// `sigma(-d)`: area of the facets that it can meet.
    pub(crate) facing: T,
    /// `sigma(d)`: area of the facets that it would meet on its way back.
    pub(crate) backing: T,
    /// `sigma(-d) / |d_z|`.
    pub(crate) rate: T,
}

impl<T: Real> Flight<T> {
    #[inline(always)]
    pub(crate) fn new<N: Ndf<T>>(ndf: &N, d: Vec3<T>) -> Self {
        let below = ndf.lambda_cos(d).at_least(T::of(1e-24));
        let facing = below + (-d.z).at_least(T::ZERO);
        Self {
            d,
            facing,
            backing: below + d.z.at_least(T::ZERO),
            rate: facing / d.z.abs().at_least(T::of(LEAST_COS)),
        }
    }

    /// The same flight, the other way; for flights that enter or leave the surface.
    #[inline(always)]
    pub(crate) fn reversed(&self) -> Self {
        Self {
            d: -self.d,
            facing: self.backing,
            backing: self.facing,
            rate: self.backing / self.d.z.abs().at_least(T::of(LEAST_COS)),
        }
    }

    #[inline(always)]
    pub(crate) fn is_upward(&self) -> bool {
        self.d.z > T::ZERO
    }
}

/// Facets of one material.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Facets<T, N> {
    pub(crate) ndf: N,
    pub(crate) reflectance: Reflectance<T>,
}

impl<T: Real, N: VisibleNormals<T>> Facets<T, N> {
    /// The flight that leaves for `wo`, reversed.
    #[inline(always)]
    pub(crate) fn arriving(&self, wo: Vec3<T>) -> Flight<T> {
        Flight::new(&self.ndf, -wo)
    }

    /// The facet that is met (sampled among those that `-d` sees), its reflectance, and the flight
    /// after it.
    #[inline(always)]
    pub(crate) fn bounce(&self, d: Vec3<T>, u: [T; 2]) -> (Vec3<T>, Rgb<T>, Flight<T>) {
        let (wm, cos, next) = meet(&self.ndf, d, u);
        (wm, self.reflectance.eval(cos), next)
    }

    /// `(F, D / 4)` of the facet that turns `d` to `wi`; zeros where none does.
    #[inline(always)]
    pub(crate) fn connection(&self, d: Vec3<T>, wi: Vec3<T>) -> (Rgb<T>, T) {
        match turn(&self.ndf, d, wi) {
            Some((cos, quarter_d)) => (self.reflectance.eval(cos), quarter_d),
            None => (Rgb::BLACK, T::ZERO),
        }
    }

    /// `f cos` of light that met one facet: `F D / (4 sigma(wo))` times the share that leaves,
    /// `|Lambda_o| / (|Lambda_o| + Lambda_i)`: the height-correlated `G2` of Smith.
    #[inline(always)]
    pub(crate) fn single(&self, arriving: &Flight<T>, leaving: &Flight<T>) -> Rgb<T> {
        let (fresnel, quarter_d) = self.connection(arriving.d, leaving.d);
        let exit = arriving.rate / (arriving.rate + leaving.rate);
        fresnel * (quarter_d / arriving.facing * exit)
    }
}

/// The facet that is met, sampled among those that `-d` sees, the cosine of incidence, and the flight
/// after it.
#[inline(always)]
pub(crate) fn meet<T: Real, N: VisibleNormals<T>>(
    ndf: &N,
    d: Vec3<T>,
    u: [T; 2],
) -> (Vec3<T>, T, Flight<T>) {
    let wm = ndf.sample_wm(-d, u);
    let along = d.dot(wm);
    let after = d - wm * (T::TWO * along);
    (wm, -along, Flight::new(ndf, after))
}

/// The cosine of incidence on the facet that turns `d` to `wi`, and its `D / 4`; `None` where none
/// does.
#[inline(always)]
pub(crate) fn turn<T: Real, N: Ndf<T>>(ndf: &N, d: Vec3<T>, wi: Vec3<T>) -> Option<(T, T)> {
    let wm = wi - d;
    let length = wm.length();
    if wm.z > T::ZERO && length > T::of(1e-6) {
        let wm = wm * (T::ONE / length);
        Some((wi.dot(wm), T::of(0.25) * ndf.d(wm)))
    } else {
        None
    }
}
