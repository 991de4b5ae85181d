//! Nanoseconds per element of sampling rough metal in batches, one line per sampler: `cap 2.1`.
//!
//! `crates/specula-py/benches/lobes.py` runs it beside the same from Python.
#![allow(clippy::print_stdout, reason = "it reports on stdout")]

use std::hint::black_box;
use std::time::Instant;

use specula_bsdf::batch::{Directions, LobeBatches, SampleOutcome, Samples};
use specula_bsdf::bsdf::{Lobe, RoughConductor};
use specula_bsdf::fresnel::{Reflectance, Schlick};
use specula_bsdf::math::{Stream, rgb};
use specula_bsdf::ndf::Ggx;
use specula_bsdf::vndf::Sampler;
use specula_bsdf::{Alpha, Transport};

/// Calls, of which the quickest counts.
const ROUNDS: usize = 3;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Cargo adds `--bench`.
    let count = match std::env::args().skip(1).find(|a| a != "--bench") {
        Some(text) => text.parse()?,
        None => 1 << 20,
    };
    let mut stream = Stream::new(1);
    let mut wo = Directions::<Vec<f32>>::zeroed(count);
    for i in 0..count {
        let z = 0.1 + 0.9 * stream.next::<f32>();
        let phi = core::f32::consts::TAU * stream.next::<f32>();
        let r = (1.0 - z * z).sqrt();
        (wo.x[i], wo.y[i], wo.z[i]) = (r * phi.cos(), r * phi.sin(), z);
    }
    let u: [Vec<f32>; 3] = [0; 3].map(|_| (0..count).map(|_| stream.next()).collect());
    let mut samples = Samples::<Vec<f32>, Vec<SampleOutcome>>::rejected(count);
    let ggx = Ggx::new(Alpha::isotropic(0.3));
    let f0 = Reflectance::Schlick(Schlick {
        f0: rgb(0.9, 0.6, 0.3),
    });
    for sampler in [Sampler::Cap, Sampler::Bounded, Sampler::Exact] {
        let lobe: Lobe<f32> = RoughConductor::new(ggx, f0).with_sampler(sampler).into();
        let batches = LobeBatches::new(&lobe, Transport::Radiance, 0);
        let mut least = f64::INFINITY;
        for _ in 0..ROUNDS {
            let start = Instant::now();
            let u = u.each_ref().map(Vec::as_slice);
            batches.sample(0, wo.as_slices(), u, samples.as_mut_slices())?;
            black_box(&mut samples);
            least = least.min(start.elapsed().as_secs_f64());
        }
        println!("{sampler} {:.3}", 1e9 * least / count as f64);
    }
    Ok(())
}
