//! Three-component vectors: directions, points and microfacet normals.

use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use super::Real;

/// A vector, `(x, y, z)`. In the local frame of a surface, z is along the shading normal.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Vec3<T> {
    /// First component.
    pub x: T,
    /// Second component.
    pub y: T,
    /// Third component.
    pub z: T,
}

/// The vector `(x, y, z)`.
#[inline(always)]
pub const fn vec3<T>(x: T, y: T, z: T) -> Vec3<T> {
    Vec3 { x, y, z }
}

impl<T: Real> Vec3<T> {
    /// `(0, 0, 0)`.
    pub const ZERO: Self = vec3(T::ZERO, T::ZERO, T::ZERO);
    /// `(1, 0, 0)`.
    pub const X: Self = vec3(T::ONE, T::ZERO, T::ZERO);
    /// `(0, 1, 0)`.
    pub const Y: Self = vec3(T::ZERO, T::ONE, T::ZERO);
    /// `(0, 0, 1)`.
    pub const Z: Self = vec3(T::ZERO, T::ZERO, T::ONE);

    /// The same value three times.
    #[inline(always)]
    pub fn splat(v: T) -> Self {
        vec3(v, v, v)
    }

    /// Dot product.
    #[inline(always)]
    pub fn dot(self, o: Self) -> T {
        let plane = self.x.mad(o.x, self.y * o.y);
        self.z.mad(o.z, plane)
    }

    /// Cross product, right-handed.
    #[inline(always)]
    pub fn cross(self, o: Self) -> Self {
        vec3(
            self.y * o.z - self.z * o.y,
            self.z * o.x - self.x * o.z,
            self.x * o.y - self.y * o.x,
        )
    }

    /// Squared length.
    #[inline(always)]
    pub fn length_squared(self) -> T {
        self.dot(self)
    }

    /// Length.
    #[inline(always)]
    pub fn length(self) -> T {
        self.dot(self).sqrt()
    }

    /// The unit vector of the same direction; not finite for the zero vector.
    #[inline(always)]
    pub fn normalize(self) -> Self {
        self * (T::ONE / self.length())
    }

    /// The unit vector of the same direction, of those too whose squares vanish; NaN for the zero vector.
    #[inline(always)]
    pub(crate) fn normalize_any(self) -> Self {
        let largest = self.x.abs().at_least(self.y.abs()).at_least(self.z.abs());
        let is_small = largest < T::of(1e-10);
        let scale = T::select(is_small, T::ONE / largest.at_least(T::TINY), T::ONE);
        (self * scale).normalize()
    }

    /// Componentwise product.
    #[inline(always)]
    pub fn hadamard(self, o: Self) -> Self {
        vec3(self.x * o.x, self.y * o.y, self.z * o.z)
    }

    /// Whether all components are finite.
    #[inline(always)]
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite() && self.z.is_finite()
    }

    /// The same vector in another precision.
    #[inline(always)]
    pub fn cast<U: Real>(self) -> Vec3<U> {
        vec3(
            U::of(self.x.to_f64()),
            U::of(self.y.to_f64()),
            U::of(self.z.to_f64()),
        )
    }

    /// `(x, y, z)` as an array.
    #[inline(always)]
    pub fn to_array(self) -> [T; 3] {
        [self.x, self.y, self.z]
    }
}

impl<T> From<[T; 3]> for Vec3<T> {
    #[inline(always)]
    fn from([x, y, z]: [T; 3]) -> Self {
        vec3(x, y, z)
    }
}

impl<T: Real> Add for Vec3<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        vec3(self.x + o.x, self.y + o.y, self.z + o.z)
    }
}

impl<T: Real> Sub for Vec3<T> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        vec3(self.x - o.x, self.y - o.y, self.z - o.z)
    }
}

impl<T: Real> Mul<T> for Vec3<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, s: T) -> Self {
        vec3(self.x * s, self.y * s, self.z * s)
    }
}

impl<T: Real> Div<T> for Vec3<T> {
    type Output = Self;
    #[inline(always)]
    fn div(self, s: T) -> Self {
        vec3(self.x / s, self.y / s, self.z / s)
    }
}

impl<T: Real> Neg for Vec3<T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        vec3(-self.x, -self.y, -self.z)
    }
}

impl<T: Real> AddAssign for Vec3<T> {
    #[inline(always)]
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}

impl<T: Real> SubAssign for Vec3<T> {
    #[inline(always)]
    fn sub_assign(&mut self, o: Self) {
        *self = *self - o;
    }
}

impl<T: Real> MulAssign<T> for Vec3<T> {
    #[inline(always)]
    fn mul_assign(&mut self, s: T) {
        *self = *self * s;
    }
}
