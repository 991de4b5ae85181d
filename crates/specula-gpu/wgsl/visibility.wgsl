// Rays through cut-outs, hidden lights, and boundaries of media that have no surface.
//
// Twin of specula-render/src/integrator/visibility.rs.

import tracer::world::{word, vector, offset_leave};
import tracer::sequence::{Sequence, sequence_hashed};
import tracer::ray::{Ray, Hit};
import tracer::traverse::{traverse, traverse_occluded};
import tracer::surface::{Surface, surface_at, surface_place};
import tracer::medium_stack::{MediumStack, medium_stack_cross, medium_stack_transmittance};
import tracer::texture_graph::{parameter_float, parameter_colour};
import tracer::lights::{LightSample};

/// The ray ends at the surface.
const VISIBILITY_BLOCKED: u32 = 0u;
/// The ray passes as if nothing were there.
const VISIBILITY_FREE: u32 = 1u;
/// The ray passes from one medium into another.
const VISIBILITY_BOUNDARY: u32 = 2u;
/// Whether it takes surfaces to follow a ray: some let it pass, or bound media. 0: it ends at its first hit.
const VISIBILITY_BY_SURFACES: u32 = HAS_PASSABLE | HAS_BOUNDARIES | HIDES_EMITTERS;

/// Where something blocks a ray, if anything does.
struct VisibilityHit {
    hit: Hit,
    // Of the media on the way.
    transmittance: vec3f,
    // How many rays were traced.
    rays: u32,
}

/// A ray from a surface to a light.
struct ShadowRay {
    ray: Ray,
    // What arrives on the way to the camera, should nothing occlude the light; black: there is no such ray.
    contribution: vec3f,
    from_infinity: u32,
    // Where there are media: the surface, the light, and the media at the surface on the light's side.
    begin: vec3f,
    end: vec3f,
    media: MediumStack,
}

/// Emitted radiance of a surface; black on a side that does not emit.
///
/// Twin: specula-render/src/integrator.rs, PathTracer::emission.
fn visibility_radiance(s: Surface, direction: vec3f) -> vec3f {
    let shape = SHAPES + s.shape * SHAPE_SIZE;
    let emits = word(shape + 1u) != 0u || dot(s.ng, direction) < 0.0;
    if s.light == NONE || !emits {
        return vec3f(0.0);
    }
    if LIGHT_HAS_TEXTURED == 0u {
        return max(vector(shape + 4u), vec3f(0.0));
    }
    return max(parameter_colour(shape + 3u, surface_place(s)), vec3f(0.0));
}

/// What a surface does to a ray: by chance where it is partly transparent.
///
/// Twin: specula-render/src/integrator/visibility.rs, PathTracer::passage.
fn visibility_passage(surface: Surface, s: Sequence, key: vec3u) -> u32 {
    let shape = SHAPES + surface.shape * SHAPE_SIZE;
    let alpha = parameter_float(shape + 7u, surface_place(surface));
    if !(alpha >= 1.0 || sequence_hashed(s, key) < alpha) {
        return VISIBILITY_FREE;
    }
    return select(VISIBILITY_BLOCKED, VISIBILITY_BOUNDARY, word(shape + 9u) != 0u);
}

/// Updates the media where a path passes a surface that bounds one.
///
/// Twin: specula-render/src/integrator/visibility.rs, PathTracer::cross.
fn visibility_cross(media: ptr<function, MediumStack>, surface: Surface, direction: vec3f) {
    let material = word(SHAPES + surface.shape * SHAPE_SIZE);
    medium_stack_cross(media, material, dot(surface.ng, direction) < 0.0);
}

/// The first hit that blocks the ray, and the transmittance of the media on the way. Hidden lights let camera
/// rays pass until these have hit something else.
///
/// * `ray`: on return, the ray that hits the surface.
///
/// Twin: specula-render/src/integrator/visibility.rs, PathTracer::intersect.
fn visibility_intersect(
    ray: ptr<function, Ray>,
    media: ptr<function, MediumStack>,
    s: Sequence,
    depth: u32,
) -> VisibilityHit {
    var first: VisibilityHit;
    first.transmittance = vec3f(1.0);
    if VISIBILITY_BY_SURFACES == 0u {
        first.hit = traverse(*ray, false);
        first.rays = 1u;
        return first;
    }
    var begin = (*ray).origin;
    var hidden = HIDES_EMITTERS != 0u && depth == 0u;
    for (var pass_ = 0u; pass_ < MOST_PASSES; pass_ += 1u) {
        first.rays += 1u;
        first.hit = traverse(*ray, false);
        if first.hit.instance == NONE {
            return first;
        }
        let surface = surface_at(*ray, first.hit);
        hidden = hidden && surface.light != NONE;
        var passage = VISIBILITY_BLOCKED;
        if hidden {
            passage = VISIBILITY_FREE;
        } else if HAS_PASSABLE != 0u {
            passage = visibility_passage(surface, s, vec3u(depth, pass_, 1u));
        }
        if HAS_BOUNDARIES != 0u && passage != VISIBILITY_FREE {
            let distance = length(surface.position - begin);
            first.transmittance *= medium_stack_transmittance((*media).absorption, distance);
        }
        if passage == VISIBILITY_BLOCKED {
            return first;
        }
        let direction = (*ray).direction;
        if passage == VISIBILITY_BOUNDARY {
            visibility_cross(media, surface, direction);
            begin = surface.position;
        }
        (*ray).origin = offset_leave(surface.position, surface.error, surface.ng, direction);
    }
    first.hit.instance = NONE;
    return first;
}

/// The ray from a surface to a light sample.
///
/// * `within`: the media at the surface, on the light's side.
/// * `contribution`: of the light sample.
fn visibility_shadow_ray(
    surface: Surface,
    light: LightSample,
    within: MediumStack,
    contribution: vec3f,
) -> ShadowRay {
    let origin = offset_leave(surface.position, surface.error, surface.ng, light.wi);
    var shadow: ShadowRay;
    shadow.ray = Ray(origin, light.wi, FARTHEST);
    if light.from_infinity == 0u {
        let other = offset_leave(
            light.target_position, light.target_error, light.target_normal, -light.wi);
        shadow.ray = Ray(origin, other - origin, SHADOW_RAY_END);
    }
    shadow.contribution = contribution;
    shadow.from_infinity = light.from_infinity;
    if HAS_BOUNDARIES != 0u {
        shadow.begin = surface.position;
        shadow.end = light.target_position;
        shadow.media = within;
    }
    return shadow;
}

/// Transmittance of the medium in front of the light. A vertex that sees infinity is in no closed medium.
///
/// Twin: specula-render/src/integrator/visibility.rs, transmittance_to_light.
fn visibility_last_segment(begin: vec3f, shadow: ShadowRay, media: MediumStack) -> vec3f {
    if HAS_BOUNDARIES == 0u || shadow.from_infinity != 0u {
        return vec3f(1.0);
    }
    return medium_stack_transmittance(media.absorption, length(shadow.end - begin));
}

/// Transmittance from a light to a surface; zero where the light is occluded.
///
/// * `rays`: number of rays that were traced, which is added to.
///
/// Twin: specula-render/src/integrator/visibility.rs, PathTracer::transmittance.
fn visibility_transmittance(shadow: ShadowRay, s: Sequence, depth: u32, rays: ptr<function, u32>) -> vec3f {
    var ray = shadow.ray;
    if HAS_PASSABLE == 0u {
        *rays += 1u;
        if traverse_occluded(ray) {
            return vec3f(0.0);
        }
        return visibility_last_segment(shadow.begin, shadow, shadow.media);
    }
    var media = shadow.media;
    var begin = shadow.begin;
    var transmittance = vec3f(1.0);
    for (var pass_ = 0u; pass_ < MOST_PASSES; pass_ += 1u) {
        *rays += 1u;
        let hit = traverse(ray, false);
        if hit.instance == NONE {
            return transmittance * visibility_last_segment(begin, shadow, media);
        }
        let there = surface_at(ray, hit);
        let passage = visibility_passage(there, s, vec3u(depth, pass_, 2u));
        if passage == VISIBILITY_BLOCKED {
            return vec3f(0.0);
        }
        if passage == VISIBILITY_BOUNDARY {
            let distance = length(there.position - begin);
            transmittance *= medium_stack_transmittance(media.absorption, distance);
            visibility_cross(&media, there, ray.direction);
            begin = there.position;
        }
        ray.origin = offset_leave(there.position, there.error, there.ng, ray.direction);
        ray.t_max -= hit.t;
        if ray.t_max <= 0.0 {
            return transmittance * visibility_last_segment(begin, shadow, media);
        }
    }
    return vec3f(0.0);
}
