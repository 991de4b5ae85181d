//! Sample sequences: which dimension of which sequence every decision of a path uses.
//!
//! Numbers come in sets of four, one for each purpose at each vertex:
//!
//! | set | 0 | 1 and 2 | 3 |
//! |---|---|---|---|
//! | camera | x on the lens | x and y within the filter | y on the lens |
//! | scatter, vertex v | choice of lobe | direction | Russian roulette |
//! | light, vertex v | choice of light | point on it | finer digits of the choice |
//!
//! Each set is the first four dimensions of an Owen-scrambled Sobol sequence, shuffled and
//! scrambled by itself (Burley 2020, "padding"; by the crate `sobol_burley`), under a hash of the set, the
//! pixel, the render's seed and the block of 2^16 samples: pixels and sets are decorrelated, and a
//! sequence never runs past its length. Numbers 1 and 2 are Sobol's first two dimensions: any 2^k samples
//! from a multiple of 2^k on have one in each elementary rectangle of area 2^-k.
//!
//! Higher dimensions for the other sets, under one shuffle, were here before: some pairs of them are
//! so badly distributed that 32 samples miss half of a product. Mean squared error at 32 samples of sets
//! by themselves over that, in the scenes of `data/versus`: 0.91 to 0.71.
//!
//! Lobes that walk between microfacets draw from a hashed stream per vertex. Opacity and the choice
//! within mixed materials take hashed numbers, since their count along a path is not bounded.

use std::sync::LazyLock;

use multiversion::multiversion;
use sobol_burley::parts::sobol_rev;
use sobol_burley::sample_4d;
use specula_bsdf::math::Stream;

use crate::flat::Words;

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

    /// Numbers 1 and 2 for the filter, 0 and 3 for the lens.
    #[cfg(test)]
    pub(crate) fn camera(&self) -> [f32; 4] {
        self.set(Purpose::Camera.set(0))
    }

    /// Three numbers for the lobe, one for Russian roulette.
    #[inline]
    pub(crate) fn scatter(&self, vertex: u32) -> [f32; 4] {
        self.set(Purpose::Scatter.set(vertex))
    }

    /// One number for the choice of a light, two for the point on it, one for finer digits of the
    /// choice.
    #[inline]
    pub(crate) fn light(&self, vertex: u32) -> [f32; 4] {
        self.set(Purpose::Light.set(vertex))
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
        let [x, y, z, w] = sample_4d(self.index, 0, seed_of_set(self.seed, set));
        [z, x, y, w]
    }
}

/// What the numbers at a vertex are for.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Purpose {
    /// The filter and the lens, whatever the vertex.
    Camera,
    /// [`Sampler::scatter`].
    Scatter,
    /// [`Sampler::light`].
    Light,
}

impl Purpose {
    fn set(self, vertex: u32) -> u32 {
        match self {
            Self::Camera => 0,
            Self::Scatter => 1 + 2 * vertex,
            Self::Light => 2 + 2 * vertex,
        }
    }
}

/// What a set is shuffled and scrambled by.
#[inline(always)]
fn seed_of_set(seed: u32, set: u32) -> u32 {
    hash(seed.wrapping_add(set.wrapping_mul(0x9e37_79b9)))
}

/// Numbers of many samples at once: those that a [`Sampler`] draws, bit for bit.
#[derive(Clone, Debug)]
pub(crate) struct Numbers<const N: usize> {
    indices: [u32; N],
    seeds: [u32; N],
    /// What the sets are shuffled and scrambled by.
    keys: [u32; N],
    /// Shuffled indices, bits reversed.
    rest: [u32; N],
    /// Of the sequence's third and fourth dimension, before they are scrambled.
    bits: [[u32; N]; 2],
    /// By number of the set.
    pub(crate) values: [[f32; N]; 4],
}

impl<const N: usize> Numbers<N> {
    pub(crate) const ZERO: Self = Self {
        indices: [0; N],
        seeds: [0; N],
        keys: [0; N],
        rest: [0; N],
        bits: [[0; N]; 2],
        values: [[0.0; N]; 4],
    };

    /// Places a sample.
    #[inline(always)]
    pub(crate) fn place(&mut self, i: usize, sampler: &Sampler) {
        self.indices[i] = sampler.index;
        self.seeds[i] = sampler.seed;
    }

    /// Draws for the first `n` samples.
    pub(crate) fn draw(&mut self, n: usize, purpose: Purpose, vertex: u32) {
        draw(n, purpose.set(vertex), self);
    }
}

/// Columns of the generator matrices by bit of the index from its highest, and number of the set.
static COLUMNS: LazyLock<[[u32; 4]; 16]> = LazyLock::new(|| {
    let mut bit = 32;
    [(); 16].map(|()| {
        bit -= 1;
        ORDER.map(|dimension| sobol_rev(1 << bit, dimension))
    })
});

/// Sobol's dimensions by number of the set.
const ORDER: [u32; 4] = [2, 0, 1, 3];

/// What distinguishes the scrambling of the numbers, as in the crate's `sample_4d`.
const KEYS: [u32; 4] = [0x691e_72ca, 0x912f_69ba, 0x174f_18ab, 0xb40c_c1b8];

/// The generator matrices for shaders, by bit and number.
pub(crate) fn flatten(to: &mut Words) {
    to.begin("SOBOL_COLUMNS");
    to.ids(COLUMNS.iter().flatten().copied());
}

/// Burley's shuffled and scrambled sequence, as in the crate's `sample_4d`.
///
/// The first dimension's generator matrix is the identity, the second's Pascal's triangle modulo 2, whose
/// entry at `i`, `j` is 1 where the bits of `i` are among those of `j` (Lucas's theorem): four steps
/// instead of sixteen columns.
#[multiversion(targets(
    "x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+avx2+fma+bmi1+bmi2",
    "x86_64+avx2+fma+bmi1+bmi2"
))]
fn draw<const N: usize>(n: usize, set: u32, numbers: &mut Numbers<N>) {
    use sobol_burley::parts::{hash, owen_scramble_rev};
    let n = n.min(N);
    let Numbers {
        indices,
        seeds,
        keys,
        rest,
        bits,
        values,
    } = numbers;
    for i in 0..n {
        keys[i] = seed_of_set(seeds[i], set);
        rest[i] = owen_scramble_rev(indices[i].reverse_bits(), hash(keys[i] ^ 0x79c6_8e4a));
    }
    // One column after the other: these are the loops that become vectors.
    let [b0, b3] = bits;
    for (bit, [c0, _, _, c3]) in (0_u32..).zip(&*COLUMNS) {
        for i in 0..n {
            let mask = ((rest[i] << bit) >> 31).wrapping_neg();
            let so_far = |b: u32| if bit == 0 { 0 } else { b };
            b0[i] = so_far(b0[i]) ^ (mask & c0);
            b3[i] = so_far(b3[i]) ^ (mask & c3);
        }
    }
    let [v0, v1, v2, v3] = values;
    for i in 0..n {
        v0[i] = scrambled(b0[i], keys[i], KEYS[0]);
        v3[i] = scrambled(b3[i], keys[i], KEYS[3]);
    }
    for i in 0..n {
        let x = (rest[i] & 0xffff_0000).reverse_bits();
        v1[i] = scrambled(x, keys[i], KEYS[1]);
        let x = x ^ ((x >> 1) & 0x5555);
        let x = x ^ ((x >> 2) & 0x3333);
        let x = x ^ ((x >> 4) & 0x0f0f);
        let x = x ^ ((x >> 8) & 0x00ff);
        v2[i] = scrambled(x, keys[i], KEYS[2]);
    }
}

/// A number of a set in `[0, 1)` from its bits, reversed.
#[inline(always)]
fn scrambled(bits: u32, set: u32, number: u32) -> f32 {
    use sobol_burley::parts::{hash, owen_scramble_rev, u32_to_f32_norm};
    let key = hash(set.wrapping_mul(0x9c8f_2d3b) ^ number);
    u32_to_f32_norm(owen_scramble_rev(bits, key).reverse_bits())
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
        for set in [0, 1, 2, 65, 200] {
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
    fn many_at_once_are_those_of_each() {
        let mut numbers = Numbers::<48>::ZERO;
        let sampler = |i: usize| {
            let k = u32::try_from(i).unwrap();
            Sampler::new([7 * k, k], k.wrapping_mul(2_654_435_761), 5)
        };
        for i in 0..33 {
            numbers.place(i, &sampler(i));
        }
        let found = |numbers: &Numbers<48>, i: usize| [0, 1, 2, 3].map(|d| numbers.values[d][i]);
        for vertex in [0, 1, 30, 31, 32, 99] {
            numbers.draw(33, Purpose::Scatter, vertex);
            for i in 0..33 {
                assert_eq!(found(&numbers, i), sampler(i).scatter(vertex));
            }
            numbers.draw(33, Purpose::Light, vertex);
            for i in 0..33 {
                assert_eq!(found(&numbers, i), sampler(i).light(vertex));
            }
        }
        numbers.draw(33, Purpose::Camera, 7);
        for i in 0..33 {
            assert_eq!(found(&numbers, i), sampler(i).camera());
        }
    }

    #[test]
    fn samples_beyond_the_length_of_the_sequence_are_new() {
        let early = Sampler::new([0, 0], 1, 0).set(0);
        let late = Sampler::new([0, 0], 1 + (1 << 16), 0).set(0);
        assert_ne!(early, late);
    }

    #[test]
    fn neighbouring_pixels_are_decorrelated() {
        let n = 4096;
        let mut product = 0.0_f64;
        for x in 0..n {
            let a = Sampler::new([x, 0], 0, 0).set(0)[0];
            let b = Sampler::new([x + 1, 0], 0, 0).set(0)[0];
            product += f64::from(a - 0.5) * f64::from(b - 0.5);
        }
        // Standard deviation of the mean: (1/12) / sqrt(n).
        let z = product / f64::from(n) * 12.0 * f64::from(n).sqrt();
        assert!(z.abs() < 4.5, "{z}");
    }
}
