// Unidirectional path tracing with next-event estimation, vertex by vertex. Here one thread follows one
// sample to its end; queue.wgsl takes all paths from one vertex to the next.
//
// Twin of specula-render/src/integrator.rs: the same values decide the same things, so that a sample
// follows the same path up to rounding. SEED, MAX_DEPTH and STRATEGY are constants of the render.

import tracer::world::{word, number, offset_leave};
import tracer::sequence::{Sequence, sequence_of, sequence_camera, sequence_scatter, sequence_light};
import tracer::sequence::{sequence_stream, sequence_hashed};
import tracer::camera::{camera_ray};
import tracer::film::{film_developed};
import tracer::ray::{Ray};
import tracer::surface::{Surface};
import tracer::medium_stack::{MediumStack};
import tracer::visibility::{visibility_nearest, visibility_transmittance, visibility_cross, visibility_place};
import tracer::visibility::{visibility_radiance};
import tracer::partials::{partials_of};
import tracer::bump::{Softness, bump_of_material, bump_is_there, bump_bend, bump_softened};
import tracer::bump::{bump_softness, bump_coat_differs, bump_of_coat};
import tracer::lights::{Receiver, LightSample, lights_sample, lights_pdf_of_surface};
import tracer::lights::{lights_arriving_count, lights_arriving, lights_share_from_infinity};
import tracer::material::{Bound, material_bind, material_eval, material_sample, material_albedo};
import package::math::frame::{FrameBasis, frame_from_normal_tangent, frame_to_local, frame_to_world};
import package::bsdf::bsdf_sample::{BsdfSample};

/// The wave: places that each run has among the samples, and the number of runs. Then the runs, of samples of
/// a pixel: column, row, number of the first, how many.
@group(0) @binding(4) var<storage, read> path_wanted: array<vec4u>;
/// Three vectors a sample, as sums.wgsl reads them: picture values and depth (negative where nothing was
/// met); albedo and rays traced; normal and the filter's weight, which the other vectors are times.
@group(0) @binding(5) var<storage, read_write> path_found: array<vec4f>;


/// It has only passed through thin panes: lights that are hidden stay so.
const PATH_STRAIGHT: u32 = 1u;
/// It was scattered by a lobe that is not perfectly smooth.
const PATH_ROUGH: u32 = 2u;

/// A path on its way.
struct PathState {
    radiance: vec3f,
    eta_scale: f32,
    throughput: vec3f,
    rays: u32,
    // The one that it goes on with.
    ray: Ray,
    // What the path is in.
    media: MediumStack,
    // Where the last direction was sampled, and its density; 0 where lights could not have found it.
    previous: Receiver,
    previous_pdf: f32,
    // PATH_STRAIGHT and PATH_ROUGH.
    flags: u32,
}

/// A surface with its lobe and frame, turned to the viewer.
struct PathVertex {
    surface: Surface,
    bound: Bound,
    frame: FrameBasis,
    // How light fades where a bump map by Mitsuba's rules bends the normal.
    softness: Softness,
    // Geometric normal on the viewer's side.
    facing: vec3f,
    // Towards the viewer, local.
    wo: vec3f,
}

/// Weight of the strategy with density `a` against the one with density `b`.
fn path_heuristic(a: f32, b: f32) -> f32 {
    // As a ratio: squares of densities overflow.
    let ratio = min(b / a, 1.0e18);
    if STRATEGY == STRATEGY_BALANCE {
        return 1.0 / (1.0 + ratio);
    }
    if STRATEGY == STRATEGY_POWER {
        return 1.0 / (1.0 + ratio * ratio);
    }
    return 1.0 / (1.0 + ratio * sqrt(ratio));
}

/// Weight of light found by a lobe's direction, which lights find with density `light_pdf`.
fn path_lobe_weight(pdf: f32, light_pdf: f32) -> f32 {
    if pdf <= 0.0 || STRATEGY == STRATEGY_BSDF_ONLY {
        return 1.0;
    }
    if STRATEGY == STRATEGY_LIGHTS_ONLY {
        return 0.0;
    }
    return path_heuristic(pdf, light_pdf);
}

/// Light from infinity on a ray that meets nothing.
fn path_background(state: PathState, direction: vec3f) -> vec3f {
    var sum = vec3f(0.0);
    let count = lights_arriving_count();
    var share = 0.0;
    if count > 0u && state.previous_pdf > 0.0 {
        share = lights_share_from_infinity(state.previous);
    }
    for (var i = 0u; i < count; i += 1u) {
        let arriving = lights_arriving(i, direction);
        sum += arriving.xyz * path_lobe_weight(state.previous_pdf, share * arriving.w);
    }
    return sum;
}

/// Light that a surface sends out itself.
fn path_emission(state: PathState, surface: Surface, direction: vec3f) -> vec3f {
    let radiance = visibility_radiance(surface, direction);
    if all(radiance == vec3f(0.0)) {
        return radiance;
    }
    var light_pdf = 0.0;
    if state.previous_pdf > 0.0 {
        light_pdf = lights_pdf_of_surface(
            state.previous, surface.light, surface.position, surface.ng, surface.weights);
    }
    return radiance * path_lobe_weight(state.previous_pdf, light_pdf);
}

/// Tangent of a surface, turned as its material asks.
///
/// * `normal`, `tangent`: bent by its bump.
///
/// Twin: specula-render/src/integrator.rs, PathTracer::shading_normal_and_tangent.
fn path_tangent(surface: Surface, bound: Bound, normal: vec3f, tangent: vec3f) -> vec3f {
    if bound.isotropic {
        return vec3f(0.0);
    }
    if bound.rotation == 0.0 {
        return tangent;
    }
    let along_v = partials_of(surface).along_v;
    let frame = frame_from_normal_tangent(normal, tangent);
    let side = select(1.0, -1.0, dot(frame.t, along_v) < 0.0);
    return frame.s * cos(bound.rotation) + frame.t * (sin(bound.rotation) * side);
}

/// The vertex at a surface.
///
/// Twin: specula-render/src/integrator.rs, PathTracer::shading_point.
fn path_vertex(
    surface: Surface,
    wo: vec3f,
    s: Sequence,
    depth: u32,
    rough: bool,
) -> PathVertex {
    let outside = dot(surface.ng, wo) > 0.0;
    let facing = select(-surface.ng, surface.ng, outside);
    var material = word(SHAPES + surface.shape * SHAPE_SIZE);
    if REGULARIZES != 0u && rough {
        material = word(BEHIND_ROUGH + material);
    }
    var bound = material_bind(material, visibility_place(surface), outside, s, depth);
    let bump = bump_of_material(bound.material);
    let bent = bump_bend(bump, surface);
    let tangent = path_tangent(surface, bound, bent.normal, bent.tangent);
    let upright = select(bent.normal, -bent.normal, dot(bent.normal, facing) < 0.0);
    let unbent = select(surface.ns, -surface.ns, dot(surface.ns, facing) < 0.0);
    let softened = bump_softened(bump, unbent, upright, wo);
    let ns = softened.normal;
    let n = select(ns, facing, dot(ns, wo) <= 0.0 && bound.specular);
    let frame = frame_from_normal_tangent(n, tangent);
    let local = frame_to_local(frame, normalize(wo));
    if bound.kind == KIND_GLTF && bump_coat_differs(bound.material) {
        let coat = bump_bend(bump_of_coat(bound.material), surface).normal;
        bound.first = frame_to_local(frame, select(coat, -coat, dot(coat, facing) < 0.0));
    }
    return PathVertex(surface, bound, frame, softened.softness, facing, local);
}

/// The vertex as lights are chosen for it.
fn path_receiver(vertex: PathVertex) -> Receiver {
    let normal = select(vec3f(0.0), vertex.frame.n, vertex.bound.opaque);
    return Receiver(vertex.surface.position, normal);
}

/// How many lights are sampled at a vertex.
///
/// Twin: specula-render/src/integrator/candidates.rs, PathTracer::light_candidates.
fn path_lights_at(bound: Bound, depth: u32) -> u32 {
    let is_metal = bound.kind == KIND_CONDUCTOR || bound.kind == KIND_COMPENSATED_CONDUCTOR
        || bound.kind == KIND_MULTIBOUNCE_CONDUCTOR;
    let two = depth == 0u && is_metal && !bound.specular && LIGHT_ONLY == NONE;
    return select(1u, 2u, two);
}

/// The values of one of several lights.
///
/// Twin: specula-render/src/integrator/estimator.rs, candidate_random_numbers.
fn path_light_numbers(u: vec4f, which: u32, count: u32) -> vec4f {
    if count == 1u {
        return u;
    }
    let second = which == 1u;
    let opposite = select(u.yz - 0.5, u.yz + 0.5, u.yz < vec2f(0.5));
    let at = select(u.yz, opposite, second);
    return vec4f(0.5 * u.x + select(0.0, 0.5, second), at, 0.5 * u.w);
}

/// A light, and what it would bring to the path; black: nothing.
struct PathLight {
    light: LightSample,
    contribution: vec3f,
}

/// Samples a light, one of so many.
///
/// Twin: specula-render/src/integrator.rs, PathTracer::sample_light.
fn path_consider(
    throughput: vec3f,
    vertex: PathVertex,
    s: Sequence,
    depth: u32,
    which: u32,
    count: u32,
) -> PathLight {
    var found: PathLight;
    let u = path_light_numbers(sequence_light(s, depth), which, count);
    let light = lights_sample(path_receiver(vertex), u);
    if light.valid == 0u || (STRATEGY == STRATEGY_BSDF_ONLY && light.delta == 0u) {
        return found;
    }
    let wi = frame_to_local(vertex.frame, light.wi);
    if wi.z * dot(vertex.facing, light.wi) <= 0.0 {
        return found;
    }
    let f = material_eval(vertex.bound, vertex.wo, wi, sequence_stream(s, depth, 2u * which));
    if all(f.xyz == vec3f(0.0)) {
        return found;
    }
    let pdf = light.pdf * f32(count);
    var weight = 1.0;
    if light.delta == 0u && STRATEGY != STRATEGY_LIGHTS_ONLY {
        weight = path_heuristic(pdf, f.w);
    }
    if weight <= 0.0 {
        return found;
    }
    let fading = bump_softness(vertex.softness, light.wi);
    found.light = light;
    found.contribution = throughput * f.xyz * (light.radiance * (weight * fading / pdf));
    return found;
}

/// Adds light that was scattered so many times on its way to the camera.
///
/// Twin: specula-render/src/integrator/estimator.rs, clamp_indirect.
fn path_add(state: ptr<function, PathState>, contribution: vec3f, events: u32) {
    var c = contribution;
    if CLAMPS != 0u && events >= INDIRECT_FROM {
        let bound = bitcast<f32>(CLAMP_BITS) / number(FILM);
        let largest = max(c.x, max(c.y, c.z));
        if largest > bound {
            c *= bound / largest;
        }
    }
    (*state).radiance += c;
}

/// Light from one sampled light.
///
/// Twin: specula-render/src/integrator.rs, PathTracer::add_direct.
fn path_direct(state: ptr<function, PathState>, vertex: PathVertex, s: Sequence, depth: u32) {
    if vertex.bound.specular {
        return;
    }
    let count = path_lights_at(vertex.bound, depth);
    var kept: PathLight;
    // What all would bring that have been sampled. Twin: estimator.rs, choose_candidate.
    var all_bring = 0.0;
    var kept_brings = 0.0;
    for (var which = 0u; which < count; which += 1u) {
        let found = path_consider((*state).throughput, vertex, s, depth, which, count);
        let brings = path_mean(found.contribution);
        let before = all_bring;
        all_bring += brings;
        let u = sequence_hashed(s, vec3u(depth, 0u, HASH_CANDIDATE));
        if !(brings <= 0.0) && (which == 0u || u * all_bring >= before) {
            kept = found;
            kept_brings = brings;
        }
    }
    if kept_brings == 0.0 {
        return;
    }
    let light = kept.light;
    var media = (*state).media;
    if dot(vertex.frame.n, light.wi) < 0.0 {
        visibility_cross(&media, vertex.surface, light.wi);
    }
    var rays = 0u;
    let left = visibility_transmittance(vertex.surface, light, media, s, depth, &rays);
    (*state).rays += rays;
    path_add(state, kept.contribution * (all_bring / kept_brings) * left, depth + 1u);
}

/// Mean of the channels.
fn path_mean(c: vec3f) -> f32 {
    return (c.x + c.y + c.z) * (1.0 / 3.0);
}

/// Samples the next direction; returns whether the path goes on, along its ray.
///
/// Twin: specula-render/src/integrator.rs, PathTracer::scatter.
fn path_scatter(
    state: ptr<function, PathState>,
    vertex: PathVertex,
    s: Sequence,
    depth: u32,
) -> bool {
    let u = sequence_scatter(s, depth);
    let sampled = material_sample(vertex.bound, vertex.wo, u.xyz, sequence_stream(s, depth, STREAM_SCATTER));
    if sampled.flags == 0u {
        return false;
    }
    let direction = normalize(frame_to_world(vertex.frame, sampled.wi));
    if sampled.wi.z * dot(vertex.facing, direction) <= 0.0 {
        return false;
    }
    (*state).throughput *= sampled.weight * bump_softness(vertex.softness, direction);
    (*state).eta_scale *= sampled.eta * sampled.eta;
    let passes = (sampled.flags & BSDF_SAMPLE_TRANSMISSION) != 0u;
    if !(passes && vertex.bound.kind == KIND_THIN_DIELECTRIC) {
        (*state).flags &= PATH_ROUGH;
    }
    if (sampled.flags & BSDF_SAMPLE_SPECULAR) == 0u {
        (*state).flags |= PATH_ROUGH;
    }
    if passes {
        var media = (*state).media;
        visibility_cross(&media, vertex.surface, direction);
        (*state).media = media;
    }
    let t = (*state).throughput;
    let largest = max(t.x, max(t.y, t.z)) * (*state).eta_scale;
    if !(largest > 0.0) {
        return false;
    }
    let probability = clamp(ROULETTE_SCALE * largest, ROULETTE_LEAST, 1.0);
    if depth >= ROULETTE_FROM && probability < ROULETTE_BELOW {
        if u.w >= probability {
            return false;
        }
        (*state).throughput *= 1.0 / probability;
    }
    let lights = f32(path_lights_at(vertex.bound, depth));
    (*state).previous_pdf = select(sampled.pdf / lights, 0.0, (sampled.flags & BSDF_SAMPLE_SPECULAR) != 0u);
    (*state).previous = path_receiver(vertex);
    let surface = vertex.surface;
    let origin = offset_leave(surface.position, surface.error, surface.ng, direction);
    (*state).ray = Ray(origin, direction, FARTHEST);
    return true;
}

/// Whether a thread has a sample to take.
fn path_is_wanted(slot: u32) -> bool {
    let wave = path_wanted[0];
    let run = slot / wave.x;
    return run < wave.y && slot % wave.x < path_wanted[run + 1u].w;
}

/// The values of a sample.
fn path_sequence(slot: u32) -> Sequence {
    let places = path_wanted[0].x;
    let run = path_wanted[slot / places + 1u];
    return sequence_of(run.xy, run.z + slot % places, SEED);
}

/// A path at the camera.
fn path_begin(slot: u32, s: Sequence) -> PathState {
    let pixel = path_wanted[slot / path_wanted[0].x + 1u].xy;
    let begin = camera_ray(pixel, sequence_camera(s));
    var state: PathState;
    state.ray = Ray(begin.origin, begin.direction, FARTHEST);
    state.throughput = vec3f(1.0);
    state.eta_scale = 1.0;
    state.flags = PATH_STRAIGHT;
    path_found[3u * slot] = vec4f(vec3f(0.0), -1.0);
    path_found[3u * slot + 1u] = vec4f(0.0);
    path_found[3u * slot + 2u] = vec4f(vec3f(0.0), begin.weight);
    return state;
}

/// Notes what the first vertex shows.
fn path_shows(slot: u32, vertex: PathVertex, distance: f32) {
    let weight = path_found[3u * slot + 2u].w;
    path_found[3u * slot].w = distance;
    path_found[3u * slot + 1u] = vec4f(material_albedo(vertex.bound) * weight, 0.0);
    path_found[3u * slot + 2u] = vec4f(vertex.frame.n * weight, weight);
}

/// Takes a path from one vertex to the next; returns whether it goes on.
///
/// Twin: specula-render/src/integrator.rs, PathTracer::step.
fn path_step(slot: u32, state: ptr<function, PathState>, s: Sequence, depth: u32) -> bool {
    let begin = (*state).ray.origin;
    var ray = (*state).ray;
    var media = (*state).media;
    let met = visibility_nearest(&ray, &media, s, depth);
    (*state).media = media;
    (*state).rays += met.rays;
    (*state).throughput *= met.left;
    if !met.found {
        if !(((*state).flags & PATH_STRAIGHT) != 0u && HIDES_EMITTERS != 0u) {
            let radiance = path_background(*state, ray.direction);
            path_add(state, (*state).throughput * radiance, depth);
        }
        return false;
    }
    let surface = met.surface;
    let radiance = path_emission(*state, surface, ray.direction);
    path_add(state, (*state).throughput * radiance, depth);
    if depth >= MAX_DEPTH && depth > 0u {
        return false;
    }
    let rough = ((*state).flags & PATH_ROUGH) != 0u;
    let vertex = path_vertex(surface, -ray.direction, s, depth, rough);
    if depth == 0u {
        path_shows(slot, vertex, length(surface.position - begin));
        if MAX_DEPTH == 0u {
            return false;
        }
    }
    path_direct(state, vertex, s, depth);
    return path_scatter(state, vertex, s, depth);
}

/// Notes what a path has contributed.
fn path_end(slot: u32, state: PathState) {
    let weight = path_found[3u * slot + 2u].w;
    let value = film_developed(state.radiance) * weight;
    path_found[3u * slot] = vec4f(value, path_found[3u * slot].w);
    path_found[3u * slot + 1u].w = f32(state.rays);
}

/// Takes one sample.
@compute @workgroup_size(64)
fn path_main(@builtin(global_invocation_id) id: vec3u) {
    let slot = id.x;
    if !path_is_wanted(slot) {
        return;
    }
    let s = path_sequence(slot);
    var state = path_begin(slot, s);
    for (var depth = 0u; path_step(slot, &state, s, depth); depth += 1u) {
    }
    path_end(slot, state);
}
