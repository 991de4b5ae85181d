//! Energy-preserving Oren-Nayar diffuse reflection (EON).
//!
//! Source: Portsmouth, Kutz and Hill 2025, EON: A practical energy-preserving rough diffuse BRDF,
//! JCGT 14(1). With `r` the roughness, `s = wi . wo - mu_i mu_o` and
//! `t = max(mu_i, mu_o)` where `s > 0`, else 1:
//!
//! ```text
//! f = rho/pi A (1 + r s/t) + rho_ms/pi (1 - E(mu_o)) (1 - E(mu_i)) / (1 - Eavg)
//! A = 1 / (1 + (1/2 - 2/(3 pi)) r)
//! E(mu) = A (1 + r G(mu)/pi)
//! G(mu) = sin (theta - sin cos) + 2/3 (tan (1 - sin^3) - sin)
//! Eavg = A (1 + (2/3 - 28/(15 pi)) r)
//! rho_ms = rho^2 Eavg / (1 - rho (1 - Eavg))
//! ```
//!
//! Departure: directions are sampled with density `cos / pi`, not from the paper's fitted clipped
//! transform; weights stay below 2.

use super::{Bsdf, BsdfSample, Transport};
use crate::math::{Real, Rgb, Vec3, acos, warp};

/// Rough diffuse reflection; roughness 0 is Lambert.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eon<T> {
    pub(crate) albedo: Rgb<T>,
    pub(crate) roughness: T,
}

impl<T: Real> Eon<T> {
    /// * `albedo`: in `[0, 1]`, the `rho` of the formulas.
    /// * `roughness`: clamped to `[0, 1]`.
    #[inline(always)]
    pub fn new(albedo: Rgb<T>, roughness: T) -> Self {
        Self {
            albedo,
            roughness: roughness.within(T::ZERO, T::ONE),
        }
    }

    /// `A` of the formulas.
    #[inline(always)]
    fn scale(&self) -> T {
        T::ONE / (T::ONE + T::of(0.5 - 2.0 / (3.0 * core::f64::consts::PI)) * self.roughness)
    }

    /// Directional albedo `E(mu)` of the single-scattering part for a white surface.
    #[inline(always)]
    fn single_scatter_albedo(&self, mu: T) -> T {
        let mu = mu.within(T::ZERO, T::ONE);
        let sine = ((T::ONE - mu) * (T::ONE + mu)).safe_sqrt();
        let theta = acos(mu);
        // tan (1 - sin^3) without its division by a vanishing cosine.
        let tail = sine * mu * (T::ONE + sine + sine * sine) / (T::ONE + sine);
        let g = sine * (theta - sine * mu) + T::of(2.0 / 3.0) * (tail - sine);
        self.scale() * (T::ONE + self.roughness * g * T::INV_PI)
    }

    /// `f(wo, wi)` in 1/sr; both above the horizon.
    #[inline(always)]
    fn f(&self, wo: Vec3<T>, wi: Vec3<T>) -> Rgb<T> {
        // A backfacing shading normal is treated as grazing.
        let mu_o = wo.z.within(T::ZERO, T::ONE);
        let mu_i = wi.z.at_most(T::ONE);
        let s = wo.dot(wi) - wo.z * wi.z;
        let s_over_t = T::select(s > T::ZERO, s / mu_i.at_least(mu_o), s);
        let single = self.scale() * (T::ONE + self.roughness * s_over_t);

        let average = self.scale()
            * (T::ONE + T::of(2.0 / 3.0 - 28.0 / (15.0 * core::f64::consts::PI)) * self.roughness);
        let loss = T::ONE - average;
        // The inverse is the same for all directions: batches divide once.
        let multiple = (T::ONE - self.single_scatter_albedo(mu_o)).at_least(T::ZERO)
            * (T::ONE - self.single_scatter_albedo(mu_i)).at_least(T::ZERO)
            * (T::ONE / loss.at_least(T::EPSILON));
        self.albedo.map(|rho| {
            let rho_multiple = rho * rho * average / (T::ONE - rho * loss);
            (rho * single + rho_multiple * multiple).at_least(T::ZERO) * T::INV_PI
        })
    }
}

impl<T: Real> Bsdf<T> for Eon<T> {
    #[inline(always)]
    fn eval(&self, wo: Vec3<T>, wi: Vec3<T>, _transport: Transport) -> Rgb<T> {
        let f_cos = self.f(wo, wi) * wi.z;
        // Selected at the end, so that batches have no branches.
        if wi.z > T::ZERO { f_cos } else { Rgb::BLACK }
    }

    #[inline(always)]
    fn pdf(&self, _wo: Vec3<T>, wi: Vec3<T>) -> T {
        warp::cosine_hemisphere_pdf(wi)
    }

    #[inline(always)]
    fn sample(&self, wo: Vec3<T>, u: [T; 3], _transport: Transport) -> Option<BsdfSample<T>> {
        let wi = warp::cosine_hemisphere([u[1], u[2]]);
        BsdfSample::reflected(wi, self.f(wo, wi) * T::PI, warp::cosine_hemisphere_pdf(wi))
    }

    #[inline(always)]
    fn albedo(&self) -> Rgb<T> {
        self.albedo
    }
}
