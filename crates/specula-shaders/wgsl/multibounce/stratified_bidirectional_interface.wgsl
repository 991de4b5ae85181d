// Stratified bidirectional walks at dielectric facets.
//
// On the side of `wo` a walk needs no height. Light that met one facet is in closed form (refraction
// too, by the Beta function of its masking). Once a walk refracts, its depth is sampled from the state, and
// it goes on with heights as in Heitz et al. 2016: the depths of the two sides, `-ln C` and `-ln(1 - C)`,
// have no common exponential form. Walks start at one end, chosen by the angles: those from the other end
// connect to it at grazing angles, which is rare and pays much.

import package::bsdf::bsdf_sample::{BSDF_SAMPLE_VALID, BsdfSample, bsdf_sample_none};
import package::math::stream::{StreamState, stream_next};
import package::multibounce::heitz_interface::{HeitzInterfaceWalk, heitz_interface_collisions, heitz_interface_flown, heitz_interface_left};
import package::multibounce::multibounce_interface::{MultibounceInterfaceCollision, MultibounceInterface, multibounce_interface_beyond, multibounce_interface_bounce, multibounce_interface_depth_beyond, multibounce_interface_lambda, multibounce_interface_leaves_beyond, multibounce_interface_phase, multibounce_interface_turned};
import package::multibounce::stratified_bidirectional::{STRATIFIED_BIDIRECTIONAL_CARRIED, STRATIFIED_BIDIRECTIONAL_SPLIT, stratified_bidirectional_stratum};
import package::multibounce::state::{state_down, state_exit, state_mass, state_new, state_sample_depth, state_scale, state_up};
import package::multibounce::walk::{WalkFlight, WALK_MAX_BOUNCES, walk_flight, walk_is_upward, walk_pair};

/// An estimate of `f |cos|` of a dielectric, for light (no `1/eta^2`), from the better end.
///
/// Twin: specula-bsdf/src/multibounce/stratified_bidirectional.rs, eval_interface.
fn stratified_bidirectional_interface_eval(
    facets: MultibounceInterface,
    wo: vec3f,
    wi: vec3f,
    stream: ptr<function, StreamState>,
) -> f32 {
    // Backfacing shading normals have no other end.
    if wo.z <= 0.0 || stratified_bidirectional_interface_is_better_end(facets, wo, wi) {
        return stratified_bidirectional_interface_eval_end(facets, wo, wi, stream);
    }
    let cosines = max(abs(wi.z), 1e-12) / max(wo.z, 1e-12);
    if wi.z > 0.0 {
        return cosines * stratified_bidirectional_interface_eval_end(facets, wi, wo, stream);
    }
    let there = multibounce_interface_turned(wi);
    let back = multibounce_interface_turned(wo);
    let beyond = multibounce_interface_beyond(facets);
    let squared = facets.eta * facets.eta;
    return cosines * squared * stratified_bidirectional_interface_eval_end(beyond, there, back, stream);
}

/// Whether walks that start at `wo` are the better ones: at the more grazing end; of two that are alike,
/// inside on smooth surfaces and outside on rough ones.
///
/// Twin: specula-bsdf/src/multibounce/stratified_bidirectional.rs, is_better_end.
fn stratified_bidirectional_interface_is_better_end(facets: MultibounceInterface, wo: vec3f, wi: vec3f) -> bool {
    let cos_o = wo.z;
    let cos_i = abs(wi.z);
    if wi.z > 0.0 {
        return cos_o <= cos_i;
    }
    let area = facets.normals.alpha.x * facets.normals.alpha.y;
    let outside = 1.02 - 0.22 * min(area * area, 1.0);
    if facets.eta > 1.0 {
        return cos_i >= outside * cos_o;
    }
    return cos_o < outside * cos_i;
}

/// An estimate of `f |cos|` of a dielectric, for light, by walks from `wo`.
///
/// Twin: specula-bsdf/src/multibounce/stratified_bidirectional.rs, eval_interface_from.
fn stratified_bidirectional_interface_eval_end(
    facets: MultibounceInterface,
    wo: vec3f,
    wi: vec3f,
    stream: ptr<function, StreamState>,
) -> f32 {
    let arriving = walk_flight(facets.normals, -wo);
    let reflects = wi.z > 0.0;
    let lambda = multibounce_interface_lambda(facets, wi);
    let single = multibounce_interface_phase(facets, arriving, wi, reflects);
    var leaves = 0.0;
    if single > 0.0 && reflects {
        leaves = arriving.rate / (arriving.rate + lambda);
    } else if single > 0.0 {
        leaves = multibounce_interface_leaves_beyond(arriving.rate, lambda);
    }
    var sum = 0.0;
    let shift = walk_pair(stream);
    for (var k = 0u; k < STRATIFIED_BIDIRECTIONAL_SPLIT; k++) {
        let u = stratified_bidirectional_stratum(shift, k);
        sum += stratified_bidirectional_interface_walk(facets, arriving, wi, lambda, u, stream);
    }
    return single * leaves + sum * (1.0 / f32(STRATIFIED_BIDIRECTIONAL_SPLIT));
}

/// One walk's estimate of two facets and more.
///
/// * `lambda`: of `wi`; `u`: samples the first facet.
///
/// Twin: specula-bsdf/src/multibounce/stratified_bidirectional.rs, interface_walk.
fn stratified_bidirectional_interface_walk(
    facets: MultibounceInterface,
    arriving: WalkFlight,
    wi: vec3f,
    lambda: f32,
    u: vec2f,
    stream: ptr<function, StreamState>,
) -> f32 {
    var state = state_new(arriving.rate);
    var flight = arriving;
    var weight = 1.0;
    var sum = 0.0;
    var next = u;
    let reflects = wi.z > 0.0;
    for (var bounce = 1u; bounce < WALK_MAX_BOUNCES; bounce++) {
        let way = stream_next(stream);
        let bent = multibounce_interface_bounce(facets, flight.d, vec3f(way, next));
        if bent.crosses {
            let tau = state_sample_depth(&state, stream_next(stream), stream);
            let start = HeitzInterfaceWalk(facets, MultibounceInterfaceCollision(flight, tau), false, false, 0.0);
            var moved = heitz_interface_flown(start, bent.d, true, stream);
            if !moved.has_left {
                moved = heitz_interface_collisions(moved, true, wi, stream);
                sum += weight * state_mass(&state) * moved.sum;
            }
            break;
        }
        flight = walk_flight(facets.normals, bent.d);
        if walk_is_upward(flight) {
            state_up(&state, flight.rate);
        } else if !state_down(&state, flight.rate) {
            break;
        }
        let phase = multibounce_interface_phase(facets, flight, wi, reflects);
        if phase > 0.0 {
            var leaving = 0.0;
            if reflects {
                leaving = state_exit(&state, lambda);
            } else {
                let tau = state_sample_depth(&state, stream_next(stream), stream);
                let depth = multibounce_interface_depth_beyond(tau);
                leaving = state_mass(&state) * exp(-(depth * lambda));
            }
            sum += weight * phase * leaving;
        }
        let goes_on = weight * state_mass(&state) * (1.0 / STRATIFIED_BIDIRECTIONAL_CARRIED);
        if goes_on < 1.0 {
            if stream_next(stream) >= goes_on {
                break;
            }
            weight /= goes_on;
        }
        next = walk_pair(stream);
    }
    return sum;
}

/// A direction sampled at a dielectric; its weight is 1 (for light). Its own density is not known: `pdf`
/// is 0. Transmitted where `wi.z < 0`, whatever the flags.
///
/// * `u`: samples reflection or refraction (x), and the first facet.
///
/// Twin: specula-bsdf/src/multibounce/stratified_bidirectional.rs, sample_interface.
fn stratified_bidirectional_interface_sample(
    facets: MultibounceInterface,
    wo: vec3f,
    u: vec3f,
    stream: ptr<function, StreamState>,
) -> BsdfSample {
    var flight = walk_flight(facets.normals, -wo);
    var state = state_new(flight.rate);
    var next = u;
    for (var bounce = 0u; bounce < WALK_MAX_BOUNCES; bounce++) {
        let bent = multibounce_interface_bounce(facets, flight.d, next);
        if bent.crosses {
            let tau = state_sample_depth(&state, stream_next(stream), stream);
            let start = HeitzInterfaceWalk(facets, MultibounceInterfaceCollision(flight, tau), false, false, 0.0);
            var moved = heitz_interface_flown(start, bent.d, true, stream);
            if !moved.has_left {
                moved = heitz_interface_collisions(moved, false, wo, stream);
            }
            return heitz_interface_left(moved);
        }
        flight = walk_flight(facets.normals, bent.d);
        if walk_is_upward(flight) {
            let leaving = state_up(&state, flight.rate);
            let staying = state_mass(&state);
            if stream_next(stream) * (leaving + staying) < leaving {
                return BsdfSample(flight.d, 0.0, vec3f(1.0), 1.0, BSDF_SAMPLE_VALID);
            }
            state_scale(&state, 1.0 / staying);
        } else if !state_down(&state, flight.rate) {
            break;
        }
        let way = stream_next(stream);
        next = vec3f(way, walk_pair(stream));
    }
    return bsdf_sample_none();
}
