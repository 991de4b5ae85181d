//! Passes over the film: all cores, the same picture for any number of them.

use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;

use crate::film::{FilmBuffer, Tile};
use crate::integrator::PathTracer;
use crate::options::RenderOptions;
use crate::prepared::PreparedScene;
use crate::sampler::Sampler;

/// A render in progress.
///
/// A sample is determined by its pixel, its number in the pixel and the seed, and a pixel adds its
/// samples in the order of their numbers: the picture does not depend, by a single bit, on the
/// number of threads or on how the samples are split into passes.
pub struct Renderer<'a> {
    scene: &'a PreparedScene,
    options: RenderOptions,
    film: FilmBuffer,
}

/// What a pass did.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PassReport {
    /// Samples that every pixel has by now, over all passes.
    pub samples_done_total: u32,
    /// Rays of this pass: camera, bounces and shadows.
    pub rays: u64,
    /// Whether the pass was finished, not stopped.
    pub complete: bool,
    /// Samples of the film so far that were not finite: 0 in a correct render.
    pub invalid_samples: u64,
}

/// Why a render cannot go on with a film.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ResumeError {
    /// It is of another size.
    #[error("it is of {width} x {height} pixels with the crop {crop:?} (x0, x1, y0, y1)")]
    Size {
        /// Columns of the whole picture.
        width: u32,
        /// Rows of the whole picture.
        height: u32,
        /// Pixels that it covers.
        crop: [u32; 4],
    },
    /// It was merged from parts between which samples are missing.
    #[error(
        "it was merged from parts between which samples are missing, or which were not finished"
    )]
    Gaps,
    /// Its samples begin elsewhere.
    #[error("its samples begin with number {0}")]
    FirstSample(u32),
}

impl<'a> Renderer<'a> {
    /// A render that has not begun.
    pub fn new(scene: &'a PreparedScene, options: RenderOptions) -> Self {
        Self {
            scene,
            film: FilmBuffer::new(scene.resolution, scene.crop, options.first_sample),
            options,
        }
    }

    /// A render that goes on with a film. It ends, bit for bit, as it would have without the break.
    ///
    /// # Errors
    /// Where the film is of another size, or has gaps.
    pub fn resume(
        scene: &'a PreparedScene,
        options: RenderOptions,
        film: FilmBuffer,
    ) -> Result<Self, ResumeError> {
        if film.full_resolution() != scene.resolution || film.crop() != scene.crop {
            let [width, height] = film.full_resolution();
            let crop = film.crop();
            return Err(ResumeError::Size {
                width,
                height,
                crop,
            });
        }
        if !film.is_open() {
            return Err(ResumeError::Gaps);
        }
        if film.first_sample() != options.first_sample {
            return Err(ResumeError::FirstSample(film.first_sample()));
        }
        Ok(Self {
            scene,
            options,
            film,
        })
    }

    /// Adds `samples` samples to every pixel, in rayon's current pool.
    ///
    /// A pass that is stopped leaves whole tiles unrendered; the next pass begins with what they
    /// lack, and takes every pixel to the same count.
    ///
    /// * `stop`: looked at before every tile.
    pub fn render_pass(&mut self, samples: u32, stop: &AtomicBool) -> PassReport {
        let target = self.film.complete_samples().saturating_add(samples);
        let scene = self.scene;
        let options = &self.options;
        let tracer = PathTracer::new(scene, options);
        let (rays, complete) = self
            .film
            .tiles
            .par_iter_mut()
            .with_max_len(1)
            .map(|tile| {
                if stop.load(Ordering::Relaxed) {
                    return (0, false);
                }
                (render_tile(scene, &tracer, options, tile, target), true)
            })
            .reduce(|| (0, true), |a, b| (a.0 + b.0, a.1 && b.1));
        PassReport {
            samples_done_total: self.film.complete_samples(),
            rays,
            complete,
            invalid_samples: self.film.invalid_samples(),
        }
    }

    /// What has been gathered so far.
    pub fn film(&self) -> &FilmBuffer {
        &self.film
    }

    /// The options of the render.
    pub fn options(&self) -> &RenderOptions {
        &self.options
    }
}

/// Brings every pixel of a tile to `target` samples; returns the rays traced.
fn render_tile(
    scene: &PreparedScene,
    tracer: &PathTracer<'_>,
    options: &RenderOptions,
    tile: &mut Tile,
    target: u32,
) -> u64 {
    let [x0, x1, y0, _] = tile.bounds;
    let width = x1 - x0;
    let (seed, first) = (options.seed, options.first_sample);
    let mut rays = 0;
    for (i, pixel) in (0_u32..).zip(&mut tile.pixels) {
        let (x, y) = (x0 + i % width, y0 + i / width);
        for nth in pixel.count..target {
            let number = first.wrapping_add(nth);
            let sampler = Sampler::new([x, y], number, seed);
            let [u0, u1, u2, u3] = sampler.camera();
            let ([dx, dy], weight) = scene.filter.sample([u0, u1]);
            let raster = [x as f32 + 0.5 + dx, y as f32 + 0.5 + dy];
            let (origin, direction) = scene.camera.ray(raster, [u2, u3]);
            let (sample, traced) = tracer.trace(&sampler, origin, direction);
            rays += traced;
            if !pixel.add(&sample, weight) {
                tile.invalid += 1;
            }
        }
    }
    rays
}
