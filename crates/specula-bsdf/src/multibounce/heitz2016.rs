//! Heitz, Hanika, d'Eon and Dachsbacher 2016, Multiple-Scattering Microfacet BSDFs with the Smith
//! Model: a random walk over directions and heights. The ground truth of the other models.
//!
//! The paper samples the next height from the distribution `C1` (uniform or Gaussian). In the depth `tau = -ln C1(h)` that reads, whatever `C1` is,
//!
//! ```text
//! down:  tau += E / (1 + Lambda(-d)),     E = -ln U
//! up:    tau -= E / Lambda(d),            below 0: the ray has left
//! leaves along wi with probability C1(h)^Lambda(wi) = exp(-tau Lambda(wi))
//! ```
//!
//! so no height is ever needed; for the uniform distribution it is `h = 2 exp(-tau) - 1`. The walk
//! scatters by the phase function, `p(d, d') = F D(h) / (4 sigma(-d))`, and connects to `wi` at
//! every collision.
//!
//! Departures: rays start at `C1 = 1` (the released code: 0.999); the term of one bounce may be
//! taken in closed form, which lowers the variance by 1 to 2 %.
//!
//! Dielectric facets reflect with probability F or refract into the other side (`interface`);
//! diffuse facets scatter about a visible normal.
//!
//! Known limitation, the model's: the variance of a connection diverges (as a logarithm) for `wi`
//! along the normal.

use super::interface::{Collision, Interface, Next, depth_beyond, turned};
use super::walk::{Facets, Flight, MAX_BOUNCES};
use crate::math::{Frame, Real, Rgb, Stream, Vec3, warp};
use crate::vndf::VisibleNormals;

/// `-ln U / rate`.
#[inline(always)]
pub(crate) fn step<T: Real>(rate: T, stream: &mut Stream) -> T {
    -(T::ONE - stream.next::<T>()).ln() / rate
}

/// An estimate of `f cos`; `wi.z > 0`.
///
/// * `SEPARATE`: one bounce in closed form; else as published.
#[inline]
pub(crate) fn eval<T: Real, N: VisibleNormals<T>, const SEPARATE: bool>(
    facets: &Facets<T, N>,
    wo: Vec3<T>,
    wi: Vec3<T>,
    stream: &mut Stream,
) -> Rgb<T> {
    let mut flight = facets.arriving(wo);
    let leaving = Flight::new(&facets.ndf, wi);
    let mut sum = if SEPARATE {
        facets.single(&flight, &leaving)
    } else {
        Rgb::BLACK
    };
    let mut weight = Rgb::WHITE;
    let mut tau = step(flight.rate, stream);
    for bounce in 0..MAX_BOUNCES {
        if bounce > 0 || !SEPARATE {
            let (fresnel, quarter_d) = facets.connection(flight.d, leaving.d);
            let exit = (-(tau * leaving.rate)).exp();
            sum += weight * fresnel * (quarter_d / flight.facing * exit);
        }
        let (_, fresnel, next) = facets.bounce(flight.d, [stream.next(), stream.next()]);
        weight *= fresnel;
        flight = next;
        let s = step(flight.rate, stream);
        tau = if flight.is_upward() { tau - s } else { tau + s };
        if tau < T::ZERO {
            break;
        }
    }
    sum
}

/// A direction and its weight, the product of Fresnel terms; `None` for the walk that did not
/// leave within [`MAX_BOUNCES`].
///
/// * `u`: samples the first facet.
#[inline]
pub(crate) fn sample<T: Real, N: VisibleNormals<T>>(
    facets: &Facets<T, N>,
    wo: Vec3<T>,
    mut u: [T; 2],
    stream: &mut Stream,
) -> Option<(Vec3<T>, Rgb<T>)> {
    let mut flight = facets.arriving(wo);
    let mut weight = Rgb::WHITE;
    let mut tau = step(flight.rate, stream);
    for _ in 0..MAX_BOUNCES {
        let (_, fresnel, next) = facets.bounce(flight.d, u);
        weight *= fresnel;
        flight = next;
        let s = step(flight.rate, stream);
        tau = if flight.is_upward() { tau - s } else { tau + s };
        if tau < T::ZERO {
            return Some((flight.d, weight));
        }
        u = [stream.next(), stream.next()];
    }
    None
}

/// An estimate of `f |cos|` of a dielectric, for light (no `1/eta^2`).
#[inline]
pub(crate) fn eval_interface<T: Real, N: VisibleNormals<T>>(
    interface: &Interface<T, N>,
    wo: Vec3<T>,
    wi: Vec3<T>,
    stream: &mut Stream,
) -> T {
    let flight = Flight::new(&interface.ndf, -wo);
    let tau = step(flight.rate, stream);
    let mut sum = T::ZERO;
    let start = Collision { flight, tau };
    collisions(*interface, start, stream, |side, at, is_beyond| {
        sum += side.connection(at, if is_beyond { turned(wi) } else { wi });
    });
    sum
}

/// A direction sampled at a dielectric; its weight is 1 (for light).
///
/// * `u`: samples the first facet.
#[inline]
pub(crate) fn sample_interface<T: Real, N: VisibleNormals<T>>(
    interface: &Interface<T, N>,
    wo: Vec3<T>,
    u: [T; 3],
    stream: &mut Stream,
) -> Option<Vec3<T>> {
    let flight = Flight::new(&interface.ndf, -wo);
    let tau = step(flight.rate, stream);
    let (next, crosses) = interface.bounce(flight.d, u);
    let at = Collision { flight, tau };
    match after(interface, &at, next, crosses, stream) {
        Next::Meets(side, at) => collisions(side, at, stream, |_, _, _| {})
            .map(|(d, is_beyond)| if is_beyond != crosses { turned(d) } else { d }),
        Next::Leaves(d) => Some(if crosses { turned(d) } else { d }),
    }
}

/// Walks through all collisions from one on; `visit` is told each, with its side and whether that
/// is beyond the first one's. Returns the direction of leaving in the frame of its side, and
/// whether that is beyond.
#[inline]
pub(crate) fn collisions<T: Real, N: VisibleNormals<T>>(
    interface: Interface<T, N>,
    start: Collision<T>,
    stream: &mut Stream,
    mut visit: impl FnMut(&Interface<T, N>, &Collision<T>, bool),
) -> Option<(Vec3<T>, bool)> {
    let (mut side, mut at, mut is_beyond) = (interface, start, false);
    for _ in 0..MAX_BOUNCES {
        visit(&side, &at, is_beyond);
        let u = [stream.next(), stream.next(), stream.next()];
        let (next, crosses) = side.bounce(at.flight.d, u);
        is_beyond = is_beyond != crosses;
        match after(&side, &at, next, crosses, stream) {
            Next::Meets(there, then) => (side, at) = (there, then),
            Next::Leaves(d) => return Some((d, is_beyond)),
        }
    }
    None
}

/// The next collision, or the direction of leaving.
#[inline]
pub(crate) fn after<T: Real, N: VisibleNormals<T>>(
    side: &Interface<T, N>,
    at: &Collision<T>,
    next: Vec3<T>,
    crosses: bool,
    stream: &mut Stream,
) -> Next<T, N> {
    let flight = Flight::new(&side.ndf, next);
    let depth = if crosses {
        depth_beyond(at.tau)
    } else {
        at.tau
    };
    let s = step(flight.rate, stream);
    let tau = if flight.is_upward() {
        depth - s
    } else {
        depth + s
    };
    if tau < T::ZERO {
        return Next::Leaves(flight.d);
    }
    let side = if crosses { side.beyond() } else { *side };
    Next::Meets(side, Collision { flight, tau })
}

/// An estimate of `f cos` of facets that reflect diffusely:
/// `p(d, d') = albedo int D_visible(wm) max(wm . d', 0) / pi dwm`, one normal for each collision.
#[inline]
pub(crate) fn eval_diffuse<T: Real, N: VisibleNormals<T>>(
    ndf: &N,
    albedo: Rgb<T>,
    wo: Vec3<T>,
    wi: Vec3<T>,
    stream: &mut Stream,
) -> Rgb<T> {
    let leaving = Flight::new(ndf, wi);
    let mut sum = Rgb::BLACK;
    diffuse_walk(ndf, albedo, wo, None, stream, |weight, wm, tau| {
        let cos = wm.dot(wi).at_least(T::ZERO);
        sum += weight * (cos * T::INV_PI * (-(tau * leaving.rate)).exp());
    });
    sum
}

/// A direction sampled at facets that reflect diffusely, and its weight.
///
/// * `u`: samples the first facet.
#[inline]
pub(crate) fn sample_diffuse<T: Real, N: VisibleNormals<T>>(
    ndf: &N,
    albedo: Rgb<T>,
    wo: Vec3<T>,
    u: [T; 2],
    stream: &mut Stream,
) -> Option<(Vec3<T>, Rgb<T>)> {
    diffuse_walk(ndf, albedo, wo, Some(u), stream, |_, _, _| {})
}

#[inline]
fn diffuse_walk<T: Real, N: VisibleNormals<T>>(
    ndf: &N,
    albedo: Rgb<T>,
    wo: Vec3<T>,
    u: Option<[T; 2]>,
    stream: &mut Stream,
    mut visit: impl FnMut(Rgb<T>, Vec3<T>, T),
) -> Option<(Vec3<T>, Rgb<T>)> {
    let mut flight = Flight::new(ndf, -wo);
    let mut tau = step(flight.rate, stream);
    let mut weight = Rgb::WHITE;
    let mut u = u.unwrap_or_else(|| [stream.next(), stream.next()]);
    for _ in 0..MAX_BOUNCES {
        let wm = ndf.sample_wm(-flight.d, u);
        weight *= albedo;
        visit(weight, wm, tau);
        let around = warp::cosine_hemisphere([stream.next(), stream.next()]);
        flight = Flight::new(ndf, Frame::from_normal(wm).to_world(around));
        let s = step(flight.rate, stream);
        tau = if flight.is_upward() { tau - s } else { tau + s };
        if tau < T::ZERO {
            return Some((flight.d, weight));
        }
        u = [stream.next(), stream.next()];
    }
    None
}
