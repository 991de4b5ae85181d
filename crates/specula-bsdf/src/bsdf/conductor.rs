//! Metals: rough and smooth.

use super::{Bsdf, BsdfSample, Event, Transport};
use crate::fresnel::Reflectance;
use crate::math::{Real, Rgb, Vec3, vec3};
use crate::ndf::{Ggx, Masking, Ndf};
use crate::vndf::Sampler;

/// Single scattering off a rough metal (Cook and Torrance 1982, with Smith masking):
///
/// ```text
/// f = F(wo . wm) G2(wo, wi) D(wm) / (4 |wo.z| |wi.z|),   wm ~ wo + wi
/// ```
///
/// Reciprocal above the horizon. For backfacing views (`wo.z < 0`) it is continued as
/// [`Ndf::g2_over_cos`] says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughConductor<T, N = Ggx<T>> {
    ndf: N,
    reflectance: Reflectance<T>,
    sampler: Sampler,
    masking: Masking,
}

impl<T: Real, N: Ndf<T>> RoughConductor<T, N> {
    /// A metal with height-correlated masking, drawn by the default sampler.
    #[inline(always)]
    pub fn new(ndf: N, reflectance: Reflectance<T>) -> Self {
        Self {
            ndf,
            reflectance,
            sampler: Sampler::default(),
            masking: Masking::default(),
        }
    }

    /// The same metal, drawn by another sampler (GGX only; Beckmann has one).
    #[inline(always)]
    #[must_use]
    pub fn with_sampler(self, sampler: Sampler) -> Self {
        Self { sampler, ..self }
    }

    /// The same metal with another masking.
    #[inline(always)]
    #[must_use]
    pub fn with_masking(self, masking: Masking) -> Self {
        Self { masking, ..self }
    }

    /// `(wm, F)`; unit half vector and the reflectance there.
    #[inline(always)]
    fn facet(&self, wo: Vec3<T>, wi: Vec3<T>) -> (Vec3<T>, Rgb<T>) {
        let wm = (wo + wi).normalize();
        (wm, self.reflectance.eval(wo.dot(wm)))
    }
}

impl<T: Real, N: Ndf<T>> Bsdf<T> for RoughConductor<T, N> {
    #[inline(always)]
    fn eval(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> Rgb<T> {
        self.eval_pdf(wo, wi, transport).0
    }

    #[inline(always)]
    fn pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        let wm = (wo + wi).normalize();
        if wi.z > T::ZERO && wm.z > T::ZERO {
            self.ndf.d(wm) / (T::of(4.0) * self.ndf.reflection_norm(self.sampler, wo))
        } else {
            T::ZERO
        }
    }

    #[inline(always)]
    fn sample(&self, wo: Vec3<T>, u: [T; 3], _transport: Transport) -> Option<BsdfSample<T>> {
        let wi = self.ndf.sample_reflection(self.sampler, wo, [u[1], u[2]]);
        let (wm, fresnel) = self.facet(wo, wi);
        let norm = self.ndf.reflection_norm(self.sampler, wo);
        let weight = fresnel * (norm * self.ndf.g2_over_cos(self.masking, wo, wi));
        let pdf = self.ndf.d(wm) / (T::of(4.0) * norm);
        BsdfSample::reflected(wi, weight, pdf)
    }

    #[inline(always)]
    fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>, _transport: Transport) -> (Rgb<T>, T) {
        let (wm, fresnel) = self.facet(wo, wi);
        if wi.z > T::ZERO && wm.z > T::ZERO {
            let quarter = self.ndf.d(wm) * T::of(0.25);
            let f_cos = fresnel * (quarter * self.ndf.g2_over_cos(self.masking, wo, wi));
            (f_cos, quarter / self.ndf.reflection_norm(self.sampler, wo))
        } else {
            (Rgb::BLACK, T::ZERO)
        }
    }

    #[inline(always)]
    fn albedo(&self) -> Rgb<T> {
        self.reflectance.eval(T::of(2.0 / 3.0))
    }
}

/// A mirror.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmoothConductor<T> {
    reflectance: Reflectance<T>,
}

impl<T: Real> SmoothConductor<T> {
    /// A mirror of this reflectance.
    #[inline(always)]
    pub fn new(reflectance: Reflectance<T>) -> Self {
        Self { reflectance }
    }
}

impl<T: Real> Bsdf<T> for SmoothConductor<T> {
    #[inline(always)]
    fn eval(&self, _wo: Vec3<T>, _wi: Vec3<T>, _transport: Transport) -> Rgb<T> {
        Rgb::BLACK
    }

    #[inline(always)]
    fn pdf(&self, _wo: Vec3<T>, _wi: Vec3<T>) -> T {
        T::ZERO
    }

    #[inline(always)]
    fn sample(&self, wo: Vec3<T>, _u: [T; 3], _transport: Transport) -> Option<BsdfSample<T>> {
        (wo.z > T::ZERO).then(|| {
            let wi = vec3(-wo.x, -wo.y, wo.z);
            let weight = self.reflectance.eval(wo.z);
            BsdfSample::delta(wi, weight, T::ONE, Event::Reflection, T::ONE)
        })
    }

    #[inline(always)]
    fn is_specular(&self) -> bool {
        true
    }

    #[inline(always)]
    fn albedo(&self) -> Rgb<T> {
        self.reflectance.eval(T::of(2.0 / 3.0))
    }
}
