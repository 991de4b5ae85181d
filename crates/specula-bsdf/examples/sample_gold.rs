//! Samples a direction off rough gold.
#![allow(clippy::print_stdout, reason = "an example prints")]

use std::error::Error;

use specula_bsdf::bsdf::RoughConductor;
use specula_bsdf::fresnel::{Conductor, Reflectance};
use specula_bsdf::math::vec3;
use specula_bsdf::ndf::Ggx;
use specula_bsdf::{Alpha, Bsdf, Rgb, Transport, metals};

fn main() -> Result<(), Box<dyn Error>> {
    let gold = metals::by_symbol("Au").ok_or("not measured")?;
    let fresnel = Reflectance::Conductor(Conductor {
        eta: Rgb::from(gold.eta),
        k: Rgb::from(gold.k),
    });
    let lobe = RoughConductor::new(Ggx::new(Alpha::new(0.1, 0.4)?), fresnel);

    let wo = vec3(0.6, 0.0, 0.8);
    match lobe.sample(wo, [0.3, 0.5, 0.7], Transport::Radiance) {
        Some(s) => println!(
            "wi {:?}, weight {:?}, pdf {} per steradian",
            s.wi, s.weight, s.pdf
        ),
        None => println!("no direction: the path ends"),
    }
    Ok(())
}
