//! The distribution of normals of the clear coat: a generalised Trowbridge and Reitz of exponent 1.

use crate::math::{Real, Vec3, vec3};

/// The GTR1 distribution.
///
/// Source: Burley 2012, appendix B.2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Gtr1<T> {
    /// `alpha^2`, in `(0, 1)`.
    pub(super) alpha2: T,
    /// `ln(alpha^2)`.
    pub(super) log: T,
}

impl<T: Real> Gtr1<T> {
    /// The clear coat of a gloss in `[0, 1]`: alpha from 0.1 down to 0.001.
    #[inline(always)]
    pub(super) fn of_gloss(gloss: T) -> Self {
        let alpha = T::of(0.1) + (T::of(0.001) - T::of(0.1)) * gloss;
        let alpha2 = alpha * alpha;
        Self {
            alpha2,
            log: alpha2.ln(),
        }
    }

    /// ```text
    /// D(wm) = (a^2 - 1) / (pi ln(a^2) (sin^2 + a^2 cos^2))
    /// ```
    ///
    /// with `1 + (a^2 - 1) cos^2` written without its cancellation at the peak.
    #[inline(always)]
    pub(super) fn d(&self, wm: Vec3<T>) -> T {
        let sin2 = wm.x * wm.x + wm.y * wm.y;
        let denominator = sin2 + self.alpha2 * wm.z * wm.z;
        let norm = (self.alpha2 - T::ONE) / (T::PI * self.log);
        T::select(wm.z > T::ZERO, norm / denominator, T::ZERO)
    }

    /// A normal of density `D(wm) wm.z`.
    #[inline(always)]
    pub(super) fn sample_wm(&self, u: [T; 2]) -> Vec3<T> {
        let (sin_phi, cos_phi) = u[1].sin_cos_turns();
        // a^2 to the power of 1 - u.
        let power = ((T::ONE - u[0]) * self.log).exp_below();
        let scale = T::ONE / (T::ONE - self.alpha2);
        let sin = ((power - self.alpha2) * scale).safe_sqrt();
        let cos = ((T::ONE - power) * scale).safe_sqrt();
        vec3(sin * cos_phi, sin * sin_phi, cos)
    }

    /// Masking of the clear coat: separable Smith of GGX with alpha 1/4, whatever the gloss.
    #[inline(always)]
    pub(super) fn masking(wo: Vec3<T>, wi: Vec3<T>) -> T {
        let g1 = |w: Vec3<T>| {
            let sin2 = w.x * w.x + w.y * w.y;
            let cos = w.z.abs();
            T::TWO * cos / (cos + (cos * cos + T::of(0.0625) * sin2).sqrt())
        };
        g1(wo) * g1(wi)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_are_normalised_and_sampled_by_their_density() {
        for gloss in [0.0_f64, 0.5, 1.0] {
            let gtr1 = Gtr1::of_gloss(gloss);
            // Over the sampler's own map the density must be constant: D cos dw = du.
            let n = 400;
            for i in 1..n {
                let at = |u: f64| gtr1.sample_wm([u, 0.0]).z;
                let u = f64::from(i) / f64::from(n);
                let step = 1e-6;
                let dz = (at(u + step) - at(u - step)).abs() / (2.0 * step);
                let wm = gtr1.sample_wm([u, 0.0]);
                let density = core::f64::consts::TAU * gtr1.d(wm) * wm.z * dz;
                assert!((density - 1.0).abs() < 1e-4, "{gloss} {u}: {density}");
            }
            assert!((gtr1.sample_wm([0.3, 0.7]).length() - 1.0).abs() < 1e-12);
        }
    }
}
