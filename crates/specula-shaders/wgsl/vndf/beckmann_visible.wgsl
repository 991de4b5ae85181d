// Visible Beckmann normals by inversion (Heitz and d'Eon 2014; Jakob 2014).
//
// In the space of unit roughness, turned so that the view lies in the x-z plane, the slopes `(x, y)`
// seen from a view with `a = cot theta` are independent:
//
//     p(y) = exp(-y^2) / sqrt(pi),      p(x) ~ (a - x) exp(-x^2)   for x < a
//
// `y` is an inverse error function. `x` is the root of its distribution function. The map from `u` is
// monotone, so that stratified points stay stratified.
//
// Departure from the Rust source, which finds the root in f64: here it is found in f32. With the scaled
// complementary error function `E(x) = exp(x^2) erfc(x)` and `g(x) = 1 - sqrt(pi) x E(x)` nothing
// cancels or underflows in the tails, and Newton's method on the logarithm of a log-concave function
// converges from everywhere. With `c, s` the cosine and the sine of the stretched view:
//
//     from above, x <= 0:   C(x) = exp(-x^2) (c E(-x) + s / sqrt(pi)) / 2,              target u A
//                 x >= 0:   U(x) = (exp(-x^2) ((c - s x) sqrt(pi) E(x) - s g(x))
//                                   + s exp(-a^2) g(a)) / (2 sqrt(pi)),         target (1 - u) A
//                           A = c + s exp(-a^2) g(a) / (2 sqrt(pi))
//     from below, y = a - x, b = -a:   S(y) = exp(-y^2 - 2 b y) (g(y + b) + y sqrt(pi) E(y + b)),
//                                      target u S(0)

import package::alpha::{alpha_stretch};
import package::math::erf::{erf_deficit, erf_inverse_uniform, erf_scaled_complement};
import package::ndf::beckmann::{beckmann_d, beckmann_d_visible, beckmann_projected_area};

/// Steps of Newton's method at most.
const BECKMANN_VISIBLE_STEPS: u32 = 24u;

/// A visible normal, unit, with `wm.z > 0`.
///
/// * `wo`: unit, any hemisphere.
/// * `u`: uniform in [0, 1)^2; `u.x` is the slope along the view, `u.y` the one across.
///
/// Twin: specula-bsdf/src/vndf/beckmann.rs, sample_wm.
fn beckmann_visible_sample_wm(alpha: vec2f, wo: vec3f, u: vec2f) -> vec3f {
    let i = alpha_stretch(alpha, wo);
    let sine = sqrt(i.x * i.x + i.y * i.y);
    let phi = select(vec2f(1.0, 0.0), i.xy / max(sine, 1e-18), sine > 1e-18);
    let along = beckmann_visible_slope_along(i.z, sine, u.x);
    let across = erf_inverse_uniform(u.y);
    let slope = along * phi + across * vec2f(-phi.y, phi.x);
    return normalize(alpha_stretch(alpha, vec3f(-slope, 1.0)));
}

/// Density of `beckmann_visible_sample_wm`, `D(wm) max(wo . wm, 0) / sigma(wo)`, in 1/sr.
///
/// Twin: specula-bsdf/src/vndf/beckmann.rs, pdf_wm.
fn beckmann_visible_pdf_wm(alpha: vec2f, wo: vec3f, wm: vec3f) -> f32 {
    return beckmann_d_visible(alpha, wo, wm);
}

/// Density of the reflections of `wo` off its normals in 1/sr: `D(wm) / (4 sigma(wo))`; 0 where
/// `wi.z <= 0`.
///
/// Twin: specula-bsdf/src/vndf/beckmann.rs, reflection_pdf.
fn beckmann_visible_reflection_pdf(alpha: vec2f, wo: vec3f, wi: vec3f) -> f32 {
    let m = wo + wi;
    if wi.z <= 0.0 || m.z <= 0.0 {
        return 0.0;
    }
    return beckmann_d(alpha, normalize(m)) / (4.0 * beckmann_projected_area(alpha, wo));
}

/// The slope `x` with distribution function `u`, seen from a view `(sine, 0, cosine)`.
///
/// Twin: specula-bsdf/src/vndf/beckmann.rs, slope_along.
fn beckmann_visible_slope_along(cosine: f32, sine: f32, u: f32) -> f32 {
    let b = min(abs(cosine) / max(sine, 1e-18), 1e9);
    if cosine < 0.0 {
        return -b - beckmann_visible_excess_below(b, u);
    }
    let hidden = sine * exp(-(b * min(b, 1e4))) * erf_deficit(b);
    let area = cosine + 0.2820948 * hidden;
    if u * area < 0.5 * cosine + 0.2820948 * sine {
        return beckmann_visible_slope_away(cosine, sine, u * area);
    }
    return beckmann_visible_slope_towards(cosine, sine, (1.0 - u) * area, hidden);
}

/// Root `x <= 0` of `C(x) = goal`.
///
/// Twin: specula-bsdf/src/vndf/beckmann.rs, slope_from_above.
fn beckmann_visible_slope_away(cosine: f32, sine: f32, goal: f32) -> f32 {
    // A zero goal would mean an endless tail.
    let wanted = log(max(goal, 1e-30 * (cosine + sine)));
    var x = 0.0;
    for (var i = 0u; i < BECKMANN_VISIBLE_STEPS; i++) {
        let scaled = 0.5 * cosine * erf_scaled_complement(-x) + 0.2820948 * sine;
        let excess = log(scaled) - x * x - wanted;
        // Along the surface the first slope is 0.
        let slope = max(0.5641896 * (cosine - sine * x) / scaled, 1e-30);
        let next = clamp(x - excess / slope, -30.0, 0.0);
        let is_done = abs(next - x) <= 3e-7 * (1.0 - next);
        x = next;
        if is_done {
            break;
        }
    }
    return x;
}

/// Root `x` in `[0, a]` of `U(x) = goal`.
///
/// * `hidden`: `s exp(-a^2) g(a)`.
///
/// Twin: specula-bsdf/src/vndf/beckmann.rs, slope_from_above.
fn beckmann_visible_slope_towards(cosine: f32, sine: f32, goal: f32, hidden: f32) -> f32 {
    let wanted = log(max(goal, 1e-30 * (cosine + sine)));
    var low = 0.0;
    var high = min(cosine / max(sine, 1e-18), 9.0);
    var x = 0.0;
    for (var i = 0u; i < BECKMANN_VISIBLE_STEPS; i++) {
        let falloff = exp(-(x * x));
        let rise = cosine - sine * x;
        let seen = rise * 1.7724539 * erf_scaled_complement(x) - sine * erf_deficit(x);
        let rest = 0.2820948 * max(falloff * seen + hidden, 1e-30 * (cosine + sine));
        let excess = log(rest) - wanted;
        if excess > 0.0 {
            low = x;
        } else {
            high = x;
        }
        let step = x + excess * rest / max(0.5641896 * falloff * rise, 1e-37);
        let next = select(0.5 * (low + high), step, step >= low && step <= high);
        let is_done = abs(next - x) <= 3e-7 * (1.0 + next);
        x = next;
        if is_done {
            break;
        }
    }
    return x;
}

/// Root `y` of `S(y) = u S(0)` for a view with `b = -cot theta > 0`.
///
/// Twin: specula-bsdf/src/vndf/beckmann.rs, excess_from_below.
fn beckmann_visible_excess_below(b: f32, u: f32) -> f32 {
    // A zero u would mean an endless tail.
    let wanted = log(max(u, 1e-16));
    let whole = log(erf_deficit(b));
    let guess = 1.0 - wanted;
    var y = guess / (b + sqrt(b * b + guess));
    for (var i = 0u; i < BECKMANN_VISIBLE_STEPS; i++) {
        let scaled = erf_deficit(y + b) + y * 1.7724539 * erf_scaled_complement(y + b);
        let excess = log(scaled) - whole - y * (y + 2.0 * b) - wanted;
        let next = max(y + 0.5 * excess * scaled / y, 0.01 * y);
        let is_done = abs(next - y) <= 3e-7 * next;
        y = next;
        if is_done {
            break;
        }
    }
    return y;
}
