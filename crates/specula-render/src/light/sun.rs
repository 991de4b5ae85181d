//! A round light infinitely far away.

use specula_bsdf::math::vec3;
use specula_bsdf::{Frame, Real, Rgb, Vec3};

use crate::convert::{narrow, narrow3};
use crate::words::Words;

/// The same radiance from every direction within a cone.
#[derive(Clone, Debug)]
pub(super) struct Sun {
    frame: Frame<f32>,
    radiance: Rgb<f32>,
    /// `1 - cos` of the half angle.
    one_minus_cos: f32,
}

impl Sun {
    /// * `irradiance`: on a surface that faces it: `E = pi L sin^2(half angle)`.
    /// * `half_angle_deg`: in (0, 90].
    pub(super) fn new(irradiance: Rgb<f32>, to_light: [f64; 3], half_angle_deg: f64) -> Self {
        let half_angle = half_angle_deg.to_radians();
        let half_sine = (0.5 * half_angle).sin();
        let per_irradiance = 1.0 / (core::f64::consts::PI * half_angle.sin().powi(2));
        Self {
            frame: Frame::from_normal(narrow3(glam::DVec3::from(to_light).normalize())),
            radiance: irradiance * narrow(per_irradiance),
            one_minus_cos: narrow(2.0 * half_sine * half_sine),
        }
    }

    /// Frame, radiance and size, for shaders.
    pub(super) fn flatten(&self, to: &mut Words) {
        for v in [self.frame.s, self.frame.t, self.frame.n] {
            to.vector(v);
        }
        to.colour(self.radiance);
        to.number(self.one_minus_cos);
    }

    /// Whether it is seen in the direction `wi` (unit).
    ///
    /// By the chord, `|wi - axis|^2 = 2 (1 - cos)`, which has the digits that the cosine of a
    /// small angle lacks.
    #[inline]
    fn covers(&self, wi: Vec3<f32>) -> bool {
        (wi - self.frame.n).length_squared() <= 2.0 * self.one_minus_cos
    }

    /// Radiance from a direction.
    #[inline]
    pub(super) fn radiance(&self, wi: Vec3<f32>) -> Rgb<f32> {
        if self.covers(wi) {
            self.radiance
        } else {
            Rgb::BLACK
        }
    }

    /// Density in 1/sr with which [`Sun::sample`] samples `wi`.
    #[inline]
    pub(super) fn pdf(&self, wi: Vec3<f32>) -> f32 {
        if self.covers(wi) {
            0.5 * f32::INV_PI / self.one_minus_cos
        } else {
            0.0
        }
    }

    /// A direction (unit, world), its radiance and its density.
    #[inline]
    pub(super) fn sample(&self, u: [f32; 2]) -> (Vec3<f32>, Rgb<f32>, f32) {
        let t = u[0] * self.one_minus_cos;
        let sin = (t * (2.0 - t)).sqrt();
        let phi = u[1] * core::f32::consts::TAU;
        let wi = self
            .frame
            .to_world(vec3(sin * phi.cos(), sin * phi.sin(), 1.0 - t))
            .normalize();
        (wi, self.radiance, 0.5 * f32::INV_PI / self.one_minus_cos)
    }

    /// Integral of luminance over the sphere of directions.
    pub(super) fn sampled_integral(&self) -> f64 {
        let colour = self.radiance.luminance().max(self.radiance.mean());
        f64::from(colour) * core::f64::consts::TAU * f64::from(self.one_minus_cos)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::Sampler;

    #[test]
    fn irradiance_is_given_back_for_suns_of_every_size() {
        for half_angle in [0.01, 0.2665, 10.0, 60.0, 89.0] {
            let sun = Sun::new(Rgb::splat(3.0), [0.6, 0.0, 0.8], half_angle);
            let (mut irradiance, mut outside) = (0.0, 0);
            let n = 10_000_u32;
            for i in 0..n {
                let u = Sampler::new([0, 0], i, 1).camera();
                let (wi, radiance, pdf) = sun.sample([u[0], u[1]]);
                let cos = wi.dot(vec3(0.6, 0.0, 0.8));
                irradiance += f64::from(radiance.g * cos / pdf) / f64::from(n);
                outside += u32::from(sun.pdf(wi) != pdf);
            }
            assert!(
                (irradiance - 3.0).abs() < 6e-3,
                "{half_angle}: {irradiance}"
            );
            // Rounding at the rim.
            assert!(outside < n / 1000, "{half_angle}: {outside}");
            let solid_angle = core::f64::consts::TAU * (1.0 - half_angle.to_radians().cos());
            let (_, _, pdf) = sun.sample([0.5; 2]);
            assert!((f64::from(pdf) * solid_angle - 1.0).abs() < 1e-5);
        }
    }
}
