//! The sheet of a scene: by everybody at equal time, a detail above and the whole picture below.

use std::path::Path;

use specula_bsdf::Rgb;
use specula_render::picture::{Display, write_rgb8};

use super::block::Block;
use super::outcome::{Outcome, Row};
use crate::Result;

/// Side of a panel, in pixels: eight columns of two stay below 600 kB, however noisy.
const SIDE: usize = 112;

/// Whether a row has a column: those without shared paths look as the defaults do, but for their amount of noise.
pub(crate) fn shows(row: &Row) -> bool {
    row.block != Some(Block::Alone)
}

/// Writes the columns, that of the reference first.
pub(crate) fn write(outcome: &Outcome, path: &Path) -> Result<()> {
    let Some(reference) = outcome.references.first() else {
        return Ok(());
    };
    let shown = outcome.rows.iter().zip(&outcome.first);
    let shown = shown.filter(|(row, _)| shows(row)).map(|(_, first)| first);
    let columns: Vec<_> = std::iter::once(&reference.picture).chain(shown).collect();
    let bytes = sheet(&columns, reference.width, outcome.scene.detail);
    let [width, height] = [columns.len() * SIDE, 2 * SIDE].map(u32::try_from);
    Ok(write_rgb8(path, width?, height?, &bytes)?)
}

/// The pixels of all columns, row by row.
fn sheet(columns: &[&Vec<Rgb<f32>>], width: usize, detail: Option<[usize; 2]>) -> Vec<u8> {
    let details: Vec<_> = columns.iter().map(|p| crop(p, width, detail)).collect();
    let wholes: Vec<_> = columns.iter().map(|p| shrink(p, width)).collect();
    let display = Display::default();
    let mut bytes = Vec::with_capacity(3 * 2 * SIDE * SIDE * columns.len());
    for panels in [details, wholes] {
        for y in 0..SIDE {
            for panel in &panels {
                let line = &panel[y * SIDE..(y + 1) * SIDE];
                bytes.extend(line.iter().flat_map(|&c| display.to_rgb8(c)));
            }
        }
    }
    bytes
}

/// A square of [`SIDE`] pixels from `[x, y]` on, or from the middle; black beyond the picture.
fn crop(picture: &[Rgb<f32>], width: usize, from: Option<[usize; 2]>) -> Vec<Rgb<f32>> {
    let size = [width, picture.len() / width];
    let [left, top] = from.unwrap_or(size.map(|s| s.saturating_sub(SIDE) / 2));
    let pixel = |i: usize| {
        let [x, y] = [left + i % SIDE, top + i / SIDE];
        let inside = x < size[0] && y < size[1];
        inside.then(|| picture[y * width + x])
    };
    (0..SIDE * SIDE)
        .map(|i| pixel(i).unwrap_or(Rgb::splat(0.0)))
        .collect()
}

/// A picture as large as fits, by means of what falls into each pixel of [`SIDE`], clamped before, as a screen does;
/// black around it.
fn shrink(picture: &[Rgb<f32>], width: usize) -> Vec<Rgb<f32>> {
    let size = [width, picture.len() / width];
    let longer = size[0].max(size[1]);
    // What falls into the `i`-th pixel along an axis; at least one, so that small pictures are magnified.
    let range = |i: usize, side: usize| {
        let before = (longer - side) / 2;
        let from = i * longer / SIDE;
        let until = ((i + 1) * longer / SIDE).max(from + 1);
        from.max(before) - before..until.clamp(before, before + side) - before
    };
    let pixel = |x: usize, y: usize| {
        let (mut sum, mut count) = ([0.0; 3], 0.0_f32);
        for row in range(y, size[1]) {
            for column in range(x, size[0]) {
                let colour = picture[row * width + column].to_array();
                (0..3).for_each(|c| sum[c] += colour[c].min(1.0));
                count += 1.0;
            }
        }
        let [r, g, b] = sum.map(|s: f32| s / count.max(1.0));
        Rgb { r, g, b }
    };
    (0..SIDE * SIDE)
        .map(|i| pixel(i % SIDE, i / SIDE))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panels_are_cut_and_shrunk_where_they_should_be() {
        let width = 2 * SIDE;
        let picture: Vec<_> = (0..width * width)
            .map(|i| Rgb::splat(if i % width < SIDE { 0.0 } else { 1.0 }))
            .collect();
        let cut = crop(&picture, width, Some([SIDE - 1, 3]));
        assert_eq!((cut[0].r, cut[1].r, cut.len()), (0.0, 1.0, SIDE * SIDE));
        let small = shrink(&picture, width);
        assert_eq!((small[SIDE / 2 - 1].r, small[SIDE / 2].r), (0.0, 1.0));
    }

    #[test]
    fn pictures_of_any_shape_fit() {
        for [width, height] in [[1, 1], [3, 40], [640, 360], [100, 1000], [112, 111]] {
            let picture = vec![Rgb::splat(1.0_f32); width * height];
            let small = shrink(&picture, width);
            let white = small.iter().filter(|c| c.r == 1.0).count();
            assert_eq!(small[SIDE * SIDE / 2 + SIDE / 2].r, 1.0);
            let share = width.min(height) as f32 / width.max(height) as f32;
            let rows = white as f32 / SIDE as f32;
            assert!(
                (rows - share * SIDE as f32).abs() <= 2.0,
                "{width} x {height}: {rows}"
            );
            let cut = crop(&picture, width, None);
            let inside = cut.iter().filter(|c| c.r == 1.0).count();
            assert_eq!(inside, width.min(SIDE) * height.min(SIDE));
        }
    }

    #[test]
    fn details_are_above_whole_pictures() {
        // White but for the right half, of which the detail is.
        let width = 4 * SIDE;
        let half: Vec<_> = (0..width * width)
            .map(|i| Rgb::splat(if i % width < width / 2 { 1.0 } else { 0.0 }))
            .collect();
        let white = vec![Rgb::splat(1.0); width * width];
        let bytes = sheet(&[&white, &half], width, Some([width / 2, 0]));
        assert_eq!(bytes.len(), 3 * 2 * SIDE * 2 * SIDE);
        let green = |x: usize, y: usize| bytes[3 * (y * 2 * SIDE + x) + 1];
        let rows = [SIDE - 1, SIDE].map(|y| [0, SIDE, 2 * SIDE - 1].map(|x| green(x, y)));
        assert_eq!(rows, [[255, 0, 0], [255, 255, 0]]);
    }
}
