//! A rough or smooth dielectric coat over Lambert: paint, plastic, polished wood, glazed tiles.
//!
//! The model is closed form. A Lambertian base forgets where its light came from, so the coat acts
//! on it only through two numbers of the interface: the share `T(w)` of light from direction `w`
//! that enters, and the share `R_int` of diffuse light from below that is thrown back:
//!
//! ```text
//! f = f_interface(wo, wi) + T(wo) T(wi) / eta^2  rho/pi / (1 - rho R_int)
//! ```
//!
//! The series of bounces between base and coat is the geometric one, summed. For a coat without
//! absorption or thickness this is exactly the limit that a stochastic walk between the layers
//! (Guo et al. 2018; pbrt-v4's `coateddiffuse`) converges to, without its noise and without its
//! cut at a number of bounces. With a white base and a smooth coat it returns all light.
//!
//! `T` and `R_int` are exact for a smooth coat, and tables made by quadrature for a rough one
//! (`energy/interface.rs`).

use super::{Bsdf, BsdfSample, Event, Transport};
use crate::energy::interface;
use crate::fresnel::dielectric;
use crate::math::{Real, Rgb, Vec3, vec3, warp};
use crate::ndf::{Ggx, Masking, Ndf};
use crate::vndf::Sampler;

/// Lambert under a dielectric coat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoatedDiffuse<T> {
    pub(crate) coat: Option<Ggx<T>>,
    pub(crate) eta: T,
    pub(crate) albedo: Rgb<T>,
    /// `rho / (eta^2 (1 - rho R_int))`: the base with all bounces, before `T(wo) T(wi) / pi`.
    pub(crate) base: Rgb<T>,
    pub(crate) sampler: Sampler,
}

impl<T: Real> CoatedDiffuse<T> {
    /// * `coat`: distribution of the coat's normals; `None` for a smooth coat.
    /// * `eta`: index of the coat over that outside, clamped to `[1, 3]`.
    /// * `albedo`: of the base, in `[0, 1]`.
    #[inline]
    pub fn new(coat: Option<Ggx<T>>, eta: T, albedo: Rgb<T>) -> Self {
        let eta = Real::clamp(eta, T::ONE, T::of(3.0));
        let internal = interface::internal_reflectance(coat, eta);
        let scale = T::ONE / (eta * eta);
        Self {
            coat,
            eta,
            albedo,
            base: albedo.map(|rho| scale * rho / (T::ONE - rho * internal)),
            sampler: Sampler::default(),
        }
    }

    /// The same material, its coat drawn by another sampler.
    #[inline(always)]
    #[must_use]
    pub fn with_sampler(self, sampler: Sampler) -> Self {
        Self { sampler, ..self }
    }

    /// Share of light from `w` that enters the coat.
    #[inline(always)]
    fn transmittance(&self, w: Vec3<T>) -> T {
        interface::transmittance(self.coat, self.eta, w.z.abs())
    }

    /// Probability of drawing the coat's reflection; 0 for a mirror that faces away.
    #[inline(always)]
    fn coat_probability(&self, entering: T, wo: Vec3<T>) -> T {
        let reflected = T::ONE - entering;
        let diffuse = entering * self.albedo.max_channel();
        let visible = self.coat.is_some() || wo.z > T::ZERO;
        let share = reflected / Real::max(reflected + diffuse, T::TINY);
        T::select(visible, share, T::ZERO)
    }

    /// The base's part of `f |cos|`.
    #[inline(always)]
    fn base_f_cos(&self, entering: T, wi: Vec3<T>) -> Rgb<T> {
        self.base * (entering * self.transmittance(wi) * warp::cosine_hemisphere_pdf(wi))
    }
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
    fn sample(&self, wo: Vec3<T>, u: [T; 3], transport: Transport) -> Option<BsdfSample<T>> {
        let entering = self.transmittance(wo);
        let p = self.coat_probability(entering, wo);
        let direction = [u[1], u[2]];
        let wi = if u[0] < p {
            match self.coat {
                Some(ggx) => ggx.sample_reflection(self.sampler, wo, direction),
                None => {
                    let weight = Rgb::splat((T::ONE - entering) / p);
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
        let mut f_cos = self.base_f_cos(entering, wi);
        let mut pdf = (T::ONE - p) * warp::cosine_hemisphere_pdf(wi);
        if let Some(ggx) = self.coat {
            let wm = (wo + wi).normalize();
            if wm.z > T::ZERO {
                let quarter = T::of(0.25) * ggx.d(wm);
                let fresnel = dielectric(wo.dot(wm), self.eta).reflectance;
                let shadowed = ggx.g2_over_cos(Masking::HeightCorrelated, wo, wi);
                f_cos += Rgb::splat(fresnel * quarter * shadowed);
                pdf += p * quarter / ggx.reflection_norm(self.sampler, wo);
            }
        }
        (f_cos, pdf)
    }

    #[inline(always)]
    fn albedo(&self) -> Rgb<T> {
        self.albedo
    }
}
