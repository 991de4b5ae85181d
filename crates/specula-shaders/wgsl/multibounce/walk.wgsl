// What every walk over the facets needs: a flight with its rates, a bounce, a connection.
//
// The microsurface is a medium whose depth `tau = -ln C1(h) >= 0` is measured by the distribution
// `C1` of its heights. A ray of direction `d` meets facets at the rate
//
//     |Lambda(d)| = sigma(-d) / |d_z|      per unit of tau:   1 + Lambda going down, Lambda going up
//
// whatever `C1` is: that is why results do not depend on the distribution of heights (Heitz et al.
// 2016, observed; Dupuy et al. 2016 and Bitterli and d'Eon 2022, derived).
//
// Here the papers' directions `d` run along the light's path: `d_0 = -wo`, `d_k = wi`.

import package::fresnel::reflectance::{ReflectanceModel, reflectance_eval};
import package::math::stream::{StreamState, stream_next};
import package::multibounce::normals::{NormalsModel, normals_d, normals_lambda_cos, normals_sample_wm};

/// Bounces after which a walk ends whatever it carries. Survivors of so many are below 1e-6 of the
/// energy but for views within 1e-3 of the horizon.
const WALK_MAX_BOUNCES: u32 = 64u;

/// A direction of travel.
///
/// Twin: specula-bsdf/src/multibounce/walk.rs, Flight.
struct WalkFlight {
    /// Unit.
    d: vec3f,
    /// `sigma(-d)`: area of the facets that it can meet.
    facing: f32,
    /// `sigma(d)`: area of the facets that it would meet on its way back.
    backing: f32,
    /// `sigma(-d) / |d_z|`.
    rate: f32,
}

/// Facets of one material.
///
/// Twin: specula-bsdf/src/multibounce/walk.rs, Facets.
struct WalkFacets {
    /// Their distribution.
    normals: NormalsModel,
    /// Of each of them.
    reflectance: ReflectanceModel,
}

/// A facet that was met.
///
/// Twin: specula-bsdf/src/multibounce/walk.rs, meet.
struct WalkMeeting {
    /// Its normal.
    wm: vec3f,
    /// Cosine of incidence.
    cos_m: f32,
    /// The flight after it.
    next: WalkFlight,
}

/// A facet that was met and what it reflects.
///
/// Twin: specula-bsdf/src/multibounce/walk.rs, Facets::bounce.
struct WalkBounce {
    /// Its normal.
    wm: vec3f,
    /// Its reflectance.
    fresnel: vec3f,
    /// The flight after it.
    next: WalkFlight,
}

/// The facet that turns one direction to another.
///
/// Twin: specula-bsdf/src/multibounce/walk.rs, turn.
struct WalkTurn {
    /// Cosine of incidence.
    cos_m: f32,
    /// Its `D / 4`, in 1/sr; 0 where there is none.
    quarter_d: f32,
}

/// The facet that connects a path to the other direction: its reflectance and density.
///
/// Twin: specula-bsdf/src/multibounce/walk.rs, Facets::connection.
struct WalkConnection {
    /// Reflectance; 0 where no facet connects.
    fresnel: vec3f,
    /// `D / 4` in 1/sr; 0 where no facet connects.
    quarter_d: f32,
}

/// The flight along `d`.
///
/// * `d`: unit.
///
/// Twin: specula-bsdf/src/multibounce/walk.rs, Flight::new.
fn walk_flight(normals: NormalsModel, d: vec3f) -> WalkFlight {
    let below = max(normals_lambda_cos(normals, d), 1e-24);
    let facing = below + max(-d.z, 0.0);
    let backing = below + max(d.z, 0.0);
    return WalkFlight(d, facing, backing, facing / max(abs(d.z), 1e-12));
}

/// The same flight, the other way; for flights that enter or leave the surface.
///
/// Twin: specula-bsdf/src/multibounce/walk.rs, Flight::reversed.
fn walk_reversed(flight: WalkFlight) -> WalkFlight {
    let rate = flight.backing / max(abs(flight.d.z), 1e-12);
    return WalkFlight(-flight.d, flight.backing, flight.facing, rate);
}

/// Whether a flight goes up.
///
/// Twin: specula-bsdf/src/multibounce/walk.rs, Flight::is_upward.
fn walk_is_upward(flight: WalkFlight) -> bool {
    return flight.d.z > 0.0;
}

/// The flight that leaves for `wo`, reversed.
///
/// Twin: specula-bsdf/src/multibounce/walk.rs, Facets::arriving.
fn walk_arriving(facets: WalkFacets, wo: vec3f) -> WalkFlight {
    return walk_flight(facets.normals, -wo);
}

/// The facet that is met, sampled among those that `-d` sees.
///
/// * `u`: uniform in `[0, 1)^2`.
///
/// Twin: specula-bsdf/src/multibounce/walk.rs, meet.
fn walk_meet(normals: NormalsModel, d: vec3f, u: vec2f) -> WalkMeeting {
    let wm = normals_sample_wm(normals, -d, u);
    let along = dot(d, wm);
    let after = d - wm * (2.0 * along);
    return WalkMeeting(wm, -along, walk_flight(normals, after));
}

/// The facet that is met (sampled among those that `-d` sees), its reflectance, and the flight after it.
///
/// * `u`: uniform in `[0, 1)^2`.
///
/// Twin: specula-bsdf/src/multibounce/walk.rs, Facets::bounce.
fn walk_bounce(facets: WalkFacets, d: vec3f, u: vec2f) -> WalkBounce {
    let met = walk_meet(facets.normals, d, u);
    return WalkBounce(met.wm, reflectance_eval(facets.reflectance, met.cos_m), met.next);
}

/// The facet that turns `d` to `wi`.
///
/// Twin: specula-bsdf/src/multibounce/walk.rs, turn.
fn walk_turn(normals: NormalsModel, d: vec3f, wi: vec3f) -> WalkTurn {
    let between = wi - d;
    let size = length(between);
    if !(between.z > 0.0 && size > 1e-6) {
        return WalkTurn(0.0, 0.0);
    }
    let wm = between * (1.0 / size);
    return WalkTurn(dot(wi, wm), 0.25 * normals_d(normals, wm));
}

/// Reflectance and `D / 4` of the facet that turns `d` to `wi`; zeros where none does.
///
/// Twin: specula-bsdf/src/multibounce/walk.rs, Facets::connection.
fn walk_connection(facets: WalkFacets, d: vec3f, wi: vec3f) -> WalkConnection {
    let turn = walk_turn(facets.normals, d, wi);
    if turn.quarter_d <= 0.0 {
        return WalkConnection(vec3f(0.0), 0.0);
    }
    return WalkConnection(reflectance_eval(facets.reflectance, turn.cos_m), turn.quarter_d);
}

/// `f cos` of light that met one facet: `F D / (4 sigma(wo))` times the share that leaves,
/// `|Lambda_o| / (|Lambda_o| + Lambda_i)`: the height-correlated `G2` of Smith.
///
/// Twin: specula-bsdf/src/multibounce/walk.rs, Facets::single.
fn walk_single(facets: WalkFacets, arriving: WalkFlight, leaving: WalkFlight) -> vec3f {
    let met = walk_connection(facets, arriving.d, leaving.d);
    let share = arriving.rate / (arriving.rate + leaving.rate);
    return met.fresnel * (met.quarter_d / arriving.facing * share);
}

/// Two uniform random numbers of the stream, in its order.
///
/// Twin: specula-bsdf/src/math/stream.rs, Stream::next, twice.
fn walk_pair(stream: ptr<function, StreamState>) -> vec2f {
    let first = stream_next(stream);
    let second = stream_next(stream);
    return vec2f(first, second);
}
