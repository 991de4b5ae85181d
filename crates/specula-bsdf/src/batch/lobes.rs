//! What the batch functions take in place of one lobe.

use super::columns::LobeAt;
use super::level::Arithmetic;
use super::recast::{Recast, convert, recast};
use super::slices::LengthMismatch;
use crate::bsdf::in_columns::InColumns;
use crate::bsdf::{
    Bsdf, BsdfSample, Compensated, CompensatedDielectric, DiffuseTransmission, Eon, Lambert,
    SmoothConductor, SmoothDielectric, ThinDielectric, Transport,
};
use crate::fresnel::Reflectance;
use crate::math::{Real, Rgb, Vec3};
use crate::vndf::Sampler;

/// The lobes of a batch: one lobe for all elements (every single-scattering lobe of this crate), or
/// [`PerElement`](super::PerElement) alphas, or [`Any`] lobe that implements [`Bsdf`].
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no lobe whose batches are known",
    note = "wrap a lobe of your own in `batch::Any`; a lobe of this crate has its batches in `src/batch/lobes.rs`"
)]
pub trait Lobes<T: Real> {
    /// Fails where an array of per-element parameters is not `n` long.
    #[doc(hidden)]
    fn check(&self, _n: usize) -> Result<(), LengthMismatch> {
        Ok(())
    }

    /// Runs the kernel over `n` of these lobes in the arithmetic's scalar.
    #[doc(hidden)]
    fn run<A: Arithmetic, K: Kernel>(&self, n: usize, kernel: K);
}

/// Loops over elements, each with a lobe.
#[doc(hidden)]
pub trait Kernel {
    /// Runs them; always inlined.
    fn run<U: Real, F: Family<U>>(self, family: F);

    /// Runs them over lobes that are put into columns first; always inlined.
    fn run_in_columns<U, L, const N: usize, const P: usize, const Q: usize>(
        self,
        lobes: impl LobeAt<L>,
    ) where
        U: Real,
        L: InColumns<U, N, P, Q>;
}

/// A lobe for every element.
///
/// Kernels turn its choices into constants outside their loops, so that these do not branch.
#[doc(hidden)]
pub trait Family<U: Real>: Copy {
    /// The lobe's type.
    type Lobe: InStages<U>;

    /// Whether the sampler of its lobes is a choice.
    const HAS_SAMPLER: bool = Self::Lobe::HAS_SAMPLER;

    /// Whether the reflectance of its lobes is a choice that they have in common.
    const HAS_REFLECTANCE: bool = Self::Lobe::HAS_REFLECTANCE;

    /// Whether [`is_isotropic`](Family::is_isotropic) may say so.
    const MAY_BE_ISOTROPIC: bool = Self::Lobe::HAS_SAMPLER;

    /// The lobe at `i`.
    fn at(&self, i: usize) -> Self::Lobe;

    /// The lobes from `start` to before `end`.
    fn range(&self, start: usize, end: usize) -> Self;

    /// With another common lobe.
    fn with(self, change: impl FnOnce(Self::Lobe) -> Self::Lobe) -> Self;

    /// The common lobe.
    fn common(&self) -> &Self::Lobe;

    /// Whether all its lobes are isotropic.
    fn is_isotropic(&self) -> bool;
}

/// A lobe with choices to be made into constants, whose samples may be made in two stages, each a
/// loop of its own.
#[doc(hidden)]
pub trait InStages<U: Real>: Bsdf<U> + Copy {
    /// Whether there are two stages: then the sampler matters in the first one only, and the
    /// reflectance in the second one only.
    const STAGED: bool = false;

    /// Whether the sampler is a choice.
    const HAS_SAMPLER: bool = false;

    /// Whether the reflectance is a choice.
    const HAS_REFLECTANCE: bool = false;

    /// Whether the alphas are equal, and the sampler has a shorter way for such.
    #[inline(always)]
    fn is_isotropic(&self) -> bool {
        false
    }

    /// With alphas that the compiler sees to be equal.
    #[inline(always)]
    #[must_use]
    fn isotropic(self) -> Self {
        self
    }

    /// The sampler, where there is a choice.
    #[inline(always)]
    fn sampler(&self) -> Sampler {
        Sampler::default()
    }

    /// With this sampler.
    #[inline(always)]
    #[must_use]
    fn choose_sampler(self, _sampler: Sampler) -> Self {
        self
    }

    /// The reflectance, where there is a choice.
    #[inline(always)]
    fn reflectance(&self) -> Reflectance<U> {
        Reflectance::Constant(Rgb::BLACK)
    }

    /// With this reflectance.
    #[inline(always)]
    #[must_use]
    fn choose_reflectance(self, _reflectance: Reflectance<U>) -> Self {
        self
    }

    /// First stage of a sample: the direction, and the `N` of its density `D / (4 N)`.
    #[inline(always)]
    fn sample_first(&self, _wo: Vec3<U>, _u: [U; 3]) -> (Vec3<U>, U) {
        (Vec3::ZERO, U::ZERO)
    }

    /// Second stage of a sample: its weight and density, from what the first one returned.
    #[inline(always)]
    fn sample_second(&self, _wo: Vec3<U>, _first: (Vec3<U>, U)) -> Option<BsdfSample<U>> {
        None
    }

    /// First stage of eval and pdf together: `N` as numerator and denominator.
    #[inline(always)]
    fn eval_first(&self, _wo: Vec3<U>) -> [U; 2] {
        [U::ZERO; 2]
    }

    /// Second stage of eval and pdf together.
    #[inline(always)]
    fn eval_second(&self, _wo: Vec3<U>, _wi: Vec3<U>, _first: [U; 2]) -> (Rgb<U>, U) {
        (Rgb::BLACK, U::ZERO)
    }
}

/// The same lobe everywhere.
#[derive(Clone, Copy)]
pub(super) struct Same<L>(pub(super) L);

impl<U: Real, L: InStages<U>> Family<U> for Same<L> {
    type Lobe = L;

    #[inline(always)]
    fn at(&self, _i: usize) -> L {
        self.0
    }

    #[inline(always)]
    fn range(&self, _start: usize, _end: usize) -> Self {
        *self
    }

    #[inline(always)]
    fn with(self, change: impl FnOnce(L) -> L) -> Self {
        Self(change(self.0))
    }

    #[inline(always)]
    fn common(&self) -> &L {
        &self.0
    }

    #[inline(always)]
    fn is_isotropic(&self) -> bool {
        self.0.is_isotropic()
    }
}

/// A family whose lobes are all isotropic: alphas are made equal at every use, so that the compiler drops
/// what serves unequal ones.
#[derive(Clone, Copy)]
pub(super) struct Isotropic<F>(pub(super) F);

impl<U: Real, F: Family<U>> Family<U> for Isotropic<F> {
    type Lobe = F::Lobe;
    const HAS_REFLECTANCE: bool = F::HAS_REFLECTANCE;

    #[inline(always)]
    fn at(&self, i: usize) -> F::Lobe {
        self.0.at(i).isotropic()
    }

    #[inline(always)]
    fn range(&self, start: usize, end: usize) -> Self {
        Self(self.0.range(start, end))
    }

    #[inline(always)]
    fn with(self, change: impl FnOnce(F::Lobe) -> F::Lobe) -> Self {
        Self(self.0.with(change))
    }

    #[inline(always)]
    fn common(&self) -> &F::Lobe {
        self.0.common()
    }

    #[inline(always)]
    fn is_isotropic(&self) -> bool {
        true
    }
}

/// A lobe of the caller's own, or a mixture: compiled for each level from its scalar source, as
/// [`Bsdf`] gives it. It vectorises if the source is inlined, calls nothing and branches little.
#[derive(Clone, Copy, Debug)]
pub struct Any<L>(pub L);

impl<U: Real, L: Bsdf<U>> Bsdf<U> for Any<L> {
    #[inline(always)]
    fn eval(&self, wo: Vec3<U>, wi: Vec3<U>, transport: Transport) -> Rgb<U> {
        self.0.eval(wo, wi, transport)
    }

    #[inline(always)]
    fn pdf(&self, wo: Vec3<U>, wi: Vec3<U>) -> U {
        self.0.pdf(wo, wi)
    }

    #[inline(always)]
    fn sample(&self, wo: Vec3<U>, u: [U; 3], transport: Transport) -> Option<BsdfSample<U>> {
        self.0.sample(wo, u, transport)
    }

    #[inline(always)]
    fn eval_pdf(&self, wo: Vec3<U>, wi: Vec3<U>, transport: Transport) -> (Rgb<U>, U) {
        self.0.eval_pdf(wo, wi, transport)
    }

    #[inline(always)]
    fn albedo(&self) -> Rgb<U> {
        self.0.albedo()
    }
}

impl<U: Real, L: Bsdf<U> + Copy> InStages<U> for Any<L> {}

impl<T: Real, L: Bsdf<T> + Copy> Lobes<T> for Any<L> {
    #[inline(always)]
    fn run<A: Arithmetic, K: Kernel>(&self, _n: usize, kernel: K) {
        kernel.run::<T, _>(Same(*self));
    }
}

recast!(SmoothConductor, self, U => SmoothConductor {
    reflectance: self.reflectance.recast(),
});

impl<U: Real> InStages<U> for SmoothConductor<U> {
    const HAS_REFLECTANCE: bool = true;

    #[inline(always)]
    fn reflectance(&self) -> Reflectance<U> {
        self.reflectance
    }

    #[inline(always)]
    fn choose_reflectance(self, reflectance: Reflectance<U>) -> Self {
        Self { reflectance }
    }
}

impl<T: Real> Lobes<T> for SmoothConductor<T> {
    #[inline(always)]
    fn run<A: Arithmetic, K: Kernel>(&self, _n: usize, kernel: K) {
        kernel.run::<A::Of<T>, _>(Same(self.recast()));
    }
}

/// Lobes without choices to be made into constants, each with the same lobe in the scalar `U`.
macro_rules! as_they_are {
    ($($lobe:ident, $self:ident, $u:ident => $body:expr;)*) => {
        $(recast!($lobe, $self, $u => $body);

        impl<U: Real> InStages<U> for $lobe<U> {}

        impl<T: Real> Lobes<T> for $lobe<T> {
            #[inline(always)]
            fn run<A: Arithmetic, K: Kernel>(&self, _n: usize, kernel: K) {
                kernel.run::<A::Of<T>, _>(Same(self.recast()));
            }
        })*
    };
}

as_they_are! {
    Lambert, self, U => Lambert::new(self.albedo().cast());
    Eon, self, U => Eon {
        albedo: self.albedo.cast(),
        roughness: convert(self.roughness),
    };
    DiffuseTransmission, self, U => DiffuseTransmission {
        reflectance: self.reflectance.cast(),
        transmittance: self.transmittance.cast(),
    };
    SmoothDielectric, self, U => SmoothDielectric {
        eta: convert(self.eta),
        two_sided: self.two_sided,
        tints: self.tints.cast(),
    };
    ThinDielectric, self, U => ThinDielectric::new(convert(self.eta)).with_tints(self.tints.cast());
}

/// Lobes that look up tables and branch: loops of their scalar code.
macro_rules! one_by_one {
    ($($lobe:ident),*) => {
        $(impl<U: Real> InStages<U> for $lobe<U> {}

        impl<T: Real> Lobes<T> for $lobe<T> {
            #[inline(always)]
            fn run<A: Arithmetic, K: Kernel>(&self, n: usize, kernel: K) {
                Any(*self).run::<A, K>(n, kernel);
            }
        })*
    };
}

one_by_one!(Compensated, CompensatedDielectric);
