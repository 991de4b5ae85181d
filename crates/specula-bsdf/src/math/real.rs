//! The scalar types that every formula is written for: `f32` and `f64`.

use core::fmt::Debug;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use super::{Fused, turns};

mod sealed {
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
    impl Sealed for crate::math::Fused<f32> {}
    impl Sealed for crate::math::Fused<f64> {}
}

/// A floating-point scalar. Sealed: `f32` and `f64` are all there are.
///
/// Formulas are written once over `Real`, in the branch-free form that compilers vectorise:
/// [`min`](Real::min), [`max`](Real::max) and [`select`](Real::select) compile to one instruction
/// each (they do not honour NaN as `f32::min` does: where an operand is NaN, the other is returned
/// only if it stands second).
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
    /// The same values with fused [`mul_add`](Real::mul_add).
    #[doc(hidden)]
    type Fused: Real;

    /// A literal, rounded to this type.
    fn of(x: f64) -> Self;
    /// This number as `f64`, exactly.
    fn to_f64(self) -> f64;
    /// `self * factor + term`: rounded twice by `f32` and `f64`, so that scalar results are the same
    /// on every machine; once inside the batch kernels, where the machine has the instruction.
    fn mul_add(self, factor: Self, term: Self) -> Self;
    /// `self * factor + term` with the product as it is: rounded once where
    /// [`mul_add`](Real::mul_add) is fused, within a thousandth of that for `f32` otherwise (through
    /// `f64`), and twice for `f64`. For sums that cancel.
    #[inline(always)]
    fn mul_add_once(self, factor: Self, term: Self) -> Self {
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
    /// Natural logarithm.
    fn ln(self) -> Self;
    /// The sine, in radians, by the platform's library: for code that is not a kernel.
    fn sin(self) -> Self;
    /// The cosine, in radians, by the platform's library: for code that is not a kernel.
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

    /// The smaller; `other` where `self` is NaN.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        if self < other { self } else { other }
    }

    /// The larger; `other` where `self` is NaN.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if self > other { self } else { other }
    }

    /// `if_true` or `if_false`, both already computed.
    #[inline(always)]
    fn select(condition: bool, if_true: Self, if_false: Self) -> Self {
        if condition { if_true } else { if_false }
    }

    /// `self` limited to `[low, high]`.
    #[inline(always)]
    fn clamp(self, low: Self, high: Self) -> Self {
        Real::min(Real::max(self, low), high)
    }

    /// `self * self`.
    #[inline(always)]
    fn squared(self) -> Self {
        self * self
    }

    /// `sqrt(max(self, 0))`.
    #[inline(always)]
    fn safe_sqrt(self) -> Self {
        Real::max(self, Self::ZERO).sqrt()
    }
}

macro_rules! impl_real {
    ($t:ident, $erf:path, $erfc:path, $turns:path, $digits:literal) => {
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
            fn mul_add(self, factor: Self, term: Self) -> Self {
                self * factor + term
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                $t::sqrt(self)
            }
            #[inline(always)]
            fn abs(self) -> Self {
                $t::abs(self)
            }
            #[inline(always)]
            fn floor(self) -> Self {
                $t::floor(self)
            }
            #[inline(always)]
            fn exp(self) -> Self {
                $t::exp(self)
            }
            #[inline(always)]
            fn ln(self) -> Self {
                $t::ln(self)
            }
            #[inline(always)]
            fn sin(self) -> Self {
                $t::sin(self)
            }
            #[inline(always)]
            fn cos(self) -> Self {
                $t::cos(self)
            }
            #[inline(always)]
            fn atan2(self, x: Self) -> Self {
                $t::atan2(self, x)
            }
            #[inline(always)]
            fn erf(self) -> Self {
                $erf(self)
            }
            #[inline(always)]
            fn erfc(self) -> Self {
                $erfc(self)
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

impl_real!(f32, libm::erff, libm::erfcf, turns::sin_cos_f32, 24);
impl_real!(f64, libm::erf, libm::erfc, turns::sin_cos_f64, 53);
