//! Rough metals and rough glass: one lobe for all, or alphas per element.

use super::alphas::{AlphaAt, AlphaSlices, Alphas};
use super::level::Arithmetic;
use super::lobes::{Family, InStages, Kernel, Lobes, Same};
use super::recast::{Recast, convert};
use super::slices::LengthMismatch;
use crate::alpha::Alpha;
use crate::bsdf::{BsdfSample, RoughConductor, RoughDielectric};
use crate::fresnel::Reflectance;
use crate::math::{Real, Rgb, Vec3};
use crate::ndf::{Beckmann, Ggx, Ndf};
use crate::vndf::Sampler;

/// A rough lobe whose alphas differ from element to element, as from a texture.
///
/// * `lobe`: everything else of it; its own alphas are not used.
/// * `alpha_x`, `alpha_y`: `(n,)`, along the local x and y; the same slice twice where isotropic.
///   Clamped to the range of [`Alpha`](crate::Alpha), NaN to its lower end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PerElement<'a, T, L> {
    /// What the elements have in common.
    pub lobe: L,
    /// Alphas along the local x.
    pub alpha_x: &'a [T],
    /// Alphas along the local y.
    pub alpha_y: &'a [T],
}

impl<'a, T: Real, L> PerElement<'a, T, L> {
    fn check(&self, n: usize) -> Result<(), LengthMismatch> {
        let (alpha_x, alpha_y) = (self.alpha_x, self.alpha_y);
        Alphas::PerElement { alpha_x, alpha_y }.check(n)
    }

    #[inline(always)]
    fn alpha_slices(&self, n: usize) -> AlphaSlices<'a, T> {
        AlphaSlices::first(self.alpha_x, self.alpha_y, n)
    }
}

/// The lobes over one distribution, in another scalar.
macro_rules! recast_over {
    ($ndf:ident) => {
        impl<T: Real> Recast for RoughConductor<T, $ndf<T>> {
            type In<U: Real> = RoughConductor<U, $ndf<U>>;

            #[inline(always)]
            fn recast<U: Real>(&self) -> RoughConductor<U, $ndf<U>> {
                RoughConductor {
                    ndf: self.ndf.recast(),
                    reflectance: self.reflectance.recast(),
                    sampler: self.sampler,
                    masking: self.masking,
                }
            }
        }

        impl<T: Real> Recast for RoughDielectric<T, $ndf<T>> {
            type In<U: Real> = RoughDielectric<U, $ndf<U>>;

            #[inline(always)]
            fn recast<U: Real>(&self) -> RoughDielectric<U, $ndf<U>> {
                RoughDielectric {
                    ndf: self.ndf.recast(),
                    eta: convert(self.eta),
                    two_sided: self.two_sided,
                    sampler: self.sampler,
                    masking: self.masking,
                    tints: self.tints.cast(),
                }
            }
        }
    };
}

recast_over!(Ggx);
recast_over!(Beckmann);

/// A lobe that can be given other alphas.
trait Rough<U: Real>: InStages<U> {
    fn with_alpha(self, alpha: Alpha<U>) -> Self;
}

macro_rules! with_alphas {
    ($($lobe:ident over $ndf:ident),*) => {
        $(impl<U: Real> Rough<U> for $lobe<U, $ndf<U>> {
            #[inline(always)]
            fn with_alpha(self, alpha: Alpha<U>) -> Self {
                Self {
                    ndf: $ndf::new(alpha),
                    ..self
                }
            }
        })*
    };
}

with_alphas!(
    RoughConductor over Ggx,
    RoughConductor over Beckmann,
    RoughDielectric over Ggx,
    RoughDielectric over Beckmann
);

#[inline(always)]
fn is_isotropic<U: Real>(ggx: &Ggx<U>) -> bool {
    ggx.alpha().x == ggx.alpha().y
}

/// Clamped anew, so that the compiler sees two equal alphas, neither of them NaN.
#[inline(always)]
fn made_isotropic<U: Real>(ggx: &Ggx<U>) -> Alpha<U> {
    Alpha::isotropic(ggx.alpha().x)
}

impl<U: Real> InStages<U> for RoughConductor<U> {
    const STAGED: bool = true;
    const HAS_SAMPLER: bool = true;
    const HAS_REFLECTANCE: bool = true;

    #[inline(always)]
    fn is_isotropic(&self) -> bool {
        is_isotropic(&self.ndf)
    }

    #[inline(always)]
    fn isotropic(self) -> Self {
        self.with_alpha(made_isotropic(&self.ndf))
    }

    #[inline(always)]
    fn sampler(&self) -> Sampler {
        self.sampler
    }

    #[inline(always)]
    fn choose_sampler(self, sampler: Sampler) -> Self {
        self.with_sampler(sampler)
    }

    #[inline(always)]
    fn reflectance(&self) -> Reflectance<U> {
        self.reflectance
    }

    #[inline(always)]
    fn choose_reflectance(self, reflectance: Reflectance<U>) -> Self {
        Self {
            reflectance,
            ..self
        }
    }

    #[inline(always)]
    fn sample_first(&self, wo: Vec3<U>, u: [U; 3]) -> (Vec3<U>, U) {
        self.sample_wi(wo, u)
    }

    #[inline(always)]
    fn sample_second(&self, wo: Vec3<U>, (wi, norm): (Vec3<U>, U)) -> Option<BsdfSample<U>> {
        self.weigh(wo, wi, norm)
    }

    #[inline(always)]
    fn eval_first(&self, wo: Vec3<U>) -> [U; 2] {
        self.norm(wo)
    }

    #[inline(always)]
    fn eval_second(&self, wo: Vec3<U>, wi: Vec3<U>, norm: [U; 2]) -> (Rgb<U>, U) {
        self.evaluate(wo, wi, norm)
    }
}

/// Its normals are found one after the other, by Newton's method; all else is vectors.
impl<U: Real> InStages<U> for RoughConductor<U, Beckmann<U>> {
    const STAGED: bool = true;
    const HAS_REFLECTANCE: bool = true;

    #[inline(always)]
    fn reflectance(&self) -> Reflectance<U> {
        self.reflectance
    }

    #[inline(always)]
    fn choose_reflectance(self, reflectance: Reflectance<U>) -> Self {
        Self {
            reflectance,
            ..self
        }
    }

    #[inline(always)]
    fn sample_first(&self, wo: Vec3<U>, u: [U; 3]) -> (Vec3<U>, U) {
        self.sample_wi(wo, u)
    }

    #[inline(always)]
    fn sample_second(&self, wo: Vec3<U>, (wi, norm): (Vec3<U>, U)) -> Option<BsdfSample<U>> {
        self.weigh(wo, wi, norm)
    }

    #[inline(always)]
    fn eval_first(&self, wo: Vec3<U>) -> [U; 2] {
        self.norm(wo)
    }

    #[inline(always)]
    fn eval_second(&self, wo: Vec3<U>, wi: Vec3<U>, norm: [U; 2]) -> (Rgb<U>, U) {
        self.evaluate(wo, wi, norm)
    }
}

/// Values and densities are vectors; samples are made one after the other.
impl<U: Real> InStages<U> for RoughDielectric<U, Beckmann<U>> {}

impl<U: Real> InStages<U> for RoughDielectric<U> {
    const HAS_SAMPLER: bool = true;

    #[inline(always)]
    fn is_isotropic(&self) -> bool {
        is_isotropic(&self.ndf)
    }

    #[inline(always)]
    fn isotropic(self) -> Self {
        self.with_alpha(made_isotropic(&self.ndf))
    }

    #[inline(always)]
    fn sampler(&self) -> Sampler {
        self.sampler
    }

    #[inline(always)]
    fn choose_sampler(self, sampler: Sampler) -> Self {
        self.with_sampler(sampler)
    }
}

#[derive(Clone, Copy)]
struct Textured<'a, T, L> {
    lobe: L,
    alpha_values: AlphaSlices<'a, T>,
}

impl<T: Real, U: Real, L: Rough<U>> Family<U> for Textured<'_, T, L> {
    type Lobe = L;
    const MAY_BE_ISOTROPIC: bool = false;

    #[inline(always)]
    fn at(&self, i: usize) -> L {
        self.lobe.with_alpha(self.alpha_values.at(i))
    }

    #[inline(always)]
    fn range(&self, start: usize, end: usize) -> Self {
        Self {
            lobe: self.lobe,
            alpha_values: self.alpha_values.range(start, end),
        }
    }

    #[inline(always)]
    fn with(self, change: impl FnOnce(L) -> L) -> Self {
        Self {
            lobe: change(self.lobe),
            ..self
        }
    }

    #[inline(always)]
    fn common(&self) -> &L {
        &self.lobe
    }

    #[inline(always)]
    fn is_isotropic(&self) -> bool {
        false
    }
}

macro_rules! rough_lobes {
    ($($lobe:ident over $ndf:ident),*) => {
        $(impl<T: Real> Lobes<T> for $lobe<T, $ndf<T>> {
            #[inline(always)]
            fn run<A: Arithmetic, K: Kernel>(&self, _n: usize, kernel: K) {
                kernel.run::<A::Of<T>, _>(Same(self.recast()));
            }
        }

        impl<T: Real> Lobes<T> for PerElement<'_, T, $lobe<T, $ndf<T>>> {
            fn check(&self, n: usize) -> Result<(), LengthMismatch> {
                self.check(n)
            }

            #[inline(always)]
            fn run<A: Arithmetic, K: Kernel>(&self, n: usize, kernel: K) {
                let (lobe, alpha_values) = (self.lobe.recast(), self.alpha_slices(n));
                kernel.run::<A::Of<T>, _>(Textured { lobe, alpha_values });
            }
        })*
    };
}

rough_lobes!(
    RoughConductor over Ggx,
    RoughConductor over Beckmann,
    RoughDielectric over Ggx,
    RoughDielectric over Beckmann
);
