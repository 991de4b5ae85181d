//! Wang, Jin, Fan, Yang, Holzschuch and Yan 2022, Position-Free Multiple-Bounce Computations for
//! Smith Microfacet BSDFs.
//!
//! Every bounce is taken as independent of those before: with `l = |Lambda(d)|` of the incoming
//! flight and `L = Lambda(d')` of an outgoing upward one, the probability of leaving is
//!
//! ```text
//! height-correlated:    l / (l + L)       every collision as deep as Exp(l)
//! height-uncorrelated:  1 / (1 + L)       G1
//! ```
//!
//! and 0 for a downward one. A path weighs `prod v_i s_i`, `v = F D / (4 |d_z|)`, where the segment
//! terms `s` are these probabilities (the last) or their complements, over `l`.
//!
//! The model's bias is its own: it conserves energy (its furnace is exact) but not the directions,
//! as depths of later collisions are not exponential. Against Heitz 2016 it errs by -20 % to +11 %
//! at alpha 1 up to 60 degrees, and by +180 % at 85 (test `wang_is_biased_as_its_model_says`; example `multibounce_means`). One bounce is exact when correlated, and has the
//! separable `G2` when not. The uncorrelated model is reciprocal; the correlated one, as released,
//! is not (test `means_are_reciprocal`): the reversed flight has another rate.
//!
//! Departures: the released code samples visible normals below the horizon with a routine that is
//! wrong there; Specula's is not. Its constant roulette starts at the third bounce here too.

use super::walk::{Facets, Flight, MAX_BOUNCES};
use crate::math::{Real, Rgb, Stream, Vec3};
use crate::vndf::VisibleNormals;

/// Bounces without roulette.
const SURE: usize = 2;
/// Probability of each bounce beyond.
const GOES_ON: f64 = 0.7;

/// Probability of leaving along a flight of rate `outgoing`.
#[inline(always)]
fn exit<T: Real>(correlated: bool, incoming: T, outgoing: T) -> T {
    let against = T::select(correlated, incoming, T::ONE);
    against / (against + outgoing)
}

/// An estimate of the model's `f cos`; `wi.z > 0`.
#[inline]
pub(crate) fn eval<T: Real, N: VisibleNormals<T>>(
    facets: &Facets<T, N>,
    correlated: bool,
    wo: Vec3<T>,
    wi: Vec3<T>,
    stream: &mut Stream,
) -> Rgb<T> {
    let mut flight = facets.arriving(wo);
    let leaving = Flight::new(&facets.ndf, wi);
    let mut weight = Rgb::WHITE;
    let mut sum = Rgb::BLACK;
    for bounce in 0..MAX_BOUNCES {
        let (fresnel, quarter_d) = facets.connection(flight.d, leaving.d);
        let leaves = exit(correlated, flight.rate, leaving.rate);
        sum += weight * fresnel * (quarter_d / flight.facing * leaves);
        if bounce >= SURE {
            if stream.next::<T>() >= T::of(GOES_ON) {
                break;
            }
            weight *= T::of(1.0 / GOES_ON);
        }
        let (_, fresnel, next) = facets.bounce(flight.d, [stream.next(), stream.next()]);
        weight *= fresnel;
        if next.is_upward() {
            // 1 - exit, without cancellation.
            let against = T::select(correlated, flight.rate, T::ONE);
            weight *= next.rate / (against + next.rate);
        }
        flight = next;
    }
    sum
}

/// A direction and its weight, the product of Fresnel terms.
///
/// * `u`: samples the first facet.
#[inline]
pub(crate) fn sample<T: Real, N: VisibleNormals<T>>(
    facets: &Facets<T, N>,
    correlated: bool,
    wo: Vec3<T>,
    mut u: [T; 2],
    stream: &mut Stream,
) -> Option<(Vec3<T>, Rgb<T>)> {
    let mut flight = facets.arriving(wo);
    let mut weight = Rgb::WHITE;
    for _ in 0..MAX_BOUNCES {
        let (_, fresnel, next) = facets.bounce(flight.d, u);
        weight *= fresnel;
        if next.is_upward() && stream.next::<T>() < exit(correlated, flight.rate, next.rate) {
            return Some((next.d, weight));
        }
        flight = next;
        u = [stream.next(), stream.next()];
    }
    None
}
