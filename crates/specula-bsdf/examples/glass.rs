//! Follows light through rough glass: reflection or refraction.
#![allow(clippy::print_stdout, reason = "an example prints")]

use std::error::Error;

use specula_bsdf::bsdf::RoughDielectric;
use specula_bsdf::math::vec3;
use specula_bsdf::ndf::Ggx;
use specula_bsdf::{Alpha, Bsdf, Event, Transport};

fn main() -> Result<(), Box<dyn Error>> {
    let lobe = RoughDielectric::new(Ggx::new(Alpha::new(0.1, 0.1)?), 1.5);

    // From outside, `wo.z > 0`. From inside it is below the surface.
    for wo in [vec3(0.6, 0.0, 0.8), vec3(0.6, 0.0, -0.8)] {
        for choice in [0.01, 0.99] {
            let Some(s) = lobe.sample(wo, [choice, 0.5, 0.5], Transport::Radiance) else {
                continue;
            };
            // `eta` is what the path's index of refraction is multiplied by, as Russian roulette needs.
            let way = match s.event {
                Event::Reflection => "reflected",
                Event::Transmission => "refracted",
            };
            println!(
                "{way} towards {:?}, weight {:.3}, eta {:.2}",
                s.wi, s.weight.g, s.eta
            );
        }
    }
    Ok(())
}
