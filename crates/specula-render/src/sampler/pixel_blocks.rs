//! Sequences of the pixels of a block: each is stratified, and so are all together.
//!
//! All pixels of a block of 16 x 16 share the scrambling of their sequences. What tells them apart is a digital
//! shift, by the place of a pixel within its block. Any `2^n` samples, from a multiple of `2^n` on, of all pixels of
//! an aligned square of `2^l x 2^l` have one point in each elementary rectangle of area `2^-(n + 2 l)`, for any `n`
//! and `l` within the digits of the table. The error of a mean over pixels falls with it; a pixel's own does not
//! change (Ahmed and Wonka 2020, "Screen-space blue-noise diffusion of Monte Carlo sampling error via hierarchical
//! ordering of pixels", by other means: their samples are consecutive ones of a sequence, so that their number has to
//! be known).
//!
//! **Why it is so.** Digits of Sobol's first two dimensions are the coefficients, at 0 and at 1, of the polynomial over
//! GF(2) whose coefficients are the bits of the index. The shift has those of a rational function with a pole at the
//! roots of `q = 1 + z + z^2`, the one irreducible polynomial of degree 2: of
//!
//! `f = sum_c (a_c + b_c z) / q^(c + 1)`
//!
//! where `a_c` and `b_c` are bit `c` of the pixel's `x` and `y`, after a shuffle. For `n` bits of the index and
//! `l` bits of `x` and `y` the sum of both is `P / q^l` with a polynomial `P` of less than `n + 2 l` coefficients.
//! As `q` is 1 at 0 and at 1, any `n + 2 l` of the first digits at 0 and at 1 determine `P` (Hermite interpolation),
//! and with it the sample and the pixel.

use sobol_burley::parts::{hash, owen_scramble_rev};

/// Bits of the coordinates of a pixel within its block.
const LEVELS: u32 = 4;

/// Digits of a shift.
const DIGITS: u32 = 16;

/// What distinguishes the shuffle of the places.
const SHUFFLE_KEY: u32 = 0x2c1b_3c6d;

/// The coordinates of a pixel's block.
#[inline(always)]
pub(super) fn block(pixel: [u32; 2]) -> [u32; 2] {
    pixel.map(|p| p >> LEVELS)
}

/// The place of a pixel within its block: bits of `x` and `y` in turn, the lowest first, from bit 31 down.
#[inline(always)]
pub(super) fn place([x, y]: [u32; 2]) -> u32 {
    let [x, y] = [x, y].map(|p| APART[(p & 15) as usize]);
    x | y >> 1
}

/// Four bits apart, the lowest first, from bit 31 down.
const APART: [u32; 16] = {
    let mut apart = [0; 16];
    let mut i = 0;
    while i < 4 * apart.len() {
        let (bits, level) = (i / 4, i % 4);
        if (bits >> level) & 1 == 1 {
            apart[bits] |= 1 << (31 - 2 * level);
        }
        i += 1;
    }
    apart
};

/// Where the shift of a pixel is in [`SHIFTS`]: its place after a shuffle.
///
/// Places of each aligned square are shuffled among themselves, for each set in another way: by scrambling the
/// place, and by multiplying `a_c + b_c z` by one of the three powers of `z` modulo `q`. What two sets do together is
/// then nearly independent from pixel to pixel. Scrambling alone leaves pairs of pixels and, as two bits that are
/// both flipped stay equal, twice the squared error of the means of products.
///
/// * `place`: bits 24 to 31, as [`place`] returns it; the others are 0.
/// * `key`: the seed of the set.
#[inline(always)]
pub(super) fn shuffled(place: u32, key: u32) -> u32 {
    let power = ((key >> 16) * 3) >> 16;
    power << 8 | owen_scramble_rev(place, hash(key ^ SHUFFLE_KEY)) >> 24
}

/// Shifts by power of `z` and place: digits of the first dimension in the lower half, of the second in the upper; the
/// first digit is the lowest bit. The last quarter repeats the first, so that ten bits are always within.
pub(super) static SHIFTS: [u32; 1024] = shifts();

const fn shifts() -> [u32; 1024] {
    let mut shifts = [0; 1024];
    let mut fraction = 1;
    let mut level = 0;
    while level < LEVELS {
        fraction = divided(fraction);
        // 1, z and z^2 = 1 + z modulo q, over q^(c + 1). With z = 1 + t, q is 1 + t + t^2: the fraction itself has
        // the same digits at 0 and at 1.
        let (one, z, sum) = (fraction, fraction << 1, fraction ^ fraction << 1);
        let powers = [digits(one, one), digits(z, sum), digits(sum, z)];
        let mut i = 0;
        while i < shifts.len() {
            let (power, place) = (i >> 8, i & 0xff);
            if (place >> (7 - 2 * level)) & 1 == 1 {
                shifts[i] ^= powers[power % 3];
            }
            if (place >> (6 - 2 * level)) & 1 == 1 {
                shifts[i] ^= powers[(power + 1) % 3];
            }
            i += 1;
        }
        level += 1;
    }
    shifts
}

/// A power series over GF(2) divided by `q`.
const fn divided(series: u32) -> u32 {
    let (mut quotient, mut rest) = (0, series);
    let mut digit = 0;
    while digit < DIGITS {
        if (rest >> digit) & 1 == 1 {
            quotient |= 1 << digit;
            rest ^= 0b111 << digit;
        }
        digit += 1;
    }
    quotient
}

const fn digits(first: u32, second: u32) -> u32 {
    let all = (1 << DIGITS) - 1;
    (first & all) | (second & all) << DIGITS
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::convert::floor_index;
    use crate::sampler::{Purpose, Sampler};

    /// Points of a set's first two dimensions, of `samples` of the pixels of a square.
    fn points(
        (corner, width): ([u32; 2], u32),
        samples: core::ops::Range<u32>,
        (purpose, vertex): (Purpose, u32),
    ) -> Vec<[f32; 2]> {
        let pixels = (0..width * width).map(|i| [corner[0] + i % width, corner[1] + i / width]);
        let sample = |pixel, i| {
            let [_, x, y, _] = Sampler::new(pixel, i, 11).set(purpose.set(vertex));
            [x, y]
        };
        pixels
            .flat_map(|pixel| samples.clone().map(move |i| sample(pixel, i)))
            .collect()
    }

    #[test]
    fn pixels_of_a_square_are_stratified_together() {
        let sets = [
            (Purpose::Camera, 0),
            (Purpose::Scatter, 0),
            (Purpose::Light, 0),
            (Purpose::Scatter, 3),
        ];
        // Squares of 1, 2, 4, 8 and 16 pixels; numbers of samples, the last ones of two that were added later.
        let squares = [
            ([5, 9], 0),
            ([38, 70], 1),
            ([4, 12], 2),
            ([24, 8], 3),
            ([16, 48], 4),
        ];
        for ((corner, level), set) in squares.into_iter().flat_map(|s| sets.map(|set| (s, set))) {
            for (first, n) in [(0_u32, 0_u32), (5, 0), (6, 1), (8, 2), (32, 5)] {
                let points = points((corner, 1 << level), first..first + (1 << n), set);
                let digits = n + 2 * level;
                assert_eq!(points.len(), 1 << digits);
                for across in 0..=digits {
                    let sides = [across, digits - across].map(|d| (1_u32 << d) as f32);
                    let mut cells = vec![0_u32; points.len()];
                    for [x, y] in &points {
                        let [x, y] = [x * sides[0], y * sides[1]].map(floor_index);
                        cells[x << (digits - across) | y] += 1;
                    }
                    let even = cells.iter().all(|&count| count == 1);
                    assert!(
                        even,
                        "{set:?}, level {level}, samples {first} + 2^{n}, {across}"
                    );
                }
            }
        }
    }

    #[test]
    fn digits_of_shifts_are_those_of_the_fractions() {
        // Multiplied by q^(c + 1), the series are powers of z, of 1 + t at 1, each modulo q.
        let times_q = |series: u32| (series ^ series << 1 ^ series << 2) & 0xffff;
        let powers = [[1, 1], [2, 3], [3, 2]];
        for level in 0..LEVELS {
            for (power, bit, expected) in [
                (0, 7, 0),
                (1, 7, 1),
                (2, 7, 2),
                (0, 6, 1),
                (1, 6, 2),
                (2, 6, 0),
            ] {
                let shift = SHIFTS[power << 8 | 1 << (bit - 2 * level)];
                let mut found = [shift & 0xffff, shift >> 16];
                for _ in 0..=level {
                    found = found.map(times_q);
                }
                assert_eq!(
                    found, powers[expected],
                    "level {level}, power {power}, bit {bit}"
                );
            }
        }
    }

    #[test]
    fn places_are_shuffled_within_squares() {
        let mut orders = std::collections::BTreeSet::new();
        for key in 0..400_u32 {
            let shuffled = |x, y| shuffled(place([x, y]), key.wrapping_mul(0x9e37_79b9));
            let mut seen = [false; 256];
            for i in 0..256 {
                let [x, y] = [i % 16, i / 16];
                seen[(shuffled(x, y) & 0xff) as usize] = true;
                // Pixels of a square of 4 x 4 stay together: they share the bits of what is above.
                let corner = shuffled(x & !3, y & !3);
                assert_eq!(shuffled(x, y) & 0x0f, corner & 0x0f);
            }
            assert!(seen.iter().all(|&s| s));
            orders.insert([[0, 0], [1, 0], [0, 1], [1, 1]].map(|[x, y]| {
                let shift = SHIFTS[shuffled(x, y) as usize];
                (shift ^ SHIFTS[shuffled(0, 0) as usize]) & 3
            }));
        }
        // Six linear maps of two bits.
        assert_eq!(orders.len(), 6, "{orders:?}");
    }

    /// The squared error of the means of blocks over that of the means of as many pixels far apart, times the same for
    /// single pixels.
    fn relative_error(integrand: impl Fn(&Sampler) -> f64) -> [f64; 2] {
        let (samples, blocks) = (16_u32, 1000_u32);
        let value = |pixel, seed| {
            let sum: f64 = (0..samples)
                .map(|i| integrand(&Sampler::new(pixel, i, seed)))
                .sum();
            sum / f64::from(samples)
        };
        let of_block = |seed, apart: u32| -> Vec<f64> {
            let pixel = |i: u32| [i % 8 * apart, i / 8 * apart];
            (0..64).map(|i| value(pixel(i), seed)).collect()
        };
        let mut sums = [[0.0; 2]; 2];
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        let all: [Vec<Vec<f64>>; 2] =
            [1, 16].map(|apart| (0..blocks).map(|seed| of_block(seed, apart)).collect());
        let truth = mean(&all.iter().flatten().flatten().copied().collect::<Vec<_>>());
        for (k, blocks) in all.iter().enumerate() {
            for block in blocks {
                sums[0][k] += (mean(block) - truth).powi(2);
                sums[1][k] += mean(
                    &block
                        .iter()
                        .map(|v| (v - truth).powi(2))
                        .collect::<Vec<_>>(),
                );
            }
        }
        sums.map(|[together, apart]| together / apart)
    }

    #[test]
    fn means_of_blocks_have_less_error_and_pixels_the_same() {
        let smooth = |s: &Sampler| {
            let [_, x, y, _] = s.scatter(1).map(f64::from);
            (3.0 * x + y).sin() * y
        };
        let [block, pixel] = relative_error(smooth);
        assert!(block < 0.1, "{block}");
        assert!((pixel - 1.0).abs() < 0.1, "{pixel}");
    }

    #[test]
    fn products_of_sets_are_independent_from_pixel_to_pixel() {
        let wave = |u: f32, cycles: f64| (core::f64::consts::TAU * cycles * f64::from(u)).cos();
        // By coarse digits, by fine ones, with those of the camera, with a choice. Four thirds, as of four things
        // that are paired with four others.
        let coarse = |s: &Sampler| wave(s.scatter(1)[1], 0.5) * wave(s.light(1)[1], 0.5);
        let middle = |s: &Sampler| wave(s.scatter(1)[1], 1.0) * wave(s.scatter(2)[1], 1.0);
        let fine = |s: &Sampler| wave(s.scatter(1)[1], 3.0) * wave(s.scatter(2)[2], 5.0);
        let late = |s: &Sampler| wave(s.scatter(3)[2], 2.0) * wave(s.scatter(4)[1], 3.0);
        let camera = |s: &Sampler| wave(s.camera()[1], 2.0) * wave(s.scatter(0)[2], 2.0);
        let choice = |s: &Sampler| wave(s.scatter(1)[0], 1.0) * wave(s.scatter(2)[1], 1.0);
        for (of, [block, pixel]) in [
            ("coarse", relative_error(coarse)),
            ("middle", relative_error(middle)),
            ("fine", relative_error(fine)),
            ("late", relative_error(late)),
            ("camera", relative_error(camera)),
            ("choice", relative_error(choice)),
        ] {
            assert!(block < 1.33 * 1.2, "{of}: {block}");
            assert!((pixel - 1.0).abs() < 0.1, "{of}: {pixel}");
        }
    }
}
