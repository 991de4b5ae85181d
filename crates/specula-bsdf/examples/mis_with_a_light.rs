//! Direct light of a disk-shaped lamp on rough gold: samples of the lamp and of the lobe, weighted by the
//! power heuristic.
#![allow(clippy::print_stdout, reason = "an example prints")]

use std::error::Error;
use std::f64::consts::TAU;

use specula_bsdf::bsdf::RoughConductor;
use specula_bsdf::fresnel::{Reflectance, Schlick};
use specula_bsdf::math::{Frame, Stream, rgb, vec3};
use specula_bsdf::ndf::Ggx;
use specula_bsdf::{Alpha, Bsdf, Rgb, Transport, Vec3};

/// A lamp of radiance 1 that fills a cone of directions.
struct Lamp {
    axis: Vec3<f64>,
    cos_max: f64,
}

impl Lamp {
    /// A direction towards the lamp, uniform over its solid angle.
    fn sample(&self, u: [f64; 2]) -> Vec3<f64> {
        let z = 1.0 - u[0] * (1.0 - self.cos_max);
        let (sine, cosine) = (TAU * u[1]).sin_cos();
        let radius = (1.0 - z * z).sqrt();
        Frame::from_normal(self.axis).to_world(vec3(radius * cosine, radius * sine, z))
    }

    fn pdf(&self, wi: Vec3<f64>) -> f64 {
        let inside = wi.dot(self.axis) > self.cos_max;
        if inside {
            1.0 / (TAU * (1.0 - self.cos_max))
        } else {
            0.0
        }
    }
}

fn power(pdf: f64, other: f64) -> f64 {
    pdf * pdf / (pdf * pdf + other * other)
}

/// One estimate of the light towards `wo`.
fn estimate(lobe: &impl Bsdf<f64>, lamp: &Lamp, wo: Vec3<f64>, stream: &mut Stream) -> Rgb<f64> {
    let mut sum = Rgb::BLACK;
    let wi = lamp.sample([stream.next(), stream.next()]);
    let (f_cos, pdf) = lobe.eval_pdf(wo, wi, Transport::Radiance);
    sum += f_cos * (power(lamp.pdf(wi), pdf) / lamp.pdf(wi));

    let u = [stream.next(), stream.next(), stream.next()];
    if let Some(s) = lobe.sample(wo, u, Transport::Radiance) {
        // A perfect mirror has no density to weigh with: only the lobe can sample it.
        let hit = lamp.pdf(s.wi);
        let weight = if s.specular { 1.0 } else { power(s.pdf, hit) };
        if hit > 0.0 {
            sum += s.weight * weight;
        }
    }
    sum
}

fn main() -> Result<(), Box<dyn Error>> {
    let gold = Reflectance::Schlick(Schlick {
        f0: rgb(1.0, 0.72, 0.32),
    });
    let lobe = RoughConductor::new(Ggx::new(Alpha::new(0.2, 0.2)?), gold);
    let lamp = Lamp {
        axis: vec3(-0.5, 0.1, 0.85).normalize(),
        cos_max: 0.97,
    };
    let mut stream = Stream::new(3);
    let mut sum = Rgb::BLACK;
    for _ in 0..10_000 {
        sum += estimate(&lobe, &lamp, vec3(0.6, 0.0, 0.8), &mut stream);
    }
    println!("radiance {:?}", sum * 1e-4);
    Ok(())
}
