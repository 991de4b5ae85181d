// Alphas `(alpha_x, alpha_y)` of a distribution of microfacet normals, each in [1e-4, 10], as `vec2f`.
//
// This is the alpha of the formulas, not an artist's roughness.

/// Below this in both directions a renderer uses the smooth lobe instead: the highlight is narrower
/// than f32 directions resolve.
///
/// Twin: specula-bsdf/src/alpha.rs, Alpha::SPECULAR_BELOW.
const ALPHA_SPECULAR_BELOW: f32 = 1e-3;
/// Smallest alpha.
///
/// Twin: specula-bsdf/src/alpha.rs, Alpha::MIN.
const ALPHA_MIN: f32 = 1e-4;
/// Largest alpha.
///
/// Twin: specula-bsdf/src/alpha.rs, Alpha::MAX.
const ALPHA_MAX: f32 = 10.0;

/// The nearest alphas in [1e-4, 10].
///
/// Twin: specula-bsdf/src/alpha.rs, Alpha::clamped. Departure: what becomes of NaN is not said.
fn alpha_clamped(alpha: vec2f) -> vec2f {
    return clamp(alpha, vec2f(ALPHA_MIN), vec2f(ALPHA_MAX));
}

/// `(alpha_x x, alpha_y y, z)`, not normalised: a direction in the space of unit roughness; a normal of
/// that space back in the surface's.
///
/// Twin: specula-bsdf/src/alpha.rs, Alpha::stretch.
fn alpha_stretch(alpha: vec2f, w: vec3f) -> vec3f {
    return vec3f(alpha.x * w.x, alpha.y * w.y, w.z);
}
