//! A stream of random numbers, for lobes whose values are themselves estimates.

use super::Real;

/// A small pseudo-random stream: a 64-bit counter through a strong mix.
///
/// Source: SplitMix64 (Steele, Lea and Flood 2014). Streams of different seeds are independent for
/// every purpose here; the period is 2^64.
#[derive(Clone, Debug)]
pub struct Stream(u64);

impl Stream {
    /// The stream of a seed.
    #[inline(always)]
    pub const fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next random number, uniform in `[0, 1)`, in steps of 2^-24 (`f32`) or 2^-53 (`f64`).
    #[inline(always)]
    #[allow(clippy::should_implement_trait, reason = "a stream without an end")]
    pub fn next<T: Real>(&mut self) -> T {
        T::unit_from_bits(self.next_bits())
    }

    /// The next 64 bits.
    #[inline(always)]
    pub(crate) fn next_bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_uniform_and_below_one() {
        let mut stream = Stream::new(7);
        let n = 100_000;
        let (mut sum, mut squares) = (0.0, 0.0);
        for _ in 0..n {
            let u: f32 = stream.next();
            assert!((0.0..1.0).contains(&u));
            sum += f64::from(u);
            squares += f64::from(u) * f64::from(u);
        }
        let n = f64::from(n);
        assert!((sum / n - 0.5).abs() < 4.5 * (1.0 / (12.0 * n)).sqrt());
        assert!((squares / n - 1.0 / 3.0).abs() < 4.5 * (4.0 / (45.0 * n)).sqrt());
    }
}
