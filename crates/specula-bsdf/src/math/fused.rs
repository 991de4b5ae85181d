//! Floats whose [`mad`](Real::mad) rounds once.

use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use super::platform::platform;
use super::{Real, turns};

/// A float that differs in one operation: [`mad`](Real::mad) is fused.
///
/// The batch kernels compute in it where the machine has the instruction; elsewhere each fused
/// operation is a call of the platform's library, right and slow.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
#[repr(transparent)]
pub struct Fused<T>(T);

macro_rules! operator {
    ($t:ident: $($operator:ident $name:ident $assign:ident $name_assign:ident),*) => {
        $(impl $operator for Fused<$t> {
            type Output = Self;
            #[inline(always)]
            fn $name(self, o: Self) -> Self {
                Self($operator::$name(self.0, o.0))
            }
        }
        impl $assign for Fused<$t> {
            #[inline(always)]
            fn $name_assign(&mut self, o: Self) {
                $assign::$name_assign(&mut self.0, o.0);
            }
        })*
    };
}

macro_rules! forward {
    ($($name:ident),*) => {
        $(#[inline(always)]
        fn $name(self) -> Self {
            Self(Real::$name(self.0))
        })*
    };
}

macro_rules! impl_fused {
    ($t:ident, $fma:ident, $turns:path) => {
        operator!($t: Add add AddAssign add_assign, Sub sub SubAssign sub_assign,
            Mul mul MulAssign mul_assign, Div div DivAssign div_assign);

        impl Neg for Fused<$t> {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self(-self.0)
            }
        }

        impl Real for Fused<$t> {
            const ZERO: Self = Self(<$t as Real>::ZERO);
            const ONE: Self = Self(<$t as Real>::ONE);
            const TWO: Self = Self(<$t as Real>::TWO);
            const HALF: Self = Self(<$t as Real>::HALF);
            const PI: Self = Self(<$t as Real>::PI);
            const INV_PI: Self = Self(<$t as Real>::INV_PI);
            const EPSILON: Self = Self(<$t as Real>::EPSILON);
            const TINY: Self = Self(<$t as Real>::TINY);
            const MAX: Self = Self(<$t as Real>::MAX);
            type Fused = Self;

            forward!(sqrt, abs, floor, exp, exp_below, exp_m1, ln, sin, cos, erf, erfc);

            #[inline(always)]
            fn of(x: f64) -> Self {
                Self(<$t as Real>::of(x))
            }
            #[inline(always)]
            fn to_f64(self) -> f64 {
                self.0.to_f64()
            }
            #[inline(always)]
            fn mad(self, factor: Self, term: Self) -> Self {
                Self(platform!($t::mul_add or $fma(self.0, factor.0, term.0)))
            }
            #[inline(always)]
            fn mad_exact_product(self, factor: Self, term: Self) -> Self {
                self.mad(factor, term)
            }
            #[inline(always)]
            fn atan2(self, x: Self) -> Self {
                Self(Real::atan2(self.0, x.0))
            }
            #[inline(always)]
            fn sin_cos_turns(self) -> (Self, Self) {
                $turns(self)
            }
            #[inline(always)]
            fn truncated(self) -> i32 {
                Real::truncated(self.0)
            }
            #[inline(always)]
            fn of_integer(i: i32) -> Self {
                Self(<$t as Real>::of_integer(i))
            }
            #[inline(always)]
            fn is_finite(self) -> bool {
                Real::is_finite(self.0)
            }
            #[inline(always)]
            fn copysign(self, sign: Self) -> Self {
                Self(Real::copysign(self.0, sign.0))
            }
            #[inline(always)]
            fn unit_from_bits(bits: u64) -> Self {
                Self(<$t as Real>::unit_from_bits(bits))
            }
        }
    };
}

impl_fused!(f32, fmaf, turns::sin_cos_f32);
impl_fused!(f64, fma, turns::sin_cos_f64);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_fused_operation_rounds_once() {
        let x = 1.0_f32 + 3.0 * f32::EPSILON;
        let plain = x.mad(x, -1.0);
        let fused = Fused(x).mad(Fused(x), Fused(-1.0));
        assert_eq!(plain, x * x - 1.0);
        assert_eq!(fused.0, x.mul_add(x, -1.0));
        assert_ne!(plain, fused.0);
        assert_eq!((Fused(x) * Fused(x) - Fused(1.0)).0, plain);
        let (s, c) = Fused(0.3_f64).sin_cos_turns();
        let (sine, cosine) = (core::f64::consts::TAU * 0.3).sin_cos();
        assert!((s.0 - sine).abs() < 2e-15 && (c.0 - cosine).abs() < 2e-15);
    }
}
