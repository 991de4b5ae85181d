// Wang, Jin, Fan, Yang, Holzschuch and Yan 2022, Position-Free Multiple-Bounce Computations for Smith
// Microfacet BSDFs.
//
// Every bounce is taken as independent of those before: with `l = |Lambda(d)|` of the incoming flight
// and `L = Lambda(d')` of an outgoing upward one, the probability of leaving is
//
//     height-correlated:    l / (l + L)       every collision as deep as Exp(l)
//     height-uncorrelated:  1 / (1 + L)       G1
//
// and 0 for a downward one. A path weighs `prod v_i s_i`, `v = F D / (4 |d_z|)`, where the segment
// terms `s` are these probabilities (the last) or their complements, over `l`.
//
// The model's bias is its own: it conserves energy (its furnace is exact) but not its directions, as depths of later
// collisions are not exponential. Against Heitz 2016 it errs by -20 % to +11 % at alpha 1 up to 60 degrees, and by
// +180 % at 85. One bounce is exact when correlated, and has the separable `G2` when not. The uncorrelated model is
// reciprocal; the correlated one, as released, is not: the reversed flight has another rate.
//
// Departures: the released code samples visible normals below the horizon with a routine that is wrong
// there; Specula's is not. Its constant roulette starts at the third bounce here too.

import package::bsdf::bsdf_sample::{BSDF_SAMPLE_VALID, BsdfSample, bsdf_sample_none};
import package::math::stream::{StreamState, stream_next};
import package::multibounce::walk::{WalkFacets, WALK_MAX_BOUNCES, walk_arriving, walk_bounce, walk_connection, walk_flight, walk_is_upward, walk_pair};

/// Bounces without roulette.
const WANG2022_SURE: u32 = 2u;
/// Probability of each bounce beyond.
const WANG2022_GOES_ON: f32 = 0.7;

/// Probability of leaving along a flight of rate `outgoing`.
///
/// Twin: specula-bsdf/src/multibounce/wang2022.rs, exit.
fn wang2022_leaves(correlated: bool, incoming: f32, outgoing: f32) -> f32 {
    let against = select(1.0, incoming, correlated);
    return against / (against + outgoing);
}

/// An estimate of the model's `f cos`; `wi.z > 0`.
///
/// * `correlated`: masking and shadowing of each bounce are correlated by its height.
///
/// Twin: specula-bsdf/src/multibounce/wang2022.rs, eval.
fn wang2022_eval(
    facets: WalkFacets,
    correlated: bool,
    wo: vec3f,
    wi: vec3f,
    stream: ptr<function, StreamState>,
) -> vec3f {
    var flight = walk_arriving(facets, wo);
    let leaving = walk_flight(facets.normals, wi);
    var weight = vec3f(1.0);
    var sum = vec3f(0.0);
    for (var bounce = 0u; bounce < WALK_MAX_BOUNCES; bounce++) {
        let end = walk_connection(facets, flight.d, leaving.d);
        let leaves = wang2022_leaves(correlated, flight.rate, leaving.rate);
        sum += weight * end.fresnel * (end.quarter_d / flight.facing * leaves);
        if bounce >= WANG2022_SURE {
            if stream_next(stream) >= WANG2022_GOES_ON {
                break;
            }
            weight *= 1.0 / WANG2022_GOES_ON;
        }
        let met = walk_bounce(facets, flight.d, walk_pair(stream));
        weight *= met.fresnel;
        if walk_is_upward(met.next) {
            // 1 - wang_leaves, without cancellation.
            let against = select(1.0, flight.rate, correlated);
            weight *= met.next.rate / (against + met.next.rate);
        }
        flight = met.next;
    }
    return sum;
}

/// A direction and its weight, the product of Fresnel terms. Its own density is not known: `pdf`
/// is 0.
///
/// * `u`: samples the first facet.
///
/// Twin: specula-bsdf/src/multibounce/wang2022.rs, sample.
fn wang2022_sample(
    facets: WalkFacets,
    correlated: bool,
    wo: vec3f,
    u: vec2f,
    stream: ptr<function, StreamState>,
) -> BsdfSample {
    var flight = walk_arriving(facets, wo);
    var weight = vec3f(1.0);
    var next = u;
    for (var bounce = 0u; bounce < WALK_MAX_BOUNCES; bounce++) {
        let met = walk_bounce(facets, flight.d, next);
        weight *= met.fresnel;
        if walk_is_upward(met.next) {
            let leaves = wang2022_leaves(correlated, flight.rate, met.next.rate);
            if stream_next(stream) < leaves {
                return BsdfSample(met.next.d, 0.0, weight, 1.0, BSDF_SAMPLE_VALID);
            }
        }
        flight = met.next;
        next = walk_pair(stream);
    }
    return bsdf_sample_none();
}
