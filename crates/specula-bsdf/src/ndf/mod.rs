//! Distributions of microfacet normals under Smith's assumption, one file each.
//!
//! Everything follows from three functions of a distribution, all free of cancellation:
//! the density `D(wm)`, the projected area `sigma(w)` and `|cos| Lambda(w)`.

mod beckmann;
mod ggx;

pub use beckmann::Beckmann;
pub use ggx::Ggx;

use crate::alpha::Alpha;
use crate::math::{Real, Vec3};

/// How masking of the viewer and shadowing of the light go together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Masking {
    /// `G2 = 1 / (1 + Lambda(wo) + Lambda(wi))` (Heitz 2014, eq. 99): pbrt-v4, Cycles.
    #[default]
    HeightCorrelated,
    /// `G2 = G1(wo) G1(wi)`: Mitsuba 3, OpenPBR's reference code.
    Separable,
}

/// A distribution of microfacet normals with Smith masking: what a lobe evaluates.
///
/// Directions are unit and local; the surface normal is z. Sampling is
/// [`VisibleNormals`](crate::vndf::VisibleNormals).
pub trait Ndf<T: Real>: Copy {
    /// The alphas.
    fn alpha(&self) -> Alpha<T>;

    /// Density of microfacet normals `D(wm)` in 1/sr; 0 where `wm.z <= 0`.
    ///
    /// Invariant: `D(wm) wm.z` integrates to 1 over the hemisphere.
    fn d(&self, wm: Vec3<T>) -> T;

    /// Area of the visible microfacets seen from `w`, per unit of the surface's:
    ///
    /// ```text
    /// sigma(w) = int D(wm) max(w . wm, 0) dwm = w.z (1 + Lambda(w))
    /// ```
    ///
    /// * `w`: any unit direction, below the horizon too.
    /// * Returns: above 0, to the precision of the type.
    fn projected_area(&self, w: Vec3<T>) -> T;

    /// `D` of the normal along `m`, of the squared length given: saves normalising a half vector.
    #[inline(always)]
    fn d_along(&self, m: Vec3<T>, length_squared: T) -> T {
        self.d(m * (T::ONE / length_squared.sqrt()))
    }

    /// `|w.z| Lambda(|w.z|)`: finite at grazing angles, where `Lambda` is not.
    fn lambda_cos(&self, w: Vec3<T>) -> T;

    /// Smith's `Lambda`, of the upper of the directions `w` and its mirror image.
    #[inline(always)]
    fn lambda(&self, w: Vec3<T>) -> T {
        self.lambda_cos(w) / w.z.abs()
    }

    /// Smith's masking `G1 = 1 / (1 + Lambda)`; 0 where `w.z <= 0`.
    #[inline(always)]
    fn g1(&self, w: Vec3<T>) -> T {
        T::select(w.z > T::ZERO, w.z / (w.z + self.lambda_cos(w)), T::ZERO)
    }

    /// Height-correlated masking and shadowing; 0 unless both directions are above the horizon.
    #[inline(always)]
    fn g2_correlated(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        let seen = wo.z > T::ZERO && wi.z > T::ZERO;
        let both = wo.z * wi.z;
        let shadow = wi.z * self.lambda_cos(wo) + wo.z * self.lambda_cos(wi);
        T::select(seen, both / (both + shadow), T::ZERO)
    }

    /// Uncorrelated masking and shadowing, `G1(wo) G1(wi)`.
    #[inline(always)]
    fn g2_separable(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        self.g1(wo) * self.g1(wi)
    }

    /// `G2(wo, wi) / |wo.z|`, the form in which every lobe needs it: finite at grazing views, and
    /// continued through the horizon for backfacing shading normals.
    ///
    /// ```text
    /// height-correlated:  |wi.z| / (sigma(wo) |wi.z| + |wo.z| |wi.z| Lambda(wi))
    /// separable:          |wi.z| / (sigma(wo) (|wi.z| + |wi.z| Lambda(wi)))
    /// ```
    ///
    /// For `wo.z > 0` it is the equation named; for `wo.z < 0`, `sigma(wo)` alone knows the sign.
    /// So `G2 / |wo.z|` is continuous in `wo`, at most `1/sigma(wo)`, and the weight of a sampled
    /// visible normal is at most 1 on both sides of the horizon: no black pixel and no firefly
    /// where an interpolated normal faces away.
    #[inline(always)]
    fn g2_over_cos(&self, masking: Masking, wo: Vec3<T>, wi: Vec3<T>) -> T {
        let (top, bottom) = self.g2_over_cos_quotient(masking, wo, wi);
        T::select(bottom > T::ZERO, top / bottom, T::ZERO)
    }

    /// [`g2_over_cos`](Ndf::g2_over_cos) as numerator and denominator.
    #[inline(always)]
    fn g2_over_cos_quotient(&self, masking: Masking, wo: Vec3<T>, wi: Vec3<T>) -> (T, T) {
        let cos_i = wi.z.abs();
        let sigma_o = self.projected_area(wo);
        let lambda_i = self.lambda_cos(wi);
        let denominator = match masking {
            Masking::HeightCorrelated => sigma_o * cos_i + wo.z.abs() * lambda_i,
            Masking::Separable => sigma_o * (cos_i + lambda_i),
        };
        (cos_i, denominator)
    }

    /// Density of visible normals,
    ///
    /// ```text
    /// D_visible(wo, wm) = D(wm) max(wo . wm, 0) / sigma(wo)
    /// ```
    ///
    /// in 1/sr, for any `wo`.
    ///
    /// Source: Heitz and d'Eon 2014, eq. 2; for backfacing views Tokuyoshi 2021.
    #[inline(always)]
    fn d_visible(&self, wo: Vec3<T>, wm: Vec3<T>) -> T {
        self.d(wm) * wo.dot(wm).at_least(T::ZERO) / self.projected_area(wo)
    }
}
