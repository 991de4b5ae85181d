//! Directional transmittance and internal reflectance of a dielectric interface, for coats.
//!
//! ```text
//! T(mu) = int (1 - F(wo.wm)) D_visible(wo, wm) dwm              light from outside that enters
//! R_int = 1 - int_0^1 T(mu) 2 mu dmu / eta^2                    diffuse light reflected inside
//! ```
//!
//! `T` is what the facets seen from `wo` let through. Light refracted downwards stays below: what
//! masking takes from the single-scattering transmission lobe is not lost but refracted again, so
//! that here, where only the amount counts, no masking term belongs. `R_int` follows by
//! reciprocity. What single scattering alone lets through is in `interface_single.rs`, what a layer
//! under the interface absorbs in `interface_layer.rs`.
//!
//! Smooth: closed forms. Rough: tables of `T / (1 - F(mu_e))` and of `R_int`, linear in
//! `(eta - 1)/(eta + 1)`, `sqrt(1.1 alpha / (1 + alpha))` and `sqrt(mu)`, where `mu_e` is a cosine raised by
//! the roughness so that the quotient is smooth. Made by `cargo xtask tables`; largest absolute
//! error of `T` against quadrature, over alpha in [0.02, 1.4], eta in [1.33, 2.4], mu in [0.01, 1]:
//! 6e-3 (test `the_tables_hold_their_bound`). Anisotropic alphas are taken as
//! `sqrt(alpha_x alpha_y)`.

use super::interface_table::{ALPHAS, ETAS, INTERNAL_REFLECTANCE, MUS, TRANSMITTANCE};
use super::neighbours::neighbours;
use crate::fresnel::{dielectric, dielectric_average};
use crate::math::Real;
use crate::ndf::{Ggx, Ndf};

/// Largest value of `alpha / (1 + alpha)`: alpha 10. The table's coordinate is the square root of
/// its share of this.
pub const ALPHA_END: f64 = 10.0 / 11.0;
/// Largest value of the table's coordinate `(eta - 1) / (eta + 1)`: eta 3.
pub const ETA_END: f64 = 0.5;

/// The raised cosine at which the smooth transmittance is factored out of the table.
#[inline]
pub fn effective_cosine<T: Real>(mu: T, alpha: T) -> T {
    let a2 = alpha * alpha;
    ((mu * mu + a2) / (T::ONE + a2)).sqrt()
}

/// Share of the light from outside at the cosine `mu` that enters.
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

/// Share of diffuse light from inside that is reflected.
///
/// * `coat`: `None` for a smooth interface.
/// * `eta`: index inside over outside, in `[1, 3]`.
#[inline]
pub fn internal_reflectance<T: Real>(coat: Option<Ggx<T>>, eta: T) -> T {
    let Some(ggx) = coat else {
        return dielectric_average(T::ONE / eta);
    };
    let (e, a) = (eta_knot(eta, ETAS), alpha_knot(mean_alpha(ggx), ALPHAS));
    e.lerp(|i| a.lerp(|j| table(INTERNAL_REFLECTANCE[i][j])))
}

pub(super) fn eta_knot<T: Real>(eta: T, count: usize) -> Knot<T> {
    Knot::new((eta - T::ONE) / (eta + T::ONE), ETA_END, count)
}

pub(super) fn alpha_knot<T: Real>(alpha: T, count: usize) -> Knot<T> {
    let share = alpha / ((T::ONE + alpha) * T::of(ALPHA_END));
    Knot::new(share.sqrt(), 1.0, count)
}

pub(super) fn cosine_knot<T: Real>(mu: T, count: usize) -> Knot<T> {
    Knot::new(mu.within(T::ZERO, T::ONE).sqrt(), 1.0, count)
}

/// The alpha that stands for both: `sqrt(alpha_x alpha_y)`.
pub(super) fn mean_alpha<T: Real>(ggx: Ggx<T>) -> T {
    (ggx.alpha().x * ggx.alpha().y).sqrt()
}

pub(super) fn table<T: Real>(value: f32) -> T {
    T::of(f64::from(value))
}

/// A place between two knots of a uniform axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Knot<T> {
    low: usize,
    fraction: T,
}

impl<T: Real> Knot<T> {
    /// `x` on the axis `[0, end]` of `count` knots, clamped.
    #[inline]
    pub(super) fn new(x: T, end: f64, count: usize) -> Self {
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_possible_wrap,
            reason = "a dozen knots"
        )]
        let last = (count - 1) as i32;
        let place = (x * T::of(f64::from(last) / end)).within(T::ZERO, T::of(f64::from(last)));
        let low = place.truncated().min(last - 1);
        let fraction = place - T::of_integer(low);
        #[allow(clippy::cast_sign_loss, reason = "clamped to the axis above")]
        let low = low as usize;
        Self { low, fraction }
    }

    #[inline]
    pub(super) fn lerp(&self, at: impl Fn(usize) -> T) -> T {
        let (a, b) = (at(self.low), at(self.low + 1));
        a + (b - a) * self.fraction
    }

    /// [`lerp`](Self::lerp) of a row's values, without an address.
    #[inline(always)]
    pub(super) fn lerp_in<const N: usize>(&self, row: &[T; N]) -> T {
        let [a, b] = neighbours(row, self.low);
        a + (b - a) * self.fraction
    }
}
