//! Passes over the film: all cores, the same picture for any number of them.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use macro_rules_attribute::apply;
use rayon::prelude::*;

use crate::film::{
    Aim, FilmBuffer, PixelSums, ROWS, SampleRows, ScatterCounts, Tile, VertexCounts,
};
use crate::integrator::{PathTracer, Tally, Wavefront};
use crate::options::RenderOptions;
use crate::prepared::PreparedScene;
use crate::sampler::Sampler;
use crate::simd::simd_levels;

/// A render in progress.
///
/// A sample is determined by its pixel, its index in the pixel and the seed, and a pixel adds its
/// samples in the order of their indices: the picture does not depend, by a single bit, on the
/// number of threads or on how the samples are split into passes. Adaptive sampling allots work when
/// all tiles have what was allotted before, so that this holds there too.
pub struct Renderer<'a> {
    pub(crate) scene: &'a PreparedScene,
    pub(crate) options: RenderOptions,
    pub(crate) film: FilmBuffer,
    /// Those that no thread uses.
    workers: Mutex<Vec<Worker>>,
}

/// What a thread renders a tile with.
struct Worker {
    wavefront: Wavefront,
    /// The tile's pixels as they were before, in case that it is stopped.
    before: Vec<PixelSums>,
}

/// What a pass did.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PassReport {
    /// Samples that every pixel has by now, over all passes.
    pub samples_done_total: u32,
    /// Rays of this pass: camera, bounces and shadows.
    pub rays: u64,
    /// Directions that lobes sampled in this pass; `None` where a device sampled them.
    pub scattered: Option<ScatterCounts>,
    /// Vertices that were shaded in this pass; `None` where a device shaded them.
    pub vertices: Option<VertexCounts>,
    /// Whether the pass was finished, not stopped.
    pub complete: bool,
    /// Samples of the film so far that were not finite: 0 in a correct render.
    pub invalid_samples: u64,
    /// One of those of this pass.
    pub invalid: Option<InvalidSample>,
}

/// A sample that was not finite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InvalidSample {
    /// Column and row.
    pub pixel: [u32; 2],
    /// Its index in the pixel.
    pub sample: u32,
    /// Index of the material in the scene at whose surface it went wrong; `None` beyond all surfaces.
    pub material: Option<usize>,
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
    #[error("its samples begin with index {0}")]
    FirstSample(u32),
    /// Its samples are spread by their error and those of the render evenly, or the other way round.
    #[error("one was made for a noise, the other for a number of samples")]
    Adaptive,
}

impl<'a> Renderer<'a> {
    /// A render that has not begun.
    pub fn new(scene: &'a PreparedScene, options: RenderOptions) -> Self {
        let mut renderer = Self {
            scene,
            film: FilmBuffer::new(scene.resolution, scene.crop, options.first_sample),
            options,
            workers: Mutex::default(),
        };
        renderer.begin();
        renderer
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
        let has_samples = film.most_and_mean_samples().0 > 0;
        if has_samples && options.noise.is_some() != film.is_adaptive() {
            return Err(ResumeError::Adaptive);
        }
        let mut renderer = Self {
            scene,
            options,
            film,
            workers: Mutex::default(),
        };
        renderer.begin();
        Ok(renderer)
    }

    /// Allots what adaptive sampling does first.
    fn begin(&mut self) {
        if let Some(aim) = self.aim() {
            self.film.plan(aim);
        }
    }

    /// Allots what adaptive sampling does next, once what was allotted is done. A share of a round ends with it.
    pub(crate) fn plan(&mut self) {
        if self.options.round_share.is_none() {
            self.begin();
        }
    }

    /// Whether this render takes the samples of a tile, by its place.
    fn takes(&self, place: usize) -> bool {
        self.options.round_share.is_none_or(|[from, to, of]| {
            let class = place % (of as usize).max(1);
            (from as usize..to as usize).contains(&class)
        })
    }

    fn aim(&self) -> Option<Aim> {
        let samples = self.options.samples_per_pixel;
        (self.options.noise).map(|noise| Aim { noise, samples })
    }

    /// Samples that each tile is to have after a pass of so many.
    pub(crate) fn goals(&self, samples: u32) -> Vec<u32> {
        let even = self.film.complete_samples().saturating_add(samples);
        let adaptive = self.options.noise.is_some();
        let goal = |(place, tile): (usize, &Tile)| match adaptive {
            true if self.takes(place) => tile.target.min(tile.count().saturating_add(samples)),
            true => tile.count(),
            false => even,
        };
        self.film.tiles.iter().enumerate().map(goal).collect()
    }

    /// Adds `samples` samples to every pixel, in rayon's current pool. In adaptive sampling: at most as
    /// many, to those that have not got yet what was allotted to them.
    ///
    /// A pass that is stopped leaves whole tiles unrendered; the next pass begins with what they
    /// lack, and takes every pixel to the same count.
    ///
    /// * `stop`: read before every vertex, so that a pass ends within milliseconds; the tiles that
    ///   were being rendered stay as they were.
    pub fn render_pass(&mut self, samples: u32, stop: &AtomicBool) -> PassReport {
        let goals = self.goals(samples);
        let options = &self.options;
        let tracer = PathTracer::new(self.scene, options);
        let workers = &self.workers;
        let (done, complete) = self
            .film
            .tiles
            .par_iter_mut()
            .zip(goals)
            .with_max_len(1)
            .map(|(tile, goal)| {
                if tile.count() >= goal {
                    return (Done::default(), true);
                }
                if stop.load(Ordering::Relaxed) {
                    return (Done::default(), false);
                }
                let mut worker = free(workers).pop().unwrap_or_else(|| Worker {
                    wavefront: Wavefront::new(),
                    before: Vec::new(),
                });
                let (invalid, rays) = (tile.invalid, tile.rays);
                worker.before.clear();
                worker.before.extend_from_slice(&tile.pixels);
                let done = render_tile(&tracer, &mut worker.wavefront, (options, stop), tile, goal);
                let Some(done) = done else {
                    (tile.invalid, tile.rays) = (invalid, rays);
                    tile.pixels.copy_from_slice(&worker.before);
                    return (Done::default(), false);
                };
                free(workers).push(worker);
                (done, true)
            })
            .reduce(
                || (Done::default(), true),
                |a, b| (a.0.and(b.0), a.1 && b.1),
            );
        self.plan();
        self.report(done, Some(done.tally), complete)
    }

    /// What a pass did.
    ///
    /// * `counts`: `None` where a device did it, which counts rays alone.
    pub(crate) fn report(&self, done: Done, counts: Option<Tally>, complete: bool) -> PassReport {
        PassReport {
            samples_done_total: self.film.complete_samples(),
            rays: done.tally.rays,
            scattered: counts.map(|counts| counts.scattered),
            vertices: counts.map(|counts| counts.vertices),
            complete,
            invalid_samples: self.film.invalid_samples(),
            invalid: done.invalid,
        }
    }

    /// Samples of the pixels that have the fewest; in adaptive sampling, of those that need more.
    /// `None`: none does.
    pub fn samples_done(&self) -> Option<u32> {
        match self.options.noise {
            Some(_) => self.film.fewest_of_open(|place| self.takes(place)),
            None => Some(self.film.complete_samples()),
        }
    }

    /// Share of the samples that have been taken, in `[0, 1]`: of `most` per pixel, or of what adaptive
    /// sampling is likely to need; 0 where that is not known yet.
    pub fn share_done(&self, most: u32) -> f64 {
        match self.aim() {
            Some(aim) => self.film.share_of_work(aim),
            None => f64::from(self.film.complete_samples()) / f64::from(most.max(1)),
        }
    }

    /// The scene that is rendered.
    pub fn scene(&self) -> &PreparedScene {
        self.scene
    }

    /// What has been gathered so far.
    pub fn film(&self) -> &FilmBuffer {
        &self.film
    }

    /// What has been gathered, without a copy: a later render goes on with it ([`Renderer::resume`]).
    #[must_use]
    pub fn into_film(self) -> FilmBuffer {
        self.film
    }

    /// The options of the render.
    pub fn options(&self) -> &RenderOptions {
        &self.options
    }
}

/// The workers that no thread uses.
fn free(workers: &Mutex<Vec<Worker>>) -> MutexGuard<'_, Vec<Worker>> {
    workers.lock().unwrap_or_else(PoisonError::into_inner)
}

/// What was done for a tile, or for several.
#[derive(Clone, Copy, Default)]
pub(crate) struct Done {
    pub(crate) tally: Tally,
    pub(crate) invalid: Option<InvalidSample>,
}

impl Done {
    /// Of two sets of tiles in order.
    pub(crate) fn and(self, later: Self) -> Self {
        Self {
            tally: self.tally.and(later.tally),
            invalid: self.invalid.or(later.invalid),
        }
    }
}

/// Takes every pixel of a tile to `target` samples. `None`: stopped, with the tile and the wavefront in a state
/// that is of no use.
fn render_tile(
    tracer: &PathTracer<'_>,
    wavefront: &mut Wavefront,
    (options, stop): (&RenderOptions, &AtomicBool),
    tile: &mut Tile,
    target: u32,
) -> Option<Done> {
    let [x0, x1, y0, _] = tile.bounds;
    let width = x1 - x0;
    let (seed, first) = (options.seed, options.first_sample);
    let count = tile.count();
    let sample = |(i, nth): (u32, u32)| {
        let pixel = [x0 + i % width, y0 + i / width];
        (pixel, Sampler::new(pixel, first.wrapping_add(nth), seed))
    };
    let pixels = crate::convert::id(tile.pixels.len());
    let bounds = tile.bounds;
    let mut done = Done::default();
    let mut add = |places: &[(u32, u32)], sizes: &[usize]| {
        tracer.begin(wavefront, samplers(places, first, sample));
        if !tracer.follow_until(wavefront, stop) {
            return false;
        }
        tracer.share(wavefront, sizes);
        let tally = wavefront.take_tally();
        tile.rays += tally.rays;
        done.tally = done.tally.and(tally);
        for place in add_samples(tracer, wavefront, places, &mut tile.pixels) {
            tile.invalid += 1;
            let (pixel, sampler) = sample(place);
            done.invalid = Some(InvalidSample {
                pixel,
                sample: first.wrapping_add(place.1),
                material: tracer
                    .material_of_invalid_sample(wavefront, pixel, sampler)
                    .map(|m| m as usize),
            });
        }
        true
    };
    let mut places = Vec::with_capacity(Wavefront::SIZE);
    if options.share_paths > 1 {
        let mut sizes = Vec::new();
        for nth in count..target {
            for group in groups(bounds, options.share_paths, |i| sample((i, nth)).1) {
                if places.len() + group.len() > Wavefront::SIZE {
                    if !add(&places, &sizes) {
                        return None;
                    }
                    places.clear();
                    sizes.clear();
                }
                places.extend(group.iter().map(|&i| (i, nth)));
                sizes.push(group.len());
            }
        }
        return add(&places, &sizes).then_some(done);
    }
    let mut all = (0..pixels).flat_map(|i| (count..target).map(move |nth| (i, nth)));
    loop {
        places.clear();
        places.extend(all.by_ref().take(Wavefront::SIZE));
        if places.is_empty() {
            return Some(done);
        }
        if !add(&places, &[]) {
            return None;
        }
    }
}

/// Pixels and samplers of samples, of which most are of the same pixel as the one before.
///
/// * `places`: of each sample the pixel, by its place in the tile, and the index of the sample there.
/// * `first`: the index of each pixel's first sample in its sequence.
/// * `of`: the pixel and sampler of one sample.
fn samplers(
    places: &[(u32, u32)],
    first: u32,
    of: impl Fn((u32, u32)) -> ([u32; 2], Sampler),
) -> impl Iterator<Item = ([u32; 2], Sampler)> {
    let mut last = None;
    places.iter().map(move |&(i, nth)| {
        let number = first.wrapping_add(nth);
        let key = (i, number >> 16);
        let (pixel, sampler) = match last {
            Some((same, known)) if same == key => known,
            _ => of((i, nth)),
        };
        last = Some((key, (pixel, sampler)));
        (pixel, sampler.at(number))
    })
}

/// Groups of at most `size` pixels of a tile whose paths share: squares of 4 x 4 pixels are dealt out by
/// chance, anew for every sample, so that pixels change partners.
///
/// * `bounds`: of the tile.
/// * `sampler`: of the sample of a pixel, by its place in the tile.
fn groups(
    [x0, x1, y0, y1]: [u32; 4],
    size: u32,
    sampler: impl Fn(u32) -> Sampler,
) -> Vec<Vec<u32>> {
    const SIDE: u32 = 4;
    let [width, height] = [x1 - x0, y1 - y0];
    let mut groups = Vec::new();
    for top in (0..height).step_by(SIDE as usize) {
        for left in (0..width).step_by(SIDE as usize) {
            let [right, bottom] = [(left + SIDE).min(width), (top + SIDE).min(height)];
            let mut square: Vec<(f32, u32)> = (top..bottom)
                .flat_map(|y| (left..right).map(move |x| y * width + x))
                .map(|i| (sampler(i).hashed([u32::MAX, 0, 0]), i))
                .collect();
            square.sort_by(|a, b| a.0.total_cmp(&b.0));
            let dealt = square.chunks(size.max(1) as usize);
            groups.extend(dealt.map(|group| group.iter().map(|&(_, i)| i).collect()));
        }
    }
    groups
}

/// Adds the samples of a wavefront to their pixels; returns those that are not finite.
///
/// * `places`: of each path the pixel, and the index of the sample there.
#[apply(simd_levels)]
fn add_samples(
    tracer: &PathTracer<'_>,
    wavefront: &Wavefront,
    places: &[(u32, u32)],
    pixels: &mut [PixelSums],
) -> Vec<(u32, u32)> {
    let mut invalid = Vec::new();
    let mut rows = SampleRows::new();
    for (chunk, places) in places.chunks(ROWS).enumerate() {
        for (row, &place) in places.iter().enumerate() {
            let (sample, weight) = tracer.contribution(wavefront, chunk * ROWS + row);
            if !rows.set(row, &sample, weight) {
                invalid.push(place);
            }
        }
        let mut first = 0;
        for run in places.chunk_by(|a, b| a.0 == b.0) {
            pixels[run[0].0 as usize].add_rows(&rows, first..first + run.len());
            first += run.len();
        }
    }
    invalid
}
