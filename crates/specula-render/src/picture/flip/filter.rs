//! Separable filters over planes whose border extends.

use rayon::prelude::*;

/// One channel of a picture.
pub(super) struct Plane {
    /// Pixels in a row.
    pub(super) width: usize,
    /// Row by row.
    pub(super) values: Vec<f32>,
}

impl Plane {
    /// Correlation with the kernel `across` along rows and `down` along columns, both of odd length.
    pub(super) fn filtered(&self, across: &[f32], down: &[f32]) -> Self {
        let (width, height) = (self.width, self.values.len() / self.width);
        let mut rows = vec![0.0; self.values.len()];
        rows.par_chunks_mut(width)
            .zip(self.values.par_chunks(width))
            .for_each(|(out, row)| filter_row(row, across, out));
        let mut values = vec![0.0; self.values.len()];
        values
            .par_chunks_mut(width)
            .enumerate()
            .for_each(|(y, out)| {
                for (i, &weight) in down.iter().enumerate() {
                    let from = clamped(y, i, down.len() / 2, height);
                    let row = &rows[from * width..][..width];
                    for (o, &v) in out.iter_mut().zip(row) {
                        *o += weight * v;
                    }
                }
            });
        Self { width, values }
    }
}

fn filter_row(row: &[f32], kernel: &[f32], out: &mut [f32]) {
    let radius = kernel.len() / 2;
    for (x, o) in out.iter_mut().enumerate() {
        *o = if x >= radius && x + radius < row.len() {
            let window = &row[x - radius..][..kernel.len()];
            window.iter().zip(kernel).map(|(v, k)| v * k).sum()
        } else {
            let taps = kernel.iter().enumerate();
            taps.map(|(i, k)| k * row[clamped(x, i, radius, row.len())])
                .sum()
        };
    }
}

/// Index of tap `i` of a kernel of this radius at `position`, held within `0..length`.
fn clamped(position: usize, i: usize, radius: usize, length: usize) -> usize {
    (position + i).saturating_sub(radius).min(length - 1)
}

fn offsets(radius: usize) -> impl Iterator<Item = f32> {
    #[expect(clippy::cast_precision_loss, reason = "a few pixels")]
    (0..=2 * radius).map(move |i| i as f32 - radius as f32)
}

/// A Gaussian of `2 radius + 1` taps and sum 1, and its sum before it was normalised.
pub(super) fn gaussian_kernel(sd: f32, radius: usize) -> (Vec<f32>, f32) {
    let raw: Vec<f32> = offsets(radius)
        .map(|x| (-x * x / (2.0 * sd * sd)).exp())
        .collect();
    let mass: f32 = raw.iter().sum();
    (raw.iter().map(|v| v / mass).collect(), mass)
}

/// The first derivative of a Gaussian.
pub(super) fn edge_kernel(sd: f32, radius: usize) -> Vec<f32> {
    let raw = offsets(radius).map(|x| -x * (-x * x / (2.0 * sd * sd)).exp());
    balanced(raw.collect())
}

/// The second derivative of a Gaussian.
pub(super) fn point_kernel(sd: f32, radius: usize) -> Vec<f32> {
    let raw = offsets(radius).map(|x| {
        let square = x * x / (sd * sd);
        (square - 1.0) * (-0.5 * square).exp()
    });
    balanced(raw.collect())
}

/// Positive weights scaled to a sum of 1 and negative ones to -1 (section 3.3).
fn balanced(mut kernel: Vec<f32>) -> Vec<f32> {
    let positive: f32 = kernel.iter().filter(|v| **v > 0.0).sum();
    let negative: f32 = -kernel.iter().filter(|v| **v < 0.0).sum::<f32>();
    for v in &mut kernel {
        *v /= if *v > 0.0 { positive } else { negative };
    }
    kernel
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn filters_of_sum_one_keep_a_constant_and_derivatives_remove_it() {
        let plane = Plane {
            width: 7,
            values: vec![0.3; 35],
        };
        let (smooth, _) = gaussian_kernel(2.7, 9);
        for v in plane.filtered(&smooth, &smooth).values {
            assert!((v - 0.3).abs() < 1e-6);
        }
        for kernel in [edge_kernel(2.7, 9), point_kernel(2.7, 9)] {
            for v in plane.filtered(&kernel, &smooth).values {
                assert!(v.abs() < 1e-6);
            }
        }
    }

    #[test]
    fn an_impulse_gives_the_kernel_back() {
        let mut plane = Plane {
            width: 9,
            values: vec![0.0; 81],
        };
        plane.values[4 * 9 + 4] = 1.0;
        let out = plane.filtered(&[1.0, 2.0, 4.0], &[0.0, 1.0, 0.5]);
        assert_eq!(out.values[4 * 9 + 3..4 * 9 + 6], [4.0, 2.0, 1.0]);
        assert_eq!(out.values[3 * 9 + 3..3 * 9 + 6], [2.0, 1.0, 0.5]);
        assert_eq!(out.values[5 * 9 + 3..5 * 9 + 6], [0.0, 0.0, 0.0]);
    }
}
