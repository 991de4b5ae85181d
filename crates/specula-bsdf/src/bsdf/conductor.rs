//! Metals: rough and smooth.

use super::{Bsdf, BsdfSample, Event, Transport};
use crate::alpha::Alpha;
use crate::fresnel::Reflectance;
use crate::math::{Real, Rgb, Vec3, vec3};
use crate::ndf::{Ggx, Masking, Ndf};
use crate::vndf::{Reflections, Sampler, VisibleNormals};

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

impl<T: Real, N: VisibleNormals<T>> RoughConductor<T, N> {
    /// A metal with height-correlated masking, sampled by the default sampler.
    #[inline(always)]
    pub fn new(ndf: N, reflectance: Reflectance<T>) -> Self {
        Self {
            ndf,
            reflectance,
            sampler: Sampler::default(),
            masking: Masking::default(),
        }
    }

    /// Its alphas.
    #[inline(always)]
    pub fn alpha(&self) -> Alpha<T> {
        self.ndf.alpha()
    }

    /// The same metal with another masking.
    #[inline(always)]
    #[must_use]
    pub fn with_masking(self, masking: Masking) -> Self {
        Self { masking, ..self }
    }

    /// The first half of a sample: the direction, perhaps below the horizon, and its `N`. Batches
    /// sample many before they weigh them: two short loops overlap more iterations than a long one.
    #[inline(always)]
    pub(crate) fn sample_wi(&self, wo: Vec3<T>, u: [T; 3]) -> (Vec3<T>, T) {
        let wi = self
            .ndf
            .sample_reflection_by(self.sampler, wo, [u[1], u[2]]);
        (wi, self.ndf.reflection_norm_by(self.sampler, wo))
    }

    /// `N` of `pdf = D / (4 N)` as numerator and denominator.
    #[inline(always)]
    pub(crate) fn norm(&self, wo: Vec3<T>) -> [T; 2] {
        self.ndf.reflection_norm_quotient(self.sampler, wo).into()
    }

    /// The second half: the weight of a direction sampled with `pdf = D / (4 N)`.
    #[inline(always)]
    pub(crate) fn weigh(&self, wo: Vec3<T>, wi: Vec3<T>, norm: T) -> Option<BsdfSample<T>> {
        let (d, fresnel) = self.facet(wo, wi);
        // weight = F N G2 / |cos_o| and pdf = D / (4 N) with one division.
        let (top, bottom) = self.ndf.g2_over_cos_quotient(self.masking, wo, wi);
        let inverse = T::ONE / (norm * bottom).at_least(T::TINY);
        let weight = fresnel * (norm * norm * top * inverse);
        let pdf = T::of(0.25) * d * bottom * inverse;
        BsdfSample::reflected(wi, weight, pdf)
    }

    /// `eval` and `pdf`, given the `N` of `pdf = D / (4 N)` as numerator and denominator.
    #[inline(always)]
    pub(crate) fn evaluate(&self, wo: Vec3<T>, wi: Vec3<T>, norm: [T; 2]) -> (Rgb<T>, T) {
        let (d, fresnel) = self.facet(wo, wi);
        let quarter = d * T::of(0.25);
        let f_cos = fresnel * (quarter * self.ndf.g2_over_cos(self.masking, wo, wi));
        let [n, m] = norm;
        // Selected at the end, so that batches have no branches.
        if wi.z > T::ZERO && wo.z + wi.z > T::ZERO {
            (f_cos, quarter * m / n)
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

impl<T: Real> RoughConductor<T> {
    /// The same metal, sampled by another sampler. For GGX alone: Beckmann has one sampler.
    ///
    /// ```compile_fail
    /// use specula_bsdf::Alpha;
    /// use specula_bsdf::bsdf::RoughConductor;
    /// use specula_bsdf::fresnel::Reflectance;
    /// use specula_bsdf::math::Rgb;
    /// use specula_bsdf::ndf::Beckmann;
    /// use specula_bsdf::vndf::Sampler;
    ///
    /// let beckmann = Beckmann::new(Alpha::isotropic(0.3_f32));
    /// let metal = RoughConductor::new(beckmann, Reflectance::Constant(Rgb::WHITE));
    /// let _ = metal.with_sampler(Sampler::Cap);
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn with_sampler(self, sampler: Sampler) -> Self {
        Self { sampler, ..self }
    }
}

impl<T: Real> RoughConductor<T> {
    /// The metal seen along `wo`, with what depends on `wo` alone computed once: for several
    /// evaluations or samples of one view.
    #[inline(always)]
    pub fn seen_along(&self, wo: Vec3<T>) -> SeenConductor<T> {
        SeenConductor {
            metal: *self,
            reflections: Reflections::new(self.ndf.alpha(), wo, self.sampler),
        }
    }
}

/// A rough metal and a view, from [`RoughConductor::seen_along`]. Functions and values are those of
/// [`Bsdf`], `wo` apart.
#[derive(Clone, Copy, Debug)]
pub struct SeenConductor<T> {
    metal: RoughConductor<T>,
    reflections: Reflections<T>,
}

impl<T: Real> SeenConductor<T> {
    /// `f |cos|` and its density: as [`Bsdf::eval_pdf`].
    #[inline(always)]
    pub fn eval_pdf(&self, wi: Vec3<T>) -> (Rgb<T>, T) {
        let Reflections { wo, norm, .. } = self.reflections;
        self.metal.evaluate(wo, wi, [norm, T::ONE])
    }

    /// As [`Bsdf::pdf`].
    #[inline(always)]
    pub fn pdf(&self, wi: Vec3<T>) -> T {
        self.reflections.pdf(wi)
    }

    /// As [`Bsdf::sample`].
    #[inline(always)]
    pub fn sample(&self, u: [T; 3]) -> Option<BsdfSample<T>> {
        let wi = self.reflections.sample_direction([u[1], u[2]]);
        let Reflections { wo, norm, .. } = self.reflections;
        self.metal.weigh(wo, wi, norm)
    }
}

impl<T: Real, N: VisibleNormals<T>> Bsdf<T> for RoughConductor<T, N> {
    #[inline(always)]
    fn eval(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> Rgb<T> {
        self.eval_pdf(wo, wi, transport).0
    }

    #[inline(always)]
    fn pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        let half = wo + wi;
        let d = self.ndf.d_along(half, half.length_squared());
        let [n, m] = self.norm(wo);
        let pdf = d * m / (T::of(4.0) * n);
        T::select(wi.z > T::ZERO && half.z > T::ZERO, pdf, T::ZERO)
    }

    #[inline(always)]
    fn sample(&self, wo: Vec3<T>, u: [T; 3], _transport: Transport) -> Option<BsdfSample<T>> {
        let (wi, norm) = self.sample_wi(wo, u);
        self.weigh(wo, wi, norm)
    }

    #[inline(always)]
    fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>, _transport: Transport) -> (Rgb<T>, T) {
        self.evaluate(wo, wi, self.norm(wo))
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
        let wi = vec3(-wo.x, -wo.y, wo.z);
        let weight = self.reflectance.eval(wo.z);
        let sample = BsdfSample::delta(wi, weight, T::ONE, Event::Reflection, T::ONE);
        // Selected at the end, so that batches have no branches.
        (wo.z > T::ZERO).then_some(sample)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::alpha::Alpha;
    use crate::fresnel::Conductor;
    use crate::math::{Stream, rgb, warp};

    /// Within rounding: the compiler may contract the two differently.
    fn close(a: f64, b: f64) -> bool {
        (a - b).abs() <= 1e-12 * a.abs().max(b.abs())
    }

    #[test]
    fn seen_along_a_view_is_the_same_metal() {
        let gold = Reflectance::Conductor(Conductor {
            eta: rgb(0.14, 0.37, 1.44),
            k: rgb(3.98, 2.38, 1.6),
        });
        let mut stream = Stream::new(3);
        for sampler in [Sampler::Cap, Sampler::Bounded, Sampler::Exact] {
            for alpha in [Alpha::isotropic(0.4), Alpha::clamped(0.1, 0.8)] {
                let metal = RoughConductor::new(Ggx::new(alpha), gold).with_sampler(sampler);
                for _ in 0..500 {
                    let wo: Vec3<f64> = warp::uniform_sphere([stream.next(), stream.next()]);
                    let wi = warp::uniform_sphere([stream.next(), stream.next()]);
                    let seen = metal.seen_along(wo);
                    let (f, pdf) = metal.eval_pdf(wo, wi, Transport::Radiance);
                    let (g, qdf) = seen.eval_pdf(wi);
                    assert!(close(f.r, g.r) && close(f.b, g.b) && close(pdf, qdf));
                    assert!(close(metal.pdf(wo, wi), seen.pdf(wi)));

                    let u = [stream.next(), stream.next(), stream.next()];
                    let (a, b) = (metal.sample(wo, u, Transport::Radiance), seen.sample(u));
                    assert_eq!(a.is_some(), b.is_some());
                    if let (Some(a), Some(b)) = (a, b) {
                        assert_eq!(a.wi, b.wi);
                        assert!(close(a.weight.g, b.weight.g) && close(a.pdf, b.pdf));
                    }
                }
            }
        }
    }
}
