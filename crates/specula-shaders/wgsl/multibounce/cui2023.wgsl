// Cui, Pan, Yang, Zhang, Yan and Wang 2023, Multiple-bounce Smith Microfacet BRDFs using the Invariance
// Principle: unidirectional and bidirectional estimators.
//
// A path `d_0 .. d_k` weighs `prod v_i S_k` with `v = F D / (4 |d_z|)` and the segment term of the
// whole path (eq. 14):
//
//     S_1 = 1 / (|Lambda_0| + Lambda_1)
//     S_k = (S(0..k-1) + S(1..k)) / (|Lambda_0| + Lambda_k),    0 unless d_0 goes down and d_k up
//
// Departures: `S_k` times the product of the path's rates is the `state_exit` of module `state`, and is
// taken from it: the tables e, g, l of the paper's algorithm 1 (which the Rust follows) overflow or
// underflow near grazing angles even in f64, which WGSL does not have. A walk still ends where those
// tables would be full.
//
// Corrected here (the publication against its own derivation, by tests of the Rust):
// * algorithm 2: the exit probability is `G1 = 1 / (1 + Lambda)`, not `1 / |Lambda|`, and the bounce
//   is counted before its direction is used;
// * algorithm 3: roulette of `q = clamp(S_k, 0.3, 0.95)` costs up to five times the variance of a
//   fixed `q = 0.7`, which is used; the weight is multiplied by `v(d_k, d_{k+1}) / p_k` once
//   `d_{k+1}` exists;
// * the released bidirectional code drops pairs whose densities are below 1e-4 (-4 % of energy) and
//   clamps cosines above 0.9999; neither is needed with the densities in closed form.

import package::bsdf::bsdf_sample::{BSDF_SAMPLE_VALID, BsdfSample, bsdf_sample_none};
import package::math::stream::{StreamState, stream_next};
import package::multibounce::normals::{normals_d};
import package::multibounce::state::{StateDepth, state_down, state_exit, state_new, state_scale, state_up};
import package::multibounce::walk::{WalkFacets, WalkFlight, WALK_MAX_BOUNCES, walk_arriving, walk_bounce, walk_connection, walk_flight, walk_is_upward, walk_pair, walk_reversed, walk_single};

/// Downward flights that the tables hold.
const CUI2023_LAYERS: u32 = 16u;
/// Bounces without roulette.
const CUI2023_SURE: u32 = 2u;
/// Probability of each bounce beyond.
const CUI2023_GOES_ON: f32 = 0.7;
/// Flights that a subpath can hold. Roulette leaves 0.7^10 of the walks that get there, and each end
/// covers for the other.
const CUI2023_SUBPATH: u32 = 12u;
/// A finite cap: an infinite quotient times the roulette's 0 would be NaN.
const CUI2023_CAP: f32 = 1e30;

/// An estimate of `f cos` from one end; `wi.z > 0`.
///
/// Twin: specula-bsdf/src/multibounce/cui2023.rs, eval.
fn cui2023_eval(facets: WalkFacets, wo: vec3f, wi: vec3f, stream: ptr<function, StreamState>) -> vec3f {
    var flight = walk_arriving(facets, wo);
    let leaving = walk_flight(facets.normals, wi);
    var state = state_new(flight.rate);
    var weight = vec3f(1.0);
    var sum = vec3f(0.0);
    for (var bounce = 0u; bounce < WALK_MAX_BOUNCES; bounce++) {
        // v / p = F |Lambda(d)|, and of the last v: 1 / |d_z| = |Lambda(d)| / sigma(-d).
        let end = walk_connection(facets, flight.d, leaving.d);
        let segment = state_exit(&state, leaving.rate);
        sum += weight * end.fresnel * (end.quarter_d / flight.facing * segment);
        if bounce >= CUI2023_SURE {
            if stream_next(stream) >= CUI2023_GOES_ON {
                break;
            }
            weight *= 1.0 / CUI2023_GOES_ON;
        }
        let met = walk_bounce(facets, flight.d, walk_pair(stream));
        weight *= met.fresnel;
        flight = met.next;
        if walk_is_upward(flight) {
            state_up(&state, flight.rate);
        } else {
            if state.layers >= CUI2023_LAYERS {
                break;
            }
            state_down(&state, flight.rate);
        }
    }
    return sum;
}

/// A direction and its weight: leaves with probability `G1`, whatever came before, and makes up for it
/// (algorithm 2). Its own density is not known: `pdf` is 0.
///
/// * `u`: samples the first facet.
///
/// Twin: specula-bsdf/src/multibounce/cui2023.rs, sample.
fn cui2023_sample(facets: WalkFacets, wo: vec3f, u: vec2f, stream: ptr<function, StreamState>) -> BsdfSample {
    var flight = walk_arriving(facets, wo);
    var state = state_new(flight.rate);
    var weight = vec3f(1.0);
    var next = u;
    for (var bounce = 0u; bounce < WALK_MAX_BOUNCES; bounce++) {
        let met = walk_bounce(facets, flight.d, next);
        weight *= met.fresnel;
        flight = met.next;
        if walk_is_upward(flight) {
            // prod |Lambda| S_k over the probability of this path.
            let masking = 1.0 / (1.0 + flight.rate);
            let leaving = state_up(&state, flight.rate);
            if stream_next(stream) < masking {
                return BsdfSample(flight.d, 0.0, weight * (leaving / masking), 1.0, BSDF_SAMPLE_VALID);
            }
            state_scale(&state, 1.0 / (1.0 - masking));
        } else if !state_down(&state, flight.rate) {
            break;
        }
        next = walk_pair(stream);
    }
    return bsdf_sample_none();
}

/// Flights of one end's walk.
///
/// Twin: specula-bsdf/src/multibounce/cui2023.rs, Subpath.
struct Cui2023Subpath {
    /// The first is the given one.
    flights: array<WalkFlight, CUI2023_SUBPATH>,
    /// Fresnel terms and roulette up to each flight.
    weights: array<vec3f, CUI2023_SUBPATH>,
    /// `D / 4` of the facet that each flight left.
    quarter_d: array<f32, CUI2023_SUBPATH>,
    /// How many flights, at least 1.
    count: u32,
}

/// A walk from one end.
///
/// * `path`: zero; filled in place, since nvcc 13.0 compiles a returned one wrongly.
///
/// Twin: specula-bsdf/src/multibounce/cui2023.rs, Subpath::sample.
fn cui2023_subpath(
    path: ptr<function, Cui2023Subpath>,
    facets: WalkFacets,
    start: WalkFlight,
    stream: ptr<function, StreamState>,
) {
    (*path).flights[0] = start;
    (*path).weights[0] = vec3f(1.0);
    (*path).count = 1u;
    while (*path).count < CUI2023_SUBPATH {
        let count = (*path).count;
        var weight = (*path).weights[count - 1u];
        if count > CUI2023_SURE {
            if stream_next(stream) >= CUI2023_GOES_ON {
                break;
            }
            weight *= 1.0 / CUI2023_GOES_ON;
        }
        let met = walk_bounce(facets, (*path).flights[count - 1u].d, walk_pair(stream));
        (*path).flights[count] = met.next;
        (*path).weights[count] = weight * met.fresnel;
        (*path).quarter_d[count] = 0.25 * normals_d(facets.normals, met.wm);
        (*path).count = count + 1u;
    }
}

/// An estimate of `f cos` from both ends; both directions above the horizon.
///
/// Flights `e_0 .. e_s` of the walk from `wo` and `r_t .. r_0` of that from `wi` meet at one facet: a
/// path of `s + t + 1` bounces. Balance heuristic over all ways of splitting it.
///
/// Twin: specula-bsdf/src/multibounce/cui2023.rs, eval_bidirectional.
fn cui2023_eval_bidirectional(
    facets: WalkFacets,
    wo: vec3f,
    wi: vec3f,
    stream: ptr<function, StreamState>,
) -> vec3f {
    let arriving = walk_arriving(facets, wo);
    let leaving = walk_flight(facets.normals, wi);
    var eye: Cui2023Subpath;
    var light: Cui2023Subpath;
    cui2023_subpath(&eye, facets, arriving, stream);
    cui2023_subpath(&light, facets, walk_reversed(leaving), stream);
    var sum = walk_single(facets, arriving, leaving);
    for (var s = 0u; s < eye.count; s++) {
        for (var t = select(0u, 1u, s == 0u); t < light.count; t++) {
            let end = walk_connection(facets, eye.flights[s].d, -light.flights[t].d);
            if end.quarter_d <= 0.0 {
                continue;
            }
            let throughput = eye.weights[s] * light.weights[t] * end.fresnel;
            let rivals = cui2023_rivals(&eye, &light, s, t, end.quarter_d);
            let density = cui2023_path_over_density(&eye, &light, s, t, leaving.rate);
            sum += throughput * (end.quarter_d * density / rivals);
        }
    }
    return sum;
}

/// `prod D / (4 |d_z|) S` over the density of both subpaths, without the connecting `D / 4`.
///
/// Twin: specula-bsdf/src/multibounce/cui2023.rs, path_over_density.
fn cui2023_path_over_density(
    eye: ptr<function, Cui2023Subpath>,
    light: ptr<function, Cui2023Subpath>,
    s: u32,
    t: u32,
    exit_rate: f32,
) -> f32 {
    var state = state_new((*eye).flights[0].rate);
    // The state has the factor prod |Lambda(d_i)|, i < k. The walk from wi sampled with sigma(d_i), i > s + 1.
    var factor = 1.0 / (*eye).flights[s].facing;
    // It has room for the flights of both subpaths: state_down does not fail.
    for (var j = 1u; j <= s; j++) {
        cui2023_fly(&state, (*eye).flights[j]);
    }
    for (var j = t; j >= 1u; j--) {
        let flight = (*light).flights[j];
        cui2023_fly(&state, walk_reversed(flight));
        factor *= 1.0 / flight.backing;
    }
    for (var j = 0u; j < t; j++) {
        factor *= (*light).flights[j].facing;
    }
    return state_exit(&state, exit_rate) * factor;
}

/// The state after a flight.
///
/// Twin: specula-bsdf/src/multibounce/cui2023.rs, path_over_density.
fn cui2023_fly(state: ptr<function, StateDepth>, flight: WalkFlight) {
    if walk_is_upward(flight) {
        state_up(state, flight.rate);
    } else {
        state_down(state, flight.rate);
    }
}

/// Sum of the densities of all ways to split the path, over that of this one.
///
/// With the path's flights `d_0 .. d_k` and facets `h_0 .. h_{k-1}`, moving the connection from `h_i`
/// to `h_{i+1}` multiplies the density by `D(h_i) / sigma(-d_i)  sigma(d_{i+2}) / D(h_{i+1})`.
///
/// Twin: specula-bsdf/src/multibounce/cui2023.rs, rivals.
fn cui2023_rivals(
    eye: ptr<function, Cui2023Subpath>,
    light: ptr<function, Cui2023Subpath>,
    s: u32,
    t: u32,
    quarter_d: f32,
) -> f32 {
    // Towards wi: the facets that the light's walk sampled, from its last. Then towards wo.
    let towards_wi = cui2023_rivals_along(light, t, (*eye).flights[s].facing, s + t, quarter_d);
    let towards_wo = cui2023_rivals_along(eye, s, (*light).flights[t].facing, s + t, quarter_d);
    return 1.0 + towards_wi + towards_wo;
}

/// The part of `cui2023_rivals` whose connections lie on one of the subpaths.
///
/// * `last`: its last flight in use; `facing` of the other's last; `bounces` of both.
///
/// Twin: specula-bsdf/src/multibounce/cui2023.rs, rivals.
fn cui2023_rivals_along(
    path: ptr<function, Cui2023Subpath>,
    last: u32,
    facing: f32,
    bounces: u32,
    quarter_d: f32,
) -> f32 {
    var sum = 0.0;
    var quotient = 1.0;
    var here = quarter_d;
    var area = facing;
    for (var j = last; j >= 1u; j--) {
        let next = (*path).quarter_d[j];
        quotient *= here / area * (*path).flights[j - 1u].facing / next;
        quotient = min(quotient, CUI2023_CAP) * cui2023_roulette(bounces - j + 1u);
        quotient /= cui2023_roulette(j);
        sum += quotient;
        here = next;
        area = (*path).flights[j].backing;
    }
    return sum;
}

/// Probability that a subpath makes its `bounce`-th bounce once it has come so far.
///
/// Twin: specula-bsdf/src/multibounce/cui2023.rs, roulette.
fn cui2023_roulette(bounce: u32) -> f32 {
    if bounce <= CUI2023_SURE {
        return 1.0;
    }
    return select(CUI2023_GOES_ON, 0.0, bounce >= CUI2023_SUBPATH);
}
