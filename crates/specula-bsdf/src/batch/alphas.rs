//! Alphas for a batch.

use super::slices::{LengthMismatch, check};
use crate::alpha::Alpha;
use crate::math::Real;

/// Alphas of the microfacets' distribution for a batch of elements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Alphas<'a, T> {
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

impl<T> From<Alpha<T>> for Alphas<'_, T> {
    fn from(alpha: Alpha<T>) -> Self {
        Self::Same(alpha)
    }
}

impl<T: Real> Alphas<'_, T> {
    pub(super) fn check(&self, n: usize) -> Result<(), LengthMismatch> {
        match self {
            Self::Same(_) => Ok(()),
            Self::PerElement { alpha_x, alpha_y } => {
                check(n, [("alpha_x", alpha_x.len()), ("alpha_y", alpha_y.len())])
            }
        }
    }
}

/// Alphas by index, in the scalar of a kernel.
pub(super) trait AlphaAt<U: Real> {
    fn at(&self, i: usize) -> Alpha<U>;
}

/// One for all.
#[derive(Clone, Copy)]
pub(super) struct OneAlpha<U>(pub(super) Alpha<U>);

impl<U: Real> AlphaAt<U> for OneAlpha<U> {
    #[inline(always)]
    fn at(&self, _i: usize) -> Alpha<U> {
        self.0
    }
}

/// One for all, in both directions. Clamped at every use, so that the compiler sees two equal alphas
/// that are not NaN, and drops what serves unequal ones.
#[derive(Clone, Copy)]
pub(super) struct IsotropicAlpha<U>(pub(super) U);

impl<U: Real> AlphaAt<U> for IsotropicAlpha<U> {
    #[inline(always)]
    fn at(&self, _i: usize) -> Alpha<U> {
        Alpha::isotropic(self.0)
    }
}

/// Two slices of the same length.
#[derive(Clone, Copy)]
pub(super) struct AlphaSlices<'a, T> {
    x: &'a [T],
    y: &'a [T],
}

impl<'a, T: Real> AlphaSlices<'a, T> {
    /// The first `n` of both.
    #[inline(always)]
    pub(super) fn first(x: &'a [T], y: &'a [T], n: usize) -> Self {
        Self {
            x: &x[..n],
            y: &y[..n],
        }
    }
}

impl<T: Real> AlphaSlices<'_, T> {
    /// Whether no element is isotropic, once clamped.
    #[inline(always)]
    pub(super) fn all_unequal(&self) -> bool {
        let pairs = self.x.iter().zip(self.y);
        pairs.fold(true, |all, (&x, &y)| {
            let alpha = Alpha::clamped(x, y);
            all & (alpha.x != alpha.y)
        })
    }

    #[inline(always)]
    pub(super) fn range(&self, start: usize, end: usize) -> Self {
        let count = end - start;
        Self {
            x: &self.x[start..end][..count],
            y: &self.y[start..end][..count],
        }
    }
}

impl<T: Real, U: Real> AlphaAt<U> for AlphaSlices<'_, T> {
    #[inline(always)]
    fn at(&self, i: usize) -> Alpha<U> {
        Alpha::clamped(U::of(self.x[i].to_f64()), U::of(self.y[i].to_f64()))
    }
}
