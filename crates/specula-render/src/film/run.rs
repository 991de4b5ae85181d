//! Sums of a run of samples of one pixel, exact, as a device returns them.
//!
//! A device has no `f64`, and its compilers may reorder and fuse what is added in `f32`. So it adds
//! integers: a run's values are multiples of one unit, far below the last bit of all but absurdly small
//! ones. So the film holds the same to the last bit however its samples were split into runs, waves and
//! passes.

use bytemuck::{Pod, Zeroable};

use super::PixelSums;

/// Most samples of a run.
pub(crate) const LONGEST_RUN: u32 = 64;

/// Sums over a run of at most 64 samples of a pixel: 176 bytes.
///
/// Let `e` be the largest exponent of the values' bits as `f32` (1 where all are subnormal).
///
/// GPU twin: `sums.wgsl`, which says how bits beyond these units are left out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
pub struct RunSums {
    /// Picture values times the filter's weight, in units of `2^(e - 246)`.
    pub colour: [i128; 3],
    /// Their squares, in units of `2^(2 e - 372)`.
    pub squares: [i128; 3],
    /// Distances of first surfaces, in units of `2^(e - 246)` with an `e` of their own.
    pub depth: i128,
    /// Colours of first surfaces times the filter's weight, in units of `2^-30`, each rounded.
    pub albedo: [i64; 3],
    /// Shading normals of first surfaces, likewise.
    pub normal: [i64; 3],
    /// `e` of the colours; from bit 8 on `e` of the depths; from bit 16 on how many have a depth.
    pub scales: u32,
    /// Rays that were traced.
    pub rays: u32,
    /// A bit for each sample, the first one's lowest: whether it was not finite. It is in no sum.
    pub invalid: u64,
}

impl PixelSums {
    /// Adds the sums of `count` samples.
    pub(crate) fn add_run(&mut self, run: &RunSums, count: u32) {
        let exponent = |shift: u32| i32::from((run.scales >> shift).to_le_bytes()[0]);
        let (colour, depth) = (exponent(0), exponent(8));
        for i in 0..3 {
            self.colour[i].add_units(run.colour[i], colour - 246);
            self.squares[i].add_units(run.squares[i], 2 * colour - 372);
            self.albedo[i].add_units(run.albedo[i]);
            self.normal[i].add_units(run.normal[i]);
        }
        self.depth.add_units(run.depth, depth - 246);
        self.hits = self.hits.saturating_add(run.scales >> 16);
        self.count = self.count.saturating_add(count);
    }
}

#[cfg(test)]
mod tests {
    use specula_bsdf::{Rgb, Vec3};

    use super::super::PixelSample;
    use super::*;

    /// A colour, an albedo of it, and a distance now and then.
    fn sample(i: u16) -> PixelSample {
        let x = f32::from(i) * 0.37 + 1e-3;
        PixelSample {
            colour: Rgb {
                r: x,
                g: 1.0 / x,
                b: (x * 3.0).fract() * 1e-3,
            },
            albedo: Rgb::splat((x * 0.1).fract()),
            normal: Vec3::Z,
            depth: (!i.is_multiple_of(3)).then_some(x),
        }
    }

    /// What a device makes of samples of weight 1, all finite.
    fn run(samples: &[PixelSample]) -> RunSums {
        let parts = |x: f32| {
            let (exponent, digits) = ((x.to_bits() >> 23) & 0xff, x.to_bits() & 0x7f_ffff);
            (exponent, i128::from(digits | 0x80_0000))
        };
        let colours = || samples.iter().map(|s| s.colour.to_array());
        let depths = || samples.iter().filter_map(|s| s.depth);
        let largest = colours().flatten().map(|x| parts(x).0).max().unwrap_or(1);
        let deepest = depths().map(|x| parts(x).0).max().unwrap_or(1);
        let hits = u32::try_from(depths().count()).unwrap();
        let mut sums = RunSums {
            scales: largest | deepest << 8 | hits << 16,
            ..RunSums::default()
        };
        for colour in colours() {
            for (k, (exponent, digits)) in colour.map(parts).into_iter().enumerate() {
                sums.colour[k] += digits << (96 - (largest - exponent));
                sums.squares[k] += (digits * digits) << (72 - 2 * (largest - exponent));
            }
        }
        for (exponent, digits) in depths().map(parts) {
            sums.depth += digits << (96 - (deepest - exponent));
        }
        let fixed = |x: f32| {
            let mut sum = crate::film::sum::FixedSum::default();
            sum.add(x);
            sum.word().cast_signed()
        };
        for s in samples {
            let (albedo, normal) = (s.albedo.to_array(), s.normal.to_array());
            for k in 0..3 {
                sums.albedo[k] += fixed(albedo[k]);
                sums.normal[k] += fixed(normal[k]);
            }
        }
        sums
    }

    #[test]
    fn runs_add_up_to_what_their_samples_do() {
        let samples: Vec<PixelSample> = (0..200).map(sample).collect();
        let mut one_by_one = PixelSums::default();
        for s in &samples {
            assert!(one_by_one.add(s, 1.0));
        }
        let of_runs = |longest: usize| {
            let mut pixel = PixelSums::default();
            for samples in samples.chunks(longest) {
                let count = u32::try_from(samples.len()).unwrap();
                pixel.add_run(&run(samples), count);
            }
            pixel
        };
        let values = |p: &PixelSums| {
            let sums = [p.colour, p.squares, [p.depth; 3]].map(|s| s.map(|s| s.value().to_bits()));
            (sums, p.albedo, p.normal, p.hits, p.count)
        };
        for longest in [1, 7, 64] {
            assert_eq!(values(&of_runs(longest)), values(&one_by_one), "{longest}");
            // To the last bit that a file stores.
            assert_eq!(of_runs(longest), of_runs(50), "{longest}");
        }
        let mut short = samples.clone();
        short.pop();
        assert_ne!(values(&one_by_one).0, {
            let mut pixel = PixelSums::default();
            for samples in short.chunks(50) {
                pixel.add_run(&run(samples), 50);
            }
            values(&pixel).0
        });
    }
}
