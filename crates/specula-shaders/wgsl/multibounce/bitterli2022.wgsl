// Bitterli and d'Eon 2022, A Position-Free Path Integral for Homogeneous Slabs and Multiple
// Scattering on Smith Microfacets: the unidirectional estimator.
//
// Heights are integrated in closed form. The density of the depth of a collision is
// hyperexponential, `sum_j a_j exp(-b_j tau)`:
//
//     start:           a_1 = b_1 = |Lambda_0|
//     down, rate l:    a_j *= l / (l - b_j),  a_{N+1} = -sum_j a_j,  b_{N+1} = l
//     up, rate L:      a_j *= L / (L + b_j)
//     exit, rate L:    p = sum_j a_j / (b_j + L)
//
// A walk goes on after an upward flight with the probability that a facet meets it, and connects with
// `f_p p`.
//
// Departures: the same distribution has the form of `state`, whose values are those of the
// paper but for rounding. The paper's differences of rates need f64 (in which Rust has the
// coefficients) and rates that are moved apart where they meet; WGSL has no f64, and `state` needs
// neither. The paper gives no sampling of directions: that of Heitz 2016 is used.
//
// Known limitation, the model's: as for Heitz 2016, the variance diverges for `wi` along the normal.

import package::math::stream::{StreamState, stream_next};
import package::multibounce::state::{state_down, state_exit, state_mass, state_new, state_scale, state_up};
import package::multibounce::walk::{WalkFacets, WALK_MAX_BOUNCES, walk_arriving, walk_bounce, walk_connection, walk_flight, walk_is_upward, walk_pair};

/// Terms that the density can hold.
const BITTERLI2022_TERMS: u32 = 16u;

/// An estimate of `f cos`; `wi.z > 0`.
///
/// Twin: specula-bsdf/src/multibounce/bitterli2022.rs, eval.
fn bitterli2022_eval(facets: WalkFacets, wo: vec3f, wi: vec3f, stream: ptr<function, StreamState>) -> vec3f {
    var flight = walk_arriving(facets, wo);
    let leaving = walk_flight(facets.normals, wi);
    var heights = state_new(flight.rate);
    var weight = vec3f(1.0);
    var sum = vec3f(0.0);
    for (var bounce = 0u; bounce < WALK_MAX_BOUNCES; bounce++) {
        let end = walk_connection(facets, flight.d, leaving.d);
        let leaves = state_exit(&heights, leaving.rate);
        sum += weight * end.fresnel * (end.quarter_d / flight.facing * leaves);
        let met = walk_bounce(facets, flight.d, walk_pair(stream));
        weight *= met.fresnel;
        flight = met.next;
        if walk_is_upward(flight) {
            state_up(&heights, flight.rate);
            let staying = state_mass(&heights);
            if stream_next(stream) >= staying {
                break;
            }
            state_scale(&heights, 1.0 / staying);
        } else {
            if heights.layers >= BITTERLI2022_TERMS {
                break;
            }
            state_down(&heights, flight.rate);
        }
    }
    return sum;
}
