// The complementary error function, scaled and not, and the inverse of the error function.
//
// Departure from the Rust source, which calls a library: both fits are in `s = (x - k) / (x + k)`,
// which maps [0, inf) to [-1, 1) (the form of Shepherd and Laframboise 1981, Chebyshev Approximation
// of (1 + 2x) exp(x^2) erfc(x)), with coefficients computed in 40 digits; errors of rounding included
// they are at most 2 units of the last place.

/// `exp(x^2) erfc(x)` for `x >= 0`.
///
/// Twin: specula-bsdf/src/math/real.rs, erfc, times the exponential.
fn erf_scaled_complement(x: f32) -> f32 {
    let s = (x - 2.0) / (x + 2.0);
    let high = ((0.000165867579 * s - 0.000182478015) * s - 0.00140835775) * s + 0.0010404808;
    let middle = ((high * s + 0.00870021721) * s - 0.00794070691) * s - 0.0542159009;
    let low = ((middle * s + 0.164035273) * s - 0.166030604) * s - 0.0927630388;
    return (low * s + 1.27697838) / (1.0 + 2.0 * x);
}

/// `1 - erf(x)`, precise where that is small but for what the exponential loses.
///
/// Twin: specula-bsdf/src/math/real.rs, erfc.
fn erf_complement(x: f32) -> f32 {
    let tail = exp(-(x * x)) * erf_scaled_complement(abs(x));
    return select(2.0 - tail, tail, x >= 0.0);
}

/// `1 - sqrt(pi) x exp(x^2) erfc(x)` for `x >= 0`, without its cancellation: 1 at 0, `1 / (2 x^2)` for
/// large `x`.
///
/// Twin: specula-bsdf/src/ndf/beckmann.rs, lambda_cos, of the two terms that cancel there.
fn erf_deficit(x: f32) -> f32 {
    let s = (x - 3.0) / (x + 3.0);
    let high = ((0.000377919867 * s - 0.000254115298) * s - 0.00321355289) * s + 0.00531839639;
    let middle = ((high * s + 0.012332381) * s - 0.0594959846) * s + 0.100104405;
    let low = ((middle * s - 0.058854759) * s - 0.0914059793) * s + 0.23926832;
    let sum = ((low * s - 0.189955454) * s - 0.125981857) * s + 1.17176029;
    return sum / (1.0 + x * (2.0 * x + 1.7724539));
}

/// The number whose error function is `2 u - 1`, for `u` in [0, 1).
///
/// In terms of `u`, so that `1 - (2 u - 1)^2 = 4 u (1 - u)` does not cancel. A `u` of 0 is taken as half
/// a step of 2^-24.
///
/// Source: Giles 2010, Approximating the erfinv function, table 5.
///
/// Twin: specula-bsdf/src/vndf/beckmann.rs, erf_inverse.
fn erf_inverse_uniform(u: f32) -> f32 {
    let x = 2.0 * u - 1.0;
    let w = -log(4.0 * max(u, 2.9802322e-8) * (1.0 - u));
    if w < 5.0 {
        let s = w - 2.5;
        let high = ((2.81022636e-8 * s + 3.43273939e-7) * s - 3.5233877e-6) * s - 4.39150654e-6;
        let middle = ((high * s + 0.00021858087) * s - 0.00125372503) * s - 0.00417768164;
        return x * ((middle * s + 0.246640727) * s + 1.50140941);
    }
    let s = sqrt(w) - 3.0;
    let high = ((-0.000200214257 * s + 0.000100950558) * s + 0.00134934322) * s - 0.00367684245;
    let middle = ((high * s + 0.00573950773) * s - 0.0076224613) * s + 0.00943887047;
    return x * ((middle * s + 1.00167406) * s + 2.83297682);
}
