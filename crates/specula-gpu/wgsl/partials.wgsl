// Derivatives of a surface by its texture coordinates: for bump maps, and for the sense of rotations.
//
// Twin of specula-render/src/geometry/partials.rs.

import tracer::surface::{Surface, surface_normal_of, surface_pair};
import tracer::world::{word, number, vector, affine_point, affine_vector, unit_or};

/// First derivatives by u and v.
///
/// Twin: specula-render/src/geometry/partials.rs, Partials.
struct Partials {
    /// Of the position.
    along_u: vec3f,
    /// Of the position.
    along_v: vec3f,
    /// Of the shading normal, which points to the outside.
    normal_along_u: vec3f,
    /// Of the shading normal.
    normal_along_v: vec3f,
}

/// The unit normal and the derivatives at a point.
struct PartialsAndNormal {
    normal: vec3f,
    partials: Partials,
}

/// Derivatives by u and v of a quantity that is linear over a triangle.
struct PartialsSolved {
    along_u: vec3f,
    along_v: vec3f,
}

/// The derivatives at a surface, in the world; zero vectors where its texture coordinates are constant.
///
/// Twin: specula-render/src/geometry/partials.rs, Geometry::partials.
fn partials_of(s: Surface) -> Partials {
    let placement = INSTANCES + s.instance * INSTANCE_SIZE;
    let group = word(placement);
    let identity = word(placement + 1u) != 0u;
    let triangles = word(group + GROUP_TRIANGLE_COUNT);
    var in_group: PartialsAndNormal;
    if QUADRIC_COUNT == 0u || s.primitive < triangles {
        let has_uvs = word(SHAPES + s.shape * SHAPE_SIZE + 2u) != 0u;
        in_group = partials_of_triangle(group, s.primitive, s.weights, has_uvs);
    } else {
        var near = s.position;
        if !identity {
            near = affine_point(placement + 27u, near);
        }
        let at = word(group + GROUP_QUADRICS) + (s.primitive - triangles) * QUADRIC_SIZE;
        in_group = partials_of_quadric(at, near);
    }
    if identity {
        return in_group.partials;
    }
    return partials_moved(in_group, placement + 3u, placement + 15u).partials;
}

/// The unit normal and the derivatives after a transform.
///
/// With `m = N n`, `d(m/|m|) = (dm - n' (n' . dm)) / |m|`.
///
/// * `points`, `normals`: offsets of the affine maps of points and of normals.
///
/// Twin: specula-render/src/geometry/partials.rs, Partials::moved.
fn partials_moved(before: PartialsAndNormal, points: u32, normals: u32) -> PartialsAndNormal {
    let moved = affine_vector(normals, before.normal);
    let unit = unit_or(moved, before.normal);
    let size = 1.0 / max(dot(moved, unit), 1.0e-37);
    let p = before.partials;
    let du = affine_vector(normals, p.normal_along_u);
    let dv = affine_vector(normals, p.normal_along_v);
    return PartialsAndNormal(
        unit,
        Partials(
            affine_vector(points, p.along_u),
            affine_vector(points, p.along_v),
            (du - unit * dot(unit, du)) * size,
            (dv - unit * dot(unit, dv)) * size,
        ),
    );
}

/// Derivatives by u and v of a quantity that changes by `along` and `other` where `(u, v)` changes by the rows.
fn partials_solved(rows: vec4f, along: vec3f, other: vec3f) -> PartialsSolved {
    let determinant = rows.x * rows.w - rows.y * rows.z;
    if determinant == 0.0 {
        return PartialsSolved(vec3f(0.0), vec3f(0.0));
    }
    let scale = 1.0 / determinant;
    return PartialsSolved(
        (along * rows.w - other * rows.y) * scale,
        (other * rows.x - along * rows.z) * scale,
    );
}

/// The unit shading normal and the derivatives of a triangle, in its group's space.
///
/// Twin: specula-render/src/geometry/partials.rs, GroupData::triangle_partials.
fn partials_of_triangle(
    group: u32,
    primitive: u32,
    weights: vec2f,
    has_uvs: bool,
) -> PartialsAndNormal {
    let at = word(group + GROUP_TRIANGLES) + 3u * primitive;
    let i = vec3u(word(at), word(at + 1u), word(at + 2u));
    let last = max(i.x, max(i.y, i.z));
    let positions = word(group + GROUP_POSITIONS);
    let corner = vector(positions + 3u * i.x);
    let along = vector(positions + 3u * i.y) - corner;
    let other = vector(positions + 3u * i.z) - corner;
    // pbrt's coordinates of triangles without any: (0, 0), (1, 0), (1, 1).
    var rows = vec4f(1.0, 0.0, 1.0, 1.0);
    if has_uvs {
        let uvs = word(group + GROUP_UVS);
        let uv = surface_pair(uvs + 2u * i.x);
        rows = vec4f(surface_pair(uvs + 2u * i.y) - uv, surface_pair(uvs + 2u * i.z) - uv);
    }
    let ng = surface_normal_of(along, other);
    var dp = partials_solved(rows, along, other);
    if word(group + GROUP_NORMALS + 1u) <= last {
        return PartialsAndNormal(ng, Partials(dp.along_u, dp.along_v, vec3f(0.0), vec3f(0.0)));
    }
    let normals = word(group + GROUP_NORMALS);
    let na = vector(normals + 3u * i.x);
    let nb = vector(normals + 3u * i.y);
    let nc = vector(normals + 3u * i.z);
    let w = vec3f(1.0 - weights.x - weights.y, weights.x, weights.y);
    let interpolated = na * w.x + nb * w.y + nc * w.z;
    let ns = unit_or(interpolated, ng);
    if word(group + GROUP_TANGENTS + 1u) > last {
        let tangents = word(group + GROUP_TANGENTS);
        let tangent = vector(tangents + 4u * i.x) * w.x + vector(tangents + 4u * i.y) * w.y
            + vector(tangents + 4u * i.z) * w.z;
        let side = number(tangents + 4u * i.x + 3u) * w.x + number(tangents + 4u * i.y + 3u) * w.y
            + number(tangents + 4u * i.z + 3u) * w.z;
        let along_v = cross(ns, tangent) * side;
        // The mesh's own tangents; lengths do not matter to normal maps and rotations.
        if dot(along_v, along_v) > 0.0 {
            dp = PartialsSolved(tangent, along_v);
        }
    }
    let size = dot(interpolated, ns);
    var dn = PartialsSolved(vec3f(0.0), vec3f(0.0));
    if size > 0.0 {
        let solved = partials_solved(rows, nb - na, nc - na);
        dn.along_u = (solved.along_u - ns * dot(ns, solved.along_u)) * (1.0 / size);
        dn.along_v = (solved.along_v - ns * dot(ns, solved.along_v)) * (1.0 / size);
    }
    return PartialsAndNormal(ns, Partials(dp.along_u, dp.along_v, dn.along_u, dn.along_v));
}

/// The unit normal and the derivatives next to a point of the group's space.
///
/// Twin: specula-render/src/geometry/partials.rs, PlacedQuadric::partials.
fn partials_of_quadric(at: u32, near: vec3f) -> PartialsAndNormal {
    let turn = 6.2831853;
    let q = affine_point(at + 16u, near);
    let radius = number(at + 1u);
    let outwards = unit_or(vec3f(q.xy, 0.0), vec3f(1.0, 0.0, 0.0));
    let around = vec3f(-outwards.y, outwards.x, 0.0);
    var normal = vec3f(0.0, 0.0, 1.0);
    var partials: Partials;
    if word(at) == QUADRIC_SPHERE {
        normal = unit_or(q, vec3f(0.0, 0.0, 1.0));
        let sine = sqrt(normal.x * normal.x + normal.y * normal.y);
        // v runs from -z to +z.
        let upwards = vec3f(outwards.xy * -normal.z, sine);
        let du = around * (turn * sine);
        let dv = upwards * (0.5 * turn);
        partials = Partials(du * radius, dv * radius, du, dv);
    } else {
        let radial = sqrt(q.x * q.x + q.y * q.y);
        partials.along_u = around * (turn * radial);
        partials.along_v = outwards * -radius;
    }
    if word(at + 3u) != 0u {
        normal = -normal;
        partials.normal_along_u = -partials.normal_along_u;
        partials.normal_along_v = -partials.normal_along_v;
    }
    return partials_moved(PartialsAndNormal(normal, partials), at + 4u, at + 28u);
}
