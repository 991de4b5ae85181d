// Our density for multiple importance sampling: normalised, with its own sampler.
//
// Light that meets one facet is distributed exactly: it flies along `w` with the density
//
//     p1(w) = D(wm) / (4 sigma(wo)),   wm ~ wo + w,      1 over the sphere
//
// of which the share `G(w) = l_o / (l_o + Lambda(w))` of an upward `w` leaves and all else meets facets
// again. What follows is modelled by maps of the sphere to the upper hemisphere: a light that stays is
// sent along `T(w)`. As a map moves light and neither makes nor loses any,
//
//     p(wi) = G p1(wi) + sum_T c_T J_T (1 - G) p1(T^-1(wi)),    J_T = |d T^-1 / d wi|,   sum_T c_T = 1
//
// integrates to 1 for every distribution of normals and every view, with no table and no fit of any
// albedo. The maps, with `M(u; e) = e u / (1 - (1 - e) u)`:
//
// | flight | map | taken |
// |---|---|---|
// | up | raised: `w.z = M(z^2; 0.25)`; azimuth spread | isotropic part |
// | up | rolled: about the axis of less roughness, `sin = 1 - sin'^2` | `1 - r^2` |
// | down | raised: `w.z = -wo.z u`, `u = M(z^2; 0.65 / wo.z)`; azimuth spread | isotropic part |
// | down | turned up: as before, with `1 - u` for `u` | `0.8 a^4 / (a^4 + 0.15)` of it |
// | down | rolled on, to the other side of the axis | `0.45 (1 - r^2)` |
//
// `r` is the ratio of the smaller alpha to the larger, `a^2` their product. The azimuth spreads about
// the forward direction: `tan(phi / 2) = kappa tan(phi' / 2)` (a wrapped Cauchy distribution, where
// all light goes forward), `kappa = 1 / (1 + 2 (1 - a^2) sin^2 theta_o)`. All depends continuously on
// alphas and directions.

import package::math::warp::{warp_cosine_hemisphere};
import package::multibounce::normals::{NormalsModel, normals_d, normals_lambda_cos, normals_sample_wm};
import package::multibounce::walk::{walk_flight};

/// A cosine lobe's share, so that the density is above 0 where D underflows.
const NORMALISED_FLOOR: f32 = 1e-4;
/// `e` of upward flights.
const NORMALISED_RISE: f32 = 0.25;
/// `e` of downward flights, times `wo.z`.
const NORMALISED_RISE_BELOW: f32 = 0.65;
/// A floor of divisors.
const NORMALISED_TINY: f32 = 1.1754944e-38;

/// What the maps of one view share.
///
/// Twin: specula-bsdf/src/multibounce/normalised.rs, Maps.
struct NormalisedMaps {
    /// Downward flights of the first facet are above `-mu`.
    mu: f32,
    /// `sigma(wo)`.
    sigma: f32,
    /// `|Lambda_o|`.
    rate: f32,
    /// Horizontal, unit: away from the viewer.
    forward: vec2f,
    /// Of the spread of azimuths.
    kappa: f32,
    /// Share of downward flights that are turned up.
    below_turned: f32,
    /// Share of upward flights that are rolled.
    rolled_up: f32,
    /// Share of downward flights that are rolled.
    rolled_down: f32,
    /// The axis of less roughness is x.
    is_smooth_along_x: bool,
}

/// A flight that a map sends along a given direction.
///
/// Twin: specula-bsdf/src/multibounce/normalised.rs, Maps::roll_back.
struct NormalisedSource {
    /// The flight.
    w: vec3f,
    /// `J_T` of the map.
    jacobian: f32,
}

/// Both flights that rolling sends along a given direction.
///
/// Twin: specula-bsdf/src/multibounce/normalised.rs, Maps::roll_back.
struct NormalisedSources {
    /// The upward one.
    up: NormalisedSource,
    /// The downward one.
    down: NormalisedSource,
}

/// Whether a random number lies in a part of `[0, 1)`, and its position there.
///
/// Twin: specula-bsdf/src/multibounce/normalised.rs, sample.
struct NormalisedChoice {
    /// Whether the part was taken.
    is_taken: bool,
    /// The random number, rescaled to `[0, 1)`.
    rest: f32,
}

/// The density of a reflected `wi` (see the module's text).
///
/// * Returns: 1/sr; 0 where `wi.z <= 0`, above 0 elsewhere.
///
/// Invariant: integrates to 1; is that of `normalised_sample_direction`.
///
/// Twin: specula-bsdf/src/multibounce/normalised.rs, pdf.
fn normalised_pdf(normals: NormalsModel, wo: vec3f, wi: vec3f) -> f32 {
    if wi.z <= 0.0 {
        return 0.0;
    }
    let maps = normalised_maps(normals, wo);
    let below = maps.below_turned;
    let leaves = 1.0 - normalised_stays(maps, normals, wi);
    var sum = leaves * normalised_met(normals, wo, wi);
    let round_up = 1.0 - maps.rolled_up;
    let round_down = 1.0 - maps.rolled_down;
    let gathered = normalised_turn(maps, wi, maps.kappa);
    let towards = gathered.xy;
    let spread = gathered.z;
    let up = normalised_slow(wi.z, NORMALISED_RISE, 1.0);
    let raised_up = NormalisedSource(normalised_at(towards, up.x), up.y * spread);
    sum += round_up * normalised_sent(maps, normals, wo, raised_up);
    let slow = normalised_slow(wi.z, NORMALISED_RISE_BELOW, maps.mu);
    let jacobian = slow.y * spread * maps.mu;
    let raised = NormalisedSource(normalised_at(towards, -maps.mu * slow.x), jacobian);
    let turned = NormalisedSource(normalised_at(towards, maps.mu * (slow.x - 1.0)), jacobian);
    sum += round_down * (1.0 - below) * normalised_sent(maps, normals, wo, raised);
    sum += round_down * below * normalised_sent(maps, normals, wo, turned);
    if maps.rolled_up > 0.0 {
        let rolled = normalised_roll_back(maps, wi);
        sum += maps.rolled_up * normalised_sent(maps, normals, wo, rolled.up);
        sum += maps.rolled_down * normalised_sent(maps, normals, wo, rolled.down);
    }
    let floor_share = NORMALISED_FLOOR * wi.z * 0.31830987;
    return (1.0 - NORMALISED_FLOOR) * sum / (4.0 * maps.sigma) + floor_share;
}

/// A direction of the density `normalised_pdf`.
///
/// * `u`: uniform in `[0, 1)`; two sample a facet, the third what follows.
/// * Returns: unit, above the horizon; with `z <= 0` in the rare case that rounding leaves it there.
///
/// Twin: specula-bsdf/src/multibounce/normalised.rs, sample.
fn normalised_sample_direction(normals: NormalsModel, wo: vec3f, u: vec3f) -> vec3f {
    let maps = normalised_maps(normals, wo);
    var choice = normalised_takes(u.z, NORMALISED_FLOOR);
    if choice.is_taken {
        return warp_cosine_hemisphere(u.xy);
    }
    let wm = normals_sample_wm(normals, wo, u.xy);
    let w = wm * (2.0 * dot(wo, wm)) - wo;
    if w.z > 0.0 {
        choice = normalised_takes(choice.rest, normalised_stays(maps, normals, w));
        if !choice.is_taken {
            return w;
        }
        choice = normalised_takes(choice.rest, maps.rolled_up);
        if choice.is_taken {
            return normalised_roll(maps, w);
        }
        let scattered = normalised_turn(maps, w, 1.0 / maps.kappa).xy;
        return normalised_at(scattered, normalised_fast(w.z, NORMALISED_RISE, 1.0));
    }
    choice = normalised_takes(choice.rest, maps.rolled_down);
    if choice.is_taken {
        return normalised_roll(maps, w);
    }
    let deep = clamp(-w.z / maps.mu, 0.0, 1.0);
    choice = normalised_takes(choice.rest, maps.below_turned);
    let raised = select(deep, 1.0 - deep, choice.is_taken);
    let scattered = normalised_turn(maps, w, 1.0 / maps.kappa).xy;
    return normalised_at(scattered, normalised_fast(raised, NORMALISED_RISE_BELOW, maps.mu));
}

/// Whether a random number lies below `share`, and the number rescaled from its part to `[0, 1)`.
///
/// Twin: specula-bsdf/src/multibounce/normalised.rs, sample.
fn normalised_takes(choice: f32, share: f32) -> NormalisedChoice {
    if choice < share {
        return NormalisedChoice(true, choice / share);
    }
    return NormalisedChoice(false, (choice - share) / max(1.0 - share, NORMALISED_TINY));
}

/// Density from the flight `source` that meets facets, by the maps of directions, times `4 sigma(wo)`.
///
/// Twin: specula-bsdf/src/multibounce/normalised.rs, pdf.
fn normalised_sent(
    maps: NormalisedMaps,
    normals: NormalsModel,
    wo: vec3f,
    source: NormalisedSource,
) -> f32 {
    var stays = 1.0;
    if source.w.z > 0.0 {
        stays = normalised_stays(maps, normals, source.w);
    }
    return source.jacobian * stays * normalised_met(normals, wo, source.w);
}

/// `D` of the facet that turns `wo` to `w`.
///
/// Twin: specula-bsdf/src/multibounce/normalised.rs, met.
fn normalised_met(normals: NormalsModel, wo: vec3f, w: vec3f) -> f32 {
    let between = wo + w;
    let size = length(between);
    if between.z > 0.0 && size > 1e-6 {
        return normals_d(normals, between * (1.0 / size));
    }
    return 0.0;
}

/// `u = M(z^2; e / m)` and `du / dz`.
///
/// Twin: specula-bsdf/src/multibounce/normalised.rs, slow.
fn normalised_slow(z: f32, e: f32, m: f32) -> vec2f {
    let up = e * z * z;
    let sum = max(up + m * (1.0 - z * z), NORMALISED_TINY);
    return vec2f(up / sum, 2.0 * z * (e / sum) * (m / sum));
}

/// The inverse of `normalised_slow`.
///
/// Twin: specula-bsdf/src/multibounce/normalised.rs, fast.
fn normalised_fast(u: f32, e: f32, m: f32) -> f32 {
    let up = m * u;
    return min(sqrt(max(up / max(up + e * (1.0 - u), NORMALISED_TINY), 0.0)), 1.0);
}

/// The direction of height `z` towards a horizontal unit vector.
///
/// Twin: specula-bsdf/src/multibounce/normalised.rs, at.
fn normalised_at(towards: vec2f, z: f32) -> vec3f {
    let r = sqrt(max((1.0 - z) * (1.0 + z), 0.0));
    return vec3f(towards * r, z);
}

/// The maps of a view.
///
/// Twin: specula-bsdf/src/multibounce/normalised.rs, Maps::new.
fn normalised_maps(normals: NormalsModel, wo: vec3f) -> NormalisedMaps {
    let view = walk_flight(normals, -wo);
    let x = normals.alpha.x;
    let y = normals.alpha.y;
    let area = x * y;
    let fourth = area * area;
    let ratio = min(x, y) / max(x, y);
    let rolled = 1.0 - ratio * ratio;
    let sine = wo.x * wo.x + wo.y * wo.y;
    let smooth_part = max(1.0 - area, 0.0);
    return NormalisedMaps(
        max(wo.z, 1e-6),
        view.facing,
        view.rate,
        normalised_horizontal(-wo, vec2f(1.0, 0.0)),
        1.0 / (1.0 + 2.0 * smooth_part * sine),
        0.8 * fourth / (fourth + 0.15),
        rolled,
        0.45 * rolled,
        x < y,
    );
}

/// Share of an upward flight that meets a facet.
///
/// Twin: specula-bsdf/src/multibounce/normalised.rs, Maps::stays.
fn normalised_stays(maps: NormalisedMaps, normals: NormalsModel, w: vec3f) -> f32 {
    let lambda_cos = normals_lambda_cos(normals, w);
    return lambda_cos / max(lambda_cos + maps.rate * w.z, NORMALISED_TINY);
}

/// The half-angle from the forward direction, its tangent times `k`: the horizontal direction that
/// it leads to, and the derivative of the angle.
///
/// * `k`: `kappa` gathers what its inverse scatters.
///
/// Twin: specula-bsdf/src/multibounce/normalised.rs, Maps::turn.
fn normalised_turn(maps: NormalisedMaps, w: vec3f, k: f32) -> vec3f {
    let f = maps.forward;
    let towards = normalised_horizontal(w, f);
    let along = towards.x * f.x + towards.y * f.y;
    let across = towards.y * f.x - towards.x * f.y;
    let near_part = 1.0 + along;
    let far_part = k * k * (1.0 - along);
    let scale = 1.0 / (near_part + far_part);
    let turned_along = (near_part - far_part) * scale;
    let turned_across = 2.0 * k * across * scale;
    return vec3f(
        turned_along * f.x - turned_across * f.y,
        turned_along * f.y + turned_across * f.x,
        2.0 * k * scale,
    );
}

/// `(along, across)` the axis of less roughness.
///
/// Twin: specula-bsdf/src/multibounce/normalised.rs, Maps::to_axis.
fn normalised_to_axis(maps: NormalisedMaps, w: vec3f) -> vec2f {
    return select(w.yx, w.xy, maps.is_smooth_along_x);
}

/// The vector of these parts along and across the axis of less roughness.
///
/// Twin: specula-bsdf/src/multibounce/normalised.rs, Maps::of_axis.
fn normalised_of_axis(maps: NormalisedMaps, along: f32, across: f32, z: f32) -> vec3f {
    return select(vec3f(across, along, z), vec3f(along, across, z), maps.is_smooth_along_x);
}

/// The flights up and down that `normalised_roll` sends along `wi`, with their Jacobians.
///
/// With the sine `s` of the elevation about the axis, `d omega = d along d s / sqrt(1 - s^2)`.
///
/// Twin: specula-bsdf/src/multibounce/normalised.rs, Maps::roll_back.
fn normalised_roll_back(maps: NormalisedMaps, wi: vec3f) -> NormalisedSources {
    let parts = normalised_to_axis(maps, wi);
    let along = parts.x;
    let across = parts.y;
    let radius = max(sqrt(across * across + wi.z * wi.z), 1e-12);
    let cosine = across / radius;
    let sine = wi.z / radius;
    let side_sign = select(1.0, -1.0, across < 0.0);
    // The sine of the flight's elevation.
    let t = cosine * cosine;
    let side_up = wi.z * sqrt(1.0 + t) * side_sign;
    let up = normalised_of_axis(maps, along, side_up, radius * t);
    let up_jacobian = 2.0 * sqrt(t / (1.0 + t));
    let top = min(maps.mu / radius, 1.0);
    let low = top * t;
    // 1 - low, without cancellation.
    let rest = (1.0 - top + top * sine * sine) * (1.0 + low);
    let side_down = -(radius * sqrt(max(rest, 0.0))) * side_sign;
    let down = normalised_of_axis(maps, along, side_down, -radius * low);
    let down_jacobian = 2.0 * top * sine * sqrt(t / max(rest, NORMALISED_TINY));
    return NormalisedSources(
        NormalisedSource(up, up_jacobian),
        NormalisedSource(down, down_jacobian),
    );
}

/// Rolls a flight about the axis of less roughness: an upward one rises on its side, a downward one goes
/// on to the other.
///
/// Twin: specula-bsdf/src/multibounce/normalised.rs, Maps::roll.
fn normalised_roll(maps: NormalisedMaps, w: vec3f) -> vec3f {
    let parts = normalised_to_axis(maps, w);
    let along = parts.x;
    let across = parts.y;
    let radius = max(sqrt(across * across + w.z * w.z), 1e-12);
    let is_up = w.z > 0.0;
    let top = select(min(maps.mu / radius, 1.0), 1.0, is_up);
    let t = clamp(abs(w.z) / (radius * top), 0.0, 1.0);
    let z = radius * sqrt(max(1.0 - t, 0.0));
    let is_left = (across < 0.0) == is_up;
    let side_sign = select(1.0, -1.0, is_left);
    return normalised_of_axis(maps, along, radius * sqrt(t) * side_sign, z);
}

/// The unit vector along the horizontal part of `w`; `otherwise` where it has none.
///
/// Twin: specula-bsdf/src/multibounce/normalised.rs, horizontal.
fn normalised_horizontal(w: vec3f, otherwise: vec2f) -> vec2f {
    let size = sqrt(w.x * w.x + w.y * w.y);
    if size > 1e-6 {
        return w.xy / size;
    }
    return otherwise;
}
