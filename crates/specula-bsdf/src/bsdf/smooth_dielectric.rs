//! Smooth dielectrics: one interface, and a thin pane of two.

use super::{Bsdf, BsdfSample, Event, Tints, Transport};
use crate::fresnel::{dielectric, refract};
use crate::math::{Real, Rgb, Vec3, vec3};

/// A smooth interface between two dielectrics.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmoothDielectric<T> {
    pub(crate) eta: T,
    pub(crate) two_sided: bool,
    pub(crate) tints: Tints<T>,
}

impl<T: Real> SmoothDielectric<T> {
    /// An interface with both sides: `wo.z < 0` views it from inside.
    ///
    /// * `eta`: index inside over index outside, above 0.
    #[inline(always)]
    pub fn new(eta: T) -> Self {
        Self {
            eta,
            two_sided: true,
            tints: Tints::WHITE,
        }
    }

    /// An interface as seen from the geometric side of `wo`; a backfacing shading normal
    /// (`wo.z < 0`) gives no sample.
    ///
    /// * `eta`: index beyond the interface over the index on the side of `wo`.
    #[inline(always)]
    pub fn facing(eta: T) -> Self {
        Self {
            eta,
            two_sided: false,
            tints: Tints::WHITE,
        }
    }

    /// The same surface with factors on its two branches.
    #[inline(always)]
    #[must_use]
    pub fn with_tints(self, tints: Tints<T>) -> Self {
        Self { tints, ..self }
    }
}

impl<T: Real> Bsdf<T> for SmoothDielectric<T> {
    #[inline(always)]
    fn eval(&self, _wo: Vec3<T>, _wi: Vec3<T>, _transport: Transport) -> Rgb<T> {
        Rgb::BLACK
    }

    #[inline(always)]
    fn pdf(&self, _wo: Vec3<T>, _wi: Vec3<T>) -> T {
        T::ZERO
    }

    #[inline(always)]
    fn sample(&self, wo: Vec3<T>, u: [T; 3], transport: Transport) -> Option<BsdfSample<T>> {
        let inside = wo.z < T::ZERO;
        if wo.z == T::ZERO || (inside && !self.two_sided) {
            return None;
        }
        let eta = T::select(inside, T::ONE / self.eta, self.eta);
        let bent = dielectric(wo.z.abs(), eta);
        if u[0] < bent.reflectance {
            let wi = vec3(-wo.x, -wo.y, wo.z);
            return Some(BsdfSample::delta(
                wi,
                self.tints.reflection,
                bent.reflectance,
                Event::Reflection,
                T::ONE,
            ));
        }
        let normal = vec3(T::ZERO, T::ZERO, T::ONE.copysign(wo.z));
        let wi = refract(wo, normal, wo.z.abs(), bent.cos_t, eta);
        let weight = match transport {
            Transport::Radiance => T::ONE / (eta * eta),
            Transport::Importance => T::ONE,
        };
        Some(BsdfSample::delta(
            wi,
            self.tints.transmission * weight,
            bent.transmittance,
            Event::Transmission,
            eta,
        ))
    }

    #[inline(always)]
    fn is_specular(&self) -> bool {
        true
    }

    #[inline(always)]
    fn albedo(&self) -> Rgb<T> {
        Rgb::WHITE
    }
}

/// A pane so thin that light leaves it where it entered: both interfaces with all reflections
/// between them, `R = 2 F / (1 + F)`, and transmission straight on.
///
/// Source: Stokes 1862 (the pile of plates), as in pbrt-v4's `thindielectric`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThinDielectric<T> {
    pub(crate) eta: T,
    pub(crate) tints: Tints<T>,
}

impl<T: Real> ThinDielectric<T> {
    /// * `eta`: index of the pane over that around it, above 0.
    #[inline(always)]
    pub fn new(eta: T) -> Self {
        Self {
            eta,
            tints: Tints::WHITE,
        }
    }

    /// The same surface with factors on its two branches.
    #[inline(always)]
    #[must_use]
    pub fn with_tints(self, tints: Tints<T>) -> Self {
        Self { tints, ..self }
    }
}

impl<T: Real> Bsdf<T> for ThinDielectric<T> {
    #[inline(always)]
    fn eval(&self, _wo: Vec3<T>, _wi: Vec3<T>, _transport: Transport) -> Rgb<T> {
        Rgb::BLACK
    }

    #[inline(always)]
    fn pdf(&self, _wo: Vec3<T>, _wi: Vec3<T>) -> T {
        T::ZERO
    }

    #[inline(always)]
    fn sample(&self, wo: Vec3<T>, u: [T; 3], _transport: Transport) -> Option<BsdfSample<T>> {
        let single = dielectric(wo.z.abs(), self.eta).reflectance;
        let reflectance = T::TWO * single / (T::ONE + single);
        Some(if u[0] < reflectance {
            let wi = vec3(-wo.x, -wo.y, wo.z);
            let tint = self.tints.reflection;
            BsdfSample::delta(wi, tint, reflectance, Event::Reflection, T::ONE)
        } else {
            let probability = T::ONE - reflectance;
            let tint = self.tints.transmission;
            BsdfSample::delta(-wo, tint, probability, Event::Transmission, T::ONE)
        })
    }

    #[inline(always)]
    fn is_specular(&self) -> bool {
        true
    }

    #[inline(always)]
    fn albedo(&self) -> Rgb<T> {
        Rgb::WHITE
    }
}
