//! Schlick's approximation.

use crate::math::{Real, Rgb};

/// `F = F0 + (1 - F0) (1 - cos)^5`.
///
/// Source: Schlick 1994, eq. 15.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Schlick<T> {
    /// Reflectance at normal incidence, in `[0, 1]`.
    pub f0: Rgb<T>,
}

impl<T: Real> Schlick<T> {
    /// Reflectance at `cos`, in `[0, 1]`.
    #[inline(always)]
    pub fn eval(&self, cos: T) -> Rgb<T> {
        let m = (T::ONE - cos).within(T::ZERO, T::ONE);
        let m2 = m * m;
        let m5 = m2 * m2 * m;
        self.f0.map(|f0| f0 + (T::ONE - f0) * m5)
    }
}
