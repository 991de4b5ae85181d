//! Passes whose samples a device takes: what is requested of it, and how its sums are added.

use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;

use crate::film::{LONGEST_RUN, RunSums};
use crate::integrator::{PathTracer, Wavefront};
use crate::renderer::{Done, InvalidSample, PassReport, Renderer};
use crate::sampler::Sampler;

/// How much a device is asked for before its first sums are added: it works while these are.
const AT_ONCE: usize = 2;

/// A device that takes samples and adds them run by run.
pub trait SampleDevice {
    /// How it fails.
    type Error;

    /// What it is asked for at once, a tile at least.
    fn most(&self) -> Most;

    /// Begins to take samples; need not wait for them.
    ///
    /// # Errors
    /// Those of the device.
    fn begin(&mut self, wanted: &[Wanted]) -> Result<(), Self::Error>;

    /// The sums of what was begun first and is not finished yet, in the order of [`Wanted::runs`].
    ///
    /// # Errors
    /// Those of the device.
    fn finish(&mut self) -> Result<&[RunSums], Self::Error>;
}

/// Bounds of what a device is asked for at once.
#[derive(Clone, Copy, Debug)]
pub struct Most {
    /// Samples.
    pub samples: usize,
    /// Runs, each of which has sums.
    pub runs: usize,
}

/// Samples that are wanted of every pixel of a tile.
#[derive(Clone, Copy, Debug)]
pub struct Wanted {
    place: usize,
    bounds: [u32; 4],
    first: u32,
    counts: [u32; 2],
}

/// A pixel, and the index of one of its samples.
type PixelIndex = ([u32; 2], u32);

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

    /// How many runs.
    fn run_count(&self) -> usize {
        let [x0, x1, y0, y1] = self.bounds;
        let of_pixel = (self.counts[1] - self.counts[0]).div_ceil(self.longest_run().max(1));
        (x1 - x0) as usize * (y1 - y0) as usize * of_pixel as usize
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
    /// # Errors
    /// Those of the device. The film has what came before, and can be resumed.
    pub fn render_pass_with<D: SampleDevice>(
        &mut self,
        samples: u32,
        stop: &AtomicBool,
        device: &mut D,
    ) -> Result<PassReport, D::Error> {
        let goals = self.goals(samples);
        let (mut done, mut begun, mut next) = (Done::default(), VecDeque::new(), 0);
        loop {
            while begun.len() < AT_ONCE && !stop.load(Ordering::Relaxed) {
                let wanted = self.wanted(&goals, device.most(), next);
                let Some(last) = wanted.last() else { break };
                next = last.place + 1;
                device.begin(&wanted)?;
                begun.push_back(wanted);
            }
            let Some(wanted) = begun.pop_front() else {
                break;
            };
            done = done.and(self.add(&wanted, device.finish()?));
        }
        let one = Most {
            samples: 1,
            runs: 1,
        };
        let complete = self.wanted(&goals, one, next).is_empty();
        self.plan();
        Ok(self.report(done, None, complete))
    }

    /// The samples that tiles need next: so many together, one tile at least.
    ///
    /// * `goals`: samples that they are to have.
    /// * `begin`: tiles before this one have been asked for.
    fn wanted(&self, goals: &[u32], most: Most, begin: usize) -> Vec<Wanted> {
        let mut wanted: Vec<Wanted> = Vec::new();
        let (mut samples, mut runs) = (0, 0);
        let first = self.options.first_sample;
        let tiles = self.film.tiles.iter().zip(goals).enumerate().skip(begin);
        for (place, (tile, goal)) in tiles {
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
            runs += one.run_count();
            if (samples > most.samples || runs > most.runs) && !wanted.is_empty() {
                break;
            }
            wanted.push(one);
        }
        wanted
    }

    /// Adds the sums of a device.
    fn add(&mut self, wanted: &[Wanted], sums: &[RunSums]) -> Done {
        let mut rest = sums;
        let mut tiles = self.film.tiles.iter_mut().enumerate();
        let mut parts = Vec::with_capacity(wanted.len());
        for one in wanted {
            let (these, later) = rest.split_at(one.run_count().min(rest.len()));
            rest = later;
            let tile = tiles.find(|(place, _)| *place == one.place);
            parts.extend(tile.map(|(_, tile)| (one, tile, these)));
        }
        let added = parts.into_par_iter().map(|(one, tile, sums)| {
            let (mut rays, mut invalid) = (0, None);
            for (run, sums) in one.runs().zip(sums) {
                rays += u64::from(sums.rays);
                tile.pixels[run.place].add_run(sums, run.count);
                tile.invalid += u64::from(sums.invalid.count_ones());
                if sums.invalid != 0 {
                    let sample = run.first.wrapping_add(sums.invalid.trailing_zeros());
                    invalid = Some((run.pixel, sample));
                }
            }
            tile.rays += rays;
            (rays, invalid)
        });
        let added: Vec<(u64, Option<PixelIndex>)> = added.collect();
        let mut done = Done::default();
        done.tally.rays = added.iter().map(|(rays, _)| rays).sum();
        let invalid = added.into_iter().rev().find_map(|(_, invalid)| invalid);
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
