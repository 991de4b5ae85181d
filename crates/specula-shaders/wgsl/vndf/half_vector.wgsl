// Reflections by half vectors that need not be normalised.

import package::ndf::ggx::{ggx_d_along};

/// The unit vector along `m`, of those too whose squares vanish.
///
/// Twin: specula-bsdf/src/math/vec3.rs, Vec3::normalize_any.
fn half_vector_unit(m: vec3f) -> vec3f {
    let largest = max(max(abs(m.x), abs(m.y)), abs(m.z));
    let scale = select(1.0, 1.0 / max(largest, 1.17549435e-38), largest < 1e-10);
    return normalize(m * scale);
}

/// `wo` mirrored about a vector `m` of any length.
///
/// Twin: specula-bsdf/src/vndf/mod.rs, reflect_unnormalised.
fn half_vector_mirrored(wo: vec3f, m: vec3f) -> vec3f {
    return m * (2.0 * dot(wo, m) / dot(m, m)) - wo;
}

/// `D(wm) / (4 N)` in 1/sr for reflections above the horizon off GGX, else 0.
///
/// `1 / (4 (wo . wm))` is the Jacobian of the half vector (Walter et al. 2007, eq. 14); its cosine
/// cancels against the visible normals'.
///
/// * `norm`: `N` as numerator and denominator.
///
/// Twin: specula-bsdf/src/vndf/mod.rs, reflection_density.
fn half_vector_density(alpha: vec2f, wo: vec3f, wi: vec3f, norm: vec2f) -> f32 {
    let m = wo + wi;
    if wi.z <= 0.0 || m.z <= 0.0 {
        return 0.0;
    }
    return ggx_d_along(alpha, m, dot(m, m)) * norm.y / (4.0 * norm.x);
}
