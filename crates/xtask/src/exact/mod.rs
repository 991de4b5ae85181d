//! `cargo xtask exact`: what the sampler of exact reflections rejects, saves and looks like.

mod figure;
mod fuzz;
mod mirror;
mod variance;

use std::path::Path;

use specula_bsdf::math::{Vec3, vec3};

use crate::Result;
use crate::generated::Generated;

/// Prints the tables of `docs/exact-reflection-sampling.md`, or with `fuzz` samples that many
/// reflections in f32 and counts those below the surface.
pub(crate) fn run(fuzz: Option<u64>) -> Result<()> {
    if let Some(count) = fuzz {
        return fuzz::run(count);
    }
    variance::rejected();
    variance::independent();
    variance::stratified();
    Ok(())
}

/// The document's figure.
pub(crate) fn generate(_root: &Path) -> Result<Vec<Generated>> {
    Ok(vec![Generated {
        path: "docs/exact-reflection-sampling.svg",
        text: figure::draw(),
    }])
}

/// A view by its polar angle and azimuth in degrees.
fn view(theta_deg: f64, phi_deg: f64) -> Vec3<f64> {
    let (sine, cosine) = theta_deg.to_radians().sin_cos();
    let (y, x) = phi_deg.to_radians().sin_cos();
    vec3(sine * x, sine * y, cosine)
}

/// Point `i` of the two-dimensional R2 sequence.
fn r2(i: u32) -> [f64; 2] {
    let at = |step: f64| (0.5 + f64::from(i) * step).fract();
    [at(0.754_877_666_246_693), at(0.569_840_290_998_053)]
}
