//! Image textures: pixels in memory and their interpolation.

mod filter;
mod moments;
mod pyramid;

pub(crate) use moments::slope_of;
pub(crate) use pyramid::pyramid_pixels;
use specula_bsdf::Rgb;
use specula_bsdf::math::rgb;
use specula_scene::Pixels;
use specula_scene::scene::{Interpolation, Wrap};

use crate::codes::NONE;
use crate::convert::{floor, floor_i32, id, truncated};
use crate::words::Words;

/// A picture's pixels, row by row from the top, in the depth of its file.
#[derive(Clone, Debug, Default)]
pub(super) struct Raster {
    width: i32,
    height: i32,
    pixels: Pixels,
    /// Ever smaller ones, down to one pixel; empty where no texture is filtered over them.
    smaller: Vec<Self>,
}

/// How a picture is sampled: behaviour outside of it, and interpolation.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lookup {
    /// Along s and t.
    pub(super) wrap: [Wrap; 2],
    pub(super) filter: Interpolation,
    /// Whether what the picture itself contributes is left out: the mean over what a footprint averages, times the share
    /// that is averaged. 0 where the picture is interpolated.
    pub(super) means_only: bool,
}

impl Raster {
    /// * `pixels`: `width * height`, else the picture is black.
    pub(super) fn new(width: u32, height: u32, pixels: Pixels) -> Self {
        let [Ok(w), Ok(h)] = [width, height].map(i32::try_from) else {
            return Self::default();
        };
        if pixels.is_empty() || pixels.len() as u64 != u64::from(width) * u64::from(height) {
            return Self::default();
        }
        Self {
            width: w,
            height: h,
            pixels,
            smaller: Vec::new(),
        }
    }

    /// The value at `(s, t)`, of the picture itself; t = 0 is its lower edge. Black where the coordinates are not finite.
    pub(super) fn at(&self, [s, t]: [f32; 2], lookup: Lookup) -> Rgb<f32> {
        if self.width == 0 || !(s.is_finite() && t.is_finite()) {
            return Rgb::BLACK;
        }
        let [x, y] = self.position([s, t], lookup.wrap);
        if matches!(lookup.filter, Interpolation::Nearest) {
            return self.pixel(floor_i32(x), floor_i32(y), lookup.wrap);
        }
        let [[x0, x1], [y0, y1]] = [x, y].map(|c| {
            let below = truncated(floor(c - 0.5));
            [below, below.saturating_add(1)]
        });
        let [fx, fy] = [x, y].map(|c| (c - 0.5) - floor(c - 0.5));
        let [wrap_x, wrap_y] = lookup.wrap;
        let columns = [x0, x1].map(|x| wrapped(x, self.width, wrap_x));
        let rows = [y0, y1].map(|y| wrapped(y, self.height, wrap_y));
        let [a, b, c, d] = match (columns, rows) {
            ([Some(x0), Some(x1)], [Some(y0), Some(y1)]) => {
                let [y0, y1] = [y0, y1].map(|y| y * self.width.unsigned_abs() as usize);
                let pixels = self.pixels.rgb_of([y0 + x0, y0 + x1, y1 + x0, y1 + x1]);
                pixels.map(|[r, g, b]| rgb(r, g, b))
            }
            _ => {
                [(x0, y0), (x1, y0), (x0, y1), (x1, y1)].map(|(x, y)| self.pixel(x, y, lookup.wrap))
            }
        };
        (a * (1.0 - fx) + b * fx) * (1.0 - fy) + (c * (1.0 - fx) + d * fx) * fy
    }

    /// Column and row of a point, with fractions; pixel centres are at halves.
    #[inline(always)]
    fn position(&self, [s, t]: [f32; 2], [wrap_s, wrap_t]: [Wrap; 2]) -> [f32; 2] {
        let x = reduced(s, wrap_s) * self.width as f32;
        let y = (1.0 - reduced(t, wrap_t)) * self.height as f32;
        [x, y]
    }

    #[inline]
    fn pixel(&self, x: i32, y: i32, [wrap_x, wrap_y]: [Wrap; 2]) -> Rgb<f32> {
        let (Some(x), Some(y)) = (
            wrapped(x, self.width, wrap_x),
            wrapped(y, self.height, wrap_y),
        ) else {
            return Rgb::BLACK;
        };
        let at = y * self.width.unsigned_abs() as usize + x;
        let [r, g, b] = self.pixels.rgb(at);
        rgb(r, g, b)
    }
}

impl Raster {
    /// Width, height, whether pixels are bytes; then three floats for each pixel, or a table of 256 floats and a word of
    /// three bytes for each pixel, red in the lowest one. Returns its offset.
    pub(super) fn flatten(&self, to: &mut Words) -> u32 {
        let here = to.offset();
        to.ids([self.width, self.height].map(i32::unsigned_abs));
        let Some(indexed) = self.pixels.indexed() else {
            to.flag(false);
            to.floats(self.pixels.iter().flatten());
            return here;
        };
        to.flag(true);
        to.floats(indexed.table.iter().copied());
        if indexed.is_colour {
            let words = indexed.indices.as_chunks().0.iter();
            to.ids(words.map(|&[r, g, b]| u32::from_le_bytes([r, g, b, 0])));
        } else {
            let words = indexed.indices.iter();
            to.ids(words.map(|&i| u32::from_le_bytes([i, i, i, 0])));
        }
        here
    }

    /// The number of smaller levels, then the offsets of all, the picture itself first. Returns its offset; [`NONE`]
    /// where smaller levels were not made.
    ///
    /// * `at`: offset of the picture itself.
    pub(super) fn flatten_pyramid(&self, at: u32, to: &mut Words) -> u32 {
        if self.smaller.is_empty() && self.width.max(self.height) > 1 {
            return NONE;
        }
        let levels: Vec<u32> = self.smaller.iter().map(|level| level.flatten(to)).collect();
        let here = to.offset();
        to.id(id(levels.len()));
        to.ids([at].into_iter().chain(levels));
        here
    }
}

/// Coordinates that repeat are reduced first, so that pixel indices stay small and exact.
#[inline]
fn reduced(s: f32, wrap: Wrap) -> f32 {
    match wrap {
        Wrap::Repeat => s - floor(s),
        Wrap::Mirror => s - 2.0 * floor(0.5 * s),
        Wrap::Black | Wrap::Clamp => s,
    }
}

/// The index of a pixel, wrapped to `0..size`; `None` where the picture is black.
#[inline]
fn wrapped(x: i32, size: i32, wrap: Wrap) -> Option<usize> {
    let inside = if (0..size).contains(&x) {
        x
    } else {
        match wrap {
            Wrap::Repeat => x.rem_euclid(size),
            Wrap::Clamp => x.clamp(0, size - 1),
            Wrap::Mirror => {
                let back = i64::from(x).rem_euclid(2 * i64::from(size));
                i32::try_from(back.min(2 * i64::from(size) - 1 - back)).unwrap_or(0)
            }
            Wrap::Black => return None,
        }
    };
    usize::try_from(inside).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Upper row 0, 1; lower row 2, 3.
    fn square() -> Raster {
        Raster::new(2, 2, vec![[0.0; 3], [1.0; 3], [2.0; 3], [3.0; 3]].into())
    }

    fn at(wrap: Wrap, filter: Interpolation, s: f32, t: f32) -> f32 {
        let lookup = Lookup {
            wrap: [wrap; 2],
            filter,
            means_only: false,
        };
        square().at([s, t], lookup).r
    }

    #[test]
    fn pictures_stand_upright_and_interpolate() {
        let at = |s, t| at(Wrap::Clamp, Interpolation::Bilinear, s, t);
        assert_eq!(at(0.25, 0.75), 0.0);
        assert_eq!(at(0.75, 0.75), 1.0);
        assert_eq!(at(0.25, 0.25), 2.0);
        assert_eq!(at(0.5, 0.5), 1.5);
        assert_eq!(at(-5.0, -5.0), 2.0);
        assert_eq!(at(f32::NAN, 0.5), 0.0);
    }

    #[test]
    fn wraps_differ_outside() {
        let at = |wrap, s, t| at(wrap, Interpolation::Bilinear, s, t);
        assert_eq!(at(Wrap::Black, 1.75, 0.25), 0.0);
        assert_eq!(at(Wrap::Black, 1.0, 0.25), 1.5);
        assert_eq!(at(Wrap::Repeat, 1.75, 0.25), 3.0);
        assert_eq!(at(Wrap::Repeat, -1.25, -0.75), 3.0);
        assert_eq!(at(Wrap::Mirror, 1.25, 0.25), 3.0);
        assert_eq!(at(Wrap::Mirror, -0.25, 0.25), 2.0);
        assert_eq!(at(Wrap::Mirror, 2.25, -0.25), 2.0);
        // Across a mirror there is nothing to interpolate.
        assert_eq!(at(Wrap::Mirror, 1.0, 0.25), 3.0);
        assert_eq!(at(Wrap::Repeat, 1.0, 0.25), 2.5);
    }

    #[test]
    fn each_axis_wraps_by_its_own_rule() {
        let lookup = Lookup {
            wrap: [Wrap::Repeat, Wrap::Clamp],
            filter: Interpolation::Nearest,
            means_only: false,
        };
        assert_eq!(square().at([1.6, 7.0], lookup).r, 1.0);
        assert_eq!(square().at([-0.4, -7.0], lookup).r, 3.0);
    }

    #[test]
    fn nearest_is_the_pixel_around_the_point() {
        let at = |s, t| at(Wrap::Repeat, Interpolation::Nearest, s, t);
        assert_eq!(at(0.49, 0.51), 0.0);
        assert_eq!(at(0.51, 0.49), 3.0);
        assert_eq!(at(-0.01, 0.51), 1.0);
    }
}
