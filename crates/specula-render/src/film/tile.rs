//! Tiles of the film: squares of pixels, the units of work.

use core::ops::{Deref, DerefMut};

use rayon::prelude::*;

use super::buffer::PixelSums;
use crate::huge_pages;

/// Side of a tile in pixels.
pub(crate) const TILE: u32 = 16;

/// A square of pixels, the unit of work.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tile {
    /// Pixels `[x0, x1, y0, y1]` of the whole picture.
    pub(crate) bounds: [u32; 4],
    pub(crate) pixels: TilePixels,
    /// Samples that were not finite.
    pub(crate) invalid: u64,
    /// Rays that its samples took.
    pub(crate) rays: u64,
    /// Samples of each pixel that adaptive sampling has allotted; 0 in other films.
    pub(crate) target: u32,
}

/// What a tile takes, however many pixels it has.
pub(crate) const BYTES_PER_TILE: u64 = size_of::<Tile>() as u64;

/// The pixels of a tile, row by row: the first ones of a whole square, so that all tiles lie in one piece of memory.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TilePixels {
    sums: [PixelSums; (TILE * TILE) as usize],
    count: usize,
}

impl Deref for TilePixels {
    type Target = [PixelSums];

    #[inline(always)]
    fn deref(&self) -> &[PixelSums] {
        &self.sums[..self.count]
    }
}

impl DerefMut for TilePixels {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [PixelSums] {
        &mut self.sums[..self.count]
    }
}

/// Bounds of the tiles of a crop, row by row.
pub(super) fn bounds_of([x0, x1, y0, y1]: [u32; 4]) -> impl Iterator<Item = [u32; 4]> {
    let row = move |y: u32| {
        let bounds = move |x: u32| [x, (x + TILE).min(x1), y, (y + TILE).min(y1)];
        (x0..x1).step_by(TILE as usize).map(bounds)
    };
    (y0..y1).step_by(TILE as usize).flat_map(row)
}

/// How many pixels are within bounds.
pub(super) fn area([x0, x1, y0, y1]: [u32; 4]) -> usize {
    (x1 - x0) as usize * (y1 - y0) as usize
}

/// The tiles of a crop without any sample.
pub(super) fn empty_tiles(crop: [u32; 4]) -> Vec<Tile> {
    let tile = |bounds: [u32; 4]| Tile {
        bounds,
        pixels: TilePixels {
            sums: [PixelSums::default(); (TILE * TILE) as usize],
            count: area(bounds),
        },
        invalid: 0,
        rays: 0,
        target: 0,
    };
    let bounds: Vec<[u32; 4]> = bounds_of(crop).collect();
    let mut tiles = Vec::with_capacity(bounds.len());
    huge_pages::advise(&tiles);
    // By all threads: the system clears every page.
    bounds
        .into_par_iter()
        .map(tile)
        .collect_into_vec(&mut tiles);
    tiles
}
