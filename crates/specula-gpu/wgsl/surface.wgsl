// From a hit to the surface there: position with its error, normals, tangent, texture coordinates.
//
// Twin of specula-render/src/geometry/{hit,flat}.rs.

import tracer::world::{word, number, vector, affine_point, affine_vector, affine_magnitude};
import tracer::world::{offset_coupled, unit_or};
import tracer::angles::{angles_turns};
import tracer::ray::{Hit, Ray};
import tracer::texture_coordinates::{Footprint, TextureCoordinates};

/// A point of a surface, in the world.
///
/// Twin: specula-render/src/geometry/hit.rs, Surface.
struct Surface {
    position: vec3f,
    // Bound on the error of each component of `position`.
    error: vec3f,
    // Geometric normal, unit, towards the outside.
    ng: vec3f,
    // Shading normal, unit.
    ns: vec3f,
    // dp/du, or zero where there are no texture coordinates.
    tangent: vec3f,
    uv: vec2f,
    second_uv: vec2f,
    colour: vec3f,
    shape: u32,
    // Index of the light that it is part of, or NONE.
    light: u32,
    instance: u32,
    primitive: u32,
    // Barycentric, of the second and third corner.
    weights: vec2f,
    // What filtered textures are means over; zero until a path's cone comes there.
    footprint: Footprint,
}

/// The surface as textures take it.
///
/// Twin: specula-render/src/geometry/hit.rs, Surface::place.
fn surface_place(s: Surface) -> TextureCoordinates {
    return TextureCoordinates(s.uv, s.second_uv, s.position, s.ng, s.colour, s.footprint);
}

/// A vector of two components.
fn surface_pair(at: u32) -> vec2f {
    return vec2f(number(at), number(at + 1u));
}

/// The unit normal of a triangle by two of its edges; `+z` where it has no area.
///
/// Twin: specula-render/src/geometry.rs, normal_of.
fn surface_normal_of(first: vec3f, second: vec3f) -> vec3f {
    // Of the size of the edges, so that the product neither overflows nor vanishes.
    let a = abs(first);
    let b = abs(second);
    let scale = max(max(a.x, max(a.y, a.z)), max(b.x, max(b.y, b.z)));
    if !(scale > 0.0) {
        return vec3f(0.0, 0.0, 1.0);
    }
    return unit_or(cross(first / scale, second / scale), vec3f(0.0, 0.0, 1.0));
}

/// The surface at a point of a triangle, in its group's space.
///
/// Twin: specula-render/src/geometry/hit.rs, GroupData::triangle_surface.
fn surface_of_triangle(group: u32, primitive: u32, weights: vec2f, has_uvs: bool) -> Surface {
    let at = word(group + GROUP_TRIANGLES) + 3u * primitive;
    let i = vec3u(word(at), word(at + 1u), word(at + 2u));
    let last = max(i.x, max(i.y, i.z));
    let positions = word(group + GROUP_POSITIONS);
    let a = vector(positions + 3u * i.x);
    let b = vector(positions + 3u * i.y);
    let c = vector(positions + 3u * i.z);
    let w = vec3f(1.0 - weights.x - weights.y, weights.x, weights.y);
    var s: Surface;
    s.ng = surface_normal_of(b - a, c - a);
    s.ns = s.ng;
    if word(group + GROUP_NORMALS + 1u) > last {
        let normals = word(group + GROUP_NORMALS);
        let sum = vector(normals + 3u * i.x) * w.x + vector(normals + 3u * i.y) * w.y
            + vector(normals + 3u * i.z) * w.z;
        s.ns = unit_or(sum, s.ng);
    }
    // pbrt's coordinates of triangles without any: (0, 0), (1, 0), (1, 1).
    s.uv = vec2f(weights.x + weights.y, weights.y);
    if has_uvs {
        let uvs = word(group + GROUP_UVS);
        let p = surface_pair(uvs + 2u * i.x);
        let q = surface_pair(uvs + 2u * i.y);
        let r = surface_pair(uvs + 2u * i.z);
        s.uv = p * w.x + q * w.y + r * w.z;
        let along = q - p;
        let other = r - p;
        let determinant = along.x * other.y - along.y * other.x;
        if determinant != 0.0 {
            let dpdu = ((b - a) * other.y - (c - a) * along.y) * sign(determinant);
            s.tangent = unit_or(dpdu, vec3f(0.0));
        }
    }
    if word(group + GROUP_TANGENTS + 1u) > last {
        let tangents = word(group + GROUP_TANGENTS);
        let sum = vector(tangents + 4u * i.x) * w.x + vector(tangents + 4u * i.y) * w.y
            + vector(tangents + 4u * i.z) * w.z;
        s.tangent = unit_or(sum, s.tangent);
    }
    if word(group + GROUP_SECOND_UVS + 1u) > last {
        let uvs = word(group + GROUP_SECOND_UVS);
        s.second_uv = surface_pair(uvs + 2u * i.x) * w.x + surface_pair(uvs + 2u * i.y) * w.y
            + surface_pair(uvs + 2u * i.z) * w.z;
    }
    s.colour = vec3f(1.0);
    if word(group + GROUP_COLOURS + 1u) > last {
        let colours = word(group + GROUP_COLOURS);
        s.colour = vector(colours + 3u * i.x) * w.x + vector(colours + 3u * i.y) * w.y
            + vector(colours + 3u * i.z) * w.z;
    }
    s.position = a * w.x + b * w.y + c * w.z;
    s.error = offset_coupled(max(abs(a), max(abs(b), abs(c))));
    return s;
}

/// The surface of a quadric next to a point of its group's space.
///
/// Twin: specula-render/src/geometry/hit.rs, PlacedQuadric::surface.
fn surface_of_quadric(at: u32, near: vec3f) -> Surface {
    let radius = number(at + 1u);
    var q = affine_point(at + 16u, near);
    var normal = vec3f(0.0, 0.0, 1.0);
    var v = 0.0;
    if word(at) == QUADRIC_SPHERE {
        normal = unit_or(q, vec3f(0.0, 0.0, 1.0));
        q = normal * radius;
        // The polar angle by a tangent: WGSL's arccosine has few digits.
        v = 1.0 - 2.0 * angles_turns(length(q.xy), q.z);
    } else {
        q.z = number(at + 2u);
        v = 1.0 - length(q.xy) / radius;
    }
    if word(at + 3u) != 0u {
        normal = -normal;
    }
    var s: Surface;
    s.position = affine_point(at + 4u, q);
    s.error = offset_coupled(affine_magnitude(at + 4u, q));
    s.ng = unit_or(affine_vector(at + 28u, normal), normal);
    s.ns = s.ng;
    s.tangent = affine_vector(at + 4u, vec3f(-q.y, q.x, 0.0));
    let u = angles_turns(q.y, q.x);
    s.uv = vec2f(select(u, u + 1.0, u < 0.0), clamp(v, 0.0, 1.0));
    s.colour = vec3f(1.0);
    return s;
}

/// The surface at a hit.
///
/// Twin: specula-render/src/geometry/hit.rs, Geometry::surface_at.
fn surface_at(ray: Ray, hit: Hit) -> Surface {
    let placement = INSTANCES + hit.instance * INSTANCE_SIZE;
    let group = word(placement);
    let identity = word(placement + 1u) != 0u;
    let shape = word(word(group + GROUP_SHAPE_OF) + hit.primitive);
    let triangles = word(group + GROUP_TRIANGLE_COUNT);
    var s: Surface;
    if QUADRIC_COUNT == 0u || hit.primitive < triangles {
        let has_uvs = word(SHAPES + shape * SHAPE_SIZE + 2u) != 0u;
        s = surface_of_triangle(group, hit.primitive, vec2f(hit.u, hit.v), has_uvs);
    } else {
        // The point along the ray is only as exact as the ray is long: quadrics project it.
        var near = ray.origin + ray.direction * hit.t;
        if !identity {
            near = affine_point(placement + 27u, near);
        }
        let at = word(group + GROUP_QUADRICS) + (hit.primitive - triangles) * QUADRIC_SIZE;
        s = surface_of_quadric(at, near);
    }
    s.shape = shape;
    s.instance = hit.instance;
    s.primitive = hit.primitive;
    s.weights = vec2f(hit.u, hit.v);
    s.light = NONE;
    if hit.primitive < word(group + GROUP_LIGHT_OF + 1u) {
        let light = word(word(group + GROUP_LIGHT_OF) + hit.primitive);
        if light != NONE {
            s.light = word(placement + 2u) + light;
        }
    }
    if !identity {
        let world = placement + 3u;
        let p = s.position;
        let reach = abs(p) + s.error * (1.0 / RELATIVE_ERROR);
        s.position = affine_point(world, p);
        s.error = offset_coupled(affine_magnitude(world, reach));
        s.ng = unit_or(affine_vector(placement + 15u, s.ng), s.ng);
        s.ns = unit_or(affine_vector(placement + 15u, s.ns), s.ng);
        s.tangent = affine_vector(world, s.tangent);
    }
    return s;
}
