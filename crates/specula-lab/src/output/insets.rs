//! Parts of pictures, enlarged, in one picture beneath the whole.

use specula_bsdf::Rgb;
use specula_render::picture::{Display, Picture};

/// A part of a picture that is shown enlarged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Inset {
    /// First column.
    pub x: u32,
    /// First row.
    pub y: u32,
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

/// Frames of insets, in their order: distinct in greyscale too.
const FRAMES: [[u8; 3]; 4] = [[230, 159, 0], [0, 114, 178], [240, 228, 66], [0, 158, 115]];
/// Pixels between pictures.
const GAP: usize = 4;
/// Pixels of a frame.
const FRAME: usize = 2;

/// Pixels of a picture in eight bits, rows from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sheet {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Red, green, blue.
    pub pixels: Vec<[u8; 3]>,
}

impl Sheet {
    /// All of one colour.
    #[must_use]
    pub fn new(width: usize, height: usize, colour: [u8; 3]) -> Self {
        Self {
            width,
            height,
            pixels: vec![colour; width * height],
        }
    }

    /// A picture as a screen shows it.
    #[must_use]
    pub fn of(picture: &Picture, display: Display) -> Self {
        Self {
            width: picture.width as usize,
            height: picture.height as usize,
            pixels: picture
                .colour
                .iter()
                .map(|&c: &Rgb<f32>| display.to_rgb8(c))
                .collect(),
        }
    }

    /// The bytes that a writer of PNG files takes.
    #[must_use]
    pub fn bytes(&self) -> Vec<u8> {
        self.pixels.concat()
    }

    /// Copies `other` into this one with its first pixel at column `x` and row `y`; what lies beyond is
    /// cut off.
    pub fn put(&mut self, other: &Self, x: usize, y: usize) {
        let width = other.width.min(self.width.saturating_sub(x));
        for row in 0..other.height.min(self.height.saturating_sub(y)) {
            let to = (y + row) * self.width + x;
            let from = row * other.width;
            self.pixels[to..to + width].copy_from_slice(&other.pixels[from..from + width]);
        }
    }

    /// The part `inset`, each pixel as `factor` x `factor`.
    fn enlarged(&self, inset: Inset, factor: usize) -> Self {
        let [w, h] = [inset.width, inset.height].map(|n| n as usize);
        let mut part = Self::new(w * factor, h * factor, [0; 3]);
        for (i, pixel) in part.pixels.iter_mut().enumerate() {
            let x = inset.x as usize + (i % (w * factor)) / factor;
            let y = inset.y as usize + (i / (w * factor)) / factor;
            if x < self.width && y < self.height {
                *pixel = self.pixels[y * self.width + x];
            }
        }
        part
    }

    /// A frame of `colour` just inside the rectangle at `x`, `y`.
    fn frame(&mut self, [x, y, width, height]: [usize; 4], colour: [u8; 3]) {
        for row in y..(y + height).min(self.height) {
            for column in x..(x + width).min(self.width) {
                let inside = (x + FRAME..x + width - FRAME.min(width)).contains(&column)
                    && (y + FRAME..y + height - FRAME.min(height)).contains(&row);
                if !inside {
                    self.pixels[row * self.width + column] = colour;
                }
            }
        }
    }
}

/// The picture with its insets framed, and under it the insets side by side, as wide together as the
/// picture.
#[must_use]
pub fn with_insets(picture: &Sheet, insets: &[Inset]) -> Sheet {
    let Some(widest) = insets.iter().map(|i| i.width as usize).max() else {
        return picture.clone();
    };
    let share = (picture.width + GAP) / insets.len();
    let factor = ((share.saturating_sub(GAP)) / widest.max(1)).max(1);
    let tallest = insets.iter().map(|i| i.height as usize).max().unwrap_or(0);
    let mut sheet = Sheet::new(
        picture.width,
        picture.height + GAP + tallest * factor,
        [255; 3],
    );
    sheet.put(picture, 0, 0);
    for (i, &inset) in insets.iter().enumerate() {
        let colour = FRAMES[i % FRAMES.len()];
        let [x, y, w, h] = [inset.x, inset.y, inset.width, inset.height].map(|n| n as usize);
        sheet.frame(
            [
                x.saturating_sub(FRAME),
                y.saturating_sub(FRAME),
                w + 2 * FRAME,
                h + 2 * FRAME,
            ],
            colour,
        );
        let part = picture.enlarged(inset, factor);
        let (left, top) = (i * share, picture.height + GAP);
        sheet.put(&part, left, top);
        sheet.frame([left, top, part.width, part.height], colour);
    }
    sheet
}

/// Sheets side by side.
#[must_use]
pub fn row(sheets: &[Sheet]) -> Sheet {
    let width = sheets.iter().map(|s| s.width + GAP).sum::<usize>().max(GAP) - GAP;
    let height = sheets.iter().map(|s| s.height).max().unwrap_or(0);
    let mut all = Sheet::new(width, height, [255; 3]);
    let mut x = 0;
    for sheet in sheets {
        all.put(sheet, x, 0);
        x += sheet.width + GAP;
    }
    all
}

/// Sheets under each other.
#[must_use]
pub fn column(sheets: &[Sheet]) -> Sheet {
    let height = sheets
        .iter()
        .map(|s| s.height + GAP)
        .sum::<usize>()
        .max(GAP)
        - GAP;
    let width = sheets.iter().map(|s| s.width).max().unwrap_or(0);
    let mut all = Sheet::new(width, height, [255; 3]);
    let mut y = 0;
    for sheet in sheets {
        all.put(sheet, 0, y);
        y += sheet.height + GAP;
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn insets_show_their_part() {
        let mut picture = Sheet::new(64, 32, [10; 3]);
        picture.pixels[5 * 64 + 7] = [200; 3];
        let inset = Inset {
            x: 4,
            y: 4,
            width: 8,
            height: 8,
        };
        let sheet = with_insets(&picture, &[inset]);
        let factor = 64 / 8;
        assert_eq!(sheet.height, 32 + GAP + 8 * factor);
        let (x, y) = (3 * factor + 1, 32 + GAP + factor + 1);
        assert_eq!(sheet.pixels[y * 64 + x], [200; 3]);
        assert_eq!(sheet.pixels[3 * 64 + 3], FRAMES[0]);
        assert_eq!(sheet.pixels[5 * 64 + 7], [200; 3]);
        // Nothing beyond the edges is touched, wherever the inset lies.
        let corner = Inset {
            x: 60,
            y: 30,
            width: 8,
            height: 8,
        };
        let cut = with_insets(&picture, &[corner, inset]);
        assert_eq!(cut.width, 64);
    }
}
