// Sine and cosine of a fraction of a turn, without branches, tables or range reduction.
//
// With `t = 1/2 - u`, both follow from `s = sin(pi t)` and `c = cos(pi t)` on half a turn, where
// polynomials are short: `sin(2 pi u) = 2 s c` and `cos(2 pi u) = 2 s^2 - 1`. The coefficients are
// Chebyshev fits in `t^2` over [0, 1/4]. The built-in functions are not used: their errors differ
// between GPUs and are bounded near 0 only.

/// `(sin(2 pi u), cos(2 pi u))` for `u` in [0, 1]; absolute error at most 1e-6.
///
/// Twin: specula-bsdf/src/math/turns.rs, sin_cos_f32.
fn turns_sin_cos(u: f32) -> vec2f {
    let t = 0.5 - u;
    let x = t * t;
    let sine = ((0.15531182 * x - 1.1965808) * x + 5.1001548) * x - 10.33542;
    let twice_sine = t * (sine * x + 6.2831855);
    let high = ((-0.024395932 * x + 0.23493707) * x - 1.335212) * x + 4.058709;
    let cosine = (high * x - 4.934802) * x + 1.0;
    return vec2f(twice_sine * cosine, twice_sine * (0.5 * twice_sine) - 1.0);
}
