//! Moments of the slopes of a normal map, as pictures that filters average.
//!
//! A normal `(x, y, z)` has the slope `p = (x, y) / z`. What a filter has to preserve of normals are the mean of their
//! slopes and of the slopes' squares and product, from which their covariance follows (Olano and Baker 2010, "LEAN
//! Mapping").
//!
//! Between pixel centres a normal map is interpolated. A pixel has the moments over all that it has a share in, weighted
//! by the share:
//!
//! ```text
//! B_i = integral phi_i p,   M_i = integral phi_i p p^T,   phi_i: bilinear interpolation's weight of pixel i
//! ```
//!
//! Departure: LEAN takes the slopes at pixel centres. Between those the interpolated normals vary less than the pixels:
//! of independent slopes 4/9 of the variance is left. With the same weights in both moments no covariance is negative.
//!
//! The integrals are those of the Gauss-Legendre rule of two points along each axis between four pixels, which is exact
//! where slopes are bilinear.

use rayon::prelude::*;
use specula_bsdf::Rgb;
use specula_scene::Pixels;
use specula_scene::scene::Wrap;

use super::Raster;
use crate::convert::narrow;

/// The slope of a normal that is at most so steep, 84 degrees off: of those on the horizon and below, 8 bits know
/// nothing.
const STEEPEST: f32 = 10.0;

/// The slope `(x, y) / z` of a normal; 0 of none.
pub(crate) fn slope_of([x, y, z]: [f32; 3]) -> [f32; 2] {
    let z = z.max((x * x + y * y).sqrt() / STEEPEST);
    if z > 0.0 { [x / z, y / z] } else { [0.0; 2] }
}

/// Where the rule of two points evaluates, in `[0, 1]`.
const GAUSS: [f32; 2] = [0.211_324_87, 0.788_675_1];

impl Raster {
    /// The moments of the slopes of a normal map, with pyramids: `(x, y, 1)`, then `(x^2, x y, y^2)`.
    ///
    /// * `wrap`: along s and t.
    /// * `normal`: the normal that a colour stands for.
    pub(in crate::texture) fn slope_moments(
        &self,
        wrap: [Wrap; 2],
        normal: impl Fn(Rgb<f32>) -> [f32; 3] + Sync,
    ) -> [Self; 2] {
        let row = 3 * self.width.unsigned_abs() as usize;
        let [mut slopes, mut squares] = [0; 2].map(|_| vec![0.0; 3 * self.pixels.len()]);
        let rows = slopes.par_chunks_mut(row.max(1));
        let rows = rows.zip(squares.par_chunks_mut(row.max(1))).enumerate();
        rows.for_each(|(y, (slopes, squares))| {
            let y = i32::try_from(y).unwrap_or(i32::MAX);
            let pixels = slopes.chunks_exact_mut(3).zip(squares.chunks_exact_mut(3));
            for (x, (slope, square)) in (0..).zip(pixels) {
                let [first, second] = self.moments_of_pixel([x, y], wrap, &normal);
                slope.copy_from_slice(&first);
                square.copy_from_slice(&second);
            }
        });
        [slopes, squares].map(|values| {
            Self {
                width: self.width,
                height: self.height,
                pixels: Pixels::floats(values, true),
                smaller: Vec::new(),
            }
            .with_pyramid()
        })
    }

    fn moments_of_pixel(
        &self,
        [x, y]: [i32; 2],
        wrap: [Wrap; 2],
        normal: impl Fn(Rgb<f32>) -> [f32; 3],
    ) -> [[f32; 3]; 2] {
        let around = [-1, 0, 1].map(|dy| {
            [-1, 0, 1].map(|dx| self.pixel(x.saturating_add(dx), y.saturating_add(dy), wrap))
        });
        // Along an axis: the first of two neighbours, where between them, and the share of this pixel.
        let axis = [0, 1].map(|first: usize| {
            GAUSS.map(|at| (first, at, if first == 0 { at } else { 1.0 - at }))
        });
        let points = || axis.iter().flatten();
        let mut sums = [[0.0_f64; 3]; 2];
        for &(row, v, of_row) in points() {
            for &(column, u, of_column) in points() {
                let [above, below] = [row, row + 1].map(|r| {
                    let [left, right] = [around[r][column], around[r][column + 1]];
                    left * (1.0 - u) + right * u
                });
                let slope = slope_of(normal(above * (1.0 - v) + below * v));
                let [p, q] = slope.map(f64::from);
                let weight = 0.25 * f64::from(of_row) * f64::from(of_column);
                for (sum, of_slope) in sums.iter_mut().zip([[p, q, 1.0], [p * p, p * q, q * q]]) {
                    for (sum, v) in sum.iter_mut().zip(of_slope) {
                        *sum += weight * v;
                    }
                }
            }
        }
        sums.map(|sum| sum.map(narrow))
    }
}

#[cfg(test)]
mod tests;
