//! Sine and cosine of a fraction of a turn, without branches, tables or range reduction.
//!
//! With `t = 1/2 - u`, both follow from `s = sin(pi t)` and `c = cos(pi t)` on half a turn, where
//! polynomials are short: `sin(2 pi u) = 2 s c` and `cos(2 pi u) = 2 s^2 - 1`. The coefficients
//! are Chebyshev fits in `t^2` over `[0, 1/4]`, computed in 40 digits.

use super::Real;

/// `(sin(2 pi u), cos(2 pi u))` for `u` in `[0, 1]`; absolute error at most 1e-6, for `f32`.
#[inline(always)]
pub(crate) fn sin_cos_f32<T: Real>(u: T) -> (T, T) {
    const SIN: [f32; 5] = [
        core::f32::consts::PI,
        -5.167_71,
        2.550_077_4,
        -0.598_290_4,
        0.077_655_91,
    ];
    const COS: [f32; 6] = [
        1.0,
        -4.934_802,
        4.058_709,
        -1.335_212,
        0.234_937_07,
        -0.024_395_932,
    ];
    let t = T::HALF - u;
    let x = t * t;
    double_angle(t * horner(x, 2.0, &SIN), horner(x, 1.0, &COS))
}

/// `(sin(2 pi u), cos(2 pi u))` for `u` in `[0, 1]`; absolute error at most 2e-15, for `f64`.
#[inline(always)]
pub(crate) fn sin_cos_f64<T: Real>(u: T) -> (T, T) {
    const SIN: [f64; 8] = [
        core::f64::consts::PI,
        -5.167_712_780_049_786,
        2.550_164_039_861_868,
        -0.599_264_528_825_224,
        0.082_145_878_816_310_43,
        -0.007_370_364_326_530_416,
        0.000_465_987_015_804_337_8,
        -0.000_021_133_627_352_052_97,
    ];
    const COS: [f64; 9] = [
        1.0,
        -4.934_802_200_544_677,
        4.058_712_126_416_497,
        -1.335_262_768_843_447,
        0.235_330_630_129_532_86,
        -0.025_806_888_737_002_2,
        0.001_929_556_272_481_713,
        -0.000_104_566_553_387_487_38,
        0.000_004_149_564_353_942_586,
    ];
    let t = T::HALF - u;
    let x = t * t;
    double_angle(t * horner(x, 2.0, &SIN), horner(x, 1.0, &COS))
}

/// `(sin 2a, cos 2a)` from `2 sin a` and `cos a`.
#[inline(always)]
fn double_angle<T: Real>(twice_sine: T, cosine: T) -> (T, T) {
    (
        twice_sine * cosine,
        twice_sine.mad(T::HALF * twice_sine, -T::ONE),
    )
}

/// `scale` times the polynomial of these ascending coefficients. A plain loop: iterators are not
/// inlined everywhere, and a call within a batch's loop would keep it from vectorising.
#[inline(always)]
pub(super) fn horner<T: Real, C: Copy + Into<f64>, const N: usize>(
    x: T,
    scale: f64,
    coefficients: &[C; N],
) -> T {
    let mut i = N - 1;
    let mut sum = T::of(scale * coefficients[i].into());
    while i > 0 {
        i -= 1;
        sum = x.mad(sum, T::of(scale * coefficients[i].into()));
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_stay_within_the_stated_bounds() {
        let mut worst32 = 0.0_f64;
        let mut worst64 = 0.0_f64;
        for i in 0..=100_000_u32 {
            let u = f64::from(i) / 100_000.0;
            let (s, c) = (core::f64::consts::TAU * u).sin_cos();
            let (s64, c64) = sin_cos_f64(u);
            worst64 = worst64.max((s - s64).abs()).max((c - c64).abs());
            #[allow(
                clippy::cast_possible_truncation,
                reason = "the f32 twin is under test"
            )]
            let u32 = u as f32;
            let (s, c) = (core::f64::consts::TAU * f64::from(u32)).sin_cos();
            let (s32, c32) = sin_cos_f32(u32);
            worst32 = worst32
                .max((s - f64::from(s32)).abs())
                .max((c - f64::from(c32)).abs());
        }
        assert!(worst32 < 1e-6, "{worst32:e}");
        assert!(worst64 < 2e-15, "{worst64:e}");
    }
}
