// Unidirectional path tracing with next-event estimation. From one vertex to the next a path is traced, shaded and, by
// a shadow ray, connected to a light. In `path_main` a thread follows one path to its end; queue.wgsl takes all paths
// through one of these parts after the other.
//
// Twin of specula-render/src/integrator.rs and integrator/estimator.rs: the same random numbers serve the same
// decisions, so that a sample follows the same path up to rounding.

import tracer::world::{word, number, offset_leave};
import tracer::sequence::{Sequence, sequence_of, sequence_camera, sequence_scatter, sequence_light};
import tracer::sequence::{sequence_index, sequence_stream, sequence_hashed};
import tracer::camera::{camera_ray};
import tracer::film::{film_developed};
import tracer::ray::{Ray, Hit};
import tracer::surface::{Surface, surface_at, surface_place};
import tracer::footprint::{footprint_of, footprint_mean_curvature};
import tracer::ray_cone::{ray_cone_of_sample, ray_cone_at, ray_cone_mirrored, ray_cone_refracted, ray_cone_scattered};
import tracer::medium_stack::{MediumStack};
import tracer::visibility::{ShadowRay, visibility_intersect, visibility_shadow_ray, visibility_transmittance};
import tracer::visibility::{visibility_cross, visibility_radiance};
import tracer::partials::{partials_of};
import tracer::bump::{Softness, bump_of_material, bump_is_there, bump_bend, bump_softened};
import tracer::bump::{bump_softness, bump_coat_differs, bump_of_coat};
import tracer::lights::{Receiver, LightSample, lights_sample, lights_pdf_of_surface};
import tracer::lights::{lights_count_at_infinity, lights_arriving_from_infinity, lights_share_from_infinity};
import tracer::slopes::{slopes_trace_about, slopes_widening, slopes_within};
import tracer::widened::{widened_alphas, widened_bound};
import tracer::material::{Bound, material_bind, material_eval, material_sample, material_albedo};
import package::math::frame::{FrameBasis, frame_from_normal_tangent, frame_to_local, frame_to_world};
import package::bsdf::bsdf_sample::{BsdfSample};

/// The samples to be taken, in runs of consecutive samples of a pixel. First the slots of each run and the number of
/// runs; then the render's seed, maximum depth, strategy, and bound of indirect light (bits of a float, or UNCLAMPED);
/// then of each run: column, row, index of its first sample, number of samples.
@group(0) @binding(4) var<storage, read> path_requests: array<vec4u>;
/// Three vectors a sample, as sums.wgsl reads them: picture values and depth (negative where the camera ray hit
/// nothing); albedo and number of rays; normal and the filter's weight. All but depth, rays and weight are times
/// the weight.
@group(0) @binding(5) var<storage, read_write> path_results: array<vec4f>;

/// Where runs begin in `path_requests`.
const PATH_FIRST_RUN: u32 = 2u;
/// The path has passed through thin panes only: hidden lights stay hidden.
const PATH_STRAIGHT: u32 = 1u;
/// The path was scattered by a lobe that is not perfectly smooth.
const PATH_ROUGH: u32 = 2u;
/// The path ends where it is.
const PATH_ENDS: u32 = 4u;

/// The state of a path.
struct PathState {
    // The ray to the next vertex, and what it hits.
    ray: Ray,
    hit: Hit,
    // How many rays were traced.
    rays: u32,
    // Density with which the last direction was sampled; 0 where no light sample could have had it.
    previous_pdf: f32,
    // PATH_STRAIGHT, PATH_ROUGH and PATH_ENDS.
    flags: u32,
    radiance: vec3f,
    eta_scale: f32,
    throughput: vec3f,
    // The vertex where the last direction was sampled; at first, where the camera is.
    previous: Receiver,
    // The media that the path is in.
    media: MediumStack,
    // How wide what the path stands for is, where textures are filtered.
    cone: vec2f,
}

/// A surface with its lobe and shading frame, which faces the viewer.
///
/// Twin: specula-render/src/integrator.rs, ShadingPoint.
struct PathShadingPoint {
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

/// The render's maximum depth.
fn path_max_depth() -> u32 {
    return path_requests[1].y;
}

/// How direct light is sampled: one of the codes `STRATEGY_*`.
fn path_strategy() -> u32 {
    return path_requests[1].z;
}

/// MIS weight of a direction that was sampled with density `a` and could have been with density `b`.
///
/// Twin: specula-render/src/integrator/estimator.rs, mis_weight.
fn path_mis_weight(a: f32, b: f32) -> f32 {
    // As a ratio: squares of densities overflow.
    let ratio = min(b / a, 1.0e18);
    let strategy = path_strategy();
    if strategy == STRATEGY_BALANCE {
        return 1.0 / (1.0 + ratio);
    }
    if strategy == STRATEGY_POWER {
        return 1.0 / (1.0 + ratio * ratio);
    }
    return 1.0 / (1.0 + ratio * sqrt(ratio));
}

/// MIS weight of emission on a ray whose direction a lobe sampled with density `pdf` (0: the camera or a perfect
/// mirror) and light sampling takes with density `light_pdf`.
///
/// Twin: specula-render/src/integrator/estimator.rs, emission_weight.
fn path_emission_weight(pdf: f32, light_pdf: f32) -> f32 {
    let strategy = path_strategy();
    if pdf <= 0.0 || strategy == STRATEGY_BSDF_ONLY {
        return 1.0;
    }
    if strategy == STRATEGY_LIGHTS_ONLY {
        return 0.0;
    }
    return path_mis_weight(pdf, light_pdf);
}

/// Light from infinity on a ray that hits nothing, with its MIS weight.
///
/// Twin: specula-render/src/integrator.rs, PathTracer::background.
fn path_background(state: PathState, direction: vec3f) -> vec3f {
    var sum = vec3f(0.0);
    let count = lights_count_at_infinity();
    var share = 0.0;
    if count > 0u && state.previous_pdf > 0.0 {
        share = lights_share_from_infinity(state.previous);
    }
    for (var i = 0u; i < count; i += 1u) {
        let arriving = lights_arriving_from_infinity(i, direction);
        sum += arriving.xyz * path_emission_weight(state.previous_pdf, share * arriving.w);
    }
    return sum;
}

/// Emission of a surface, with its MIS weight.
///
/// Twin: specula-render/src/integrator.rs, PathTracer::emission.
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
    return radiance * path_emission_weight(state.previous_pdf, light_pdf);
}

/// Tangent of a surface, with its material's rotation.
///
/// * `normal`, `tangent`: bent by its bump map.
/// * `varies`: whether its tangent matters, also where the material's own does not.
///
/// Twin: specula-render/src/integrator/bumped.rs, PathTracer::bumped_frame.
fn path_tangent(surface: Surface, bound: Bound, normal: vec3f, tangent: vec3f, varies: bool) -> vec3f {
    if bound.isotropic && !varies {
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

/// The surface with its material's lobe and its shading frame.
///
/// Twin: specula-render/src/integrator.rs, PathTracer::shading_point.
fn path_shading_point(
    surface: Surface,
    wo: vec3f,
    s: Sequence,
    depth: u32,
    rough: bool,
) -> PathShadingPoint {
    let outside = dot(surface.ng, wo) > 0.0;
    let facing = select(-surface.ng, surface.ng, outside);
    var material = word(SHAPES + surface.shape * SHAPE_SIZE);
    if REGULARIZES != 0u && rough {
        material = word(BEHIND_ROUGH + material);
    }
    var bound = material_bind(material, surface_place(surface), outside, s, depth);
    let bump = bump_of_material(bound.material);
    let bent = bump_bend(bump, surface);
    let varies = NORMAL_MAPS_ARE_FILTERED != 0u && bent.spread.covariance.x + bent.spread.covariance.z > 0.0;
    var tangent = path_tangent(surface, bound, bent.normal, bent.tangent, varies);
    let upright = select(bent.normal, -bent.normal, dot(bent.normal, facing) < 0.0);
    let unbent = select(surface.ns, -surface.ns, dot(surface.ns, facing) < 0.0);
    let softened = bump_softened(bump, unbent, upright, wo);
    let ns = softened.normal;
    let has_coat = bound.kind == KIND_GLTF && bump_coat_differs(bound.material);
    var coat = vec3f(0.0);
    var own_coat = 0.0;
    if has_coat {
        let bent_coat = bump_bend(bump_of_coat(bound.material), surface);
        coat = select(bent_coat.normal, -bent_coat.normal, dot(bent_coat.normal, facing) < 0.0);
        if NORMAL_MAPS_ARE_FILTERED != 0u {
            own_coat = slopes_trace_about(bent_coat.spread, coat);
        }
    }
    if NORMAL_MAPS_ARE_FILTERED != 0u && (varies || own_coat > 0.0) {
        let unturned = frame_from_normal_tangent(ns, tangent);
        let map = slopes_within(bent.spread, unturned);
        let widening = slopes_widening(map, own_coat, widened_alphas(bound));
        bound = widened_bound(bound, widening);
        tangent = unturned.s * widening.turn.x + unturned.t * widening.turn.y;
    }
    let n = select(ns, facing, dot(ns, wo) <= 0.0 && bound.specular);
    let frame = frame_from_normal_tangent(n, tangent);
    let local = frame_to_local(frame, normalize(wo));
    if has_coat {
        bound.first = frame_to_local(frame, coat);
    }
    return PathShadingPoint(surface, bound, frame, softened.softness, facing, local);
}

/// The point as lights are chosen for it.
fn path_receiver(vertex: PathShadingPoint) -> Receiver {
    let normal = select(vec3f(0.0), vertex.frame.n, vertex.bound.opaque);
    return Receiver(vertex.surface.position, normal);
}

/// How many light candidates a vertex has.
///
/// Twin: specula-render/src/integrator/candidates.rs, PathTracer::light_candidates.
fn path_light_candidates(bound: Bound, depth: u32) -> u32 {
    let is_metal = bound.kind == KIND_CONDUCTOR || bound.kind == KIND_COMPENSATED_CONDUCTOR
        || bound.kind == KIND_MULTIBOUNCE_CONDUCTOR;
    let two = depth == 0u && is_metal && !bound.specular && LIGHT_ONLY == NONE;
    return select(1u, 2u, two);
}

/// The random numbers of one of `count` light candidates.
///
/// Twin: specula-render/src/integrator/estimator.rs, candidate_random_numbers.
fn path_candidate_random_numbers(u: vec4f, which: u32, count: u32) -> vec4f {
    if count == 1u {
        return u;
    }
    let second = which == 1u;
    let opposite = select(u.yz - 0.5, u.yz + 0.5, u.yz < vec2f(0.5));
    let at = select(u.yz, opposite, second);
    return vec4f(0.5 * u.x + select(0.0, 0.5, second), at, 0.5 * u.w);
}

/// A light sample and its contribution, should nothing occlude it; black where it has none.
struct PathCandidate {
    light: LightSample,
    contribution: vec3f,
}

/// Samples a light.
///
/// * `which`, `count`: which of how many light candidates.
///
/// Twin: specula-render/src/integrator.rs, PathTracer::sample_light.
fn path_sample_light(
    throughput: vec3f,
    vertex: PathShadingPoint,
    s: Sequence,
    depth: u32,
    which: u32,
    count: u32,
) -> PathCandidate {
    var candidate: PathCandidate;
    let u = path_candidate_random_numbers(sequence_light(s, depth), which, count);
    let light = lights_sample(path_receiver(vertex), u);
    if light.valid == 0u || (path_strategy() == STRATEGY_BSDF_ONLY && light.delta == 0u) {
        return candidate;
    }
    let wi = frame_to_local(vertex.frame, light.wi);
    if wi.z * dot(vertex.facing, light.wi) <= 0.0 {
        return candidate;
    }
    let f = material_eval(vertex.bound, vertex.wo, wi, sequence_stream(s, depth, 2u * which));
    if all(f.xyz == vec3f(0.0)) {
        return candidate;
    }
    let pdf = light.pdf * f32(count);
    var weight = 1.0;
    if light.delta == 0u && path_strategy() != STRATEGY_LIGHTS_ONLY {
        weight = path_mis_weight(pdf, f.w);
    }
    if weight <= 0.0 {
        return candidate;
    }
    let fading = bump_softness(vertex.softness, light.wi);
    candidate.light = light;
    candidate.contribution = throughput * f.xyz * (light.radiance * (weight * fading / pdf));
    return candidate;
}

/// Adds light that was scattered `events` times on its way to the camera.
///
/// Twin: specula-render/src/integrator/estimator.rs, clamp_indirect.
fn path_add(state: ptr<function, PathState>, contribution: vec3f, events: u32) {
    var c = contribution;
    if path_requests[1].w != UNCLAMPED && events >= INDIRECT_FROM {
        let bound = bitcast<f32>(path_requests[1].w) / number(FILM);
        let largest = max(c.x, max(c.y, c.z));
        if largest > bound {
            c *= bound / largest;
        }
    }
    (*state).radiance += c;
}

/// The ray to a light, chosen among the light candidates of a vertex, with its contribution.
///
/// Twin: specula-render/src/integrator.rs, PathTracer::add_direct.
fn path_shadow_ray(state: PathState, vertex: PathShadingPoint, s: Sequence, depth: u32) -> ShadowRay {
    var none: ShadowRay;
    if vertex.bound.specular {
        return none;
    }
    let count = path_light_candidates(vertex.bound, depth);
    var chosen: PathCandidate;
    // Means of the contributions: of all candidates so far, of the chosen one. Twin: estimator.rs, choose_candidate.
    var sum = 0.0;
    var mean_of_chosen = 0.0;
    for (var which = 0u; which < count; which += 1u) {
        let candidate = path_sample_light(state.throughput, vertex, s, depth, which, count);
        let mean = path_mean(candidate.contribution);
        let before = sum;
        sum += mean;
        let u = sequence_hashed(s, vec3u(depth, 0u, HASH_CANDIDATE));
        if !(mean <= 0.0) && (which == 0u || u * sum >= before) {
            chosen = candidate;
            mean_of_chosen = mean;
        }
    }
    if mean_of_chosen == 0.0 {
        return none;
    }
    let light = chosen.light;
    var media = state.media;
    if dot(vertex.frame.n, light.wi) < 0.0 {
        visibility_cross(&media, vertex.surface, light.wi);
    }
    return visibility_shadow_ray(vertex.surface, light, media, chosen.contribution * (sum / mean_of_chosen));
}

/// Mean of the channels.
fn path_mean(c: vec3f) -> f32 {
    return (c.x + c.y + c.z) * (1.0 / 3.0);
}

/// The cone of a path that was scattered.
///
/// Twin: specula-render/src/integrator/footprints.rs, PathTracer::spread_cone.
fn path_spread(cone: vec2f, vertex: PathShadingPoint, sampled: BsdfSample, index: u32) -> vec2f {
    if (sampled.flags & BSDF_SAMPLE_SPECULAR) == 0u {
        return ray_cone_scattered(cone, sampled.pdf, index);
    }
    let outside = dot(vertex.facing, vertex.surface.ng) >= 0.0;
    let curvature = select(-1.0, 1.0, outside) * footprint_mean_curvature(vertex.surface);
    if (sampled.flags & BSDF_SAMPLE_TRANSMISSION) == 0u {
        return ray_cone_mirrored(cone, curvature);
    }
    return ray_cone_refracted(cone, curvature, sampled.eta);
}

/// Samples the next ray; returns whether the path continues.
///
/// Twin: specula-render/src/integrator.rs, PathTracer::scatter.
fn path_scatter(
    state: ptr<function, PathState>,
    vertex: PathShadingPoint,
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
        (*state).flags &= ~PATH_STRAIGHT;
    }
    if (sampled.flags & BSDF_SAMPLE_SPECULAR) == 0u {
        (*state).flags |= PATH_ROUGH;
    }
    if TEXTURES_ARE_FILTERED != 0u {
        (*state).cone = path_spread((*state).cone, vertex, sampled, sequence_index(s));
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
    let candidates = f32(path_light_candidates(vertex.bound, depth));
    (*state).previous_pdf = select(sampled.pdf / candidates, 0.0, (sampled.flags & BSDF_SAMPLE_SPECULAR) != 0u);
    (*state).previous = path_receiver(vertex);
    let surface = vertex.surface;
    let origin = offset_leave(surface.position, surface.error, surface.ng, direction);
    (*state).ray = Ray(origin, direction, FARTHEST);
    return true;
}

/// Whether a slot has a sample to be taken.
fn path_is_requested(slot: u32) -> bool {
    let head = path_requests[0];
    let run = slot / head.x;
    return run < head.y && slot % head.x < path_requests[run + PATH_FIRST_RUN].w;
}

/// The sample sequence of a slot.
fn path_sequence(slot: u32) -> Sequence {
    let slots = path_requests[0].x;
    let run = path_requests[slot / slots + PATH_FIRST_RUN];
    return sequence_of(run.xy, run.z + slot % slots, path_requests[1].x);
}

/// Begins a path: its camera ray.
fn path_begin(slot: u32, s: Sequence) -> PathState {
    let pixel = path_requests[slot / path_requests[0].x + PATH_FIRST_RUN].xy;
    let begin = camera_ray(pixel, sequence_camera(s));
    var state: PathState;
    state.ray = Ray(begin.origin, begin.direction, FARTHEST);
    state.previous.position = begin.origin;
    state.throughput = vec3f(1.0);
    state.eta_scale = 1.0;
    state.flags = PATH_STRAIGHT;
    state.cone = ray_cone_of_sample(begin.cone, sequence_index(s));
    path_results[3u * slot] = vec4f(vec3f(0.0), -1.0);
    path_results[3u * slot + 1u] = vec4f(0.0);
    path_results[3u * slot + 2u] = vec4f(vec3f(0.0), begin.weight);
    return state;
}

/// Writes depth, albedo and normal of the first vertex, the features for denoisers.
fn path_write_features(slot: u32, vertex: PathShadingPoint, distance: f32) {
    let weight = path_results[3u * slot + 2u].w;
    path_results[3u * slot].w = distance;
    path_results[3u * slot + 1u] = vec4f(material_albedo(vertex.bound) * weight, 0.0);
    path_results[3u * slot + 2u] = vec4f(vertex.frame.n * weight, weight);
}

/// Traces a path to its next vertex.
fn path_trace(state: ptr<function, PathState>, s: Sequence, depth: u32) {
    var ray = (*state).ray;
    var media = (*state).media;
    let found = visibility_intersect(&ray, &media, s, depth);
    (*state).ray = ray;
    (*state).media = media;
    (*state).hit = found.hit;
    (*state).rays += found.rays;
    (*state).throughput *= found.transmittance;
}

/// Shades the vertex that a path has been traced to: adds its emission, or the background, and samples the next ray,
/// unless the path ends. Returns a ray to a light.
///
/// Twin: specula-render/src/integrator.rs, PathTracer::step.
fn path_shade(slot: u32, state: ptr<function, PathState>, s: Sequence, depth: u32) -> ShadowRay {
    var none: ShadowRay;
    let ray = (*state).ray;
    let straight = ((*state).flags & PATH_STRAIGHT) != 0u;
    let rough = ((*state).flags & PATH_ROUGH) != 0u;
    (*state).flags |= PATH_ENDS;
    if (*state).hit.instance == NONE {
        if !(straight && HIDES_EMITTERS != 0u) {
            let radiance = path_background(*state, ray.direction);
            path_add(state, (*state).throughput * radiance, depth);
        }
        return none;
    }
    var surface = surface_at(ray, (*state).hit);
    let radiance = path_emission(*state, surface, ray.direction);
    path_add(state, (*state).throughput * radiance, depth);
    if depth >= path_max_depth() && depth > 0u {
        return none;
    }
    let distance = length(surface.position - (*state).previous.position);
    if TEXTURES_ARE_FILTERED != 0u {
        (*state).cone = ray_cone_at((*state).cone, distance);
        surface.footprint = footprint_of(surface, ray.direction, (*state).cone.x);
    }
    let vertex = path_shading_point(surface, -ray.direction, s, depth, rough);
    if depth == 0u {
        path_write_features(slot, vertex, distance);
        if path_max_depth() == 0u {
            return none;
        }
    }
    let shadow = path_shadow_ray(*state, vertex, s, depth);
    if path_scatter(state, vertex, s, depth) {
        (*state).flags &= ~PATH_ENDS;
    }
    return shadow;
}

/// Adds the light that arrives along a shadow ray.
fn path_connect(state: ptr<function, PathState>, shadow: ShadowRay, s: Sequence, depth: u32) {
    if all(shadow.contribution == vec3f(0.0)) {
        return;
    }
    var rays = 0u;
    let transmittance = visibility_transmittance(shadow, s, depth, &rays);
    (*state).rays += rays;
    path_add(state, shadow.contribution * transmittance, depth + 1u);
}

/// Writes the pixel sample of a path that has ended: its radiance, developed, times the filter's weight.
fn path_end(slot: u32, state: PathState) {
    let weight = path_results[3u * slot + 2u].w;
    let value = film_developed(state.radiance) * weight;
    path_results[3u * slot] = vec4f(value, path_results[3u * slot].w);
    path_results[3u * slot + 1u].w = f32(state.rays);
}

/// Takes one sample: follows its path to the end.
@compute @workgroup_size(64)
fn path_main(@builtin(global_invocation_id) id: vec3u) {
    let slot = id.x;
    if !path_is_requested(slot) {
        return;
    }
    let s = path_sequence(slot);
    var state = path_begin(slot, s);
    for (var depth = 0u; (state.flags & PATH_ENDS) == 0u; depth += 1u) {
        path_trace(&state, s, depth);
        let shadow = path_shade(slot, &state, s, depth);
        path_connect(&state, shadow, s, depth);
    }
    path_end(slot, state);
}
