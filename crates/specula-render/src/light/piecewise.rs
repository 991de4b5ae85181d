//! A distribution over the unit square, constant in every cell of a grid.

use rayon::prelude::*;

use crate::convert::{floor_index, id, narrow};
use crate::huge_pages;
use crate::soa::{Column, Floats};
use crate::words::Words;

/// A piecewise constant density over `[0, 1)^2`.
#[derive(Clone, Debug)]
pub(super) struct Piecewise {
    width: usize,
    height: usize,
    /// Rows of `width + 1` cumulated shares.
    rows: Vec<f32>,
    /// Cumulated shares of the rows, `height + 1`.
    columns: Vec<f32>,
    /// Mean of the weights.
    pub(super) mean: f64,
}

impl Piecewise {
    /// * `weight`: of the cell in column x and row y; finite, not negative. All zero: uniform.
    pub(super) fn new(
        [width, height]: [usize; 2],
        weight: impl Fn(usize, usize) -> f64 + Sync,
    ) -> Self {
        let mut rows = vec![0.0; (width + 1) * height];
        huge_pages::advise(&rows);
        let mut columns = vec![0.0; height + 1];
        let row = |weights: &mut Vec<f64>, (y, row): (usize, &mut [f32])| {
            for (x, w) in weights.iter_mut().enumerate() {
                *w = weight(x, y);
            }
            cumulate(weights, row);
            weights.iter().sum::<f64>()
        };
        let sums: Vec<f64> = (rows.par_chunks_mut(width + 1).enumerate())
            .map_init(|| vec![0.0_f64; width], row)
            .collect();
        cumulate(&sums, &mut columns);
        Self {
            width,
            height,
            rows,
            columns,
            mean: sums.iter().sum::<f64>() / (width * height) as f64,
        }
    }

    /// Its mean, without a table.
    ///
    /// * `weight`: as of [`Piecewise::new`].
    pub(super) fn mean_of(
        [width, height]: [usize; 2],
        weight: impl Fn(usize, usize) -> f64 + Sync,
    ) -> f64 {
        let row = |y: usize| (0..width).map(|x| weight(x, y)).sum::<f64>();
        let sums: Vec<f64> = (0..height).into_par_iter().map(row).collect();
        sums.iter().sum::<f64>() / (width * height) as f64
    }

    /// Density at a point, per area of the square.
    #[inline]
    pub(super) fn density(&self, [u, v]: [f32; 2]) -> f32 {
        let x = floor_index(u * self.width as f32).min(self.width - 1);
        let y = floor_index(v * self.height as f32).min(self.height - 1);
        self.share([x, y]) * self.width as f32 * self.height as f32
    }

    /// A point sampled with that density.
    ///
    /// * `u`: uniform in `[0, 1)^2`.
    #[inline]
    pub(super) fn sample(&self, u: [f32; 2]) -> [f32; 2] {
        let ([x, y], [s, t]) = self.sample_cell(u);
        [
            (x as f32 + s) / self.width as f32,
            (y as f32 + t) / self.height as f32,
        ]
    }

    /// A cell sampled by its weight, and where in it the point lies, uniform in `[0, 1)^2`.
    ///
    /// * `u`: uniform in `[0, 1)^2`.
    #[inline]
    pub(super) fn sample_cell(&self, u: [f32; 2]) -> ([usize; 2], [f32; 2]) {
        let (y, t) = invert(&self.columns, u[1]);
        let row = &self.rows[y * (self.width + 1)..(y + 1) * (self.width + 1)];
        let (x, s) = invert(row, u[0]);
        ([x, y], [s, t])
    }

    /// [`Piecewise::sample_cell`] for each of the first `n` batches.
    ///
    /// * `u`: random numbers to sample by; then where in its cell each point lies.
    #[inline(always)]
    pub(super) fn sample_cells<const N: usize>(
        &self,
        n: usize,
        u: &mut [Floats<N>; 2],
        cells: &mut [Column<u32, N>; 2],
    ) {
        let n = n.min(N);
        let stride = id(self.width + 1);
        let mut from = [0; N];
        invert_all(
            n,
            &self.columns,
            id(self.height),
            &from,
            &mut u[1],
            &mut cells[1],
        );
        for i in 0..n {
            from[i] = cells[1][i] * stride;
        }
        invert_all(
            n,
            &self.rows,
            id(self.width),
            &from,
            &mut u[0],
            &mut cells[0],
        );
    }

    /// Places of the cumulated shares in the rows, and of those of the rows, for shaders.
    pub(super) fn flatten(&self, to: &mut Words) -> [u32; 2] {
        [&self.rows, &self.columns].map(|shares| {
            let offset = to.offset();
            to.floats(shares.iter().copied());
            offset
        })
    }

    /// Cells in a row.
    pub(super) fn width(&self) -> u32 {
        id(self.width)
    }

    /// Probability of a cell.
    #[inline]
    pub(super) fn share(&self, [x, y]: [usize; 2]) -> f32 {
        let row = y * (self.width + 1) + x;
        (self.rows[row + 1] - self.rows[row]) * (self.columns[y + 1] - self.columns[y])
    }
}

/// The cumulated shares of `weights`, from 0 to 1; equal shares where all are zero.
///
/// * `to`: one more than weights.
fn cumulate(weights: &[f64], to: &mut [f32]) {
    let sum: f64 = weights.iter().sum();
    let mut run = 0.0;
    to.fill(1.0);
    for (i, (w, share)) in weights.iter().zip(to).enumerate() {
        *share = narrow(if sum > 0.0 {
            run / sum
        } else {
            i as f64 / weights.len() as f64
        });
        run += w;
    }
}

/// The cell in which `u` falls, and where within it, in `[0, 1)`.
fn invert(cdf: &[f32], u: f32) -> (usize, f32) {
    let (mut cell, mut size) = (0, cdf.len() - 1);
    while size > 1 {
        let half = size / 2;
        cell += if cdf[cell + half] <= u { half } else { 0 };
        size -= half;
    }
    (cell, within(cdf[cell], cdf[cell + 1], u))
}

/// Where `u` lies between two cumulated shares, in `[0, 1)`.
#[inline(always)]
fn within(from: f32, to: f32, u: f32) -> f32 {
    let width = to - from;
    let at = if width > 0.0 { (u - from) / width } else { 0.5 };
    let below_one = 1.0 - f32::EPSILON;
    let at = if at > 0.0 { at } else { 0.0 };
    if at < below_one { at } else { below_one }
}

/// [`invert`] in many distributions of `size` cells, level by level.
///
/// * `from`: where in `cdf` each begins.
#[inline(always)]
fn invert_all<const N: usize>(
    n: usize,
    cdf: &[f32],
    mut size: u32,
    from: &[u32; N],
    u: &mut [f32; N],
    cells: &mut [u32; N],
) {
    let share = |at: u32| cdf.get(at as usize).copied().unwrap_or(0.0);
    cells.fill(0);
    while size > 1 {
        let half = size / 2;
        for i in 0..n {
            let low = share(from[i] + cells[i] + half) <= u[i];
            cells[i] += if low { half } else { 0 };
        }
        size -= half;
    }
    for i in 0..n {
        let at = from[i] + cells[i];
        u[i] = within(share(at), share(at + 1), u[i]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Searches of batches and single ones, where cells are empty, and at the very shares.
    #[test]
    fn batches_find_the_cells_of_single_searches() {
        const N: usize = 64;
        for [width, height] in [
            [1, 1],
            [2, 40],
            [15, 3],
            [16, 16],
            [17, 2],
            [33, 5],
            [300, 70],
        ] {
            let weight = |x: usize, y: usize| match (x * 7 + y * 3) % 5 {
                0 | 3 => 0.0,
                k => (k * k) as f64 + (x as f64 * 0.37).sin().abs(),
            };
            let table = Piecewise::new([width, height], weight);
            assert_eq!(Piecewise::mean_of([width, height], weight), table.mean);
            let mut state = 1_u32;
            for round in 0..40 {
                let shares = if round % 2 == 0 {
                    &table.columns
                } else {
                    &table.rows
                };
                let mut number = |i: usize, every: usize| {
                    state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
                    match i % every {
                        0 => shares[state as usize % shares.len()].min(1.0 - f32::EPSILON),
                        _ => (state >> 8) as f32 / (1 << 24) as f32,
                    }
                };
                let before: [[f32; N]; 2] =
                    [3, 4].map(|every| std::array::from_fn(|i| number(i, every)));
                let mut u = [Floats::<N>::of(0.0); 2];
                let mut cells = [Column::<u32, N>::of(0); 2];
                u[0].copy_from_slice(&before[0]);
                u[1].copy_from_slice(&before[1]);
                table.sample_cells(N, &mut u, &mut cells);
                for i in 0..N {
                    let (cell, within) = table.sample_cell([before[0][i], before[1][i]]);
                    assert_eq!([cells[0][i], cells[1][i]], cell.map(id), "{width} {height}");
                    assert_eq!([u[0][i], u[1][i]], within);
                }
            }
        }
    }
}
