//! Samples in rows, each what it adds to the sums of its pixel: those of a run of samples of one pixel are added
//! together, a lane for each sum.

use core::ops::Range;

use super::buffer::{PixelSample, PixelSums};
use super::sum::{FixedSum, Sum};

/// Lanes of a vector of sums.
const LANES: usize = 8;
/// Rows that are filled before they are added: a vector that is read just after its numbers were written one by one
/// waits for all of them.
pub(crate) const ROWS: usize = 64;

/// Terms of [`Sum`]s: colour, colour once more, depth, and a lane that is not used.
type Values = [f32; LANES];
/// Terms of [`FixedSum`]s: albedo, normal, and two lanes that are not used.
type FixedValues = [f32; LANES];

/// The lanes of the colour's squares.
const SQUARES: Range<usize> = 3..6;
const DEPTH: usize = 6;

/// Samples that are to be added.
pub(crate) struct SampleRows {
    values: [Values; ROWS],
    fixed: [FixedValues; ROWS],
    /// Whether each is finite: the others count as black.
    finite: [bool; ROWS],
    hit: [bool; ROWS],
}

impl SampleRows {
    pub(crate) fn new() -> Self {
        Self {
            values: [[0.0; LANES]; ROWS],
            fixed: [[0.0; LANES]; ROWS],
            finite: [false; ROWS],
            hit: [false; ROWS],
        }
    }

    /// Sets one of the [`ROWS`] rows: a sample and its filter weight. Returns whether it is finite.
    #[inline(always)]
    pub(crate) fn set(&mut self, row: usize, sample: &PixelSample, weight: f32) -> bool {
        let value = sample.colour * weight;
        let [r, g, b] = value.to_array();
        let [albedo_r, albedo_g, albedo_b] = (sample.albedo * weight).to_array();
        let [x, y, z] = (sample.normal * weight).to_array();
        self.values[row] = [r, g, b, r, g, b, sample.depth.unwrap_or(0.0), 0.0];
        self.fixed[row] = [albedo_r, albedo_g, albedo_b, x, y, z, 0.0, 0.0];
        self.hit[row] = sample.depth.is_some();
        self.finite[row] = value.is_finite();
        self.finite[row]
    }
}

impl PixelSums {
    /// Adds the samples of a range of rows, in their order.
    #[inline(always)]
    pub(crate) fn add_rows(&mut self, rows: &SampleRows, range: Range<usize>) {
        let ([r, g, b], [rr, gg, bb]) = (self.colour, self.squares);
        let mut sums = [r, g, b, rr, gg, bb, self.depth, Sum::default()];
        let ([r, g, b], [x, y, z]) = (self.albedo, self.normal);
        let unused = FixedSum::default();
        let mut fixed = [r, g, b, x, y, z, unused, unused];
        for row in range {
            self.count += 1;
            if !rows.finite[row] {
                continue;
            }
            self.hits += u32::from(rows.hit[row]);
            let mut terms = rows.values[row].map(f64::from);
            for term in &mut terms[SQUARES] {
                *term *= *term;
            }
            for (sum, &term) in sums.iter_mut().zip(&terms) {
                sum.add(term);
            }
            for (sum, &term) in fixed.iter_mut().zip(&rows.fixed[row]) {
                sum.add(term);
            }
        }
        for i in 0..3 {
            self.colour[i] = sums[i];
            self.squares[i] = sums[SQUARES.start + i];
            self.albedo[i] = fixed[i];
            self.normal[i] = fixed[3 + i];
        }
        self.depth = sums[DEPTH];
    }
}

#[cfg(test)]
mod tests {
    use specula_bsdf::{Rgb, Vec3};

    use super::*;

    /// Some without a depth, some not finite, all negative in places.
    fn samples() -> Vec<(PixelSample, f32)> {
        let sample = |i: u16| {
            let x = f32::from(i) * 0.37 - 2.0;
            let red = if i % 11 == 5 { f32::NAN } else { x };
            let colour = Rgb {
                r: red,
                g: 1e3 / (x * x + 1.0),
                b: (x * 3.0).fract() * 1e-3,
            };
            let sample = PixelSample {
                colour,
                albedo: Rgb {
                    r: (x * 0.1).fract(),
                    g: if i == 7 { f32::NAN } else { 0.5 },
                    b: if i == 8 { f32::INFINITY } else { 3e-10 },
                },
                normal: Vec3 {
                    x: -x * 0.1,
                    y: 0.6,
                    z: -0.8,
                },
                depth: (!i.is_multiple_of(3)).then_some(x.abs()),
            };
            (sample, 1.0 - 0.01 * f32::from(i % 7))
        };
        (0..ROWS)
            .map(|i| sample(u16::try_from(i).unwrap()))
            .collect()
    }

    #[test]
    fn rows_add_what_samples_do_one_by_one() {
        let samples = samples();
        let mut rows = SampleRows::new();
        let mut expected = PixelSums::default();
        for (row, (sample, weight)) in samples.iter().enumerate() {
            let is_finite = rows.set(row, sample, *weight);
            assert_eq!(is_finite, expected.add(sample, *weight), "{row}");
            assert_eq!(is_finite, row % 11 != 5, "{row}");
        }
        for cuts in [vec![0, ROWS], vec![0, 1, 2, 20, 20, ROWS]] {
            let mut sums = PixelSums::default();
            for pair in cuts.windows(2) {
                sums.add_rows(&rows, pair[0]..pair[1]);
            }
            assert_eq!(sums, expected, "{cuts:?}");
        }
        let mut fewer = PixelSums::default();
        fewer.add_rows(&rows, 0..ROWS - 1);
        assert_ne!(fewer, expected);
    }
}
