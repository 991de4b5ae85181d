// What rays pass on their way: cut-outs, hidden lights, and boundaries without surface, between which
// media absorb.
//
// Twin of specula-render/src/integrator/visibility.rs.

import tracer::world::{word, offset_leave};
import tracer::sequence::{Sequence, sequence_hashed};
import tracer::ray::{Ray};
import tracer::traverse::{traverse, traverse_occluded};
import tracer::surface::{Surface, surface_at};
import tracer::medium_stack::{MediumStack, medium_stack_cross, medium_stack_transmittance};
import tracer::texture_coordinates::{TextureCoordinates};
import tracer::texture_graph::{parameter_float, parameter_colour};
import tracer::lights::{LightSample};

/// The ray ends at the surface.
const VISIBILITY_STOPS: u32 = 0u;
/// The surface is not there.
const VISIBILITY_PASSES: u32 = 1u;
/// The surface bounds what absorbs, and nothing else.
const VISIBILITY_CROSSES: u32 = 2u;

/// The first surface that does not let a ray pass, if there is one.
struct Met {
    found: bool,
    surface: Surface,
    // What is left of what the ray carries.
    left: vec3f,
    rays: u32,
}

/// The surface as textures see it.
fn visibility_place(s: Surface) -> TextureCoordinates {
    return TextureCoordinates(s.uv, s.second_uv, s.position, s.ng, s.colour);
}

/// Light that a surface sends out itself; black where it sends none out there.
///
/// Twin: specula-render/src/integrator.rs, PathTracer::emission.
fn visibility_radiance(s: Surface, direction: vec3f) -> vec3f {
    let shape = SHAPES + s.shape * SHAPE_SIZE;
    let emits = word(shape + 1u) != 0u || dot(s.ng, direction) < 0.0;
    if s.light == NONE || !emits {
        return vec3f(0.0);
    }
    return max(parameter_colour(shape + 3u, visibility_place(s)), vec3f(0.0));
}

/// What a surface does with a ray, by chance where it is partly transparent.
///
/// Twin: specula-render/src/integrator/visibility.rs, PathTracer::passage.
fn visibility_meeting(surface: Surface, s: Sequence, key: vec3u) -> u32 {
    let shape = SHAPES + surface.shape * SHAPE_SIZE;
    let alpha = parameter_float(shape + 7u, visibility_place(surface));
    if !(alpha >= 1.0 || sequence_hashed(s, key) < alpha) {
        return VISIBILITY_PASSES;
    }
    return select(VISIBILITY_STOPS, VISIBILITY_CROSSES, word(shape + 9u) != 0u);
}

/// Passes a surface: what the path is in changes where that bounds a body.
fn visibility_cross(media: ptr<function, MediumStack>, surface: Surface, direction: vec3f) {
    let material = word(SHAPES + surface.shape * SHAPE_SIZE);
    medium_stack_cross(media, material, dot(surface.ng, direction) < 0.0);
}

/// The first surface that does not let the ray pass, and what is absorbed on the way to it. Hidden lights
/// let the camera's rays pass until these have met something else.
///
/// * `ray`: the one that meets it, when this returns.
///
/// Twin: specula-render/src/integrator/visibility.rs, PathTracer::intersect.
fn visibility_nearest(
    ray: ptr<function, Ray>,
    media: ptr<function, MediumStack>,
    s: Sequence,
    depth: u32,
) -> Met {
    var met: Met;
    met.left = vec3f(1.0);
    var begin = (*ray).origin;
    var hidden = HIDES_EMITTERS != 0u && depth == 0u;
    for (var pass_ = 0u; pass_ < MOST_PASSES; pass_ += 1u) {
        met.rays += 1u;
        let hit = traverse(*ray, false);
        if hit.instance == NONE {
            return met;
        }
        met.surface = surface_at(*ray, hit);
        hidden = hidden && met.surface.light != NONE;
        var meeting = VISIBILITY_STOPS;
        if hidden {
            meeting = VISIBILITY_PASSES;
        } else if HAS_PASSABLE != 0u {
            meeting = visibility_meeting(met.surface, s, vec3u(depth, pass_, 1u));
        }
        if HAS_BOUNDARIES != 0u && meeting != VISIBILITY_PASSES {
            let distance = length(met.surface.position - begin);
            met.left *= medium_stack_transmittance((*media).absorption, distance);
        }
        if meeting == VISIBILITY_STOPS {
            met.found = true;
            return met;
        }
        let direction = (*ray).direction;
        if meeting == VISIBILITY_CROSSES {
            visibility_cross(media, met.surface, direction);
            begin = met.surface.position;
        }
        (*ray).origin = offset_leave(
            met.surface.position, met.surface.error, met.surface.ng, direction);
    }
    return met;
}

/// What the last body leaves of a light. What sees one at infinity is in none that is closed.
fn visibility_last_stretch(begin: vec3f, light: LightSample, media: MediumStack) -> vec3f {
    if HAS_BOUNDARIES == 0u || light.from_infinity != 0u {
        return vec3f(1.0);
    }
    return medium_stack_transmittance(media.absorption, length(light.target_position - begin));
}

/// What is left of a light's radiance on its way to a surface; zero where something stands between them.
///
/// * `within`: what the surface is in, on the light's side.
///
/// Twin: specula-render/src/integrator/visibility.rs, PathTracer::transmittance.
fn visibility_transmittance(
    surface: Surface,
    light: LightSample,
    within: MediumStack,
    s: Sequence,
    depth: u32,
    rays: ptr<function, u32>,
) -> vec3f {
    let origin = offset_leave(surface.position, surface.error, surface.ng, light.wi);
    var ray = Ray(origin, light.wi, FARTHEST);
    if light.from_infinity == 0u {
        let other = offset_leave(
            light.target_position, light.target_error, light.target_normal, -light.wi);
        ray = Ray(origin, other - origin, SHADOW_RAY_END);
    }
    if HAS_PASSABLE == 0u {
        *rays += 1u;
        if traverse_occluded(ray) {
            return vec3f(0.0);
        }
        return visibility_last_stretch(surface.position, light, within);
    }
    var media = within;
    var begin = surface.position;
    var left = vec3f(1.0);
    for (var pass_ = 0u; pass_ < MOST_PASSES; pass_ += 1u) {
        *rays += 1u;
        let hit = traverse(ray, false);
        if hit.instance == NONE {
            return left * visibility_last_stretch(begin, light, media);
        }
        let there = surface_at(ray, hit);
        let meeting = visibility_meeting(there, s, vec3u(depth, pass_, 2u));
        if meeting == VISIBILITY_STOPS {
            return vec3f(0.0);
        }
        if meeting == VISIBILITY_CROSSES {
            let distance = length(there.position - begin);
            left *= medium_stack_transmittance(media.absorption, distance);
            visibility_cross(&media, there, ray.direction);
            begin = there.position;
        }
        ray.origin = offset_leave(there.position, there.error, there.ng, ray.direction);
        ray.t_max -= hit.t;
        if ray.t_max <= 0.0 {
            return left * visibility_last_stretch(begin, light, media);
        }
    }
    return vec3f(0.0);
}
