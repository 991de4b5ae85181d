// What rays pass on their way: cut-outs, hidden lights, and boundaries without surface, between which
// bodies absorb.
//
// Twin of specula-render/src/integrator/passing.rs.

import tracer::world::{word, offset_leave};
import tracer::sequence::{Sequence, sequence_hashed};
import tracer::ray::{Ray};
import tracer::traverse::{traverse, traverse_occluded};
import tracer::surface::{Surface, surface_at, SHAPE_SIZE};
import tracer::bodies::{Bodies, bodies_cross, bodies_transmittance};
import tracer::texture_place::{Place};
import tracer::texture_graph::{parameter_float, parameter_colour};
import tracer::lights::{LightSample};

/// How much of the ray to a light is looked at: not its very end.
const PASSING_TO_LIGHT: f32 = 0.9999;
/// Most surfaces that a ray passes.
const PASSING_MOST: u32 = 4096u;
/// The ray ends at the surface.
const PASSING_STOPS: u32 = 0u;
/// The surface is not there.
const PASSING_PASSES: u32 = 1u;
/// The surface bounds what absorbs, and nothing else.
const PASSING_CROSSES: u32 = 2u;

/// The first surface that does not let a ray pass, if there is one.
struct Met {
    found: bool,
    surface: Surface,
    // What is left of what the ray carries.
    left: vec3f,
    rays: u32,
}

/// The surface as textures see it.
fn passing_place(s: Surface) -> Place {
    return Place(s.uv, s.second_uv, s.position, s.ng, s.colour);
}

/// Light that a surface sends out itself; black where it sends none out there.
///
/// Twin: specula-render/src/integrator.rs, PathTracer::emission.
fn passing_radiance(s: Surface, direction: vec3f) -> vec3f {
    let shape = SHAPES + s.shape * SHAPE_SIZE;
    let shines = word(shape + 1u) != 0u || dot(s.ng, direction) < 0.0;
    if s.light == NONE || !shines {
        return vec3f(0.0);
    }
    return max(parameter_colour(shape + 3u, passing_place(s)), vec3f(0.0));
}

/// What a surface does with a ray, by chance where it is partly transparent.
///
/// Twin: specula-render/src/integrator/passing.rs, PathTracer::meeting.
fn passing_meeting(surface: Surface, s: Sequence, key: vec3u) -> u32 {
    let shape = SHAPES + surface.shape * SHAPE_SIZE;
    let alpha = parameter_float(shape + 7u, passing_place(surface));
    if !(alpha >= 1.0 || sequence_hashed(s, key) < alpha) {
        return PASSING_PASSES;
    }
    return select(PASSING_STOPS, PASSING_CROSSES, word(shape + 9u) != 0u);
}

/// Passes a surface: what the path is in changes where that bounds a body.
fn passing_cross(bodies: ptr<function, Bodies>, surface: Surface, direction: vec3f) {
    let material = word(SHAPES + surface.shape * SHAPE_SIZE);
    bodies_cross(bodies, material, dot(surface.ng, direction) < 0.0);
}

/// The first surface that does not let the ray pass, and what is absorbed on the way to it. Hidden lights
/// let the camera's rays pass until these have met something else.
///
/// * `ray`: the one that meets it, when this returns.
///
/// Twin: specula-render/src/integrator/passing.rs, PathTracer::nearest.
fn passing_nearest(
    ray: ptr<function, Ray>,
    bodies: ptr<function, Bodies>,
    s: Sequence,
    depth: u32,
) -> Met {
    var met: Met;
    met.left = vec3f(1.0);
    var begin = (*ray).origin;
    var hidden = HIDES_EMITTERS != 0u && depth == 0u;
    for (var pass_ = 0u; pass_ < PASSING_MOST; pass_ += 1u) {
        met.rays += 1u;
        let hit = traverse(*ray, false);
        if hit.instance == NONE {
            return met;
        }
        met.surface = surface_at(*ray, hit);
        hidden = hidden && met.surface.light != NONE;
        var meeting = PASSING_STOPS;
        if hidden {
            meeting = PASSING_PASSES;
        } else if HAS_PASSABLE != 0u {
            meeting = passing_meeting(met.surface, s, vec3u(depth, pass_, 1u));
        }
        if HAS_BOUNDARIES != 0u && meeting != PASSING_PASSES {
            let distance = length(met.surface.position - begin);
            met.left *= bodies_transmittance((*bodies).absorption, distance);
        }
        if meeting == PASSING_STOPS {
            met.found = true;
            return met;
        }
        let direction = (*ray).direction;
        if meeting == PASSING_CROSSES {
            passing_cross(bodies, met.surface, direction);
            begin = met.surface.position;
        }
        (*ray).origin = offset_leave(
            met.surface.position, met.surface.error, met.surface.ng, direction);
    }
    return met;
}

/// What the last body leaves of a light. What sees one at infinity is in none that is closed.
fn passing_last_stretch(begin: vec3f, light: LightSample, bodies: Bodies) -> vec3f {
    if HAS_BOUNDARIES == 0u || light.from_infinity != 0u {
        return vec3f(1.0);
    }
    return bodies_transmittance(bodies.absorption, length(light.target_position - begin));
}

/// What is left of a light's radiance on its way to a surface; zero where something stands between them.
///
/// * `within`: what the surface is in, on the light's side.
///
/// Twin: specula-render/src/integrator/passing.rs, PathTracer::shine.
fn passing_shine(
    surface: Surface,
    light: LightSample,
    within: Bodies,
    s: Sequence,
    depth: u32,
    rays: ptr<function, u32>,
) -> vec3f {
    let origin = offset_leave(surface.position, surface.error, surface.ng, light.wi);
    var ray = Ray(origin, light.wi, FARTHEST);
    if light.from_infinity == 0u {
        let other = offset_leave(
            light.target_position, light.target_error, light.target_normal, -light.wi);
        ray = Ray(origin, other - origin, PASSING_TO_LIGHT);
    }
    if HAS_PASSABLE == 0u {
        *rays += 1u;
        if traverse_occluded(ray) {
            return vec3f(0.0);
        }
        return passing_last_stretch(surface.position, light, within);
    }
    var bodies = within;
    var begin = surface.position;
    var left = vec3f(1.0);
    for (var pass_ = 0u; pass_ < PASSING_MOST; pass_ += 1u) {
        *rays += 1u;
        let hit = traverse(ray, false);
        if hit.instance == NONE {
            return left * passing_last_stretch(begin, light, bodies);
        }
        let there = surface_at(ray, hit);
        let meeting = passing_meeting(there, s, vec3u(depth, pass_, 2u));
        if meeting == PASSING_STOPS {
            return vec3f(0.0);
        }
        if meeting == PASSING_CROSSES {
            let distance = length(there.position - begin);
            left *= bodies_transmittance(bodies.absorption, distance);
            passing_cross(&bodies, there, ray.direction);
            begin = there.position;
        }
        ray.origin = offset_leave(there.position, there.error, there.ng, ray.direction);
        ray.t_max -= hit.t;
        if ray.t_max <= 0.0 {
            return left * passing_last_stretch(begin, light, bodies);
        }
    }
    return vec3f(0.0);
}
