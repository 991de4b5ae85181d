// Our density for multiple importance sampling: normalised, with its own sampler.
//
// Light that meets one facet is distributed exactly: it flies along `w` with the density
//
//     p1(w) = D(wm) / (4 sigma(wo)),   wm ~ wo + w,      1 over the sphere
//
// of which the share `G(w) = l_o / (l_o + Lambda(w))` of an upward `w` leaves and all else meets
// facets again. What follows is modelled in two ways, both of which move light and neither make nor
// lose any:
//
// - Maps `T` of the sphere to the upper hemisphere send a light that stays along `T(w)` (`normalised_maps`).
// - A flight is sampled with a point `u` of the unit square, of which any sampler `Q` makes a direction
//   of its own lobe `q`: light that stays is sent along `Q(u)` (`normalised_lobes`). The density needs the flight
//   that the point of `wi` samples, and neither an albedo nor the flight's own density.
//
//     p(wi) = G p1(wi) + sum_T c_T J_T (1 - G) p1(T^-1(wi)) + sum_Q c_Q q(wi) (1 - G(w(Q^-1(wi)))),
//     J_T = |d T^-1 / d wi|,   sum_T c_T + sum_Q c_Q = 1
//
// So `p` integrates to 1 for every distribution of normals and every view, with no table and no fit of
// any albedo. With `M(u; e) = e u / (1 - (1 - e) u)`:
//
// | flight | sent | share |
// |---|---|---|
// | up | raised: `w.z = M(z^2; e)`; azimuth spread | isotropic part |
// | up | turned: `1 - w.z = M(z^2; 2.21)` | `0.675 a^4 / (a^4 + 1.45)` of it |
// | down | raised: `w.z = -wo.z u`, `u = M(z^2; e)`; azimuth spread | isotropic part |
// | down | turned: as before, with `1 - u` for `u` | `0.49 a^4 / (a^4 + 0.435)` of it |
// | any | a lobe that is alike in all azimuths | of rough surfaces, `a` above 0.59 |
// | up | rolled about the grain, on its side; raised and turned, too | `(1 - r^2)^2` |
// | down | rolled about the grain, to the other side; raised and turned, too | `(1 - r^2)^2` |
// | any | a lobe about the grain | of rough surfaces |
//
// The grain is the axis of less roughness, `r` the ratio of the smaller alpha to the larger, `a^2` their
// product. The azimuth spreads about the forward direction: `tan(phi / 2) = kappa tan(phi' / 2)`, a
// wrapped Cauchy distribution where all light goes forward. All depends continuously on alphas and
// directions.

import package::math::warp::{warp_cosine_hemisphere};
import package::multibounce::normalised_lobes::{
    normalised_lobes_cone, normalised_lobes_cone_density, normalised_lobes_cone_direction, normalised_lobes_round,
    normalised_lobes_round_density, normalised_lobes_round_direction,
};
import package::multibounce::normalised_maps::{
    NormalisedMapsRise, NormalisedMapsRoll, normalised_maps_horizontal, normalised_maps_rise_back,
    normalised_maps_rise_send, normalised_maps_roll_back, normalised_maps_roll_send,
};
import package::multibounce::normals::{NormalsModel, normals_d, normals_lambda_cos, normals_sample_wm};
import package::multibounce::walk::{walk_flight};

/// A cosine lobe's share, so that the density is above 0 where D underflows.
const NORMALISED_FLOOR: f32 = 1e-4;
/// A floor of divisors.
const NORMALISED_TINY: f32 = 1.1754944e-38;

/// What the directions of one view share.
///
/// Twin: specula-bsdf/src/multibounce/normalised/mod.rs, View.
struct NormalisedView {
    /// `wo.z`, above 0.
    mu: f32,
    /// `sigma(wo)`.
    sigma: f32,
    /// `|Lambda_o|`.
    rate: f32,
    /// Geometric mean of the alphas.
    scale: f32,
    /// The smaller alpha, and the larger.
    alphas: vec2f,
    /// The axis of less roughness is x.
    is_smooth_along_x: bool,
    /// Share of light that goes by the grain.
    grain: f32,
    /// Of that, share of its lobe.
    cone: f32,
    /// Of the rest, share of the lobe of all azimuths.
    all_round: f32,
    /// Maps that raise flights.
    rise: NormalisedMapsRise,
    /// Maps that roll flights about the grain.
    roll: NormalisedMapsRoll,
}

/// Whether a random number lies in a part of `[0, 1)`, and its position there.
///
/// Twin: specula-bsdf/src/multibounce/normalised/mod.rs, sample.
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
/// Twin: specula-bsdf/src/multibounce/normalised/mod.rs, pdf.
fn normalised_pdf(normals: NormalsModel, wo: vec3f, wi: vec3f) -> f32 {
    if wi.z <= 0.0 {
        return 0.0;
    }
    let view = normalised_view(normals, wo);
    var sum = (1.0 - normalised_stays(view, normals, wi)) * normalised_met(normals, wo, wi);
    let maps = (1.0 - view.grain) * (1.0 - view.all_round);
    if maps > 0.0 {
        let sources = normalised_maps_rise_back(view.rise, wi);
        sum += maps * normalised_sent(view, normals, wo, sources.up);
        sum += maps * normalised_sent(view, normals, wo, sources.up_turned);
        sum += maps * normalised_sent(view, normals, wo, sources.down);
        sum += maps * normalised_sent(view, normals, wo, sources.down_turned);
    }
    let parts = normalised_to_grain(view, wi);
    let rolled = view.grain * (1.0 - view.cone);
    if rolled > 0.0 {
        let sources = normalised_maps_roll_back(view.roll, parts);
        sum += rolled * normalised_rolled_sent(view, normals, wo, sources.up);
        sum += rolled * normalised_rolled_sent(view, normals, wo, sources.up_turned);
        sum += rolled * normalised_rolled_sent(view, normals, wo, sources.down);
        sum += rolled * normalised_rolled_sent(view, normals, wo, sources.down_turned);
    }
    var lobes = 0.0;
    let round_share = (1.0 - view.grain) * view.all_round;
    if round_share > 0.0 {
        let lobe = normalised_lobes_round_density(normalised_lobes_round(view.scale, view.mu), wi);
        let here = normalised_stays(view, normals, normalised_flight(normals, wo, lobe.xy));
        let there = normalised_flight(normals, wo, normalised_opposite(lobe.xy));
        lobes += round_share * lobe.z * 0.5 * (here + normalised_stays(view, normals, there));
    }
    let cone_share = view.grain * view.cone;
    if cone_share > 0.0 {
        let cone = normalised_lobes_cone(view.alphas, normalised_to_grain(view, wo).xy, view.mu);
        let lobe = normalised_lobes_cone_density(cone, parts);
        let flight = normalised_flight(normals, wo, lobe.xy);
        lobes += cone_share * lobe.z * normalised_stays(view, normals, flight);
    }
    let floor_share = NORMALISED_FLOOR * wi.z * 0.31830987;
    return (1.0 - NORMALISED_FLOOR) * (sum / (4.0 * view.sigma) + lobes) + floor_share;
}

/// A direction of the density `normalised_pdf`.
///
/// * `u`: uniform in `[0, 1)`; two sample a facet, the third what follows.
/// * Returns: unit, above the horizon; with `z <= 0` in the rare case that rounding leaves it there.
///
/// Twin: specula-bsdf/src/multibounce/normalised/mod.rs, sample.
fn normalised_sample_direction(normals: NormalsModel, wo: vec3f, u: vec3f) -> vec3f {
    let view = normalised_view(normals, wo);
    var choice = normalised_takes(u.z, NORMALISED_FLOOR);
    if choice.is_taken {
        return warp_cosine_hemisphere(u.xy);
    }
    let w = normalised_flight(normals, wo, u.xy);
    choice = normalised_takes(choice.rest, normalised_stays(view, normals, w));
    if !choice.is_taken {
        return w;
    }
    choice = normalised_takes(choice.rest, view.grain);
    if choice.is_taken {
        choice = normalised_takes(choice.rest, view.cone);
        if choice.is_taken {
            let cone = normalised_lobes_cone(view.alphas, normalised_to_grain(view, wo).xy, view.mu);
            return normalised_to_grain(view, normalised_lobes_cone_direction(cone, u.xy));
        }
        choice = normalised_takes(choice.rest, view.roll.turned);
        let parts = normalised_to_grain(view, w);
        return normalised_to_grain(view, normalised_maps_roll_send(view.roll, parts, choice.is_taken));
    }
    choice = normalised_takes(choice.rest, view.all_round);
    if choice.is_taken {
        choice = normalised_takes(choice.rest, 0.5);
        let point = select(u.xy, normalised_opposite(u.xy), choice.is_taken);
        return normalised_lobes_round_direction(normalised_lobes_round(view.scale, view.mu), point);
    }
    let turned = select(view.rise.turned.y, view.rise.turned.x, w.z > 0.0);
    choice = normalised_takes(choice.rest, turned);
    return normalised_maps_rise_send(view.rise, w, choice.is_taken);
}

/// Density from a flight that meets facets, by its map, times `4 sigma(wo)`.
///
/// * `source`: the flight, and its share times the map's Jacobian as `w`.
///
/// Twin: specula-bsdf/src/multibounce/normalised/mod.rs, pdf.
fn normalised_sent(view: NormalisedView, normals: NormalsModel, wo: vec3f, source: vec4f) -> f32 {
    let stays = normalised_stays(view, normals, source.xyz);
    return source.w * stays * normalised_met(normals, wo, source.xyz);
}

/// The same, of a flight in parts along the grain, across it and upwards.
///
/// Twin: specula-bsdf/src/multibounce/normalised/mod.rs, pdf.
fn normalised_rolled_sent(
    view: NormalisedView,
    normals: NormalsModel,
    wo: vec3f,
    source: vec4f,
) -> f32 {
    let w = normalised_to_grain(view, source.xyz);
    return normalised_sent(view, normals, wo, vec4f(w, source.w));
}

/// Whether a random number lies below `share`, and the number rescaled from its part to `[0, 1)`.
///
/// Twin: specula-bsdf/src/multibounce/normalised/mod.rs, sample.
fn normalised_takes(choice: f32, share: f32) -> NormalisedChoice {
    if choice < share {
        return NormalisedChoice(true, choice / share);
    }
    return NormalisedChoice(false, (choice - share) / max(1.0 - share, NORMALISED_TINY));
}

/// The point of the other end of the height and of the other side.
///
/// Twin: specula-bsdf/src/multibounce/normalised/mod.rs, opposite.
fn normalised_opposite(u: vec2f) -> vec2f {
    return vec2f(1.0 - u.x, select(u.y - 0.5, u.y + 0.5, u.y < 0.5));
}

/// The flight after the first facet, of a point of the unit square.
///
/// Twin: specula-bsdf/src/multibounce/normalised/mod.rs, flight.
fn normalised_flight(normals: NormalsModel, wo: vec3f, u: vec2f) -> vec3f {
    let wm = normals_sample_wm(normals, wo, clamp(u, vec2f(0.0), vec2f(0.9999999)));
    return wm * (2.0 * dot(wo, wm)) - wo;
}

/// `D` of the facet that turns `wo` to `w`.
///
/// Twin: specula-bsdf/src/multibounce/normalised/mod.rs, met.
fn normalised_met(normals: NormalsModel, wo: vec3f, w: vec3f) -> f32 {
    let between = wo + w;
    let size = length(between);
    if between.z > 0.0 && size > 1e-6 {
        return normals_d(normals, between * (1.0 / size));
    }
    return 0.0;
}

/// How low a direction of height `mu` is for facets of this alpha.
///
/// Twin: specula-bsdf/src/multibounce/normalised/mod.rs, View::new.
fn normalised_low(mu: f32, alpha: f32, k: f32) -> f32 {
    let heights = mu / (k * alpha);
    return 1.0 / (alpha * (1.0 + heights * heights));
}

/// What the directions of a view share.
///
/// Twin: specula-bsdf/src/multibounce/normalised/mod.rs, View::new.
fn normalised_view(normals: NormalsModel, wo: vec3f) -> NormalisedView {
    let view = walk_flight(normals, -wo);
    let x = normals.alpha.x;
    let y = normals.alpha.y;
    let small = min(x, y);
    let large = max(x, y);
    let ratio = small / large;
    let unequal = 1.0 - ratio * ratio;
    let area = x * y;
    let fourth = area * area;
    let scale = sqrt(area);
    let mu = max(wo.z, 1e-6);
    let sine = wo.x * wo.x + wo.y * wo.y;
    let away = normalised_maps_horizontal(-wo, vec2f(1.0, 0.0));
    // The roughness that the view sees.
    let seen = length(normals.alpha * away);
    let smooth_part = max(1.0 - area, 0.0);
    let spread = 1.72 * smooth_part * sine + 0.0214 * normalised_low(mu, seen, 3.16);
    let is_smooth_along_x = x < y;
    let across = select(wo.x, wo.y, is_smooth_along_x);
    let mu_across = mu / sqrt(mu * mu + across * across);
    let large_squared = large * large;
    let large_fourth = large_squared * large_squared;
    return NormalisedView(
        mu,
        view.facing,
        view.rate,
        scale,
        vec2f(small, large),
        is_smooth_along_x,
        unequal * unequal,
        clamp(large / 4.07, 0.0, 1.0),
        clamp((scale - 0.59) / (3.26 - 0.59), 0.0, 1.0),
        NormalisedMapsRise(
            away,
            mu,
            1.0 / (1.0 + spread),
            0.281 + 0.0262 * normalised_low(mu, seen, 2.804),
            (0.353 + 0.157 * normalised_low(mu, seen, 2.23)) / mu,
            vec2f(fourth / (fourth + 0.0097), 0.49 * fourth / (fourth + 0.435)),
        ),
        NormalisedMapsRoll(
            mu,
            0.263 + 0.032 * normalised_low(mu_across, large, 1.64),
            0.319 / mu_across,
            0.917 * large_fourth / (large_fourth + 0.0154),
        ),
    );
}

/// Share of a flight that meets a facet.
///
/// Twin: specula-bsdf/src/multibounce/normalised/mod.rs, View::stays.
fn normalised_stays(view: NormalisedView, normals: NormalsModel, w: vec3f) -> f32 {
    if w.z <= 0.0 {
        return 1.0;
    }
    let lambda_cos = normals_lambda_cos(normals, w);
    return lambda_cos / max(lambda_cos + view.rate * w.z, NORMALISED_TINY);
}

/// A vector's parts along the grain, across it and upwards; and the vector of such parts.
///
/// Twin: specula-bsdf/src/multibounce/normalised/mod.rs, View::to_grain.
fn normalised_to_grain(view: NormalisedView, w: vec3f) -> vec3f {
    return select(w.yxz, w, view.is_smooth_along_x);
}
