//! A rough metal with all its bounces, by one of the models.

use super::{Bsdf, BsdfSample, Transport};
use crate::fresnel::Reflectance;
use crate::math::{Real, Rgb, Stream, Vec3};
use crate::multibounce::walk::Facets;
use crate::multibounce::{
    MisPdf, MultibounceModel, bitterli2022, cui2023, heitz2016, mis_pdf, seed,
    stratified_bidirectional, wang2022,
};
use crate::ndf::Ggx;
use crate::vndf::VisibleNormals;

/// Reflection off a rough metal with every bounce between its facets. Values are estimates.
///
/// Backfacing views (`wo.z < 0`) are continued as in [`Ndf::g2_over_cos`](crate::ndf::Ndf::g2_over_cos): the first collision is
/// `Exp(sigma(wo) / |wo.z|)` deep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MultibounceConductor<T, N = Ggx<T>> {
    ndf: N,
    reflectance: Reflectance<T>,
    model: MultibounceModel,
    mis: MisPdf,
}

impl<T: Real, N: VisibleNormals<T>> MultibounceConductor<T, N> {
    /// A metal evaluated by `model`.
    #[inline(always)]
    pub fn new(ndf: N, reflectance: Reflectance<T>, model: MultibounceModel) -> Self {
        Self {
            ndf,
            reflectance,
            model,
            mis: MisPdf::default(),
        }
    }

    /// The same metal with another density for multiple importance sampling.
    #[inline(always)]
    #[must_use]
    pub fn with_mis_pdf(self, mis: MisPdf) -> Self {
        Self { mis, ..self }
    }

    #[inline(always)]
    pub(crate) fn facets(&self) -> Facets<T, N> {
        Facets {
            ndf: self.ndf,
            reflectance: self.reflectance,
        }
    }

    /// The model.
    #[inline(always)]
    pub(crate) fn model(&self) -> MultibounceModel {
        self.model
    }

    /// The density for multiple importance sampling.
    #[inline(always)]
    pub(crate) fn mis_pdf(&self) -> MisPdf {
        self.mis
    }

    /// An estimate of the model's `f cos` alone, without the density of multiple importance
    /// sampling.
    ///
    /// * `wi`: above the horizon.
    #[inline]
    pub fn estimate(&self, wo: Vec3<T>, wi: Vec3<T>, stream: &mut Stream) -> Rgb<T> {
        let facets = &self.facets();
        match self.model {
            MultibounceModel::Heitz2016 => heitz2016::eval::<T, N, true>(facets, wo, wi, stream),
            MultibounceModel::BitterliDeon2022 => bitterli2022::eval(facets, wo, wi, stream),
            MultibounceModel::Wang2022 { correlated } => {
                wang2022::eval(facets, correlated, wo, wi, stream)
            }
            MultibounceModel::Cui2023 { bidirectional } if bidirectional && wo.z > T::ZERO => {
                cui2023::eval_bidirectional(facets, wo, wi, stream)
            }
            MultibounceModel::Cui2023 { .. } => cui2023::eval(facets, wo, wi, stream),
            MultibounceModel::StratifiedBidirectional => {
                stratified_bidirectional::eval(facets, wo, wi, stream)
            }
        }
    }

    /// An estimate of `f cos` by Heitz 2016 as published: one bounce is estimated like the others,
    /// where [`MultibounceModel::Heitz2016`] has it in closed form. For comparisons.
    ///
    /// * `wi`: above the horizon.
    #[inline]
    pub fn estimate_as_heitz(&self, wo: Vec3<T>, wi: Vec3<T>, stream: &mut Stream) -> Rgb<T> {
        heitz2016::eval::<T, N, false>(&self.facets(), wo, wi, stream)
    }

    /// Samples a direction by the model's walk, with its weight, without the density for multiple
    /// importance sampling; `None` where the walk did not leave.
    ///
    /// * `u`: samples the first facet.
    #[inline]
    pub fn sample_walk(
        &self,
        wo: Vec3<T>,
        u: [T; 2],
        stream: &mut Stream,
    ) -> Option<(Vec3<T>, Rgb<T>)> {
        let facets = &self.facets();
        match self.model {
            MultibounceModel::Heitz2016 | MultibounceModel::BitterliDeon2022 => {
                heitz2016::sample(facets, wo, u, stream)
            }
            MultibounceModel::Wang2022 { correlated } => {
                wang2022::sample(facets, correlated, wo, u, stream)
            }
            MultibounceModel::Cui2023 { .. } => cui2023::sample(facets, wo, u, stream),
            MultibounceModel::StratifiedBidirectional => {
                stratified_bidirectional::sample(facets, wo, u, stream)
            }
        }
    }
}

impl<T: Real, N: VisibleNormals<T>> Bsdf<T> for MultibounceConductor<T, N> {
    #[inline]
    fn eval(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> Rgb<T> {
        self.eval_pdf(wo, wi, transport).0
    }

    #[inline]
    fn pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        mis_pdf::reflection(self.mis, &self.ndf, wo, wi)
    }

    #[inline]
    fn sample(&self, wo: Vec3<T>, u: [T; 3], transport: Transport) -> Option<BsdfSample<T>> {
        self.sample_random(wo, u, transport, &mut seed(wo, u))
    }

    #[inline]
    fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> (Rgb<T>, T) {
        self.eval_pdf_random(wo, wi, transport, &mut seed(wo, wi.to_array()))
    }

    #[inline]
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
            (self.estimate(wo, wi, stream), self.pdf(wo, wi))
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
        let (wi, weight) = self.sample_walk(wo, [u[1], u[2]], stream)?;
        BsdfSample::reflected(wi, weight, self.pdf(wo, wi))
    }

    #[inline(always)]
    fn albedo(&self) -> Rgb<T> {
        self.reflectance.eval(T::of(2.0 / 3.0))
    }
}
