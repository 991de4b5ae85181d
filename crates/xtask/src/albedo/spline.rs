//! Coefficients of tensor products of B-splines from their values.

use specula_bsdf::internal::spline::{Cubic, Quadratic};

/// An axis of a table: how many coefficients, and of which degree.
#[derive(Clone, Copy)]
pub(super) enum Axis {
    Cubic(usize),
    Quadratic(usize),
}

impl Axis {
    pub(super) fn count(self) -> usize {
        match self {
            Self::Cubic(count) | Self::Quadratic(count) => count,
        }
    }

    /// As many places of `[0, 1]` as coefficients: the knots and the middles of the first and last
    /// interval, or both ends and the middles of all.
    #[allow(clippy::cast_precision_loss, reason = "some dozen coefficients")]
    pub(super) fn places(self) -> Vec<f64> {
        match self {
            Self::Cubic(count) => {
                let cells = (count - 3) as f64;
                let mut places: Vec<f64> = (0..count - 2).map(|i| i as f64 / cells).collect();
                places.insert(1, 0.5 / cells);
                places.insert(count - 2, 1.0 - 0.5 / cells);
                places
            }
            Self::Quadratic(count) => {
                let cells = (count - 2) as f64;
                let middles = (0..count - 2).map(|i| (i as f64 + 0.5) / cells);
                [0.0].into_iter().chain(middles).chain([1.0]).collect()
            }
        }
    }

    /// Weights of all coefficients at a place.
    fn row(self, x: f64) -> Vec<f64> {
        let mut row = vec![0.0; self.count()];
        match self {
            Self::Cubic(count) => {
                let stencil = Cubic::cubic(x, count);
                row[stencil.first()..][..4].copy_from_slice(stencil.weights());
            }
            Self::Quadratic(count) => {
                let stencil = Quadratic::quadratic(x, count);
                row[stencil.first()..][..3].copy_from_slice(stencil.weights());
            }
        }
        row
    }

    /// The matrix that makes coefficients of the values at the places.
    fn inverse(self) -> Vec<Vec<f64>> {
        let n = self.count();
        let mut rows: Vec<Vec<f64>> = self
            .places()
            .iter()
            .enumerate()
            .map(|(i, &x)| {
                let mut row = self.row(x);
                row.resize(2 * n, 0.0);
                row[n + i] = 1.0;
                row
            })
            .collect();
        for column in 0..n {
            let pivot = (column..n)
                .max_by(|&i, &j| rows[i][column].abs().total_cmp(&rows[j][column].abs()))
                .unwrap_or(column);
            rows.swap(column, pivot);
            let scale = 1.0 / rows[column][column];
            rows[column].iter_mut().for_each(|value| *value *= scale);
            let own = rows[column].clone();
            for (i, row) in rows.iter_mut().enumerate() {
                let factor = row[column];
                if i != column && factor != 0.0 {
                    for (value, own) in row.iter_mut().zip(&own) {
                        *value -= factor * own;
                    }
                }
            }
        }
        rows.into_iter().map(|row| row[n..].to_vec()).collect()
    }
}

/// Turns values, the last axis fastest, into coefficients.
pub(super) fn coefficients(axes: &[Axis], values: &mut [f64]) {
    for (a, axis) in axes.iter().enumerate() {
        let n = axis.count();
        let inverse = axis.inverse();
        let stride: usize = axes[a + 1..].iter().map(|axis| axis.count()).product();
        for block in values.chunks_mut(n * stride) {
            for offset in 0..stride {
                let line: Vec<f64> = (0..n).map(|i| block[offset + i * stride]).collect();
                for (i, row) in inverse.iter().enumerate() {
                    block[offset + i * stride] = row.iter().zip(&line).map(|(a, b)| a * b).sum();
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn splines_meet_the_values() {
        let axes = [Axis::Cubic(7), Axis::Quadratic(6)];
        let value = |x: f64, y: f64| (3.0 * x).sin() + y * y * x;
        let (xs, ys) = (axes[0].places(), axes[1].places());
        let mut table: Vec<f64> = xs
            .iter()
            .flat_map(|&x| ys.iter().map(move |&y| value(x, y)))
            .collect();
        coefficients(&axes, &mut table);
        for &x in &xs {
            for &y in &ys {
                let (sx, sy) = (Cubic::cubic(x, 7), Quadratic::quadratic(y, 6));
                let got = sx.sum(|i| sy.sum(|j| table[6 * i + j]));
                assert!((got - value(x, y)).abs() < 1e-13, "{x} {y}");
            }
        }
    }
}
