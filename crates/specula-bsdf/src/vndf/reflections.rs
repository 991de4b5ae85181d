//! Many reflections of one view: what depends on the view alone is computed once.
//!
//! All samplers share the density `D(wm) / (4 N(wo))`. With `N` stored, a density costs `D` alone:
//! no square root and one division. For anisotropic alphas the cone of `exact` is stored as well,
//! which is most of a sample's cost. Worth it from the second use of a view on: several light samples
//! at a shading point, resampling, mixtures with guided distributions.

use super::exact::Cone;
use super::{Sampler, above, exact, reflect_unnormalised, reflection_density};
use crate::alpha::Alpha;
use crate::math::{Real, Vec3};
use crate::ndf::Ggx;

/// The reflections of one view off visible GGX normals.
///
/// ```
/// use specula_bsdf::vndf::{Reflections, Sampler};
/// use specula_bsdf::{Alpha, Vec3};
///
/// let wo = Vec3 { x: 0.6_f64, y: 0.0, z: 0.8 };
/// let reflections = Reflections::new(Alpha::clamped(0.1, 0.8), wo, Sampler::Exact);
/// let wi = reflections.sample([0.3, 0.7]).expect("none is rejected");
/// assert!(reflections.pdf(wi) > 0.0);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Reflections<T> {
    alpha: Alpha<T>,
    pub(crate) wo: Vec3<T>,
    sampler: Sampler,
    /// `N`, in which the samplers differ.
    pub(crate) norm: T,
    /// The valid half vectors, where a sample needs them.
    cone: Option<Cone<T>>,
}

impl<T: Real> Reflections<T> {
    /// The reflections of `wo`.
    ///
    /// * `wo`: unit, any hemisphere; below the horizon all samplers use the whole cap.
    #[inline(always)]
    pub fn new(alpha: Alpha<T>, wo: Vec3<T>, sampler: Sampler) -> Self {
        let cone = (sampler == Sampler::Exact && wo.z > T::ZERO && alpha.x != alpha.y)
            .then(|| Cone::new(alpha, wo));
        let norm = match cone {
            Some(cone) => {
                let (top, bottom) = cone.norm();
                top / bottom
            }
            None => Ggx::new(alpha).reflection_norm(sampler, wo),
        };
        Self {
            alpha,
            wo,
            sampler,
            norm,
            cone,
        }
    }

    /// `N` of `pdf = D(wm) / (4 N)`.
    #[inline(always)]
    pub fn norm(&self) -> T {
        self.norm
    }

    /// A reflection, perhaps below the horizon (never, but for rounding, with [`Sampler::Exact`]).
    ///
    /// * `u`: uniform in `[0, 1)^2`, as the sampler's own function takes it.
    #[inline(always)]
    pub fn sample_direction(&self, u: [T; 2]) -> Vec3<T> {
        let (alpha, wo) = (self.alpha, self.wo);
        match &self.cone {
            Some(cone) => reflect_unnormalised(wo, exact::half_vector(alpha, cone, u)),
            None => Ggx::new(alpha).sample_reflection(self.sampler, wo, u),
        }
    }

    /// A reflection; `None` below the horizon.
    #[inline(always)]
    pub fn sample(&self, u: [T; 2]) -> Option<Vec3<T>> {
        above(self.sample_direction(u))
    }

    /// Density of [`sample`](Self::sample) in 1/sr: `D(wm) / (4 N)`; 0 where `wi.z <= 0`.
    #[inline(always)]
    pub fn pdf(&self, wi: Vec3<T>) -> T {
        reflection_density(self.alpha, self.wo, wi, (self.norm, T::ONE))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Stream, warp};

    const SAMPLERS: [Sampler; 4] = [
        Sampler::Heitz,
        Sampler::Cap,
        Sampler::Bounded,
        Sampler::Exact,
    ];

    /// Directions are the sampler's own bit for bit, densities within rounding.
    #[test]
    fn equals_the_functions_of_each_sampler() {
        let mut stream = Stream::new(7);
        for sampler in SAMPLERS {
            for (ax, ay) in [(0.3, 0.3), (0.1, 0.8), (2.0, 0.05), (1e-3, 1e-3)] {
                let alpha = Alpha::clamped(ax, ay);
                let ggx = Ggx::new(alpha);
                for _ in 0..200 {
                    let wo: Vec3<f64> = warp::uniform_sphere([stream.next(), stream.next()]);
                    let reflections = Reflections::new(alpha, wo, sampler);
                    let u = [stream.next(), stream.next()];
                    let wi = ggx.sample_reflection(sampler, wo, u);
                    assert_eq!(
                        reflections.sample_direction(u),
                        wi,
                        "{sampler} {ax} {ay} {wo:?}"
                    );
                    assert_eq!(reflections.sample(u).is_some(), wi.z > 0.0);
                    let half = wo + wi;
                    let d = ggx.d_along(half, half.length_squared());
                    let pdf = d / (4.0 * ggx.reflection_norm(sampler, wo));
                    let expected = if wi.z > 0.0 && half.z > 0.0 { pdf } else { 0.0 };
                    let pdf = reflections.pdf(wi);
                    assert!(
                        (pdf - expected).abs() <= 1e-12 * expected,
                        "{sampler} {ax} {ay} {wo:?}: {pdf} {expected}"
                    );
                }
            }
        }
    }
}
