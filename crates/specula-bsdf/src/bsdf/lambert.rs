//! Lambert's diffuse reflection, and the two-sided sheet that also transmits.

use super::{Bsdf, BsdfSample, Event, Transport};
use crate::math::{Real, Rgb, Vec3, vec3, warp};

/// `f = albedo / pi`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lambert<T> {
    albedo: Rgb<T>,
}

impl<T: Real> Lambert<T> {
    /// * `albedo`: in `[0, 1]`.
    #[inline(always)]
    pub fn new(albedo: Rgb<T>) -> Self {
        Self { albedo }
    }
}

impl<T: Real> Bsdf<T> for Lambert<T> {
    #[inline(always)]
    fn eval(&self, _wo: Vec3<T>, wi: Vec3<T>, _transport: Transport) -> Rgb<T> {
        self.albedo * warp::cosine_hemisphere_pdf(wi)
    }

    #[inline(always)]
    fn pdf(&self, _wo: Vec3<T>, wi: Vec3<T>) -> T {
        warp::cosine_hemisphere_pdf(wi)
    }

    #[inline(always)]
    fn sample(&self, _wo: Vec3<T>, u: [T; 3], _transport: Transport) -> Option<BsdfSample<T>> {
        let wi = warp::cosine_hemisphere([u[1], u[2]]);
        BsdfSample::reflected(wi, self.albedo, warp::cosine_hemisphere_pdf(wi))
    }

    #[inline(always)]
    fn albedo(&self) -> Rgb<T> {
        self.albedo
    }
}

/// A thin sheet: Lambert on the side of the viewer and on the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiffuseTransmission<T> {
    pub(crate) reflectance: Rgb<T>,
    pub(crate) transmittance: Rgb<T>,
}

impl<T: Real> DiffuseTransmission<T> {
    /// * `reflectance`, `transmittance`: in `[0, 1]`, their sum at most 1 for a passive sheet.
    #[inline(always)]
    pub fn new(reflectance: Rgb<T>, transmittance: Rgb<T>) -> Self {
        Self {
            reflectance,
            transmittance,
        }
    }

    /// Probability of the reflected side.
    #[inline(always)]
    fn reflection_probability(&self) -> T {
        let r = self.reflectance.max_channel();
        let t = self.transmittance.max_channel();
        T::select(r + t > T::ZERO, r / (r + t), T::ONE)
    }
}

impl<T: Real> Bsdf<T> for DiffuseTransmission<T> {
    #[inline(always)]
    fn eval(&self, _wo: Vec3<T>, wi: Vec3<T>, _transport: Transport) -> Rgb<T> {
        let colour = if wi.z > T::ZERO {
            self.reflectance
        } else {
            self.transmittance
        };
        colour * (wi.z.abs() * T::INV_PI)
    }

    #[inline(always)]
    fn pdf(&self, _wo: Vec3<T>, wi: Vec3<T>) -> T {
        let p = self.reflection_probability();
        T::select(wi.z > T::ZERO, p, T::ONE - p) * wi.z.abs() * T::INV_PI
    }

    #[inline(always)]
    fn sample(&self, wo: Vec3<T>, u: [T; 3], _transport: Transport) -> Option<BsdfSample<T>> {
        let p = self.reflection_probability();
        let w = warp::cosine_hemisphere([u[1], u[2]]);
        if u[0] < p {
            BsdfSample::reflected(w, self.reflectance / p, self.pdf(wo, w))
        } else {
            let wi = vec3(w.x, w.y, -w.z);
            BsdfSample::transmitted(
                wi,
                self.transmittance / (T::ONE - p),
                self.pdf(wo, wi),
                T::ONE,
            )
        }
    }

    #[inline(always)]
    fn albedo(&self) -> Rgb<T> {
        self.reflectance + self.transmittance
    }
}

impl<T: Real> BsdfSample<T> {
    /// A reflected sample; `None` below the horizon or where its density is not positive and finite.
    #[inline(always)]
    pub(crate) fn reflected(wi: Vec3<T>, weight: Rgb<T>, pdf: T) -> Option<Self> {
        (wi.z > T::ZERO && pdf > T::ZERO && pdf <= T::MAX).then_some(Self {
            wi,
            weight,
            pdf,
            event: Event::Reflection,
            specular: false,
            eta: T::ONE,
        })
    }

    /// A transmitted sample; `None` above the horizon or where its density is not positive and finite.
    #[inline(always)]
    pub(super) fn transmitted(wi: Vec3<T>, weight: Rgb<T>, pdf: T, eta: T) -> Option<Self> {
        (wi.z < T::ZERO && pdf > T::ZERO && pdf <= T::MAX).then_some(Self {
            wi,
            weight,
            pdf,
            event: Event::Transmission,
            specular: false,
            eta,
        })
    }

    /// A mirrored or refracted sample with probability `pdf`.
    #[inline(always)]
    pub(super) fn delta(wi: Vec3<T>, weight: Rgb<T>, pdf: T, event: Event, eta: T) -> Self {
        Self {
            wi,
            weight,
            pdf,
            event,
            specular: true,
            eta,
        }
    }
}
