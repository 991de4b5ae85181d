// Footprints of cones on surfaces, and the curvature that spreads them.
//
// Twin of specula-render/src/geometry/footprint.rs.

import tracer::partials::{Partials, partials_of};
import tracer::surface::{Surface, surface_pair};
import tracer::texture_coordinates::{Footprint};
import tracer::world::{word, vector, affine_vector};
import package::math::frame::{FrameBasis, frame_from_normal_tangent};

/// Least cosine between a cone and a surface's normal: footprints are no longer than 1/this times their width.
const FOOTPRINT_LEAST_COSINE: f32 = 1.0e-3;

/// What a cone covers of the tangent plane of a surface.
///
/// * `direction`: of the cone, unit.
/// * `radius`: of the cone at the surface.
///
/// Twin: specula-render/src/geometry/footprint.rs, Geometry::footprint.
fn footprint_of(s: Surface, direction: vec3f, radius: f32) -> Footprint {
    let frame = frame_from_normal_tangent(s.ng, direction);
    let cosine = abs(dot(s.ng, direction));
    let first = frame.s * (radius / max(cosine, FOOTPRINT_LEAST_COSINE));
    let second = frame.t * radius;
    return footprint_with_changes(s, first, second);
}

/// The footprint by its half axes, with how much both sets of texture coordinates change along these.
///
/// Twin: specula-render/src/geometry/footprint.rs, Geometry::changes_of_coordinates.
fn footprint_with_changes(s: Surface, first: vec3f, second: vec3f) -> Footprint {
    let placement = INSTANCES + s.instance * INSTANCE_SIZE;
    let group = word(placement);
    if QUADRIC_COUNT != 0u && s.primitive >= word(group + GROUP_TRIANGLE_COUNT) {
        let partials = partials_of(s);
        let along = footprint_weights(first, second, partials.along_u, partials.along_v);
        return Footprint(first, second, along, vec4f(0.0));
    }
    let at = word(group + GROUP_TRIANGLES) + 3u * s.primitive;
    let i = vec3u(word(at), word(at + 1u), word(at + 2u));
    let positions = word(group + GROUP_POSITIONS);
    let corner = vector(positions + 3u * i.x);
    var along = vector(positions + 3u * i.y) - corner;
    var other = vector(positions + 3u * i.z) - corner;
    if word(placement + 1u) == 0u {
        along = affine_vector(placement + 3u, along);
        other = affine_vector(placement + 3u, other);
    }
    let weights = footprint_weights(first, second, along, other);
    // pbrt's coordinates of triangles without any: (0, 0), (1, 0), (1, 1).
    var changes = footprint_changes(weights, vec2f(1.0, 0.0), vec2f(1.0, 1.0));
    if word(SHAPES + s.shape * SHAPE_SIZE + 2u) != 0u {
        changes = footprint_changes_of(weights, word(group + GROUP_UVS), i);
    }
    var second_changes = vec4f(0.0);
    if word(group + GROUP_SECOND_UVS + 1u) > max(i.x, max(i.y, i.z)) {
        second_changes = footprint_changes_of(weights, word(group + GROUP_SECOND_UVS), i);
    }
    return Footprint(first, second, changes, second_changes);
}

/// Changes of the coordinates that begin at an offset, over a triangle.
fn footprint_changes_of(weights: vec4f, at: u32, corners: vec3u) -> vec4f {
    let uv = surface_pair(at + 2u * corners.x);
    return footprint_changes(
        weights, surface_pair(at + 2u * corners.y) - uv, surface_pair(at + 2u * corners.z) - uv);
}

/// Changes along two vectors, by their weights of a triangle's edges.
fn footprint_changes(weights: vec4f, along: vec2f, other: vec2f) -> vec4f {
    return vec4f(along * weights.x + other * weights.y, along * weights.z + other * weights.w);
}

/// The weights `[x, y]` with which `x along + y other` is nearest to a vector, of both half axes; 0 where the two are
/// parallel.
///
/// Twin: specula-render/src/geometry/footprint.rs, weights_of.
fn footprint_weights(first: vec3f, second: vec3f, along: vec3f, other: vec3f) -> vec4f {
    let aa = dot(along, along);
    let ab = dot(along, other);
    let bb = dot(other, other);
    let determinant = aa * bb - ab * ab;
    if determinant <= 0.0 {
        return vec4f(0.0);
    }
    let a = vec2f(dot(first, along), dot(second, along));
    let b = vec2f(dot(first, other), dot(second, other));
    let x = (a * bb - b * ab) / determinant;
    let y = (b * aa - a * ab) / determinant;
    return vec4f(x.x, y.x, x.y, y.y);
}

/// Mean of the two principal curvatures of a surface, above 0 where it is convex seen from the outside, in 1 over the
/// world's unit of length. 0 where its texture coordinates are constant.
///
/// Twin: specula-render/src/geometry/footprint.rs, Geometry::mean_curvature.
fn footprint_mean_curvature(s: Surface) -> f32 {
    let p = partials_of(s);
    let e = dot(p.along_u, p.along_u);
    let f = dot(p.along_u, p.along_v);
    let g = dot(p.along_v, p.along_v);
    let determinant = e * g - f * f;
    if determinant <= 1.0e-6 * e * g {
        return 0.0;
    }
    let mixed = 0.5 * (dot(p.normal_along_u, p.along_v) + dot(p.normal_along_v, p.along_u));
    let trace = dot(p.normal_along_u, p.along_u) * g - 2.0 * mixed * f + dot(p.normal_along_v, p.along_v) * e;
    return 0.5 * trace / determinant;
}
