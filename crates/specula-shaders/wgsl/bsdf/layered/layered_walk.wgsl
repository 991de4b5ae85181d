// The random walk between coat and base: its value for two directions, and its samples.
//
// A value adds up what every vertex below the coat sends to the light (`layered_connect`). Light that the
// coat reflects is followed with its reflectance as a factor, never chosen against leaving. A
// sample follows what its surfaces sample, with their weights, until it leaves.

import package::bsdf::bsdf_sample::{BSDF_SAMPLE_SPECULAR, BSDF_SAMPLE_TRANSMISSION, BSDF_SAMPLE_VALID, BsdfSample, BSDF_SAMPLE_IMPORTANCE, BSDF_SAMPLE_RADIANCE, bsdf_sample_none};
import package::bsdf::layered::layered_base::{layered_base_sample, layered_base_is_mirror};
import package::bsdf::layered::layered_coat::{layered_coat_bounce, layered_coat_enter, layered_coat_scatter_above, layered_coat_scatter_below};
import package::bsdf::layered::layered_connect::{LayeredConnectEnds, LayeredConnectVertex, layered_connect_at_base, layered_connect_at_particle, layered_connect_sampled_from_light};
import package::bsdf::layered::layered_lobe::{LAYERED_LOBE_MOST_EVENTS, LayeredLobe, layered_lobe_is_base_narrow};
import package::bsdf::layered::layered_medium::{layered_medium_depth_of_collision, layered_medium_scatters, layered_medium_transmittance, layered_medium_turned};
import package::math::rgb::{rgb_max_channel};
import package::math::stream::{StreamState, stream_next};

/// Walks whose throughput is below this may end, so that those which go on carry as much.
const LAYERED_WALK_ROULETTE_BELOW: f32 = 0.25;
/// A floor of divisors.
const LAYERED_WALK_TINY: f32 = 1.1754944e-38;
/// A flight ends at the base. Twin: specula-bsdf/src/bsdf/layered/walk.rs, End::Base.
const LAYERED_WALK_BASE: u32 = 0u;
/// A flight ends at the coat. Twin: specula-bsdf/src/bsdf/layered/walk.rs, End::Coat.
const LAYERED_WALK_COAT: u32 = 1u;
/// A flight ends at a particle. Twin: specula-bsdf/src/bsdf/layered/walk.rs, End::Particle.
const LAYERED_WALK_PARTICLE: u32 = 2u;

/// A walk below the coat.
///
/// Twin: specula-bsdf/src/bsdf/layered/walk.rs, State.
struct LayeredWalkState {
    /// Direction of travel.
    w: vec3f,
    /// What it carries.
    throughput: vec3f,
    /// Above the base.
    height: f32,
    /// Interfaces and particles met.
    events: u32,
}

/// Flies to the next surface or particle; returns which.
///
/// Twin: specula-bsdf/src/bsdf/layered/walk.rs, State::land.
fn layered_walk_land(
    state: ptr<function, LayeredWalkState>,
    lobe: LayeredLobe,
    stream: ptr<function, StreamState>,
) -> u32 {
    let thickness = lobe.medium.thickness;
    let w = (*state).w;
    let is_up = w.z > 0.0;
    if layered_medium_scatters(lobe.medium) {
        let depth = layered_medium_depth_of_collision(w, stream);
        let height = (*state).height + select(-depth, depth, is_up);
        if height > 0.0 && height < thickness {
            (*state).height = height;
            (*state).throughput *= lobe.medium.albedo;
            return LAYERED_WALK_PARTICLE;
        }
    } else {
        (*state).throughput *= layered_medium_transmittance(thickness, w);
    }
    (*state).height = select(0.0, thickness, is_up);
    return select(LAYERED_WALK_BASE, LAYERED_WALK_COAT, is_up);
}

/// Whether the walk goes on, by Russian roulette.
///
/// Twin: specula-bsdf/src/bsdf/layered/walk.rs, State::survives.
fn layered_walk_survives(state: ptr<function, LayeredWalkState>, stream: ptr<function, StreamState>) -> bool {
    let carried = rgb_max_channel((*state).throughput);
    if carried >= LAYERED_WALK_ROULETTE_BELOW {
        return true;
    }
    let is_alive = stream_next(stream) * LAYERED_WALK_ROULETTE_BELOW < carried;
    (*state).throughput *= LAYERED_WALK_ROULETTE_BELOW / max(carried, LAYERED_WALK_TINY);
    return is_alive;
}

/// An estimate of `f |cos|` without the coat's own reflection.
///
/// Twin: specula-bsdf/src/bsdf/layered/walk.rs, eval.
fn layered_walk_eval(lobe: LayeredLobe, wo: vec3f, wi: vec3f, stream: ptr<function, StreamState>) -> vec3f {
    let start = layered_coat_enter(lobe.coat, wo, BSDF_SAMPLE_IMPORTANCE, stream);
    let is_clear = !layered_medium_scatters(lobe.medium) && lobe.max_depth >= 2u;
    let is_sampled_from_light = layered_lobe_is_base_narrow(lobe) && is_clear;
    let entry = layered_coat_enter(lobe.coat, wi, BSDF_SAMPLE_RADIANCE, stream);
    var ends = LayeredConnectEnds(wo, wi, entry, start.pdf, is_sampled_from_light && start.exists);
    var sum = vec3f(0.0);
    if is_sampled_from_light {
        sum = layered_connect_sampled_from_light(ends, lobe, stream);
    }
    if !start.exists {
        return sum;
    }
    let thickness = lobe.medium.thickness;
    var state = LayeredWalkState(start.w, vec3f(start.weight), thickness, 0u);
    for (var event = 0u; event < LAYERED_LOBE_MOST_EVENTS; event++) {
        // Leaving is an event too.
        if state.events + 1u >= lobe.max_depth {
            break;
        }
        state.events += 1u;
        let end = layered_walk_land(&state, lobe, stream);
        if end == LAYERED_WALK_COAT {
            let next = layered_coat_bounce(lobe.coat, state.w, stream);
            if !next.exists {
                break;
            }
            state.w = next.w;
            state.throughput *= next.weight;
        } else {
            var found: LayeredConnectVertex;
            if end == LAYERED_WALK_BASE {
                found = layered_connect_at_base(ends, lobe, state.w, stream);
            } else {
                let ways = vec2f(state.height, thickness - state.height);
                let left = lobe.max_depth - state.events;
                found = layered_connect_at_particle(ends, lobe, state.w, ways, left, stream);
            }
            sum += state.throughput * found.light;
            if !found.goes_on {
                break;
            }
            state.w = found.w;
            state.throughput *= found.weight;
        }
        ends.is_first = false;
        if state.w.z == 0.0 || !layered_walk_survives(&state, stream) {
            break;
        }
    }
    return sum;
}

/// A sample of the walk; none where nothing leaves. Specular where every surface on the way was smooth. Its
/// own density is not known: `pdf` is 0.
///
/// * `u`: samples what happens at the coat first.
///
/// Twin: specula-bsdf/src/bsdf/layered/walk.rs, sample.
fn layered_walk_sample(lobe: LayeredLobe, wo: vec3f, u: vec3f, stream: ptr<function, StreamState>) -> BsdfSample {
    let first = layered_coat_scatter_above(lobe.coat, wo, u);
    var specular = first.flags & BSDF_SAMPLE_SPECULAR;
    if first.flags == 0u {
        return bsdf_sample_none();
    }
    if (first.flags & BSDF_SAMPLE_TRANSMISSION) == 0u {
        return BsdfSample(first.wi, 0.0, first.weight, 1.0, BSDF_SAMPLE_VALID | specular);
    }
    var state = LayeredWalkState(first.wi, first.weight, lobe.medium.thickness, 0u);
    for (var event = 0u; event < LAYERED_LOBE_MOST_EVENTS; event++) {
        // Leaving is the last event.
        if state.events >= lobe.max_depth {
            break;
        }
        state.events += 1u;
        let end = layered_walk_land(&state, lobe, stream);
        if end == LAYERED_WALK_PARTICLE {
            state.w = layered_medium_turned(lobe.medium, state.w, stream);
            specular = 0u;
        } else if end == LAYERED_WALK_BASE {
            let next = layered_base_sample(lobe.base, -state.w, stream);
            if next.flags == 0u {
                break;
            }
            specular = select(0u, specular, layered_base_is_mirror(lobe.base));
            state.w = next.wi;
            state.throughput *= next.weight;
        } else {
            let next = layered_coat_scatter_below(lobe.coat, state.w, stream);
            if next.flags == 0u {
                break;
            }
            state.throughput *= next.weight;
            state.w = next.wi;
            if (next.flags & BSDF_SAMPLE_TRANSMISSION) != 0u {
                return BsdfSample(state.w, 0.0, state.throughput, 1.0, BSDF_SAMPLE_VALID | specular);
            }
        }
        if state.w.z == 0.0 || !layered_walk_survives(&state, stream) {
            break;
        }
    }
    return bsdf_sample_none();
}
