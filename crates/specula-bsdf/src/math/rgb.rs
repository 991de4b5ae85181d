//! Colours: linear RGB (sRGB primaries, D65 white), unbounded.

use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Sub};

use super::Real;

/// A linear RGB triple with sRGB primaries and a D65 white.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Rgb<T> {
    /// Red.
    pub r: T,
    /// Green.
    pub g: T,
    /// Blue.
    pub b: T,
}

/// The colour `(r, g, b)`.
#[inline(always)]
pub const fn rgb<T>(r: T, g: T, b: T) -> Rgb<T> {
    Rgb { r, g, b }
}

impl<T: Real> Rgb<T> {
    /// `(0, 0, 0)`.
    pub const BLACK: Self = rgb(T::ZERO, T::ZERO, T::ZERO);
    /// `(1, 1, 1)`.
    pub const WHITE: Self = rgb(T::ONE, T::ONE, T::ONE);

    /// The same value three times.
    #[inline(always)]
    pub fn splat(v: T) -> Self {
        rgb(v, v, v)
    }

    /// `f` of every channel.
    #[inline(always)]
    pub fn map(self, mut f: impl FnMut(T) -> T) -> Self {
        rgb(f(self.r), f(self.g), f(self.b))
    }

    /// `f` of every pair of channels.
    #[inline(always)]
    pub fn zip(self, o: Self, mut f: impl FnMut(T, T) -> T) -> Self {
        rgb(f(self.r, o.r), f(self.g, o.g), f(self.b, o.b))
    }

    /// Relative luminance, Rec. 709 weights.
    #[inline(always)]
    pub fn luminance(self) -> T {
        T::of(0.2126) * self.r + T::of(0.7152) * self.g + T::of(0.0722) * self.b
    }

    /// Arithmetic mean of the channels.
    #[inline(always)]
    pub fn mean(self) -> T {
        (self.r + self.g + self.b) * T::of(1.0 / 3.0)
    }

    /// The largest channel.
    #[inline(always)]
    pub fn max_channel(self) -> T {
        self.r.at_least(self.g).at_least(self.b)
    }

    /// Whether every channel is exactly zero.
    #[inline(always)]
    pub fn is_black(self) -> bool {
        self.r == T::ZERO && self.g == T::ZERO && self.b == T::ZERO
    }

    /// Whether every channel is finite.
    #[inline(always)]
    pub fn is_finite(self) -> bool {
        self.r.is_finite() && self.g.is_finite() && self.b.is_finite()
    }

    /// The same colour in another precision.
    #[inline(always)]
    pub fn cast<U: Real>(self) -> Rgb<U> {
        rgb(
            U::of(self.r.to_f64()),
            U::of(self.g.to_f64()),
            U::of(self.b.to_f64()),
        )
    }

    /// `(r, g, b)` as an array.
    #[inline(always)]
    pub fn to_array(self) -> [T; 3] {
        [self.r, self.g, self.b]
    }
}

impl<T> From<[T; 3]> for Rgb<T> {
    #[inline(always)]
    fn from([r, g, b]: [T; 3]) -> Self {
        rgb(r, g, b)
    }
}

impl<T: Real> Add for Rgb<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        self.zip(o, |a, b| a + b)
    }
}

impl<T: Real> Sub for Rgb<T> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        self.zip(o, |a, b| a - b)
    }
}

impl<T: Real> Mul for Rgb<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: Self) -> Self {
        self.zip(o, |a, b| a * b)
    }
}

impl<T: Real> Mul<T> for Rgb<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, s: T) -> Self {
        self.map(|a| a * s)
    }
}

impl<T: Real> Div<T> for Rgb<T> {
    type Output = Self;
    #[inline(always)]
    fn div(self, s: T) -> Self {
        self.map(|a| a / s)
    }
}

impl<T: Real> AddAssign for Rgb<T> {
    #[inline(always)]
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}

impl<T: Real> MulAssign for Rgb<T> {
    #[inline(always)]
    fn mul_assign(&mut self, o: Self) {
        *self = *self * o;
    }
}

impl<T: Real> MulAssign<T> for Rgb<T> {
    #[inline(always)]
    fn mul_assign(&mut self, s: T) {
        *self = *self * s;
    }
}
