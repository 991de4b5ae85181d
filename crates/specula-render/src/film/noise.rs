//! The estimate of a picture's error, and the pixels that it leaves out.
//!
//! The error of a picture is the root of the mean over its pixels of
//!
//! ```text
//! e = v / (B (Y + B / 100))
//! ```
//!
//! * `Y`: the pixel's luminance, `v` the variance of its mean; `B`: luminance of the picture, the mean
//!   over its pixels.
//!
//! `v` is itself estimated from the pixel's samples. Where a rare path contributes a thousand times what others
//! do (a firefly), one sample makes all of it: the estimate says nothing about the pixel's error, its
//! own error is as large as itself, and one such pixel can outweigh all others. So pixels whose variance
//! is not known are left out. A pixel's mean is carried by about
//!
//! ```text
//! Y^2 / v
//! ```
//!
//! samples: one firefly makes it 1, `k` equal ones make it `k`, and it is the harmonic part of Kish's
//! effective number of samples that the spread of values leaves, `1 / n_eff = 1 / n + v / Y^2`
//! (Kish 1965, "Survey sampling", 11.7). Where it is below [`CARRIERS`], which is where the standard error
//! exceeds half of the mean, the variance counts as not known. (Zirr et al. 2018, "Re-weighting firefly
//! samples for improved finite-sample Monte Carlo estimates", trust a sample likewise by how many of its kind
//! there are. Departures: within the pixel alone, and nothing is re-weighted: fireflies stay in the picture.)
//!
//! At most one pixel in [`ONE_IN`] is left out, those with the largest `e`: what is noisy all over is said to
//! be noisy. The estimate is that of all other pixels, a trimmed mean (Huber and Ronchetti 2009, "Robust
//! statistics", 3.3); [`NoiseEstimate`] says how many were left out and what share of the squared error they
//! have. It is no bound on the error of the whole: none can be had of finitely many samples of a tail that may
//! be arbitrarily heavy.

use rayon::prelude::*;

use super::buffer::{FilmBuffer, PixelSums};
use super::tile::Tile;
use crate::convert::narrow;

/// Samples that carry a pixel whose variance counts as known, at least. With 2 to 16, the estimate for the BMW
/// of `docs/noise.md` differs by a tenth; with fewer than 2 a second firefly in a pixel counts as knowledge.
const CARRIERS: f64 = 4.0;
/// At most one pixel in so many is left out. One in 1000 was too few: fireflies outnumbered them.
const ONE_IN: usize = 200;
/// Below this share of the picture's brightness errors count as if it were reached.
const DARKEST: f64 = 0.01;

/// An estimate of a picture's relative error, as of [`FilmBuffer::noise`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoiseEstimate {
    /// Of the pixels that are not left out; infinite below two samples per pixel.
    pub relative: f32,
    /// Of all pixels. It jumps with every firefly.
    pub of_all: f32,
    /// Pixels that are left out as their variance is not known, at most one in 200.
    pub left_out: usize,
    /// All pixels.
    pub pixels: usize,
    /// Share of all pixels' squared error that those left out have, in `[0, 1]`.
    pub share_left_out: f32,
}

/// A set of pixels of a tile, as bits by their index in it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Places([u64; 4]);

impl Places {
    fn add(&mut self, place: usize) {
        self.0[place / 64 % 4] |= 1 << (place % 64);
    }

    fn has(&self, place: usize) -> bool {
        self.0[place / 64 % 4] >> (place % 64) & 1 != 0
    }

    fn count(&self) -> usize {
        self.0.iter().map(|w| w.count_ones() as usize).sum()
    }
}

/// What the error of pixels is measured by.
pub(super) struct Survey {
    /// Luminance of the picture, the mean over the pixels that are not left out.
    pub(super) brightness: f64,
    /// Of each tile its pixels.
    pub(super) tiles: Vec<Vec<PixelNoise>>,
    /// Of each tile the pixels that are left out.
    left_out: Vec<Places>,
}

/// Luminance of a pixel, and its standard deviation.
#[derive(Clone, Copy, Debug)]
pub(super) struct PixelNoise {
    luminance: f64,
    deviation: f64,
}

impl PixelNoise {
    #[inline(always)]
    pub(super) fn new(pixel: &PixelSums) -> Self {
        let [luminance, deviation] = pixel.luminance_and_deviation();
        Self {
            luminance,
            deviation,
        }
    }

    /// The squared error.
    #[inline(always)]
    pub(super) fn squared_error(self, brightness: f64) -> f64 {
        let shown = brightness * (self.luminance.max(0.0) + DARKEST * brightness);
        self.deviation * self.deviation / shown.max(f64::MIN_POSITIVE)
    }

    /// Whether too few samples carry the pixel for its variance to be known.
    #[inline(always)]
    pub(super) fn is_unknown(self) -> bool {
        let Self {
            luminance: mean,
            deviation,
        } = self;
        deviation.is_finite() && CARRIERS * deviation * deviation > mean * mean
    }
}

impl FilmBuffer {
    /// Estimate of the picture's relative error: the square root of the mean over pixels of
    ///
    /// ```text
    /// var(mean luminance) / (B (mean luminance + B / 100)),   B the picture's mean luminance
    /// ```
    ///
    /// the relative error at the picture's brightness, weighed with the root of the luminance
    /// elsewhere. Pixels whose variance is not known, as fewer than four samples carry it, are left out, at most one in
    /// 200 ([`noise_estimate`](Self::noise_estimate) says how many, and what they are about). The channels are taken for
    /// fully correlated, which overestimates the error of luminance where they are not, and samples for
    /// independent, though their sequences are better than that. Infinite below two samples per pixel.
    pub fn noise(&self) -> f32 {
        self.noise_estimate().relative
    }

    /// [`noise`](Self::noise), and what it leaves out.
    pub fn noise_estimate(&self) -> NoiseEstimate {
        let Survey {
            brightness,
            tiles,
            left_out,
        } = self.survey();
        // Of the pixels that count, and of those left out.
        let tile = |(tile, left_out): (&Vec<PixelNoise>, &Places)| {
            let mut sums = [0.0; 2];
            for (i, p) in tile.iter().enumerate() {
                sums[usize::from(left_out.has(i))] += p.squared_error(brightness);
            }
            sums
        };
        let sums: Vec<[f64; 2]> = (tiles.par_iter().zip(&left_out)).map(tile).collect();
        let [counted, apart] = [0, 1].map(|k| sums.iter().map(|s| s[k]).sum::<f64>());
        let pixels: usize = self.tiles.iter().map(|t| t.pixels.len()).sum();
        let left_out: usize = left_out.iter().map(Places::count).sum();
        let all = counted + apart;
        let root = |sum: f64, count: usize| narrow((sum / count.max(1) as f64).sqrt());
        NoiseEstimate {
            relative: root(counted, pixels - left_out),
            of_all: root(all, pixels),
            left_out,
            pixels,
            share_left_out: if apart > 0.0 && all.is_finite() {
                narrow(apart / all)
            } else {
                0.0
            },
        }
    }

    /// Which pixels are left out, and how bright the others are.
    pub(super) fn survey(&self) -> Survey {
        let look_at = |tile: &Tile| {
            let pixels: Vec<PixelNoise> = tile.pixels.iter().map(PixelNoise::new).collect();
            let mut unknown = Places::default();
            for (i, p) in pixels.iter().enumerate() {
                if p.is_unknown() {
                    unknown.add(i);
                }
            }
            (pixels, unknown)
        };
        let (tiles, mut left_out): (Vec<_>, Vec<_>) = self.tiles.par_iter().map(look_at).unzip();
        let pixels: usize = self.tiles.iter().map(|t| t.pixels.len()).sum();
        let most = pixels / ONE_IN;
        if left_out.iter().map(Places::count).sum::<usize>() > most {
            left_out = worst(&tiles, &left_out, most);
        }
        Survey {
            brightness: brightness(&tiles, &left_out),
            tiles,
            left_out,
        }
    }
}

/// So many of some pixels, those with the largest error; of equal ones the first.
fn worst(tiles: &[Vec<PixelNoise>], among: &[Places], most: usize) -> Vec<Places> {
    // One firefly must not change what the errors of others are measured by.
    let brightness = brightness(tiles, among);
    let tile = |(t, (tile, among)): (usize, (&Vec<PixelNoise>, &Places))| {
        let pixels = tile.iter().enumerate();
        let error = |(i, p): (usize, &PixelNoise)| (p.squared_error(brightness), t, i);
        let unknown = pixels.filter(|(i, _)| among.has(*i));
        unknown.map(error).collect::<Vec<(f64, usize, usize)>>()
    };
    let errors = tiles.par_iter().zip(among).enumerate();
    let mut errors: Vec<_> = errors.flat_map_iter(tile).collect();
    let larger = |a: &(f64, usize, usize), b: &(f64, usize, usize)| {
        b.0.total_cmp(&a.0).then((a.1, a.2).cmp(&(b.1, b.2)))
    };
    if most > 0 && most < errors.len() {
        errors.select_nth_unstable_by(most - 1, larger);
    }
    let mut worst = vec![Places::default(); among.len()];
    for (_, tile, place) in errors.into_iter().take(most) {
        worst[tile].add(place);
    }
    worst
}

/// Mean luminance of all pixels but some; of all, where there are no others or these are black.
fn brightness(tiles: &[Vec<PixelNoise>], but: &[Places]) -> f64 {
    let tile = |(tile, but): (&Vec<PixelNoise>, &Places)| {
        let (mut counted, mut all, mut count) = (0.0, 0.0, 0_usize);
        for (i, p) in tile.iter().enumerate() {
            all += p.luminance;
            if !but.has(i) {
                counted += p.luminance;
                count += 1;
            }
        }
        (counted, all, count)
    };
    // Tile by tile: the same for any number of threads.
    let sums: Vec<(f64, f64, usize)> = (tiles.par_iter().zip(but)).map(tile).collect();
    let (counted, all, count) = sums
        .iter()
        .fold((0.0, 0.0, 0), |a, s| (a.0 + s.0, a.1 + s.1, a.2 + s.2));
    if counted > 0.0 {
        return counted / count as f64;
    }
    let pixels: usize = tiles.iter().map(Vec::len).sum();
    (all / pixels.max(1) as f64).max(0.0)
}

#[cfg(test)]
mod tests;
