//! What the lights of a scene answer, for tests of their twins in shaders.

use specula_bsdf::{Rgb, Vec3};

use super::{LightSample, Receiver, Target};
use crate::geometry::{At, Surface};
use crate::prepared::PreparedScene;

/// A point to be lit, and its normal; `None` where light from every side counts.
type Lit = ([f32; 3], Option<[f32; 3]>);

fn receiver((point, normal): Lit) -> Receiver {
    Receiver {
        point: Vec3::from(point),
        normal: normal.map(Vec3::from),
    }
}

impl PreparedScene {
    /// What a light sends that `u` leads to: direction (3), density, radiance (3), whether the light
    /// is without extent, target, its error and its normal (3 each), whether from infinity.
    #[doc(hidden)]
    pub fn probe_light(&self, lit: Lit, u: [f32; 4]) -> Option<[f32; 18]> {
        let world = (&self.geometry, &self.textures);
        let sampled = self.lights.sample(&receiver(lit), world, u)?;
        let LightSample {
            wi,
            radiance,
            pdf,
            delta,
            from,
        } = sampled;
        let mut answer = [0.0; 18];
        answer[..3].copy_from_slice(&wi.to_array());
        answer[3] = pdf;
        answer[4..7].copy_from_slice(&radiance.to_array());
        answer[7] = f32::from(u8::from(delta));
        answer[17] = f32::from(u8::from(from.is_none()));
        if let Some(Target {
            point,
            error,
            normal,
        }) = from
        {
            for (i, v) in [point, error, normal].into_iter().enumerate() {
                answer[8 + 3 * i..11 + 3 * i].copy_from_slice(&v.to_array());
            }
        }
        Some(answer)
    }

    /// Density with which a point of a light's surface is sampled.
    ///
    /// * `weights`: of its primitive's second and third corner.
    #[doc(hidden)]
    pub fn probe_light_pdf(
        &self,
        lit: Lit,
        light: u32,
        position: [f32; 3],
        normal: [f32; 3],
        weights: [f32; 2],
    ) -> f32 {
        let surface = Surface {
            position: Vec3::from(position),
            error: Vec3::ZERO,
            ng: Vec3::from(normal),
            ns: Vec3::from(normal),
            tangent: Vec3::ZERO,
            uv: [0.0; 2],
            second_uv: [0.0; 2],
            colour: Rgb::WHITE,
            shape: 0,
            light,
            at: At {
                weights,
                ..At::default()
            },
        };
        self.lights.pdf_of_surface(&receiver(lit), &surface)
    }

    /// Radiance and density of every light at infinity in a direction.
    #[doc(hidden)]
    pub fn probe_infinity(&self, wi: [f32; 3]) -> Vec<[f32; 4]> {
        let arriving = self.lights.arriving_from_infinity(Vec3::from(wi));
        arriving.map(|(c, pdf)| [c.r, c.g, c.b, pdf]).collect()
    }

    /// Probability with which a light from infinity is sampled.
    #[doc(hidden)]
    pub fn probe_share_from_infinity(&self, lit: Lit) -> f32 {
        self.lights.share_from_infinity(&receiver(lit))
    }
}
