//! The scalar types that every formula is written for: `f32` and `f64`.

use core::fmt::Debug;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use super::platform::platform;
use super::{Fused, exponential, turns};

mod sealed {
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
    impl Sealed for crate::math::Fused<f32> {}
    impl Sealed for crate::math::Fused<f64> {}
}

/// A floating-point scalar: `f32` or `f64`. Sealed.
///
/// Formulas are written once over `Real`, in the branch-free form that compilers vectorise:
/// [`at_least`](Real::at_least), [`at_most`](Real::at_most) and [`select`](Real::select) compile to
/// one instruction each.
///
/// Methods that share a name with one of `f32` and `f64` return what that returns. What differs from
/// the standard library has a name of its own: [`mad`](Real::mad) is not `mul_add`, which is fused;
/// [`at_least`](Real::at_least), [`at_most`](Real::at_most) and [`within`](Real::within) turn NaN
/// into a bound, where `max` and `min` ignore it and `clamp` returns it.
pub trait Real:
    sealed::Sealed
    + Copy
    + Debug
    + Default
    + PartialOrd
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + DivAssign
{
    /// 0.
    const ZERO: Self;
    /// 1.
    const ONE: Self;
    /// 2.
    const TWO: Self;
    /// 1/2.
    const HALF: Self;
    /// The ratio of a circle's circumference to its diameter.
    const PI: Self;
    /// 1/pi.
    const INV_PI: Self;
    /// Distance from 1 to the next larger number.
    const EPSILON: Self;
    /// Smallest positive normal number.
    const TINY: Self;
    /// Largest finite number.
    const MAX: Self;
    /// The same values with a fused [`mad`](Real::mad).
    #[doc(hidden)]
    type Fused: Real;

    /// A literal, rounded to this type.
    fn of(x: f64) -> Self;
    /// This number as `f64`, exactly.
    fn to_f64(self) -> f64;
    /// `self * factor + term`, as HLSL's `mad`: two roundings on `f32` and `f64`, so that scalar
    /// results are the same on every machine; one inside the batch kernels at the levels that have
    /// the instruction.
    fn mad(self, factor: Self, term: Self) -> Self;
    /// `self * factor + term` with an unrounded product, for sums that cancel: one rounding where
    /// [`mad`](Real::mad) is fused; otherwise through `f64`, which is within a thousandth of an ulp
    /// of that for `f32`, and two roundings for `f64`.
    #[inline(always)]
    fn mad_exact_product(self, factor: Self, term: Self) -> Self {
        Self::of(self.to_f64() * factor.to_f64() + term.to_f64())
    }
    /// Square root; NaN below zero.
    fn sqrt(self) -> Self;
    /// Absolute value.
    fn abs(self) -> Self;
    /// Largest integer at most `self`.
    fn floor(self) -> Self;
    /// e to the power of `self`.
    fn exp(self) -> Self;
    /// e to the power of `self`, which is at most 0, as a branch-free polynomial; 0 below -87 (`f32`) or -708
    /// (`f64`), and of NaN.
    ///
    /// Relative error at most 2e-7 (`f32`) and 4e-16 (`f64`); `exp(0)` is 1.
    fn exp_below(self) -> Self;
    /// `exp(self) - 1`, precise near 0.
    fn exp_m1(self) -> Self;
    /// Natural logarithm.
    fn ln(self) -> Self;
    /// The sine, in radians, by the platform's library. Kernels take
    /// [`sin_cos_turns`](Real::sin_cos_turns).
    fn sin(self) -> Self;
    /// The cosine, in radians, by the platform's library. Kernels take
    /// [`sin_cos_turns`](Real::sin_cos_turns).
    fn cos(self) -> Self;
    /// The angle in radians, in `(-pi, pi]`, of the point `(x, self)`.
    fn atan2(self, x: Self) -> Self;
    /// `2/sqrt(pi)` times the integral of `exp(-t^2)` over `[0, self]`.
    fn erf(self) -> Self;
    /// `1 - erf(self)`, precise where that is small.
    fn erfc(self) -> Self;
    /// `(sin, cos)` of `2 pi self` for `self` in `[0, 1]`, as branch-free polynomials.
    ///
    /// Absolute error at most 1e-6 (`f32`) and 2e-15 (`f64`), so that samplers spend no time in a
    /// library's range reduction.
    fn sin_cos_turns(self) -> (Self, Self);
    /// Whether neither infinite nor NaN.
    fn is_finite(self) -> bool;
    /// `self` with the sign of `sign`.
    fn copysign(self, sign: Self) -> Self;

    /// The leading bits of a random word as a number in `[0, 1)`.
    fn unit_from_bits(bits: u64) -> Self;

    /// The integer part, for places in tables: within `i32`, 0 of NaN.
    #[doc(hidden)]
    fn truncated(self) -> i32;
    /// A small integer, exactly.
    #[doc(hidden)]
    fn of_integer(i: i32) -> Self;

    /// Largest integer at most `self`, which is in `[0, 2^22]`: by sums, as a conversion to an integer that saturates is
    /// one element at a time in some batches, and [`floor`](Real::floor) a call on some machines.
    #[doc(hidden)]
    #[inline(always)]
    fn floor_of_small(self) -> Self {
        // Numbers from here on have no fractions.
        let shift = Self::ONE / Self::EPSILON;
        let nearest = (self + shift) - shift;
        nearest - Self::select(nearest > self, Self::ONE, Self::ZERO)
    }

    /// `self`, or `bound` where `self` is smaller or NaN.
    #[inline(always)]
    fn at_least(self, bound: Self) -> Self {
        if self > bound { self } else { bound }
    }

    /// `self`, or `bound` where `self` is larger or NaN.
    #[inline(always)]
    fn at_most(self, bound: Self) -> Self {
        if self < bound { self } else { bound }
    }

    /// `if_true` or `if_false`, both already computed.
    #[inline(always)]
    fn select(condition: bool, if_true: Self, if_false: Self) -> Self {
        if condition { if_true } else { if_false }
    }

    /// `self` limited to `[low, high]`; `low` where `self` is NaN.
    #[inline(always)]
    fn within(self, low: Self, high: Self) -> Self {
        self.at_least(low).at_most(high)
    }

    /// `self * self`.
    #[inline(always)]
    fn squared(self) -> Self {
        self * self
    }

    /// Square root; 0 below zero and of NaN.
    #[inline(always)]
    fn safe_sqrt(self) -> Self {
        self.at_least(Self::ZERO).sqrt()
    }
}

macro_rules! impl_real {
    (
        $t:ident, $turns:path, $exp_below:path, $digits:literal,
        $sqrt:ident $floor:ident $exp:ident $exp_m1:ident $ln:ident $sin:ident $cos:ident $atan2:ident
        $erf:ident $erfc:ident
    ) => {
        impl Real for $t {
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const TWO: Self = 2.0;
            const HALF: Self = 0.5;
            const PI: Self = core::$t::consts::PI;
            const INV_PI: Self = core::$t::consts::FRAC_1_PI;
            const EPSILON: Self = $t::EPSILON;
            const TINY: Self = $t::MIN_POSITIVE;
            const MAX: Self = $t::MAX;
            type Fused = Fused<$t>;

            #[inline(always)]
            #[allow(
                clippy::cast_possible_truncation,
                reason = "rounding a literal is what it is for"
            )]
            fn of(x: f64) -> Self {
                x as $t
            }
            #[inline(always)]
            fn to_f64(self) -> f64 {
                f64::from(self)
            }
            #[inline(always)]
            fn mad(self, factor: Self, term: Self) -> Self {
                self * factor + term
            }
            #[inline(always)]
            fn abs(self) -> Self {
                $t::abs(self)
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                platform!($t::sqrt or $sqrt(self))
            }
            #[inline(always)]
            fn floor(self) -> Self {
                platform!($t::floor or $floor(self))
            }
            #[inline(always)]
            fn exp(self) -> Self {
                platform!($t::exp or $exp(self))
            }
            #[inline(always)]
            fn exp_below(self) -> Self {
                $exp_below(self)
            }
            #[inline(always)]
            fn exp_m1(self) -> Self {
                platform!($t::exp_m1 or $exp_m1(self))
            }
            #[inline(always)]
            fn ln(self) -> Self {
                platform!($t::ln or $ln(self))
            }
            #[inline(always)]
            fn sin(self) -> Self {
                platform!($t::sin or $sin(self))
            }
            #[inline(always)]
            fn cos(self) -> Self {
                platform!($t::cos or $cos(self))
            }
            #[inline(always)]
            fn atan2(self, x: Self) -> Self {
                platform!($t::atan2 or $atan2(self, x))
            }
            #[inline(always)]
            fn erf(self) -> Self {
                libm::$erf(self)
            }
            #[inline(always)]
            fn erfc(self) -> Self {
                libm::$erfc(self)
            }
            #[inline(always)]
            fn sin_cos_turns(self) -> (Self, Self) {
                $turns(self)
            }
            #[inline(always)]
            #[allow(
                clippy::cast_precision_loss,
                reason = "the word is shifted to the type's digits"
            )]
            fn unit_from_bits(bits: u64) -> Self {
                const STEP: $t = 1.0 / (1_u64 << $digits) as $t;
                (bits >> (64 - $digits)) as $t * STEP
            }
            #[inline(always)]
            #[allow(
                clippy::cast_possible_truncation,
                reason = "saturating is meant"
            )]
            fn truncated(self) -> i32 {
                self as i32
            }
            #[inline(always)]
            #[allow(
                clippy::cast_precision_loss,
                clippy::cast_lossless,
                reason = "small integers, in either type"
            )]
            fn of_integer(i: i32) -> Self {
                i as $t
            }
            #[inline(always)]
            fn is_finite(self) -> bool {
                $t::is_finite(self)
            }
            #[inline(always)]
            fn copysign(self, sign: Self) -> Self {
                $t::copysign(self, sign)
            }
        }
    };
}

impl_real!(f32, turns::sin_cos_f32, exponential::exp_f32, 24, sqrtf floorf expf expm1f logf sinf cosf atan2f erff erfcf);
impl_real!(f64, turns::sin_cos_f64, exponential::exp_f64, 53, sqrt floor exp expm1 log sin cos atan2 erf erfc);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_numbers_are_rounded_down() {
        for i in 0..=50_000_u16 {
            let x = f32::from(i) * 0.004_1;
            let both = [x, x.next_up(), x.next_down().max(0.0), x.round()];
            for x in both {
                assert_eq!(x.floor_of_small(), x.floor(), "{x}");
                let x = f64::from(x);
                assert_eq!(x.floor_of_small(), x.floor(), "{x}");
            }
        }
    }

    #[test]
    fn bounds_take_the_place_of_nan() {
        assert_eq!(f32::NAN.at_least(2.0), 2.0);
        assert_eq!(f64::NAN.at_most(2.0), 2.0);
        assert_eq!(f64::NAN.within(-1.0, 1.0), -1.0);
        assert_eq!(f64::NAN.safe_sqrt(), 0.0);
        assert_eq!([1.0_f64, 3.0].map(|x| x.at_least(2.0)), [2.0, 3.0]);
        assert_eq!([1.0_f64, 3.0].map(|x| x.at_most(2.0)), [1.0, 2.0]);
        assert!(1.0_f64.at_least(f64::NAN).is_nan());
    }
}
