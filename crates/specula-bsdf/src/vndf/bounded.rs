//! Reflections off visible GGX normals by bounded spherical caps (Tokuyoshi and Eto 2024).
//!
//! The cap of `cap` shrinks from `z > -i.z` to `z > -k i.z`, which still holds every reflection
//! above the surface. Reflections only: refraction and random walks need all visible normals.
//!
//! Departures from the paper, each held by a test:
//! * eq. 4 must read `r / alpha^2`; the step functions of eqs. 10 and 25 take the stretched view;
//! * eq. 7 clamps alpha at 1. Without the clamp, and with `s = 1 + sgn(1 - alpha) sqrt(x^2 + y^2)`
//!   of eq. 5, the bound stays conservative where both alphas exceed 1, and rejects up to 38
//!   percentage points less;
//! * listing 2 is a density only above the horizon and divides by zero at `(0, 0, -1)`.

use super::{Stretched, above, reflect_unnormalised, reflection_density, squared_radius};
use crate::alpha::Alpha;
use crate::math::{Real, Vec3};

/// The reflection of `wo`, perhaps below the horizon.
///
/// * `wo`: unit, any hemisphere; below the horizon the whole cap is used.
/// * `u`: uniform in `[0, 1)^2`; `u[0]` is the height on the cap, `u[1]` the azimuth.
#[inline(always)]
pub fn sample_direction<T: Real>(alpha: Alpha<T>, wo: Vec3<T>, u: [T; 2]) -> Vec3<T> {
    let (i, height) = stretched_with_height(alpha, wo);
    let half = super::cap::half_vector_on_cap(alpha, &i, u[0] * height, u[1]);
    reflect_unnormalised(wo, half)
}

/// The reflection of `wo`; `None` below the horizon.
#[inline(always)]
pub fn sample_reflection<T: Real>(alpha: Alpha<T>, wo: Vec3<T>, u: [T; 2]) -> Option<Vec3<T>> {
    above(sample_direction(alpha, wo, u))
}

/// Density of [`sample_reflection`] in 1/sr: `D(wm) / (4 N)`; 0 where `wi.z <= 0`.
///
/// Source: Tokuyoshi and Eto 2024, eq. 10 times the Jacobian.
#[inline(always)]
pub fn reflection_pdf<T: Real>(alpha: Alpha<T>, wo: Vec3<T>, wi: Vec3<T>) -> T {
    reflection_density(alpha, wo, wi, norm_quotient(alpha, wo))
}

/// `N` of `pdf = D(wm) / (4 N)`:
///
/// ```text
/// N = (k z + |(ax x, ay y, z)|) / 2   for z > 0,   sigma(wo) else
/// ```
#[inline(always)]
pub fn norm<T: Real>(alpha: Alpha<T>, wo: Vec3<T>) -> T {
    let (top, bottom) = norm_quotient(alpha, wo);
    top / bottom
}

/// [`norm`] as numerator and denominator.
#[inline(always)]
pub(crate) fn norm_quotient<T: Real>(alpha: Alpha<T>, wo: Vec3<T>) -> (T, T) {
    let h = alpha.stretch(wo);
    let h2 = squared_radius(h);
    let length = (h2 + h.z * h.z).sqrt();
    let (top, bottom) = bound(alpha, wo);
    let up = wo.z > T::ZERO;
    (
        T::select(up, top * wo.z + length * bottom, h2),
        T::TWO * T::select(up, bottom, length - wo.z),
    )
}

/// The stretched view, and the height of its cap, `1 + k z` (`1 + z` below the horizon), with one
/// division for both.
#[inline(always)]
fn stretched_with_height<T: Real>(alpha: Alpha<T>, wo: Vec3<T>) -> (Stretched<T>, T) {
    let h = alpha.stretch(wo);
    let h2 = squared_radius(h);
    let length = (h2 + h.z * h.z).sqrt();
    let long = length + h.z.abs();
    let (top, bottom) = bound(alpha, wo);
    let up = h.z > T::ZERO;
    let factor = T::select(up, bottom, long);
    let inverse = T::ONE / (length * factor);
    let stretched = Stretched {
        direction: h * (factor * inverse),
        one_plus_z: T::select(up, long * bottom, h2) * inverse,
    };
    let height = T::select(up, length * bottom + top * h.z, h2) * inverse;
    (stretched, height)
}

/// `k` of eq. 6 with the conservative alpha of eq. 7, unclamped, as numerator and denominator: the
/// cap is `z > -k i.z`.
///
/// ```text
/// k = (1 - a^2) s^2 / (s^2 + a^2 z^2),   a = min(ax, ay),   s = 1 + sgn(1 - a) sqrt(x^2 + y^2)
/// ```
#[inline(always)]
fn bound<T: Real>(alpha: Alpha<T>, wo: Vec3<T>) -> (T, T) {
    let a = alpha.x.at_most(alpha.y);
    let sine = (wo.x * wo.x + wo.y * wo.y).sqrt();
    let s = T::ONE + sine.copysign(T::ONE - a);
    let (a2, s2) = (a * a, s * s);
    // At grazing views with a > 1 both terms of the denominator vanish; k is then 0 or less.
    let bottom = (s2 + a2 * wo.z * wo.z).at_least(T::of(1e-24));
    ((T::ONE - a2) * s2, bottom)
}
