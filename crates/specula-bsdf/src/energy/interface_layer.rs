//! What an absorbing layer under a dielectric interface takes, for coats.
//!
//! The transmittance of a layer of optical thickness `t` at the cosine `mu` is `exp(-t / mu)`. Its
//! mean `<>` over the directions that a rough interface refracts to, of light from outside at the
//! cosine `mu`, and over those of diffuse light that the interface reflects inside, up at `mu_i` and
//! down at `mu_r`:
//!
//! ```text
//! crossing(mu) = <exp(-t / mu')>
//! there_and_back = <exp(-t / mu_i - t / mu_r)>
//! ```
//!
//! Smooth: `crossing` is `exp(-t / mu')` with the refracted cosine. Rough: tables of the cosine `c`
//! of which `exp(-t / c)` is the mean (for `crossing` as a share of the smooth one, refracted from
//! the raised cosine `mu_e` of `interface.rs`), linear in that module's coordinates and in
//! `(t / (1 + t))^(1/4)`. The means are over single scattering; light that facets pass on to each
//! other is given the same. Made by `cargo xtask tables`; largest absolute errors against
//! quadrature, over alpha in [0.02, 1.4], eta in [1.2, 2.4], mu in [0.01, 1]
//! (test `absorption_holds_its_bounds`):
//!
//! | t | `crossing` | `there_and_back` |
//! |---|---|---|
//! | 0.01 | 4e-3 | 2e-3 |
//! | 0.1, 1 | 1.5e-2 | 6e-3 |

use super::interface::{
    Knot, alpha_knot, cosine_knot, effective_cosine, eta_knot, mean_alpha, table,
};
use super::interface_single_table::{
    ABSORPTION_ALPHAS, ABSORPTION_MUS, CROSSING, ETAS, THERE_AND_BACK, THICKNESSES,
};
use crate::fresnel::dielectric;
use crate::math::Real;
use crate::ndf::Ggx;

/// The places of an interface in the table of `crossing`.
#[inline]
pub(super) fn places<T: Real>(eta: T, alpha: T) -> [Knot<T>; 2] {
    [eta_knot(eta, ETAS), alpha_knot(alpha, ABSORPTION_ALPHAS)]
}

/// A layer that absorbs and does not scatter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layer<T> {
    thickness: T,
    place: Knot<T>,
}

impl<T: Real> Layer<T> {
    /// * `thickness`: optical, from 0 up.
    #[inline]
    pub fn new(thickness: T) -> Self {
        let thickness = thickness.within(T::ZERO, T::of(1e6));
        let share = thickness / (T::ONE + thickness);
        Self {
            thickness,
            place: Knot::new(share.sqrt().sqrt(), 1.0, THICKNESSES),
        }
    }

    /// Whether there is nothing to cross.
    #[inline(always)]
    pub fn is_empty(&self) -> bool {
        self.thickness <= T::ZERO
    }

    /// Share that is left of light from outside at the cosine `mu` which entered and crossed.
    ///
    /// * `coat`: `None` for a smooth interface.
    /// * `eta`: index inside over outside, in `[1, 3]`.
    #[inline]
    pub fn crossing(&self, coat: Option<Ggx<T>>, eta: T, mu: T) -> T {
        if self.is_empty() {
            return T::ONE;
        }
        let Some(ggx) = coat else {
            return self.left(dielectric(mu, eta).cos_t);
        };
        let alpha = mean_alpha(ggx);
        let refracted = dielectric(effective_cosine(mu, alpha), eta).cos_t;
        self.left(refracted * self.share(places(eta, alpha), mu))
    }

    /// The cosine of which `exp(-t / c)` is the mean, over the refracted one.
    #[inline(always)]
    pub(super) fn share(&self, [e, a]: [Knot<T>; 2], mu: T) -> T {
        cosine_knot(mu, ABSORPTION_MUS).lerp(|k| self.share_at([e, a], k))
    }

    /// [`share`](Self::share) at a knot of the cosines.
    #[inline(always)]
    pub(super) fn share_at(&self, [e, a]: [Knot<T>; 2], k: usize) -> T {
        let row = |i: usize, j: usize| self.place.lerp(|l| table(CROSSING[i][j][k][l]));
        e.lerp(|i| a.lerp(|j| row(i, j)))
    }

    /// Share that is left of diffuse light which crossed upwards, was reflected, and crossed again.
    ///
    /// * `coat`: `None` for a smooth interface.
    /// * `eta`: index inside over outside, in `[1, 3]`.
    #[inline]
    pub fn there_and_back(&self, coat: Option<Ggx<T>>, eta: T) -> T {
        if self.is_empty() {
            return T::ONE;
        }
        let e = eta_knot(eta, ETAS);
        let a = alpha_knot(coat.map_or(T::ZERO, mean_alpha), ABSORPTION_ALPHAS);
        let row = |i: usize, j: usize| self.place.lerp(|l| table(THERE_AND_BACK[i][j][l]));
        self.left(e.lerp(|i| a.lerp(|j| row(i, j))))
    }

    /// `exp(-t / cos)`.
    #[inline(always)]
    pub(super) fn left(&self, cos: T) -> T {
        (-self.thickness / cos.at_least(T::TINY)).exp_below()
    }
}
