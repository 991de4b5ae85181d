//! Rough metals by Kulla and Conty, without tables.

use super::{Bsdf, BsdfSample, RoughConductor, Transport};
use crate::alpha::Alpha;
use crate::energy::fresnel_average::reflectance_average;
use crate::energy::model::further_bounces;
use crate::energy::{ggx_average_loss, ggx_loss};
use crate::fresnel::Reflectance;
use crate::math::warp::{cosine_hemisphere, cosine_hemisphere_pdf};
use crate::math::{Real, Rgb, Vec3};
use crate::ndf::Ggx;
use crate::vndf::Sampler;

/// [`Compensated`](super::Compensated) by Kulla and Conty for isotropic GGX, with polynomials
/// ([`ggx_loss`]) for the tables: what shaders take that hold none.
///
/// ```text
/// f = f_ss + F_avg F_ms L(wo) L(wi) / (pi L_avg)
/// ```
///
/// Albedos are within 2e-3: a white metal's of 1, any other's of `Compensated`'s (`specula-stat/tests/kulla_conty.rs`).
/// Reciprocal. Single scattering is sampled by bounded caps, the second lobe by the cosine. A view below the horizon
/// sees nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KullaConty<T> {
    single: RoughConductor<T>,
    alpha: T,
    /// Average reflectance of a facet.
    average: Rgb<T>,
    /// `F_avg F_ms`.
    colour: Rgb<T>,
    average_loss: T,
}

impl<T: Real> KullaConty<T> {
    /// The metal.
    ///
    /// * `alpha`: in `[1e-4, 1]`; beyond, the nearest is taken.
    #[inline]
    pub fn new(alpha: T, reflectance: Reflectance<T>) -> Self {
        let alpha = alpha.within(T::of(1e-4), T::ONE);
        let ggx = Ggx::new(Alpha::isotropic(alpha));
        let average = reflectance_average(&reflectance);
        let average_loss = ggx_average_loss(alpha);
        Self {
            single: RoughConductor::new(ggx, reflectance).with_sampler(Sampler::Bounded),
            alpha,
            average,
            colour: average * further_bounces(average, average_loss),
            average_loss,
        }
    }

    /// Probability of sampling the second lobe.
    #[inline(always)]
    fn second_share(&self, loss: T) -> T {
        let second = self.colour.max_channel() * loss;
        let first = self.average.max_channel() * (T::ONE - loss);
        second / (second + first).at_least(T::TINY)
    }
}

impl<T: Real> Bsdf<T> for KullaConty<T> {
    #[inline]
    fn eval(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> Rgb<T> {
        self.eval_pdf(wo, wi, transport).0
    }

    #[inline]
    fn pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        self.eval_pdf(wo, wi, Transport::Radiance).1
    }

    #[inline]
    fn sample(&self, wo: Vec3<T>, u: [T; 3], transport: Transport) -> Option<BsdfSample<T>> {
        let wi = if u[0] < self.second_share(ggx_loss(self.alpha, wo.z.at_least(T::ZERO))) {
            cosine_hemisphere([u[1], u[2]])
        } else {
            self.single.sample_wi(wo, u).0
        };
        let (f_cos, pdf) = self.eval_pdf(wo, wi, transport);
        if pdf > T::ZERO {
            BsdfSample::reflected(wi, f_cos / pdf, pdf)
        } else {
            None
        }
    }

    #[inline]
    fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> (Rgb<T>, T) {
        if wo.z <= T::ZERO || wi.z <= T::ZERO {
            return (Rgb::BLACK, T::ZERO);
        }
        let (first, first_pdf) = self.single.eval_pdf(wo, wi, transport);
        let cosine = cosine_hemisphere_pdf(wi);
        let loss = ggx_loss(self.alpha, wo.z);
        let shape = loss * ggx_loss(self.alpha, wi.z) * cosine / self.average_loss;
        let p = self.second_share(loss);
        (
            first + self.colour * shape,
            first_pdf + p * (cosine - first_pdf),
        )
    }

    #[inline(always)]
    fn albedo(&self) -> Rgb<T> {
        self.single.albedo()
    }
}
