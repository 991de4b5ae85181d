//! A distribution of normals of one's own: a share of sharp GGX in blunt GGX, as on hazy metal.
//!
//! The projected area is linear in the distribution, so masking and visible normals of a mixture follow
//! from those of its parts.
#![allow(clippy::print_stdout, reason = "an example prints")]

use std::error::Error;

use specula_bsdf::bsdf::RoughConductor;
use specula_bsdf::fresnel::Reflectance;
use specula_bsdf::math::{Real, vec3};
use specula_bsdf::ndf::{Ggx, Ndf};
use specula_bsdf::vndf::VisibleNormals;
use specula_bsdf::{Alpha, Bsdf, Rgb, Transport, Vec3};

#[derive(Clone, Copy, Debug)]
struct Hazy<T> {
    parts: [Ggx<T>; 2],
    /// Share of the second part.
    haze: T,
}

impl<T: Real> Hazy<T> {
    fn mix(&self, of: impl Fn(&Ggx<T>) -> T) -> T {
        of(&self.parts[0]) * (T::ONE - self.haze) + of(&self.parts[1]) * self.haze
    }
}

impl<T: Real> Ndf<T> for Hazy<T> {
    fn alpha(&self) -> Alpha<T> {
        self.parts[0].alpha()
    }

    fn d(&self, wm: Vec3<T>) -> T {
        self.mix(|ggx| ggx.d(wm))
    }

    fn projected_area(&self, w: Vec3<T>) -> T {
        self.mix(|ggx| ggx.projected_area(w))
    }

    fn lambda_cos(&self, w: Vec3<T>) -> T {
        self.mix(|ggx| ggx.lambda_cos(w))
    }
}

impl<T: Real> VisibleNormals<T> for Hazy<T> {
    fn sample_wm(&self, wo: Vec3<T>, u: [T; 2]) -> Vec3<T> {
        // Each part by what is seen of it; the random number that chose is used again.
        let seen = self.haze * self.parts[1].projected_area(wo) / self.projected_area(wo);
        if u[0] < seen {
            self.parts[1].sample_wm(wo, [u[0] / seen, u[1]])
        } else {
            self.parts[0].sample_wm(wo, [(u[0] - seen) / (T::ONE - seen), u[1]])
        }
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let ndf = Hazy {
        parts: [
            Ggx::new(Alpha::new(0.05, 0.05)?),
            Ggx::new(Alpha::new(0.4, 0.4)?),
        ],
        haze: 0.3,
    };
    let lobe = RoughConductor::new(ndf, Reflectance::Constant(Rgb::splat(0.9)));
    let sample = lobe.sample(
        vec3(0.6_f64, 0.0, 0.8),
        [0.1, 0.2, 0.3],
        Transport::Radiance,
    );
    let sample = sample.ok_or("below the horizon")?;
    println!("towards {:?}, pdf {}", sample.wi, sample.pdf);
    Ok(())
}
