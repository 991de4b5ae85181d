//! The exponential of a number that is at most 0, without branches, tables or a library, so that loops over it are
//! vectors.
//!
//! ```text
//! x = n ln 2 + r,   |r| <= ln(2) / 2,   e^x = 2^n e^r
//! ```
//!
//! `n` is rounded by adding `1.5 * 2^(digits of the fraction)`, which leaves it in the low bits of the sum, and
//! `n ln 2` is subtracted in two parts. `e^r` is Taylor's series: the terms that are left out are below a tenth of an
//! ulp.

macro_rules! exponential {
    (
        $(#[$doc:meta])* $name:ident: $t:ident,
        least $least:literal, magic $magic:literal, shift $shift:literal, one $one:literal,
        ln2 [$high:literal, $low:literal], degree $degree:literal
    ) => {
        $(#[$doc])*
        #[inline(always)]
        pub(super) fn $name(x: $t) -> $t {
            /// `1/k!`.
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_precision_loss,
                reason = "coefficients are rounded to the type"
            )]
            const SERIES: [$t; $degree + 1] = {
                let mut series = [1.0; $degree + 1];
                let (mut k, mut factorial) = (1, 1.0_f64);
                while k <= $degree {
                    factorial *= k as f64;
                    series[k] = (1.0 / factorial) as $t;
                    k += 1;
                }
                series
            };
            // NaN becomes the bound.
            let within = if x > $least { x } else { $least };
            let shifted = within * core::$t::consts::LOG2_E + $magic;
            let n = shifted - $magic;
            let r = (within - n * $high) - n * $low;
            let mut i = $degree;
            let mut sum = SERIES[i];
            while i > 0 {
                i -= 1;
                sum = sum * r + SERIES[i];
            }
            let power = $t::from_bits((shifted.to_bits() << $shift).wrapping_add($one));
            if x > $least { sum * power } else { 0.0 }
        }
    };
}

exponential! {
    /// `exp(x)` for `x <= 0`, for `f32`.
    exp_f32: f32,
    least -87.0, magic 12_582_912.0, shift 23, one 0x3f80_0000,
    ln2 [0.693_359_4, -2.121_944_4e-4], degree 7
}

exponential! {
    /// `exp(x)` for `x <= 0`, for `f64`.
    exp_f64: f64,
    least -708.0, magic 6_755_399_441_055_744.0, shift 52, one 0x3ff0_0000_0000_0000,
    ln2 [0.693_147_180_369_123_8, 1.908_214_929_270_587_7e-10], degree 13
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_stay_within_the_stated_bounds() {
        let mut worst32 = 0.0_f64;
        let mut worst64 = 0.0_f64;
        for i in 0..=200_000_u32 {
            // Dense near 0.
            let share = f64::from(i) / 200_000.0;
            let x = -700.0 * share * share * share;
            worst64 = worst64.max((exp_f64(x) / x.exp() - 1.0).abs());
            #[allow(
                clippy::cast_possible_truncation,
                reason = "the f32 twin is under test"
            )]
            let x = (-86.9 * share * share) as f32;
            worst32 = worst32.max((f64::from(exp_f32(x)) / f64::from(x).exp() - 1.0).abs());
        }
        assert!(worst32 < 2e-7, "{worst32:e}");
        assert!(worst64 < 4e-16, "{worst64:e}");
    }

    #[test]
    fn ends_are_exact() {
        assert_eq!([exp_f32(0.0), exp_f32(-0.0)], [1.0; 2]);
        assert_eq!([exp_f64(0.0), exp_f64(-0.0)], [1.0; 2]);
        for x in [-88.0, -1e30, f32::NEG_INFINITY, f32::NAN] {
            assert_eq!(exp_f32(x), 0.0);
        }
        for x in [-709.0, -1e300, f64::NEG_INFINITY, f64::NAN] {
            assert_eq!(exp_f64(x), 0.0);
        }
    }
}
