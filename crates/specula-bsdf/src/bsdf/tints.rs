//! Factors on a dielectric's reflection and transmission, for artists: white in nature.

use super::Event;
use crate::math::{Real, Rgb};

/// Factors on what a surface reflects and on what it lets through; white by default.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Tints<T> {
    /// Factor on reflection, in `[0, 1]`.
    pub reflection: Rgb<T>,
    /// Factor on transmission, in `[0, 1]`.
    pub transmission: Rgb<T>,
}

impl<T: Real> Tints<T> {
    /// No tints.
    pub const WHITE: Self = Self {
        reflection: Rgb::WHITE,
        transmission: Rgb::WHITE,
    };

    /// The factor on one branch.
    #[inline(always)]
    pub fn on(&self, event: Event) -> Rgb<T> {
        match event {
            Event::Reflection => self.reflection,
            Event::Transmission => self.transmission,
        }
    }

    /// The factor for light on the viewer's side or on the other.
    #[inline(always)]
    pub(crate) fn on_side(&self, reflects: bool) -> Rgb<T> {
        self.reflection
            .zip(self.transmission, |r, t| T::select(reflects, r, t))
    }

    /// The same colours in another precision.
    #[inline(always)]
    pub fn cast<U: Real>(&self) -> Tints<U> {
        Tints {
            reflection: self.reflection.cast(),
            transmission: self.transmission.cast(),
        }
    }
}

impl<T: Real> Default for Tints<T> {
    fn default() -> Self {
        Self::WHITE
    }
}
