//! Sample sequences: which dimension of which sequence every decision of a path uses.
//!
//! Every pixel has an Owen-scrambled Sobol sequence of its own (Burley 2020, by the crate
//! `sobol_burley`), seeded with a hash of the pixel, the render's seed and the block of 2^16
//! samples: pixels are decorrelated, and a sequence never runs past its length. Dimensions go in
//! sets of four:
//!
//! | set | numbers |
//! |---|---|
//! | 0 | x and y within the filter, x and y on the lens |
//! | 1 + 2 v | vertex v: choice of lobe, two for the direction, Russian roulette |
//! | 2 + 2 v | vertex v: choice of light, two for the point on it, finer digits of the choice |
//!
//! From vertex 31 on the sets repeat under another seed (Burley's padding): stratified within
//! themselves, random against the others. Lobes that walk between microfacets draw from a hashed
//! stream per vertex. Opacity and the choice within mixed materials take
//! hashed numbers, since their count along a path is not bounded.

use sobol_burley::{NUM_DIMENSION_SETS_4D, sample_4d};
use specula_bsdf::math::Stream;

/// The numbers of one sample of one pixel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sampler {
    index: u32,
    seed: u32,
}

impl Sampler {
    /// The numbers of sample `sample` of a pixel.
    #[inline]
    pub(crate) fn new(pixel: [u32; 2], sample: u32, seed: u32) -> Self {
        let block = sample >> 16;
        Self {
            index: sample & 0xffff,
            seed: hash(pixel[0] ^ hash(pixel[1] ^ hash(seed ^ hash(block)))),
        }
    }

    /// Two numbers for the filter, two for the lens.
    #[inline]
    pub(crate) fn camera(&self) -> [f32; 4] {
        self.set(0)
    }

    /// Three numbers for the lobe, one for Russian roulette.
    #[inline]
    pub(crate) fn scatter(&self, vertex: u32) -> [f32; 4] {
        self.set(1 + 2 * vertex)
    }

    /// One number for the choice of a light, two for the point on it, one for finer digits of the
    /// choice.
    #[inline]
    pub(crate) fn light(&self, vertex: u32) -> [f32; 4] {
        self.set(2 + 2 * vertex)
    }

    /// A number in `[0, 1)` that depends on the sample and on `key`.
    #[inline]
    pub(crate) fn hashed(&self, key: [u32; 3]) -> f32 {
        let bits = hash(self.seed ^ hash(self.index ^ hash(key[0] ^ hash(key[1] ^ hash(key[2])))));
        // 24 bits: every value is exact and below 1.
        (bits >> 8) as f32 * (1.0 / 16_777_216.0)
    }

    /// Numbers without end for a lobe whose values are estimates, at one vertex; `purpose` tells
    /// its evaluation from its sampling.
    #[inline]
    pub(crate) fn stream(&self, vertex: u32, purpose: u32) -> Stream {
        let low = hash(self.seed ^ hash(vertex ^ hash(purpose)));
        let high = hash(low ^ hash(self.index));
        Stream::new(u64::from(high) << 32 | u64::from(low))
    }

    #[inline]
    fn set(&self, set: u32) -> [f32; 4] {
        let round = set / NUM_DIMENSION_SETS_4D;
        let seed = if round == 0 {
            self.seed
        } else {
            hash(self.seed.wrapping_add(round.wrapping_mul(0x9e37_79b9)))
        };
        sample_4d(self.index, set % NUM_DIMENSION_SETS_4D, seed)
    }
}

/// A bijective mix of 32 bits.
///
/// Source: Wellons 2018, `lowbias32`.
#[inline]
pub(crate) fn hash(mut x: u32) -> u32 {
    x = x.wrapping_add(0x9e37_79b9);
    x ^= x >> 16;
    x = x.wrapping_mul(0x7feb_352d);
    x ^= x >> 15;
    x = x.wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_set_is_stratified_and_within_the_unit_interval() {
        for set in [0, 1, 2, 63, 64, 65, 200] {
            for dimension in 0..4 {
                let mut cells = [0_u32; 256];
                for sample in 0..256 {
                    let u = Sampler::new([3, 5], sample, 7).set(set)[dimension];
                    assert!((0.0..1.0).contains(&u));
                    cells[crate::convert::floor_index(u * 256.0)] += 1;
                }
                assert!(
                    cells.iter().all(|&c| c == 1),
                    "set {set} dimension {dimension}"
                );
            }
        }
    }

    #[test]
    fn samples_beyond_the_length_of_the_sequence_are_new() {
        let early = Sampler::new([0, 0], 1, 0).camera();
        let late = Sampler::new([0, 0], 1 + (1 << 16), 0).camera();
        assert_ne!(early, late);
    }

    #[test]
    fn neighbouring_pixels_are_decorrelated() {
        let n = 4096;
        let mut product = 0.0_f64;
        for x in 0..n {
            let a = Sampler::new([x, 0], 0, 0).camera()[0];
            let b = Sampler::new([x + 1, 0], 0, 0).camera()[0];
            product += f64::from(a - 0.5) * f64::from(b - 0.5);
        }
        // Standard deviation of the mean: (1/12) / sqrt(n).
        let z = product / f64::from(n) * 12.0 * f64::from(n).sqrt();
        assert!(z.abs() < 4.5, "{z}");
    }
}
