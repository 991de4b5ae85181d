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
import package::vndf::stretched::{stretched_lengths};

/// The reflection of `wo`, perhaps below the horizon (to be rejected).
///
/// * `wo`: unit, any hemisphere; below the horizon the whole cap is used.
/// * `u`: uniform in [0, 1)^2; `u.x` is the height on the cap, `u.y` the azimuth.
///
/// Twin: specula-bsdf/src/vndf/bounded.rs, sample_direction.
fn bounded_sample_direction(alpha: vec2f, wo: vec3f, u: vec2f) -> vec3f {
    let h = alpha_stretch(alpha, wo);
    let lengths = stretched_lengths(h);
    let height = u.x * bounded_height(alpha, wo, lengths);
    let m = cap_half_vector_towards(alpha, h, lengths, height, u.y);
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

/// `N` of `bounded_height`, as numerator and denominator.
///
/// Twin: specula-bsdf/src/vndf/bounded.rs, norm_quotient.
fn bounded_norm_quotient(alpha: vec2f, wo: vec3f) -> vec2f {
    let lengths = stretched_lengths(alpha_stretch(alpha, wo));
    return vec2f(bounded_height(alpha, wo, lengths), 2.0);
}

/// `2 N`, which is the height of the cap times the view's length: `t + k z`, or `t + z` below the horizon; with
/// `k` of eq. 6 and the conservative alpha of eq. 7, unclamped: the cap is `z > -k i.z`.
///
///     k = (1 - a^2) s^2 / (s^2 + a^2 z^2),   a = min(ax, ay),   s = 1 + sgn(1 - a) sqrt(x^2 + y^2)
///
/// * `lengths`: `stretched_lengths` of the stretched view.
///
/// Twin: specula-bsdf/src/vndf/bounded.rs, bound.
fn bounded_height(alpha: vec2f, wo: vec3f, lengths: vec2f) -> f32 {
    if wo.z <= 0.0 {
        return lengths.y;
    }
    let a = min(alpha.x, alpha.y);
    let sine = sqrt(wo.x * wo.x + wo.y * wo.y);
    let s = 1.0 + select(-sine, sine, a <= 1.0);
    // At grazing views with a > 1 both terms of the denominator vanish; k is then 0 or less.
    let bottom = max(s * s + a * a * wo.z * wo.z, 1e-24);
    return lengths.x + (1.0 - a * a) * s * s / bottom * wo.z;
}
