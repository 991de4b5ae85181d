// Traversal of the bounding volume hierarchies: 8-wide nodes of quantised boxes over packets of triangles, spheres,
// disks and instances.
//
// Twin of specula-render/src/accel/{traverse,frame,triangle,instances}.rs: the same tree, the same watertight test of
// triangles (Woop, Benthin and Wald 2013), the same rule for ties. Departures: boxes are quantised (Ylitie, Karras and
// Laine 2017) and hold the CPU's (src/tree.rs); children are visited in the order of the ray's octant, and a stack
// entry is a node with the children that are left; transforms of instances in f32, where the CPU computes in f64;
// directions along an axis get a tiny component instead of an infinite reciprocal, which shaders may not count on.
// Where the adapter's ray queries cast rays, query.wgsl replaces this module.

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
    // Whether the direction is negative along each axis; the same as bits of an octant.
    negative: vec3<bool>,
    octant: u32,
    // The axis along which the direction is greatest.
    main: u32,
    shear: vec3f,
}

/// Slack of the slab test.
///
/// Twin: specula-render/src/accel/frame.rs, SLACK.
const TRAVERSE_SLACK: f32 = 1.00000095367431640625;
/// On the stack: the ray leaves an instance.
const TRAVERSE_LEAVE: u32 = 0xffffffffu;
/// For a reference: the next one is on the stack.
const TRAVERSE_NEXT: u32 = 0xffffffffu;
/// Bits of the index in a reference; those above are its kind.
const TRAVERSE_INDEX: u32 = 0x3fffffffu;
/// Triangles that are intersected in a turn, at most.
const TRAVERSE_AT_ONCE: u32 = 2u;
/// Least absolute value of a direction's component in the test of boxes.
const TRAVERSE_LEAST: f32 = 1.0e-30;
/// Vectors of a node, and where its children begin.
const TRAVERSE_NODE: u32 = 6u;
const TRAVERSE_CHILDREN: u32 = 4u;
/// Vectors of a triangle.
const TRAVERSE_TRIANGLE: u32 = 3u;

/// A vector with its component along an axis last, the others in turn before it.
fn traverse_turned(v: vec3f, main: u32) -> vec3f {
    return select(select(v, v.zxy, main == 1u), v.yzx, main == 0u);
}

/// Prepares a ray.
fn traverse_frame(origin: vec3f, direction: vec3f) -> RayFrame {
    let size = abs(direction);
    var main = 2u;
    if size.x > size.y && size.x > size.z {
        main = 0u;
    } else if size.y >= size.x && size.y > size.z {
        main = 1u;
    }
    let negative = direction < vec3f(0.0);
    let least = select(vec3f(TRAVERSE_LEAST), vec3f(-TRAVERSE_LEAST), negative);
    let safe = select(direction, least, size < vec3f(TRAVERSE_LEAST));
    let turned = traverse_turned(direction, main);
    let inverse = 1.0 / turned.z;
    let bits = select(vec3u(0u), vec3u(1u, 2u, 4u), negative);
    return RayFrame(
        origin,
        direction,
        1.0 / safe,
        negative,
        bits.x | bits.y | bits.z,
        main,
        vec3f(turned.xy * inverse, inverse),
    );
}

/// Which of four boxes the ray enters before `end`.
///
/// * `near`, `far`: of each axis, the planes of the boxes where the ray enters and leaves, in units of `spacing` from `start`.
fn traverse_boxes(near: vec3u, far: vec3u, spacing: vec3f, start: vec3f, frame: RayFrame, end: f32) -> u32 {
    let scale = frame.scale;
    let enter_x = (vec4f(unpack4xU8(near.x)) * spacing.x + start.x) * scale.x;
    let enter_y = (vec4f(unpack4xU8(near.y)) * spacing.y + start.y) * scale.y;
    let enter_z = (vec4f(unpack4xU8(near.z)) * spacing.z + start.z) * scale.z;
    let slack = scale * TRAVERSE_SLACK;
    let leave_x = (vec4f(unpack4xU8(far.x)) * spacing.x + start.x) * slack.x;
    let leave_y = (vec4f(unpack4xU8(far.y)) * spacing.y + start.y) * slack.y;
    let leave_z = (vec4f(unpack4xU8(far.z)) * spacing.z + start.z) * slack.z;
    let first = max(max(enter_x, enter_y), max(enter_z, vec4f(0.0)));
    let last = min(min(leave_x, leave_y), min(leave_z, vec4f(end)));
    let bits = select(vec4u(0u), vec4u(1u, 2u, 4u, 8u), first <= last);
    return bits.x | bits.y | bits.z | bits.w;
}

/// Moves bit `i` of eight to bit `i ^ octant`: children by their slots to children in the order of the ray.
fn traverse_ordered(slots: u32, octant: u32) -> u32 {
    var mask = slots;
    mask = select(mask, ((mask & 0x55u) << 1u) | ((mask >> 1u) & 0x55u), (octant & 1u) != 0u);
    mask = select(mask, ((mask & 0x33u) << 2u) | ((mask >> 2u) & 0x33u), (octant & 2u) != 0u);
    return select(mask, ((mask & 0x0fu) << 4u) | (mask >> 4u), (octant & 4u) != 0u);
}

/// The children of a node whose boxes the ray enters before `end`: bits in the order of the ray.
fn traverse_node(index: u32, frame: RayFrame, end: f32) -> u32 {
    let at = index * TRAVERSE_NODE;
    let head = world_nodes[at];
    let spacing = bitcast<vec3f>(((vec3u(head.w) >> vec3u(0u, 8u, 16u)) & vec3u(0xffu)) << vec3u(23u));
    let start = bitcast<vec3f>(head.xyz) - frame.origin;
    let low_xy = world_nodes[at + 1u];
    let mixed = world_nodes[at + 2u];
    let high_yz = world_nodes[at + 3u];
    let near_x = select(low_xy.xy, mixed.zw, frame.negative.x);
    let near_y = select(low_xy.zw, high_yz.xy, frame.negative.y);
    let near_z = select(mixed.xy, high_yz.zw, frame.negative.z);
    let far_x = select(mixed.zw, low_xy.xy, frame.negative.x);
    let far_y = select(high_yz.xy, low_xy.zw, frame.negative.y);
    let far_z = select(high_yz.zw, mixed.xy, frame.negative.z);
    let first = traverse_boxes(
        vec3u(near_x.x, near_y.x, near_z.x), vec3u(far_x.x, far_y.x, far_z.x), spacing, start, frame, end);
    let second = traverse_boxes(
        vec3u(near_x.y, near_y.y, near_z.y), vec3u(far_x.y, far_y.y, far_z.y), spacing, start, frame, end);
    let occupied = head.w >> 24u;
    return traverse_ordered((first | (second << 4u)) & occupied, frame.octant);
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

/// Twice the signed area of the triangle between the ray and an edge. The sign is exact: a fused product and sum leaves
/// a rest that would let rays hit triangles without area, and pass between neighbours (Kahan's difference of products).
fn traverse_edge(a: vec3f, b: vec3f) -> f32 {
    let product = a.y * b.x;
    let rest = fma(-a.y, b.x, product);
    return fma(a.x, b.y, -product) + rest;
}

/// A corner of a triangle, sheared along the ray.
fn traverse_sheared(corner: vec3u, frame: RayFrame) -> vec3f {
    let local = traverse_turned(bitcast<vec3f>(corner) - frame.origin, frame.main);
    return vec3f(local.xy - frame.shear.xy * local.z, local.z);
}

/// Intersects so many triangles of a packet at most, from this one on; returns whether the packet ends with them. The
/// fourth word of a triangle's first corner is its index, that of the second is not 0 in the last one.
fn traverse_packet(index: u32, frame: RayFrame, instance: u32, best: ptr<function, Hit>) -> bool {
    for (var i = 0u; i < TRAVERSE_AT_ONCE; i += 1u) {
        let at = (index + i) * TRAVERSE_TRIANGLE;
        let first = world_triangles[at];
        let second = world_triangles[at + 1u];
        let a = traverse_sheared(first.xyz, frame);
        let b = traverse_sheared(second.xyz, frame);
        let c = traverse_sheared(world_triangles[at + 2u].xyz, frame);
        let u = traverse_edge(c, b);
        let v = traverse_edge(a, c);
        let w = traverse_edge(b, a);
        let low = min(u, min(v, w));
        let high = max(u, max(v, w));
        let total = (u + v) + w;
        if (low >= 0.0 || high <= 0.0) && total != 0.0 {
            // Divided one by one: the products with z, or 1 / total, may overflow.
            let weights = vec3f(u, v, w) / total;
            let t = ((weights.x * a.z + weights.y * b.z) + weights.z * c.z) * frame.shear.z;
            if t > 0.0 && t <= (*best).t {
                traverse_offer(best, t, weights.y, weights.z, first.w, instance);
            }
        }
        if second.w != 0u {
            return true;
        }
    }
    return false;
}

/// The child of a node that the ray visits first.
///
/// * `rest`: children that are left, as of [`traverse_node`].
fn traverse_child(node: u32, rest: u32, octant: u32) -> u32 {
    let slot = firstTrailingBit(rest) ^ octant;
    return world_nodes[node * TRAVERSE_NODE + TRAVERSE_CHILDREN + (slot >> 2u)][slot & 3u];
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
    // A node, and which of its children are left.
    var node = 0u;
    var rest = 0u;
    var current = TREE_ROOT;
    // Threads in lockstep execute a turn for all that any of them does: a node, and a few triangles after it.
    loop {
        if (current >> 30u) == 0u {
            if rest != 0u {
                stack[top] = vec2u(node, rest);
                top += 1u;
            }
            node = current & TRAVERSE_INDEX;
            rest = traverse_node(node, frame, best.t * TRAVERSE_SLACK);
            current = TRAVERSE_NEXT;
            if rest != 0u {
                current = traverse_child(node, rest, frame.octant);
                rest &= rest - 1u;
            }
        }
        let kind = current >> 30u;
        let index = current & TRAVERSE_INDEX;
        if kind == 1u {
            let ends = traverse_packet(index, frame, instance, &best);
            current = select(current + TRAVERSE_AT_ONCE, TRAVERSE_NEXT, ends);
        } else if QUADRIC_COUNT != 0u && kind == 2u {
            let at = QUADRICS + index * 16u;
            let t = quadric_distance(at, at + 4u, frame.origin, frame.direction);
            if t > 0.0 && t <= best.t {
                traverse_offer(&best, t, 0.0, 0.0, word(at + 3u), instance);
            }
            current = TRAVERSE_NEXT;
        } else if kind == 3u && current != TRAVERSE_NEXT {
            if rest != 0u {
                stack[top] = vec2u(node, rest);
                top += 1u;
                rest = 0u;
            }
            let at = PLACEMENTS + index * 15u;
            instance = word(at + 1u);
            if word(at + 2u) == 0u {
                let origin = affine_point(at + 3u, ray.origin);
                frame = traverse_frame(origin, affine_vector(at + 3u, ray.direction));
                stack[top] = vec2u(TRAVERSE_LEAVE, 0u);
                top += 1u;
            }
            current = word(at);
        }
        if any && best.instance != NONE {
            break;
        }
        if current == TRAVERSE_NEXT {
            while rest == 0u {
                if top == 0u {
                    return best;
                }
                top -= 1u;
                node = stack[top].x;
                rest = stack[top].y;
                if node == TRAVERSE_LEAVE {
                    frame = traverse_frame(ray.origin, ray.direction);
                }
            }
            current = traverse_child(node, rest, frame.octant);
            rest &= rest - 1u;
        }
    }
    return best;
}

/// Whether anything occludes a ray.
fn traverse_occluded(ray: Ray) -> bool {
    return traverse(ray, true).instance != NONE;
}
