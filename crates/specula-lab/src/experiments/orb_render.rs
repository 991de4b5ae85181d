//! Renders of orbs, and how far each orb is from its reference.

use specula_bsdf::Rgb;
use specula_bsdf::vndf::Sampler;
use specula_render::picture::Picture;
use specula_render::{RenderOptions, Strategy};
use specula_scene::{Energy, Scene};

use crate::{Errors, Lab, Rendered, Result, errors};

/// The samplers that are compared: sampler, name, number of its line style.
pub(super) const SAMPLERS: [(Sampler, &str, usize); 3] = [
    (Sampler::Cap, "cap", 3),
    (Sampler::Bounded, "bounded", 2),
    (Sampler::Exact, "exact", 1),
];

/// Longest paths: practically unlimited within an orb.
const DEPTH: u32 = 32;
/// Side of a square within an orb's outline, in sides of the orb's own square.
const WITHIN: f64 = 0.6;
/// Exposure of pictures in stops: silver in bright light.
pub(super) const EXPOSURE_STOPS: f32 = -0.7;

/// A render that samples lobes only, not lights, so that the weights of the sampler show.
pub(super) fn by_sampler(
    lab: &Lab<'_>,
    scene: &Scene,
    sampler: Sampler,
    energy: Energy,
    spp: u32,
    number: u32,
) -> Result<Rendered> {
    let options = RenderOptions {
        samples_per_pixel: spp,
        max_depth: DEPTH,
        seed: lab.render_seed().wrapping_add(number),
        vndf_sampler: sampler,
        energy,
        strategy: Strategy::BsdfOnly,
        ..RenderOptions::default()
    };
    lab.render(scene, &options)
}

/// The reference: the exact sampler and light sampling, with another seed.
pub(super) fn reference(lab: &Lab<'_>, scene: &Scene, energy: Energy, spp: u32) -> Result<Picture> {
    let options = RenderOptions {
        samples_per_pixel: spp,
        max_depth: DEPTH,
        seed: lab.render_seed().wrapping_add(1_000_003),
        energy,
        ..RenderOptions::default()
    };
    Ok(lab.render(scene, &options)?.picture)
}

/// Estimated root mean squared error of a picture, from the spread of its samples.
pub(super) fn own_error(picture: &Picture) -> f64 {
    let mean = |c: &Rgb<f32>| (f64::from(c.r) + f64::from(c.g) + f64::from(c.b)) / 3.0;
    let sum: f64 = picture.variance.iter().map(mean).sum();
    (sum / picture.variance.len().max(1) as f64).sqrt()
}

/// Errors of each orb of a row, over a square within its outline.
pub(super) fn errors_by_orb(reference: &Picture, picture: &Picture) -> Result<Vec<Errors>> {
    let count = reference.width / reference.height.max(1);
    (0..count)
        .map(|orb| errors(&square(reference, orb), &square(picture, orb)))
        .collect()
}

/// A square within the outline of the orb at a place of the row.
pub(super) fn square(picture: &Picture, orb: u32) -> Picture {
    let side = picture.height;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a part of the side"
    )]
    let within = (f64::from(side) * WITHIN) as u32;
    let margin = (side - within) / 2;
    let left = orb * side + margin;
    let mut colour = Vec::new();
    for row in margin..margin + within {
        let begin = (row * picture.width + left) as usize;
        colour.extend_from_slice(&picture.colour[begin..begin + within as usize]);
    }
    Picture::from_colour(within, within, colour)
}

/// Mean and standard error of a few values.
pub(super) fn mean_and_error(values: &[f64]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let square = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>();
    (mean, (square / (n - 1.0).max(1.0) / n).sqrt())
}
