// Lobes for light that has met so many facets that little is left of its first flight.
//
// Each coordinate of a lobe, `x` in (-1, 1), has the slope `s = x / sqrt(1 - x^2)`, and that Student's
// distribution with two degrees of freedom about `centre`, of scale `width`:
//
//     P(x) = 1/2 + t / (2 sqrt(1 + t^2)),   t = (s - centre) / width
//
// It is uniform in `x` for centre 0 and width 1, and its tails are those of GGX's slopes.

import package::math::arccosine::{arccosine};
import package::math::turns::{turns_sin_cos};
import package::multibounce::normalised_maps::{normalised_maps_at};

/// Distribution of a coordinate in (-1, 1).
///
/// Twin: specula-bsdf/src/multibounce/normalised/lobes.rs, Student.
struct NormalisedLobesStudent {
    /// Of the slope.
    centre: f32,
    /// Scale of the slope.
    width: f32,
}

/// Alike in all azimuths; the squared height is distributed.
///
/// Twin: specula-bsdf/src/multibounce/normalised/lobes.rs, Round.
struct NormalisedLobesRound {
    /// Of `2 z^2 - 1`.
    heights: NormalisedLobesStudent,
}

/// About the grain, which is the axis of less roughness: light that meets facets across it keeps its
/// component along it.
///
/// Twin: specula-bsdf/src/multibounce/normalised/lobes.rs, Cone.
struct NormalisedLobesCone {
    /// Of the component along the grain.
    along: NormalisedLobesStudent,
    /// Of the height about the grain.
    heights: NormalisedLobesStudent,
    /// Towards one side of the grain.
    skew: f32,
}

/// `P(x)` and `dP / dx`.
///
/// * `cosine`: `sqrt(1 - x^2)`, which cancels near the ends unless it is known otherwise.
///
/// Twin: specula-bsdf/src/multibounce/normalised/lobes.rs, Student::cumulative.
fn normalised_lobes_cumulative(
    student: NormalisedLobesStudent,
    x: f32,
    cosine: f32,
) -> vec2f {
    let least = max(cosine, 1e-9);
    let t = (x / least - student.centre) / student.width;
    let secant = sqrt(1.0 + t * t);
    let both = secant * least;
    return vec2f(0.5 + 0.5 * t / secant, 0.5 / (student.width * both * both * both));
}

/// The `x` of `P(x) = u`.
///
/// Twin: specula-bsdf/src/multibounce/normalised/lobes.rs, Student::inverse.
fn normalised_lobes_inverse(student: NormalisedLobesStudent, u: f32) -> f32 {
    let sine = 2.0 * u - 1.0;
    let cosine = sqrt(max(4.0 * u * (1.0 - u), 1e-18));
    let s = student.centre + student.width * (sine / cosine);
    return s / sqrt(1.0 + s * s);
}

/// The lobe of a view.
///
/// * `scale`: the geometric mean of the alphas.
/// * `mu`: `wo.z`.
///
/// Twin: specula-bsdf/src/multibounce/normalised/lobes.rs, Round::new.
fn normalised_lobes_round(scale: f32, mu: f32) -> NormalisedLobesRound {
    let height = 2.0 * mu * mu - 1.0;
    let blunt = 0.172 + 3.81 / scale;
    return NormalisedLobesRound(NormalisedLobesStudent(
        0.777 * height / sqrt(1.0 - height * height + blunt),
        2.7 / sqrt(5.7 + scale),
    ));
}

/// The point of the unit square that `normalised_lobes_round_direction` sends along `wi`, and the density.
///
/// Twin: specula-bsdf/src/multibounce/normalised/lobes.rs, Round::density.
fn normalised_lobes_round_density(lobe: NormalisedLobesRound, wi: vec3f) -> vec3f {
    let radius = sqrt(wi.x * wi.x + wi.y * wi.y);
    let height = 2.0 * wi.z * wi.z - 1.0;
    let below = normalised_lobes_cumulative(lobe.heights, height, 2.0 * wi.z * radius);
    let cosine = wi.x / max(radius, 1.1754944e-38);
    let angle = arccosine(min(abs(cosine), 1.0));
    let half_turns = 0.31830987 * select(angle, 3.1415927 - angle, cosine < 0.0);
    let turn = 0.5 + 0.5 * select(half_turns, -half_turns, wi.y < 0.0);
    return vec3f(1.0 - below.x, turn, 2.0 * below.y * wi.z * 0.31830987);
}

/// The direction of a point of the unit square.
///
/// Twin: specula-bsdf/src/multibounce/normalised/lobes.rs, Round::direction.
fn normalised_lobes_round_direction(lobe: NormalisedLobesRound, u: vec2f) -> vec3f {
    let squared = 0.5 + 0.5 * normalised_lobes_inverse(lobe.heights, 1.0 - u.x);
    // Half a turn less.
    let sin_cos = turns_sin_cos(u.y);
    return normalised_maps_at(vec2f(-sin_cos.y, -sin_cos.x), sqrt(max(squared, 0.0)));
}

/// The lobe of a view.
///
/// * `alphas`: the smaller one, which is along the grain, and the larger.
/// * `wo`: along and across the grain; `mu` is `wo.z`.
///
/// Twin: specula-bsdf/src/multibounce/normalised/lobes.rs, Cone::new.
fn normalised_lobes_cone(alphas: vec2f, wo: vec2f, mu: f32) -> NormalisedLobesCone {
    let small = alphas.x;
    let large = alphas.y;
    let radius_squared = mu * mu + wo.y * wo.y;
    let soft = 2.73 * small;
    let centre = -1.02 * wo.x / sqrt(radius_squared + soft * soft);
    let spread = 0.711 * sqrt(small / (1.0 + 0.14 * small));
    let height = 1.0 - 2.0 * abs(wo.y) / sqrt(max(radius_squared, 1.1754944e-38));
    let blunt = 0.28 + 0.18 / large;
    let skew = -0.866 * wo.y / (1.0 + 6.14 * large * large);
    return NormalisedLobesCone(
        NormalisedLobesStudent(centre, spread * sqrt(1.0 + centre * centre)),
        NormalisedLobesStudent(
            0.484 * height / sqrt(1.0 - height * height + blunt),
            2.0 / sqrt(0.66 + large),
        ),
        clamp(skew, -0.9, 0.9),
    );
}

/// The point of the unit square that `normalised_lobes_cone_direction` sends to a direction of these parts along
/// the grain, across it and upwards, and the density.
///
/// Twin: specula-bsdf/src/multibounce/normalised/lobes.rs, Cone::density.
fn normalised_lobes_cone_density(lobe: NormalisedLobesCone, parts: vec3f) -> vec3f {
    let radius = max(sqrt(parts.y * parts.y + parts.z * parts.z), 1e-6);
    let along = normalised_lobes_cumulative(lobe.along, parts.x, radius);
    // (c + k) / (1 + k c) moves what goes to both sides alike; `less` and `more` are 1 - c and 1 + c.
    let k = lobe.skew;
    let c = parts.y / radius;
    let near_side = parts.z * parts.z / (radius * (radius + abs(parts.y)));
    let far_side = 1.0 + abs(c);
    let is_left = c < 0.0;
    let less = select(near_side, far_side, is_left) * (1.0 + k);
    let more = select(far_side, near_side, is_left) * (1.0 - k);
    let inverse = 1.0 / (1.0 - k * c);
    let moved = (1.0 - k * k) * inverse * inverse;
    let even = 0.5 * (more - less) * inverse;
    let rest = min(less, more) * inverse;
    let cosine = 2.0 * sqrt(abs(even) * rest);
    let below = normalised_lobes_cumulative(lobe.heights, 2.0 * rest - 1.0, cosine);
    let outwards = 0.5 * (1.0 - below.x);
    // Half a turn is added, so that the sides meet where the square's do.
    let v = select(outwards, 1.0 - outwards, even < 0.0);
    return vec3f(along.x, v, along.y * below.y * moved * parts.z / radius);
}

/// The direction of a point of the unit square, as parts along the grain, across it and upwards.
///
/// Twin: specula-bsdf/src/multibounce/normalised/lobes.rs, Cone::direction.
fn normalised_lobes_cone_direction(lobe: NormalisedLobesCone, u: vec2f) -> vec3f {
    let along = normalised_lobes_inverse(lobe.along, u.x);
    let radius = sqrt(max((1.0 - along) * (1.0 + along), 0.0));
    let is_left = u.y >= 0.5;
    let outwards = 2.0 * select(u.y, 1.0 - u.y, is_left);
    let side = 0.5 - 0.5 * normalised_lobes_inverse(lobe.heights, 1.0 - outwards);
    let even = select(side, -side, is_left);
    let k = lobe.skew;
    let c = (even + k) / (1.0 + k * even);
    return vec3f(along, radius * c, radius * sqrt(max(1.0 - c * c, 0.0)));
}
