//! The arc cosine of a number in `[0, 1]`, without branches, tables or a library.
//!
//! `acos(x) = sqrt(1 - x) P(x)`, where `P` is smooth: the root takes the singularity at 1. The
//! coefficients are Chebyshev fits over `[0, 1]`, computed in 50 digits.

use super::Real;
use super::turns::horner;

/// `acos(x)` in radians for `x` in `[0, 1]`; absolute error at most 3e-7 (`f32`) and 1e-15 (`f64`).
#[inline(always)]
pub(crate) fn acos<T: Real>(x: T) -> T {
    const SINGLE: [f64; 8] = [
        core::f64::consts::FRAC_PI_2,
        -0.214_598_494,
        0.088_974_099_3,
        -0.050_145_025,
        0.030_808_253_4,
        -0.016_965_472,
        0.006_580_885_24,
        -0.001_237_004_85,
    ];
    const DOUBLE: [f64; 19] = [
        core::f64::consts::FRAC_PI_2,
        -0.214_601_836_602_531_81,
        0.089_048_622_545_645,
        -0.050_792_814_423_952_05,
        0.033_681_284_182_414_34,
        -0.024_374_292_336_345_07,
        0.018_671_957_405_041_725,
        -0.014_883_920_575_805_611,
        0.012_205_147_307_853_922,
        -0.010_182_378_741_879_057,
        0.008_496_530_448_837_192,
        -0.006_887_567_219_596_805,
        0.005_196_071_506_077_658,
        -0.003_461_028_582_630_26,
        0.001_921_357_687_418_782,
        -0.000_834_207_246_495_475_9,
        0.000_261_486_424_236_535_65,
        -0.000_052_097_667_756_768_49,
        0.000_004_921_467_667_228_333,
    ];
    let is_single = T::EPSILON.to_f64() > 1e-10;
    let polynomial = if is_single {
        horner(x, 1.0, &SINGLE)
    } else {
        horner(x, 1.0, &DOUBLE)
    };
    (T::ONE - x).safe_sqrt() * polynomial
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_stay_within_the_stated_bounds() {
        let (mut worst32, mut worst64) = (0.0_f64, 0.0_f64);
        for i in 0..=100_000_u32 {
            let x = f64::from(i) / 100_000.0;
            worst64 = worst64.max((acos(x) - x.acos()).abs());
            #[allow(
                clippy::cast_possible_truncation,
                reason = "the f32 twin is under test"
            )]
            let single = x as f32;
            let error = f64::from(acos(single)) - f64::from(single).acos();
            worst32 = worst32.max(error.abs());
        }
        assert!(worst32 < 3e-7, "{worst32:e}");
        assert!(worst64 < 1e-15, "{worst64:e}");
    }
}
