//! Mitsuba 3's `plastic` and `roughplastic`: a dielectric coat over Lambert.

pub(crate) mod interface;
mod interface_table;

use super::under_coat::{UnderCoat, UnderRough, UnderSmooth};
use super::{Bsdf, BsdfSample, Transport};
use crate::energy::Tabulated;
use crate::math::{Real, Rgb, Vec3};
use crate::ndf::{Ggx, Masking};
use crate::vndf::{Sampler, VisibleNormals};
use interface::{EntranceInRow, Interface, RoughEntrance, SmoothEntrance};

/// Lambert under a dielectric coat, by Mitsuba 3's formulas:
///
/// ```text
/// f = specular F G2 D / (4 |wo.z| |wi.z|)  +  T(wo) T(wi) / eta^2  base / pi
/// base = diffuse / (1 - r R_int),   r = diffuse where nonlinear, else 1
/// ```
///
/// A smooth coat has a Dirac delta of strength `specular F` for its first part. `T` and `R_int` are
/// those of `interface` in this module.
///
/// Reciprocal above the horizon; a backfacing view (`wo.z < 0`) is continued as
/// [`Ndf::g2_over_cos`](crate::ndf::Ndf::g2_over_cos) says, with `T` of its mirror image.
///
/// # Known limitations of the model
///
/// * A white base does not return all light: `T` and `R_int` of a rough coat leave out what meets a
///   second facet (as much as a fifth at alpha 0.4), where [`CoatedDiffuse`](super::CoatedDiffuse)
///   counts it.
/// * Where `nonlinear` is not set, the base is not darkened and saturated by the light that bounces
///   below the coat: it takes the colour of the texture.
/// * The fit for smooth coats makes light at high indices: 2.3 % at 2.4 (test
///   `no_plastic_makes_light`).
/// * It has one side: from behind it is black; a renderer binds [`Black`](super::Black) there.
///
/// Source: Mitsuba 3's documentation of the two plugins; the smooth coat's is the model of Jakob's
/// Mitsuba 0.6. A test holds values of Mitsuba 3.9.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plastic<T, N = Ggx<T>> {
    pub(crate) coat: Option<N>,
    masking: Masking,
    sampler: Sampler,
    eta: T,
    specular: Rgb<T>,
    diffuse: Rgb<T>,
    /// `diffuse / (eta^2 (1 - r R_int))`.
    base: Rgb<T>,
    /// `R_int`.
    internal: T,
    nonlinear: bool,
    interface: Interface<T>,
}

impl<T: Real> Plastic<T> {
    /// Mitsuba's `plastic`: a smooth coat.
    ///
    /// * `eta`: index of the coat over that outside, clamped to `[1/3, 3]`.
    /// * `diffuse`: albedo of the base, in `[0, 1]`.
    /// * `specular`: factor on the coat's reflection, 1 in nature.
    /// * `nonlinear`: whether light between coat and base takes the base's colour at every bounce.
    #[inline]
    pub fn smooth(eta: T, diffuse: Rgb<T>, specular: Rgb<T>, nonlinear: bool) -> Self {
        let eta = eta.within(T::of(1.0 / 3.0), T::of(3.0));
        let interface = Interface::smooth();
        let internal = interface::smooth_internal_reflectance(eta);
        let series = (internal, nonlinear);
        Self::of((None, Masking::default()), eta, specular, interface, series).over(diffuse)
    }
}

impl<T: Real, N: Tabulated<T>> Plastic<T, N> {
    /// Mitsuba's `roughplastic`: a coat of the normals `ndf`.
    ///
    /// * `masking`: [`Masking::Separable`] is Mitsuba's.
    /// * `eta`: index of the coat over that outside, clamped to `[1, 3]`.
    /// * `diffuse`: albedo of the base, in `[0, 1]`.
    /// * `specular`: factor on the coat's reflection, 1 in nature.
    /// * `nonlinear`: whether light between coat and base takes the base's colour at every bounce.
    #[inline]
    pub fn rough(
        ndf: N,
        masking: Masking,
        eta: T,
        diffuse: Rgb<T>,
        specular: Rgb<T>,
        nonlinear: bool,
    ) -> Self {
        let eta = eta.within(T::ONE, T::of(3.0));
        let (interface, internal) = Interface::rough(ndf, eta);
        let series = (internal, nonlinear);
        Self::of((Some(ndf), masking), eta, specular, interface, series).over(diffuse)
    }
}

impl<T: Real, N: VisibleNormals<T>> Plastic<T, N> {
    #[inline]
    fn of(
        (coat, masking): (Option<N>, Masking),
        eta: T,
        specular: Rgb<T>,
        interface: Interface<T>,
        (internal, nonlinear): (T, bool),
    ) -> Self {
        Self {
            coat,
            masking,
            sampler: Sampler::default(),
            eta,
            specular,
            diffuse: Rgb::BLACK,
            base: Rgb::BLACK,
            internal,
            nonlinear,
            interface,
        }
    }

    /// The same coat over another base: what does not depend on the base is not looked up again.
    ///
    /// * `diffuse`: albedo of the base, in `[0, 1]`.
    #[inline]
    #[must_use]
    pub fn over(self, diffuse: Rgb<T>) -> Self {
        let scale = T::ONE / (self.eta * self.eta);
        let base = diffuse.map(|rho| {
            let back = T::select(self.nonlinear, rho, T::ONE);
            scale * rho / (T::ONE - back * self.internal)
        });
        Self {
            diffuse,
            base,
            ..self
        }
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

    /// The base under its coat.
    ///
    /// * `interface`: what looks the interface up.
    #[inline(always)]
    fn under<I>(&self, interface: I) -> UnderCoat<T, I> {
        UnderCoat {
            eta: self.eta,
            specular: self.specular,
            albedo: self.diffuse,
            base: self.base,
            interface,
        }
    }

    /// The same under a rough coat.
    #[inline(always)]
    pub(crate) fn under_rough<I>(&self, ndf: N, interface: I) -> UnderRough<T, N, I> {
        UnderRough {
            under: self.under(interface),
            ndf,
            masking: self.masking,
            sampler: self.sampler,
        }
    }

    /// The same under a smooth coat.
    #[inline(always)]
    pub(crate) fn under_smooth(&self) -> UnderSmooth<T, SmoothEntrance<T>> {
        UnderSmooth(self.under(SmoothEntrance { eta: self.eta }))
    }

    /// The interface of a rough coat.
    #[inline(always)]
    fn entrance(&self) -> RoughEntrance<'_, T> {
        RoughEntrance {
            eta: self.eta,
            interface: &self.interface,
        }
    }

    /// The same for batches.
    #[inline(always)]
    pub(crate) fn entrance_in_row(&self) -> EntranceInRow<T> {
        EntranceInRow {
            eta: self.eta,
            interface: self.interface,
        }
    }
}

impl<T: Real> Plastic<T> {
    /// The same material, its coat sampled by another sampler.
    #[inline(always)]
    #[must_use]
    pub fn with_sampler(self, sampler: Sampler) -> Self {
        Self { sampler, ..self }
    }
}

impl<T: Real, N: VisibleNormals<T>> Bsdf<T> for Plastic<T, N> {
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
            Some(ndf) => self.under_rough(ndf, self.entrance()).sample_alone(wo, u),
            None => self.under_smooth().sample_alone(wo, u),
        }
    }

    #[inline]
    fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>, _transport: Transport) -> (Rgb<T>, T) {
        match self.coat {
            Some(ndf) => (self.under_rough(ndf, self.entrance())).eval_pdf_alone(wo, wi),
            None => self.under_smooth().eval_pdf_alone(wo, wi),
        }
    }

    #[inline(always)]
    fn albedo(&self) -> Rgb<T> {
        self.diffuse
    }
}
