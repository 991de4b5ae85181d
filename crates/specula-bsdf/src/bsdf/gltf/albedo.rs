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
//! taken at the alpha along the view.

use alloc::vec::Vec;

use super::albedo_table::{ALPHAS, MUS, ROUGHNESSES, SCHLICK, SHEEN};
pub use super::sheen::{LEAST_ROUGHNESS, charlie_f_cos};
use crate::energy::Loss;
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
    loss: Loss<T>,
    /// `w f0` and `w (1 - f0)`, of the brightest channel.
    normal: T,
    rise: T,
}

impl<T: Real> LayerAlbedo<T> {
    /// * `normal`, `grazing`: largest reflectances at normal and at grazing incidence.
    #[inline(always)]
    pub(super) fn new(ggx: Ggx<T>, normal: T, grazing: T) -> Self {
        Self {
            ggx,
            loss: Loss::new(ggx, Masking::HeightCorrelated),
            normal,
            rise: grazing - normal,
        }
    }

    /// `min(1, (1 - E) / B)`: what of the diffuse base is not too much.
    #[inline]
    pub(super) fn limit(&self, w: Vec3<T>) -> T {
        let mu = w.z.abs().at_most(T::ONE);
        let whole = T::ONE - self.loss.directional(w);
        let q = schlick(self.alpha_along(w), mu) + T::of(MARGIN) * (T::ONE - mu);
        let above = whole * (self.normal + self.rise * q);
        let leaves = (T::ONE - above).at_least(T::ZERO);
        let wanted = T::ONE - self.normal - self.rise * half_vectors(mu);
        T::select(leaves < wanted, leaves / wanted, T::ONE)
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

/// `q` of the cosine `mu`.
#[inline]
pub fn schlick<T: Real>(alpha: T, mu: T) -> T {
    let a = Stencil::new(alpha.sqrt(), ALPHAS);
    let m = Stencil::new(mu.sqrt(), MUS);
    a.sum(|i| m.sum(|k| entry(SCHLICK[i][k])))
}

/// `H` of the cosine `mu`: a least-squares fit, absolute error 9e-6.
#[inline]
pub fn half_vectors<T: Real>(mu: T) -> T {
    [0.008978, -0.043663, 0.086456, -0.079853, 0.028164]
        .into_iter()
        .fold(T::ZERO, |sum, c| sum * mu + T::of(c))
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
    let sum = roughness.sum(|i| m.sum(|k| entry(SHEEN[i][k])));
    let margin = T::of(MARGIN) * (T::ONE - mu);
    (sum + margin).within(T::ZERO, T::ONE)
}

/// The tables as plain values, for shaders: `q` by alpha and cosine, and the sheen's albedo by roughness
/// and cosine.
pub fn raw_tables() -> [Vec<f32>; 2] {
    let share = |&x: &u16| f32::from(x) / 65535.0;
    [SCHLICK.as_flattened(), SHEEN.as_flattened()].map(|table| table.iter().map(share).collect())
}

#[inline(always)]
fn entry<T: Real>(x: u16) -> T {
    T::of(f64::from(x) / SCALE)
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
            let layer = LayerAlbedo::new(ggx, 0.04, 1.0);
            for z in [0.71_f64, 0.8, 0.9, 1.0] {
                let limit = layer.limit(vec3((1.0 - z * z).sqrt(), 0.0, z));
                assert!(limit <= 1.0);
                least = least.min(limit);
            }
            let grazing = layer.limit(vec3(0.995, 0.0, 0.1));
            // Rough facets lose what the base would have too much.
            assert!(grazing < 1.0 || i > 6, "{i}");
        }
        assert!((0.96..0.999).contains(&least), "{least}");
    }
}
