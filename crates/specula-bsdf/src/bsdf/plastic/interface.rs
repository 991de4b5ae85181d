//! Transmittance and internal reflectance of the coats of Mitsuba 3's plastics.
//!
//! ```text
//! T(mu) = int (1 - F(wo.wm)) G1(wt) D_visible(wo, wm) dwm                rough: single refraction
//! R_int = 2/64 sum_k mu_k int F(wo.wm) G1(wr) D_visible(wo, wm) dwm      mu_k = k/63, from inside
//! ```
//!
//! with `wt`, `wr` the refracted and the reflected direction. `R_int` is the sum that `roughplastic`
//! takes, a rectangle rule with both its ends (1.5 % below the integral for a narrow lobe), so that
//! pictures agree with Mitsuba's.
//!
//! A smooth coat has `T = 1 - F` and a published fit of `R_int`, as `plastic` has.
//!
//! Rough: tables, cubic in `(eta - 1)/(eta + 1)`, `sqrt(1.1 alpha / (1 + alpha))` and `sqrt(mu)`,
//! made by `cargo xtask tables`. Largest absolute error of `T` against quadrature over alpha in
//! [0.01, 1.4], eta in [1.33, 2.4], mu in [0.05, 1]: 3e-3 (test `the_plastic_tables_hold_their_bound`).
//! Mitsuba's own table is linear in 63 steps of mu: it is above the integral by up to 0.02 below
//! mu = 0.02. Anisotropic alphas are taken as `sqrt(alpha_x alpha_y)`.

use alloc::vec::Vec;

use super::interface_table::{ALPHAS, ETAS, INTERNAL_REFLECTANCE, MUS, TRANSMITTANCE};
use crate::energy::Tabulated;
use crate::energy::albedo::TabulatedNdf;
use crate::energy::interface_coat::{Entrance, Incident};
use crate::energy::stencil::Stencil;
use crate::fresnel::dielectric;
use crate::math::Real;

/// Largest entry of the tables.
pub const SCALE: f64 = 65535.0;

/// The transmittance of a rough coat at its knots in `sqrt(mu)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Interface<T> {
    knots: [T; MUS],
}

impl<T: Real> Interface<T> {
    /// Of no account: smooth coats have closed forms.
    #[inline(always)]
    pub(super) fn smooth() -> Self {
        Self {
            knots: [T::ONE; MUS],
        }
    }

    /// The table at an alpha and an index in `[1, 3]`, and the internal reflectance there.
    #[inline]
    pub(super) fn rough<N: Tabulated<T>>(ndf: N, eta: T) -> (Self, T) {
        let which = match N::TABLES {
            TabulatedNdf::Ggx => 0,
            TabulatedNdf::Beckmann => 1,
        };
        let alpha = (ndf.alpha().x * ndf.alpha().y).sqrt();
        let e = Stencil::new(eta_coordinate(eta), ETAS);
        let a = Stencil::new(alpha_coordinate(alpha), ALPHAS);
        let entry = |x: u16| T::of(f64::from(x) / SCALE);
        let knots =
            core::array::from_fn(|k| e.sum(|i| a.sum(|j| entry(TRANSMITTANCE[which][i][j][k]))));
        let internal = e.sum(|i| a.sum(|j| entry(INTERNAL_REFLECTANCE[which][i][j])));
        (Self { knots }, internal)
    }

    /// `T(mu)`, in `[0, 1]`.
    #[inline(always)]
    fn transmittance(&self, mu: T) -> T {
        let at = Stencil::new(mu.at_least(T::ZERO).sqrt(), MUS);
        at.sum(|k| self.knots[k]).within(T::ZERO, T::ONE)
    }
}

/// A rough coat's interface, one direction after the other.
#[derive(Clone, Copy)]
pub(crate) struct RoughEntrance<'a, T> {
    pub(super) eta: T,
    pub(super) interface: &'a Interface<T>,
}

/// The same for batches: without branches and addresses.
#[derive(Clone, Copy)]
pub(crate) struct EntranceInRow<T> {
    pub(super) eta: T,
    pub(super) interface: Interface<T>,
}

/// A smooth coat's interface.
#[derive(Clone, Copy)]
pub(crate) struct SmoothEntrance<T> {
    pub(super) eta: T,
}

impl<T: Real> Entrance<T> for RoughEntrance<'_, T> {
    #[inline(always)]
    fn incident(&self, mu: T) -> Incident<T> {
        Incident {
            reflected: dielectric(mu, self.eta).reflectance,
            arriving: self.interface.transmittance(mu),
        }
    }
}

impl<T: Real> Entrance<T> for EntranceInRow<T> {
    #[inline(always)]
    fn incident(&self, mu: T) -> Incident<T> {
        let at = Stencil::new(mu.at_least(T::ZERO).sqrt(), MUS);
        let sum = at.sum_in(&self.interface.knots);
        Incident {
            reflected: dielectric(mu, self.eta).reflectance,
            arriving: sum.within(T::ZERO, T::ONE),
        }
    }
}

impl<T: Real> Entrance<T> for SmoothEntrance<T> {
    #[inline(always)]
    fn incident(&self, mu: T) -> Incident<T> {
        let there = dielectric(mu, self.eta);
        Incident {
            reflected: there.reflectance,
            arriving: there.transmittance,
        }
    }
}

/// `T(mu)` of a rough coat, by the tables.
///
/// * `eta`: index inside over that outside, in `[1, 3]`.
pub fn transmittance<T: Real, N: Tabulated<T>>(ndf: N, eta: T, mu: T) -> T {
    Interface::rough(ndf, eta).0.transmittance(mu)
}

/// The tables as plain values, for shaders: `T` by distribution, index, alpha and cosine, and `R_int`
/// by distribution, index and alpha.
pub fn raw_tables() -> [Vec<f32>; 2] {
    let share = |&x: &u16| f32::from(x) / 65535.0;
    let rows = TRANSMITTANCE.as_flattened().as_flattened().as_flattened();
    let internal = INTERNAL_REFLECTANCE.as_flattened().as_flattened();
    [rows, internal].map(|table| table.iter().map(share).collect())
}

/// The tables' coordinate of an index.
#[inline(always)]
fn eta_coordinate<T: Real>(eta: T) -> T {
    T::TWO * (eta - T::ONE) / (eta + T::ONE)
}

/// The tables' coordinate of an alpha: 0 to 1 for alpha from 0 to 10.
#[inline(always)]
fn alpha_coordinate<T: Real>(alpha: T) -> T {
    (T::of(1.1) * alpha / (T::ONE + alpha)).sqrt()
}

/// Mitsuba's fits of the diffuse reflectance of a smooth interface from inside.
///
/// ```text
/// 0.0636 eta + 0.6681 + 0.7099 / eta - 1.4399 / eta^2                    eta > 1
/// a polynomial of degree 5 in eta                                        eta <= 1
/// ```
///
/// * `eta`: index inside over outside.
///
/// Source: Egan and Hilgeman 1973; d'Eon and Irving 2011.
#[inline]
pub fn smooth_internal_reflectance<T: Real>(eta: T) -> T {
    let inverse = T::ONE / eta;
    if eta > T::ONE {
        let falling = T::of(0.7099) - T::of(1.4399) * inverse;
        T::of(0.0636) * eta + T::of(0.6681) + inverse * falling
    } else {
        [-1.36881, 4.98554, -7.80989, 6.75335, -3.4793, 0.919317]
            .into_iter()
            .fold(T::ZERO, |sum, c| sum * eta + T::of(c))
    }
}
