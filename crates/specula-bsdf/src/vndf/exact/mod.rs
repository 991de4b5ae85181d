//! Reflections off visible GGX normals, none of them below the surface.
//!
//! The half vectors whose reflection lies above the surface form a quadratic cone (`cone`), whose
//! projection along the view has an area in closed form. That area is sampled from uniformly: in
//! closed form where the alphas are equal (`isotropic`), by a walk along chords where they are not
//! (`chords`). The density is the visible normals' over the cone:
//!
//! ```text
//! pdf(wi) = D(wm) / (4 N),   N = int D(wm) max(wo . wm, 0) [wi.z > 0] dwm
//! ```
//!
//! Source: our own derivation, `docs/exact-reflection-sampling.md`. Its ingredients: visible normals
//! as half vectors of a spherical cap (Dupuy and Benyoub 2023), the bound of that cap (Tokuyoshi and
//! Eto 2024), the vector irradiance of an ellipse.

mod chords;
mod cone;
mod isotropic;

use super::{above, cap, reflect_unnormalised, reflection_density};
use crate::alpha::Alpha;
use crate::math::{Real, Vec3};
use crate::ndf::Ggx;
pub(super) use chords::half_vector;
pub(super) use cone::Cone;

/// The reflection of `wo`, above the horizon but for rounding (less than one in 10^6 in `f32`).
///
/// * `wo`: unit, any hemisphere; below the horizon all visible normals reflect upwards, and are
///   sampled by `cap`.
/// * `u`: uniform in `[0, 1)^2`, a point of the disk: `u[0]` the squared radius, `u[1]` the azimuth.
#[inline(always)]
pub fn sample_direction<T: Real>(alpha: Alpha<T>, wo: Vec3<T>, u: [T; 2]) -> Vec3<T> {
    if wo.z > T::ZERO {
        if alpha.x == alpha.y {
            reflect_unnormalised(wo, isotropic::half_vector(alpha, wo, u))
        } else {
            sample_along_chords(alpha, wo, u)
        }
    } else {
        cap::sample_direction(alpha, wo, u)
    }
}

/// [`sample_direction`] of a view above the horizon, `wo.z > 0`, for unequal alphas.
#[inline(always)]
pub(crate) fn sample_along_chords<T: Real>(alpha: Alpha<T>, wo: Vec3<T>, u: [T; 2]) -> Vec3<T> {
    reflect_unnormalised(wo, half_vector(alpha, &Cone::new(alpha, wo), u))
}

/// The radius of a point of the disk. Its rim is the horizon, below which rounding would leave some.
#[inline(always)]
fn radius<T: Real>(u: T) -> T {
    u.at_most(T::ONE - T::of(32.0) * T::EPSILON).sqrt()
}

/// The reflection of `wo`; `None` below the horizon.
#[inline(always)]
pub fn sample_reflection<T: Real>(alpha: Alpha<T>, wo: Vec3<T>, u: [T; 2]) -> Option<Vec3<T>> {
    above(sample_direction(alpha, wo, u))
}

/// Density of [`sample_reflection`] in 1/sr: `D(wm) / (4 N)`; 0 where `wi.z <= 0`.
#[inline(always)]
pub fn reflection_pdf<T: Real>(alpha: Alpha<T>, wo: Vec3<T>, wi: Vec3<T>) -> T {
    reflection_density(alpha, wo, wi, norm_quotient(alpha, wo))
}

/// `N` of `pdf = D(wm) / (4 N)`:
///
/// ```text
/// N = lambda^2 / (|v|^2 sqrt(Dx Dy))   for z > 0,   sigma(wo) else
/// ```
///
/// (`cone` of this module; `lambda^2 / Delta` for isotropic alpha.)
#[inline(always)]
pub fn norm<T: Real>(alpha: Alpha<T>, wo: Vec3<T>) -> T {
    let (top, bottom) = norm_quotient(alpha, wo);
    top / bottom
}

/// [`norm`] as numerator and denominator.
#[inline(always)]
pub(crate) fn norm_quotient<T: Real>(alpha: Alpha<T>, wo: Vec3<T>) -> (T, T) {
    if wo.z > T::ZERO {
        if alpha.x == alpha.y {
            isotropic::norm(alpha.x, wo.z)
        } else {
            Cone::new(alpha, wo).norm()
        }
    } else {
        Ggx::new(alpha).projected_area_quotient(wo)
    }
}
