// The angle of a vector in the plane, without tables.
//
// `atan(t) = t P(t^2)` for `t` in [0, 1], where `P` is smooth; the rest follows by reflections. The
// coefficients are a Chebyshev fit over [0, 1]. The built-in function may be wrong by thousands of ulps, and is
// not defined at the origin.

/// The angle from the x axis to `(x, y)` in radians, in [-pi, pi]; 0 at the origin. Relative error at most 3e-7.
///
/// Twin: specula-bsdf/src/math/real.rs, Real::atan2.
fn arctangent(y: f32, x: f32) -> f32 {
    let largest = max(abs(x), abs(y));
    if !(largest > 0.0) {
        return 0.0;
    }
    let t = min(abs(x), abs(y)) / largest;
    let s = t * t;
    let high = ((0.0027662835 * s - 0.015731249) * s + 0.042137623) * s - 0.07456855;
    let middle = ((high * s + 0.10618371) * s - 0.14197798) * s + 0.19991872;
    let small = t * ((middle * s - 0.33333036) * s + 1.0);
    let upper = select(small, 1.5707963 - small, abs(y) > abs(x));
    let turned = select(upper, 3.1415927 - upper, x < 0.0);
    return select(turned, -turned, y < 0.0);
}
