//! Passes whose samples a device takes: what is requested of it, and how its sums are added.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::film::{LONGEST_RUN, RunSums};
use crate::integrator::{PathTracer, Wavefront};
use crate::renderer::{Done, InvalidSample, PassReport, Renderer};
use crate::sampler::Sampler;

/// Samples that are wanted of every pixel of a tile.
#[derive(Clone, Copy, Debug)]
pub struct Wanted {
    place: usize,
    bounds: [u32; 4],
    first: u32,
    counts: [u32; 2],
}

/// Consecutive samples of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Run {
    /// Column and row.
    pub pixel: [u32; 2],
    /// Index of the first.
    pub first: u32,
    /// How many, at most 64.
    pub count: u32,
    /// Index of the pixel in the tile.
    place: usize,
}

impl Wanted {
    /// How many samples.
    pub fn len(&self) -> usize {
        let [x0, x1, y0, y1] = self.bounds;
        let pixels = (x1 - x0) as usize * (y1 - y0) as usize;
        pixels * (self.counts[1] - self.counts[0]) as usize
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Samples of the longest run.
    pub fn longest_run(&self) -> u32 {
        let count = self.counts[1] - self.counts[0];
        // Runs of a pixel are nearly as long as each other.
        count.div_ceil(count.div_ceil(LONGEST_RUN).max(1))
    }

    /// Every run, pixel by pixel.
    pub fn runs(&self) -> impl Iterator<Item = Run> + use<> {
        let Self {
            bounds: [x0, x1, y0, y1],
            first,
            counts: [from, to],
            ..
        } = *self;
        let longest = self.longest_run();
        let pixels = (y0..y1).flat_map(move |y| (x0..x1).map(move |x| [x, y]));
        pixels.enumerate().flat_map(move |(place, pixel)| {
            let begins = (from..to).step_by(longest.max(1) as usize);
            begins.map(move |begin| Run {
                pixel,
                first: first.wrapping_add(begin),
                count: longest.min(to - begin),
                place,
            })
        })
    }
}

impl Renderer<'_> {
    /// [`Renderer::render_pass`] with samples that a device takes and adds run by run.
    ///
    /// * `most`: samples that the device is asked for at once, a tile at least.
    /// * `device`: the sums of tiles, in the order of [`Wanted::runs`].
    ///
    /// # Errors
    /// Those of the device. The film has what came before, and can be resumed.
    pub fn render_pass_with<E>(
        &mut self,
        samples: u32,
        stop: &AtomicBool,
        mut most: impl FnMut() -> usize,
        mut device: impl FnMut(&[Wanted]) -> Result<Vec<RunSums>, E>,
    ) -> Result<PassReport, E> {
        let goals = self.goals(samples);
        let (mut done, mut complete) = (Done::default(), true);
        while complete {
            let wanted = self.wanted(&goals, most());
            if wanted.is_empty() {
                break;
            }
            let sums = device(&wanted)?;
            done = done.and(self.add(&wanted, &sums));
            complete = !stop.load(Ordering::Relaxed);
        }
        self.plan();
        Ok(self.report(done, None, complete))
    }

    /// The samples that tiles need next: so many together, one tile at least.
    ///
    /// * `goals`: samples that they are to have.
    fn wanted(&self, goals: &[u32], most: usize) -> Vec<Wanted> {
        let mut wanted: Vec<Wanted> = Vec::new();
        let mut samples = 0;
        let first = self.options.first_sample;
        for ((tile, goal), place) in self.film.tiles.iter().zip(goals).zip(0..) {
            if tile.count() >= *goal {
                continue;
            }
            let one = Wanted {
                place,
                bounds: tile.bounds,
                first,
                counts: [tile.count(), *goal],
            };
            samples += one.len();
            if samples > most && !wanted.is_empty() {
                break;
            }
            wanted.push(one);
        }
        wanted
    }

    /// Adds the sums of a device.
    fn add(&mut self, wanted: &[Wanted], sums: &[RunSums]) -> Done {
        let (mut done, mut invalid) = (Done::default(), None);
        let mut sums = sums.iter();
        for one in wanted {
            let tile = &mut self.film.tiles[one.place];
            for (run, sums) in one.runs().zip(sums.by_ref()) {
                done.tally.rays += u64::from(sums.rays);
                tile.rays += u64::from(sums.rays);
                tile.pixels[run.place].add_run(sums, run.count);
                tile.invalid += u64::from(sums.invalid.count_ones());
                if sums.invalid != 0 {
                    let sample = run.first.wrapping_add(sums.invalid.trailing_zeros());
                    invalid = Some((run.pixel, sample));
                }
            }
        }
        done.invalid = invalid.map(|(pixel, sample)| self.invalid(pixel, sample));
        done
    }

    /// A sample that was not finite, with the material at which it went wrong.
    fn invalid(&self, pixel: [u32; 2], sample: u32) -> InvalidSample {
        let tracer = PathTracer::new(self.scene, &self.options);
        let sampler = Sampler::new(pixel, sample, self.options.seed);
        let material = tracer.material_of_invalid_sample(&mut Wavefront::new(), pixel, sampler);
        InvalidSample {
            pixel,
            sample,
            material: material.map(|m| m as usize),
        }
    }
}
