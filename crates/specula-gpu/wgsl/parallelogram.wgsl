// Parallelograms that emit light: rectangles are sampled uniformly by solid angle, others by area.
//
// Source: Urena, Fajardo and King 2013, An Area-Preserving Parametrization for Spherical Rectangles.
// Departures: of the angles of the spherical rectangle their excess over a right angle is stored, so that their sum
// does not cancel against a full turn; the equation for `x` has no quotients of sines.
//
// Layout of a record, in words: corner, two edges, normal (3 each), area, two edges of length 1 (3 each), their
// lengths, the least solid angle at which it is sampled by solid angle, bound on the error of a point (3).

import tracer::angles::{angles_sin_cos_of_half, angles_turns, angles_with_sign};
import tracer::world::{number, vector};

/// Least denominator of a quotient.
const PARALLELOGRAM_LEAST: f32 = 1e-37;
/// A value that stands for infinity.
const PARALLELOGRAM_MOST: f32 = 3e38;

/// A sampled point of a parallelogram, as seen from another point.
struct ParallelogramSeen {
    /// The point.
    position: vec3f,
    /// Towards it, unit.
    wi: vec3f,
    /// In 1/sr; 0: there is no sample.
    pdf: f32,
}

/// A spherical rectangle: a rectangle as seen from a point, in the coordinates of its sides, whose origin is the
/// point.
struct ParallelogramSpread {
    /// Where it begins and ends along its first side.
    x: vec2f,
    /// The same along its second.
    y: vec2f,
    /// Distance to its plane.
    h: f32,
    /// Components along the normal of the planes through the point and the lower and upper side.
    b: vec2f,
    /// Excess of the last two angles over right angles, in turns.
    last: f32,
    /// Over 2 pi.
    solid_angle: f32,
}

/// Samples a point of the parallelogram at `at`, as seen from `p`.
///
/// * `u`: uniform in `[0, 1)^2`.
///
/// Twin: specula-render/src/light/parallelogram.rs, Parallelogram::sample.
fn parallelogram_sample(at: u32, p: vec3f, u: vec2f) -> ParallelogramSeen {
    let spread = parallelogram_spread(at, p);
    let solid_angle = 6.2831855 * spread.solid_angle;
    let by_angle = solid_angle >= number(at + 21u);
    var weights = u;
    if by_angle {
        weights = parallelogram_weights(spread, u, vec2f(number(at + 19u), number(at + 20u)));
    }
    let position = vector(at) + vector(at + 3u) * weights.x + vector(at + 6u) * weights.y;
    let d = position - p;
    let distance_squared = dot(d, d);
    if !(distance_squared > 0.0) {
        return ParallelogramSeen(position, vec3f(0.0), 0.0);
    }
    let wi = d * (1.0 / sqrt(distance_squared));
    if by_angle {
        return ParallelogramSeen(position, wi, 1.0 / solid_angle);
    }
    let projected = number(at + 12u) * abs(dot(vector(at + 9u), wi));
    return ParallelogramSeen(position, wi, parallelogram_ratio(distance_squared, projected));
}

/// Density in 1/sr with which the direction from `p` to the point `q` of the parallelogram at `at` is
/// sampled.
/// Twin: specula-render/src/light/parallelogram.rs, Parallelogram::pdf.
fn parallelogram_pdf(at: u32, p: vec3f, q: vec3f) -> f32 {
    let solid_angle = 6.2831855 * parallelogram_spread(at, p).solid_angle;
    if solid_angle >= number(at + 21u) {
        return 1.0 / solid_angle;
    }
    let d = q - p;
    let distance_squared = dot(d, d);
    if !(distance_squared > 0.0) {
        return 0.0;
    }
    let cosine = abs(dot(vector(at + 9u), d)) / sqrt(distance_squared);
    return parallelogram_ratio(distance_squared, number(at + 12u) * cosine);
}

/// A quotient of two values that are not negative; 0 where it is not finite.
fn parallelogram_ratio(a: f32, b: f32) -> f32 {
    if a >= PARALLELOGRAM_MOST * min(b, 1.0) {
        return 0.0;
    }
    return a / b;
}

/// The spherical rectangle of the parallelogram at `at`, as seen from `p`.
/// Twin: specula-render/src/light/parallelogram.rs, Parallelogram::spread.
fn parallelogram_spread(at: u32, p: vec3f) -> ParallelogramSpread {
    let d = vector(at) - p;
    let across = dot(d, vector(at + 13u));
    let along = dot(d, vector(at + 16u));
    let ends_x = vec2f(across, across + number(at + 19u));
    let ends_y = vec2f(along, along + number(at + 20u));
    let h = abs(dot(d, vector(at + 9u)));
    let left = -parallelogram_along(ends_x.x, h * h);
    let right = parallelogram_along(ends_x.y, h * h);
    let low = -parallelogram_along(ends_y.x, h * h);
    let high = parallelogram_along(ends_y.y, h * h);
    let last = parallelogram_excess(high * left) + parallelogram_excess(left * low);
    let first = parallelogram_excess(low * right) + parallelogram_excess(right * high);
    return ParallelogramSpread(ends_x, ends_y, h, vec2f(low, high), last, first + last);
}

/// `t / sqrt(t^2 + h^2)`.
fn parallelogram_along(t: f32, h_squared: f32) -> f32 {
    return t / sqrt(max(t * t + h_squared, PARALLELOGRAM_LEAST));
}

/// Excess of an angle over a right angle, in turns.
///
/// * `sine`: of the excess.
fn parallelogram_excess(sine: f32) -> f32 {
    return angles_turns(sine, sqrt(max((1.0 - sine) * (1.0 + sine), 0.0)));
}

/// Samples a point uniformly by solid angle: its coordinates along the two edges, in `[0, 1]`.
/// Twin: specula-render/src/light/parallelogram.rs, Spread::sample.
fn parallelogram_weights(spread: ParallelogramSpread, u: vec2f, sides: vec2f) -> vec2f {
    let h = spread.h;
    let sin_cos = angles_sin_cos_of_half(u.x * spread.solid_angle - spread.last);
    let q = sin_cos.y * spread.b.x + spread.b.y;
    let c = sin_cos.x * parallelogram_along(h, spread.y.x * spread.y.x);
    let rest = (q - c) * (q + c);
    // Where rounding leaves nothing below the root, the upper end.
    var x = spread.x.y;
    if rest > 0.0 {
        x = clamp(
            angles_with_sign(h * sin_cos.x, q * sin_cos.x) / sqrt(rest),
            spread.x.x,
            spread.x.y,
        );
    }
    let distance_squared = x * x + h * h;
    let begin = parallelogram_along(spread.y.x, distance_squared);
    let end = parallelogram_along(spread.y.y, distance_squared);
    let t = begin + u.y * (end - begin);
    let cosine_squared = max((1.0 - t) * (1.0 + t), 1e-12);
    let y = clamp(t * sqrt(distance_squared / cosine_squared), spread.y.x, spread.y.y);
    let along = vec2f(x - spread.x.x, y - spread.y.x);
    return clamp(along / max(sides, vec2f(PARALLELOGRAM_LEAST)), vec2f(0.0), vec2f(1.0));
}
