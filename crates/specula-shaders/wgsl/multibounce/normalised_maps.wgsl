// Maps of the sphere to the upper hemisphere: where light that stays is sent, by its first flight.

/// A floor of divisors.
const NORMALISED_MAPS_TINY: f32 = 1.1754944e-38;
/// `e` of turned upward flights.
const NORMALISED_MAPS_TURNED_UP: f32 = 1.844;
/// `e` of turned downward flights, times `wo.z`.
const NORMALISED_MAPS_TURNED_DOWN: f32 = 0.65;
/// `e` of turned upward flights that are rolled.
const NORMALISED_MAPS_ROLLED_UP: f32 = 0.88;
/// `e` of turned downward flights that are rolled.
const NORMALISED_MAPS_ROLLED_DOWN: f32 = 0.23;

/// Raises flights, and spreads their azimuths about the forward direction.
///
/// Twin: specula-bsdf/src/multibounce/normalised/maps.rs, Rise.
struct NormalisedMapsRise {
    /// Horizontal, unit: away from the viewer.
    away: vec2f,
    /// `wo.z`, above 0: downward flights are above `-mu`.
    mu: f32,
    /// `tan(phi / 2) = kappa tan(phi' / 2)`.
    kappa: f32,
    /// `e` of upward flights.
    up: f32,
    /// `e` of downward flights.
    down: f32,
    /// Shares of upward and of downward flights whose order is turned: the highest end lowest.
    turned: vec2f,
}

/// Rolls flights about the grain: an upward one stays on its side, a downward one goes on to the other.
///
/// Twin: specula-bsdf/src/multibounce/normalised/maps.rs, Roll.
struct NormalisedMapsRoll {
    /// `wo.z`.
    mu: f32,
    /// `e` of upward flights.
    up: f32,
    /// `e` of downward flights.
    down: f32,
    /// Share of flights whose order is turned: the highest end lowest.
    turned: f32,
}

/// Four flights that maps send along a given direction, with their shares times Jacobians as `w`.
///
/// Twin: specula-bsdf/src/multibounce/normalised/maps.rs, Rise::back.
struct NormalisedMapsSources {
    /// Upward, raised.
    up: vec4f,
    /// Upward, turned.
    up_turned: vec4f,
    /// Downward, raised.
    down: vec4f,
    /// Downward, turned.
    down_turned: vec4f,
}

/// `u = M(s; e)` and `du / ds`.
///
/// Twin: specula-bsdf/src/multibounce/normalised/maps.rs, odds.
fn normalised_maps_odds(s: f32, e: f32) -> vec2f {
    let up = e * s;
    let sum = max(up + (1.0 - s), NORMALISED_MAPS_TINY);
    return vec2f(up / sum, (e / sum) / sum);
}

/// The `s` of `M(s; e) = u`, and `1 - s`.
///
/// Twin: specula-bsdf/src/multibounce/normalised/maps.rs, odds_inverse.
fn normalised_maps_odds_inverse(u: f32, e: f32) -> vec2f {
    let rest = e * (1.0 - u);
    return vec2f(u, rest) / max(u + rest, NORMALISED_MAPS_TINY);
}

/// The direction of height `z` towards a horizontal unit vector.
///
/// Twin: specula-bsdf/src/multibounce/normalised/maps.rs, at.
fn normalised_maps_at(towards: vec2f, z: f32) -> vec3f {
    let r = sqrt(max((1.0 - z) * (1.0 + z), 0.0));
    return vec3f(towards * r, z);
}

/// The unit vector along the horizontal part of `w`; `otherwise` where it has none.
///
/// Twin: specula-bsdf/src/multibounce/normalised/maps.rs, horizontal.
fn normalised_maps_horizontal(w: vec3f, otherwise: vec2f) -> vec2f {
    let size = sqrt(w.x * w.x + w.y * w.y);
    if size > 1e-6 {
        return w.xy / size;
    }
    return otherwise;
}

/// The half-angle from the forward direction, its tangent times `k`: the horizontal direction that
/// it leads to, and the derivative of the angle.
///
/// * `k`: `kappa` gathers what its inverse scatters.
///
/// Twin: specula-bsdf/src/multibounce/normalised/maps.rs, Rise::turn.
fn normalised_maps_turn(away: vec2f, w: vec3f, k: f32) -> vec3f {
    let towards = normalised_maps_horizontal(w, away);
    let along = towards.x * away.x + towards.y * away.y;
    let across = towards.y * away.x - towards.x * away.y;
    let near_part = 1.0 + along;
    let far_part = k * k * (1.0 - along);
    let scale = 1.0 / (near_part + far_part);
    let turned_along = (near_part - far_part) * scale;
    let turned_across = 2.0 * k * across * scale;
    return vec3f(
        turned_along * away.x - turned_across * away.y,
        turned_along * away.y + turned_across * away.x,
        2.0 * k * scale,
    );
}

/// The flights that are sent along `wi`.
///
/// Twin: specula-bsdf/src/multibounce/normalised/maps.rs, Rise::back.
fn normalised_maps_rise_back(rise: NormalisedMapsRise, wi: vec3f) -> NormalisedMapsSources {
    let gathered = normalised_maps_turn(rise.away, wi, rise.kappa);
    let s = wi.z * wi.z;
    let jacobian = 2.0 * wi.z * gathered.z;
    let towards = gathered.xy;
    let up = normalised_maps_odds(s, rise.up);
    let up_turned = normalised_maps_odds(s, NORMALISED_MAPS_TURNED_UP);
    let down = normalised_maps_odds(s, rise.down);
    let down_turned = normalised_maps_odds(s, NORMALISED_MAPS_TURNED_DOWN / rise.mu);
    let mu = rise.mu;
    let turned = rise.turned;
    return NormalisedMapsSources(
        vec4f(normalised_maps_at(towards, up.x), jacobian * up.y * (1.0 - turned.x)),
        vec4f(normalised_maps_at(towards, 1.0 - up_turned.x), jacobian * up_turned.y * turned.x),
        vec4f(normalised_maps_at(towards, -mu * down.x), jacobian * down.y * (1.0 - turned.y) * mu),
        vec4f(
            normalised_maps_at(towards, -mu * (1.0 - down_turned.x)),
            jacobian * down_turned.y * turned.y * mu,
        ),
    );
}

/// The direction that the flight `w` is sent to.
///
/// Twin: specula-bsdf/src/multibounce/normalised/maps.rs, Rise::send.
fn normalised_maps_rise_send(rise: NormalisedMapsRise, w: vec3f, is_turned: bool) -> vec3f {
    let towards = normalised_maps_turn(rise.away, w, 1.0 / rise.kappa).xy;
    let is_up = w.z > 0.0;
    let u = clamp(select(-w.z / rise.mu, w.z, is_up), 0.0, 1.0);
    let raised = select(rise.down, rise.up, is_up);
    let turned = select(NORMALISED_MAPS_TURNED_DOWN / rise.mu, NORMALISED_MAPS_TURNED_UP, is_up);
    var s = normalised_maps_odds_inverse(u, raised);
    if is_turned {
        s = normalised_maps_odds_inverse(1.0 - u, turned);
    }
    let lifted = sqrt(max(s, vec2f(0.0)));
    return vec3f(towards * lifted.y, lifted.x);
}

/// One flight of `normalised_maps_roll_back`.
///
/// Twin: specula-bsdf/src/multibounce/normalised/maps.rs, Roll::back.
fn normalised_maps_rolled(
    roll: NormalisedMapsRoll,
    parts: vec3f,
    e: f32,
    is_turned: bool,
    is_up: bool,
) -> vec4f {
    let across = parts.y;
    let radius = max(sqrt(across * across + parts.z * parts.z), 1e-12);
    let cosine = across / radius;
    let sine = parts.z / radius;
    let jacobian = 2.0 * sine * abs(cosine);
    // Downward flights are above `-mu`.
    let top = select(min(roll.mu / radius, 1.0), 1.0, is_up);
    let odds = normalised_maps_odds(sine * sine, e);
    // t, and 1 - t without cancellation where the top is 1.
    var t = top * odds.x;
    var rest = 1.0 - top + top * (1.0 - odds.x);
    var share = 1.0 - roll.turned;
    if is_turned {
        t = top * (1.0 - odds.x);
        rest = 1.0 - top + top * odds.x;
        share = roll.turned;
    }
    let side = sqrt(max(rest * (1.0 + t), 1e-12));
    let side_sign = select(1.0, -1.0, (across < 0.0) == is_up);
    let height = select(-t, t, is_up);
    return vec4f(
        parts.x,
        radius * side * side_sign,
        radius * height,
        share * jacobian * odds.y * top / side,
    );
}

/// The flights that are sent along a direction of these parts along the grain, across it and upwards.
///
/// With the sine `t` of the elevation about the grain, `d omega = d along d t / sqrt(1 - t^2)`.
///
/// Twin: specula-bsdf/src/multibounce/normalised/maps.rs, Roll::back.
fn normalised_maps_roll_back(roll: NormalisedMapsRoll, parts: vec3f) -> NormalisedMapsSources {
    return NormalisedMapsSources(
        normalised_maps_rolled(roll, parts, roll.up, false, true),
        normalised_maps_rolled(roll, parts, NORMALISED_MAPS_ROLLED_UP, true, true),
        normalised_maps_rolled(roll, parts, roll.down, false, false),
        normalised_maps_rolled(roll, parts, NORMALISED_MAPS_ROLLED_DOWN, true, false),
    );
}

/// The direction that a flight is sent to; both as parts along the grain, across it and upwards.
///
/// Twin: specula-bsdf/src/multibounce/normalised/maps.rs, Roll::send.
fn normalised_maps_roll_send(roll: NormalisedMapsRoll, parts: vec3f, is_turned: bool) -> vec3f {
    let across = parts.y;
    let radius = max(sqrt(across * across + parts.z * parts.z), 1e-12);
    let is_up = parts.z > 0.0;
    let top = select(min(roll.mu / radius, 1.0), 1.0, is_up);
    let t = clamp(abs(parts.z) / (radius * top), 0.0, 1.0);
    let raised = select(roll.down, roll.up, is_up);
    let turned = select(NORMALISED_MAPS_ROLLED_DOWN, NORMALISED_MAPS_ROLLED_UP, is_up);
    var s = normalised_maps_odds_inverse(t, raised);
    if is_turned {
        s = normalised_maps_odds_inverse(1.0 - t, turned);
    }
    let side_sign = select(1.0, -1.0, (across < 0.0) == is_up);
    let lifted = radius * sqrt(max(s, vec2f(0.0)));
    return vec3f(parts.x, lifted.y * side_sign, lifted.x);
}
