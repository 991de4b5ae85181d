//! Piecewise bilinear functions on the unit square that depend on the view, and warps by them.
//!
//! A table holds one slice per pair of a view's azimuth and polar angle. Between views, slices are
//! interpolated linearly. A warp's slices are densities, each of integral 1, with their running integrals:
//! interpolated densities then have the interpolated integrals.
//!
//! ```text
//! p(x, y)                  bilinear within the cells of the grid
//! C(x, y) = int_0^x p(t, y) dt      along the rows
//! M(y)    = int_0^y C(1, t) dt
//! ```
//!
//! A sample solves `M(y) = u_y`, then `C(x, y) = u_x C(1, y)`: quadratic equations within a cell.
//!
//! Source: Dupuy and Jakob 2018, section 5 and the data's loader.

use alloc::vec::Vec;

use crate::math::Real;

/// Four slices and their weights, which sum to 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slices<T> {
    slices: [usize; 4],
    weights: [T; 4],
}

impl<T: Real> Slices<T> {
    /// Those about a view.
    ///
    /// * `phi_i`, `theta_i`: the tables' views, ascending; views beyond them take the nearest.
    pub(super) fn new(phi_i: &[T], theta_i: &[T], phi: T, theta: T) -> Self {
        let (i, s) = between(phi_i, phi);
        let (j, t) = between(theta_i, theta);
        let next = |i: usize, all: &[T]| (i + 1).min(all.len() - 1);
        let at = |i: usize, j: usize| i * theta_i.len() + j;
        let (k, l) = (next(i, phi_i), next(j, theta_i));
        let (r, v) = (T::ONE - s, T::ONE - t);
        Self {
            slices: [at(i, j), at(i, l), at(k, j), at(k, l)],
            weights: [r * v, r * t, s * v, s * t],
        }
    }

    /// One slice alone.
    pub(super) fn only(slice: usize) -> Self {
        Self {
            slices: [slice; 4],
            weights: [T::ONE, T::ZERO, T::ZERO, T::ZERO],
        }
    }

    /// The interpolated value.
    ///
    /// * `size`: of a slice.
    /// * `place`: within the slice.
    #[inline]
    pub(super) fn value(&self, data: &[T], size: usize, place: usize) -> T {
        let mut sum = T::ZERO;
        for (slice, weight) in self.slices.iter().zip(self.weights) {
            sum += data[slice * size + place] * weight;
        }
        sum
    }
}

/// The interval of ascending knots that `x` lies in, and the place within it in `[0, 1]`.
fn between<T: Real>(knots: &[T], x: T) -> (usize, T) {
    if knots.len() < 2 {
        return (0, T::ZERO);
    }
    let i = last_at_most(knots.len() - 1, x, |i| knots[i]);
    let t = (x - knots[i]) / (knots[i + 1] - knots[i]);
    (i, t.within(T::ZERO, T::ONE))
}

/// The last index below `count` whose value is at most `x`; 0 where there is none.
fn last_at_most<T: Real>(count: usize, x: T, value: impl Fn(usize) -> T) -> usize {
    let (mut low, mut high) = (0, count);
    while high - low > 1 {
        let middle = low.midpoint(high);
        if value(middle) <= x {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// The cell of a coordinate in `[0, 1]` among `nodes`, and the place within it.
fn cell<T: Real>(x: T, nodes: usize) -> (usize, T) {
    let place = x.within(T::ZERO, T::ONE) * count(nodes - 1);
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to the axis above; NaN becomes 0"
    )]
    let i = (place.to_f64() as usize).min(nodes - 2);
    (i, place - count(i))
}

/// A count as a scalar.
#[allow(
    clippy::cast_precision_loss,
    reason = "sizes of grids are far below 2^53"
)]
pub(super) fn count<T: Real>(n: usize) -> T {
    T::of(n as f64)
}

fn lerp<T: Real>(a: T, b: T, t: T) -> T {
    a * (T::ONE - t) + b * t
}

/// Where in `[0, 1]` the integral of the density from `a` to `b` reaches `area`.
///
/// ```text
/// a t + (b - a) t^2 / 2 = area,   t = 2 area / (a + sqrt(a^2 + 2 (b - a) area))
/// ```
fn within_cell<T: Real>(area: T, a: T, b: T) -> T {
    let root = (a * a + T::TWO * (b - a) * area).at_least(T::ZERO).sqrt();
    (T::TWO * area / (a + root).at_least(T::TINY)).within(T::ZERO, T::ONE)
}

/// Integral from 0 to `t` of the density from `a` to `b`.
fn area<T: Real>(t: T, a: T, b: T) -> T {
    t * (a + (b - a) * t * T::HALF)
}

/// A bilinear function on the unit square.
#[derive(Clone, Debug)]
pub(super) struct Grid<T> {
    /// Nodes along x and y, at least 2 each.
    size: [usize; 2],
    /// Rows of x.
    values: Vec<T>,
}

impl<T: Real> Grid<T> {
    pub(super) fn new(size: [usize; 2], values: &[f32]) -> Self {
        let values = values.iter().map(|&v| T::of(v.into())).collect();
        Self { size, values }
    }

    pub(super) fn count(&self) -> usize {
        self.values.len()
    }

    pub(super) fn size(&self) -> [usize; 2] {
        self.size
    }

    pub(super) fn values(&self) -> &[T] {
        &self.values
    }

    /// The value at a point; beyond the square the nearest one.
    pub(super) fn eval(&self, [x, y]: [T; 2]) -> T {
        let [w, h] = self.size;
        let ((j, s), (i, t)) = (cell(x, w), cell(y, h));
        let row = |i: usize| lerp(self.values[i * w + j], self.values[i * w + j + 1], s);
        lerp(row(i), row(i + 1), t)
    }
}

/// A bilinear colour on the unit square for every slice.
#[derive(Clone, Debug)]
pub(super) struct Colours<T> {
    size: [usize; 2],
    /// Slices of red, green, blue.
    values: Vec<T>,
}

impl<T: Real> Colours<T> {
    /// * `values`: slices of three channels of rows.
    pub(super) fn new(size: [usize; 2], values: &[f32]) -> Self {
        let values = values.iter().map(|&v| T::of(v.into())).collect();
        Self { size, values }
    }

    pub(super) fn count(&self) -> usize {
        self.values.len()
    }

    pub(super) fn size(&self) -> [usize; 2] {
        self.size
    }

    pub(super) fn values(&self) -> &[T] {
        &self.values
    }

    pub(super) fn eval(&self, at: &Slices<T>, [x, y]: [T; 2]) -> [T; 3] {
        let [w, h] = self.size;
        let ((j, s), (i, t)) = (cell(x, w), cell(y, h));
        let stride = 3 * w * h;
        core::array::from_fn(|channel| {
            let node = |i: usize, j: usize| {
                let place = (channel * h + i) * w + j;
                at.value(&self.values, stride, place)
            };
            let row = |i: usize| lerp(node(i, j), node(i, j + 1), s);
            lerp(row(i), row(i + 1), t)
        })
    }
}

/// Densities on the unit square, one for each slice, and the warps to them.
#[derive(Clone, Debug)]
pub(super) struct Warp<T> {
    size: [usize; 2],
    density: Vec<T>,
    /// `C` at the nodes.
    along_rows: Vec<T>,
    /// `M` at the rows.
    marginal: Vec<T>,
}

impl<T: Real> Warp<T> {
    /// Slices are scaled to integral 1. One without a value above 0 is uniform.
    ///
    /// * `values`: slices of rows; negative values count as 0.
    pub(super) fn new(size: [usize; 2], values: &[f32]) -> Self {
        let [w, h] = size;
        let mut warp = Self {
            size,
            density: Vec::with_capacity(values.len()),
            along_rows: Vec::with_capacity(values.len()),
            marginal: Vec::with_capacity(values.len() / w),
        };
        for slice in values.chunks_exact(w * h) {
            warp.push(slice);
        }
        warp
    }

    fn push(&mut self, slice: &[f32]) {
        let [w, h] = self.size;
        let of = |v: f32| f64::from(v.max(0.0));
        let (dx, dy): (f64, f64) = (1.0 / count::<f64>(w - 1), 1.0 / count::<f64>(h - 1));
        let row_total = |row: &[f32]| {
            let pairs = row.windows(2).map(|p| 0.5 * (of(p[0]) + of(p[1])));
            pairs.sum::<f64>() * dx
        };
        let totals: Vec<f64> = slice.chunks_exact(w).map(row_total).collect();
        let total = totals.windows(2).map(|p| 0.5 * (p[0] + p[1])).sum::<f64>() * dy;
        let uniform = !(total > 0.0 && total.is_finite());
        let value = |v: f32| if uniform { 1.0 } else { of(v) / total };
        let mut below = 0.0;
        let mut before = 0.0;
        for (i, row) in slice.chunks_exact(w).enumerate() {
            let mut sum = 0.0;
            let mut last = 0.0;
            for (j, &v) in row.iter().enumerate() {
                let v = value(v);
                if j > 0 {
                    sum += 0.5 * (last + v) * dx;
                }
                last = v;
                self.density.push(T::of(v));
                self.along_rows.push(T::of(sum));
            }
            if i > 0 {
                below += 0.5 * (before + sum) * dy;
            }
            before = sum;
            self.marginal.push(T::of(below));
        }
    }

    pub(super) fn count(&self) -> usize {
        self.density.len() + self.along_rows.len() + self.marginal.len()
    }

    pub(super) fn size(&self) -> [usize; 2] {
        self.size
    }

    /// Densities, integrals along rows, integrals of rows; of each all slices.
    pub(super) fn values(&self) -> [&[T]; 3] {
        [&self.density, &self.along_rows, &self.marginal]
    }

    fn slice(&self) -> usize {
        self.size[0] * self.size[1]
    }

    /// The density at a point.
    pub(super) fn pdf(&self, at: &Slices<T>, [x, y]: [T; 2]) -> T {
        let [w, h] = self.size;
        let ((j, s), (i, t)) = (cell(x, w), cell(y, h));
        let node = |i: usize, j: usize| at.value(&self.density, self.slice(), i * w + j);
        let row = |i: usize| lerp(node(i, j), node(i, j + 1), s);
        lerp(row(i), row(i + 1), t)
    }

    /// From uniform random numbers to a point, with its density.
    pub(super) fn sample(&self, at: &Slices<T>, u: [T; 2]) -> ([T; 2], T) {
        let [w, h] = self.size;
        let size = self.slice();
        let marginal = |i: usize| at.value(&self.marginal, h, i);
        let i = last_at_most(h - 1, u[1], marginal);
        let total = |i: usize| at.value(&self.along_rows, size, i * w + w - 1);
        let totals = [total(i), total(i + 1)];
        let left = (u[1] - marginal(i)) * count(h - 1);
        let t = within_cell(left, totals[0], totals[1]);

        let target = u[0] * lerp(totals[0], totals[1], t);
        let across = |data: &[T], j: usize| {
            let node = |i: usize| at.value(data, size, i * w + j);
            lerp(node(i), node(i + 1), t)
        };
        let j = last_at_most(w - 1, target, |j| across(&self.along_rows, j));
        let density = [j, j + 1].map(|j| across(&self.density, j));
        let left = (target - across(&self.along_rows, j)) * count(w - 1);
        let s = within_cell(left, density[0], density[1]);
        let point = [
            (count::<T>(j) + s) / count(w - 1),
            (count::<T>(i) + t) / count(h - 1),
        ];
        (point, lerp(density[0], density[1], s))
    }

    /// From a point to the random numbers that lead to it, with its density.
    pub(super) fn invert(&self, at: &Slices<T>, [x, y]: [T; 2]) -> ([T; 2], T) {
        let [w, h] = self.size;
        let size = self.slice();
        let ((j, s), (i, t)) = (cell(x, w), cell(y, h));
        let across = |data: &[T], j: usize| {
            let node = |i: usize| at.value(data, size, i * w + j);
            lerp(node(i), node(i + 1), t)
        };
        let density = [j, j + 1].map(|j| across(&self.density, j));
        let below = across(&self.along_rows, j) + area(s, density[0], density[1]) / count(w - 1);
        let total = |i: usize| at.value(&self.along_rows, size, i * w + w - 1);
        let totals = [total(i), total(i + 1)];
        let all = lerp(totals[0], totals[1], t).at_least(T::TINY);
        let rows = at.value(&self.marginal, h, i) + area(t, totals[0], totals[1]) / count(h - 1);
        let u = [below / all, rows].map(|v| v.within(T::ZERO, T::ONE));
        (u, lerp(density[0], density[1], s))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two azimuths, two polar angles, a grid of 4 x 3.
    fn warp<T: Real>() -> Warp<T> {
        let values: Vec<f32> = (0..48_u16).map(|i| f32::from(i * 37 % 11)).collect();
        Warp::new([4, 3], &values)
    }

    fn slices<T: Real>(phi: f64, theta: f64) -> Slices<T> {
        let knots = [T::ZERO, T::ONE];
        Slices::new(&knots, &knots, T::of(phi), T::of(theta))
    }

    #[test]
    fn densities_integrate_to_one_between_views() {
        let warp = warp::<f64>();
        for (phi, theta) in [(0.0, 0.0), (1.0, 1.0), (0.3, 0.8), (-4.0, 9.0)] {
            let at = slices(phi, theta);
            let n = 600;
            let middle = |i: u32| (f64::from(i) + 0.5) / f64::from(n);
            let points = (0..n * n).map(|i| [middle(i % n), middle(i / n)]);
            let mean = points.map(|p| warp.pdf(&at, p)).sum::<f64>() / f64::from(n * n);
            assert!((mean - 1.0).abs() < 1e-4, "{mean} at {phi}, {theta}");
        }
    }

    #[test]
    fn inversion_undoes_sampling() {
        let warp = warp::<f64>();
        let mut stream = crate::math::Stream::new(3);
        for _ in 0..2000 {
            let at = slices(stream.next(), stream.next());
            let u = [stream.next(), stream.next()];
            let (point, pdf) = warp.sample(&at, u);
            let (back, again) = warp.invert(&at, point);
            for (u, v) in u.into_iter().zip(back) {
                assert!((u - v).abs() < 1e-12, "{u} {v}");
            }
            assert!((pdf - again).abs() < 1e-11 && (pdf - warp.pdf(&at, point)).abs() < 1e-11);
        }
    }

    #[test]
    fn a_slice_of_zeros_is_uniform() {
        let warp = Warp::<f32>::new([2, 2], &[0.0; 4]);
        let at = Slices::new(&[0.0], &[0.0], 0.0, 0.0);
        let (point, pdf) = warp.sample(&at, [0.25, 0.75]);
        assert_eq!((point, pdf), ([0.25, 0.75], 1.0));
    }
}
