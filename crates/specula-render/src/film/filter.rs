//! Reconstruction filters, by sampling them: positions follow the filter, weights are constant.
//!
//! A sample's position about its pixel is sampled in proportion to the filter's absolute value
//! (Ernst et al. 2006), so that a pixel depends on its own samples only: tiles need no borders and
//! the picture no order of summation. Where the filter is negative (Mitchell, Lanczos), the weight
//! is; its magnitude is `int |f| / int f`, and the pixel is the mean of weighted samples, without
//! division by the sum of weights, hence without bias. Each axis of the filter is the step function
//! of its [`CELLS`] midpoints.

use specula_scene::scene::Filter;

use crate::convert::{floor_index, narrow};
use crate::words::Words;

/// Cells that a filter's width is tabulated in.
const CELLS: usize = 1024;

/// A filter ready for sampling.
#[derive(Clone, Debug)]
pub(crate) struct FilterSampler {
    axes: [Axis; 2],
}

#[derive(Clone, Debug)]
struct Axis {
    radius: f32,
    /// `cdf[i]`: share of `|f|` left of cell `i`; the last is 1.
    cdf: Vec<f32>,
    /// Last cell that begins at or before each share of [`CELLS`].
    guide: Vec<u16>,
    /// Whether it is 1 everywhere.
    is_box: bool,
    /// Where `f` is negative.
    negative: Vec<bool>,
    /// `int |f| / int f`.
    magnitude: f32,
}

impl FilterSampler {
    /// Tabulates a filter.
    pub(crate) fn new(filter: &Filter) -> Self {
        let radius = match *filter {
            Filter::Box { radius }
            | Filter::Triangle { radius }
            | Filter::Gaussian { radius, .. }
            | Filter::Mitchell { radius, .. }
            | Filter::LanczosSinc { radius, .. } => radius,
        };
        Self {
            axes: [0, 1].map(|axis| {
                let r = radius[axis].max(1e-3);
                Axis::new(r, |x| evaluate(filter, f64::from(r), x))
            }),
        }
    }

    /// Moves points from their pixels' centres, and multiplies the weights of their samples.
    ///
    /// * `u`: random numbers of each axis, one for each point.
    pub(crate) fn sample_all(&self, u: [&[f32]; 2], at: [&mut [f32]; 2], weights: &mut [f32]) {
        weights.fill(1.0);
        for ((axis, u), at) in self.axes.iter().zip(u).zip(at) {
            axis.sample_all(u, at, weights);
        }
    }
}

impl FilterSampler {
    /// The filter for shaders: of each axis the radius, whether it is a box, the magnitude of weights,
    /// the distribution over cells, and whether each cell is negative.
    pub(crate) fn flatten(&self, to: &mut Words) {
        to.constant("FILTER_CELLS", crate::convert::id(CELLS));
        for (axis, name) in self.axes.iter().zip(["FILTER_ACROSS", "FILTER_DOWN"]) {
            to.begin(name);
            to.number(axis.radius);
            to.flag(axis.is_box);
            to.number(axis.magnitude);
            to.floats(axis.cdf.iter().copied());
            to.ids(axis.negative.iter().map(|&n| u32::from(n)));
        }
    }
}

impl Axis {
    fn new(radius: f32, f: impl Fn(f64) -> f64) -> Self {
        let r = f64::from(radius);
        let values: Vec<f64> = (0..CELLS)
            .map(|i| f(((i as f64 + 0.5) / CELLS as f64 * 2.0 - 1.0) * r))
            .collect();
        let whole: f64 = values.iter().sum();
        let absolute: f64 = values.iter().map(|v| v.abs()).sum();
        let usable = absolute > 0.0 && whole > 1e-6 * absolute;
        let mut cdf = Vec::with_capacity(CELLS + 1);
        let mut sum = 0.0;
        for (i, v) in values.iter().enumerate() {
            cdf.push(if usable {
                narrow(sum / absolute)
            } else {
                i as f32 / CELLS as f32
            });
            sum += v.abs();
        }
        cdf.push(1.0);
        let first = |i: usize| {
            let share = i as f32 / CELLS as f32;
            let cell = cdf.partition_point(|&c| c <= share).clamp(1, CELLS) - 1;
            u16::try_from(cell).unwrap_or(0)
        };
        Self {
            radius,
            guide: (0..CELLS).map(first).collect(),
            is_box: values.iter().all(|&v| v == 1.0),
            cdf,
            negative: values.iter().map(|&v| usable && v < 0.0).collect(),
            magnitude: if usable {
                narrow(absolute / whole)
            } else {
                1.0
            },
        }
    }

    fn sample_all(&self, u: &[f32], at: &mut [f32], weights: &mut [f32]) {
        if self.is_box {
            // What the cells come to.
            for (u, at) in u.iter().zip(at) {
                *at += (u * 2.0 - 1.0) * self.radius;
            }
            return;
        }
        for ((&u, at), weight) in u.iter().zip(at).zip(weights) {
            let (x, w) = self.sample(u);
            *at += x;
            *weight *= w;
        }
    }

    /// An offset, and the weight there.
    #[inline]
    fn sample(&self, u: f32) -> (f32, f32) {
        let mut cell = usize::from(self.guide[floor_index(u * CELLS as f32).min(CELLS - 1)]);
        while cell + 1 < CELLS && self.cdf[cell + 1] <= u {
            cell += 1;
        }
        let width = self.cdf[cell + 1] - self.cdf[cell];
        let within = if width > 0.0 {
            ((u - self.cdf[cell]) / width).clamp(0.0, 1.0)
        } else {
            0.5
        };
        let x = ((cell as f32 + within) / CELLS as f32 * 2.0 - 1.0) * self.radius;
        let sign = if self.negative[cell] { -1.0 } else { 1.0 };
        (x, sign * self.magnitude)
    }
}

/// One axis of a filter at `x` in `[-r, r]`, in pbrt-v4's parametrisation, not normalised.
fn evaluate(filter: &Filter, r: f64, x: f64) -> f64 {
    match *filter {
        Filter::Box { .. } => 1.0,
        Filter::Triangle { .. } => (r - x.abs()).max(0.0),
        Filter::Gaussian { sigma, .. } => {
            let s = f64::from(sigma).max(1e-3);
            let g = |x: f64| (-x * x / (2.0 * s * s)).exp();
            (g(x) - g(r)).max(0.0)
        }
        Filter::Mitchell { b, c, .. } => mitchell(2.0 * x.abs() / r, f64::from(b), f64::from(c)),
        Filter::LanczosSinc { tau, .. } => sinc(x) * sinc(x / f64::from(tau).max(1e-3)),
    }
}

/// Mitchell and Netravali 1988, eq. 8, on `[0, 2]`.
fn mitchell(x: f64, b: f64, c: f64) -> f64 {
    if x <= 1.0 {
        ((12.0 - 9.0 * b - 6.0 * c) * x * x * x
            + (-18.0 + 12.0 * b + 6.0 * c) * x * x
            + (6.0 - 2.0 * b))
            / 6.0
    } else if x <= 2.0 {
        ((-b - 6.0 * c) * x * x * x
            + (6.0 * b + 30.0 * c) * x * x
            + (-12.0 * b - 48.0 * c) * x
            + (8.0 * b + 24.0 * c))
            / 6.0
    } else {
        0.0
    }
}

fn sinc(x: f64) -> f64 {
    let y = core::f64::consts::PI * x;
    if y.abs() < 1e-5 { 1.0 } else { y.sin() / y }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `int f(x) x^2 / int f(x)` by the midpoint rule and by samples.
    fn second_moments(filter: Filter, r: f64) -> (f64, f64, f64) {
        let n = 20_000;
        let (mut top, mut bottom) = (0.0, 0.0);
        for i in 0..n {
            let x = ((f64::from(i) + 0.5) / f64::from(n) * 2.0 - 1.0) * r;
            let f = evaluate(&filter, r, x);
            top += f * x * x;
            bottom += f;
        }
        let sampler = FilterSampler::new(&filter);
        let (mut moment, mut weights) = (0.0, 0.0);
        for i in 0..n {
            let sample = |u: f32| {
                let (mut at, mut weight) = ([[0.0]; 2], [0.0]);
                let [x, y] = &mut at;
                sampler.sample_all([&[u], &[0.5]], [x, y], &mut weight);
                (at[0][0], weight[0])
            };
            let (x, w) = sample((i as f32 + 0.5) / n as f32);
            let sign = sample(0.5).1.abs().sqrt();
            let w = f64::from(w / sign);
            moment += w * f64::from(x * x);
            weights += w;
        }
        (top / bottom, moment / f64::from(n), weights / f64::from(n))
    }

    #[test]
    fn samples_follow_the_filter_and_weights_average_to_one() {
        let filters = [
            (Filter::Box { radius: [0.5; 2] }, 0.5),
            (Filter::Triangle { radius: [2.0; 2] }, 2.0),
            (
                Filter::Gaussian {
                    radius: [1.5; 2],
                    sigma: 0.5,
                },
                1.5,
            ),
            (
                Filter::Mitchell {
                    radius: [2.0; 2],
                    b: 1.0 / 3.0,
                    c: 1.0 / 3.0,
                },
                2.0,
            ),
            (
                Filter::LanczosSinc {
                    radius: [4.0; 2],
                    tau: 3.0,
                },
                4.0,
            ),
        ];
        for (filter, r) in filters {
            let (expected, found, weights) = second_moments(filter, r);
            assert!((weights - 1.0).abs() < 2e-3, "{filter:?}: {weights}");
            assert!(
                (expected - found).abs() < 2e-3 * (1.0 + expected.abs()),
                "{filter:?}: {expected} {found}"
            );
        }
    }
}
