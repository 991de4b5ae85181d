// Heitz, Hanika, d'Eon and Dachsbacher 2016, Multiple-Scattering Microfacet BSDFs with the Smith
// Model: a random walk over directions and heights. The ground truth of the other models.
//
// The paper samples the next height from the distribution `C1` (uniform or Gaussian). In the depth
// `tau = -ln C1(h)` that reads, whatever `C1` is,
//
//     down:  tau += E / (1 + Lambda(-d)),     E = -ln U
//     up:    tau -= E / Lambda(d),            below 0: the ray has left
//     leaves along wi with probability C1(h)^Lambda(wi) = exp(-tau Lambda(wi))
//
// so no height is ever needed; for the uniform distribution it is `h = 2 exp(-tau) - 1`. The walk
// scatters by the phase function, `p(d, d') = F D(h) / (4 sigma(-d))`, and connects to `wi` at every
// collision.
//
// Departures: rays start at `C1 = 1` (the released code: 0.999); the term of one bounce may be taken
// in closed form, which lowers the variance by 1 to 2 %.
//
// Known limitation, the model's: the variance of a connection diverges (as a logarithm) for `wi` along
// the normal.

import package::bsdf::bsdf_sample::{BSDF_SAMPLE_VALID, BsdfSample, bsdf_sample_none};
import package::math::stream::{StreamState, stream_next};
import package::multibounce::walk::{WalkFacets, WalkFlight, WALK_MAX_BOUNCES, walk_arriving, walk_bounce, walk_connection, walk_flight, walk_is_upward, walk_pair, walk_single};

/// `-ln U / rate`.
///
/// Twin: specula-bsdf/src/multibounce/heitz2016.rs, step.
fn heitz2016_step(rate: f32, stream: ptr<function, StreamState>) -> f32 {
    return -log(1.0 - stream_next(stream)) / rate;
}

/// The depth after a flight from the depth `tau`; below 0 where it leaves.
///
/// Twin: specula-bsdf/src/multibounce/heitz2016.rs, eval.
fn heitz2016_depth(tau: f32, flight: WalkFlight, stream: ptr<function, StreamState>) -> f32 {
    let s = heitz2016_step(flight.rate, stream);
    return tau + select(s, -s, walk_is_upward(flight));
}

/// An estimate of `f cos`; `wi.z > 0`.
///
/// * `separate`: one bounce in closed form; else as published.
///
/// Twin: specula-bsdf/src/multibounce/heitz2016.rs, eval.
fn heitz2016_eval(
    facets: WalkFacets,
    separate: bool,
    wo: vec3f,
    wi: vec3f,
    stream: ptr<function, StreamState>,
) -> vec3f {
    var flight = walk_arriving(facets, wo);
    let leaving = walk_flight(facets.normals, wi);
    var sum = vec3f(0.0);
    if separate {
        sum = walk_single(facets, flight, leaving);
    }
    var weight = vec3f(1.0);
    var tau = heitz2016_step(flight.rate, stream);
    for (var bounce = 0u; bounce < WALK_MAX_BOUNCES; bounce++) {
        if bounce > 0u || !separate {
            let met = walk_connection(facets, flight.d, leaving.d);
            let leaves = exp(-(tau * leaving.rate));
            sum += weight * met.fresnel * (met.quarter_d / flight.facing * leaves);
        }
        let met = walk_bounce(facets, flight.d, walk_pair(stream));
        weight *= met.fresnel;
        flight = met.next;
        tau = heitz2016_depth(tau, flight, stream);
        if tau < 0.0 {
            break;
        }
    }
    return sum;
}

/// A direction and its weight, the product of Fresnel terms; none for the walk that did not leave
/// within `WALK_MAX_BOUNCES`. Its own density is not known: `pdf` is 0.
///
/// * `u`: samples the first facet.
///
/// Twin: specula-bsdf/src/multibounce/heitz2016.rs, sample.
fn heitz2016_sample(
    facets: WalkFacets,
    wo: vec3f,
    u: vec2f,
    stream: ptr<function, StreamState>,
) -> BsdfSample {
    var flight = walk_arriving(facets, wo);
    var weight = vec3f(1.0);
    var tau = heitz2016_step(flight.rate, stream);
    var next = u;
    for (var bounce = 0u; bounce < WALK_MAX_BOUNCES; bounce++) {
        let met = walk_bounce(facets, flight.d, next);
        weight *= met.fresnel;
        flight = met.next;
        tau = heitz2016_depth(tau, flight, stream);
        if tau < 0.0 {
            return BsdfSample(flight.d, 0.0, weight, 1.0, BSDF_SAMPLE_VALID);
        }
        next = walk_pair(stream);
    }
    return bsdf_sample_none();
}
