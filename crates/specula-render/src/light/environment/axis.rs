//! Cells between the centres of a picture's pixels, along one axis.

use crate::convert::{floor_i32, id};
use crate::words::Words;

/// How the cells lie along one axis of a picture.
#[derive(Clone, Copy, Debug)]
pub(super) enum AxisKind {
    /// As many cells as pixels: the last reaches over the edge.
    Wrapped,
    /// One more: the first and the last are halves.
    Clamped,
    /// One less: the outer centres lie on the edges.
    Between,
}

/// The cells along one axis, as plain values: loops over batches have no branches.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axis {
    pub(super) cells: u32,
    /// Whole cells that fit along the axis.
    pub(super) steps: f32,
    /// Where the first cell begins, in cells.
    begin: f32,
    /// Where in the first cell the picture begins, and where in the last it ends.
    ends: [f32; 2],
    /// The pixel at the first cell's beginning; the next is at its end.
    first_pixel: i32,
}

impl Axis {
    pub(super) fn new(kind: AxisKind, pixels: usize) -> Self {
        let pixels = id(pixels);
        let (cells, steps, begin, ends, first_pixel) = match kind {
            AxisKind::Wrapped => (pixels, pixels, 0.5, [0.0, 1.0], 0),
            AxisKind::Clamped => (pixels + 1, pixels, -0.5, [0.5, 0.5], -1),
            AxisKind::Between => {
                let between = (pixels - 1).max(1);
                (between, between, 0.0, [0.0, 1.0], 0)
            }
        };
        Self {
            cells,
            steps: steps as f32,
            begin,
            ends,
            first_pixel,
        }
    }

    /// The pixel at the beginning of a cell; a last one is at the end of the last cell.
    pub(super) fn pixel(&self, cell: u32) -> i32 {
        cell.cast_signed() + self.first_pixel
    }

    /// Five words for shaders.
    pub(super) fn flatten(&self, to: &mut Words) {
        to.id(self.cells);
        to.floats([self.steps, self.begin, self.ends[0], self.ends[1]]);
    }

    /// The part of a cell that lies within the picture.
    #[inline(always)]
    pub(super) fn range(&self, cell: u32) -> [f32; 2] {
        let first = if cell == 0 { self.ends[0] } else { 0.0 };
        let last = if cell + 1 == self.cells {
            self.ends[1]
        } else {
            1.0
        };
        [first, last]
    }

    /// The coordinate, in `[0, 1]`, of a point in a cell.
    #[inline(always)]
    pub(super) fn place(&self, cell: u32, within: f32) -> f32 {
        let at = cell as f32 + within + self.begin;
        (if at > self.steps { at - self.steps } else { at }) / self.steps
    }

    /// The cell of a coordinate, and where in it that lies.
    #[inline(always)]
    pub(super) fn cell_of(&self, coordinate: f32) -> (u32, f32) {
        let at = coordinate * self.steps - self.begin;
        let at = if at < 0.0 { at + self.steps } else { at };
        let cell = floor_i32(at).clamp(0, self.cells.cast_signed() - 1);
        (cell.cast_unsigned(), at - cell as f32)
    }
}
