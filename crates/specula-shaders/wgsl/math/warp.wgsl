// Maps from the unit square to directions.

import package::math::turns::{turns_sin_cos};

/// A direction over the upper hemisphere with density `cos theta / pi`.
///
/// * `u`: uniform in [0, 1)^2.
///
/// Source: polar disk, lifted (Malley's method).
///
/// Twin: specula-bsdf/src/math/warp.rs, cosine_hemisphere.
fn warp_cosine_hemisphere(u: vec2f) -> vec3f {
    let phi = turns_sin_cos(u.y);
    let r = sqrt(u.x);
    // With 1 - u, z is exact and above zero for every u < 1.
    return vec3f(r * phi.y, r * phi.x, sqrt(1.0 - u.x));
}

/// Density of `warp_cosine_hemisphere` in 1/sr; 0 below the horizon.
///
/// Twin: specula-bsdf/src/math/warp.rs, cosine_hemisphere_pdf.
fn warp_cosine_hemisphere_pdf(w: vec3f) -> f32 {
    return max(w.z, 0.0) * 0.31830987;
}

/// A direction of the whole sphere with density `1 / (4 pi)`.
///
/// * `u`: uniform in [0, 1)^2.
///
/// Twin: specula-bsdf/src/math/warp.rs, uniform_sphere.
fn warp_uniform_sphere(u: vec2f) -> vec3f {
    let phi = turns_sin_cos(u.y);
    let below = 2.0 * u.x;
    let r = sqrt(max(below * (2.0 - below), 0.0));
    return vec3f(r * phi.y, r * phi.x, 1.0 - below);
}
