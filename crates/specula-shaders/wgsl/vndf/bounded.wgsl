// Reflections off visible GGX normals by bounded spherical caps (Tokuyoshi and Eto 2024).
//
// The cap of `cap` shrinks from `z > -i.z` to `z > -k i.z`, which still holds every reflection above the
// surface. Reflections only: refraction and random walks need all visible normals.
//
// Departures from the paper:
// * eq. 4 must read `r / alpha^2`; the step functions of eqs. 10 and 25 take the stretched view;
// * eq. 7 clamps alpha at 1. Without the clamp, and with `s = 1 + sgn(1 - alpha) sqrt(x^2 + y^2)` of
//   eq. 5, the bound stays conservative where both alphas exceed 1, and rejects up to 38 percentage
//   points less;
// * listing 2 is a density only above the horizon and divides by zero at `(0, 0, -1)`.

import package::alpha::{alpha_stretch};
import package::vndf::cap::{cap_half_vector_towards};
import package::vndf::half_vector::{half_vector_density, half_vector_mirrored};
import package::vndf::stretched::{StretchedDirection, stretched_squared_radius};

/// The stretched view with its cap.
///
/// Twin: specula-bsdf/src/vndf/bounded.rs, stretched_with_height.
struct BoundedCap {
    /// The view.
    view: StretchedDirection,
    /// The cap's height, `1 + k z` (`1 + z` below the horizon).
    height: f32,
}

/// The reflection of `wo`, perhaps below the horizon (to be rejected).
///
/// * `wo`: unit, any hemisphere; below the horizon the whole cap is used.
/// * `u`: uniform in [0, 1)^2; `u.x` is the height on the cap, `u.y` the azimuth.
///
/// Twin: specula-bsdf/src/vndf/bounded.rs, sample_direction.
fn bounded_sample_direction(alpha: vec2f, wo: vec3f, u: vec2f) -> vec3f {
    let cap = bounded_cap(alpha, wo);
    let m = cap_half_vector_towards(alpha, cap.view, u.x * cap.height, u.y);
    return half_vector_mirrored(wo, m);
}

/// Density of `bounded_sample_direction` in 1/sr: `D(wm) / (4 N)`; 0 where `wi.z <= 0`.
///
/// Source: Tokuyoshi and Eto 2024, eq. 10 times the Jacobian.
///
/// Twin: specula-bsdf/src/vndf/bounded.rs, reflection_pdf.
fn bounded_reflection_pdf(alpha: vec2f, wo: vec3f, wi: vec3f) -> f32 {
    return half_vector_density(alpha, wo, wi, bounded_norm_quotient(alpha, wo));
}

/// `N` of `pdf = D(wm) / (4 N)`:
///
///     N = (k z + |(ax x, ay y, z)|) / 2   for z > 0,   sigma(wo) else
///
/// Twin: specula-bsdf/src/vndf/bounded.rs, norm.
fn bounded_norm(alpha: vec2f, wo: vec3f) -> f32 {
    let quotient = bounded_norm_quotient(alpha, wo);
    return quotient.x / quotient.y;
}

/// `bounded_norm` as numerator and denominator.
///
/// Twin: specula-bsdf/src/vndf/bounded.rs, norm_quotient.
fn bounded_norm_quotient(alpha: vec2f, wo: vec3f) -> vec2f {
    let h = alpha_stretch(alpha, wo);
    let radius = stretched_squared_radius(h);
    let length = sqrt(radius + h.z * h.z);
    if wo.z > 0.0 {
        let bound = bounded_bound(alpha, wo);
        return vec2f(bound.x * wo.z + length * bound.y, 2.0 * bound.y);
    }
    return vec2f(radius, 2.0 * (length - wo.z));
}

/// The stretched view and the height of its cap, with one division for both.
///
/// Twin: specula-bsdf/src/vndf/bounded.rs, stretched_with_height.
fn bounded_cap(alpha: vec2f, wo: vec3f) -> BoundedCap {
    let h = alpha_stretch(alpha, wo);
    let radius = stretched_squared_radius(h);
    let length = sqrt(radius + h.z * h.z);
    let long = length + abs(h.z);
    let bound = bounded_bound(alpha, wo);
    let up = h.z > 0.0;
    let factor = select(long, bound.y, up);
    let inverse = 1.0 / (length * factor);
    let view = StretchedDirection(h * (factor * inverse), select(radius, long * bound.y, up) * inverse);
    return BoundedCap(view, select(radius, length * bound.y + bound.x * h.z, up) * inverse);
}

/// `k` of eq. 6 with the conservative alpha of eq. 7, unclamped, as numerator and denominator: the cap
/// is `z > -k i.z`.
///
///     k = (1 - a^2) s^2 / (s^2 + a^2 z^2),   a = min(ax, ay),   s = 1 + sgn(1 - a) sqrt(x^2 + y^2)
///
/// Twin: specula-bsdf/src/vndf/bounded.rs, bound.
fn bounded_bound(alpha: vec2f, wo: vec3f) -> vec2f {
    let a = min(alpha.x, alpha.y);
    let sine = sqrt(wo.x * wo.x + wo.y * wo.y);
    let s = 1.0 + select(-sine, sine, a <= 1.0);
    let squares = vec2f(a * a, s * s);
    // At grazing views with a > 1 both terms of the denominator vanish; k is then 0 or less.
    let bottom = max(squares.y + squares.x * wo.z * wo.z, 1e-24);
    return vec2f((1.0 - squares.x) * squares.y, bottom);
}
