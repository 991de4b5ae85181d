// Rays alone, for measurements: a thread casts a ray. In front of it are the modules of a scene's rays.

import tracer::ray::{Ray, Hit};
import tracer::traverse::{traverse, traverse_occluded};

/// Of each ray: origin, direction, end, whether any hit will do.
@group(0) @binding(0) var<storage, read> cast_rays: array<f32>;
/// Of each ray: bits of the distance, barycentrics, primitive, instance.
@group(0) @binding(4) var<storage, read_write> cast_hits: array<u32>;

/// Casts a ray.
@compute @workgroup_size(64)
fn cast_main(@builtin(global_invocation_id) id: vec3u) {
    let at = 8u * id.x;
    if at >= arrayLength(&cast_rays) {
        return;
    }
    let origin = vec3f(cast_rays[at], cast_rays[at + 1u], cast_rays[at + 2u]);
    let direction = vec3f(cast_rays[at + 3u], cast_rays[at + 4u], cast_rays[at + 5u]);
    let ray = Ray(origin, direction, cast_rays[at + 6u]);
    var hit = Hit(0.0, 0.0, 0.0, 0u, NONE);
    if cast_rays[at + 7u] == 0.0 {
        hit = traverse(ray, false);
    } else if traverse_occluded(ray) {
        hit.instance = 0u;
    }
    let to = 5u * id.x;
    cast_hits[to] = bitcast<u32>(hit.t);
    cast_hits[to + 1u] = bitcast<u32>(hit.u);
    cast_hits[to + 2u] = bitcast<u32>(hit.v);
    cast_hits[to + 3u] = hit.primitive;
    cast_hits[to + 4u] = hit.instance;
}
