//! Pyramids: a picture and ever smaller ones, each the mean of the one before over its own pixels.
//!
//! A level has half the columns and rows of the one before, rounded down, and at least one. Pixel `j` of `m` covers the
//! pixels `j n / m` to `(j + 1) n / m` of `n`, and is their mean, weighted by how much of each it covers:
//!
//! ```text
//! n = 2 m:      (x[2j] + x[2j+1]) / 2
//! n = 2 m + 1:  ((m - j) x[2j] + m x[2j+1] + (j + 1) x[2j+2]) / n
//! ```
//!
//! Every pixel has the same weight in the sum of a level, so that all levels have the mean of the picture.
//!
//! Source: Williams 1983, "Pyramidal parametrics"; for odd sizes Guthe and Heckbert 2005, "Non-power-of-two mipmapping".
//! Departure: pbrt-v4 resizes pictures to powers of two first.

use rayon::prelude::*;
use specula_scene::Pixels;

use super::Raster;

impl Raster {
    /// The picture with its pyramid.
    pub(in crate::texture) fn with_pyramid(mut self) -> Self {
        let mut levels: Vec<Self> = Vec::new();
        loop {
            let last = levels.last().unwrap_or(&self);
            if last.width.max(last.height) <= 1 {
                break;
            }
            let next = last.halved();
            levels.push(next);
        }
        self.smaller = levels;
        self
    }

    /// Level 0 is the picture itself.
    pub(super) fn level(&self, level: usize) -> &Self {
        match level {
            0 => self,
            _ => &self.smaller[level - 1],
        }
    }

    /// The next smaller one.
    fn halved(&self) -> Self {
        let [columns, rows] = [self.width, self.height].map(Axis::new);
        let channels = if self.pixels.is_colour() { 3 } else { 1 };
        let stride = self.width.unsigned_abs() as usize;
        let mut values = vec![0.0; columns.to * rows.to * channels];
        let row_length = columns.to * channels;
        let fill = |(y, row): (usize, &mut [f32])| {
            let (y0, of_rows) = rows.weights(y);
            for (x, pixel) in row.chunks_exact_mut(channels).enumerate() {
                let (x0, of_columns) = columns.weights(x);
                let mut sum = [0.0_f64; 3];
                for (dy, a) in of_rows.iter().enumerate().filter(|(_, w)| **w > 0.0) {
                    for (dx, b) in of_columns.iter().enumerate().filter(|(_, w)| **w > 0.0) {
                        let rgb = self.pixels.rgb((y0 + dy) * stride + x0 + dx);
                        for (sum, v) in sum.iter_mut().zip(rgb) {
                            *sum += a * b * f64::from(v);
                        }
                    }
                }
                for (to, v) in pixel.iter_mut().zip(sum) {
                    *to = crate::convert::narrow(v);
                }
            }
        };
        values.par_chunks_mut(row_length).enumerate().for_each(fill);
        Self {
            width: halved(self.width),
            height: halved(self.height),
            pixels: Pixels::floats(values, channels == 3),
            smaller: Vec::new(),
        }
    }
}

/// Pixels of the levels below a picture, together.
pub(crate) fn pyramid_pixels([mut width, mut height]: [u32; 2]) -> u64 {
    let mut sum = 0;
    while width.max(height) > 1 {
        [width, height] = [width, height].map(|n| (n / 2).max(1));
        sum += u64::from(width) * u64::from(height);
    }
    sum
}

fn halved(size: i32) -> i32 {
    (size / 2).max(1)
}

/// Columns or rows, and how many there are in the next level.
struct Axis {
    from: usize,
    to: usize,
}

impl Axis {
    fn new(size: i32) -> Self {
        let [from, to] = [size, halved(size)].map(|n| n.unsigned_abs() as usize);
        Self { from, to }
    }

    /// The first pixel that pixel `j` of the next level covers, and the weights from it on.
    fn weights(&self, j: usize) -> (usize, [f64; 3]) {
        let (n, m) = (self.from as f64, self.to as f64);
        if self.from == 1 {
            (0, [1.0, 0.0, 0.0])
        } else if self.from == 2 * self.to {
            (2 * j, [0.5, 0.5, 0.0])
        } else {
            let j_ = j as f64;
            (2 * j, [(m - j_) / n, m / n, (j_ + 1.0) / n])
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use specula_bsdf::math::Stream;

    fn random(width: u32, height: u32, is_colour: bool) -> Raster {
        let mut random = Stream::new(u64::from(width * 1000 + height));
        let channels = if is_colour { 3 } else { 1 };
        let values = (0..width * height * channels).map(|_| random.next());
        let pixels = Pixels::floats(values.collect(), is_colour);
        Raster::new(width, height, pixels).with_pyramid()
    }

    fn mean(raster: &Raster) -> [f64; 3] {
        let sum = raster.pixels.iter().fold([0.0; 3], |sum, p| {
            [0, 1, 2].map(|c| sum[c] + f64::from(p[c]))
        });
        sum.map(|s| s / raster.pixels.len() as f64)
    }

    #[test]
    fn every_level_has_the_mean_of_the_picture() {
        for (width, height) in [
            (64, 64),
            (61, 37),
            (1, 17),
            (100, 3),
            (2, 1),
            (1, 1),
            (255, 254),
        ] {
            for is_colour in [false, true] {
                let raster = random(width, height, is_colour);
                let expected = mean(&raster);
                for level in &raster.smaller {
                    for (found, expected) in mean(level).into_iter().zip(expected) {
                        let error = (found - expected).abs();
                        assert!(error < 1e-6, "{width} x {height}: {found} and {expected}");
                    }
                }
                let last = raster.level(raster.smaller.len());
                assert_eq!([last.width, last.height], [1, 1]);
                let count: usize = raster.smaller.iter().map(|l| l.pixels.len()).sum();
                assert_eq!(count as u64, pyramid_pixels([width, height]));
            }
        }
    }

    /// Each pixel against the integral of the picture over what it covers.
    #[test]
    fn pixels_are_means_over_what_they_cover() {
        let raster = random(13, 6, false);
        let level = raster.level(1);
        assert_eq!([level.width, level.height], [6, 3]);
        for y in 0..3 {
            for x in 0..6 {
                let mut sum = 0.0;
                let (from, to) = (f64::from(x) * 13.0 / 6.0, f64::from(x + 1) * 13.0 / 6.0);
                for column in 0..13_u32 {
                    let c = f64::from(column);
                    let covered = (to.min(c + 1.0) - from.max(c)).max(0.0);
                    for row in [2 * y, 2 * y + 1] {
                        let [v, ..] = raster.pixels.rgb((row * 13 + column) as usize);
                        sum += covered * f64::from(v);
                    }
                }
                let expected = sum / (2.0 * 13.0 / 6.0);
                let [found, ..] = level.pixels.rgb((y * 6 + x) as usize);
                assert!((f64::from(found) - expected).abs() < 1e-6, "{x} {y}");
            }
        }
    }
}
