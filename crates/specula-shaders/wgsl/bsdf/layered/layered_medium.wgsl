// What fills a coat: a slab that absorbs and scatters.

import package::math::frame::{frame_from_normal};
import package::math::stream::{StreamState, stream_next};
import package::math::turns::{turns_sin_cos};

/// A floor of divisors.
const LAYERED_MEDIUM_TINY: f32 = 1.1754944e-38;

/// A homogeneous medium of unit extinction: lengths are optical.
///
/// Twin: specula-bsdf/src/bsdf/layered/medium.rs, Medium.
struct LayeredMedium {
    /// Optical thickness along the normal, 0 to 1e6.
    thickness: f32,
    /// Share of scattered light at each collision, in [0, 1]; black absorbs all.
    albedo: vec3f,
    /// Mean cosine of the scattering angle (Henyey and Greenstein 1941), in [-0.99, 0.99]; positive
    /// scatters forwards.
    g: f32,
}

/// Whether it scatters.
///
/// Twin: specula-bsdf/src/bsdf/layered/medium.rs, Medium::scatters.
fn layered_medium_scatters(medium: LayeredMedium) -> bool {
    return medium.thickness > 0.0 && any(medium.albedo != vec3f(0.0));
}

/// `exp(-depth / |cos|)`: transmittance of a slab of that optical depth.
///
/// Twin: specula-bsdf/src/bsdf/layered/medium.rs, Medium::transmittance.
fn layered_medium_transmittance(depth: f32, w: vec3f) -> f32 {
    return exp(-depth / max(abs(w.z), LAYERED_MEDIUM_TINY));
}

/// Depth along the normal of the next collision, `Exp(1 / |cos|)`.
///
/// Twin: specula-bsdf/src/bsdf/layered/medium.rs, Medium::depth_of_collision.
fn layered_medium_depth_of_collision(w: vec3f, stream: ptr<function, StreamState>) -> f32 {
    return -log(1.0 - stream_next(stream)) * abs(w.z);
}

/// Density in 1/sr of being turned by an angle.
///
///     p(cos) = (1 - g^2) / (4 pi (1 + g^2 - 2 g cos)^(3/2))
///
/// * `cosine`: of the angle between the directions of travel.
///
/// Source: Henyey and Greenstein 1941, eq. 2.
///
/// Twin: specula-bsdf/src/bsdf/layered/medium.rs, Medium::phase.
fn layered_medium_phase(medium: LayeredMedium, cosine: f32) -> f32 {
    let g = medium.g;
    // (1 - g)^2 at least.
    let base = 1.0 + g * g - 2.0 * g * cosine;
    return (1.0 - g) * (1.0 + g) * 0.25 * 0.31830987 / (base * sqrt(base));
}

/// A direction of travel after a collision, of density `layered_medium_phase`.
///
/// Twin: specula-bsdf/src/bsdf/layered/medium.rs, Medium::turned.
fn layered_medium_turned(medium: LayeredMedium, w: vec3f, stream: ptr<function, StreamState>) -> vec3f {
    let g = medium.g;
    let xi = 1.0 - 2.0 * stream_next(stream);
    // 1 - g xi > 0; its series near g = 0 is the isotropic xi.
    var cosine = xi + 1.5 * g * (1.0 - xi * xi);
    if abs(g) >= 1e-3 {
        let s = (1.0 - g * g) / (1.0 + g * xi);
        cosine = (1.0 + g * g - s * s) / (2.0 * g);
    }
    cosine = clamp(cosine, -1.0, 1.0);
    let sine = sqrt(max((1.0 - cosine) * (1.0 + cosine), 0.0));
    let azimuth = turns_sin_cos(stream_next(stream));
    let frame = frame_from_normal(w);
    return normalize(frame.s * (sine * azimuth.y) + frame.t * (sine * azimuth.x) + w * cosine);
}
