//! A rough or smooth dielectric coat over Lambert: paint, plastic, polished wood, glazed tiles.
//!
//! The model is closed form. A Lambertian base forgets where its light came from, so the coat acts
//! on it only through two values of the interface: the share `T(w)` of light from direction `w`
//! that enters and reaches the base, and the share `R` of diffuse light from the base that the coat
//! reflects to it. With `n` bounces off the base at most:
//!
//! ```text
//! f = f_interface(wo, wi) + T(wo) T(wi) / eta^2  rho/pi  (1 - q^n) / (1 - q),   q = rho R
//! ```
//!
//! The series of bounces between base and coat is the geometric one, summed. It is the expectation
//! of a stochastic walk between the layers (Guo, Hasan and Zhao 2018; pbrt-v4's `coateddiffuse`,
//! whose walk ends after `maxdepth = 2 n` events), without its noise: exact but for the tables of `T`
//! and `R`. pbrt's other estimate, of the value for a given pair of directions, exceeds its walk by
//! up to a fifth under rough coats.
//!
//! What is between coat and base, and what the coat's facets do with light that they send to each
//! other, is a [`CoatLayer`]. Without one the coat loses nothing: with a white base and a smooth coat
//! it returns all light. `T` and `R` are exact for a smooth coat without absorption, and tables made
//! by quadrature otherwise (`energy/interface.rs`, `interface_single.rs`, `interface_layer.rs`).

use super::under_coat::{UnderCoat, UnderRough, UnderSmooth};
use super::{Bsdf, BsdfSample, Transport};
use crate::energy::interface_coat::CoatInterface;
use crate::energy::interface_layer::Layer;
use crate::math::{Real, Rgb, Vec3};
use crate::ndf::{Ggx, Masking};
use crate::vndf::Sampler;

/// What becomes of light that one of a coat's facets sends to another.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum CoatScattering {
    /// It is lost: each facet scatters once. Rough coats darken the base.
    Single,
    /// It is followed: what is not transmitted is reflected.
    #[default]
    Lossless,
}

/// The medium between a coat and its base, and the light paths that count.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CoatLayer<T> {
    /// Optical thickness of an absorbing medium, from 0 up: its transmittance at the cosine `mu` is
    /// `exp(-thickness / mu)`.
    pub thickness: T,
    /// Events after which light is lost: bounces off the base and off the coat from inside. `None`:
    /// no limit.
    pub max_depth: Option<u32>,
    /// What the coat's facets do.
    pub scattering: CoatScattering,
}

impl<T: Real> Default for CoatLayer<T> {
    /// Nothing is lost.
    fn default() -> Self {
        Self {
            thickness: T::ZERO,
            max_depth: None,
            scattering: CoatScattering::Lossless,
        }
    }
}

/// Lambert under a dielectric coat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoatedDiffuse<T> {
    pub(crate) coat: Option<Ggx<T>>,
    pub(crate) eta: T,
    pub(crate) albedo: Rgb<T>,
    pub(crate) interface: CoatInterface<T>,
    /// `rho / eta^2 (1 - q^n) / (1 - q)`: the base with all bounces, before `T(wo) T(wi) / pi`.
    pub(crate) base: Rgb<T>,
    pub(crate) sampler: Sampler,
}

/// A coat, to be laid over diffuse bases of many colours: what does not depend on the base is looked up once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiffuseCoat<T> {
    coat: Option<Ggx<T>>,
    eta: T,
    interface: CoatInterface<T>,
    /// Share of diffuse light from the base that the coat sends back to it.
    internal: T,
    max_depth: Option<u32>,
    sampler: Sampler,
}

impl<T: Real> DiffuseCoat<T> {
    /// * `coat`: distribution of the coat's normals; `None` for a smooth coat.
    /// * `eta`: index of the coat over that outside, clamped to `[1, 3]`.
    #[inline]
    pub fn new(coat: Option<Ggx<T>>, eta: T, layer: CoatLayer<T>) -> Self {
        let eta = eta.within(T::ONE, T::of(3.0));
        let is_single = layer.scattering == CoatScattering::Single;
        let interface = CoatInterface::new(coat, eta, Layer::new(layer.thickness), is_single);
        Self {
            coat,
            eta,
            interface,
            internal: interface.internal_reflectance(coat),
            max_depth: layer.max_depth,
            sampler: Sampler::default(),
        }
    }

    /// The same coat, sampled by another sampler.
    #[inline(always)]
    #[must_use]
    pub fn with_sampler(self, sampler: Sampler) -> Self {
        Self { sampler, ..self }
    }

    /// The coat over a base.
    ///
    /// * `albedo`: of the base, in `[0, 1]`.
    #[inline]
    pub fn over(&self, albedo: Rgb<T>) -> CoatedDiffuse<T> {
        let scale = T::ONE / (self.eta * self.eta);
        CoatedDiffuse {
            coat: self.coat,
            eta: self.eta,
            albedo,
            interface: self.interface,
            base: albedo.map(|rho| {
                let q = rho * self.internal;
                scale * rho * followed(q, self.max_depth) / (T::ONE - q)
            }),
            sampler: self.sampler,
        }
    }
}

impl<T: Real> CoatedDiffuse<T> {
    /// A coat that loses nothing.
    ///
    /// * `coat`: distribution of the coat's normals; `None` for a smooth coat.
    /// * `eta`: index of the coat over that outside, clamped to `[1, 3]`.
    /// * `albedo`: of the base, in `[0, 1]`.
    #[inline]
    pub fn new(coat: Option<Ggx<T>>, eta: T, albedo: Rgb<T>) -> Self {
        Self::over_layer(coat, eta, albedo, CoatLayer::default())
    }

    /// A coat with a medium between it and the base, other parameters as of [`new`](Self::new).
    #[inline]
    pub fn over_layer(coat: Option<Ggx<T>>, eta: T, albedo: Rgb<T>, layer: CoatLayer<T>) -> Self {
        DiffuseCoat::new(coat, eta, layer).over(albedo)
    }

    /// The albedo of the base with all bounces between it and its coat, over the square of the coat's index: what
    /// [`PerElementBase`](crate::batch::PerElementBase) takes.
    #[inline(always)]
    pub fn base(&self) -> Rgb<T> {
        self.base
    }

    /// Whether the coat is a mirror: then some samples are specular, and others are not.
    #[inline(always)]
    pub fn is_smooth(&self) -> bool {
        self.coat.is_none()
    }

    /// The same material, its coat sampled by another sampler.
    #[inline(always)]
    #[must_use]
    pub fn with_sampler(self, sampler: Sampler) -> Self {
        Self { sampler, ..self }
    }

    /// The base under its coat.
    ///
    /// * `interface`: what looks the interface up.
    #[inline(always)]
    fn under<I>(&self, interface: I) -> UnderCoat<T, I> {
        UnderCoat {
            eta: self.eta,
            specular: Rgb::WHITE,
            albedo: self.albedo,
            base: self.base,
            interface,
        }
    }

    /// The same under a rough coat.
    #[inline(always)]
    pub(crate) fn under_rough<I>(&self, ggx: Ggx<T>, interface: I) -> UnderRough<T, Ggx<T>, I> {
        UnderRough {
            under: self.under(interface),
            ndf: ggx,
            masking: Masking::HeightCorrelated,
            sampler: self.sampler,
        }
    }

    /// The same under a smooth coat.
    #[inline(always)]
    pub(crate) fn under_smooth<I>(&self, interface: I) -> UnderSmooth<T, I> {
        UnderSmooth(self.under(interface))
    }
}

/// `1 - q^n`: the share of the series that a walk of so many events follows, half of them bounces off
/// the base.
#[inline]
fn followed<T: Real>(q: T, max_depth: Option<u32>) -> T {
    let Some(events) = max_depth else {
        return T::ONE;
    };
    let (mut rest, mut square, mut power) = (events / 2, q, T::ONE);
    while rest > 0 {
        if rest % 2 == 1 {
            power *= square;
        }
        square *= square;
        rest /= 2;
    }
    T::ONE - power
}

impl<T: Real> Bsdf<T> for CoatedDiffuse<T> {
    #[inline(always)]
    fn eval(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> Rgb<T> {
        self.eval_pdf(wo, wi, transport).0
    }

    #[inline(always)]
    fn pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        self.eval_pdf(wo, wi, Transport::Radiance).1
    }

    #[inline]
    fn sample(&self, wo: Vec3<T>, u: [T; 3], _transport: Transport) -> Option<BsdfSample<T>> {
        match self.coat {
            Some(ggx) => self.under_rough(ggx, &self.interface).sample_alone(wo, u),
            None => self.under_smooth(&self.interface).sample_alone(wo, u),
        }
    }

    #[inline]
    fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>, _transport: Transport) -> (Rgb<T>, T) {
        match self.coat {
            Some(ggx) => (self.under_rough(ggx, &self.interface)).eval_pdf_alone(wo, wi),
            None => (self.under_smooth(&self.interface)).eval_pdf_alone(wo, wi),
        }
    }

    #[inline(always)]
    fn albedo(&self) -> Rgb<T> {
        self.albedo
    }
}
