//! The grid of a chi-square test, for pictures: samples and quadrature over cos theta and phi.

use std::f64::consts::PI;

use specula_bsdf::Bsdf;
use specula_bsdf::math::{Real, Stream};
use specula_stat::quadrature::{Patch, Quadrature, angles};

use super::{Case, RADIANCE};

/// Rows of equal steps of cos theta, from 1 down to -1.
pub(super) const ROWS: usize = 32;
/// Columns of phi from 0 to 2 pi.
pub(super) const COLUMNS: usize = 64;

impl Case<'_> {
    /// Counts of samples and their expectation, row by row.
    pub(super) fn grid(&self) -> (Vec<f32>, Vec<f32>) {
        let mut counts = vec![0.0_f32; ROWS * COLUMNS];
        let mut stream = Stream::new(self.seed);
        for _ in 0..self.samples {
            let u = [stream.next(), stream.next(), stream.next()];
            let sample = self.lobe().sample(self.wo, u, RADIANCE);
            if let Some(s) = sample.filter(|s| !s.specular) {
                let (theta, phi) = angles(s.wi);
                let row = place(0.5 * (1.0 - theta.cos()), ROWS);
                counts[row * COLUMNS + place(phi / (2.0 * PI), COLUMNS)] += 1.0;
            }
        }
        let samples = f64::from(self.samples);
        let quadrature = Quadrature {
            relative_tolerance: 1e-3,
            absolute_tolerance: 0.01 / samples,
            max_patches: 100,
            peaks: self.peaks(),
            ..Quadrature::default()
        };
        let edge = |i: usize, n: usize| {
            let exact = |i: usize| u32::try_from(i).map_or(0.0, f64::from);
            exact(i) / exact(n)
        };
        let mut expected = Vec::with_capacity(counts.len());
        for row in 0..ROWS {
            let theta = [row, row + 1].map(|i| (1.0 - 2.0 * edge(i, ROWS)).acos());
            for column in 0..COLUMNS {
                let phi = [column, column + 1].map(|i| 2.0 * PI * edge(i, COLUMNS));
                let patch = Patch { theta, phi };
                let share = quadrature.integrate(patch, |wi| [self.lobe().pdf(self.wo, wi)]);
                expected.push(f32::of(samples * share.value[0]));
            }
        }
        (counts, expected)
    }
}

/// The cell of a share in `[0, 1]`.
fn place(share: f64, cells: usize) -> usize {
    let cells_real = u32::try_from(cells).map_or(1.0, f64::from);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to the cells"
    )]
    let i = (share * cells_real).clamp(0.0, cells_real - 1.0) as usize;
    i.min(cells - 1)
}
