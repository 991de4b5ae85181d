//! The sampler: which dimension of which sequence every decision of a path uses.
//!
//! Dimensions come in sets of four, one set for each purpose at each vertex:
//!
//! | set | dimension 0 | 1 and 2 | 3 |
//! |---|---|---|---|
//! | camera | x on the lens | x and y within the filter | y on the lens |
//! | scatter, vertex v | choice of lobe | direction | Russian roulette |
//! | light, vertex v | choice of light | point on it | finer digits of the choice |
//!
//! Each set is the first four dimensions of an Owen-scrambled Sobol sequence, shuffled and
//! scrambled by itself (Burley 2020, "padding"; by the crate `sobol_burley`), under a hash of the set, the
//! block of 16 x 16 pixels, the render's seed and the block of 2^16 samples: blocks and sets are decorrelated, and a
//! sequence never runs past its length. Dimensions 1 and 2 are Sobol's first two: any 2^k samples from a
//! multiple of 2^k on have one in each elementary rectangle of area 2^-k. They are so, too, for all pixels of a
//! square together ([`pixel_blocks`]). The other two are scrambled by pixel.
//!
//! The sets of the first vertex are joined with the camera's: which part of a fine or bumpy surface a pixel sees
//! and where the light comes from that it reflects are correlated. Their sequences take the index of the sample
//! as the camera's set has shuffled it, transformed by a matrix of bits ([`TURN`]) that stratifies both sets
//! together.
//!
//! The camera's sequence has a fifth dimension, Sobol's own: the time of the sample, where something moves.
//!
//! Lobes that walk between microfacets take random numbers from a hashed stream per vertex. Opacity and the choice
//! within mixed materials take hashed random numbers, since their count along a path is not bounded.

mod pixel_blocks;

use std::sync::LazyLock;

use macro_rules_attribute::apply;
use sobol_burley::parts::sobol_rev;
use specula_bsdf::math::Stream;

use crate::simd::simd_levels;
use crate::soa::{Column, Floats};
use crate::words::Words;
use pixel_blocks::SHIFTS;

/// The random numbers of one sample of one pixel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sampler {
    /// The sample within its block of 2^16 in the lower half, the place of the pixel within its block above.
    index: u32,
    /// Of the block of pixels and of samples.
    seed: u32,
}

impl Sampler {
    /// The random numbers of sample `sample` of a pixel.
    #[inline]
    pub(crate) fn new(pixel: [u32; 2], sample: u32, seed: u32) -> Self {
        let [x, y] = pixel_blocks::block(pixel);
        Self {
            index: pixel_blocks::place(pixel) | (sample & SAMPLE),
            seed: hash(x ^ hash(y ^ hash(seed ^ hash(sample >> 16)))),
        }
    }

    /// Those of another sample of the same pixel, in the same block of 2^16.
    #[inline]
    pub(crate) fn at(self, sample: u32) -> Self {
        Self {
            index: place(self.index) | (sample & SAMPLE),
            ..self
        }
    }

    /// Index of the sample within its block of 2^16.
    #[inline]
    pub(crate) fn index(&self) -> u32 {
        self.index & SAMPLE
    }

    /// Dimensions 1 and 2 for the filter, 0 and 3 for the lens.
    #[cfg(test)]
    pub(crate) fn camera(&self) -> [f32; 4] {
        self.set(Purpose::Camera.set(0))
    }

    /// Three random numbers for the lobe, one for Russian roulette.
    #[inline]
    pub(crate) fn scatter(&self, vertex: u32) -> [f32; 4] {
        self.set(Purpose::Scatter.set(vertex))
    }

    /// One random number for the choice of a light, two for the point on it, one for finer digits of the choice.
    #[inline]
    pub(crate) fn light(&self, vertex: u32) -> [f32; 4] {
        self.set(Purpose::Light.set(vertex))
    }

    /// The time of the sample while the shutter is open: a fifth dimension of the camera's set, which only scenes
    /// with motion take.
    pub(crate) fn time(&self) -> f32 {
        let key = seed_of_set(self.seed, CAMERA);
        let bits = sobol_rev(shuffled(self.index, key), TIME);
        scrambled(bits, key ^ place(self.index), TIME_KEY)
    }

    /// A random number in `[0, 1)` that depends on the sample and on `key`.
    #[inline]
    pub(crate) fn hashed(&self, key: [u32; 3]) -> f32 {
        let bits = hash(self.seed ^ hash(self.index ^ hash(key[0] ^ hash(key[1] ^ hash(key[2])))));
        // 24 bits: every value is exact and below 1.
        (bits >> 8) as f32 * (1.0 / 16_777_216.0)
    }

    /// A stream of random numbers for a lobe whose values are estimates, at one vertex.
    ///
    /// * `purpose`: tells its evaluation from its sampling.
    #[inline]
    pub(crate) fn stream(&self, vertex: u32, purpose: u32) -> Stream {
        let low = hash(self.seed ^ hash(vertex ^ hash(purpose)));
        let high = hash(low ^ hash(self.index));
        Stream::new(u64::from(high) << 32 | u64::from(low))
    }

    #[inline]
    fn set(&self, set: u32) -> [f32; 4] {
        let key = seed_of_set(self.seed, set);
        let index = if is_joined_with_camera(set) {
            turned(shuffled(self.index, seed_of_set(self.seed, CAMERA)))
        } else {
            shuffled(self.index, key)
        };
        let place = place(self.index);
        let shift = SHIFTS[pixel_blocks::shuffled(place, key) as usize];
        let bits = [0, 1, 2, 3].map(|k| sobol(index, k));
        [
            scrambled(bits[0], key ^ place, KEYS[0]),
            scrambled(bits[1] ^ (shift & 0xffff), key, KEYS[1]),
            scrambled(bits[2] ^ (shift >> 16), key, KEYS[2]),
            scrambled(bits[3], key ^ place, KEYS[3]),
        ]
    }
}

/// The bits of an index that tell the sample.
const SAMPLE: u32 = 0xffff;

/// The bits of an index that tell the pixel.
#[inline(always)]
fn place(index: u32) -> u32 {
    index & !SAMPLE
}

/// The purpose of a set of dimensions at a vertex.
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
            Self::Camera => CAMERA,
            Self::Scatter => 1 + 2 * vertex,
            Self::Light => 2 + 2 * vertex,
        }
    }
}

/// The camera's set.
const CAMERA: u32 = 0;

/// Whether a set is stratified together with the camera's: those of the first vertex.
#[inline(always)]
fn is_joined_with_camera(set: u32) -> bool {
    set == Purpose::Scatter.set(0) || set == Purpose::Light.set(0)
}

/// Columns of the matrix that transforms the index of a sample for sets that are joined with the camera's: bit 0
/// first; the lowest bit of a column stands for bit 0.
///
/// Each is, after those before it, the best for the `2^k` samples that it is the last for: the one that makes
/// [`tests::unevenness`] least. Columns end at the diagonal, which is 1, so that `2^k` samples from a
/// multiple of `2^k` on stay such, and each set as even as it was.
const TURN: [u32; 16] = [
    1, 2, 7, 15, 26, 33, 102, 216, 398, 517, 1449, 2698, 4096, 8192, 16384, 32768,
];

/// A shuffled index, transformed by [`TURN`]; bits reversed.
#[inline(always)]
fn turned(shuffled: u32) -> u32 {
    let mut bits = 0;
    for (bit, column) in TURN.iter().enumerate() {
        bits ^= mask(shuffled, bit) & column.reverse_bits();
    }
    bits
}

/// The index of a sample within its block, shuffled; bits reversed.
#[inline(always)]
fn shuffled(index: u32, key: u32) -> u32 {
    use sobol_burley::parts::{hash, owen_scramble_rev};
    let sample = index & SAMPLE;
    owen_scramble_rev(sample.reverse_bits(), hash(key ^ 0x79c6_8e4a))
}

/// Dimension `k` of a set before it is scrambled, bits reversed.
///
/// * `index`: the shuffled index of the sample, bits reversed.
#[inline(always)]
fn sobol(index: u32, k: usize) -> u32 {
    let columns = COLUMNS.iter().enumerate();
    columns.fold(0, |bits, (bit, c)| bits ^ (mask(index, bit) & c[k]))
}

/// All ones where a bit of a reversed word is 1.
#[inline(always)]
fn mask(reversed: u32, bit: usize) -> u32 {
    ((reversed << bit) >> 31).wrapping_neg()
}

/// The seed with which a set is shuffled and scrambled.
#[inline(always)]
fn seed_of_set(seed: u32, set: u32) -> u32 {
    hash(seed.wrapping_add(set.wrapping_mul(0x9e37_79b9)))
}

/// Random numbers of many samples at once: those of [`Sampler`], bit for bit.
#[derive(Clone, Debug)]
pub(crate) struct RandomNumbers<const N: usize> {
    indices: Column<u32, N>,
    seeds: Column<u32, N>,
    /// The seeds of the set.
    keys: Column<u32, N>,
    /// Shuffled indices, bits reversed.
    shuffled: Column<u32, N>,
    /// What tells the pixels of a block apart, of the sequence's first two dimensions.
    shifts: Column<u32, N>,
    /// Of the sequence's third and fourth dimension, before they are scrambled.
    bits: [Column<u32, N>; 2],
    /// By dimension of the set.
    pub(crate) values: [Floats<N>; 4],
}

impl<const N: usize> RandomNumbers<N> {
    pub(crate) const ZERO: Self = Self {
        indices: Column::of(0),
        seeds: Column::of(0),
        keys: Column::of(0),
        shuffled: Column::of(0),
        shifts: Column::of(0),
        bits: [Column::of(0); 2],
        values: [Floats::of(0.0); 4],
    };

    /// Sets the sampler of an element.
    #[inline(always)]
    pub(crate) fn set(&mut self, i: usize, sampler: &Sampler) {
        self.indices[i] = sampler.index;
        self.seeds[i] = sampler.seed;
    }

    /// The random numbers of the first `n` elements for a purpose.
    pub(crate) fn generate(&mut self, n: usize, purpose: Purpose, vertex: u32) {
        generate(n, purpose.set(vertex), self);
    }
}

/// Columns of the generator matrices by bit of the index from its highest, and dimension of the set.
static COLUMNS: LazyLock<[[u32; 4]; 16]> = LazyLock::new(|| {
    let mut bit = 32;
    [(); 16].map(|()| {
        bit -= 1;
        ORDER.map(|dimension| sobol_rev(1 << bit, dimension))
    })
});

/// Sobol's dimensions by dimension of the set.
const ORDER: [u32; 4] = [2, 0, 1, 3];

/// Sobol's dimension of times.
const TIME: u32 = 4;
/// What distinguishes its scrambling.
const TIME_KEY: u32 = 0x5bd1_e995;

/// What distinguishes the scrambling of the random numbers, as in the crate's `sample_4d`.
const KEYS: [u32; 4] = [0x691e_72ca, 0x912f_69ba, 0x174f_18ab, 0xb40c_c1b8];

/// The generator matrices, by bit and dimension, and the shifts of pixels, for shaders.
pub(crate) fn flatten(to: &mut Words) {
    to.begin("SOBOL_COLUMNS");
    to.ids(COLUMNS.iter().flatten().copied());
    to.begin("SEQUENCE_TURN");
    to.ids(TURN.map(u32::reverse_bits));
    to.begin("SEQUENCE_SHIFTS");
    to.ids(SHIFTS);
}

/// Burley's shuffled and scrambled sequence, with the shifts of pixels.
///
/// The first dimension's generator matrix is the identity, the second's Pascal's triangle modulo 2, whose
/// entry at `i`, `j` is 1 where the bits of `i` are among those of `j` (Lucas's theorem): four steps
/// instead of sixteen columns.
#[apply(simd_levels)]
fn generate<const N: usize>(n: usize, set: u32, random_numbers: &mut RandomNumbers<N>) {
    let n = n.min(N);
    let RandomNumbers {
        indices,
        seeds,
        keys,
        shuffled: indices_shuffled,
        shifts,
        bits,
        values,
    } = random_numbers;
    for i in 0..n {
        keys[i] = seed_of_set(seeds[i], set);
    }
    if is_joined_with_camera(set) {
        for i in 0..n {
            indices_shuffled[i] = turned(shuffled(indices[i], seed_of_set(seeds[i], CAMERA)));
        }
    } else {
        for i in 0..n {
            indices_shuffled[i] = shuffled(indices[i], keys[i]);
        }
    }
    for i in 0..n {
        shifts[i] = pixel_blocks::shuffled(place(indices[i]), keys[i]);
    }
    for i in 0..n {
        shifts[i] = SHIFTS[(shifts[i] & 0x3ff) as usize];
    }
    // Four columns after the other: these are the loops that become vectors.
    let [b0, b3] = bits;
    for (group, columns) in COLUMNS.as_chunks::<4>().0.iter().enumerate() {
        for i in 0..n {
            let [mut x0, mut x3] = if group == 0 { [0; 2] } else { [b0[i], b3[i]] };
            for (bit, [c0, _, _, c3]) in columns.iter().enumerate() {
                let mask = mask(indices_shuffled[i], 4 * group + bit);
                x0 ^= mask & c0;
                x3 ^= mask & c3;
            }
            b0[i] = x0;
            b3[i] = x3;
        }
    }
    let [v0, v1, v2, v3] = values;
    for i in 0..n {
        let key = keys[i] ^ place(indices[i]);
        v0[i] = scrambled(b0[i], key, KEYS[0]);
        v3[i] = scrambled(b3[i], key, KEYS[3]);
    }
    for i in 0..n {
        let x = (indices_shuffled[i] & 0xffff_0000).reverse_bits();
        v1[i] = scrambled(x ^ (shifts[i] & 0xffff), keys[i], KEYS[1]);
        let x = x ^ ((x >> 1) & 0x5555);
        let x = x ^ ((x >> 2) & 0x3333);
        let x = x ^ ((x >> 4) & 0x0f0f);
        let x = x ^ ((x >> 8) & 0x00ff);
        v2[i] = scrambled(x ^ (shifts[i] >> 16), keys[i], KEYS[2]);
    }
}

/// A random number in `[0, 1)` from its bits, reversed.
#[inline(always)]
fn scrambled(bits: u32, set: u32, dimension: u32) -> f32 {
    use sobol_burley::parts::{hash, owen_scramble_rev, u32_to_f32_norm};
    let key = hash(set.wrapping_mul(0x9c8f_2d3b) ^ dimension);
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
    fn times_are_stratified_and_apart_from_the_other_dimensions() {
        for k in 0..10 {
            let count = 1 << k;
            let mut cells = vec![0_u32; count];
            for sample in 0..crate::convert::id(count) {
                let sampler = Sampler::new([3, 5], sample + crate::convert::id(count), 7);
                cells[crate::convert::floor_index(sampler.time() * count as f32)] += 1;
            }
            assert!(cells.iter().all(|&n| n == 1), "{count}: {cells:?}");
        }
        // Among 16 x 16 cells, 1024 samples of time and any other dimension leave none nearly empty.
        for dimension in 0..4 {
            let mut cells = [0_u32; 256];
            for sample in 0..1024 {
                let sampler = Sampler::new([8, 1], sample, 2);
                let cell = |u: f32| crate::convert::floor_index(u * 16.0);
                cells[16 * cell(sampler.time()) + cell(sampler.camera()[dimension])] += 1;
            }
            assert!(
                cells.iter().all(|n| (1..=10).contains(n)),
                "{dimension}: {cells:?}"
            );
        }
    }

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
        let mut random_numbers = RandomNumbers::<48>::ZERO;
        let sampler = |i: usize| {
            let k = u32::try_from(i).unwrap();
            Sampler::new([7 * k, k], k.wrapping_mul(2_654_435_761), 5)
        };
        for i in 0..33 {
            random_numbers.set(i, &sampler(i));
        }
        let values = |random_numbers: &RandomNumbers<48>, i: usize| {
            [0, 1, 2, 3].map(|d| random_numbers.values[d][i])
        };
        for vertex in [0, 1, 30, 31, 32, 99] {
            random_numbers.generate(33, Purpose::Scatter, vertex);
            for i in 0..33 {
                assert_eq!(values(&random_numbers, i), sampler(i).scatter(vertex));
            }
            random_numbers.generate(33, Purpose::Light, vertex);
            for i in 0..33 {
                assert_eq!(values(&random_numbers, i), sampler(i).light(vertex));
            }
        }
        random_numbers.generate(33, Purpose::Camera, 7);
        for i in 0..33 {
            assert_eq!(values(&random_numbers, i), sampler(i).camera());
        }
    }

    /// How uneven the first samples of two sets are together, but for a factor: Owen's gain coefficients, the
    /// variance over that of independent samples (Owen 1997, "Monte Carlo variance of scrambled net quadrature",
    /// 4), summed over the terms with dimensions of both.
    ///
    /// * `samples`: their indices, as they are and transformed.
    ///
    /// The terms of a dimension's first `k` digits have half the weight of those before. Of the first set
    /// dimensions 1 and 2 count (the filter's), of the second 0, 1 and 2. Terms of three dimensions weigh 0.7, of
    /// four 0.5.
    fn unevenness(samples: impl Iterator<Item = (u32, u32)>) -> f64 {
        // By the number of digits that are zero: those terms, and less the next one.
        let terms: [f64; 17] = core::array::from_fn(|zeros| {
            let sum = 2.0 - 0.5_f64.powi(i32::try_from(zeros).unwrap() - 1);
            let next = if zeros == 16 {
                0.0
            } else {
                0.5_f64.powi(i32::try_from(zeros).unwrap())
            };
            sum - next
        });
        let term = |index: u32, k: usize| {
            let digits = sobol(index.reverse_bits(), k);
            terms[digits.trailing_zeros().min(16) as usize]
        };
        let of = |(index, turned): (u32, u32)| {
            let [a, b] = [1, 2].map(|k| term(index, k));
            let [c, x, y] = [0, 1, 2].map(|k| term(turned, k));
            let (ones, twos) = ([a + b, c + x + y], [a * b, c * x + c * y + x * y]);
            ones[0] * ones[1]
                + 0.7 * (ones[0] * twos[1] + twos[0] * ones[1])
                + 0.5 * twos[0] * twos[1]
        };
        samples.map(of).sum()
    }

    fn turn(index: u32) -> u32 {
        turned(index.reverse_bits()).reverse_bits()
    }

    #[test]
    fn the_turn_is_the_best_column_by_column() {
        for (bit, &column) in TURN.iter().enumerate() {
            assert_eq!(31 - column.leading_zeros(), crate::convert::id(bit));
        }
        for (bit, &column) in TURN.iter().enumerate().take(12) {
            let top = 1_u32 << bit;
            let with = |column: u32| unevenness((0..top).map(|i| (i | top, turn(i) ^ column)));
            let found = with(column);
            let least = (top..2 * top).map(with).fold(f64::INFINITY, f64::min);
            assert!(found <= least + 1e-9, "{bit}: {found} {least}");
        }
    }

    /// Variance of integrands over dimensions of both sets, relative to that with independent sets.
    #[test]
    fn camera_and_first_vertex_are_even_together() {
        let alone = unevenness(core::iter::once((0, 0)));
        let relative = |samples: u32| unevenness((0..samples).map(|i| (i, turn(i)))) / alone;
        for (samples, expected) in [
            (4, 1.030),
            (16, 0.931),
            (64, 0.692),
            (256, 0.434),
            (4096, 0.125),
        ] {
            let found = relative(samples);
            assert!((found - expected).abs() < 1e-3, "{samples}: {found}");
        }
        // Measured: the integral of a ridge that runs across a pixel and a lobe.
        let ridge = |camera: [f32; 4], lobe: [f32; 4]| {
            f64::from(
                (6.0 * (camera[1] + lobe[1] - 1.0)).cos() * (3.0 * (camera[2] - lobe[2])).cos(),
            )
        };
        let mut errors = [0.0; 2];
        let samples = 64;
        let pixels = 400;
        let all: Vec<[f64; 2]> = (0..pixels)
            .map(|x| {
                let mut sums = [0.0; 2];
                for i in 0..samples {
                    let sampler = Sampler::new([x, 3], i, 9);
                    let [together, apart] = [sampler.scatter(0), sampler.scatter(1)];
                    sums[0] += ridge(sampler.camera(), together);
                    sums[1] += ridge(sampler.camera(), apart);
                }
                sums
            })
            .collect();
        for k in 0..2 {
            let mean = all.iter().map(|s| s[k]).sum::<f64>() / f64::from(pixels);
            errors[k] = all.iter().map(|s| (s[k] - mean).powi(2)).sum();
        }
        let ratio: f64 = errors[0] / errors[1];
        assert!(ratio < 0.7, "{ratio}");
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
