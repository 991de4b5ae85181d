// Texture mappings: from a point of a surface to texture coordinates.
//
// Twin of specula-render/src/texture/mapping.rs.

import tracer::angles::{angles_turns};
import tracer::texture_coordinates::{TextureCoordinates};
import tracer::world::{word, number, vector, affine_point, affine_vector};

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

/// How much `(s, t)` change along the half axes of the place's footprint, to first order: those of the first, then those
/// of the second.
///
/// At the poles of spheres and along the axis of cylinders the azimuth changes by up to a radian, not infinitely.
///
/// * `at`: as of `texture_mapping_at`.
///
/// Twin: specula-render/src/texture/mapping.rs, Mapping::axes.
fn texture_mapping_axes(at: u32, place: TextureCoordinates) -> vec4f {
    let kind = word(at);
    let first = at + 1u;
    let footprint = place.footprint;
    if kind <= TEXTURE_MAPPING_SECOND_UV {
        let changes = select(
            footprint.changes, footprint.second_changes, kind == TEXTURE_MAPPING_SECOND_UV);
        return vec4f(
            number(first) * changes.x + number(first + 1u) * changes.y,
            number(first + 3u) * changes.x + number(first + 4u) * changes.y,
            number(first) * changes.z + number(first + 1u) * changes.w,
            number(first + 3u) * changes.z + number(first + 4u) * changes.w,
        );
    }
    if kind == TEXTURE_MAPPING_PLANAR {
        let s = vector(first);
        let t = vector(first + 4u);
        return vec4f(
            dot(s, footprint.first), dot(t, footprint.first), dot(s, footprint.second), dot(t, footprint.second));
    }
    let p = affine_point(first, place.position);
    let is_spherical = kind == TEXTURE_MAPPING_SPHERICAL;
    return vec4f(
        texture_mapping_turned(p, affine_vector(first, footprint.first), is_spherical),
        texture_mapping_turned(p, affine_vector(first, footprint.second), is_spherical),
    );
}

/// How much a spherical or cylindrical mapping of `p` changes along `d`, both in the texture's space.
fn texture_mapping_turned(p: vec3f, d: vec3f, is_spherical: bool) -> vec2f {
    let whole_turn = 6.2831853;
    let squared_radius = max(dot(p.xy, p.xy), dot(d.xy, d.xy));
    var turn = 0.0;
    if squared_radius > 0.0 {
        turn = (p.x * d.y - p.y * d.x) / squared_radius / whole_turn;
    }
    if !is_spherical {
        return vec2f(turn, d.z);
    }
    let radius = sqrt(squared_radius);
    let outwards = dot(p.xy, d.xy) / max(radius, 1.1754944e-38);
    let squared = max(radius * radius + p.z * p.z, 1.1754944e-38);
    return vec2f((p.z * outwards - radius * d.z) / squared / (0.5 * whole_turn), turn);
}
