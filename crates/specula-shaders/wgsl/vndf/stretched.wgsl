// A view in the space of unit roughness, with what every sampler needs of it.

import package::alpha::{alpha_stretch};

/// A direction stretched to unit roughness.
///
/// Twin: specula-bsdf/src/vndf/mod.rs, Stretched.
struct StretchedDirection {
    /// Unit.
    direction: vec3f,
    /// `1 + direction.z`, without cancellation below the horizon.
    one_plus_z: f32,
}

/// `wo` in the space of unit roughness.
///
/// For `z < 0`, `1 + z = (x^2 + y^2) / (1 - z)`. One division serves both signs.
///
/// Twin: specula-bsdf/src/vndf/mod.rs, Stretched::new.
fn stretched_new(alpha: vec2f, wo: vec3f) -> StretchedDirection {
    let h = alpha_stretch(alpha, wo);
    let radius = stretched_squared_radius(h);
    let length = sqrt(radius + h.z * h.z);
    let long = length + abs(h.z);
    let up = h.z >= 0.0;
    let factor = select(long, 1.0, up);
    let inverse = 1.0 / (length * factor);
    return StretchedDirection(h * (factor * inverse), select(radius, long, up) * inverse);
}

/// `x^2 + y^2` with a floor, so that the straight view from below is finite: it sees only facets at the
/// horizon.
///
/// Twin: specula-bsdf/src/vndf/mod.rs, squared_radius.
fn stretched_squared_radius(h: vec3f) -> f32 {
    return max(h.x * h.x + h.y * h.y, 1e-24);
}
