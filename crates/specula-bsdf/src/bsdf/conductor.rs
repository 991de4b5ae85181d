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
    pub(crate) ndf: N,
    pub(crate) reflectance: Reflectance<T>,
    pub(crate) sampler: Sampler,
    pub(crate) masking: Masking,
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

    /// The first half of a sample: the direction, perhaps below the horizon, and its `N`. Batches
    /// draw many before they weigh them: two short loops keep more of the machine busy than a long one.
    #[inline(always)]
    pub(crate) fn draw(&self, wo: Vec3<T>, u: [T; 3]) -> (Vec3<T>, T) {
        let wi = self.ndf.sample_reflection(self.sampler, wo, [u[1], u[2]]);
        (wi, self.ndf.reflection_norm(self.sampler, wo))
    }

    /// The second half: what a direction drawn with `pdf = D / (4 N)` weighs.
    #[inline(always)]
    pub(crate) fn weigh(&self, wo: Vec3<T>, wi: Vec3<T>, norm: T) -> Option<BsdfSample<T>> {
        let (d, fresnel) = self.facet(wo, wi);
        // weight = F N G2 / |cos_o| and pdf = D / (4 N) with one division.
        let (top, bottom) = self.ndf.g2_over_cos_quotient(self.masking, wo, wi);
        let inverse = T::ONE / Real::max(norm * bottom, T::TINY);
        let weight = fresnel * (norm * norm * top * inverse);
        let pdf = T::of(0.25) * d * bottom * inverse;
        BsdfSample::reflected(wi, weight, pdf)
    }

    /// `eval` and `pdf`, given the `N` of `pdf = D / (4 N)`.
    #[inline(always)]
    pub(crate) fn evaluate(&self, wo: Vec3<T>, wi: Vec3<T>, norm: T) -> (Rgb<T>, T) {
        let (d, fresnel) = self.facet(wo, wi);
        let quarter = d * T::of(0.25);
        let f_cos = fresnel * (quarter * self.ndf.g2_over_cos(self.masking, wo, wi));
        // Selected at the end, so that batches have no branches.
        if wi.z > T::ZERO && wo.z + wi.z > T::ZERO {
            (f_cos, quarter / norm)
        } else {
            (Rgb::BLACK, T::ZERO)
        }
    }

    /// `(D, F)` of the facet that reflects `wo` into `wi`. Its normal is `h / |h|` with
    /// `h = wo + wi`, and `wo . wm = |h| / 2`.
    #[inline(always)]
    fn facet(&self, wo: Vec3<T>, wi: Vec3<T>) -> (T, Rgb<T>) {
        let half = wo + wi;
        let squared = half.length_squared();
        let fresnel = self.reflectance.eval(T::HALF * squared.sqrt());
        (self.ndf.d_along(half, squared), fresnel)
    }
}

impl<T: Real, N: Ndf<T>> Bsdf<T> for RoughConductor<T, N> {
    #[inline(always)]
    fn eval(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> Rgb<T> {
        self.eval_pdf(wo, wi, transport).0
    }

    #[inline(always)]
    fn pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        let half = wo + wi;
        let d = self.ndf.d_along(half, half.length_squared());
        let pdf = d / (T::of(4.0) * self.ndf.reflection_norm(self.sampler, wo));
        T::select(wi.z > T::ZERO && half.z > T::ZERO, pdf, T::ZERO)
    }

    #[inline(always)]
    fn sample(&self, wo: Vec3<T>, u: [T; 3], _transport: Transport) -> Option<BsdfSample<T>> {
        let (wi, norm) = self.draw(wo, u);
        self.weigh(wo, wi, norm)
    }

    #[inline(always)]
    fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>, _transport: Transport) -> (Rgb<T>, T) {
        let norm = self.ndf.reflection_norm(self.sampler, wo);
        self.evaluate(wo, wi, norm)
    }

    #[inline(always)]
    fn albedo(&self) -> Rgb<T> {
        self.reflectance.eval(T::of(2.0 / 3.0))
    }
}

/// A mirror.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmoothConductor<T> {
    pub(crate) reflectance: Reflectance<T>,
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
