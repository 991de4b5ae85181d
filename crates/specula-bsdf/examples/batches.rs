//! Samples a thousand directions at once, with the widest vectors of this machine.
#![allow(clippy::print_stdout, reason = "an example prints")]

use std::error::Error;

use specula_bsdf::batch::{Directions, Level, Samples};
use specula_bsdf::bsdf::RoughConductor;
use specula_bsdf::fresnel::{Reflectance, Schlick};
use specula_bsdf::math::{Stream, rgb, vec3};
use specula_bsdf::ndf::Ggx;
use specula_bsdf::{Alpha, Transport};

const N: usize = 1000;

fn main() -> Result<(), Box<dyn Error>> {
    let f0 = rgb(0.95_f32, 0.64, 0.54);
    let ggx = Ggx::new(Alpha::new(0.3, 0.3)?);
    let lobe = RoughConductor::new(ggx, Reflectance::Schlick(Schlick { f0 }));

    // Structures of arrays: every component of all elements side by side.
    let wo: Directions<Vec<f32>> = (0..N).map(|_| vec3(0.6, 0.0, 0.8)).collect();
    let mut stream = Stream::new(1);
    let u: [Vec<f32>; 3] = [0; 3].map(|_| (0..N).map(|_| stream.next()).collect());
    let mut samples = Samples::rejected(N);
    Level::best().sample(
        &lobe,
        wo.as_slices(),
        [&u[0], &u[1], &u[2]],
        Transport::Radiance,
        samples.as_mut_slices(),
    )?;
    let accepted = samples.pdf.iter().filter(|pdf| **pdf > 0.0).count();
    println!("{:?}: {accepted} of {N} accepted", Level::best());
    assert_eq!(accepted, N, "the exact sampler rejects none");
    Ok(())
}
