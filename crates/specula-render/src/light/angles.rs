//! Sines of angles and angles of points, as polynomials without branches: loops over batches become vectors
//! of them.
//!
//! The coefficients are Chebyshev fits in the square of the argument, computed in 40 digits.

/// `sin(pi t)` for `t` in `[-1/2, 1/2]`; relative error at most 3e-7.
#[inline(always)]
fn sine(t: f32) -> f32 {
    const TERMS: [f32; 4] = [-0.598_290_4, 2.550_077_4, -5.167_71, core::f32::consts::PI];
    let x = t * t;
    let mut sum = 0.077_655_91;
    for c in TERMS {
        sum = sum * x + c;
    }
    t * sum
}

/// `(sin(pi v), cos(pi v))` for `v` in `[0, 1]`; relative error of the sine at most 3e-7.
#[inline(always)]
pub(super) fn sin_cos_half_turns(v: f32) -> (f32, f32) {
    let from_end = 1.0 - v;
    (sine(if v < from_end { v } else { from_end }), sine(0.5 - v))
}

/// `(sin(2 pi u), cos(2 pi u))` for `u` in `[0, 1]`; absolute error at most 3e-7.
#[inline(always)]
pub(super) fn sin_cos_turns(u: f32) -> (f32, f32) {
    // Half a turn away both change their signs.
    let (sin, cos) = sin_cos_of_half(u - 0.5);
    (-sin, -cos)
}

/// The same for `u` in `[-1/2, 1/2]`.
#[inline(always)]
pub(super) fn sin_cos_of_half(u: f32) -> (f32, f32) {
    let size = u.abs();
    let fold = (0.5 - size).copysign(u);
    let folded = if size > 0.25 { fold } else { u };
    (sine(2.0 * folded), sine(0.5 - 2.0 * size))
}

/// The angle of the point `(x, y)` in turns, in `[-1/2, 1/2]`; 0 at the origin. Absolute error at most
/// 1e-7.
#[inline(always)]
pub(super) fn turns(y: f32, x: f32) -> f32 {
    const TERMS: [f32; 8] = [
        -0.002_503_706,
        0.006_706_411,
        -0.011_867_953,
        0.016_899_662,
        -0.022_596_497,
        0.031_818_05,
        -0.053_051_176,
        0.159_154_94,
    ];
    let (ax, ay) = (x.abs(), y.abs());
    let steep = ay > ax;
    let (low, high) = if steep { (ax, ay) } else { (ay, ax) };
    let t = if high > 0.0 { low / high } else { 0.0 };
    let z = t * t;
    let mut sum = 0.000_440_267_7;
    for c in TERMS {
        sum = sum * z + c;
    }
    let eighth = t * sum;
    let quarter = if steep { 0.25 - eighth } else { eighth };
    let half = if x < 0.0 { 0.5 - quarter } else { quarter };
    half.copysign(y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::{PI, TAU};

    #[test]
    fn errors_stay_within_the_stated_bounds() {
        let (mut sines, mut relative, mut angles) = (0.0_f64, 0.0_f64, 0.0_f64);
        for i in 0..=200_000_u32 {
            let u = i as f32 / 200_000.0;
            let apart = |(s, c): (f32, f32), angle: f64| {
                let (sin, cos) = angle.sin_cos();
                (f64::from(s) - sin).abs().max((f64::from(c) - cos).abs())
            };
            sines = sines.max(apart(sin_cos_turns(u), TAU * f64::from(u)));
            sines = sines.max(apart(sin_cos_half_turns(u), PI * f64::from(u)));
            if u > 0.0 && u < 1.0 {
                // Near 1 by the sine's symmetry: pi itself has too few digits.
                let exact = (PI * f64::from(u.min(1.0 - u))).sin();
                let found = f64::from(sin_cos_half_turns(u).0);
                relative = relative.max((found / exact - 1.0).abs());
            }
            for scale in [1e-18_f32, 1.0, 1e18] {
                let angle = TAU * f64::from(u);
                let (y, x) = (
                    crate::convert::narrow(angle.sin()) * scale,
                    crate::convert::narrow(angle.cos()) * scale,
                );
                let exact = f64::from(y).atan2(f64::from(x)) / TAU;
                angles = angles.max((f64::from(turns(y, x)) - exact).abs());
            }
        }
        assert!(sines < 3e-7, "{sines:e}");
        assert!(relative < 3e-7, "{relative:e}");
        assert!(angles < 1e-7, "{angles:e}");
    }

    #[test]
    fn axes_and_the_origin_have_angles() {
        for (y, x, expected) in [
            (0.0, 1.0, 0.0),
            (1.0, 0.0, 0.25),
            (0.0, -1.0, 0.5),
            (-0.0, -1.0, -0.5),
            (-1.0, 0.0, -0.25),
            (0.0, 0.0, 0.0),
        ] {
            assert_eq!(turns(y, x), expected);
        }
        assert_eq!(sin_cos_half_turns(0.0).0, 0.0);
        assert_eq!(sin_cos_half_turns(1.0).0, 0.0);
    }
}
