// Rays by the adapter's ray queries: the adapter intersects triangles, and yields the boxes of spheres and disks,
// which are intersected here.
//
// Replaces traverse.wgsl: the same functions, the same meaning of hits. Barycentrics are those of the second and the
// third corner by both, and `t` is the same, since queries do not normalize a direction in a group's space.
// Departures: any of several hits with the same `t` may win, and the adapter decides whether a ray through an edge or
// a corner hits a triangle.
//
// Hits of quadrics are stored here beside the query: naga 30.0.1 compares one that is handed to it
// (`rayQueryGenerateIntersection`) with the `t` of the candidate instead of that of the nearest hit, and loses it. So
// they do not shorten the search for triangles.
//
// Twin of specula-gpu/src/queries.rs, which builds the acceleration structure.

import tracer::world::{word, affine_point, affine_vector};
import tracer::ray::{Ray, Hit};
import tracer::quadric::{quadric_distance};

/// Every instance of the scene, with its index as custom data.
@group(1) @binding(0) var query_scene: acceleration_structure;

/// The least `t > 0` at which a ray hits a quadric of an instance; not positive where it misses.
///
/// * `index`: among the quadrics of the instance's group.
fn query_quadric(ray: Ray, instance: u32, index: u32) -> f32 {
    let placement = INSTANCES + instance * INSTANCE_SIZE;
    let at = word(word(placement) + GROUP_QUADRICS) + index * QUADRIC_SIZE;
    var origin = ray.origin;
    var direction = ray.direction;
    if word(placement + 1u) == 0u {
        origin = affine_point(placement + 27u, origin);
        direction = affine_vector(placement + 27u, direction);
    }
    return quadric_distance(at, at + 16u, origin, direction);
}

/// The first hit of a ray; any hit where `any` is set.
fn traverse(ray: Ray, any: bool) -> Hit {
    var best = Hit(ray.t_max, 0.0, 0.0, 0u, NONE);
    // Queries are undefined for a ray without direction.
    if TREE_ROOT == NONE || all(ray.direction == vec3f(0.0)) {
        return best;
    }
    var query: ray_query;
    let flags = select(RAY_FLAG_NONE, RAY_FLAG_TERMINATE_ON_FIRST_HIT, any);
    rayQueryInitialize(
        &query, query_scene, RayDesc(flags, 0xffu, 0.0, ray.t_max, ray.origin, ray.direction));
    // Triangles are opaque: the adapter asks about boxes only.
    while rayQueryProceed(&query) {
        if QUADRIC_COUNT == 0u {
            continue;
        }
        let candidate = rayQueryGetCandidateIntersection(&query);
        let instance = candidate.instance_custom_data;
        let t = query_quadric(ray, instance, candidate.primitive_index);
        if t > 0.0 && t < best.t {
            let triangles = word(word(INSTANCES + instance * INSTANCE_SIZE) + GROUP_TRIANGLE_COUNT);
            best = Hit(t, 0.0, 0.0, triangles + candidate.primitive_index, instance);
            if any {
                return best;
            }
        }
    }
    let hit = rayQueryGetCommittedIntersection(&query);
    if hit.kind == RAY_QUERY_INTERSECTION_TRIANGLE && hit.t < best.t {
        let instance = hit.instance_custom_data;
        best = Hit(hit.t, hit.barycentrics.x, hit.barycentrics.y, hit.primitive_index, instance);
    }
    return best;
}

/// Whether anything occludes a ray.
fn traverse_occluded(ray: Ray) -> bool {
    return traverse(ray, true).instance != NONE;
}
