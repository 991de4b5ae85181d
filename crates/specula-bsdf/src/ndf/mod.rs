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

/// Added to cosines of incidence, so that two directions on the horizon leave no 0/0: what they see of each other is
/// right down to cosines of 1e-22.
const LEAST_COS: f64 = 1e-30;

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
    fn d_along(&self, m: Vec3<T>, _length_squared: T) -> T {
        self.d(m.normalize_any())
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
        let cos_i = wi.z.abs() + T::of(LEAST_COS);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::vec3;

    const ALPHAS: [(f64, f64); 8] = [
        (1e-4, 1e-4),
        (0.05, 0.05),
        (0.3, 0.3),
        (1.0, 1.0),
        (0.05, 0.5),
        (0.8, 0.2),
        (1e-3, 3.0),
        (10.0, 0.5),
    ];
    const COSINES: [f64; 8] = [1.0, 0.9, 0.7, 0.3, 0.05, 5e-3, 1e-4, 1e-6];
    const AZIMUTHS: [f64; 4] = [0.0, 0.7, core::f64::consts::FRAC_PI_2, 4.0];

    /// Directions above the horizon, down to grazing.
    fn directions() -> impl Iterator<Item = Vec3<f64>> {
        COSINES.into_iter().flat_map(|z| {
            let r = ((1.0 - z) * (1.0 + z)).sqrt();
            AZIMUTHS.map(|phi| vec3(r * phi.cos(), r * phi.sin(), z))
        })
    }

    fn turned(w: Vec3<f64>) -> Vec3<f64> {
        vec3(w.x, w.y, -w.z)
    }

    /// Holds `g2_over_cos_quotient`, which a distribution may write in its own form, against the functions that name
    /// the equation.
    fn masking_is_one(file: &str, ndf: &impl Ndf<f64>) {
        for masking in [Masking::HeightCorrelated, Masking::Separable] {
            for wo in directions() {
                for wi in directions() {
                    let (named, g2) = match masking {
                        Masking::HeightCorrelated => ("g2_correlated", ndf.g2_correlated(wo, wi)),
                        Masking::Separable => ("g2_separable", ndf.g2_separable(wo, wi)),
                    };
                    // Light from below and views from below: Lambda is that of the upper direction, and the projected
                    // area alone knows the side of the view.
                    let (sigma, sigma_below) =
                        (ndf.projected_area(wo), ndf.projected_area(turned(wo)));
                    let shadow = ndf.lambda_cos(wi) / wi.z;
                    let from_below = match masking {
                        Masking::HeightCorrelated => 1.0 / (sigma_below + wo.z * shadow),
                        Masking::Separable => 1.0 / (sigma_below * (1.0 + shadow)),
                    };
                    let refracted = match masking {
                        Masking::HeightCorrelated => 1.0 / (sigma + wo.z * shadow),
                        Masking::Separable => 1.0 / (sigma * (1.0 + shadow)),
                    };
                    for (form, wo, wi, expected) in [
                        (named, wo, wi, g2 / wo.z),
                        (
                            "projected_area and lambda_cos, to below",
                            wo,
                            turned(wi),
                            refracted,
                        ),
                        (
                            "projected_area and lambda_cos, from below",
                            turned(wo),
                            wi,
                            from_below,
                        ),
                    ] {
                        let quotient = ndf.g2_over_cos(masking, wo, wi);
                        assert!(
                            (quotient / expected - 1.0).abs() < 1e-9,
                            "G2 / |cos| at {:?}, wo {wo:?}, wi {wi:?} is {quotient} by `g2_over_cos_quotient` ({file}), \
                             but {expected} by `{form}` (ndf/mod.rs, {file}). Whoever changes masking changes \
                             both, and their twins in specula-shaders/wgsl/ndf.",
                            ndf.alpha(),
                        );
                    }
                }
            }
        }
    }

    /// Holds `d_along`, which a distribution may write in its own form, against `d`.
    fn density_is_one(file: &str, ndf: &impl Ndf<f64>) {
        for wm in directions() {
            for length in [0.25, 1.0, 3.0] {
                let (along, expected) = (ndf.d_along(wm * length, length * length), ndf.d(wm));
                assert!(
                    (along - expected).abs() <= 1e-9 * expected,
                    "D at {:?}, wm {wm:?} is {along} by `d_along`, but {expected} by `d` ({file})",
                    ndf.alpha(),
                );
            }
        }
    }

    #[test]
    fn every_form_of_a_distribution_is_the_same_function() {
        for (x, y) in ALPHAS {
            let (ggx, beckmann) = (Ggx::new(Alpha { x, y }), Beckmann::new(Alpha { x, y }));
            masking_is_one("ndf/ggx.rs", &ggx);
            density_is_one("ndf/ggx.rs", &ggx);
            masking_is_one("ndf/mod.rs", &beckmann);
            density_is_one("ndf/beckmann.rs", &beckmann);
        }
    }
}
