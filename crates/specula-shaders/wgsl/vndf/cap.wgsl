// Visible GGX normals by spherical caps (Dupuy and Benyoub 2023).
//
// In the space of unit roughness the visible normals are half vectors between the view `i` and
// directions uniform on the cap `z > -i.z`. The paper's i is our `wo`.
//
// Departures from the listing: its line 8 must warp back the sampled normal (as printed it returns a
// constant), and it computes `sin theta` as `sqrt(1 - z^2)`, which in f32 is wrong by up to 0.5 for
// views below the horizon. With `t = 1 + i.z` and `v = u t`:
//
//     z = 1 - v,   sin theta = sqrt(v (2 - v)),   h.z = z + i.z = t - v
//
// which needs no clamp and cancels nowhere. All are written times the view's length, which saves its division.

import package::alpha::{alpha_stretch};
import package::math::turns::{turns_sin_cos};
import package::ndf::ggx::{ggx_d_visible, ggx_projected_area_quotient};
import package::vndf::half_vector::{half_vector_density, half_vector_mirrored};
import package::vndf::stretched::{stretched_lengths};

/// A visible normal, unit, with `wm.z >= 0` and `wo . wm >= 0`.
///
/// * `wo`: unit, any hemisphere.
/// * `u`: uniform in [0, 1)^2; `u.x` is the height on the cap, `u.y` the azimuth.
///
/// Twin: specula-bsdf/src/vndf/cap.rs, sample_wm.
fn cap_sample_wm(alpha: vec2f, wo: vec3f, u: vec2f) -> vec3f {
    return normalize(cap_half_vector(alpha, wo, u));
}

/// Density of `cap_sample_wm`, `D(wm) max(wo . wm, 0) / sigma(wo)`, in 1/sr.
///
/// Twin: specula-bsdf/src/vndf/cap.rs, pdf_wm.
fn cap_pdf_wm(alpha: vec2f, wo: vec3f, wm: vec3f) -> f32 {
    return ggx_d_visible(alpha, wo, wm);
}

/// The reflection of `wo` off a visible normal, perhaps below the horizon (to be rejected).
///
/// Twin: specula-bsdf/src/vndf/cap.rs, sample_direction.
fn cap_sample_direction(alpha: vec2f, wo: vec3f, u: vec2f) -> vec3f {
    return half_vector_mirrored(wo, cap_half_vector(alpha, wo, u));
}

/// Density of `cap_sample_direction` in 1/sr: `D(wm) / (4 sigma(wo))`; 0 where `wi.z <= 0`.
///
/// Source: Tokuyoshi and Eto 2024, eq. 8 times the Jacobian; appendix C for `wo.z < 0`.
///
/// Twin: specula-bsdf/src/vndf/cap.rs, reflection_pdf.
fn cap_reflection_pdf(alpha: vec2f, wo: vec3f, wi: vec3f) -> f32 {
    return half_vector_density(alpha, wo, wi, ggx_projected_area_quotient(alpha, wo));
}

/// A visible normal of any length.
///
/// Twin: specula-bsdf/src/vndf/cap.rs, half_vector.
fn cap_half_vector(alpha: vec2f, wo: vec3f, u: vec2f) -> vec3f {
    let h = alpha_stretch(alpha, wo);
    let lengths = stretched_lengths(h);
    return cap_half_vector_towards(alpha, h, lengths, u.x * lengths.y, u.y);
}

/// The half vector towards the point of the cap `height` below its apex at the azimuth `turn`, back in the
/// surface's space, of any length. The cap is that of a sphere whose radius is the view's length.
///
/// * `h`: the stretched view; `lengths`: `stretched_lengths` of it.
///
/// Twin: specula-bsdf/src/vndf/cap.rs, half_vector_on_cap.
fn cap_half_vector_towards(alpha: vec2f, h: vec3f, lengths: vec2f, height: f32, turn: f32) -> vec3f {
    let phi = turns_sin_cos(turn);
    let sine = sqrt(height * (2.0 * lengths.x - height));
    return alpha_stretch(alpha, vec3f(sine * phi.y + h.x, sine * phi.x + h.y, lengths.y - height));
}
