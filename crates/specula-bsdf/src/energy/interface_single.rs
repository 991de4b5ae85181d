//! Transmittance and internal reflectance of a dielectric interface whose facets scatter once, for
//! coats.
//!
//! ```text
//! T(mu) = int (1 - F(wo.wm)) G2(wo, wi) / G1(wo) D_visible(wo, wm) dwm,   wi refracted, below
//! R_int = int_0^1 int F(wo.wm) G2(wo, wi) / G1(wo) D_visible(wo, wm) dwm 2 mu dmu,
//!                                                     wo, wi inside, wi reflected, still inside
//! ```
//!
//! In contrast to `interface.rs`, what masking takes and what leaves on the wrong side is lost, as
//! in a path tracer whose rough interfaces scatter singly (pbrt-v4's layered materials). `T` is
//! reciprocal: the share of diffuse light from below that leaves is `int T(mu) 2 mu dmu / eta^2`.
//!
//! Tables of `T / (1 - F(mu_e))` and of `R_int / (1 - 1/eta^2)` on the coordinates of
//! `interface.rs`. Made by `cargo xtask tables`; largest absolute errors against quadrature, over
//! alpha in [0.02, 1.4], eta in [1.2, 2.4], mu in [0.01, 1] (test
//! `single_scattering_holds_its_bounds`): 8e-3 of `T`, 2e-3 of `R_int`. Anisotropic alphas are taken
//! as `sqrt(alpha_x alpha_y)`.

use super::interface::{
    Knot, alpha_knot, cosine_knot, effective_cosine, eta_knot, mean_alpha, table,
};
use super::interface_single_table::{
    ALPHAS, ETAS, INTERNAL_ETAS, INTERNAL_REFLECTANCE, MUS, TRANSMITTANCE,
};
use crate::fresnel::{dielectric, dielectric_average};
use crate::math::Real;
use crate::ndf::Ggx;

/// Share of the light from outside at the cosine `mu` that enters by one scattering.
///
/// * `coat`: `None` for a smooth interface.
/// * `eta`: index inside over outside, in `[1, 3]`.
#[inline]
pub fn transmittance<T: Real>(coat: Option<Ggx<T>>, eta: T, mu: T) -> T {
    let Some(ggx) = coat else {
        return dielectric(mu, eta).transmittance;
    };
    let alpha = mean_alpha(ggx);
    let smooth = dielectric(effective_cosine(mu, alpha), eta).transmittance;
    (smooth * quotient(places(eta, alpha), mu)).within(T::ZERO, T::ONE)
}

/// The places of an interface in the table of `T / (1 - F(mu_e))`.
#[inline]
pub(super) fn places<T: Real>(eta: T, alpha: T) -> [Knot<T>; 2] {
    [eta_knot(eta, ETAS), alpha_knot(alpha, ALPHAS)]
}

/// `T / (1 - F(mu_e))`.
#[inline(always)]
pub(super) fn quotient<T: Real>([e, a]: [Knot<T>; 2], mu: T) -> T {
    let m = cosine_knot(mu, MUS);
    m.lerp(|k| quotient_at([e, a], k))
}

/// `T / (1 - F(mu_e))` at a knot of the cosines.
#[inline(always)]
pub(super) fn quotient_at<T: Real>([e, a]: [Knot<T>; 2], k: usize) -> T {
    e.lerp(|i| a.lerp(|j| table(TRANSMITTANCE[i][j][k])))
}

/// Share of the light from outside at the cosine `mu` that the interface reflects, roughly: Fresnel's
/// factor at a cosine raised by the roughness. Good enough to choose between strategies.
#[inline]
pub fn reflectance_estimate<T: Real>(coat: Option<Ggx<T>>, eta: T, mu: T) -> T {
    let mu = match coat {
        Some(ggx) => effective_cosine(mu, mean_alpha(ggx)),
        None => mu,
    };
    dielectric(mu, eta).reflectance
}

/// Share of diffuse light from inside that is reflected by one scattering.
///
/// * `coat`: `None` for a smooth interface.
/// * `eta`: index inside over outside, in `[1, 3]`.
#[inline]
pub fn internal_reflectance<T: Real>(coat: Option<Ggx<T>>, eta: T) -> T {
    let Some(ggx) = coat else {
        return dielectric_average(T::ONE / eta);
    };
    let e = eta_knot(eta, INTERNAL_ETAS);
    let a = alpha_knot(mean_alpha(ggx), ALPHAS);
    let quotient = e.lerp(|i| a.lerp(|j| table(INTERNAL_REFLECTANCE[i][j])));
    quotient * (T::ONE - T::ONE / (eta * eta))
}
