//! Random numbers for the tests: xoshiro256++, the same on every machine and in every release.

/// A stream of random numbers, fixed by its seed.
///
/// A generator of our own, so that no release of another crate changes the samples of a test.
///
/// Source: Blackman and Vigna 2021, Scrambled Linear Pseudorandom Number Generators; seeded by
/// `SplitMix64`, as they advise.
#[derive(Clone, Debug)]
pub struct Rng {
    state: [u64; 4],
}

impl Rng {
    /// The stream of `seed`.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        let mut x = seed;
        let state = std::array::from_fn(|_| {
            x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let z = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            z ^ (z >> 31)
        });
        Self { state }
    }

    /// A stream for each name: the seed is the FNV-1a hash of `name`.
    #[must_use]
    pub fn from_name(name: &str) -> Self {
        Self::new(name.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        }))
    }

    /// 64 random bits.
    #[inline]
    pub fn bits(&mut self) -> u64 {
        let s = &mut self.state;
        let result = s[0].wrapping_add(s[3]).rotate_left(23).wrapping_add(s[0]);
        let t = s[1] << 17;
        s[2] ^= s[0];
        s[3] ^= s[1];
        s[1] ^= s[2];
        s[0] ^= s[3];
        s[2] ^= t;
        s[3] = s[3].rotate_left(45);
        result
    }

    /// A uniform number in `[0, 1)` of 53 bits. (Rounded to `f32` it may become 1: use
    /// [`Rng::uniform_f32`] there.)
    #[inline]
    pub fn uniform(&mut self) -> f64 {
        /// 2^-53.
        const SCALE: f64 = 1.0 / 9_007_199_254_740_992.0;
        #[expect(clippy::cast_precision_loss, reason = "53 bits are exact")]
        let x = (self.bits() >> 11) as f64;
        x * SCALE
    }

    /// A uniform number in `[0, 1)` of 24 bits: exact in `f32`, and below 1 there.
    #[inline]
    pub fn uniform_f32(&mut self) -> f64 {
        /// 2^-24.
        const SCALE: f64 = 1.0 / 16_777_216.0;
        #[expect(clippy::cast_precision_loss, reason = "24 bits are exact")]
        let x = (self.bits() >> 40) as f64;
        x * SCALE
    }

    /// Three of [`Rng::uniform_f32`]: the random numbers of one BSDF sample, the same for its
    /// `f32` and its `f64` twin.
    #[inline]
    pub fn triple(&mut self) -> [f64; 3] {
        [self.uniform_f32(), self.uniform_f32(), self.uniform_f32()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mean_and_variance_are_those_of_the_uniform_distribution() {
        let mut rng = Rng::new(1);
        let n = 100_000;
        let (mut sum, mut sum_squares) = (0.0, 0.0);
        for _ in 0..n {
            let x = rng.uniform();
            assert!((0.0..1.0).contains(&x));
            sum += x;
            sum_squares += x * x;
        }
        let mean = sum / f64::from(n);
        assert!((mean - 0.5).abs() < 4.0 * (1.0 / 12.0 / f64::from(n)).sqrt());
        assert!((sum_squares / f64::from(n) - 1.0 / 3.0).abs() < 4e-3);
    }

    #[test]
    fn names_give_different_streams() {
        assert_ne!(Rng::from_name("a").bits(), Rng::from_name("b").bits());
        assert_eq!(Rng::from_name("a").bits(), Rng::from_name("a").bits());
    }
}
