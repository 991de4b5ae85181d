// Visible GGX normals by the hemisphere's cross section (Heitz 2018).
//
// In the space of unit roughness, the hemisphere seen from `wo` covers a half disk and half an ellipse;
// a point is sampled there and lifted. The paper's V is our `wo`.
//
// Departure from the listing: for views below the horizon it takes the difference of nearly equal
// values (in f32 up to 70 % of its normals face away at 179.9 degrees). With `q` half the chord at
// `t1`, `s = (1 + z) / 2` free of cancellation and `d = s (q - t2)`:
//
//     t2' = q - d,   t3^2 = 1 - t1^2 - t2'^2 = d (2 q - d)

import package::alpha::{alpha_stretch};
import package::math::turns::{turns_sin_cos};
import package::ndf::ggx::{ggx_d_visible, ggx_projected_area_quotient};
import package::vndf::half_vector::{half_vector_density};
import package::vndf::stretched::{stretched_lengths};

/// A visible normal, unit, with `wm.z >= 0`.
///
/// * `wo`: unit, any hemisphere.
/// * `u`: uniform in [0, 1)^2; `u.x` is the squared radius on the disk, `u.y` the azimuth.
///
/// Twin: specula-bsdf/src/vndf/heitz.rs, sample_wm.
fn heitz_sample_wm(alpha: vec2f, wo: vec3f, u: vec2f) -> vec3f {
    let h = alpha_stretch(alpha, wo);
    let lengths = stretched_lengths(h);
    let v = h * (1.0 / lengths.x);
    // Below, the plane of incidence is lost to rounding and to squares that vanish.
    let sine = sqrt(max(v.x * v.x + v.y * v.y, 1e-37));
    let across = sine > 1e-18;
    let axis = select(vec2f(1.0, 0.0), vec2f(-v.y, v.x) / sine, across);
    let cross_axis = vec3f(-v.z * axis.y, v.z * axis.x, v.x * axis.y - v.y * axis.x);

    let phi = turns_sin_cos(u.y);
    let r = sqrt(u.x);
    let first = r * phi.y;
    let chord = sqrt(max(1.0 - first * first, 0.0));
    let d = 0.5 * (lengths.y / lengths.x) * (chord - r * phi.x);
    let second = chord - d;
    let third = sqrt(max(d * (2.0 * chord - d), 0.0));

    let m = vec3f(axis * first, 0.0) + cross_axis * second + v * third;
    return normalize(alpha_stretch(alpha, vec3f(m.xy, max(m.z, 0.0))));
}

/// Density of `heitz_sample_wm`, `D(wm) max(wo . wm, 0) / sigma(wo)`, in 1/sr.
///
/// Twin: specula-bsdf/src/vndf/heitz.rs, pdf_wm.
fn heitz_pdf_wm(alpha: vec2f, wo: vec3f, wm: vec3f) -> f32 {
    return ggx_d_visible(alpha, wo, wm);
}

/// Density of the reflections of `wo` off its normals in 1/sr: `D(wm) / (4 sigma(wo))`; 0 where
/// `wi.z <= 0`.
///
/// Twin: specula-bsdf/src/vndf/heitz.rs, reflection_pdf.
fn heitz_reflection_pdf(alpha: vec2f, wo: vec3f, wi: vec3f) -> f32 {
    return half_vector_density(alpha, wo, wi, ggx_projected_area_quotient(alpha, wo));
}
