//! Renders of an experiment, and their errors.

use std::sync::atomic::AtomicBool;
use std::time::Instant;

use serde::{Deserialize, Serialize};
use specula_render::picture::{Picture, compare};
use specula_render::{PreparedScene, RenderOptions, Renderer, ScatterCounts};
use specula_scene::Scene;

use crate::{LabError, Result};

/// A pixel is a firefly where it is brighter than the reference by so many times the reference's own
/// brightness about it.
const FIREFLY: f32 = 4.0;

/// The result of a render.
pub struct Rendered {
    /// The picture.
    pub picture: Picture,
    /// Time from the first sample to the last, in seconds, without preparation.
    pub seconds: f64,
    /// Rays that were traced.
    pub rays: u64,
    /// Directions sampled from lobes, and those of them that were rejected.
    pub scattered: ScatterCounts,
}

/// Renders a scene with all threads.
///
/// # Errors
///
/// Where the scene cannot be prepared, or the caller asks to stop.
pub fn render(scene: &Scene, options: &RenderOptions, stop: &AtomicBool) -> Result<Rendered> {
    let prepared = PreparedScene::new(scene, options)?;
    render_prepared(&prepared, options, stop)
}

/// [`render()`] of a scene that was prepared with the same options.
///
/// # Errors
///
/// Where the caller asks to stop.
pub(crate) fn render_prepared(
    prepared: &PreparedScene,
    options: &RenderOptions,
    stop: &AtomicBool,
) -> Result<Rendered> {
    let mut renderer = Renderer::new(prepared, options.clone());
    let begin = Instant::now();
    let report = renderer.render_pass(options.samples_per_pixel, stop);
    let seconds = begin.elapsed().as_secs_f64();
    if !report.complete {
        return Err(LabError::Stopped);
    }
    Ok(Rendered {
        picture: renderer.film().picture(),
        seconds,
        rays: report.rays,
        scattered: report.scattered.unwrap_or_default(),
    })
}

/// Errors of a picture against its reference.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Errors {
    /// Root of the mean squared difference over pixels and channels.
    pub rmse: f64,
    /// Mean of the squared difference over the squared reference plus 0.01.
    pub rel_mse: f64,
    /// Mean difference over the mean of the reference.
    pub rel_bias: f64,
    /// Mean HDR-FLIP.
    pub hdr_flip: f64,
    /// Pixels brighter than the reference by four times its mean brightness within two pixels, per
    /// million.
    pub fireflies_ppm: f64,
    /// HDR-FLIP of each pixel, for maps.
    #[serde(skip)]
    pub map: Vec<f32>,
}

/// Compares a picture with its reference.
///
/// # Errors
///
/// Where they differ in size.
pub fn errors(reference: &Picture, picture: &Picture) -> Result<Errors> {
    let comparison = compare(reference, picture)?;
    Ok(Errors {
        rmse: comparison.rmse,
        rel_mse: comparison.rel_mse,
        rel_bias: comparison.rel_bias,
        hdr_flip: comparison.hdr_flip,
        fireflies_ppm: fireflies_ppm(reference, picture),
        map: comparison.flip_map,
    })
}

/// Pixels far brighter than the reference about them, per million.
fn fireflies_ppm(reference: &Picture, picture: &Picture) -> f64 {
    let (width, height) = (reference.width as usize, reference.height as usize);
    let bright = |p: &Picture, i: usize| p.colour[i].luminance();
    let mut count = 0_u32;
    for y in 0..height {
        for x in 0..width {
            let (mut sum, mut pixels) = (0.0, 0.0);
            for row in y.saturating_sub(2)..(y + 3).min(height) {
                for column in x.saturating_sub(2)..(x + 3).min(width) {
                    sum += bright(reference, row * width + column);
                    pixels += 1.0;
                }
            }
            let about = sum / pixels;
            let i = y * width + x;
            if bright(picture, i) > bright(reference, i) + FIREFLY * about {
                count += 1;
            }
        }
    }
    f64::from(count) * 1e6 / (width * height).max(1) as f64
}
