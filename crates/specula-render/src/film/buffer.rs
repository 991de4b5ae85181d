//! Sums per pixel, and the picture that they make.

use rayon::prelude::*;
use specula_bsdf::math::vec3;
use specula_bsdf::{Rgb, Vec3};

use super::sum::{FixedSum, Sum};
use super::tile::{Tile, bounds_of, empty_tiles};
use crate::convert::narrow;
use crate::picture::Picture;

/// What one camera path adds to its pixel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PixelSample {
    pub(crate) colour: Rgb<f32>,
    pub(crate) albedo: Rgb<f32>,
    pub(crate) normal: Vec3<f32>,
    /// Distance along the camera ray; `None` where the ray hit nothing.
    pub(crate) depth: Option<f32>,
}

/// Sums over the samples of one pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct PixelSums {
    pub(super) colour: [Sum; 3],
    pub(super) squares: [Sum; 3],
    pub(super) albedo: [FixedSum; 3],
    pub(super) normal: [FixedSum; 3],
    pub(super) depth: Sum,
    pub(super) hits: u32,
    pub(crate) count: u32,
}

impl PixelSums {
    /// Words of [`words`](Self::words).
    pub(crate) const WORDS: usize = 21;

    /// Adds a sample with its filter weight; returns whether it was finite. A sample that is not
    /// counts as black.
    #[cfg(test)]
    pub(crate) fn add(&mut self, sample: &PixelSample, weight: f32) -> bool {
        self.count += 1;
        let value = sample.colour * weight;
        if !value.is_finite() {
            return false;
        }
        let albedo = (sample.albedo * weight).to_array();
        let normal = (sample.normal * weight).to_array();
        for (i, v) in value.to_array().into_iter().enumerate() {
            self.colour[i].add(f64::from(v));
            self.squares[i].add(f64::from(v) * f64::from(v));
            self.albedo[i].add(albedo[i]);
            self.normal[i].add(normal[i]);
        }
        if let Some(depth) = sample.depth {
            self.depth.add(f64::from(depth));
            self.hits += 1;
        }
        true
    }

    fn merge(&mut self, o: &Self) {
        for i in 0..3 {
            self.colour[i].merge(o.colour[i]);
            self.squares[i].merge(o.squares[i]);
            self.albedo[i].merge(o.albedo[i]);
            self.normal[i].merge(o.normal[i]);
        }
        self.depth.merge(o.depth);
        self.hits = self.hits.saturating_add(o.hits);
        self.count = self.count.saturating_add(o.count);
    }

    fn mean(&self) -> [f64; 3] {
        let n = f64::from(self.count.max(1));
        self.colour.map(|c| c.value() / n)
    }

    /// Luminance of the mean, below 0 only where filters or balances have negative parts, and its standard deviation;
    /// the channels are taken for fully correlated.
    #[inline(always)]
    pub(super) fn luminance_and_deviation(&self) -> [f64; 2] {
        let [mean, variance] = self.mean_and_variance();
        let deviation = [variance[0].sqrt(), variance[1].sqrt(), variance[2].sqrt()];
        [
            Rgb::from(mean).luminance(),
            Rgb::from(deviation).luminance(),
        ]
    }

    /// The mean, and its variance: the unbiased variance of one sample over their number; infinite below two samples.
    #[inline(always)]
    fn mean_and_variance(&self) -> [[f64; 3]; 2] {
        let n = f64::from(self.count.max(1));
        let (mut mean, mut variance) = ([0.0; 3], [f64::INFINITY; 3]);
        for i in 0..3 {
            mean[i] = self.colour[i].value() / n;
            if self.count >= 2 {
                let of_one = self.squares[i].value() / n - mean[i] * mean[i];
                variance[i] = (of_one / (n - 1.0)).max(0.0);
            }
        }
        [mean, variance]
    }

    /// All of it as words of 64 bits, for files.
    pub(crate) fn words(&self) -> [u64; Self::WORDS] {
        let Self {
            colour,
            squares,
            albedo,
            normal,
            depth,
            hits,
            count,
        } = self;
        let mut words = [0; Self::WORDS];
        let sums = colour.iter().chain(squares).chain([depth]);
        let sums = sums.flat_map(|s| s.words());
        let fixed = albedo.iter().chain(normal).map(|s| s.word());
        let counts = u64::from(*hits) << 32 | u64::from(*count);
        for (to, from) in words.iter_mut().zip(sums.chain(fixed).chain([counts])) {
            *to = from;
        }
        words
    }

    /// The sums that have these [`words`](Self::words).
    #[allow(clippy::cast_possible_truncation, reason = "halves of a word")]
    pub(crate) fn from_words(w: &[u64; Self::WORDS]) -> Self {
        let sum = |i: usize| Sum::from_words([w[2 * i], w[2 * i + 1]]);
        let fixed = |i: usize| FixedSum::from_word(w[14 + i]);
        Self {
            colour: [sum(0), sum(1), sum(2)],
            squares: [sum(3), sum(4), sum(5)],
            depth: sum(6),
            albedo: [fixed(0), fixed(1), fixed(2)],
            normal: [fixed(3), fixed(4), fixed(5)],
            hits: (w[20] >> 32) as u32,
            count: w[20] as u32,
        }
    }
}

/// The film: sums per pixel, in tiles.
///
/// A pixel's sums depend on its own samples only, added in the order of their indices.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmBuffer {
    full_resolution: [u32; 2],
    /// `[x0, x1, y0, y1]`.
    crop: [u32; 4],
    /// Index of each pixel's first sample.
    first_sample: u32,
    /// Indices of the samples of a film that was merged from parts which leave gaps, half open, in
    /// order; empty: `first_sample` and what follows.
    parts: Vec<[u32; 2]>,
    /// Work that adaptive sampling has allotted so far, in samples of every pixel; 0 in other films.
    pub(super) work: f64,
    pub(crate) tiles: Vec<Tile>,
}

/// Why films cannot be merged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MergeError {
    /// Their sizes differ.
    #[error("films of different size or crop cannot be merged")]
    Size,
    /// Samples would count twice.
    #[error("samples {0} to {1} are in both films")]
    Overlap(u32, u32),
    /// Their pixels have different numbers of samples, not as shares of one round.
    #[error(
        "adaptive films are merged only where they are shares of one round: their pixels differ in samples \
         (`specula render --samples A..B` renders parts that add up)"
    )]
    Adaptive,
}

impl FilmBuffer {
    /// An empty film.
    ///
    /// * `crop`: pixels `[x0, x1, y0, y1]` of the whole picture, half open.
    /// * `first_sample`: the index of each pixel's first sample.
    pub fn new(full_resolution: [u32; 2], crop: [u32; 4], first_sample: u32) -> Self {
        Self {
            full_resolution,
            crop,
            first_sample,
            parts: Vec::new(),
            work: 0.0,
            tiles: empty_tiles(crop),
        }
    }

    /// Width and height of the whole picture.
    pub fn full_resolution(&self) -> [u32; 2] {
        self.full_resolution
    }

    /// Indices of the samples within, as ranges `[from, to)` in order. Where a pass was not
    /// finished, some pixels lack the last ones; in an adaptive film, most do.
    pub fn samples(&self) -> Vec<[u32; 2]> {
        if !self.parts.is_empty() {
            return self.parts.clone();
        }
        match self.tiles.iter().map(Tile::count).max() {
            Some(most @ 1..) => vec![[self.first_sample, self.first_sample.saturating_add(most)]],
            _ => Vec::new(),
        }
    }

    /// Whether samples can be added: those within follow each other from the first on.
    pub fn is_open(&self) -> bool {
        self.parts.is_empty()
    }

    /// Index of each pixel's first sample.
    pub fn first_sample(&self) -> u32 {
        self.first_sample
    }

    /// A film of stored sums; `None` where the parts do not fit each other, or pixels of a tile differ in their samples.
    pub(crate) fn restore(
        full_resolution: [u32; 2],
        crop: [u32; 4],
        first_sample: u32,
        parts: Vec<[u32; 2]>,
        work: f64,
        tiles: Vec<Tile>,
    ) -> Option<Self> {
        let ordered = parts.windows(2).all(|p| p[0][1] < p[1][0]);
        let whole =
            tiles.iter().map(|t| t.bounds).eq(bounds_of(crop)) && tiles.iter().all(Tile::is_even);
        if !ordered || !whole || parts.iter().any(|[from, to]| from >= to) {
            return None;
        }
        Some(Self {
            full_resolution,
            crop,
            first_sample,
            parts,
            work,
            tiles,
        })
    }

    /// Pixels `[x0, x1, y0, y1]` of the whole picture that the film covers.
    pub fn crop(&self) -> [u32; 4] {
        self.crop
    }

    /// Samples that every pixel has at least.
    pub fn complete_samples(&self) -> u32 {
        self.tiles.iter().map(Tile::count).min().unwrap_or(0)
    }

    /// The most samples of any pixel, and their mean over the pixels.
    pub fn most_and_mean_samples(&self) -> (u32, f64) {
        let most = self.tiles.iter().map(Tile::count).max().unwrap_or(0);
        let pixels: usize = self.tiles.iter().map(|t| t.pixels.len()).sum();
        let of_tile = |t: &Tile| u64::from(t.count()) * t.pixels.len() as u64;
        let sum: u64 = self.tiles.iter().map(of_tile).sum();
        (most, sum as f64 / pixels.max(1) as f64)
    }

    /// Samples that were not finite. They count as black; a correct renderer has none.
    pub fn invalid_samples(&self) -> u64 {
        self.tiles.iter().map(|t| t.invalid).sum()
    }

    /// Adds the samples of another film of the same scene and seed. All layers of its picture are, bit
    /// for bit, those of one render of all the samples. Of adaptive films, shares of a round
    /// ([`RenderOptions::round_share`](crate::RenderOptions::round_share)) become the whole round.
    ///
    /// # Errors
    /// Where the films differ in size or crop, have samples in common, or are adaptive and no shares of one round.
    pub fn merge(&mut self, other: &Self) -> Result<(), MergeError> {
        if self.full_resolution != other.full_resolution || self.crop != other.crop {
            return Err(MergeError::Size);
        }
        if self.is_adaptive() || other.is_adaptive() {
            return self.merge_round(other);
        }
        let mut all = [self.samples(), other.samples()].concat();
        all.sort_unstable();
        if let Some(p) = all.windows(2).find(|p| p[0][1] > p[1][0]) {
            return Err(MergeError::Overlap(p[1][0], p[0][1].min(p[1][1])));
        }
        let pairs = self.tiles.par_iter_mut().zip(&other.tiles);
        pairs.for_each(|(a, b)| {
            for (p, q) in a.pixels.iter_mut().zip(b.pixels.iter()) {
                p.merge(q);
            }
            a.invalid += b.invalid;
            a.rays += b.rays;
        });
        all.dedup_by(|next, range| {
            let adjoin = range[1] == next[0];
            if adjoin {
                range[1] = next[1];
            }
            adjoin
        });
        // One range of which no pixel lacks a sample can be gone on with.
        match all[..] {
            [[from, to]] if self.tiles.iter().all(|t| t.count() == to - from) => {
                self.first_sample = from;
                self.parts.clear();
            }
            _ => self.parts = all,
        }
        Ok(())
    }

    /// The colours of the picture as it is now, row by row.
    pub fn colour(&self) -> Vec<Rgb<f32>> {
        let [x0, x1, y0, y1] = self.crop;
        let width = (x1 - x0) as usize;
        let mut colour = vec![Rgb::BLACK; width * (y1 - y0) as usize];
        for tile in &self.tiles {
            let [left, right, top, _] = tile.bounds;
            let rows = tile.pixels.chunks((right - left) as usize);
            for (row, pixels) in ((top - y0) as usize..).zip(rows) {
                let first = row * width + (left - x0) as usize;
                for (c, p) in colour[first..].iter_mut().zip(pixels) {
                    *c = Rgb::from(p.mean()).cast();
                }
            }
        }
        colour
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
            for (i, p) in (0_u32..).zip(tile.pixels.iter()) {
                let x = tile.bounds[0] - x0 + i % tile_width;
                let y = tile.bounds[2] - y0 + i / tile_width;
                let at = (y * width + x) as usize;
                let inverse = 1.0 / f64::from(p.count.max(1));
                let [mean, variance] = p.mean_and_variance();
                picture.colour[at] = Rgb::from(mean).cast();
                // Unknown below two samples: 0, since pictures hold finite values only.
                picture.variance[at] =
                    Rgb::from(variance.map(|v| if v.is_finite() { v } else { 0.0 })).cast();
                picture.albedo[at] = Rgb::from(p.albedo.map(|a| a.value() * inverse)).cast();
                let [x, y, z] = p.normal.map(|n| narrow(n.value() * inverse));
                picture.normal[at] = vec3(x, y, z);
                picture.depth[at] = narrow(p.depth.value() / f64::from(p.hits.max(1)));
                picture.sample_count[at] = p.count as f32;
            }
        }
        picture
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
        let mut film = FilmBuffer::new([20, 18], [1, 19, 0, 18], 0);
        for tile in &mut film.tiles {
            for p in tile.pixels.iter_mut() {
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
        assert!((film.noise() - (7.0_f32 / 3.0 / 9.0 / 1.01).sqrt()).abs() < 1e-4);
    }

    #[test]
    fn what_is_not_finite_is_dropped_and_reported() {
        let mut p = PixelSums::default();
        assert!(!p.add(&sample(f32::NAN), 1.0));
        assert!(p.add(&sample(4.0), 1.0));
        assert_eq!(p.mean(), [2.0; 3]);
    }

    /// A film of 20 x 4 pixels, in two tiles, with `n` samples from `first` on, each its own number.
    fn film(first: u32, n: u32) -> FilmBuffer {
        let mut film = FilmBuffer::new([20, 4], [0, 20, 0, 4], first);
        for number in first..first + n {
            for p in film.tiles.iter_mut().flat_map(|t| t.pixels.iter_mut()) {
                p.add(&sample(number as f32 * 0.1), 0.7);
            }
        }
        film
    }

    #[test]
    fn merged_films_are_one_render_of_all_samples() {
        let mut parts = film(40, 7);
        parts.merge(&film(0, 13)).unwrap();
        assert_eq!(parts.samples(), [[0, 13], [40, 47]]);
        assert!(!parts.is_open());
        parts.merge(&film(13, 27)).unwrap();
        let whole = film(0, 47);
        assert_eq!(parts.samples(), whole.samples());
        assert!(parts.is_open() && parts.first_sample() == 0);
        assert_eq!(parts.picture(), whole.picture());
    }

    #[test]
    fn samples_never_count_twice() {
        let mut a = film(0, 10);
        assert_eq!(a.merge(&film(9, 5)), Err(MergeError::Overlap(9, 10)));
        assert_eq!(a.merge(&film(3, 2)), Err(MergeError::Overlap(3, 5)));
        let other = FilmBuffer::new([20, 4], [0, 3, 0, 4], 10);
        assert_eq!(a.merge(&other), Err(MergeError::Size));
        assert_eq!(a, film(0, 10));
    }

    #[test]
    fn a_part_with_an_unfinished_pass_cannot_be_gone_on_with() {
        let mut a = film(0, 10);
        for p in a.tiles[1].pixels.iter_mut() {
            p.add(&sample(1.0), 1.0);
        }
        assert_eq!(a.samples(), [[0, 11]]);
        assert_eq!(
            (a.complete_samples(), a.most_and_mean_samples()),
            (10, (11, 10.2))
        );
        a.merge(&film(11, 4)).unwrap();
        assert_eq!((a.samples(), a.is_open()), (vec![[0, 15]], false));
    }

    #[test]
    fn pixels_of_a_tile_have_as_many_samples() {
        let whole = film(0, 3);
        let restored = |tiles: Vec<Tile>| {
            FilmBuffer::restore([20, 4], [0, 20, 0, 4], 0, Vec::new(), 0.0, tiles)
        };
        assert_eq!(restored(whole.tiles.clone()), Some(whole.clone()));
        let mut tiles = whole.tiles;
        tiles[1].pixels[3].count += 1;
        assert_eq!(restored(tiles), None);
    }

    #[test]
    fn words_hold_all_of_a_pixel() {
        let mut p = PixelSums::default();
        for v in [0.1, 7.0, 1e-9] {
            let mut s = sample(v);
            s.albedo = specula_bsdf::math::rgb(0.1, 0.2, 0.3);
            s.normal = vec3(-0.5, 0.25, 1.0);
            p.add(&s, 1.1);
        }
        p.hits = 2;
        assert_eq!(PixelSums::from_words(&p.words()), p);
        assert_eq!(size_of::<PixelSums>(), 8 * PixelSums::WORDS);
    }
}
