// Traversal of the bounding volume hierarchies: 8-wide nodes over packets of 8 triangles, spheres, disks and
// instances.
//
// Twin of specula-render/src/accel/{traverse,frame,triangle,instances}.rs: the same boxes, the
// same watertight test of triangles (Woop, Benthin and Wald 2013), the same rule for ties. Departures:
// transforms of instances in f32, where the CPU computes in f64; directions along an axis get a tiny component
// instead of an infinite reciprocal, which shaders may not count on. Where the adapter's ray queries cast rays,
// query.wgsl replaces this module.

import tracer::world::{word, affine_point, affine_vector};
import tracer::ray::{Ray, Hit};
import tracer::quadric::{quadric_distance};

/// A ray, prepared for the tests of boxes and triangles.
///
/// Twin: specula-render/src/accel/frame.rs, RayFrame.
struct RayFrame {
    origin: vec3f,
    direction: vec3f,
    scale: vec3f,
    // Which bounds of boxes the ray reaches first: indices of the rows of nodes.
    near: vec3u,
    // The two lesser axes, and the one in which the direction is greatest.
    axes: vec3u,
    shear: vec3f,
}

/// Slack of the slab test.
///
/// Twin: specula-render/src/accel/frame.rs, SLACK.
const TRAVERSE_SLACK: f32 = 1.00000095367431640625;
/// On the stack: the ray leaves an instance.
const TRAVERSE_LEAVE: u32 = 0xffffffffu;
/// Least absolute value of a direction's component in the test of boxes.
const TRAVERSE_LEAST: f32 = 1.0e-30;

/// Prepares a ray.
fn traverse_frame(origin: vec3f, direction: vec3f) -> RayFrame {
    let size = abs(direction);
    var z = 2u;
    if size.x > size.y && size.x > size.z {
        z = 0u;
    } else if size.y >= size.x && size.y > size.z {
        z = 1u;
    }
    let x = (z + 1u) % 3u;
    let y = (z + 2u) % 3u;
    let negative = direction < vec3f(0.0);
    let least = select(vec3f(TRAVERSE_LEAST), vec3f(-TRAVERSE_LEAST), negative);
    let safe = select(direction, least, size < vec3f(TRAVERSE_LEAST));
    let inverse = 1.0 / direction[z];
    return RayFrame(
        origin,
        direction,
        1.0 / safe,
        select(vec3u(0u, 2u, 4u), vec3u(1u, 3u, 5u), negative),
        vec3u(x, y, z),
        vec3f(direction[x] * inverse, direction[y] * inverse, inverse),
    );
}

/// Where a ray enters a child's box; negative where it misses it.
fn traverse_box(base: u32, lane: u32, frame: RayFrame, end: f32) -> f32 {
    let near = vec3f(
        bitcast<f32>(world_nodes[base + frame.near.x * 8u + lane]),
        bitcast<f32>(world_nodes[base + frame.near.y * 8u + lane]),
        bitcast<f32>(world_nodes[base + frame.near.z * 8u + lane]),
    );
    let far = vec3f(
        bitcast<f32>(world_nodes[base + (frame.near.x ^ 1u) * 8u + lane]),
        bitcast<f32>(world_nodes[base + (frame.near.y ^ 1u) * 8u + lane]),
        bitcast<f32>(world_nodes[base + (frame.near.z ^ 1u) * 8u + lane]),
    );
    let enter = (near - frame.origin) * frame.scale;
    let leave = (far - frame.origin) * (frame.scale * TRAVERSE_SLACK);
    let first = max(max(enter.x, enter.y), max(enter.z, 0.0));
    let last = min(min(leave.x, leave.y), min(leave.z, end));
    return select(-1.0, first, first <= last);
}

/// Replaces the nearest hit so far by one that is nearer, or as near and of a smaller index.
fn traverse_offer(best: ptr<function, Hit>, t: f32, u: f32, v: f32, primitive: u32, instance: u32) {
    let is_hit = (*best).instance != NONE;
    let tied = t == (*best).t && is_hit
        && (instance < (*best).instance
            || (instance == (*best).instance && primitive < (*best).primitive));
    if t < (*best).t || tied {
        *best = Hit(t, u, v, primitive, instance);
    }
}

/// A vertex of a packet's triangle, sheared along the ray.
fn traverse_vertex(base: u32, lane: u32, corner: u32, frame: RayFrame) -> vec3f {
    let at = base + corner * 24u + lane;
    let z = bitcast<f32>(world_packets[at + frame.axes.z * 8u]) - frame.origin[frame.axes.z];
    let x = bitcast<f32>(world_packets[at + frame.axes.x * 8u]) - frame.origin[frame.axes.x];
    let y = bitcast<f32>(world_packets[at + frame.axes.y * 8u]) - frame.origin[frame.axes.y];
    return vec3f(x - frame.shear.x * z, y - frame.shear.y * z, z);
}

/// Intersects the triangles of a packet.
fn traverse_packet(index: u32, frame: RayFrame, instance: u32, best: ptr<function, Hit>) {
    let base = index * 80u;
    for (var lane = 0u; lane < 8u; lane += 1u) {
        let a = traverse_vertex(base, lane, 0u, frame);
        let b = traverse_vertex(base, lane, 1u, frame);
        let c = traverse_vertex(base, lane, 2u, frame);
        let u = c.x * b.y - c.y * b.x;
        let v = a.x * c.y - a.y * c.x;
        let w = b.x * a.y - b.y * a.x;
        let low = min(u, min(v, w));
        let high = max(u, max(v, w));
        let total = (u + v) + w;
        if (low >= 0.0 || high <= 0.0) && total != 0.0 {
            // Divided one by one: the products with z, or 1 / total, may overflow.
            let weights = vec3f(u, v, w) / total;
            let t = ((weights.x * a.z + weights.y * b.z) + weights.z * c.z) * frame.shear.z;
            if t > 0.0 && t <= (*best).t {
                let primitive = world_packets[base + 72u + lane];
                traverse_offer(best, t, weights.y, weights.z, primitive, instance);
            }
        }
    }
}

/// The first hit of a ray; any hit where `any` is set.
///
/// Twin: specula-render/src/accel/traverse.rs, cast.
fn traverse(ray: Ray, any: bool) -> Hit {
    var best = Hit(ray.t_max, 0.0, 0.0, 0u, NONE);
    if TREE_ROOT == NONE {
        return best;
    }
    var frame = traverse_frame(ray.origin, ray.direction);
    var instance = LONE_INSTANCE;
    var stack: array<vec2u, STACK_SIZE>;
    var top = 0u;
    var current = TREE_ROOT;
    loop {
        let kind = current >> 30u;
        let index = current & 0x3fffffffu;
        if current == TRAVERSE_LEAVE {
            frame = traverse_frame(ray.origin, ray.direction);
        } else if kind == 0u {
            let base = index * 64u;
            let begin = top;
            for (var lane = 0u; lane < 8u; lane += 1u) {
                let enter = traverse_box(base, lane, frame, best.t * TRAVERSE_SLACK);
                if enter >= 0.0 {
                    var at = top;
                    // The farthest at the bottom.
                    while !any && at > begin && bitcast<f32>(stack[at - 1u].y) < enter {
                        stack[at] = stack[at - 1u];
                        at -= 1u;
                    }
                    stack[at] = vec2u(world_nodes[base + 48u + lane], bitcast<u32>(enter));
                    top += 1u;
                }
            }
        } else if kind == 1u {
            traverse_packet(index, frame, instance, &best);
        } else if kind == 2u {
            let at = QUADRICS + index * 16u;
            let t = quadric_distance(at, at + 4u, frame.origin, frame.direction);
            if t > 0.0 && t <= best.t {
                traverse_offer(&best, t, 0.0, 0.0, word(at + 3u), instance);
            }
        } else {
            let at = PLACEMENTS + index * 15u;
            instance = word(at + 1u);
            if word(at + 2u) == 0u {
                let origin = affine_point(at + 3u, ray.origin);
                frame = traverse_frame(origin, affine_vector(at + 3u, ray.direction));
                stack[top] = vec2u(TRAVERSE_LEAVE, 0u);
                top += 1u;
            }
            current = word(at);
            continue;
        }
        if any && best.instance != NONE {
            return best;
        }
        loop {
            if top == 0u {
                return best;
            }
            top -= 1u;
            if any || bitcast<f32>(stack[top].y) <= best.t * TRAVERSE_SLACK {
                break;
            }
        }
        current = stack[top].x;
    }
    return best;
}

/// Whether anything occludes a ray.
fn traverse_occluded(ray: Ray) -> bool {
    return traverse(ray, true).instance != NONE;
}
