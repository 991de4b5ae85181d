//! Adaptive sampling: samples go where they lower the error of the whole picture most.
//!
//! The error of a tile is the root of the mean over its pixels of
//!
//! ```text
//! v / (B (Y + B / 100))
//! ```
//!
//! * `Y`: the pixel's luminance, `v` the variance of its mean; `B`: luminance of the picture, the mean
//!   over its pixels at 32 samples.
//!
//! At the picture's brightness this is the relative error. Elsewhere the root of `Y` takes the place
//! of `Y`, as in the eye and in a screen's encoding (Dammertz et al. 2010, "A hierarchical automatic
//! stopping condition for Monte Carlo global illumination", eq. 1; departures: the variance of all
//! samples instead of the difference of two halves, which is noisier, and quadrature).
//!
//! Let `x` be that error for one sample, so that it is `x / sqrt(n)` after `n`. Of all ways to spend
//! a number of samples, `n` in proportion to `x` makes the picture's error, the root mean square over
//! its tiles, least (Neyman 1934). It is the noise `E` that was asked for where
//!
//! ```text
//! n = x X / E^2,   X the mean of x over the picture, at 32 samples.
//! ```
//!
//! The same error in every tile would take `n` in proportion to `x^2`, and that many samples in all
//! as even sampling for the same picture's error: it gains nothing on the mean.
//!
//! A tile is judged at 32, 64, 128, ... samples, where its sequences are evenest, by its own sums and
//! the two numbers of the picture. So a picture depends neither on threads nor on passes nor on
//! interruptions, and a film that was made for one noise can be gone on with for a smaller one: it
//! ends as if that had been asked for at first.

use super::buffer::{FilmBuffer, PixelSums, Tile};
use crate::convert::narrow;

/// Samples at which a tile is judged first. With fewer, light that is rare has often not been met, and
/// a tile that is taken for quiet too early is too dark.
pub(crate) const FIRST_JUDGED: u32 = 32;
/// Most samples of a pixel where nothing else is said: the length of its sequence.
pub const MOST_SAMPLES: u32 = 1 << 16;
/// Below this share of the picture's brightness errors count as if it were reached.
const DARKEST: f64 = 0.01;

/// The picture at the first count of judgement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Reference {
    /// Mean luminance.
    pub(crate) brightness: f64,
    /// Mean over the pixels of their tile's error for one sample.
    pub(crate) deviation: f64,
}

/// What a film is rendered for: some noise, by some reference.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Criterion {
    noise: f64,
    /// `None`: not known yet.
    reference: Option<Reference>,
}

impl Criterion {
    /// Samples that a tile is taken to before it is judged the next time; `None`: it is done, or waits
    /// for others to have the first count of judgement.
    pub(crate) fn target(&self, tile: &Tile) -> Option<u32> {
        let count = tile.count();
        let is_judged = count >= FIRST_JUDGED && count.is_power_of_two();
        let is_enough = |needed: f64| needed <= f64::from(count);
        if is_judged && self.needed(tile).is_none_or(is_enough) {
            return None;
        }
        Some(next_judged(count))
    }

    /// Samples of each pixel that a tile needs, `x X / E^2`; `None` where it is not known.
    fn needed(&self, tile: &Tile) -> Option<f64> {
        let reference = self.reference?;
        let deviation = tile.deviation(reference.brightness);
        Some(deviation * reference.deviation / (self.noise * self.noise))
    }
}

/// The next count after `count` at which a tile is judged.
fn next_judged(count: u32) -> u32 {
    let power = count.saturating_add(1).checked_next_power_of_two();
    power.unwrap_or(u32::MAX).max(FIRST_JUDGED)
}

/// A pixel's squared error.
fn squared_error(pixel: &PixelSums, brightness: f64) -> f64 {
    let shown = brightness * (pixel.luminance().max(0.0) + DARKEST * brightness);
    let deviation = pixel.luminance_deviation();
    deviation * deviation / shown.max(f64::MIN_POSITIVE)
}

impl Tile {
    /// Samples of the tile's pixels.
    pub(crate) fn count(&self) -> u32 {
        self.pixels.first().map_or(0, |p| p.count)
    }

    /// The error for one sample, `x`.
    fn deviation(&self, brightness: f64) -> f64 {
        let squared = |p: &PixelSums| squared_error(p, brightness) * f64::from(p.count);
        let sum: f64 = self.pixels.iter().map(squared).sum();
        (sum / self.pixels.len().max(1) as f64).sqrt()
    }
}

impl FilmBuffer {
    /// Whether samples are spread by their error, not evenly.
    pub fn is_adaptive(&self) -> bool {
        self.reference.is_some()
    }

    /// Estimate of the picture's relative error: the square root of the mean over pixels of
    ///
    /// ```text
    /// var(mean luminance) / (B (mean luminance + B / 100)),   B the picture's mean luminance
    /// ```
    ///
    /// the relative error at the picture's brightness, weighed with the root of the luminance
    /// elsewhere. The channels are taken for fully correlated, which overestimates the error of
    /// luminance where they are not, and samples for independent, though their sequences are
    /// better than that. Infinite below two samples per pixel.
    pub fn noise(&self) -> f32 {
        let pixels = self.sums().count().max(1) as f64;
        let brightness = self.brightness();
        let sum: f64 = self.sums().map(|p| squared_error(p, brightness)).sum();
        narrow((sum / pixels).sqrt())
    }

    fn brightness(&self) -> f64 {
        let sum: f64 = self.sums().map(PixelSums::luminance).sum();
        (sum / self.sums().count().max(1) as f64).max(0.0)
    }

    pub(crate) fn criterion(&self, noise: f32) -> Criterion {
        Criterion {
            noise: f64::from(noise),
            reference: self.reference,
        }
    }

    /// Keeps what tiles are judged by, once all pixels have the first count of judgement.
    ///
    /// * Returns: whether it was new.
    pub(crate) fn take_reference(&mut self) -> bool {
        if self.reference.is_some() || self.complete_samples() < FIRST_JUDGED {
            return false;
        }
        let brightness = self.brightness();
        let weighed = |t: &Tile| t.deviation(brightness) * t.pixels.len() as f64;
        let sum: f64 = self.tiles.iter().map(weighed).sum();
        self.reference = Some(Reference {
            brightness,
            deviation: sum / self.sums().count().max(1) as f64,
        });
        true
    }

    /// Samples of the tiles that have the fewest of those that need more; `None`: none does.
    pub(crate) fn fewest_of_open(&self, noise: f32) -> Option<u32> {
        let criterion = self.criterion(noise);
        let open = self.tiles.iter().filter(|t| criterion.target(t).is_some());
        open.map(Tile::count).min()
    }

    /// Share of the samples that the noise is likely to need, at most `most` per pixel, that have been
    /// taken; 0 before the first judgement.
    pub(crate) fn share_of_samples(&self, noise: f32, most: u32) -> f64 {
        let criterion = self.criterion(noise);
        let (mut taken, mut needed) = (0.0, 0.0);
        for tile in &self.tiles {
            let Some(likely) = criterion.needed(tile) else {
                return 0.0;
            };
            let count = f64::from(tile.count());
            let all = match criterion.target(tile) {
                Some(next) => likely.max(f64::from(next)).min(f64::from(most)),
                None => count,
            };
            let pixels = tile.pixels.len() as f64;
            taken += count * pixels;
            needed += all.max(count) * pixels;
        }
        taken / needed.max(1.0)
    }
}

#[cfg(test)]
mod tests {
    use specula_bsdf::{Rgb, Vec3};

    use super::super::PixelSample;
    use super::*;

    /// Adds samples to a tile until it has `count`: `mean` with a deviation of `deviation`.
    fn fill(tile: &mut Tile, count: u32, mean: f32, deviation: f32) {
        for p in &mut tile.pixels {
            while p.count < count {
                let sign = if p.count % 2 == 0 { 1.0 } else { -1.0 };
                let sample = PixelSample {
                    colour: Rgb::splat(mean + sign * deviation),
                    albedo: Rgb::WHITE,
                    normal: Vec3::Z,
                    depth: None,
                };
                p.add(&sample, 1.0);
            }
        }
    }

    /// Four tiles of mean 1 with these deviations, brought to the noise; their counts.
    fn counts(deviations: [f32; 4], noise: f32) -> ([u32; 4], FilmBuffer) {
        let mut film = FilmBuffer::new([64, 16], [0, 64, 0, 16], 0);
        loop {
            let criterion = film.criterion(noise);
            let mut rendered = false;
            for (tile, deviation) in film.tiles.iter_mut().zip(deviations) {
                if let Some(next) = criterion.target(tile) {
                    fill(tile, next, 1.0, deviation);
                    rendered = true;
                }
            }
            film.take_reference();
            if !rendered {
                let counts = [0, 1, 2, 3].map(|i: usize| film.tiles[i].count());
                return (counts, film);
            }
        }
    }

    #[test]
    fn samples_are_in_proportion_to_the_deviation() {
        // x is nearly the deviation and X nearly 1: 100 x samples for a noise of 0.1.
        let (counts, film) = counts([0.2, 0.5, 1.1, 2.2], 0.1);
        assert_eq!(counts, [32, 64, 128, 256]);
        assert!(
            film.noise() < 0.1 && film.noise() > 0.07,
            "{}",
            film.noise()
        );
        assert_eq!(film.fewest_of_open(0.1), None);
        assert_eq!(film.share_of_samples(0.1, MOST_SAMPLES), 1.0);
        // For half the noise, four times as many.
        assert_eq!(film.fewest_of_open(0.05), Some(32));
        let share = film.share_of_samples(0.05, MOST_SAMPLES);
        assert!((0.2..0.4).contains(&share), "{share}");
        // At most as many as a pixel may have.
        assert_eq!(film.share_of_samples(0.001, 256), 480.0 / 1024.0);
    }

    #[test]
    fn dark_and_even_pictures_end_after_the_first_judgement() {
        assert_eq!(counts([0.0; 4], 0.01).0, [32; 4]);
        let mut film = FilmBuffer::new([16, 16], [0, 16, 0, 16], 0);
        fill(&mut film.tiles[0], 32, 0.0, 0.0);
        assert!(film.take_reference() && !film.take_reference());
        assert_eq!(film.fewest_of_open(0.01), None);
    }

    #[test]
    fn tiles_are_judged_at_powers_of_two_only() {
        let mut film = FilmBuffer::new([16, 16], [0, 16, 0, 16], 0);
        for count in [1, 20, 32, 33, 63, 64, 100] {
            fill(&mut film.tiles[0], count, 1.0, 1.0);
            film.take_reference();
            let expected = match count {
                32 | 64 => None,
                _ => Some(next_judged(count)),
            };
            assert_eq!(film.criterion(1.0).target(&film.tiles[0]), expected);
        }
        assert_eq!([0, 31, 32, 100].map(next_judged), [32, 32, 64, 128]);
    }

    #[test]
    fn adaptive_films_are_no_parts() {
        let (_, mut film) = counts([1.0; 4], 0.2);
        let even = FilmBuffer::new([64, 16], [0, 64, 0, 16], 1000);
        let refused = Err(super::super::MergeError::Adaptive);
        assert_eq!(film.merge(&even), refused);
        assert_eq!(even.clone().merge(&film), refused);
    }
}
