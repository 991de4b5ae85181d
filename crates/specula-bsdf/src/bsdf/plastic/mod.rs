//! Mitsuba 3's `plastic` and `roughplastic`: a dielectric coat over Lambert.

pub(crate) mod interface;
mod interface_table;

use super::{Bsdf, BsdfSample, Event, Transport};
use crate::energy::Tabulated;
use crate::fresnel::dielectric;
use crate::math::{Real, Rgb, Vec3, vec3, warp};
use crate::ndf::{Ggx, Masking};
use crate::vndf::{Sampler, VisibleNormals};
use interface::Interface;

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
    coat: Option<N>,
    masking: Masking,
    sampler: Sampler,
    eta: T,
    specular: Rgb<T>,
    diffuse: Rgb<T>,
    /// `diffuse / (eta^2 (1 - r R_int))`.
    base: Rgb<T>,
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
        Self::of(None, Masking::default(), eta, diffuse, specular, interface)
            .with_series(internal, nonlinear)
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
        Self::of(Some(ndf), masking, eta, diffuse, specular, interface)
            .with_series(internal, nonlinear)
    }
}

impl<T: Real, N: VisibleNormals<T>> Plastic<T, N> {
    #[inline]
    fn of(
        coat: Option<N>,
        masking: Masking,
        eta: T,
        diffuse: Rgb<T>,
        specular: Rgb<T>,
        interface: Interface<T>,
    ) -> Self {
        Self {
            coat,
            masking,
            sampler: Sampler::default(),
            eta,
            specular,
            diffuse,
            base: Rgb::BLACK,
            interface,
        }
    }

    /// With the sum of the bounces between base and coat.
    #[inline]
    fn with_series(self, internal: T, nonlinear: bool) -> Self {
        let scale = T::ONE / (self.eta * self.eta);
        let base = self.diffuse.map(|rho| {
            let back = T::select(nonlinear, rho, T::ONE);
            scale * rho / (T::ONE - back * internal)
        });
        Self { base, ..self }
    }

    /// Share of light from `w` that enters the coat.
    #[inline(always)]
    fn transmittance(&self, w: Vec3<T>) -> T {
        if self.coat.is_some() {
            self.interface.transmittance(w.z.abs())
        } else {
            dielectric(w.z.abs(), self.eta).transmittance
        }
    }

    /// Probability of sampling the coat's reflection; 0 for a mirror that faces away.
    #[inline(always)]
    fn coat_probability(&self, entering: T, wo: Vec3<T>) -> T {
        let reflected = dielectric(wo.z.abs(), self.eta).reflectance * self.specular.max_channel();
        let diffuse = entering * self.diffuse.max_channel();
        let visible = self.coat.is_some() || wo.z > T::ZERO;
        let share = reflected / (reflected + diffuse).at_least(T::TINY);
        T::select(visible, share, T::ZERO)
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
    fn sample(&self, wo: Vec3<T>, u: [T; 3], transport: Transport) -> Option<BsdfSample<T>> {
        let entering = self.transmittance(wo);
        let p = self.coat_probability(entering, wo);
        let direction = [u[1], u[2]];
        let wi = if u[0] < p {
            match self.coat {
                Some(ndf) => ndf.sample_reflection_by(self.sampler, wo, direction),
                None => {
                    let reflected = dielectric(wo.z.abs(), self.eta).reflectance;
                    let weight = self.specular * (reflected / p);
                    let wi = vec3(-wo.x, -wo.y, wo.z);
                    return Some(BsdfSample::delta(wi, weight, p, Event::Reflection, T::ONE));
                }
            }
        } else {
            warp::cosine_hemisphere(direction)
        };
        let (f_cos, pdf) = self.eval_pdf(wo, wi, transport);
        BsdfSample::reflected(wi, f_cos / pdf, pdf)
    }

    #[inline]
    fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>, _transport: Transport) -> (Rgb<T>, T) {
        if wi.z <= T::ZERO {
            return (Rgb::BLACK, T::ZERO);
        }
        let entering = self.transmittance(wo);
        let p = self.coat_probability(entering, wo);
        let cosine = warp::cosine_hemisphere_pdf(wi);
        let mut f_cos = self.base * (entering * self.transmittance(wi) * cosine);
        let mut pdf = (T::ONE - p) * cosine;
        if let Some(ndf) = self.coat {
            let wm = (wo + wi).normalize_any();
            if wm.z > T::ZERO {
                let quarter = T::of(0.25) * ndf.d(wm);
                let fresnel = dielectric(wo.dot(wm), self.eta).reflectance;
                let shadowed = ndf.g2_over_cos(self.masking, wo, wi);
                f_cos += self.specular * (fresnel * quarter * shadowed);
                pdf += p * quarter / ndf.reflection_norm_by(self.sampler, wo);
            }
        }
        (f_cos, pdf)
    }

    #[inline(always)]
    fn albedo(&self) -> Rgb<T> {
        self.diffuse
    }
}
