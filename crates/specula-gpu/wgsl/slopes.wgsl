// What a normal map's filter averages away, as alphas: LEAN mapping.
//
// Twin of specula-render/src/slopes.rs, which has the derivation and the sources.

import package::math::frame::{FrameBasis};

/// The slope of a normal that is at most so steep.
const SLOPES_STEEPEST: f32 = 10.0;
/// Share of a second moment that rounding may have left of it.
const SLOPES_ROUNDING: f32 = 1.0e-6;

/// How slopes of normals vary about their mean: a covariance (xx, xy, yy), and the axes of the slopes in the world.
///
/// Twin: specula-render/src/slopes.rs, SlopeSpread. Where nothing varies the covariance is 0.
struct SlopesSpread {
    covariance: vec3f,
    along_x: vec3f,
    along_y: vec3f,
}

/// How alphas grow.
///
/// Twin: specula-render/src/slopes.rs, Widening.
struct SlopesWidening {
    /// Squares of cosine and sine of the turn.
    squares: vec2f,
    /// Twice the variance along the turned axes.
    base: vec2f,
    /// Twice the mean variance of a clear coat that has a normal of its own.
    own_coat: f32,
    /// Cosine and sine of the angle by which the lobes' x axis turns.
    turn: vec2f,
}

/// The slope `(x, y) / z` of a normal; 0 of none.
///
/// Twin: specula-render/src/texture/raster/moments.rs, slope_of.
fn slopes_of_normal(n: vec3f) -> vec2f {
    let z = max(n.z, length(n.xy) / SLOPES_STEEPEST);
    return select(vec2f(0.0), n.xy / max(z, 1.0e-30), z > 0.0);
}

/// How slopes vary, by their moments.
///
/// * `scale`: factor on slopes.
///
/// Twin: specula-render/src/slopes.rs, SlopeSpread::new and SlopeCovariance::of.
fn slopes_spread(mean: vec2f, squares: vec3f, scale: f32, along_x: vec3f, along_y: vec3f) -> SlopesSpread {
    let squared = scale * scale;
    let of_axes = max((squares.xz - mean * mean) - SLOPES_ROUNDING * squares.xz, vec2f(0.0)) * squared;
    let most = sqrt(of_axes.x * of_axes.y);
    let mixed = clamp((squares.y - mean.x * mean.y) * squared, -most, most);
    // The projection's derivative at the mean is that of the axes, over the length of (p, q, 1).
    let shrunk = 1.0 / (1.0 + dot(mean, mean) * squared);
    return SlopesSpread(vec3f(of_axes.x, mixed, of_axes.y) * shrunk, along_x, along_y);
}

/// The covariance of slopes in a frame about the mean normal.
///
/// Twin: specula-render/src/slopes.rs, SlopeSpread::within.
fn slopes_within(spread: SlopesSpread, frame: FrameBasis) -> vec3f {
    let c = spread.covariance;
    let s = vec2f(dot(frame.s, spread.along_x), dot(frame.s, spread.along_y));
    let t = vec2f(dot(frame.t, spread.along_x), dot(frame.t, spread.along_y));
    return vec3f(
        s.x * s.x * c.x + 2.0 * s.x * s.y * c.y + s.y * s.y * c.z,
        s.x * t.x * c.x + (s.x * t.y + s.y * t.x) * c.y + s.y * t.y * c.z,
        t.x * t.x * c.x + 2.0 * t.x * t.y * c.y + t.y * t.y * c.z,
    );
}

/// The sum of the variances along two axes about the mean normal.
///
/// Twin: specula-render/src/slopes.rs, SlopeSpread::trace_about.
fn slopes_trace_about(spread: SlopesSpread, normal: vec3f) -> f32 {
    let c = spread.covariance;
    let a = dot(normal, spread.along_x);
    let b = dot(normal, spread.along_y);
    return max((1.0 - a * a) * c.x - 2.0 * a * b * c.y + (1.0 - b * b) * c.z, 0.0);
}

/// How alphas grow, and the angle by which the lobes' x axis turns.
///
/// * `map`: covariance (xx, xy, yy) of the normal map's slopes, in the frame of `alphas`.
/// * `own_coat`: sum of both variances of a clear coat with a normal of its own.
/// * `alphas`: of the material, 0 where it is smooth.
///
/// Twin: specula-render/src/slopes.rs, Widening::new.
fn slopes_widening(map: vec3f, own_coat: f32, alphas: vec2f) -> SlopesWidening {
    let own = 0.5 * alphas * alphas;
    let along = 2.0 * map.y;
    let across = (own.x + map.x) - (own.y + map.z);
    // Shaders' arc tangents of a zero differ, and that of (0, 0) is not defined.
    var turn = select(vec2f(1.0, 0.0), vec2f(0.0, 1.0), across < 0.0);
    if along != 0.0 {
        let angle = 0.5 * atan2(along, across);
        turn = vec2f(cos(angle), sin(angle));
    }
    let squares = turn * turn;
    let mixed = 2.0 * turn.x * turn.y * map.y;
    let base = 2.0 * vec2f(
        squares.x * map.x + mixed + squares.y * map.z,
        max(squares.y * map.x - mixed + squares.x * map.z, 0.0),
    );
    return SlopesWidening(squares, base, own_coat, turn);
}

/// The grown alphas along the turned axes.
///
/// Twin: specula-render/src/slopes.rs, Widening::of.
fn slopes_widened(w: SlopesWidening, alphas: vec2f) -> vec2f {
    let squared = alphas * alphas;
    return sqrt(vec2f(
        w.squares.x * squared.x + w.squares.y * squared.y + w.base.x,
        w.squares.y * squared.x + w.squares.x * squared.y + w.base.y,
    ));
}

/// The grown alpha of a layer that is isotropic.
///
/// Twin: specula-render/src/slopes.rs, Widening::of_isotropic.
fn slopes_widened_isotropic(w: SlopesWidening, alpha: f32) -> f32 {
    return sqrt(alpha * alpha + 0.5 * (w.base.x + w.base.y));
}

/// The grown alpha of a clear coat with a normal of its own.
///
/// Twin: specula-render/src/slopes.rs, Widening::of_own_coat.
fn slopes_widened_own_coat(w: SlopesWidening, alpha: f32) -> f32 {
    return sqrt(alpha * alpha + w.own_coat);
}
