// The states of paths between two kernels: an array of each field, so that neighbours read and write side by side, and a
// kernel only what it needs.

import tracer::lights::{Receiver};
import tracer::medium_stack::{MediumStack};
import tracer::path::{PathState};
import tracer::ray::{Ray, Hit};
import tracer::visibility::{ShadowRay, VISIBILITY_BY_SURFACES};

/// The fields, each of so many vectors as there are slots.
@group(0) @binding(6) var<storage, read_write> queue_states: array<vec4u>;

/// Origin of the ray; flags.
const QUEUE_ORIGIN: u32 = 0u;
/// Direction of the ray; density of the last direction.
const QUEUE_DIRECTION: u32 = 1u;
/// What the ray hits, but for the distance.
const QUEUE_HIT: u32 = 2u;
/// Distance of the hit; number of rays; the last two components of the previous vertex' normal.
const QUEUE_COUNTS: u32 = 3u;
/// Throughput; scale of roulette by refractions.
const QUEUE_THROUGHPUT: u32 = 4u;
/// Radiance; the first component of the previous vertex' normal.
const QUEUE_RADIANCE: u32 = 5u;
/// The previous vertex.
const QUEUE_PREVIOUS: u32 = 6u;
/// Origin and end of the shadow ray.
const QUEUE_SHADOW_ORIGIN: u32 = 7u;
/// Direction of the shadow ray; whether it goes to infinity.
const QUEUE_SHADOW_DIRECTION: u32 = 8u;
/// Contribution of the shadow ray.
const QUEUE_CONTRIBUTION: u32 = 9u;
/// Where there are media: those of the path, in two vectors.
const QUEUE_MEDIA: u32 = 10u;
/// Those of the shadow ray.
const QUEUE_SHADOW_MEDIA: u32 = 12u;
/// Where it begins and ends.
const QUEUE_SHADOW_BEGIN: u32 = 14u;
const QUEUE_SHADOW_END: u32 = 15u;
/// Where textures are filtered: the cone of the path.
const QUEUE_CONE: u32 = 10u + 6u * HAS_BOUNDARIES;
/// How many fields there are. Twin: specula-gpu/src/path_kernels.rs, state_size.
const QUEUE_FIELDS: u32 = QUEUE_CONE + TEXTURES_ARE_FILTERED;

/// Where a field of a slot is.
fn queue_state_place(slot: u32, field: u32) -> u32 {
    return field * (arrayLength(&queue_states) / QUEUE_FIELDS) + slot;
}

/// A field of a slot.
fn queue_state_read(slot: u32, field: u32) -> vec4u {
    return queue_states[queue_state_place(slot, field)];
}

/// Writes a field of a slot.
fn queue_state_write(slot: u32, field: u32, v: vec3f, w: u32) {
    queue_states[queue_state_place(slot, field)] = vec4u(bitcast<vec3u>(v), w);
}

/// Media, in two fields.
fn queue_state_media(slot: u32, field: u32) -> MediumStack {
    var media: MediumStack;
    if HAS_BOUNDARIES != 0u {
        let first = queue_state_read(slot, field);
        media = MediumStack(bitcast<vec3f>(first.xyz), first.w, queue_state_read(slot, field + 1u));
    }
    return media;
}

/// Writes media.
fn queue_state_write_media(slot: u32, field: u32, media: MediumStack) {
    if HAS_BOUNDARIES != 0u {
        queue_state_write(slot, field, media.absorption, media.count);
        queue_states[queue_state_place(slot, field + 1u)] = media.materials;
    }
}

/// What it takes to trace a path. The rest of its state is zero.
fn queue_state_to_trace(slot: u32) -> PathState {
    let origin = queue_state_read(slot, QUEUE_ORIGIN);
    let direction = queue_state_read(slot, QUEUE_DIRECTION);
    var state: PathState;
    state.ray = Ray(bitcast<vec3f>(origin.xyz), bitcast<vec3f>(direction.xyz), FARTHEST);
    state.flags = origin.w;
    state.rays = queue_state_read(slot, QUEUE_COUNTS).y;
    if VISIBILITY_BY_SURFACES != 0u {
        let throughput = queue_state_read(slot, QUEUE_THROUGHPUT);
        state.throughput = bitcast<vec3f>(throughput.xyz);
        state.eta_scale = bitcast<f32>(throughput.w);
        state.media = queue_state_media(slot, QUEUE_MEDIA);
    }
    return state;
}

/// Writes what tracing changes.
fn queue_state_traced(slot: u32, state: PathState) {
    let hit = state.hit;
    let at = queue_state_place(slot, QUEUE_HIT);
    queue_states[at] = vec4u(bitcast<vec2u>(vec2f(hit.u, hit.v)), hit.primitive, hit.instance);
    let counts = queue_state_place(slot, QUEUE_COUNTS);
    queue_states[counts] = vec4u(bitcast<u32>(hit.t), state.rays, queue_states[counts].zw);
    if VISIBILITY_BY_SURFACES != 0u {
        queue_state_write(slot, QUEUE_ORIGIN, state.ray.origin, state.flags);
        queue_state_write(slot, QUEUE_THROUGHPUT, state.throughput, bitcast<u32>(state.eta_scale));
        queue_state_write_media(slot, QUEUE_MEDIA, state.media);
    }
}

/// A path that has been traced.
fn queue_state_to_shade(slot: u32) -> PathState {
    let origin = queue_state_read(slot, QUEUE_ORIGIN);
    let direction = queue_state_read(slot, QUEUE_DIRECTION);
    let hit = queue_state_read(slot, QUEUE_HIT);
    let counts = queue_state_read(slot, QUEUE_COUNTS);
    let throughput = bitcast<vec4f>(queue_state_read(slot, QUEUE_THROUGHPUT));
    let radiance = bitcast<vec4f>(queue_state_read(slot, QUEUE_RADIANCE));
    let previous = bitcast<vec4f>(queue_state_read(slot, QUEUE_PREVIOUS));
    var state: PathState;
    state.ray = Ray(bitcast<vec3f>(origin.xyz), bitcast<vec3f>(direction.xyz), FARTHEST);
    state.flags = origin.w;
    state.previous_pdf = bitcast<f32>(direction.w);
    state.hit = Hit(bitcast<f32>(counts.x), bitcast<f32>(hit.x), bitcast<f32>(hit.y), hit.z, hit.w);
    state.rays = counts.y;
    state.throughput = throughput.xyz;
    state.eta_scale = throughput.w;
    state.radiance = radiance.xyz;
    state.previous = Receiver(previous.xyz, vec3f(radiance.w, bitcast<vec2f>(counts.zw)));
    state.media = queue_state_media(slot, QUEUE_MEDIA);
    if TEXTURES_ARE_FILTERED != 0u {
        state.cone = bitcast<vec2f>(queue_state_read(slot, QUEUE_CONE).xy);
    }
    return state;
}

/// Writes a path before it is traced.
fn queue_state_begun(slot: u32, state: PathState) {
    let normal = state.previous.normal;
    let counts = vec4u(0u, state.rays, bitcast<vec2u>(normal.yz));
    queue_state_write(slot, QUEUE_ORIGIN, state.ray.origin, state.flags);
    queue_state_write(slot, QUEUE_DIRECTION, state.ray.direction, bitcast<u32>(state.previous_pdf));
    queue_states[queue_state_place(slot, QUEUE_COUNTS)] = counts;
    queue_state_write(slot, QUEUE_THROUGHPUT, state.throughput, bitcast<u32>(state.eta_scale));
    queue_state_write(slot, QUEUE_RADIANCE, state.radiance, bitcast<u32>(normal.x));
    queue_state_write(slot, QUEUE_PREVIOUS, state.previous.position, 0u);
    queue_state_write_media(slot, QUEUE_MEDIA, state.media);
    if TEXTURES_ARE_FILTERED != 0u {
        queue_state_write(slot, QUEUE_CONE, vec3f(state.cone, 0.0), 0u);
    }
}

/// Writes a path that has been shaded, and its shadow ray.
fn queue_state_shaded(slot: u32, state: PathState, shadow: ShadowRay) {
    queue_state_begun(slot, state);
    let ray = shadow.ray;
    queue_state_write(slot, QUEUE_CONTRIBUTION, shadow.contribution, 0u);
    queue_state_write(slot, QUEUE_SHADOW_ORIGIN, ray.origin, bitcast<u32>(ray.t_max));
    queue_state_write(slot, QUEUE_SHADOW_DIRECTION, ray.direction, shadow.from_infinity);
    if HAS_BOUNDARIES != 0u {
        queue_state_write_media(slot, QUEUE_SHADOW_MEDIA, shadow.media);
        queue_state_write(slot, QUEUE_SHADOW_BEGIN, shadow.begin, 0u);
        queue_state_write(slot, QUEUE_SHADOW_END, shadow.end, 0u);
    }
}

/// The shadow ray of a slot.
fn queue_state_shadow(slot: u32) -> ShadowRay {
    let origin = queue_state_read(slot, QUEUE_SHADOW_ORIGIN);
    let direction = queue_state_read(slot, QUEUE_SHADOW_DIRECTION);
    var shadow: ShadowRay;
    shadow.ray = Ray(bitcast<vec3f>(origin.xyz), bitcast<vec3f>(direction.xyz), bitcast<f32>(origin.w));
    shadow.contribution = bitcast<vec3f>(queue_state_read(slot, QUEUE_CONTRIBUTION).xyz);
    shadow.from_infinity = direction.w;
    if HAS_BOUNDARIES != 0u {
        shadow.begin = bitcast<vec3f>(queue_state_read(slot, QUEUE_SHADOW_BEGIN).xyz);
        shadow.end = bitcast<vec3f>(queue_state_read(slot, QUEUE_SHADOW_END).xyz);
        shadow.media = queue_state_media(slot, QUEUE_SHADOW_MEDIA);
    }
    return shadow;
}

/// What it takes to add light to a path. The rest of its state is zero.
fn queue_state_to_connect(slot: u32) -> PathState {
    var state: PathState;
    state.flags = queue_state_read(slot, QUEUE_ORIGIN).w;
    state.rays = queue_state_read(slot, QUEUE_COUNTS).y;
    state.radiance = bitcast<vec3f>(queue_state_read(slot, QUEUE_RADIANCE).xyz);
    return state;
}

/// Writes what light adds.
fn queue_state_connected(slot: u32, state: PathState) {
    queue_states[queue_state_place(slot, QUEUE_COUNTS)].y = state.rays;
    let at = queue_state_place(slot, QUEUE_RADIANCE);
    queue_states[at] = vec4u(bitcast<vec3u>(state.radiance), queue_states[at].w);
}
