//! Widths of roughness for a batch.

use super::slices::{LengthMismatch, check};
use crate::alpha::Alpha;
use crate::math::Real;

/// Widths of the microfacets' distribution for a batch of elements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Widths<'a, T> {
    /// The same for all.
    Same(Alpha<T>),
    /// Each its own, as from a texture: `alpha_x: (n,)`, `alpha_y: (n,)`. They are clamped to the
    /// range of [`Alpha`], NaN to its lower end.
    PerElement {
        /// Along the local x.
        alpha_x: &'a [T],
        /// Along the local y; the same slice again where isotropic.
        alpha_y: &'a [T],
    },
}

impl<T> From<Alpha<T>> for Widths<'_, T> {
    fn from(alpha: Alpha<T>) -> Self {
        Self::Same(alpha)
    }
}

impl<T: Real> Widths<'_, T> {
    pub(super) fn check(&self, n: usize) -> Result<(), LengthMismatch> {
        match self {
            Self::Same(_) => Ok(()),
            Self::PerElement { alpha_x, alpha_y } => {
                check(n, [("alpha_x", alpha_x.len()), ("alpha_y", alpha_y.len())])
            }
        }
    }
}

/// Widths by index, in the scalar of a kernel.
pub(super) trait WidthsAt<U: Real> {
    fn at(&self, i: usize) -> Alpha<U>;
}

/// One for all.
#[derive(Clone, Copy)]
pub(super) struct OneAlpha<U>(pub(super) Alpha<U>);

impl<U: Real> WidthsAt<U> for OneAlpha<U> {
    #[inline(always)]
    fn at(&self, _i: usize) -> Alpha<U> {
        self.0
    }
}

/// One for all, in both directions. Clamped at every use, so that the compiler sees two equal widths
/// that are no NaN, and drops what serves unequal ones.
#[derive(Clone, Copy)]
pub(super) struct OneWidth<U>(pub(super) U);

impl<U: Real> WidthsAt<U> for OneWidth<U> {
    #[inline(always)]
    fn at(&self, _i: usize) -> Alpha<U> {
        Alpha::isotropic(self.0)
    }
}

/// Two slices of the same length.
#[derive(Clone, Copy)]
pub(super) struct Alphas<'a, T> {
    x: &'a [T],
    y: &'a [T],
}

impl<'a, T: Real> Alphas<'a, T> {
    /// The first `n` of both.
    #[inline(always)]
    pub(super) fn first(x: &'a [T], y: &'a [T], n: usize) -> Self {
        Self {
            x: &x[..n],
            y: &y[..n],
        }
    }
}

impl<T: Real> Alphas<'_, T> {
    #[inline(always)]
    pub(super) fn range(&self, start: usize, end: usize) -> Self {
        let count = end - start;
        Self {
            x: &self.x[start..end][..count],
            y: &self.y[start..end][..count],
        }
    }
}

impl<T: Real, U: Real> WidthsAt<U> for Alphas<'_, T> {
    #[inline(always)]
    fn at(&self, i: usize) -> Alpha<U> {
        Alpha::clamped(U::of(self.x[i].to_f64()), U::of(self.y[i].to_f64()))
    }
}
