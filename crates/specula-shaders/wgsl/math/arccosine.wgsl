// The arc cosine of a number in [0, 1], without branches or tables.
//
// `acos(x) = sqrt(1 - x) P(x)`, where `P` is smooth: the root takes the singularity at 1. The
// coefficients are a Chebyshev fit over [0, 1]. The built-in function may be wrong by 7e-5.

/// `acos(x)` in radians for `x` in [0, 1]; absolute error at most 3e-7.
///
/// Twin: specula-bsdf/src/math/arccosine.rs, acos.
fn arccosine(x: f32) -> f32 {
    let high = ((-0.00123700485 * x + 0.00658088524) * x - 0.016965472) * x + 0.0308082534;
    let middle = ((high * x - 0.050145025) * x + 0.0889740993) * x - 0.214598494;
    return sqrt(max(1.0 - x, 0.0)) * (middle * x + 1.5707963);
}
