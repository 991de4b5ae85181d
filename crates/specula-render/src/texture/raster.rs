//! Pictures, looked up.

use specula_bsdf::Rgb;
use specula_bsdf::math::rgb;
use specula_scene::scene::{Interpolation, Wrap};

use crate::convert::floor_i32;
use crate::flat::Words;

/// A picture's pixels, row by row from the top.
#[derive(Clone, Debug, Default)]
pub(super) struct Raster {
    width: i32,
    height: i32,
    pixels: Pixels,
}

#[derive(Clone, Debug)]
enum Pixels {
    Floats(Vec<[f32; 3]>),
    /// At most 256 different numbers, as pictures of 8 bits have, whatever their transfer curve: a
    /// quarter of the memory.
    Bytes {
        palette: Box<[f32; 256]>,
        pixels: Vec<[u8; 3]>,
    },
}

impl Default for Pixels {
    fn default() -> Self {
        Self::Floats(Vec::new())
    }
}

/// How a picture is looked up.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lookup {
    /// Along s and t.
    pub(super) wrap: [Wrap; 2],
    pub(super) filter: Interpolation,
}

impl Raster {
    /// * `pixels`: `width * height`, else the picture is black.
    pub(super) fn new(width: u32, height: u32, pixels: Vec<[f32; 3]>) -> Self {
        let [Ok(w), Ok(h)] = [width, height].map(i32::try_from) else {
            return Self::default();
        };
        if pixels.is_empty() || pixels.len() as u64 != u64::from(width) * u64::from(height) {
            return Self::default();
        }
        Self {
            width: w,
            height: h,
            pixels: match bytes(&pixels) {
                Some(bytes) => bytes,
                None => Pixels::Floats(pixels),
            },
        }
    }

    /// The value at `(s, t)`; t = 0 is the lower edge of the picture. Black where the coordinates
    /// are no numbers.
    pub(super) fn at(&self, [s, t]: [f32; 2], lookup: Lookup) -> Rgb<f32> {
        if self.width == 0 || !(s.is_finite() && t.is_finite()) {
            return Rgb::BLACK;
        }
        let [wrap_s, wrap_t] = lookup.wrap;
        let x = reduced(s, wrap_s) * self.width as f32;
        let y = (1.0 - reduced(t, wrap_t)) * self.height as f32;
        if lookup.filter == Interpolation::Nearest {
            return self.pixel(floor_i32(x), floor_i32(y), lookup.wrap);
        }
        let (x, y) = (x - 0.5, y - 0.5);
        let (x0, y0) = (floor_i32(x), floor_i32(y));
        let (fx, fy) = (x - x.floor(), y - y.floor());
        let at = |dx: i32, dy: i32| {
            let (x, y) = (x0.saturating_add(dx), y0.saturating_add(dy));
            self.pixel(x, y, lookup.wrap)
        };
        (at(0, 0) * (1.0 - fx) + at(1, 0) * fx) * (1.0 - fy)
            + (at(0, 1) * (1.0 - fx) + at(1, 1) * fx) * fy
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
        let [r, g, b] = match &self.pixels {
            Pixels::Floats(pixels) => pixels[at],
            Pixels::Bytes { palette, pixels } => pixels[at].map(|i| palette[usize::from(i)]),
        };
        rgb(r, g, b)
    }
}

impl Raster {
    /// Width, height, whether it is of bytes; then three numbers for each pixel, or 256 numbers and a
    /// word for each pixel, red in its lowest byte. Returns its place.
    pub(super) fn flatten(&self, to: &mut Words) -> u32 {
        let here = to.place();
        to.ids([self.width, self.height].map(i32::unsigned_abs));
        match &self.pixels {
            Pixels::Floats(pixels) => {
                to.flag(false);
                to.numbers(pixels.as_flattened().iter().copied());
            }
            Pixels::Bytes { palette, pixels } => {
                to.flag(true);
                to.numbers(palette.iter().copied());
                to.ids(
                    pixels
                        .iter()
                        .map(|&[r, g, b]| u32::from_le_bytes([r, g, b, 0])),
                );
            }
        }
        here
    }
}

/// Coordinates that repeat are reduced first: pixel numbers stay small and exact.
#[inline]
fn reduced(s: f32, wrap: Wrap) -> f32 {
    match wrap {
        Wrap::Repeat => s - s.floor(),
        Wrap::Mirror => s - 2.0 * (0.5 * s).floor(),
        Wrap::Black | Wrap::Clamp => s,
    }
}

/// A number of `0..size`; `None` where the picture is black.
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

/// Whether a picture is kept in bytes.
pub(super) fn is_of_bytes(pixels: &[[f32; 3]]) -> bool {
    bytes(pixels).is_some()
}

/// Pixels as numbers of a palette; `None` where that would need more than 256.
fn bytes(pixels: &[[f32; 3]]) -> Option<Pixels> {
    /// A free place of the table.
    const FREE: u16 = u16::MAX;
    const PLACES: usize = 1024;
    // Numbers by their bits, with open addressing.
    let mut table = [(0_u32, FREE); PLACES];
    let mut palette = Box::new([0.0; 256]);
    let mut known = 0_u16;
    let mut number = |v: f32| {
        let bits = v.to_bits();
        let mut place = (bits.wrapping_mul(0x9e37_79b9) >> 22) as usize;
        loop {
            match table[place] {
                (b, n) if b == bits && n != FREE => return u8::try_from(n).ok(),
                (_, FREE) => {
                    let n = u8::try_from(known).ok()?;
                    palette[usize::from(n)] = v;
                    table[place] = (bits, known);
                    known += 1;
                    return Some(n);
                }
                _ => place = (place + 1) % PLACES,
            }
        }
    };
    let mut out = Vec::new();
    // Pictures with more numbers show it soon: nothing is allocated for those.
    for (i, &[r, g, b]) in pixels.iter().enumerate() {
        let pixel = [number(r)?, number(g)?, number(b)?];
        if i == 0 {
            out.reserve_exact(pixels.len());
        }
        out.push(pixel);
    }
    Some(Pixels::Bytes {
        palette,
        pixels: out,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Upper row 0, 1; lower row 2, 3.
    fn square() -> Raster {
        Raster::new(2, 2, vec![[0.0; 3], [1.0; 3], [2.0; 3], [3.0; 3]])
    }

    fn at(wrap: Wrap, filter: Interpolation, s: f32, t: f32) -> f32 {
        let lookup = Lookup {
            wrap: [wrap; 2],
            filter,
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

    #[test]
    fn palettes_change_no_bit_and_are_left_where_they_are_too_small() {
        for (count, fits) in [(256, true), (257, false)] {
            let pixels: Vec<[f32; 3]> = (0..600_u16)
                .map(|i| [i, i * 7, i * 31].map(|v| f32::from(v % count).sqrt()))
                .collect();
            let raster = Raster::new(30, 20, pixels.clone());
            assert_eq!(matches!(raster.pixels, Pixels::Bytes { .. }), fits);
            for (i, expected) in (0..600).zip(&pixels) {
                let found = raster.pixel(i % 30, i / 30, [Wrap::Clamp; 2]);
                assert_eq!(found.to_array(), *expected);
            }
        }
    }
}
