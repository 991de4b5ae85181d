// Stratified bidirectional walks: from both ends over the depth state without cancellation.
//
// Light that met one facet is in closed form. All that met `k >= 2` is estimated by walks of directions,
// from `wo` and, `f` being reciprocal, from `wi`. After each bounce a walk connects to the other end:
//
//     C_k = W  F D(h) / (4 sigma(-d))  exit(Lambda_i)            W: product of F and 1 / roulette
//
// with the mass that leaves, `state_exit`, of `StateDepth`. As it holds the factor
// `|Lambda(d)| = sigma(-d) / |d_z|` of an upward `d` exactly, this is `D / (4 |d_z|) S` of Cui et al.
// 2023, bounded for every `d`; the variance of walks that leave first and connect then (Heitz 2016,
// Bitterli and d'Eon 2022) diverges for `wi` along the normal.
//
// The same path `d_0 .. d_k` is sampled from the other end with a density whose quotient by this one is
// (all facets but the ends' are shared)
//
//     R_k = D(h_{k-1}) / D(h_0)  prod_{i=0}^{k-2} sigma(-d_i) / prod_{i=2}^{k} sigma(d_i)
//
// so that the balance heuristic costs one multiplication a bounce: `C_k / (1 + R_k)` from each end.
// The first bounces of both ends are stratified over `STRATIFIED_BIDIRECTIONAL_SPLIT` points each. Walks go on with
// probability `min(1, W mass / STRATIFIED_BIDIRECTIONAL_CARRIED)`: what they can still contribute.
//
// Samples leave with exactly the mass that leaves: their weight is the product of Fresnel terms.

import package::bsdf::bsdf_sample::{BSDF_SAMPLE_VALID, BsdfSample, bsdf_sample_none};
import package::math::rgb::{rgb_max_channel};
import package::math::stream::{StreamState, stream_next};
import package::multibounce::normals::{normals_d};
import package::multibounce::state::{state_down, state_exit, state_mass, state_new, state_scale, state_up};
import package::multibounce::walk::{WalkFacets, WalkFlight, WALK_MAX_BOUNCES, walk_arriving, walk_bounce, walk_connection, walk_flight, walk_is_upward, walk_pair, walk_reversed, walk_single};

/// First bounces from each end.
const STRATIFIED_BIDIRECTIONAL_SPLIT: u32 = 2u;
/// Carried energy below which roulette begins; each walk starts with `1 / STRATIFIED_BIDIRECTIONAL_SPLIT`.
const STRATIFIED_BIDIRECTIONAL_CARRIED: f32 = 0.5;
/// A floor of divisors.
const STRATIFIED_BIDIRECTIONAL_TINY: f32 = 1e-36;

/// An estimate of `f cos`; `wi.z > 0`.
///
/// Twin: specula-bsdf/src/multibounce/stratified_bidirectional.rs, eval.
fn stratified_bidirectional_eval(facets: WalkFacets, wo: vec3f, wi: vec3f, stream: ptr<function, StreamState>) -> vec3f {
    let arriving = walk_arriving(facets, wo);
    let leaving = walk_flight(facets.normals, wi);
    var sum = walk_single(facets, arriving, leaving);
    let shift = walk_pair(stream);
    // Backfacing shading normals have no other end.
    let both = wo.z > 0.0;
    // By the cosines that the rates are of: else the flight back outweighs its density.
    let back = max(wi.z, 1e-12) / max(wo.z, 1e-12);
    for (var k = 0u; k < STRATIFIED_BIDIRECTIONAL_SPLIT; k++) {
        let u = stratified_bidirectional_stratum(shift, k);
        sum += stratified_bidirectional_walk(facets, both, arriving, leaving, u, stream);
        if both {
            let from_wi = walk_reversed(leaving);
            let to_wo = walk_reversed(arriving);
            sum += stratified_bidirectional_walk(facets, both, from_wi, to_wo, u, stream) * back;
        }
    }
    return sum;
}

/// The k-th point of a shifted lattice.
///
/// Twin: specula-bsdf/src/multibounce/stratified_bidirectional.rs, stratum.
fn stratified_bidirectional_stratum(shift: vec2f, k: u32) -> vec2f {
    let x = shift + f32(k) / f32(STRATIFIED_BIDIRECTIONAL_SPLIT);
    return select(x, x - 1.0, x >= vec2f(1.0));
}

/// The probability of going on, where below 1.
///
/// Twin: specula-bsdf/src/multibounce/stratified_bidirectional.rs, goes_on.
fn stratified_bidirectional_goes_on(weight: vec3f, mass: f32) -> f32 {
    return rgb_max_channel(weight) * mass * (1.0 / STRATIFIED_BIDIRECTIONAL_CARRIED);
}

/// One walk's estimate of two bounces and more.
///
/// * `both`: weighs with the walks from the other end.
/// * `u`: samples the first facet.
///
/// Twin: specula-bsdf/src/multibounce/stratified_bidirectional.rs, EvalWalk::finish.
fn stratified_bidirectional_walk(
    facets: WalkFacets,
    both: bool,
    arriving: WalkFlight,
    leaving: WalkFlight,
    u: vec2f,
    stream: ptr<function, StreamState>,
) -> vec3f {
    var state = state_new(arriving.rate);
    var flight = arriving;
    var weight = vec3f(1.0 / f32(STRATIFIED_BIDIRECTIONAL_SPLIT));
    // 4 R_k without the last D.
    var quotient = 0.0;
    var sum = vec3f(0.0);
    var next = u;
    for (var bounce = 1u; bounce < WALK_MAX_BOUNCES; bounce++) {
        let met = walk_bounce(facets, flight.d, next);
        if both {
            if bounce == 1u {
                let density = normals_d(facets.normals, met.wm) * leaving.backing;
                quotient = flight.facing * (4.0 / max(density, STRATIFIED_BIDIRECTIONAL_TINY));
            } else {
                quotient = flight.facing * (quotient / met.next.backing);
            }
        }
        flight = met.next;
        if walk_is_upward(flight) {
            state_up(&state, flight.rate);
        } else if !state_down(&state, flight.rate) {
            break;
        }
        weight *= met.fresnel;
        let end = walk_connection(facets, flight.d, leaving.d);
        let rivals = select(1.0, 1.0 + end.quarter_d * quotient, both);
        let leaves = state_exit(&state, leaving.rate);
        if end.quarter_d > 0.0 {
            sum += weight * end.fresnel * (end.quarter_d * leaves / (flight.facing * rivals));
        }
        let goes_on = stratified_bidirectional_goes_on(weight, state_mass(&state));
        if goes_on < 1.0 {
            if stream_next(stream) >= goes_on {
                break;
            }
            weight *= 1.0 / goes_on;
        }
        next = walk_pair(stream);
    }
    return sum;
}

/// A direction and its weight; none for the walk that did not leave within `WALK_MAX_BOUNCES`. Its own
/// density is not known: `pdf` is 0.
///
/// * `u`: samples the first facet.
///
/// Twin: specula-bsdf/src/multibounce/stratified_bidirectional.rs, sample.
fn stratified_bidirectional_sample(facets: WalkFacets, wo: vec3f, u: vec2f, stream: ptr<function, StreamState>) -> BsdfSample {
    var flight = walk_arriving(facets, wo);
    var state = state_new(flight.rate);
    var weight = vec3f(1.0);
    var next = u;
    for (var bounce = 0u; bounce < WALK_MAX_BOUNCES; bounce++) {
        let met = walk_bounce(facets, flight.d, next);
        weight *= met.fresnel;
        flight = met.next;
        if walk_is_upward(flight) {
            let leaving = state_up(&state, flight.rate);
            let staying = state_mass(&state);
            if stream_next(stream) * (leaving + staying) < leaving {
                return BsdfSample(flight.d, 0.0, weight, 1.0, BSDF_SAMPLE_VALID);
            }
            state_scale(&state, 1.0 / staying);
        } else if !state_down(&state, flight.rate) {
            break;
        }
        next = walk_pair(stream);
    }
    return bsdf_sample_none();
}
