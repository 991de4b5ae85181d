// Texture mappings: from a point of a surface to texture coordinates.
//
// Twin of specula-render/src/texture/mapping.rs.

import tracer::angles::{angles_turns};
import tracer::texture_coordinates::{TextureCoordinates};
import tracer::world::{word, number, vector, affine_point};

/// `(s, t)`, with its origin at the lower left of pictures.
///
/// * `at`: offset of the mapping's kind, which its parameters follow.
///
/// Twin: specula-render/src/texture/mapping.rs, Mapping::at. Departure: angles by `angles_turns`,
/// within 1e-7 of a turn; the CPU's are those of its `atan2`.
fn texture_mapping_at(at: u32, place: TextureCoordinates) -> vec2f {
    let kind = word(at);
    let first = at + 1u;
    if kind <= TEXTURE_MAPPING_SECOND_UV {
        let uv = select(place.uv, place.second_uv, kind == TEXTURE_MAPPING_SECOND_UV);
        return vec2f(
            number(first) * uv.x + number(first + 1u) * uv.y + number(first + 2u),
            number(first + 3u) * uv.x + number(first + 4u) * uv.y + number(first + 5u),
        );
    }
    if kind == TEXTURE_MAPPING_PLANAR {
        return vec2f(
            dot(vector(first), place.position) + number(first + 3u),
            dot(vector(first + 4u), place.position) + number(first + 7u),
        );
    }
    let p = affine_point(first, place.position);
    let turn = angles_turns(p.y, p.x);
    if kind == TEXTURE_MAPPING_SPHERICAL {
        // The polar angle by a tangent: a cosine loses half the digits at the poles.
        let polar = angles_turns(sqrt(p.x * p.x + p.y * p.y), p.z);
        return vec2f(2.0 * polar, select(turn, turn + 1.0, turn < 0.0));
    }
    return vec2f(0.5 + turn, p.z);
}
