// The sine of a fraction of a quarter of a turn, all of whose digits count.
//
// `sin(pi q / 2) = q P(q^2)`. The coefficients are a Chebyshev fit over [0, 1]. `turns_sin_cos` is as close, but
// not relative to small sines; the built-in function may be wrong by 5e-4.

/// `sin(pi q / 2)` for `q` in [0, 1]; relative error at most 3e-7. The cosine of the angle is the sine of `1 - q`.
///
/// Twin: specula-bsdf/src/math/real.rs, Real::sin.
fn quarter_sine(q: f32) -> f32 {
    let s = q * q;
    let high = (0.0001516717 * s - 0.0046741436) * s + 0.07968992;
    return q * ((high * s - 0.6459638) * s + 1.5707964);
}
