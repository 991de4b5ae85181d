//! Directional albedos of glTF's layers, which bound the light that reaches what lies below.
//!
//! ```text
//! A(wo) = int D G2 / (4 |wo.z|) dwi                        what white facets reflect at once
//! q(wo) = mean of (1 - wo.wm)^5 over that light
//! H(wo) = 1/pi int (1 - wo.h)^5 cos dwi                    over half vectors of diffuse light
//! E = A (w f0 + w (1 - f0) q),    B = 1 - w f0 - w (1 - f0) H
//! ```
//!
//! `A` is that of [`Loss`]. `q` and the sheen's albedo are tables,
//! cubic in `sqrt(mu)` and in `sqrt(alpha)` or the sheen's roughness, made by `cargo xtask tables`;
//! largest absolute errors at random places with mu above 0.02: 4e-3 (test
//! `the_gltf_tables_hold_their_bounds`). They are read with a margin of that size, less towards
//! normal incidence, so that errors cost light rather than make it. `q` of an anisotropic surface is
//! taken at the alpha along the direction.

use alloc::vec::Vec;

use super::albedo_table::{ALPHAS, MUS, ROUGHNESSES, SCHLICK, SHEEN};
pub use super::sheen::{LEAST_ROUGHNESS, charlie_f_cos};
use crate::energy::albedo::DirectionalLoss;
use crate::energy::spline::Cubic;
use crate::energy::stencil::Stencil;
use crate::math::{Real, Vec3};
use crate::ndf::{Ggx, Masking, Ndf};

/// Largest entry of the tables.
pub const SCALE: f64 = 65535.0;
/// Largest error of the tables.
pub const MARGIN: f64 = 4e-3;

/// The albedo of a dielectric layer, as far as it concerns the diffuse base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LayerAlbedo<T> {
    ggx: Ggx<T>,
    /// `1 - A`.
    loss: DirectionalLoss<T>,
    /// Where the mean alpha lies in the table of `q`.
    round: Stencil<T>,
}

/// What the tables say of a direction.
#[derive(Clone, Copy)]
pub(super) struct LookedUp<T> {
    /// `1 - A`: what white facets lose by scattering once.
    pub(super) lost: T,
    pub(super) q: T,
}

/// How many numbers [`places`] returns.
pub(super) const PLACES: usize = 10;

/// Where a direction lies in the tables of an isotropic surface: what a batch computes in vectors.
#[inline(always)]
pub(super) fn places<T: Real>(alpha: T, w: Vec3<T>) -> [T; PLACES] {
    let mu = cosine(w);
    let (first, [a, b, c, d]) = DirectionalLoss::place(alpha, mu);
    let (of_q, [p, q, r, s]) = Stencil::numbers(mu.sqrt(), MUS);
    [first, a, b, c, d, of_q, p, q, r, s]
}

#[inline(always)]
fn cosine<T: Real>(w: Vec3<T>) -> T {
    w.z.abs().at_most(T::ONE)
}

impl<T: Real> LayerAlbedo<T> {
    #[inline(always)]
    pub(super) fn new(ggx: Ggx<T>) -> Self {
        let alpha = ggx.alpha();
        Self {
            ggx,
            loss: DirectionalLoss::new(ggx, Masking::HeightCorrelated),
            round: Stencil::new(alpha.x.sqrt(), ALPHAS),
        }
    }

    /// `1 - A`: what white facets lose by scattering once.
    #[inline]
    pub(super) fn lost(&self, w: Vec3<T>) -> T {
        self.loss.at(w)
    }

    /// What the tables say of a direction.
    #[inline]
    pub(super) fn look_up(&self, w: Vec3<T>) -> LookedUp<T> {
        LookedUp {
            lost: self.lost(w),
            q: self.q(w, &Stencil::new(cosine(w).sqrt(), MUS)),
        }
    }

    /// The same, by the direction's [`places`].
    #[inline(always)]
    pub(super) fn look_up_at(&self, places: [T; PLACES], w: Vec3<T>) -> LookedUp<T> {
        let [first, a, b, c, d, of_q, p, q, r, s] = places;
        let lost = self.loss.at_place(&Cubic::of_numbers(first, [a, b, c, d]));
        LookedUp {
            lost: lost.unwrap_or_else(|| self.lost(w)),
            q: self.q(w, &Stencil::of_numbers(of_q, [p, q, r, s])),
        }
    }

    /// * `mu`: where the cosine lies.
    #[inline(always)]
    fn q(&self, w: Vec3<T>, mu: &Stencil<T>) -> T {
        let alpha = self.ggx.alpha();
        if alpha.x == alpha.y {
            schlick_at(&self.round, mu)
        } else {
            schlick_at(&Stencil::new(self.alpha_along(w).sqrt(), ALPHAS), mu)
        }
    }

    /// The alpha along the view.
    #[inline(always)]
    fn alpha_along(&self, w: Vec3<T>) -> T {
        let alpha = self.ggx.alpha();
        let (x2, y2) = (w.x * w.x, w.y * w.y);
        let spread = alpha.x * alpha.x * x2 + alpha.y * alpha.y * y2;
        let round = alpha.x * alpha.y;
        T::select(x2 + y2 > T::of(1e-12), spread / (x2 + y2), round).sqrt()
    }
}

impl<T: Real> LookedUp<T> {
    /// `min(1, (1 - E) / B)`: what of the diffuse base is not too much.
    ///
    /// * `normal`, `grazing`: the layer's largest reflectances at normal and at grazing incidence.
    #[inline(always)]
    pub(super) fn limit(self, [normal, grazing]: [T; 2], w: Vec3<T>) -> T {
        let mu = cosine(w);
        let rise = grazing - normal;
        let whole = T::ONE - self.lost;
        let q = self.q + T::of(MARGIN) * (T::ONE - mu);
        let above = whole * (normal + rise * q);
        let leaves = (T::ONE - above).at_least(T::ZERO);
        let wanted = T::ONE - normal - rise * half_vectors(mu);
        T::select(leaves < wanted, leaves / wanted, T::ONE)
    }
}

/// `q` of the cosine `mu`.
#[inline]
pub fn schlick<T: Real>(alpha: T, mu: T) -> T {
    let alpha = Stencil::new(alpha.sqrt(), ALPHAS);
    schlick_at(&alpha, &Stencil::new(mu.sqrt(), MUS))
}

#[inline(always)]
fn schlick_at<T: Real>(alpha: &Stencil<T>, mu: &Stencil<T>) -> T {
    alpha.sum_of(&SCHLICK_SHARES, |row| {
        mu.sum_of(row, |&q| T::of(f64::from(q)))
    })
}

/// `H` of the cosine `mu`: a least-squares fit, absolute error 9e-6.
#[inline(always)]
pub fn half_vectors<T: Real>(mu: T) -> T {
    let [a, b, c, d, e] = [0.008978, -0.043663, 0.086456, -0.079853, 0.028164].map(T::of);
    (((a * mu + b) * mu + c) * mu + d) * mu + e
}

/// Where a roughness of sheen, at least 0.07, lies in its table.
#[inline]
pub fn sheen_stencil<T: Real>(roughness: T) -> Stencil<T> {
    let least = T::of(LEAST_ROUGHNESS);
    let share = (roughness - least) / (T::ONE - least);
    Stencil::new(share.safe_sqrt(), ROUGHNESSES)
}

/// Albedo of white sheen at the cosine `mu`, with the margin.
#[inline]
pub fn sheen<T: Real>(roughness: &Stencil<T>, mu: T) -> T {
    let m = Stencil::new(mu.sqrt(), MUS);
    let sum = roughness.sum_of(&SHEEN_SHARES, |row| {
        m.sum_of(row, |&share| T::of(f64::from(share)))
    });
    let margin = T::of(MARGIN) * (T::ONE - mu);
    (sum + margin).within(T::ZERO, T::ONE)
}

/// The tables as plain values, for shaders: `q` by alpha and cosine, and the sheen's albedo by roughness
/// and cosine.
pub fn raw_tables() -> [Vec<f32>; 2] {
    [SCHLICK_SHARES.as_flattened(), SHEEN_SHARES.as_flattened()].map(<[f32]>::to_vec)
}

/// `q` by alpha and cosine.
static SCHLICK_SHARES: [[f32; MUS]; ALPHAS] = shares(&SCHLICK);
/// The sheen's albedo by roughness and cosine.
static SHEEN_SHARES: [[f32; MUS]; ROUGHNESSES] = shares(&SHEEN);

/// The entries of a table over the largest one.
#[allow(clippy::cast_lossless, reason = "`From` is not const")]
const fn shares<const N: usize>(table: &[[u16; MUS]; N]) -> [[f32; MUS]; N] {
    let mut shares = [[0.0; MUS]; N];
    let mut i = 0;
    while i < N {
        let mut k = 0;
        while k < MUS {
            shares[i][k] = table[i][k] as f32 / 65535.0;
            k += 1;
        }
        i += 1;
    }
    shares
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::alpha::Alpha;
    use crate::math::vec3;

    #[test]
    fn the_base_is_hardly_limited_away_from_grazing_angles() {
        let mut least = 1.0_f64;
        for i in 0..=20 {
            let ggx = Ggx::new(Alpha::isotropic(0.05 * f64::from(i)));
            let layer = LayerAlbedo::new(ggx);
            let limit = |w| layer.look_up(w).limit([0.04, 1.0], w);
            for z in [0.71_f64, 0.8, 0.9, 1.0] {
                let limit = limit(vec3((1.0 - z * z).sqrt(), 0.0, z));
                assert!(limit <= 1.0);
                least = least.min(limit);
            }
            let grazing = limit(vec3(0.995, 0.0, 0.1));
            // Rough facets lose what the base would have too much.
            assert!(grazing < 1.0 || i > 6, "{i}");
        }
        assert!((0.96..0.999).contains(&least), "{least}");
    }
}
