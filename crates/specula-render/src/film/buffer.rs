//! Sums per pixel, and the picture that they make.

use specula_bsdf::math::vec3;
use specula_bsdf::{Rgb, Vec3};

use crate::convert::narrow;
use crate::picture::Picture;

/// Side of a tile in pixels.
pub(crate) const TILE: u32 = 16;

/// What one camera path brings to its pixel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PixelSample {
    pub(crate) colour: Rgb<f32>,
    pub(crate) albedo: Rgb<f32>,
    pub(crate) normal: Vec3<f32>,
    /// Distance along the camera ray; `None` where the path met nothing.
    pub(crate) depth: Option<f32>,
}

/// Sums over the samples of one pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct PixelSums {
    colour: [f64; 3],
    squares: [f64; 3],
    albedo: [f32; 3],
    normal: [f32; 3],
    depth: f32,
    hits: u32,
    pub(crate) count: u32,
}

impl PixelSums {
    /// Adds a sample with its filter weight; returns whether it was finite. A sample that is not
    /// counts as black.
    #[inline]
    pub(crate) fn add(&mut self, sample: &PixelSample, weight: f32) -> bool {
        self.count += 1;
        let value = sample.colour * weight;
        if !value.is_finite() {
            return false;
        }
        let albedo = (sample.albedo * weight).to_array();
        let normal = (sample.normal * weight).to_array();
        for (i, v) in value.to_array().into_iter().enumerate() {
            self.colour[i] += f64::from(v);
            self.squares[i] += f64::from(v) * f64::from(v);
            self.albedo[i] += albedo[i];
            self.normal[i] += normal[i];
        }
        if let Some(depth) = sample.depth {
            self.depth += depth;
            self.hits += 1;
        }
        true
    }

    fn merge(&mut self, o: &Self) {
        for i in 0..3 {
            self.colour[i] += o.colour[i];
            self.squares[i] += o.squares[i];
            self.albedo[i] += o.albedo[i];
            self.normal[i] += o.normal[i];
        }
        self.depth += o.depth;
        self.hits += o.hits;
        self.count += o.count;
    }

    fn mean(&self) -> [f64; 3] {
        let n = f64::from(self.count.max(1));
        self.colour.map(|c| c / n)
    }

    /// Variance of the mean: the unbiased variance of one sample over their number; infinite below
    /// two samples.
    fn variance(&self) -> [f64; 3] {
        if self.count < 2 {
            return [f64::INFINITY; 3];
        }
        let n = f64::from(self.count);
        let mean = self.mean();
        [0, 1, 2].map(|i| ((self.squares[i] / n - mean[i] * mean[i]) / (n - 1.0)).max(0.0))
    }
}

/// A square of pixels, the unit of work.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tile {
    /// Pixels `[x0, x1, y0, y1]` of the whole picture.
    pub(crate) bounds: [u32; 4],
    /// Row by row.
    pub(crate) pixels: Vec<PixelSums>,
    /// Samples that were not finite.
    pub(crate) invalid: u64,
}

/// The film: sums per pixel, in tiles.
///
/// A pixel's sums depend on its own samples only, added in the order of their numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmBuffer {
    full_resolution: [u32; 2],
    /// `[x0, x1, y0, y1]`.
    crop: [u32; 4],
    pub(crate) tiles: Vec<Tile>,
}

/// Films that cannot be merged: their sizes differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("films of different size or crop cannot be merged")]
pub struct MergeError;

impl FilmBuffer {
    /// An empty film.
    ///
    /// * `crop`: pixels `[x0, x1, y0, y1]` of the whole picture, half open.
    pub fn new(full_resolution: [u32; 2], crop: [u32; 4]) -> Self {
        let [x0, x1, y0, y1] = crop;
        let mut tiles = Vec::new();
        for y in (y0..y1).step_by(TILE as usize) {
            for x in (x0..x1).step_by(TILE as usize) {
                let bounds = [x, (x + TILE).min(x1), y, (y + TILE).min(y1)];
                let area = (bounds[1] - bounds[0]) * (bounds[3] - bounds[2]);
                tiles.push(Tile {
                    bounds,
                    pixels: vec![PixelSums::default(); area as usize],
                    invalid: 0,
                });
            }
        }
        Self {
            full_resolution,
            crop,
            tiles,
        }
    }

    /// Pixels `[x0, x1, y0, y1]` of the whole picture that the film covers.
    pub fn crop(&self) -> [u32; 4] {
        self.crop
    }

    /// Samples that every pixel has at least.
    pub fn complete_samples(&self) -> u32 {
        self.sums().map(|p| p.count).min().unwrap_or(0)
    }

    /// Samples that were not finite numbers. They count as black; a correct renderer has none.
    pub fn invalid_samples(&self) -> u64 {
        self.tiles.iter().map(|t| t.invalid).sum()
    }

    /// Adds the samples of another film of the same scene, rendered with another seed.
    ///
    /// # Errors
    /// Where the films differ in size or crop.
    pub fn merge(&mut self, other: &Self) -> Result<(), MergeError> {
        if self.full_resolution != other.full_resolution || self.crop != other.crop {
            return Err(MergeError);
        }
        for (a, b) in self.tiles.iter_mut().zip(&other.tiles) {
            for (p, q) in a.pixels.iter_mut().zip(&b.pixels) {
                p.merge(q);
            }
            a.invalid += b.invalid;
        }
        Ok(())
    }

    /// Estimate of the picture's relative error: the square root of the mean over pixels of
    ///
    /// ```text
    /// var(mean luminance) / (mean luminance^2 + (picture's mean luminance / 100)^2)
    /// ```
    ///
    /// The second term keeps black pixels from dominating. The channels are taken for fully
    /// correlated, which overestimates the error of luminance where they are not. Infinite below
    /// two samples per pixel.
    pub fn noise(&self) -> f32 {
        let luminance = |c: [f64; 3]| Rgb::from(c).luminance();
        let pixels = self.sums().count().max(1) as f64;
        let mean = self.sums().map(|p| luminance(p.mean())).sum::<f64>() / pixels;
        let floor = (0.01 * mean).powi(2).max(f64::MIN_POSITIVE);
        let sum: f64 = self
            .sums()
            .map(|p| {
                let deviation = luminance(p.variance().map(f64::sqrt));
                deviation * deviation / (luminance(p.mean()).powi(2) + floor)
            })
            .sum();
        narrow((sum / pixels).sqrt())
    }

    /// The picture as it is now.
    pub fn picture(&self) -> Picture {
        let [x0, x1, y0, y1] = self.crop;
        let (width, height) = (x1 - x0, y1 - y0);
        let n = width as usize * height as usize;
        let mut picture = Picture {
            width,
            height,
            full_resolution: self.full_resolution,
            offset: [x0, y0],
            colour: vec![Rgb::BLACK; n],
            albedo: vec![Rgb::BLACK; n],
            normal: vec![Vec3::ZERO; n],
            depth: vec![0.0; n],
            sample_count: vec![0.0; n],
            variance: vec![Rgb::BLACK; n],
        };
        for tile in &self.tiles {
            let tile_width = tile.bounds[1] - tile.bounds[0];
            for (i, p) in (0_u32..).zip(&tile.pixels) {
                let x = tile.bounds[0] - x0 + i % tile_width;
                let y = tile.bounds[2] - y0 + i / tile_width;
                let at = (y * width + x) as usize;
                let inverse = 1.0 / p.count.max(1) as f32;
                picture.colour[at] = Rgb::from(p.mean()).cast();
                // Unknown below two samples: 0, since pictures hold finite numbers only.
                picture.variance[at] =
                    Rgb::from(p.variance().map(|v| if v.is_finite() { v } else { 0.0 })).cast();
                picture.albedo[at] = Rgb::from(p.albedo) * inverse;
                picture.normal[at] = vec3(p.normal[0], p.normal[1], p.normal[2]) * inverse;
                picture.depth[at] = p.depth / p.hits.max(1) as f32;
                picture.sample_count[at] = p.count as f32;
            }
        }
        picture
    }

    fn sums(&self) -> impl Iterator<Item = &PixelSums> {
        self.tiles.iter().flat_map(|t| &t.pixels)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(v: f32) -> PixelSample {
        PixelSample {
            colour: Rgb::splat(v),
            albedo: Rgb::WHITE,
            normal: Vec3::Z,
            depth: Some(2.0),
        }
    }

    #[test]
    fn mean_and_variance_of_the_mean_are_the_textbook_ones() {
        let mut film = FilmBuffer::new([20, 18], [1, 19, 0, 18]);
        for tile in &mut film.tiles {
            for p in &mut tile.pixels {
                for v in [1.0, 2.0, 6.0] {
                    assert!(p.add(&sample(v), 1.0));
                }
            }
        }
        let picture = film.picture();
        assert_eq!(
            (picture.width, picture.height, picture.offset),
            (18, 18, [1, 0])
        );
        // Variance of one sample: (4 + 1 + 9) / 2 = 7; of the mean of three: 7 / 3.
        assert!(picture.colour.iter().all(|c| (c.g - 3.0).abs() < 1e-6));
        assert!(
            picture
                .variance
                .iter()
                .all(|c| (c.g - 7.0 / 3.0).abs() < 1e-5)
        );
        assert!(picture.depth.iter().all(|&d| d == 2.0));
        assert!((film.noise() - (7.0_f32 / 3.0 / 9.0).sqrt()).abs() < 1e-3);
    }

    #[test]
    fn what_is_not_finite_is_dropped_and_reported() {
        let mut p = PixelSums::default();
        assert!(!p.add(&sample(f32::NAN), 1.0));
        assert!(p.add(&sample(4.0), 1.0));
        assert_eq!(p.mean(), [2.0; 3]);
    }

    #[test]
    fn merged_films_hold_the_samples_of_both() {
        let mut a = FilmBuffer::new([4, 4], [0, 4, 0, 4]);
        let mut b = a.clone();
        a.tiles[0].pixels[5].add(&sample(1.0), 1.0);
        b.tiles[0].pixels[5].add(&sample(3.0), 1.0);
        a.merge(&b).unwrap();
        assert_eq!(a.picture().colour[5], Rgb::splat(2.0));
        assert!(a.merge(&FilmBuffer::new([4, 4], [0, 3, 0, 4])).is_err());
    }
}
