//! What lies under the coat.

use crate::bsdf::{Bsdf, Lambert, RoughConductor, SmoothConductor, Transport};
use crate::fresnel::Reflectance;
use crate::math::{Real, Rgb, Stream, Vec3};
use crate::ndf::Ggx;
use crate::vndf::Sampler;

/// The lower surface of a [`Layered`](super::Layered) material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Base<T> {
    /// A mirror.
    Mirror(SmoothConductor<T>),
    /// A rough metal, single scattering.
    Metal(RoughConductor<T>),
    /// Lambert.
    Diffuse(Lambert<T>),
}

impl<T: Real> Base<T> {
    /// A metal.
    ///
    /// * `ndf`: `None` for a smooth one.
    /// * `reflectance`: against vacuum; [`Layered`](super::Layered) makes an index relative to the
    ///   coat's.
    #[inline]
    pub fn metal(ndf: Option<Ggx<T>>, reflectance: Reflectance<T>) -> Self {
        match ndf {
            None => Self::Mirror(SmoothConductor::new(reflectance)),
            Some(ndf) => Self::Metal(RoughConductor::new(ndf, reflectance)),
        }
    }

    /// A white or coloured Lambertian surface.
    ///
    /// * `albedo`: in `[0, 1]`.
    #[inline]
    pub fn diffuse(albedo: Rgb<T>) -> Self {
        Self::Diffuse(Lambert::new(albedo))
    }

    /// The same surface under a medium of index `eta`.
    pub(super) fn under(self, eta: T) -> Self {
        match self {
            Self::Mirror(m) => Self::Mirror(SmoothConductor::new(m.reflectance.under(eta))),
            Self::Metal(m) => Self::Metal(RoughConductor {
                reflectance: m.reflectance.under(eta),
                ..m
            }),
            Self::Diffuse(_) => self,
        }
    }

    /// The same surface, sampled by another sampler.
    pub(super) fn with_sampler(self, sampler: Sampler) -> Self {
        match self {
            Self::Metal(m) => Self::Metal(m.with_sampler(sampler)),
            other => other,
        }
    }

    pub(super) fn is_mirror(&self) -> bool {
        matches!(self, Self::Mirror(_))
    }

    /// `f |cos|` and its density; zeros where smooth.
    #[inline]
    pub(super) fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> (Rgb<T>, T) {
        let transport = Transport::Radiance;
        match self {
            Self::Mirror(_) => (Rgb::BLACK, T::ZERO),
            Self::Metal(m) => m.eval_pdf(wo, wi, transport),
            Self::Diffuse(d) => d.eval_pdf(wo, wi, transport),
        }
    }

    /// A direction, its weight and its density.
    #[inline]
    pub(super) fn sample(&self, wo: Vec3<T>, stream: &mut Stream) -> Option<(Vec3<T>, Rgb<T>, T)> {
        let transport = Transport::Radiance;
        let mut u = || [T::ZERO, stream.next(), stream.next()];
        let sample = match self {
            Self::Mirror(m) => m.sample(wo, [T::ZERO; 3], transport),
            Self::Metal(m) => m.sample(wo, u(), transport),
            Self::Diffuse(d) => d.sample(wo, u(), transport),
        }?;
        Some((sample.wi, sample.weight, sample.pdf))
    }

    /// Reflectance of a facet; of the whole where diffuse.
    #[inline]
    pub(super) fn reflectance(&self, cos: T) -> Rgb<T> {
        match self {
            Self::Mirror(m) => m.reflectance.eval(cos),
            Self::Metal(m) => m.reflectance.eval(cos),
            Self::Diffuse(d) => Bsdf::<T>::albedo(d),
        }
    }
}
