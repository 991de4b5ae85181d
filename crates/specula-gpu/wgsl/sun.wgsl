// A round light infinitely far away: the same radiance from every direction within a cone.
//
// Layout of a record, in words: tangent, bitangent, axis, radiance (3 each), `1 - cos` of the half angle.
//
// Twin of specula-render/src/light/sun.rs.

import tracer::angles::{angles_sin_cos_turns};
import tracer::world::{number, vector};

/// Density in 1/sr with which `sun_sample` samples a direction of the sun at `at`.
fn sun_density(at: u32) -> f32 {
    return 0.15915494 / number(at + 12u);
}

/// Radiance from the direction `wi` (unit), and the density in 1/sr with which `sun_sample` samples it.
///
/// By the chord, `|wi - axis|^2 = 2 (1 - cos)`, which has the digits that the cosine of a small angle
/// lacks.
/// Twin: specula-render/src/light/sun.rs, Sun::radiance and Sun::pdf.
fn sun_arriving(at: u32, wi: vec3f) -> vec4f {
    let chord = wi - vector(at + 6u);
    if dot(chord, chord) <= 2.0 * number(at + 12u) {
        return vec4f(vector(at + 9u), sun_density(at));
    }
    return vec4f(0.0);
}

/// Samples a direction (unit, world) towards the sun at `at`, uniformly by solid angle.
///
/// * `u`: uniform in `[0, 1)^2`.
///
/// Twin: specula-render/src/light/sun.rs, Sun::sample.
fn sun_sample(at: u32, u: vec2f) -> vec3f {
    let t = u.x * number(at + 12u);
    let planar = sqrt(t * (2.0 - t)) * angles_sin_cos_turns(u.y).yx;
    return normalize(
        vector(at) * planar.x + vector(at + 3u) * planar.y + vector(at + 6u) * (1.0 - t),
    );
}
