//! Any lobe, without allocation or dynamic dispatch: what a renderer holds at a hit.

use super::{
    Black, Bsdf, BsdfSample, CoatedDiffuse, Compensated, CompensatedDielectric,
    DiffuseTransmission, Eon, Gltf, Lambert, Layered, MultibounceConductor, MultibounceDielectric,
    Plastic, Principled, RoughConductor, RoughDielectric, SmoothConductor, SmoothDielectric,
    ThinDielectric, Transport,
};
use crate::math::{Real, Rgb, Stream, Vec3};
use crate::ndf::Beckmann;

/// One of the lobes of this crate, with GGX where it is rough unless its name says otherwise.
///
/// Exhaustive on purpose: renderers match it in full, so that a new lobe is a compile error at each
/// place that has to treat it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lobe<T> {
    /// See [`Lambert`].
    Lambert(Lambert<T>),
    /// See [`Eon`].
    Eon(Eon<T>),
    /// See [`DiffuseTransmission`].
    DiffuseTransmission(DiffuseTransmission<T>),
    /// See [`SmoothConductor`].
    SmoothConductor(SmoothConductor<T>),
    /// See [`RoughConductor`].
    RoughConductor(RoughConductor<T>),
    /// See [`SmoothDielectric`].
    SmoothDielectric(SmoothDielectric<T>),
    /// See [`RoughDielectric`].
    RoughDielectric(RoughDielectric<T>),
    /// See [`ThinDielectric`].
    ThinDielectric(ThinDielectric<T>),
    /// See [`CoatedDiffuse`].
    CoatedDiffuse(CoatedDiffuse<T>),
    /// See [`Layered`].
    Layered(Layered<T>),
    /// See [`Compensated`].
    Compensated(Compensated<T>),
    /// See [`CompensatedDielectric`].
    CompensatedDielectric(CompensatedDielectric<T>),
    /// See [`MultibounceConductor`].
    MultibounceConductor(MultibounceConductor<T>),
    /// See [`MultibounceDielectric`].
    MultibounceDielectric(MultibounceDielectric<T>),
    /// See [`Black`].
    Black(Black),
    /// See [`RoughConductor`], with Beckmann's normals.
    RoughConductorBeckmann(RoughConductor<T, Beckmann<T>>),
    /// See [`RoughDielectric`], with Beckmann's normals.
    RoughDielectricBeckmann(RoughDielectric<T, Beckmann<T>>),
    /// See [`Compensated`], with Beckmann's normals.
    CompensatedBeckmann(Compensated<T, Beckmann<T>>),
    /// See [`CompensatedDielectric`], with Beckmann's normals.
    CompensatedDielectricBeckmann(CompensatedDielectric<T, Beckmann<T>>),
    /// See [`MultibounceConductor`], with Beckmann's normals.
    MultibounceConductorBeckmann(MultibounceConductor<T, Beckmann<T>>),
    /// See [`MultibounceDielectric`], with Beckmann's normals.
    MultibounceDielectricBeckmann(MultibounceDielectric<T, Beckmann<T>>),
    /// See [`Plastic`].
    Plastic(Plastic<T>),
    /// See [`Plastic`], with Beckmann's normals.
    PlasticBeckmann(Plastic<T, Beckmann<T>>),
    /// See [`Principled`].
    Principled(Principled<T>),
    /// See [`Gltf`].
    Gltf(Gltf<T>),
}

macro_rules! each_lobe {
    ($lobe:expr, $l:ident => $call:expr) => {
        match $lobe {
            Lobe::Lambert($l) => $call,
            Lobe::Eon($l) => $call,
            Lobe::DiffuseTransmission($l) => $call,
            Lobe::SmoothConductor($l) => $call,
            Lobe::RoughConductor($l) => $call,
            Lobe::SmoothDielectric($l) => $call,
            Lobe::RoughDielectric($l) => $call,
            Lobe::ThinDielectric($l) => $call,
            Lobe::CoatedDiffuse($l) => $call,
            Lobe::Layered($l) => $call,
            Lobe::Compensated($l) => $call,
            Lobe::CompensatedDielectric($l) => $call,
            Lobe::MultibounceConductor($l) => $call,
            Lobe::MultibounceDielectric($l) => $call,
            Lobe::Black($l) => $call,
            Lobe::RoughConductorBeckmann($l) => $call,
            Lobe::RoughDielectricBeckmann($l) => $call,
            Lobe::CompensatedBeckmann($l) => $call,
            Lobe::CompensatedDielectricBeckmann($l) => $call,
            Lobe::MultibounceConductorBeckmann($l) => $call,
            Lobe::MultibounceDielectricBeckmann($l) => $call,
            Lobe::Plastic($l) => $call,
            Lobe::PlasticBeckmann($l) => $call,
            Lobe::Principled($l) => $call,
            Lobe::Gltf($l) => $call,
        }
    };
}

impl<T: Real> Bsdf<T> for Lobe<T> {
    #[inline]
    fn eval(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> Rgb<T> {
        each_lobe!(self, l => l.eval(wo, wi, transport))
    }

    #[inline]
    fn pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        each_lobe!(self, l => l.pdf(wo, wi))
    }

    #[inline]
    fn sample(&self, wo: Vec3<T>, u: [T; 3], transport: Transport) -> Option<BsdfSample<T>> {
        each_lobe!(self, l => l.sample(wo, u, transport))
    }

    #[inline]
    fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> (Rgb<T>, T) {
        each_lobe!(self, l => l.eval_pdf(wo, wi, transport))
    }

    #[inline]
    fn is_stochastic(&self) -> bool {
        each_lobe!(self, l => Bsdf::<T>::is_stochastic(l))
    }

    #[inline]
    fn eval_pdf_random(
        &self,
        wo: Vec3<T>,
        wi: Vec3<T>,
        transport: Transport,
        stream: &mut Stream,
    ) -> (Rgb<T>, T) {
        each_lobe!(self, l => l.eval_pdf_random(wo, wi, transport, stream))
    }

    #[inline]
    fn sample_random(
        &self,
        wo: Vec3<T>,
        u: [T; 3],
        transport: Transport,
        stream: &mut Stream,
    ) -> Option<BsdfSample<T>> {
        each_lobe!(self, l => l.sample_random(wo, u, transport, stream))
    }

    #[inline]
    fn is_specular(&self) -> bool {
        each_lobe!(self, l => Bsdf::<T>::is_specular(l))
    }

    #[inline]
    fn albedo(&self) -> Rgb<T> {
        each_lobe!(self, l => l.albedo())
    }
}

macro_rules! from_lobe {
    ($($name:ident: $lobe:ty),* $(,)?) => {
        $(impl<T: Real> From<$lobe> for Lobe<T> {
            #[inline(always)]
            fn from(lobe: $lobe) -> Self {
                Self::$name(lobe)
            }
        })*
    };
}

from_lobe!(
    Lambert: Lambert<T>,
    Eon: Eon<T>,
    DiffuseTransmission: DiffuseTransmission<T>,
    SmoothConductor: SmoothConductor<T>,
    RoughConductor: RoughConductor<T>,
    SmoothDielectric: SmoothDielectric<T>,
    RoughDielectric: RoughDielectric<T>,
    ThinDielectric: ThinDielectric<T>,
    CoatedDiffuse: CoatedDiffuse<T>,
    Layered: Layered<T>,
    Compensated: Compensated<T>,
    CompensatedDielectric: CompensatedDielectric<T>,
    MultibounceConductor: MultibounceConductor<T>,
    MultibounceDielectric: MultibounceDielectric<T>,
    Black: Black,
    RoughConductorBeckmann: RoughConductor<T, Beckmann<T>>,
    RoughDielectricBeckmann: RoughDielectric<T, Beckmann<T>>,
    CompensatedBeckmann: Compensated<T, Beckmann<T>>,
    CompensatedDielectricBeckmann: CompensatedDielectric<T, Beckmann<T>>,
    MultibounceConductorBeckmann: MultibounceConductor<T, Beckmann<T>>,
    MultibounceDielectricBeckmann: MultibounceDielectric<T, Beckmann<T>>,
    Plastic: Plastic<T>,
    PlasticBeckmann: Plastic<T, Beckmann<T>>,
    Principled: Principled<T>,
    Gltf: Gltf<T>,
);
