//! The lobe at a point: one of the library's list, a measured one, whose tables its material holds, or hair.

use specula_bsdf::bsdf::Lobe;
use specula_bsdf::hair::Hair;
use specula_bsdf::math::Stream;
use specula_bsdf::measured::Measured;
use specula_bsdf::{Bsdf, BsdfSample, Rgb, Transport, Vec3};

use super::lobes::{self, Sides};

/// A lobe, or where one is.
#[allow(
    clippy::large_enum_variant,
    reason = "one at a time is on the stack; a box would allocate at every hit"
)]
pub(crate) enum PointLobe<'a> {
    /// Of the list.
    Listed(Lobe<f32>),
    /// Measured.
    Measured(&'a Measured<f32>),
    /// A fibre of hair.
    Hair(Hair<f32>),
}

impl PointLobe<'_> {
    /// The lobe of the list; `None` where it is none.
    #[inline(always)]
    pub(crate) fn listed(&self) -> Option<&Lobe<f32>> {
        match self {
            Self::Listed(lobe) => Some(lobe),
            Self::Measured(_) | Self::Hair(_) => None,
        }
    }

    /// Where it scatters to.
    #[inline]
    pub(super) fn sides(&self) -> Sides {
        match self {
            Self::Listed(lobe) => lobes::sides(lobe),
            Self::Measured(_) => Sides::Reflects,
            Self::Hair(_) => Sides::Transmits,
        }
    }
}

impl Bsdf<f32> for PointLobe<'_> {
    #[inline(always)]
    fn eval(&self, wo: Vec3<f32>, wi: Vec3<f32>, transport: Transport) -> Rgb<f32> {
        match self {
            Self::Listed(lobe) => lobe.eval(wo, wi, transport),
            Self::Measured(measured) => measured.eval(wo, wi, transport),
            Self::Hair(hair) => hair.eval(wo, wi, transport),
        }
    }

    #[inline(always)]
    fn pdf(&self, wo: Vec3<f32>, wi: Vec3<f32>) -> f32 {
        match self {
            Self::Listed(lobe) => lobe.pdf(wo, wi),
            Self::Measured(measured) => measured.pdf(wo, wi),
            Self::Hair(hair) => hair.pdf(wo, wi),
        }
    }

    #[inline(always)]
    fn sample(&self, wo: Vec3<f32>, u: [f32; 3], transport: Transport) -> Option<BsdfSample<f32>> {
        match self {
            Self::Listed(lobe) => lobe.sample(wo, u, transport),
            Self::Measured(measured) => measured.sample(wo, u, transport),
            Self::Hair(hair) => hair.sample(wo, u, transport),
        }
    }

    #[inline(always)]
    fn is_stochastic(&self) -> bool {
        self.listed().is_some_and(Bsdf::<f32>::is_stochastic)
    }

    #[inline(always)]
    fn eval_pdf_random(
        &self,
        wo: Vec3<f32>,
        wi: Vec3<f32>,
        transport: Transport,
        stream: &mut Stream,
    ) -> (Rgb<f32>, f32) {
        match self {
            Self::Listed(lobe) => lobe.eval_pdf_random(wo, wi, transport, stream),
            Self::Measured(measured) => measured.eval_pdf(wo, wi, transport),
            Self::Hair(hair) => hair.eval_pdf(wo, wi, transport),
        }
    }

    #[inline(always)]
    fn sample_random(
        &self,
        wo: Vec3<f32>,
        u: [f32; 3],
        transport: Transport,
        stream: &mut Stream,
    ) -> Option<BsdfSample<f32>> {
        match self {
            Self::Listed(lobe) => lobe.sample_random(wo, u, transport, stream),
            Self::Measured(measured) => measured.sample(wo, u, transport),
            Self::Hair(hair) => hair.sample(wo, u, transport),
        }
    }

    #[inline(always)]
    fn is_specular(&self) -> bool {
        self.listed().is_some_and(Bsdf::<f32>::is_specular)
    }

    #[inline(always)]
    fn albedo(&self) -> Rgb<f32> {
        match self {
            Self::Listed(lobe) => lobe.albedo(),
            Self::Measured(measured) => measured.albedo(),
            Self::Hair(hair) => hair.albedo(),
        }
    }
}
