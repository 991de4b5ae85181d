//! Maps from the unit square to directions.

use super::{Real, Vec3, vec3};

/// A direction over the upper hemisphere with density `cos theta / pi`.
///
/// * `u`: uniform in `[0, 1)^2`.
///
/// Source: polar disk, lifted (Malley's method).
#[inline(always)]
pub fn cosine_hemisphere<T: Real>(u: [T; 2]) -> Vec3<T> {
    let (sin_phi, cos_phi) = u[1].sin_cos_turns();
    let r = u[0].sqrt();
    // 1 - u keeps z exact and above zero for every u < 1.
    vec3(r * cos_phi, r * sin_phi, (T::ONE - u[0]).sqrt())
}

/// Density of [`cosine_hemisphere`] in 1/sr; 0 below the horizon.
#[inline(always)]
pub fn cosine_hemisphere_pdf<T: Real>(w: Vec3<T>) -> T {
    w.z.at_least(T::ZERO) * T::INV_PI
}

/// A direction of the whole sphere with density `1 / (4 pi)`.
#[inline(always)]
pub fn uniform_sphere<T: Real>(u: [T; 2]) -> Vec3<T> {
    let (sin_phi, cos_phi) = u[1].sin_cos_turns();
    let below = T::TWO * u[0];
    let r = (below * (T::TWO - below)).safe_sqrt();
    vec3(r * cos_phi, r * sin_phi, T::ONE - below)
}
