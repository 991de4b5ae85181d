//! The sheet of a scene: the whole picture, then one detail by everybody at equal time.

use std::path::Path;

use specula_bsdf::Rgb;
use specula_render::picture::{Display, write_rgb8};

use super::measure::Outcome;
use crate::Result;

/// Side of a panel, in pixels: seven of them stay below 300 kB, however noisy.
const SIDE: usize = 112;

/// Writes the reference shrunk, its detail, and the detail as each renders it.
pub(crate) fn write(outcome: &Outcome, path: &Path) -> Result<()> {
    let Some([reference, _]) = outcome.pictures.first() else {
        return Ok(());
    };
    let detail = |picture: &[Rgb<f32>]| crop(picture, outcome.width, outcome.scene.detail);
    let mut panels = vec![shrink(reference, outcome.width), detail(reference)];
    panels.extend(outcome.pictures.iter().map(|[_, first]| detail(first)));
    let display = Display::default();
    let mut bytes = Vec::with_capacity(3 * SIDE * SIDE * panels.len());
    for y in 0..SIDE {
        for panel in &panels {
            let row = &panel[y * SIDE..(y + 1) * SIDE];
            bytes.extend(row.iter().flat_map(|&c| display.to_rgb8(c)));
        }
    }
    let width = u32::try_from(panels.len() * SIDE)?;
    Ok(write_rgb8(path, width, u32::try_from(SIDE)?, &bytes)?)
}

/// A square of [`SIDE`] pixels from `[x, y]` on.
fn crop(picture: &[Rgb<f32>], width: usize, [x, y]: [usize; 2]) -> Vec<Rgb<f32>> {
    let rows = (y..y + SIDE).map(|row| &picture[row * width + x..row * width + x + SIDE]);
    rows.flatten().copied().collect()
}

/// A square picture by means of what falls into each pixel of [`SIDE`].
fn shrink(picture: &[Rgb<f32>], width: usize) -> Vec<Rgb<f32>> {
    let edge = |i: usize| i * width / SIDE;
    let pixel = |x: usize, y: usize| {
        let (mut sum, mut count) = ([0.0; 3], 0.0);
        for row in edge(y)..edge(y + 1).max(edge(y) + 1) {
            for column in edge(x)..edge(x + 1).max(edge(x) + 1) {
                let colour = picture[row * width + column].to_array();
                (0..3).for_each(|c| sum[c] += colour[c].min(1.0));
                count += 1.0;
            }
        }
        let [r, g, b] = sum.map(|s: f32| s / count);
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
        let cut = crop(&picture, width, [SIDE - 1, 3]);
        assert_eq!((cut[0].r, cut[1].r, cut.len()), (0.0, 1.0, SIDE * SIDE));
        let small = shrink(&picture, width);
        assert_eq!((small[SIDE / 2 - 1].r, small[SIDE / 2].r), (0.0, 1.0));
    }
}
