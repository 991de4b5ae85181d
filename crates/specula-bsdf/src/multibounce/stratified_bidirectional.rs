//! Stratified bidirectional walks: from both ends over the depth state without cancellation.
//!
//! Light that met one facet is in closed form. All that met `k >= 2` is estimated by walks of
//! directions, from `wo` and, `f` being reciprocal, from `wi`. After each bounce a walk connects
//! to the other end:
//!
//! ```text
//! C_k = W  F D(h) / (4 sigma(-d))  exit(Lambda_i)            W: product of F and 1 / roulette
//! ```
//!
//! with the mass that leaves, `exit`, of [`DepthState`]. As `exit` holds the
//! factor `|Lambda(d)| = sigma(-d) / |d_z|` of an upward `d` exactly, this is `D / (4 |d_z|) S` of
//! Cui et al. 2023, bounded for every `d`; the variance of walks that leave first and connect then
//! (Heitz 2016, Bitterli and d'Eon 2022) diverges for `wi` along the normal.
//!
//! The same path `d_0 .. d_k` is sampled from the other end with a density whose quotient by this
//! one is (all facets but the ends' are shared)
//!
//! ```text
//! R_k = D(h_{k-1}) / D(h_0)  prod_{i=0}^{k-2} sigma(-d_i) / prod_{i=2}^{k} sigma(d_i)
//! ```
//!
//! so that the balance heuristic costs one multiplication a bounce: `C_k / (1 + R_k)` from each
//! end. The first bounces of both ends are stratified over [`SPLIT`] points each. Walks go on with
//! probability `min(1, W mass / CARRIED)`: what they can still contribute.
//!
//! Chosen by measurement: variance times time over that of Heitz 2016, at alpha 0.5 / 1, F = 1:
//!
//! | ends | first bounces of each | roulette | |
//! |---|---|---|---|
//! | one | 1 | 0.7 a bounce after the second | 1.33 / 0.84 |
//! | one | 1 | carried mass | 0.68 / 0.49 |
//! | one | 2 | carried mass | 0.37 / 0.22 |
//! | both | 1 | carried mass | 0.42 / 0.65 |
//! | both | 2 | carried mass | 0.22 / 0.24 (this one) |
//! | both | 4 | carried mass, from 0.25 | 0.12 / 0.20, at twice the time |
//!
//! Dielectrics: on the side of `wo` a walk needs no height. Light that met one facet is in closed
//! form (refraction too, by the Beta function of its masking). Once a walk refracts, its depth is
//! sampled from the state, and it goes on with heights as in Heitz et al. 2016: the depths of the two
//! sides, `-ln C` and `-ln(1 - C)`, have no common exponential form. Walks start at one end, chosen
//! by the angles (`is_better_end`): those from the other end connect to it at grazing angles, which
//! is rare and pays much. What it gains is in the text of [`Dielectric`](crate::bsdf::MultibounceDielectric).
//!
//! Samples leave with exactly the mass that leaves: their weight is the product of Fresnel terms.

use super::heitz2016;
use super::interface::{Collision, Interface, Next, depth_beyond, turned};
use super::state::DepthState;
use super::walk::{Facets, Flight, LEAST_COS, MAX_BOUNCES};
use crate::math::{Real, Rgb, Stream, Vec3};
use crate::vndf::VisibleNormals;

/// First bounces from each end.
pub(crate) const SPLIT: usize = 2;
/// Carried energy below which roulette begins; each walk starts with `1 / SPLIT`.
const CARRIED: f64 = 0.5;

/// An estimate of `f cos`; `wi.z > 0`.
#[inline]
pub(crate) fn eval<T: Real, N: VisibleNormals<T>>(
    facets: &Facets<T, N>,
    wo: Vec3<T>,
    wi: Vec3<T>,
    stream: &mut Stream,
) -> Rgb<T> {
    let arriving = facets.arriving(wo);
    let leaving = Flight::new(&facets.ndf, wi);
    let mut sum = facets.single(&arriving, &leaving);
    let shift = [stream.next::<T>(), stream.next::<T>()];
    if wo.z > T::ZERO {
        // By the cosines that the rates are of: else the flight back outweighs its density.
        let least = T::of(LEAST_COS);
        let back = wi.z.at_least(least) / wo.z.at_least(least);
        let (from_wi, to_wo) = (leaving.reversed(), arriving.reversed());
        for k in 0..SPLIT {
            let u = stratum(shift, k);
            sum += walk::<T, N, true>(facets, &arriving, &leaving, u, stream);
            sum += walk::<T, N, true>(facets, &from_wi, &to_wo, u, stream) * back;
        }
    } else {
        // Backfacing shading normals have no other end.
        for k in 0..SPLIT {
            let u = stratum(shift, k);
            sum += walk::<T, N, false>(facets, &arriving, &leaving, u, stream);
        }
    }
    sum
}

/// The k-th point of a shifted lattice.
#[inline(always)]
pub(crate) fn stratum<T: Real>(shift: [T; 2], k: usize) -> [T; 2] {
    #[allow(clippy::cast_precision_loss, reason = "a few strata")]
    let offset = T::of(k as f64 / SPLIT as f64);
    shift.map(|x| {
        let x = x + offset;
        T::select(x >= T::ONE, x - T::ONE, x)
    })
}

/// Energy that each walk starts with.
#[inline(always)]
pub(crate) fn share<T: Real>() -> Rgb<T> {
    #[allow(clippy::cast_precision_loss, reason = "a few strata")]
    Rgb::splat(T::of(1.0 / SPLIT as f64))
}

/// The probability of going on, where below 1.
#[inline(always)]
pub(crate) fn goes_on<T: Real>(weight: Rgb<T>, mass: T) -> T {
    weight.max_channel() * mass * T::of(1.0 / CARRIED)
}

/// One walk's estimate of two bounces and more.
///
/// * `BOTH`: weighs with the walks from the other end.
/// * `u`: samples the first facet.
#[inline(always)]
fn walk<T: Real, N: VisibleNormals<T>, const BOTH: bool>(
    facets: &Facets<T, N>,
    arriving: &Flight<T>,
    leaving: &Flight<T>,
    u: [T; 2],
    stream: &mut Stream,
) -> Rgb<T> {
    let start = EvalWalk {
        bounces: 0,
        state: DepthState::new(arriving.rate),
        flight: *arriving,
        weight: share(),
        quotient: T::ZERO,
        sum: Rgb::BLACK,
    };
    start.finish::<N, BOTH>(facets, leaving, u, stream)
}

/// The state of a walk that evaluates: it connects at every bounce.
pub(crate) struct EvalWalk<T> {
    pub(crate) bounces: usize,
    pub(crate) state: DepthState<T>,
    pub(crate) flight: Flight<T>,
    pub(crate) weight: Rgb<T>,
    /// `4 R_k` without the last D.
    pub(crate) quotient: T,
    /// What it has contributed.
    pub(crate) sum: Rgb<T>,
}

impl<T: Real> EvalWalk<T> {
    /// Walks to the end; returns the sum.
    ///
    /// * `BOTH`: weighs with the walks from the other end.
    /// * `u`: samples the next facet.
    #[inline(always)]
    pub(crate) fn finish<N: VisibleNormals<T>, const BOTH: bool>(
        self,
        facets: &Facets<T, N>,
        leaving: &Flight<T>,
        mut u: [T; 2],
        stream: &mut Stream,
    ) -> Rgb<T> {
        let Self {
            bounces,
            mut state,
            mut flight,
            mut weight,
            mut quotient,
            mut sum,
        } = self;
        for bounce in bounces + 1..MAX_BOUNCES {
            let (wm, fresnel, next) = facets.bounce(flight.d, u);
            if BOTH {
                let step = if bounce == 1 {
                    T::of(4.0) / (facets.ndf.d(wm) * leaving.backing)
                } else {
                    quotient / next.backing
                };
                quotient = flight.facing * step;
            }
            flight = next;
            if flight.is_upward() {
                state.up(flight.rate);
            } else if !state.down(flight.rate) {
                break;
            }
            weight *= fresnel;
            let (fresnel, quarter_d) = facets.connection(flight.d, leaving.d);
            let exit = state.exit(leaving.rate);
            let rivals = if BOTH {
                T::ONE + quarter_d * quotient
            } else {
                T::ONE
            };
            sum += weight * fresnel * (quarter_d * exit / (flight.facing * rivals));
            let goes_on = goes_on(weight, state.mass());
            if goes_on < T::ONE {
                if stream.next::<T>() >= goes_on {
                    break;
                }
                weight *= T::ONE / goes_on;
            }
            u = [stream.next(), stream.next()];
        }
        sum
    }
}

/// A direction and its weight; `None` for the walk that did not leave within
/// [`MAX_BOUNCES`].
///
/// * `u`: samples the first facet.
#[inline]
pub(crate) fn sample<T: Real, N: VisibleNormals<T>>(
    facets: &Facets<T, N>,
    wo: Vec3<T>,
    u: [T; 2],
    stream: &mut Stream,
) -> Option<(Vec3<T>, Rgb<T>)> {
    let flight = facets.arriving(wo);
    let start = SampleWalk {
        bounces: 0,
        state: DepthState::new(flight.rate),
        flight,
        weight: Rgb::WHITE,
    };
    start.finish(facets, u, stream)
}

/// The state of a walk that samples: it leaves.
pub(crate) struct SampleWalk<T> {
    pub(crate) bounces: usize,
    pub(crate) state: DepthState<T>,
    pub(crate) flight: Flight<T>,
    pub(crate) weight: Rgb<T>,
}

impl<T: Real> SampleWalk<T> {
    /// Walks to the end.
    ///
    /// * `u`: samples the next facet.
    #[inline(always)]
    pub(crate) fn finish<N: VisibleNormals<T>>(
        self,
        facets: &Facets<T, N>,
        mut u: [T; 2],
        stream: &mut Stream,
    ) -> Option<(Vec3<T>, Rgb<T>)> {
        let Self {
            bounces,
            mut state,
            mut flight,
            mut weight,
        } = self;
        for _ in bounces..MAX_BOUNCES {
            let (_, fresnel, next) = facets.bounce(flight.d, u);
            weight *= fresnel;
            flight = next;
            if flight.is_upward() {
                let leaving = state.up(flight.rate);
                let staying = state.mass();
                if stream.next::<T>() * (leaving + staying) < leaving {
                    return Some((flight.d, weight));
                }
                state.scale(T::ONE / staying);
            } else if !state.down(flight.rate) {
                break;
            }
            u = [stream.next(), stream.next()];
        }
        None
    }
}

/// An estimate of `f |cos|` of a dielectric, for light (no `1/eta^2`), from the better end.
#[inline]
pub(crate) fn eval_interface<T: Real, N: VisibleNormals<T>>(
    interface: &Interface<T, N>,
    wo: Vec3<T>,
    wi: Vec3<T>,
    stream: &mut Stream,
) -> T {
    // Backfacing shading normals have no other end.
    if wo.z <= T::ZERO || is_better_end(interface, wo, wi) {
        return eval_interface_from(interface, wo, wi, stream);
    }
    let least = T::of(LEAST_COS);
    let cosines = wi.z.abs().at_least(least) / wo.z.at_least(least);
    if wi.z > T::ZERO {
        cosines * eval_interface_from(interface, wi, wo, stream)
    } else {
        let eta2 = interface.eta * interface.eta;
        let (there, back) = (turned(wi), turned(wo));
        cosines * eta2 * eval_interface_from(&interface.beyond(), there, back, stream)
    }
}

/// Whether walks that start at `wo` are the better ones: at the more grazing end; of two that are
/// alike, inside on smooth surfaces and outside on rough ones.
#[inline(always)]
fn is_better_end<T: Real, N: VisibleNormals<T>>(
    interface: &Interface<T, N>,
    wo: Vec3<T>,
    wi: Vec3<T>,
) -> bool {
    let (cos_o, cos_i) = (wo.z, wi.z.abs());
    if wi.z > T::ZERO {
        return cos_o <= cos_i;
    }
    let alpha = interface.ndf.alpha();
    let a2 = alpha.x * alpha.y;
    let outside = T::of(1.02) - T::of(0.22) * (a2 * a2).at_most(T::ONE);
    if interface.eta > T::ONE {
        cos_i >= outside * cos_o
    } else {
        cos_o < outside * cos_i
    }
}

/// An estimate of `f |cos|` of a dielectric, for light, by walks from `wo`.
#[inline]
fn eval_interface_from<T: Real, N: VisibleNormals<T>>(
    interface: &Interface<T, N>,
    wo: Vec3<T>,
    wi: Vec3<T>,
    stream: &mut Stream,
) -> T {
    let arriving = Flight::new(&interface.ndf, -wo);
    let reflects = wi.z > T::ZERO;
    let lambda = interface.ndf.lambda_cos(wi) / wi.z.abs().at_least(T::of(LEAST_COS));
    let single = interface.phase(&arriving, wi, reflects);
    let leaves = if single <= T::ZERO {
        T::ZERO
    } else if reflects {
        arriving.rate / (arriving.rate + lambda)
    } else {
        Interface::<T, N>::leaves_beyond(arriving.rate, lambda)
    };
    let mut sum = T::ZERO;
    let shift = [stream.next::<T>(), stream.next::<T>()];
    for k in 0..SPLIT {
        sum += interface_walk(interface, &arriving, wi, lambda, stratum(shift, k), stream);
    }
    #[allow(clippy::cast_precision_loss, reason = "a few strata")]
    let share = T::of(1.0 / SPLIT as f64);
    single * leaves + sum * share
}

/// One walk's estimate of two facets and more.
#[inline]
fn interface_walk<T: Real, N: VisibleNormals<T>>(
    interface: &Interface<T, N>,
    arriving: &Flight<T>,
    wi: Vec3<T>,
    lambda: T,
    mut u: [T; 2],
    stream: &mut Stream,
) -> T {
    let mut state = DepthState::new(arriving.rate);
    let mut flight = *arriving;
    let mut weight = T::ONE;
    let mut sum = T::ZERO;
    for _ in 1..MAX_BOUNCES {
        let (next, crosses) = interface.bounce(flight.d, [stream.next(), u[0], u[1]]);
        if crosses {
            let choice = stream.next();
            let tau = state.sample_depth(choice, || stream.next());
            let at = Collision { flight, tau };
            let moved = heitz2016::after(interface, &at, next, true, stream);
            if let Next::Meets(side, at) = moved {
                let mut beyond = T::ZERO;
                heitz2016::collisions(side, at, stream, |side, at, is_back| {
                    beyond += side.connection(at, if is_back { wi } else { turned(wi) });
                });
                sum += weight * state.mass() * beyond;
            }
            break;
        }
        flight = Flight::new(&interface.ndf, next);
        if flight.is_upward() {
            state.up(flight.rate);
        } else if !state.down(flight.rate) {
            break;
        }
        let reflects = wi.z > T::ZERO;
        let phase = interface.phase(&flight, wi, reflects);
        if phase > T::ZERO {
            let leaving = if reflects {
                state.exit(lambda)
            } else {
                let choice = stream.next();
                let tau = state.sample_depth(choice, || stream.next());
                state.mass() * (-(depth_beyond(tau) * lambda)).exp()
            };
            sum += weight * phase * leaving;
        }
        let goes_on = weight * state.mass() * T::of(1.0 / CARRIED);
        if goes_on < T::ONE {
            if stream.next::<T>() >= goes_on {
                break;
            }
            weight /= goes_on;
        }
        u = [stream.next(), stream.next()];
    }
    sum
}

/// A direction sampled at a dielectric; its weight is 1 (for light).
///
/// * `u`: samples the first facet.
#[inline]
pub(crate) fn sample_interface<T: Real, N: VisibleNormals<T>>(
    interface: &Interface<T, N>,
    wo: Vec3<T>,
    mut u: [T; 3],
    stream: &mut Stream,
) -> Option<Vec3<T>> {
    let mut flight = Flight::new(&interface.ndf, -wo);
    let mut state = DepthState::new(flight.rate);
    for _ in 0..MAX_BOUNCES {
        let (next, crosses) = interface.bounce(flight.d, u);
        if crosses {
            let choice = stream.next();
            let tau = state.sample_depth(choice, || stream.next());
            let at = Collision { flight, tau };
            return match heitz2016::after(interface, &at, next, true, stream) {
                Next::Leaves(d) => Some(turned(d)),
                Next::Meets(side, at) => heitz2016::collisions(side, at, stream, |_, _, _| {})
                    .map(|(d, is_back)| if is_back { d } else { turned(d) }),
            };
        }
        flight = Flight::new(&interface.ndf, next);
        if flight.is_upward() {
            let leaving = state.up(flight.rate);
            let staying = state.mass();
            if stream.next::<T>() * (leaving + staying) < leaving {
                return Some(flight.d);
            }
            state.scale(T::ONE / staying);
        } else if !state.down(flight.rate) {
            break;
        }
        u = [stream.next(), stream.next(), stream.next()];
    }
    None
}
