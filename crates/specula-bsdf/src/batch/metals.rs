//! Rough metals with alphas and colours of their own, as from textures.

use super::alphas::{AlphaAt, AlphaSlices, Alphas};
use super::level::Arithmetic;
use super::lobes::{Family, Kernel, Lobes};
use super::recast::Recast;
use super::slices::{Colours, LengthMismatch, check};
use crate::bsdf::RoughConductor;
use crate::fresnel::{Reflectance, Schlick};
use crate::math::{Real, Rgb};
use crate::ndf::Ggx;

/// Rough metals whose alphas and colours differ from element to element, by Schlick's approximation:
/// the metallic base of texture-driven renderers.
///
/// * `lobe`: sampler and masking; its own alphas and reflectance are not used.
/// * `alpha_x`, `alpha_y`: `(n,)`, as of [`PerElement`](super::PerElement).
/// * `f0`: `(n, 3)`, linear sRGB reflectances at normal incidence, clamped to `[0, 1]`, NaN to 0.
///
/// Element `i` is `RoughConductor` of `alpha[i]` with [`Schlick`]`{ f0[i] }`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PerElementMetal<'a, T> {
    /// What the elements have in common.
    pub lobe: RoughConductor<T>,
    /// Alphas along the local x.
    pub alpha_x: &'a [T],
    /// Alphas along the local y; the same slice again where isotropic.
    pub alpha_y: &'a [T],
    /// Reflectances at normal incidence.
    pub f0: Colours<&'a [T]>,
}

/// The lobes by index.
#[derive(Clone, Copy)]
struct Coloured<'a, T, U> {
    lobe: RoughConductor<U>,
    alpha_values: AlphaSlices<'a, T>,
    f0: Colours<&'a [T]>,
}

impl<T: Real, U: Real> Family<U> for Coloured<'_, T, U> {
    type Lobe = RoughConductor<U>;
    // Each lobe has Schlick's approximation, whatever the common one has.
    const HAS_REFLECTANCE: bool = false;
    const MAY_BE_ISOTROPIC: bool = false;

    #[inline(always)]
    fn at(&self, i: usize) -> RoughConductor<U> {
        let f0: Rgb<U> = self.f0.at(i).cast();
        let f0 = f0.map(|x| x.within(U::ZERO, U::ONE));
        RoughConductor {
            ndf: Ggx::new(self.alpha_values.at(i)),
            reflectance: Reflectance::Schlick(Schlick { f0 }),
            ..self.lobe
        }
    }

    #[inline(always)]
    fn range(&self, start: usize, end: usize) -> Self {
        Self {
            lobe: self.lobe,
            alpha_values: self.alpha_values.range(start, end),
            f0: self.f0.range(start, end).first(end - start),
        }
    }

    #[inline(always)]
    fn with(self, change: impl FnOnce(RoughConductor<U>) -> RoughConductor<U>) -> Self {
        Self {
            lobe: change(self.lobe),
            ..self
        }
    }

    #[inline(always)]
    fn common(&self) -> &RoughConductor<U> {
        &self.lobe
    }

    #[inline(always)]
    fn is_isotropic(&self) -> bool {
        false
    }
}

impl<T: Real> Lobes<T> for PerElementMetal<'_, T> {
    fn check(&self, n: usize) -> Result<(), LengthMismatch> {
        let (alpha_x, alpha_y) = (self.alpha_x, self.alpha_y);
        Alphas::PerElement { alpha_x, alpha_y }.check(n)?;
        check(n, self.f0.lengths(["f0.r", "f0.g", "f0.b"]))
    }

    #[inline(always)]
    fn run<A: Arithmetic, K: Kernel>(&self, n: usize, kernel: K) {
        kernel.run::<A::Of<T>, _>(Coloured {
            lobe: self.lobe.recast(),
            alpha_values: AlphaSlices::first(self.alpha_x, self.alpha_y, n),
            f0: self.f0.first(n),
        });
    }
}
