//! Adaptive sampling: samples go where they lower the error of the whole picture most.
//!
//! The error of a tile is the root of the mean over its pixels of
//!
//! ```text
//! v / (B (Y + B / 100))
//! ```
//!
//! * `Y`: the pixel's luminance, `v` the variance of its mean; `B`: luminance of the picture, the mean
//!   over its pixels.
//!
//! Pixels whose variance is not known (`noise`) after many samples count as the worst of the others of their tile.
//!
//! At the picture's brightness this is the relative error. Elsewhere the root of `Y` takes the place
//! of `Y`, as in the eye and in a screen's encoding (Dammertz et al. 2010, "A hierarchical automatic
//! stopping condition for Monte Carlo global illumination", eq. 1; departures: the variance of all
//! samples instead of the difference of two halves, which is noisier, and quadrature).
//!
//! Let `x` be that error for one sample, so that it is `x / sqrt(n)` after `n`, and `c` what a sample
//! costs. Of all ways to spend an amount of work, `n` in proportion to `x / sqrt(c)` makes the picture's
//! error, the root mean square over its tiles, least (Neyman 1934; with costs Cochran 1977, 5.5). The same
//! error in every tile would take `n` in proportion to `x^2`: it gains nothing on the mean.
//!
//! Samples are taken in rounds. The first takes as many everywhere. At the end of each, when every tile
//! has what it was to have, work is allotted for the next, about half as much again in all, by what is
//! known by then of all tiles. So a picture depends neither on threads nor on passes nor on
//! interruptions, and a film that was made for one noise can be gone on with for a smaller one: it
//! ends as if that had been asked for at first.

use std::cmp::Ordering;

use rayon::prelude::*;

use super::buffer::{FilmBuffer, MergeError};
use super::noise::{PixelNoise, Survey};
use super::tile::{TILE, Tile};

/// Samples of every pixel in the first round, at most. With fewer, light that is rare has often not been
/// met, and a tile that is taken for quiet too early is too dark.
const FIRST_ROUND: u32 = 32;
/// All work after a round over that before it.
const GROWTH: f64 = core::f64::consts::SQRT_2;
/// Fewest samples of the first round: a variance of fewer says nothing.
const LEAST: u32 = 4;
/// A tile's samples after a round are at most so many times those before it, since its error is an
/// estimate.
const MOST_GROWTH: u32 = 4;
/// They are at least this share of what all would have if samples were spread evenly: what has met no
/// light yet may do so.
const LEAST_SHARE: f64 = 1.0 / 16.0;
/// Most samples of a pixel: the length of its sequence.
pub const MOST_SAMPLES: u32 = 1 << 16;
/// What a sample costs without its rays, in rays.
const COST_OF_SAMPLE: f64 = 0.5;
/// Samples after which a pixel's variance that is not known then will not be by more: four rare paths in as many.
/// With a small lamp, a pixel at its edge needs some hundred; a firefly would take any number.
pub(super) const PATIENCE: u32 = 512;
/// How much of a tile's squared error is the mean of those around it.
const SHARE_AROUND: f64 = 0.25;
/// Halvings by which the scale of all wishes is found.
const SCALE_STEPS: u32 = 120;

/// What ends an adaptive render: whatever comes first.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Aim {
    /// Of the picture ([`FilmBuffer::noise`]).
    pub(crate) noise: f32,
    /// As much work as so many samples of every pixel take.
    pub(crate) samples: u32,
}

impl Aim {
    /// Samples of every pixel in the first round.
    fn first_round(self) -> u32 {
        let quarter = rung(f64::from(self.samples / 4));
        quarter.clamp(LEAST, FIRST_ROUND).min(self.samples)
    }
}

impl Tile {
    /// Samples of each of the tile's pixels.
    pub(crate) fn count(&self) -> u32 {
        self.pixels.first().map_or(0, |p| p.count)
    }

    /// Whether all of its pixels have as many.
    pub(super) fn is_even(&self) -> bool {
        let count = self.count();
        self.pixels.iter().all(|p| p.count == count)
    }

    /// Whether it lacks samples that were allotted to it.
    fn is_open(&self) -> bool {
        self.count() < self.target
    }

    /// The squared error for one sample, `x^2`. A pixel whose variance [`PATIENCE`] samples have not made known
    /// counts as the worst of the others: it must not attract all work (Winsor's mean; Dixon 1960, "Simplified
    /// estimation from censored normal samples"). `None`: there are no others.
    ///
    /// * `pixels`: the tile's.
    fn squared_error(&self, pixels: &[PixelNoise], brightness: f64) -> Option<f64> {
        let count = self.count();
        let (mut sum, mut worst, mut counted) = (0.0, 0.0_f64, 0_usize);
        for p in pixels {
            if count < PATIENCE || !p.is_unknown() {
                let squared = p.squared_error(brightness) * f64::from(count);
                sum += squared;
                worst = worst.max(squared);
                counted += 1;
            }
        }
        let apart = (pixels.len() - counted) as f64;
        (counted > 0).then(|| (sum + apart * worst) / pixels.len() as f64)
    }

    /// What a sample of each of its pixels costs, in rays.
    fn cost(&self) -> f64 {
        let pixels = self.pixels.len() as f64;
        let rays = self.rays as f64 / f64::from(self.count().max(1));
        rays + COST_OF_SAMPLE * pixels
    }
}

impl FilmBuffer {
    /// Whether samples are spread by their error, not evenly.
    pub fn is_adaptive(&self) -> bool {
        self.work > 0.0
    }

    /// Begins a round where the last one is done and the aim not reached.
    pub(crate) fn plan(&mut self, aim: Aim) {
        let most = f64::from(aim.samples);
        if !self.is_adaptive() {
            let first = aim.first_round();
            self.work = f64::from(first);
            for tile in &mut self.tiles {
                tile.target = first;
            }
        }
        let is_reached = |film: &Self| aim.noise > 0.0 && film.noise() <= aim.noise;
        // A round may bring no tile to its next number of samples.
        while !self.tiles.iter().any(Tile::is_open) && self.work < most && !is_reached(self) {
            self.work = (self.work * GROWTH).min(most);
            self.allot();
        }
    }

    /// Takes over tiles of a round that another film has farther, as a tile's samples follow each other from the first
    /// on: the more it has, the more of the same picture it is.
    pub(super) fn merge_round(&mut self, other: &Self) -> Result<(), MergeError> {
        let is_later = other.work > self.work;
        let fits = |a: &Tile, b: &Tile| match self.work.total_cmp(&other.work) {
            Ordering::Less => a.count() <= b.count(),
            Ordering::Equal => a.target == b.target,
            Ordering::Greater => b.count() <= a.count(),
        };
        let mut pairs = self.tiles.iter().zip(&other.tiles);
        let same = self.first_sample() == other.first_sample() && self.work.min(other.work) > 0.0;
        if !same || !pairs.all(|(a, b)| fits(a, b)) {
            return Err(MergeError::Adaptive);
        }
        let pairs = self.tiles.par_iter_mut().zip(&other.tiles);
        pairs.for_each(|(a, b)| {
            if b.count() > a.count() {
                a.clone_from(b);
            }
            a.target = if is_later { b.target } else { a.target };
        });
        self.work = self.work.max(other.work);
        Ok(())
    }

    /// Allots the work of a round.
    fn allot(&mut self) {
        let wishes = self.wishes();
        let costs: Vec<f64> = self.tiles.iter().map(Tile::cost).collect();
        let all = self.work * costs.iter().sum::<f64>();
        let least = LEAST_SHARE * self.work;
        let wanted = |tile: &Tile, wish: f64, scale: f64| {
            let count = tile.count();
            let most = count.saturating_mul(MOST_GROWTH).clamp(LEAST, MOST_SAMPLES);
            let exact = (scale * wish).max(least).min(f64::from(most));
            rung(exact).max(count)
        };
        let work = |scale: f64| -> f64 {
            let tiles = self.tiles.iter().zip(&wishes).zip(&costs);
            tiles
                .map(|((t, w), c)| f64::from(wanted(t, *w, scale)) * c)
                .sum()
        };
        // The largest scale that takes no more than all of the work, by bisection.
        let (mut low, mut high) = (0.0, f64::MAX.sqrt());
        for _ in 0..SCALE_STEPS {
            let middle = halfway(low, high);
            if work(middle) <= all {
                low = middle;
            } else {
                high = middle;
            }
        }
        // Where that leaves work, tiles alike share it as they come.
        let mut left = all - work(low);
        let targets: Vec<u32> = (self.tiles.iter().zip(&wishes).zip(&costs))
            .map(|((tile, wish), cost)| {
                let [less, more] = [low, high].map(|scale| wanted(tile, *wish, scale));
                let extra = f64::from(more - less) * cost;
                if extra > left {
                    return less;
                }
                left -= extra;
                more
            })
            .collect();
        for (tile, target) in self.tiles.iter_mut().zip(targets) {
            tile.target = target;
        }
    }

    /// What the samples of each tile should be in proportion to, `x / sqrt(c)`; `x` of the tiles around is
    /// in it, as one that has not hit what they have may do so.
    pub(super) fn wishes(&self) -> Vec<f64> {
        let Survey {
            brightness, tiles, ..
        } = self.survey();
        let known: Vec<Option<f64>> = (self.tiles.par_iter().zip(&tiles))
            .map(|(tile, pixels)| tile.squared_error(pixels, brightness))
            .collect();
        let (sum, count) = (known.iter().flatten()).fold((0.0, 0.0), |(s, n), x| (s + x, n + 1.0));
        let mean = sum / f64::max(count, 1.0);
        let squares: Vec<f64> = known.into_iter().map(|x| x.unwrap_or(mean)).collect();
        let [x0, x1, _, _] = self.crop();
        let columns = (x1 - x0).div_ceil(TILE) as usize;
        let rows = self.tiles.len() / columns.max(1);
        let around = |i: usize, end: usize| i.saturating_sub(1)..(i + 2).min(end);
        (self.tiles.iter().enumerate())
            .map(|(i, tile)| {
                let (column, row) = (i % columns, i / columns);
                let (mut sum, mut count) = (0.0, 0.0);
                for r in around(row, rows) {
                    for c in around(column, columns) {
                        sum += squares[r * columns + c];
                        count += 1.0;
                    }
                }
                let square = (1.0 - SHARE_AROUND) * squares[i] + SHARE_AROUND * sum / count;
                let pixels = tile.pixels.len().max(1) as f64;
                (square * pixels / tile.cost()).sqrt()
            })
            .collect()
    }

    /// Samples of the tiles that have the fewest of those that need more; `None`: none does.
    ///
    /// * `counts`: whether a tile counts, by its place.
    pub(crate) fn fewest_of_open(&self, counts: impl Fn(usize) -> bool) -> Option<u32> {
        let tiles = self.tiles.iter().enumerate();
        let open = tiles.filter(|(place, tile)| tile.is_open() && counts(*place));
        open.map(|(_, tile)| tile.count()).min()
    }

    /// Share of the work that the aim is likely to need that has been done; 0 before the first round's end.
    pub(crate) fn share_of_work(&self, aim: Aim) -> f64 {
        let work = |count: &dyn Fn(&Tile) -> u32| -> f64 {
            let of = |t: &Tile| f64::from(count(t)) * t.cost();
            self.tiles.iter().map(of).sum()
        };
        let all: f64 = self.tiles.iter().map(Tile::cost).sum();
        let most = f64::from(aim.samples) * all;
        let done = work(&Tile::count);
        let needed = if aim.noise > 0.0 {
            let noise = f64::from(self.noise());
            if !noise.is_finite() {
                return 0.0;
            }
            let ratio = noise / f64::from(aim.noise);
            (done * ratio * ratio).min(most)
        } else {
            most
        };
        let planned = work(&|t| t.target);
        done / needed.max(planned).max(f64::MIN_POSITIVE)
    }
}

/// Between two scales: by their logarithms where they are far apart.
fn halfway(low: f64, high: f64) -> f64 {
    if high > 4.0 * low.max(1e-150) {
        (low.max(1e-150) * high).sqrt()
    } else {
        0.5 * (low + high)
    }
}

/// The nearest of 4, 6, 8, 12, 16, 24, ... to a number of samples: a tile has as many, since sequences are
/// evenest after powers of two.
fn rung(samples: f64) -> u32 {
    // The largest power of two that is not above, of a positive normal number: without its digits.
    const DIGITS: u64 = (1 << 52) - 1;
    let power = f64::from_bits(samples.max(f64::from(LEAST)).to_bits() & !DIGITS);
    let power = power.min(f64::from(1 << 30));
    let rung = match samples / power {
        ratio if ratio < 1.25 => power,
        ratio if ratio < 1.75 => 1.5 * power,
        _ => 2.0 * power,
    };
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "whole, and at most 2^31"
    )]
    let rung = rung as u32;
    rung
}

#[cfg(test)]
mod tests {
    use specula_bsdf::{Rgb, Vec3};

    use super::super::PixelSample;
    use super::*;

    /// Adds samples to a tile until it has what it is to have: `mean` with a deviation of `deviation`.
    fn fill(tile: &mut Tile, mean: f32, deviation: f32, rays: u64) {
        for p in tile.pixels.iter_mut() {
            while p.count < tile.target {
                let sign = if p.count % 2 == 0 { 1.0 } else { -1.0 };
                let sample = PixelSample {
                    colour: Rgb::splat(mean + sign * deviation),
                    albedo: Rgb::WHITE,
                    normal: Vec3::Z,
                    depth: None,
                };
                p.add(&sample, 1.0);
                tile.rays += rays;
            }
        }
    }

    /// Goes on with tiles of mean 1, of these deviations and rays for a sample, until the aim is reached;
    /// their counts.
    fn go_on<const N: usize>(
        film: &mut FilmBuffer,
        tiles: [(f32, u64); N],
        noise: f32,
        samples: u32,
    ) -> [u32; N] {
        let aim = Aim { noise, samples };
        film.plan(aim);
        while film.fewest_of_open(|_| true).is_some() {
            for (tile, (deviation, rays)) in film.tiles.iter_mut().zip(tiles) {
                fill(tile, 1.0, deviation, rays);
            }
            film.plan(aim);
        }
        core::array::from_fn(|i| film.tiles[i].count())
    }

    /// An empty film of `n` tiles, one column.
    fn film(n: u32) -> FilmBuffer {
        FilmBuffer::new([16, 16 * n], [0, 16, 0, 16 * n], 0)
    }

    /// Whether a ratio is what it should be but for the steps between rungs.
    fn is_near(found: f64, expected: f64) -> bool {
        (0.7..1.43).contains(&(found / expected))
    }

    #[test]
    fn samples_are_in_proportion_to_the_deviation() {
        // Each between others like itself, so that what is around makes no difference.
        let deviations = [0.2, 0.2, 0.2, 0.5, 0.5, 0.5, 2.0, 2.0, 2.0];
        let mut film = film(9);
        let counts = go_on(&mut film, deviations.map(|d| (d, 3)), 0.05, MOST_SAMPLES);
        let noise = film.noise();
        assert!((0.04..=0.05).contains(&noise), "{noise}");
        for (i, ratio) in [(1, 0.4), (7, 4.0)] {
            let found = f64::from(counts[i]) / f64::from(counts[4]);
            assert!(is_near(found, ratio), "{counts:?}");
        }
        assert!(
            counts.iter().all(|n| rung(f64::from(*n)) == *n),
            "{counts:?}"
        );
        // As the noise was reached, not earlier.
        let mean = f64::from(counts.iter().sum::<u32>()) / 9.0;
        let used = mean / film.work;
        assert!((0.8..=1.0).contains(&used), "{used}");
        // For half the noise, four times as many.
        let aim = |noise| Aim {
            noise,
            samples: MOST_SAMPLES,
        };
        let share = film.share_of_work(aim(0.5 * noise));
        assert!((share - 0.25).abs() < 0.01, "{share}");
        assert_eq!(film.share_of_work(aim(0.05)), 1.0);
        film.plan(aim(0.5 * noise));
        assert_eq!(film.fewest_of_open(|_| true), counts.iter().min().copied());
    }

    #[test]
    fn what_costs_more_gets_less_and_the_work_is_what_was_asked_for() {
        let mut film = film(6);
        let rays = [2, 2, 2, 32, 32, 32];
        let counts = go_on(&mut film, rays.map(|r| (1.0, r)), 0.0, 200);
        // By the root of what a sample costs.
        let expected = (32.5_f64 / 2.5).sqrt();
        let found = f64::from(counts[1]) / f64::from(counts[4]);
        assert!(is_near(found, expected), "{counts:?}");
        let work =
            |n: [f64; 6]| -> f64 { n.iter().zip(rays).map(|(n, r)| n * (r as f64 + 0.5)).sum() };
        let ratio = work(counts.map(f64::from)) / work([200.0; 6]);
        assert!((0.8..=1.0).contains(&ratio), "{counts:?}: {ratio}");
    }

    /// A round of a few samples tells little: neighbours are taken into account, no tile grows by too much, and
    /// none is given up.
    #[test]
    fn estimates_are_not_trusted_too_far() {
        let tiles = [0.0, 0.0, 0.0, 0.0, 1.0, 0.0].map(|d| (d, 3));
        let mut one = film(6);
        one.plan(Aim {
            noise: 0.0,
            samples: 400,
        });
        for (tile, (deviation, rays)) in one.tiles.iter_mut().zip(tiles) {
            fill(tile, 1.0, deviation, rays);
        }
        one.plan(Aim {
            noise: 0.0,
            samples: 400,
        });
        let targets: Vec<u32> = one.tiles.iter().map(|t| t.target).collect();
        let of_work = targets.iter().sum::<u32>();
        assert!(
            targets[4] <= FIRST_ROUND * MOST_GROWTH && targets[4] > targets[3],
            "{targets:?}"
        );
        assert_eq!(targets[..3], [FIRST_ROUND; 3]);
        assert!(f64::from(of_work) <= 6.0 * one.work, "{targets:?}");
        let counts = go_on(&mut film(6), tiles, 0.0, 1600);
        assert!(counts[0] >= 96 && counts[4] > 3000, "{counts:?}");
        assert!(counts[3] > counts[0] && counts[5] > counts[0], "{counts:?}");
    }

    #[test]
    fn dark_and_even_pictures_end_after_the_first_round() {
        let counts = go_on(&mut film(3), [(0.0, 1); 3], 0.01, MOST_SAMPLES);
        assert_eq!(counts, [FIRST_ROUND; 3]);
        let mut dark = film(1);
        let aim = Aim {
            noise: 0.01,
            samples: 9,
        };
        dark.plan(aim);
        fill(&mut dark.tiles[0], 0.0, 0.0, 1);
        dark.plan(aim);
        assert_eq!(
            (dark.fewest_of_open(|_| true), dark.tiles[0].count()),
            (None, 4)
        );
    }

    #[test]
    fn few_samples_are_taken_evenly() {
        for samples in 1..=4 {
            let counts = go_on(&mut film(2), [(0.1, 1), (2.0, 9)], 0.0, samples);
            assert_eq!(counts, [samples; 2]);
        }
        let first = |samples| {
            let aim = Aim {
                noise: 0.0,
                samples,
            };
            aim.first_round()
        };
        assert_eq!([7, 16, 64, 1000].map(first), [4, 4, 16, 32]);
        let rungs = [1.0, 4.9, 5.0, 6.9, 7.0, 13.9, 14.0, 20.0, 1e4].map(rung);
        assert_eq!(rungs, [4, 4, 6, 6, 8, 12, 16, 24, 8192]);
    }
}
