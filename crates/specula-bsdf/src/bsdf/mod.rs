//! Lobes: one file each, all behind the trait [`Bsdf`].
//!
//! Directions point away from the surface in the local frame (z up): `wo` towards the viewer,
//! given; `wi` towards the light, sampled. The papers' i is our `wo`, their o is our `wi`.

mod black;
mod coated_diffuse;
mod compensated;
mod compensated_dielectric;
mod conductor;
mod dielectric;
mod eon;
pub(crate) mod gltf;
mod lambert;
mod layered;
mod lobe;
mod lobe_table;
mod multibounce_conductor;
mod multibounce_dielectric;
mod multibounce_diffuse;
pub(crate) mod plastic;
mod principled;
mod smooth_dielectric;
mod tints;

pub use black::Black;
pub use coated_diffuse::{CoatLayer, CoatScattering, CoatedDiffuse};
pub use compensated::Compensated;
pub use compensated_dielectric::CompensatedDielectric;
pub use conductor::{RoughConductor, SeenConductor, SmoothConductor};
pub use dielectric::RoughDielectric;
pub use eon::Eon;
pub use gltf::{Gltf, GltfParameters};
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
