//! Lobes: one file each, all behind the trait [`Bsdf`], and the table of them.
//!
//! Directions point away from the surface in the local frame (z up): `wo` towards the viewer,
//! given; `wi` towards the light, sampled. The papers' i is our `wo`, their o is our `wi`.

// How to add a lobe: CONTRIBUTING.md, "Add a lobe".

mod black;
mod coated_diffuse;
mod compensated;
mod compensated_dielectric;
mod conductor;
mod dielectric;
mod eon;
pub(crate) mod gltf;
pub(crate) mod in_columns;
mod kulla_conty;
mod lambert;
mod layered;
mod lobe;
mod multibounce_conductor;
mod multibounce_dielectric;
mod multibounce_diffuse;
pub(crate) mod plastic;
mod principled;
mod smooth_dielectric;
mod tints;
pub(crate) mod under_coat;

pub use black::Black;
pub use coated_diffuse::{CoatLayer, CoatScattering, CoatedDiffuse, DiffuseCoat};
pub use compensated::Compensated;
pub use compensated_dielectric::CompensatedDielectric;
pub use conductor::{RoughConductor, SeenConductor, SmoothConductor};
pub use dielectric::RoughDielectric;
pub use eon::Eon;
pub use gltf::{Gltf, GltfParameters};
pub use kulla_conty::KullaConty;
pub use lambert::{DiffuseTransmission, Lambert};
pub use layered::{Base, Layered, Medium};
pub use lobe::Lobe;
pub use multibounce_conductor::MultibounceConductor;
pub use multibounce_dielectric::MultibounceDielectric;
pub use multibounce_diffuse::MultibounceDiffuse;
pub use plastic::Plastic;
pub use principled::{Principled, PrincipledParameters};
pub use smooth_dielectric::{SmoothDielectric, ThinDielectric};
pub use tints::Tints;

use crate::math::{Real, Rgb, Stream, Vec3};

/// The table of lobes: one row each, from which everything is made that must know every lobe. Hands its rows to the
/// macro `callback!`, behind `context`.
///
/// ```text
/// /// documentation
/// Variant: Type, sides, batch, "path of its shader";
/// ```
///
/// * sides: `reflects` where the lobe is black below the surface, `transmits` where it is not, `depends` where its
///   parameters decide.
/// * batch: how a renderer deals with many elements of the lobe at once: `closed` evaluates and samples them by
///   [`batch`](crate::batch), `delta` samples them (nothing is left to evaluate), `walks` gives each element a stream
///   of random numbers, `scalar` takes them one by one.
/// * shader: the module of `specula-shaders/wgsl` that is its twin.
///
/// [`Lobe`](crate::bsdf::Lobe), its dispatch and conversions, what `specula-render` knows of lobes, and the tests that
/// no shader and no proof is missing are made of these rows: a row without an entry does not compile.
#[doc(hidden)]
#[macro_export]
macro_rules! lobe_table {
    ($callback:ident $($context:tt)*) => {
        $callback! {
            $($context)*
            /// See [`Lambert`].
            Lambert: $crate::bsdf::Lambert<T>, reflects, closed, "bsdf/lambert";
            /// See [`Eon`].
            Eon: $crate::bsdf::Eon<T>, reflects, closed, "bsdf/eon";
            /// See [`DiffuseTransmission`].
            DiffuseTransmission: $crate::bsdf::DiffuseTransmission<T>, transmits, closed, "bsdf/diffuse_transmission";
            /// See [`SmoothConductor`].
            SmoothConductor: $crate::bsdf::SmoothConductor<T>, reflects, delta, "bsdf/smooth_conductor";
            /// See [`RoughConductor`].
            RoughConductor: $crate::bsdf::RoughConductor<T>, reflects, closed, "bsdf/rough_conductor";
            /// See [`SmoothDielectric`].
            SmoothDielectric: $crate::bsdf::SmoothDielectric<T>, transmits, delta, "bsdf/smooth_dielectric";
            /// See [`RoughDielectric`].
            RoughDielectric: $crate::bsdf::RoughDielectric<T>, transmits, closed, "bsdf/rough_dielectric";
            /// See [`ThinDielectric`].
            ThinDielectric: $crate::bsdf::ThinDielectric<T>, transmits, delta, "bsdf/thin_dielectric";
            /// See [`CoatedDiffuse`].
            CoatedDiffuse: $crate::bsdf::CoatedDiffuse<T>, reflects, closed, "bsdf/coated_diffuse";
            /// See [`Layered`].
            Layered: $crate::bsdf::Layered<T>, reflects, scalar, "bsdf/layered/layered";
            /// See [`Compensated`].
            Compensated: $crate::bsdf::Compensated<T>, reflects, closed, "bsdf/compensated";
            /// See [`CompensatedDielectric`].
            CompensatedDielectric: $crate::bsdf::CompensatedDielectric<T>, transmits, scalar,
                "bsdf/compensated_dielectric";
            /// See [`MultibounceConductor`].
            MultibounceConductor: $crate::bsdf::MultibounceConductor<T>, reflects, walks,
                "multibounce/multibounce_conductor";
            /// See [`MultibounceDielectric`].
            MultibounceDielectric: $crate::bsdf::MultibounceDielectric<T>, transmits, scalar,
                "multibounce/multibounce_dielectric";
            /// See [`Black`].
            Black: $crate::bsdf::Black, reflects, scalar, "bsdf/black";
            /// See [`RoughConductor`], with Beckmann's normals.
            RoughConductorBeckmann: $crate::bsdf::RoughConductor<T, $crate::ndf::Beckmann<T>>, reflects, closed,
                "bsdf/rough_conductor";
            /// See [`RoughDielectric`], with Beckmann's normals.
            RoughDielectricBeckmann: $crate::bsdf::RoughDielectric<T, $crate::ndf::Beckmann<T>>, transmits, closed,
                "bsdf/rough_dielectric";
            /// See [`Compensated`], with Beckmann's normals.
            CompensatedBeckmann: $crate::bsdf::Compensated<T, $crate::ndf::Beckmann<T>>, reflects, scalar,
                "bsdf/compensated";
            /// See [`CompensatedDielectric`], with Beckmann's normals.
            CompensatedDielectricBeckmann: $crate::bsdf::CompensatedDielectric<T, $crate::ndf::Beckmann<T>>,
                transmits, scalar, "bsdf/compensated_dielectric";
            /// See [`MultibounceConductor`], with Beckmann's normals.
            MultibounceConductorBeckmann: $crate::bsdf::MultibounceConductor<T, $crate::ndf::Beckmann<T>>,
                reflects, scalar, "multibounce/multibounce_conductor";
            /// See [`MultibounceDielectric`], with Beckmann's normals.
            MultibounceDielectricBeckmann: $crate::bsdf::MultibounceDielectric<T, $crate::ndf::Beckmann<T>>,
                transmits, scalar, "multibounce/multibounce_dielectric";
            /// See [`Plastic`].
            Plastic: $crate::bsdf::Plastic<T>, reflects, closed, "bsdf/plastic";
            /// See [`Plastic`], with Beckmann's normals.
            PlasticBeckmann: $crate::bsdf::Plastic<T, $crate::ndf::Beckmann<T>>, reflects, scalar, "bsdf/plastic";
            /// See [`Principled`].
            Principled: $crate::bsdf::Principled<T>, depends, closed, "bsdf/principled_solid";
            /// See [`Gltf`].
            Gltf: $crate::bsdf::Gltf<T>, depends, closed, "bsdf/gltf";
        }
    };
}

/// What a path carries, for lobes whose two adjoints differ (refraction compresses radiance).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Transport {
    /// `wo` leads to the camera: radiance is scaled by `1/eta^2` on refraction.
    #[default]
    Radiance,
    /// `wo` leads to a light: importance is not scaled.
    Importance,
}

/// Which side a sample left on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Event {
    /// `wi` on the side of `wo`.
    Reflection,
    /// `wi` on the other side.
    Transmission,
}

/// A sampled direction. A sample that failed does not exist (`None`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BsdfSample<T> {
    /// Towards the light, unit, local frame.
    pub wi: Vec3<T>,
    /// `f |cos theta_i| / pdf`, computed in the cancelled form, of the whole lobe.
    pub weight: Rgb<T>,
    /// Density in 1/sr; the probability of this direction where `specular`.
    pub pdf: T,
    /// Reflection or transmission.
    pub event: Event,
    /// Whether the direction is one of a countable set (Dirac delta): `eval` and `pdf` are zero
    /// there.
    pub specular: bool,
    /// Index of refraction of the medium that `wi` runs in over that of `wo`; 1 for reflection.
    pub eta: T,
}

/// A bidirectional scattering distribution in the local frame.
///
/// Invariants, held by the crate `specula-stat` on every lobe here:
/// * `sample` samples `wi` with density `pdf(wo, wi)`; its missing mass is the share of `None`;
/// * `weight = eval / pdf` at the sampled direction;
/// * every value is finite and none is negative for every unit `wo`, `wi`.
pub trait Bsdf<T: Real> {
    /// `f(wo, wi) |cos theta_i|`, in 1/sr, without its Dirac deltas.
    ///
    /// * `wo`, `wi`: unit, local frame.
    fn eval(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> Rgb<T>;

    /// Density with which `sample` samples `wi`, in 1/sr, without Dirac deltas.
    fn pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> T;

    /// Samples `wi`.
    ///
    /// * `u`: independent and uniform in `[0, 1)`; `u[0]` chooses among lobes, `u[1]` and `u[2]`
    ///   the direction.
    /// * Returns `None` where the sample is rejected.
    fn sample(&self, wo: Vec3<T>, u: [T; 3], transport: Transport) -> Option<BsdfSample<T>>;

    /// `eval` and `pdf` together, for multiple importance sampling.
    #[inline(always)]
    fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> (Rgb<T>, T) {
        (self.eval(wo, wi, transport), self.pdf(wo, wi))
    }

    /// Whether values are estimates: then `eval` and `sample` are one sample of a random walk, taken
    /// from a stream seeded by the arguments, and callers who integrate should pass a stream of
    /// their own to [`eval_pdf_random`](Bsdf::eval_pdf_random) and
    /// [`sample_random`](Bsdf::sample_random).
    fn is_stochastic(&self) -> bool {
        false
    }

    /// [`eval_pdf`](Bsdf::eval_pdf) with randomness: an unbiased estimate of `f |cos|` where the
    /// lobe is stochastic; the density is never random.
    #[inline(always)]
    fn eval_pdf_random(
        &self,
        wo: Vec3<T>,
        wi: Vec3<T>,
        transport: Transport,
        _stream: &mut Stream,
    ) -> (Rgb<T>, T) {
        self.eval_pdf(wo, wi, transport)
    }

    /// [`sample`](Bsdf::sample) with randomness. Where the lobe is stochastic, `weight` estimates
    /// the quotient of `f |cos|` and the true density of directions, and `pdf` is the one that
    /// multiple importance sampling weighs with.
    #[inline(always)]
    fn sample_random(
        &self,
        wo: Vec3<T>,
        u: [T; 3],
        transport: Transport,
        _stream: &mut Stream,
    ) -> Option<BsdfSample<T>> {
        self.sample(wo, u, transport)
    }

    /// Whether nothing but Dirac deltas is left: `eval` and `pdf` are zero everywhere.
    fn is_specular(&self) -> bool {
        false
    }

    /// A representative colour, for denoisers and previews: what the lobe was given as its base
    /// colour, the reflectance of its facets at a cosine of 2/3, or white for dielectrics.
    ///
    /// It is no integral. It is in `[0, 1]` wherever the lobe's own parameters are, and where those
    /// of a sheet sum to at most 1.
    fn albedo(&self) -> Rgb<T>;
}

/// What is borrowed, as it is: lobes with tables are not copied.
impl<T: Real, L: Bsdf<T> + ?Sized> Bsdf<T> for &L {
    #[inline(always)]
    fn eval(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> Rgb<T> {
        (**self).eval(wo, wi, transport)
    }

    #[inline(always)]
    fn pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        (**self).pdf(wo, wi)
    }

    #[inline(always)]
    fn sample(&self, wo: Vec3<T>, u: [T; 3], transport: Transport) -> Option<BsdfSample<T>> {
        (**self).sample(wo, u, transport)
    }

    #[inline(always)]
    fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> (Rgb<T>, T) {
        (**self).eval_pdf(wo, wi, transport)
    }

    fn is_stochastic(&self) -> bool {
        (**self).is_stochastic()
    }

    #[inline(always)]
    fn eval_pdf_random(
        &self,
        wo: Vec3<T>,
        wi: Vec3<T>,
        transport: Transport,
        stream: &mut Stream,
    ) -> (Rgb<T>, T) {
        (**self).eval_pdf_random(wo, wi, transport, stream)
    }

    #[inline(always)]
    fn sample_random(
        &self,
        wo: Vec3<T>,
        u: [T; 3],
        transport: Transport,
        stream: &mut Stream,
    ) -> Option<BsdfSample<T>> {
        (**self).sample_random(wo, u, transport, stream)
    }

    fn is_specular(&self) -> bool {
        (**self).is_specular()
    }

    #[inline(always)]
    fn albedo(&self) -> Rgb<T> {
        (**self).albedo()
    }
}
