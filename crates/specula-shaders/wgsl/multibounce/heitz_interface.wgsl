// The walk of Heitz et al. 2016 at dielectric facets, which reflect with probability F or refract into
// the other side.

import package::bsdf::bsdf_sample::{BSDF_SAMPLE_VALID, BsdfSample, bsdf_sample_none};
import package::math::stream::{StreamState, stream_next};
import package::multibounce::heitz2016::{heitz2016_depth, heitz2016_step};
import package::multibounce::multibounce_interface::{MultibounceInterfaceCollision, MultibounceInterface, multibounce_interface_beyond, multibounce_interface_bounce, multibounce_interface_connection, multibounce_interface_depth_beyond, multibounce_interface_turned};
import package::multibounce::walk::{WALK_MAX_BOUNCES, walk_flight};

/// What a walk does after a bounce, or after all of them.
///
/// Twin: specula-bsdf/src/multibounce/interface.rs, Next.
struct HeitzInterfaceWalk {
    /// The facets on the side that it is on.
    side: MultibounceInterface,
    /// Where it meets one of them; meaningful where it has not left.
    at: MultibounceInterfaceCollision,
    /// Whether that is another side than the one it started on.
    is_beyond: bool,
    /// Whether it has left, along `at.flight.d` in the frame of its side.
    has_left: bool,
    /// Sum of its connections.
    sum: f32,
}

/// An estimate of `f |cos|` of a dielectric, for light (no `1/eta^2`).
///
/// Twin: specula-bsdf/src/multibounce/heitz2016.rs, eval_interface.
fn heitz_interface_eval(
    facets: MultibounceInterface,
    wo: vec3f,
    wi: vec3f,
    stream: ptr<function, StreamState>,
) -> f32 {
    let flight = walk_flight(facets.normals, -wo);
    let tau = heitz2016_step(flight.rate, stream);
    let start = HeitzInterfaceWalk(facets, MultibounceInterfaceCollision(flight, tau), false, false, 0.0);
    return heitz_interface_collisions(start, true, wi, stream).sum;
}

/// A direction sampled at a dielectric; its weight is 1 (for light). Its own density is not known: `pdf`
/// is 0. Transmitted where `wi.z < 0`, whatever the flags.
///
/// * `u`: samples reflection or refraction (x), and the first facet.
///
/// Twin: specula-bsdf/src/multibounce/heitz2016.rs, sample_interface.
fn heitz_interface_sample(
    facets: MultibounceInterface,
    wo: vec3f,
    u: vec3f,
    stream: ptr<function, StreamState>,
) -> BsdfSample {
    let flight = walk_flight(facets.normals, -wo);
    let tau = heitz2016_step(flight.rate, stream);
    let start = HeitzInterfaceWalk(facets, MultibounceInterfaceCollision(flight, tau), false, false, 0.0);
    var walk = heitz_interface_after(start, u, stream);
    if !walk.has_left {
        walk = heitz_interface_collisions(walk, false, vec3f(0.0, 0.0, 1.0), stream);
    }
    return heitz_interface_left(walk);
}

/// The direction of a walk that has left, in the frame in which it started; none of one that has not.
///
/// Twin: specula-bsdf/src/multibounce/heitz2016.rs, sample_interface.
fn heitz_interface_left(walk: HeitzInterfaceWalk) -> BsdfSample {
    if !walk.has_left {
        return bsdf_sample_none();
    }
    let d = walk.at.flight.d;
    let wi = select(d, multibounce_interface_turned(d), walk.is_beyond);
    return BsdfSample(wi, 0.0, vec3f(1.0), 1.0, BSDF_SAMPLE_VALID);
}

/// Walks through all collisions from one on.
///
/// * `connects`: adds the connections to `wi`, in the frame in which the walk started.
///
/// Twin: specula-bsdf/src/multibounce/heitz2016.rs, collisions.
fn heitz_interface_collisions(
    start: HeitzInterfaceWalk,
    connects: bool,
    wi: vec3f,
    stream: ptr<function, StreamState>,
) -> HeitzInterfaceWalk {
    var walk = start;
    for (var bounce = 0u; bounce < WALK_MAX_BOUNCES; bounce++) {
        if connects {
            let there = select(wi, multibounce_interface_turned(wi), walk.is_beyond);
            walk.sum += multibounce_interface_connection(walk.side, walk.at, there);
        }
        let first = stream_next(stream);
        let second = stream_next(stream);
        let third = stream_next(stream);
        walk = heitz_interface_after(walk, vec3f(first, second, third), stream);
        if walk.has_left {
            break;
        }
    }
    return walk;
}

/// The walk after one more bounce.
///
/// * `u`: samples reflection or refraction (x), and the facet.
///
/// Twin: specula-bsdf/src/multibounce/heitz2016.rs, after.
fn heitz_interface_after(
    walk: HeitzInterfaceWalk,
    u: vec3f,
    stream: ptr<function, StreamState>,
) -> HeitzInterfaceWalk {
    let bent = multibounce_interface_bounce(walk.side, walk.at.flight.d, u);
    return heitz_interface_flown(walk, bent.d, bent.crosses, stream);
}

/// The walk after the flight that follows a bounce.
///
/// * `d`, `crosses`: the direction after the bounce, and whether it has changed sides.
///
/// Twin: specula-bsdf/src/multibounce/heitz2016.rs, after.
fn heitz_interface_flown(
    walk: HeitzInterfaceWalk,
    d: vec3f,
    crosses: bool,
    stream: ptr<function, StreamState>,
) -> HeitzInterfaceWalk {
    var next = walk;
    if crosses {
        next.side = multibounce_interface_beyond(walk.side);
        next.is_beyond = !walk.is_beyond;
        next.at.tau = multibounce_interface_depth_beyond(walk.at.tau);
    }
    next.at.flight = walk_flight(walk.side.normals, d);
    next.at.tau = heitz2016_depth(next.at.tau, next.at.flight, stream);
    next.has_left = next.at.tau < 0.0;
    return next;
}
