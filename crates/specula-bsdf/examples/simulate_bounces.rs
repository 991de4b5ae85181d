//! Simulates the bounces between the facets of rough gold: the value is an estimate from a random walk.
#![allow(clippy::print_stdout, reason = "an example prints")]

use std::error::Error;

use specula_bsdf::bsdf::MultibounceConductor;
use specula_bsdf::fresnel::{Conductor, Reflectance};
use specula_bsdf::math::{Stream, vec3};
use specula_bsdf::multibounce::MultibounceModel;
use specula_bsdf::ndf::Ggx;
use specula_bsdf::{Alpha, Bsdf, Rgb, Transport, metals};

fn main() -> Result<(), Box<dyn Error>> {
    let gold = metals::by_symbol("Au").ok_or("not measured")?;
    let fresnel = Reflectance::Conductor(Conductor {
        eta: Rgb::from(gold.eta),
        k: Rgb::from(gold.k),
    });
    let ggx = Ggx::new(Alpha::new(0.8_f64, 0.8)?);
    let lobe = MultibounceConductor::new(ggx, fresnel, MultibounceModel::StratifiedBidirectional);

    // The density is deterministic and serves multiple importance sampling; the value is not.
    let (wo, wi) = (vec3(0.6, 0.0, 0.8), vec3(-0.6, 0.0, 0.8));
    let mut stream = Stream::new(7);
    let mut sum = Rgb::BLACK;
    for _ in 0..1000 {
        let (f_cos, pdf) = lobe.eval_pdf_random(wo, wi, Transport::Radiance, &mut stream);
        assert!(pdf > 0.0);
        sum += f_cos;
    }
    println!("f cos, mean of 1000 walks: {:?}", sum * 1e-3);
    Ok(())
}
