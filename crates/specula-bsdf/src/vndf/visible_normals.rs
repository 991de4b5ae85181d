//! Distributions whose visible normals can be sampled.

use super::{Sampler, beckmann, bounded, cap, exact, heitz, reflect};
use crate::math::{Real, Vec3};
use crate::ndf::{Beckmann, Ggx, Ndf};

/// A distribution whose visible normals can be sampled: what a lobe samples.
///
/// A distribution of one's own needs [`sample_wm`](VisibleNormals::sample_wm) alone; the crate's
/// documentation has an example.
pub trait VisibleNormals<T: Real>: Ndf<T> {
    /// Samples a visible normal, with density [`d_visible`](Ndf::d_visible).
    ///
    /// * `wo`: unit, any hemisphere.
    /// * `u`: uniform in `[0, 1)^2`.
    fn sample_wm(&self, wo: Vec3<T>, u: [T; 2]) -> Vec3<T>;

    /// Samples a reflection of `wo`, perhaps below the horizon.
    ///
    /// * `sampler`: of account for GGX alone; lobes of other distributions cannot be given one.
    #[doc(hidden)]
    #[inline(always)]
    fn sample_reflection_by(&self, _sampler: Sampler, wo: Vec3<T>, u: [T; 2]) -> Vec3<T> {
        reflect(wo, self.sample_wm(wo, u))
    }

    /// The constant `N` of the density `D(wm) / (4 N)` of
    /// [`sample_reflection_by`](VisibleNormals::sample_reflection_by), as numerator and denominator:
    /// `sigma(wo)` where all visible normals are sampled.
    #[doc(hidden)]
    #[inline(always)]
    fn reflection_norm_quotient(&self, _sampler: Sampler, wo: Vec3<T>) -> (T, T) {
        (self.projected_area(wo), T::ONE)
    }

    /// [`reflection_norm_quotient`](VisibleNormals::reflection_norm_quotient), divided.
    #[doc(hidden)]
    #[inline(always)]
    fn reflection_norm_by(&self, sampler: Sampler, wo: Vec3<T>) -> T {
        let (top, bottom) = self.reflection_norm_quotient(sampler, wo);
        top / bottom
    }
}

impl<T: Real> Ggx<T> {
    /// Samples a reflection of `wo`, perhaps below the horizon (to be rejected).
    ///
    /// * `wo`: unit, any hemisphere.
    /// * `u`: uniform in `[0, 1)^2`.
    #[inline(always)]
    pub fn sample_reflection(&self, sampler: Sampler, wo: Vec3<T>, u: [T; 2]) -> Vec3<T> {
        let alpha = self.alpha();
        match sampler {
            Sampler::Heitz => reflect(wo, heitz::sample_wm(alpha, wo, u)),
            Sampler::Cap => cap::sample_direction(alpha, wo, u),
            Sampler::Bounded => bounded::sample_direction(alpha, wo, u),
            Sampler::Exact => exact::sample_direction(alpha, wo, u),
        }
    }

    /// The constant `N` of `pdf(wi) = D(wm) / (4 N)`, the density in 1/sr of
    /// [`sample_reflection`](Ggx::sample_reflection) above the horizon. `N = sigma(wo)` where all
    /// visible normals are sampled.
    #[inline(always)]
    pub fn reflection_norm(&self, sampler: Sampler, wo: Vec3<T>) -> T {
        self.reflection_norm_by(sampler, wo)
    }
}

impl<T: Real> VisibleNormals<T> for Ggx<T> {
    #[inline(always)]
    fn sample_wm(&self, wo: Vec3<T>, u: [T; 2]) -> Vec3<T> {
        cap::sample_wm(self.alpha(), wo, u)
    }

    #[inline(always)]
    fn sample_reflection_by(&self, sampler: Sampler, wo: Vec3<T>, u: [T; 2]) -> Vec3<T> {
        self.sample_reflection(sampler, wo, u)
    }

    #[inline(always)]
    fn reflection_norm_quotient(&self, sampler: Sampler, wo: Vec3<T>) -> (T, T) {
        match sampler {
            Sampler::Heitz | Sampler::Cap => self.projected_area_quotient(wo),
            Sampler::Bounded => bounded::norm_quotient(self.alpha(), wo),
            Sampler::Exact => exact::norm_quotient(self.alpha(), wo),
        }
    }
}

impl<T: Real> VisibleNormals<T> for Beckmann<T> {
    #[inline(always)]
    fn sample_wm(&self, wo: Vec3<T>, u: [T; 2]) -> Vec3<T> {
        beckmann::sample_wm(self.alpha(), wo, u)
    }
}
