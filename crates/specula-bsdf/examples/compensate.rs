//! Gives rough metal back what single scattering loses, and measures it in a white furnace.
#![allow(clippy::print_stdout, reason = "an example prints")]

use std::error::Error;

use specula_bsdf::bsdf::{Compensated, RoughConductor};
use specula_bsdf::energy::{EnergyModel, FmsVariant};
use specula_bsdf::fresnel::Reflectance;
use specula_bsdf::math::{Stream, vec3};
use specula_bsdf::ndf::Ggx;
use specula_bsdf::{Alpha, Bsdf, Rgb, Transport, Vec3};

/// The share of light that is reflected towards `wo`.
fn albedo(lobe: &impl Bsdf<f64>, wo: Vec3<f64>) -> f64 {
    const SAMPLES: u32 = 100_000;
    let mut stream = Stream::new(1);
    let mut sum = 0.0;
    for _ in 0..SAMPLES {
        let u = [stream.next(), stream.next(), stream.next()];
        sum += lobe
            .sample(wo, u, Transport::Radiance)
            .map_or(0.0, |s| s.weight.g);
    }
    sum / f64::from(SAMPLES)
}

fn main() -> Result<(), Box<dyn Error>> {
    let ggx = Ggx::new(Alpha::new(1.0, 1.0)?);
    let white = Reflectance::Constant(Rgb::WHITE);
    let wo = vec3(0.6, 0.0, 0.8);

    let once = albedo(&RoughConductor::new(ggx, white), wo);
    let turquin = EnergyModel::Turquin(FmsVariant::NormalIncidence);
    let whole = albedo(&Compensated::new(ggx, white, turquin), wo);
    println!("white metal of alpha 1 reflects {once:.3} of the light, compensated {whole:.3}");
    assert!(once < 0.6 && (whole - 1.0).abs() < 0.01);
    Ok(())
}
