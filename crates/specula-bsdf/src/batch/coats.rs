//! Coats over metal. Where both surfaces are rough, values and weights are vectors; a coat's samples
//! choose a surface each, and are not.

use super::level::Arithmetic;
use super::lobes::{Any, InStages, Kernel, Lobes, Same};
use super::recast::{Recast, number};
use super::rough::{is_isotropic, made_isotropic};
use crate::bsdf::{Bsdf, BsdfSample, CoatedConductor, Transport};
use crate::fresnel::Reflectance;
use crate::math::{Real, Rgb, Vec3};
use crate::ndf::Ggx;
use crate::vndf::Sampler;

/// A [`CoatedConductor`] whose surfaces are both rough, and known to be.
#[derive(Clone, Copy)]
struct RoughCoat<U> {
    lobe: CoatedConductor<U>,
    coat: Ggx<U>,
    metal: Ggx<U>,
}

impl<U: Real> RoughCoat<U> {
    /// The lobe, its surfaces plain to see.
    #[inline(always)]
    fn plain(&self) -> CoatedConductor<U> {
        CoatedConductor {
            coat: Some(self.coat),
            metal: Some(self.metal),
            ..self.lobe
        }
    }
}

impl<U: Real> Bsdf<U> for RoughCoat<U> {
    #[inline(always)]
    fn eval(&self, wo: Vec3<U>, wi: Vec3<U>, transport: Transport) -> Rgb<U> {
        self.eval_pdf(wo, wi, transport).0
    }

    #[inline(always)]
    fn pdf(&self, wo: Vec3<U>, wi: Vec3<U>) -> U {
        self.eval_pdf(wo, wi, Transport::Radiance).1
    }

    #[inline(always)]
    fn sample(&self, wo: Vec3<U>, u: [U; 3], _transport: Transport) -> Option<BsdfSample<U>> {
        self.draw_second(wo, self.draw_first(wo, u))
    }

    #[inline(always)]
    fn eval_pdf(&self, wo: Vec3<U>, wi: Vec3<U>, _transport: Transport) -> (Rgb<U>, U) {
        self.eval_second(wo, wi, self.eval_first(wo))
    }

    #[inline(always)]
    fn albedo(&self) -> Rgb<U> {
        self.plain().albedo()
    }
}

impl<U: Real> InStages<U> for RoughCoat<U> {
    const STAGED: bool = true;
    const TWO_NUMBERS: bool = true;
    const SAMPLED_BY_REFLECTANCE: bool = true;

    #[inline(always)]
    fn is_isotropic(&self) -> bool {
        is_isotropic(&self.coat) && is_isotropic(&self.metal)
    }

    #[inline(always)]
    fn isotropic(self) -> Self {
        Self {
            coat: made_isotropic(&self.coat),
            metal: made_isotropic(&self.metal),
            ..self
        }
    }

    #[inline(always)]
    fn sampler(&self) -> Option<Sampler> {
        Some(self.lobe.sampler)
    }

    #[inline(always)]
    fn choose_sampler(self, sampler: Sampler) -> Self {
        let lobe = self.lobe.with_sampler(sampler);
        Self { lobe, ..self }
    }

    #[inline(always)]
    fn reflectance(&self) -> Option<Reflectance<U>> {
        Some(self.lobe.reflectance)
    }

    #[inline(always)]
    fn choose_reflectance(self, reflectance: Reflectance<U>) -> Self {
        let lobe = CoatedConductor {
            reflectance,
            ..self.lobe
        };
        Self { lobe, ..self }
    }

    #[inline(always)]
    fn draw_first(&self, wo: Vec3<U>, u: [U; 3]) -> (Vec3<U>, [U; 2]) {
        let wi = self.lobe.draw(self.coat, self.metal, wo, u);
        (wi, self.plain().norms(wo))
    }

    #[inline(always)]
    fn draw_second(&self, wo: Vec3<U>, (wi, norms): (Vec3<U>, [U; 2])) -> Option<BsdfSample<U>> {
        self.plain().weigh(self.metal, wo, wi, norms)
    }

    #[inline(always)]
    fn eval_first(&self, wo: Vec3<U>) -> [U; 2] {
        self.plain().norms(wo)
    }

    #[inline(always)]
    fn eval_second(&self, wo: Vec3<U>, wi: Vec3<U>, norms: [U; 2]) -> (Rgb<U>, U) {
        self.plain().evaluate(self.metal, wo, wi, norms)
    }
}

impl<T: Real> Lobes<T> for CoatedConductor<T> {
    #[inline(always)]
    fn run<A: Arithmetic, K: Kernel>(&self, n: usize, kernel: K) {
        let (Some(coat), Some(metal)) = (self.coat, self.metal) else {
            return Any(*self).run::<A, K>(n, kernel);
        };
        let (coat, metal) = (coat.recast(), metal.recast());
        let lobe = CoatedConductor {
            coat: Some(coat),
            eta: number(self.eta),
            metal: Some(metal),
            reflectance: self.reflectance.recast(),
            sampler: self.sampler,
        };
        kernel.run::<A::Of<T>, _>(Same(RoughCoat { lobe, coat, metal }));
    }
}
