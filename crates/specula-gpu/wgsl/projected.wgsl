// Projected-image lights: an image by direction from a point.
//
// Layout of a record, in words: position (3), the affine map to light space (12), the window that it goes through
// (WINDOW_*; WINDOW_NONE: all directions), the window's half sides (2), cosines where a spot ends and where it starts
// to fade, intensity (a colour parameter).
//
// Twin of specula-render/src/light/projected.rs.

import tracer::octahedral::{octahedral_square};
import tracer::spot::{spot_share};
import tracer::texture_graph::{parameter_colour};
import tracer::texture_coordinates::{TextureCoordinates};
import tracer::world::{affine_vector, number, word};

/// Radiant intensity of the light at `at` towards `w` (unit, world).
/// Twin: specula-render/src/light/projected.rs, ProjectedImage::intensity.
fn projected_intensity(at: u32, w: vec3f) -> vec3f {
    let within = projected_coordinates(at, affine_vector(at + PROJECTED_TO_LIGHT, w));
    if within.z <= 0.0 {
        return vec3f(0.0);
    }
    var place: TextureCoordinates;
    place.uv = within.xy;
    place.normal = vec3f(0.0, 0.0, 1.0);
    place.colour = vec3f(1.0);
    return max(parameter_colour(at + PROJECTED_INTENSITY, place), vec3f(0.0)) * within.z;
}

/// Texture coordinates of the image towards `w` (light space, of any length), and the factor on it; 0 outside of
/// the image.
/// Twin: specula-render/src/light/projected.rs, ProjectedImage::coordinates.
fn projected_coordinates(at: u32, w: vec3f) -> vec3f {
    let through = word(at + PROJECTED_THROUGH);
    if through == WINDOW_NONE {
        let square = octahedral_square(normalize(w));
        return vec3f(square.x, 1.0 - square.y, 1.0);
    }
    let half = vec2f(number(at + PROJECTED_HALF), number(at + PROJECTED_HALF + 1u));
    let uv = 0.5 * (w.xy / half / w.z + vec2f(1.0));
    if !(w.z > 0.0 && all(uv >= vec2f(0.0)) && all(uv <= vec2f(1.0))) {
        return vec3f(0.0);
    }
    let cosine = w.z / length(w);
    var factor = 1.0;
    if through == WINDOW_IRRADIANCE {
        factor = 1.0 / (cosine * cosine * cosine);
    } else if through == WINDOW_SPOT {
        let low = number(at + PROJECTED_COSINES);
        factor = spot_share(SPOT_LINEAR_ANGLE, low, number(at + PROJECTED_COSINES + 1u), cosine);
    }
    return vec3f(uv, factor);
}
