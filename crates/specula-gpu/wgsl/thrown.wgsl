// Pictures that a light throws from a point.
//
// Words of one: position (3), the map to light space (affine), what it goes through (0: all directions, 1
// to 3: a window), the window's half sides (2), cosines at the end of a spot and at its start, intensity
// (a colour parameter).
//
// Twin of specula-render/src/light/thrown.rs.

import tracer::octahedral::{octahedral_square};
import tracer::spot::{SPOT_LINEAR_ANGLE, spot_share};
import tracer::texture_graph::{parameter_colour};
import tracer::texture_place::{Place};
import tracer::world::{affine_vector, number, word};

/// Places within the words.
const THROWN_TO_LIGHT: u32 = 3u;
const THROWN_THROUGH: u32 = 15u;
const THROWN_HALF: u32 = 16u;
const THROWN_COSINES: u32 = 18u;
const THROWN_INTENSITY: u32 = 20u;
/// What it goes through.
const THROWN_SPHERE: u32 = 0u;
const THROWN_IRRADIANCE: u32 = 2u;
const THROWN_SPOT: u32 = 3u;

/// Radiant intensity of the light at `at` towards `w` (unit, world).
/// Twin: specula-render/src/light/thrown.rs, Thrown::intensity.
fn thrown_intensity(at: u32, w: vec3f) -> vec3f {
    let within = thrown_coordinates(at, affine_vector(at + THROWN_TO_LIGHT, w));
    if within.z <= 0.0 {
        return vec3f(0.0);
    }
    let place = Place(within.xy, vec2f(0.0), vec3f(0.0), vec3f(0.0, 0.0, 1.0), vec3f(1.0));
    return max(parameter_colour(at + THROWN_INTENSITY, place), vec3f(0.0)) * within.z;
}

/// The picture's coordinates towards `w` (light space, of any length), and the factor on it; 0 where it is
/// dark.
/// Twin: specula-render/src/light/thrown.rs, Thrown::coordinates.
fn thrown_coordinates(at: u32, w: vec3f) -> vec3f {
    let through = word(at + THROWN_THROUGH);
    if through == THROWN_SPHERE {
        let square = octahedral_square(normalize(w));
        return vec3f(square.x, 1.0 - square.y, 1.0);
    }
    let half = vec2f(number(at + THROWN_HALF), number(at + THROWN_HALF + 1u));
    let uv = 0.5 * (w.xy / half / w.z + vec2f(1.0));
    if !(w.z > 0.0 && all(uv >= vec2f(0.0)) && all(uv <= vec2f(1.0))) {
        return vec3f(0.0);
    }
    let cosine = w.z / length(w);
    var factor = 1.0;
    if through == THROWN_IRRADIANCE {
        factor = 1.0 / (cosine * cosine * cosine);
    } else if through == THROWN_SPOT {
        let low = number(at + THROWN_COSINES);
        factor = spot_share(SPOT_LINEAR_ANGLE, low, number(at + THROWN_COSINES + 1u), cosine);
    }
    return vec3f(uv, factor);
}
