//! A rough surface of Lambertian facets with all its bounces (Heitz et al. 2016).

use super::{Bsdf, BsdfSample, Transport};
use crate::math::{Real, Rgb, Stream, Vec3, warp};
use crate::multibounce::{heitz2016, seed};
use crate::ndf::Ggx;
use crate::vndf::VisibleNormals;

/// Reflection off Lambertian facets with every bounce between them. Values are estimates.
///
/// The density for multiple importance sampling is the cosine's: the walk's is close to it at
/// every roughness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MultibounceDiffuse<T, N = Ggx<T>> {
    ndf: N,
    albedo: Rgb<T>,
}

impl<T: Real, N: VisibleNormals<T>> MultibounceDiffuse<T, N> {
    /// * `albedo`: of each facet, in `[0, 1]`.
    #[inline(always)]
    pub fn new(ndf: N, albedo: Rgb<T>) -> Self {
        Self { ndf, albedo }
    }
}

impl<T: Real, N: VisibleNormals<T>> Bsdf<T> for MultibounceDiffuse<T, N> {
    #[inline]
    fn eval(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> Rgb<T> {
        self.eval_pdf(wo, wi, transport).0
    }

    #[inline(always)]
    fn pdf(&self, _wo: Vec3<T>, wi: Vec3<T>) -> T {
        warp::cosine_hemisphere_pdf(wi)
    }

    #[inline]
    fn sample(&self, wo: Vec3<T>, u: [T; 3], transport: Transport) -> Option<BsdfSample<T>> {
        self.sample_random(wo, u, transport, &mut seed(wo, u))
    }

    #[inline]
    fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> (Rgb<T>, T) {
        self.eval_pdf_random(wo, wi, transport, &mut seed(wo, wi.to_array()))
    }

    #[inline(always)]
    fn is_stochastic(&self) -> bool {
        true
    }

    #[inline]
    fn eval_pdf_random(
        &self,
        wo: Vec3<T>,
        wi: Vec3<T>,
        _transport: Transport,
        stream: &mut Stream,
    ) -> (Rgb<T>, T) {
        if wi.z > T::ZERO {
            let f_cos = heitz2016::eval_diffuse(&self.ndf, self.albedo, wo, wi, stream);
            (f_cos, self.pdf(wo, wi))
        } else {
            (Rgb::BLACK, T::ZERO)
        }
    }

    #[inline]
    fn sample_random(
        &self,
        wo: Vec3<T>,
        u: [T; 3],
        _transport: Transport,
        stream: &mut Stream,
    ) -> Option<BsdfSample<T>> {
        let (wi, weight) =
            heitz2016::sample_diffuse(&self.ndf, self.albedo, wo, [u[1], u[2]], stream)?;
        BsdfSample::reflected(wi, weight, self.pdf(wo, wi))
    }

    #[inline(always)]
    fn albedo(&self) -> Rgb<T> {
        self.albedo
    }
}
