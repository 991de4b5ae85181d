//! Sums that do not depend on the order of their terms, so that a picture does not depend on how its
//! samples were split among runs and machines.

/// A sum of two `f64`: what rounding takes from the first is stored in the second (Knuth's two-sum).
///
/// Exact, and so the same in any order, as long as the terms' bits span less than about a hundred
/// binary digits: 24 of an `f32`, 48 of its square, the rest for their range and count.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Sum {
    high: f64,
    low: f64,
}

impl Sum {
    #[inline(always)]
    pub(crate) fn add(&mut self, term: f64) {
        let sum = self.high + term;
        let virtual_term = sum - self.high;
        let lost = (self.high - (sum - virtual_term)) + (term - virtual_term);
        self.high = sum;
        self.low += lost;
    }

    pub(crate) fn merge(&mut self, other: Self) {
        self.add(other.high);
        self.low += other.low;
    }

    /// Adds `units * 2^exponent`, and gives the sum the one form that its value has: the nearest `f64`,
    /// and the rest.
    pub(crate) fn add_units(&mut self, units: i128, exponent: i32) {
        // 53 bits or fewer each, so that they are exact.
        const BITS: i32 = 43;
        let part = |i: i32| {
            let bits = (units.unsigned_abs() >> (BITS * i)) & ((1 << BITS) - 1);
            bits as f64 * power_of_two(exponent + BITS * i)
        };
        for i in [2, 1, 0] {
            let magnitude = part(i);
            self.add(if units < 0 { -magnitude } else { magnitude });
        }
        let rest = std::mem::take(&mut self.low);
        self.add(rest);
    }

    pub(crate) fn value(self) -> f64 {
        self.high + self.low
    }

    pub(crate) fn words(self) -> [u64; 2] {
        [self.high.to_bits(), self.low.to_bits()]
    }

    pub(crate) fn from_words([high, low]: [u64; 2]) -> Self {
        Self {
            high: f64::from_bits(high),
            low: f64::from_bits(low),
        }
    }
}

/// A sum of values of the order of 1 (colours of surfaces, directions) in units of 2^-30: exact for
/// 2^31 of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct FixedSum(i64);

impl FixedSum {
    const UNIT: f64 = 1.0 / (1 << 30) as f64;

    /// Rounds to the nearest unit, halves away from 0. NaN counts as 0, and what is beyond 2^8 as that.
    #[inline(always)]
    pub(crate) fn add(&mut self, term: f32) {
        // As bits of a number between 2^52 and 2^53, whose last bit is 1: few processors convert several at a time.
        const ONES: f64 = (1_u64 << 52) as f64;
        const MOST: f64 = (1_u64 << 38) as f64;
        let units = f64::from(term.abs()) / Self::UNIT;
        let units = if units < MOST { units } else { MOST };
        // A sum of a number of 24 bits and a half is exact where it is close to a whole one.
        let whole = (units + 0.5).floor() + ONES;
        let units = (whole.to_bits() - ONES.to_bits()).cast_signed();
        let units = if term < 0.0 { -units } else { units };
        let units = if term.is_nan() { 0 } else { units };
        // Below 2^63 for 2^25 terms.
        self.0 = self.0.wrapping_add(units);
    }

    pub(crate) fn merge(&mut self, other: Self) {
        self.0 = self.0.saturating_add(other.0);
    }

    pub(crate) fn add_units(&mut self, units: i64) {
        self.0 = self.0.saturating_add(units);
    }

    pub(crate) fn value(self) -> f64 {
        self.0 as f64 * Self::UNIT
    }

    pub(crate) fn word(self) -> u64 {
        self.0.cast_unsigned()
    }

    pub(crate) fn from_word(word: u64) -> Self {
        Self(word.cast_signed())
    }
}

/// `2^exponent`, of a normal number.
fn power_of_two(exponent: i32) -> f64 {
    let biased = u64::try_from(1023 + exponent.clamp(-1022, 1023)).unwrap_or(0);
    f64::from_bits(biased << 52)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers of 24 bits over sixty binary places, by a fixed recurrence.
    fn numbers() -> Vec<f64> {
        let mut state = 1_u64;
        (0..10_000)
            .map(|_| {
                state = state
                    .wrapping_mul(6_364_136_223_846_793_005)
                    .wrapping_add(1);
                let mantissa = (state >> 40) as f64;
                let exponent = i32::try_from(state >> 32 & 31).unwrap() - 16;
                mantissa * 2.0_f64.powi(exponent)
            })
            .collect()
    }

    #[test]
    fn sums_are_the_same_in_any_order_and_split() {
        let numbers = numbers();
        let sum = |terms: &mut dyn Iterator<Item = &f64>| {
            let mut sum = Sum::default();
            terms.for_each(|&t| {
                sum.add(t);
                sum.add(t * t * 1e-3_f32 as f64);
            });
            sum
        };
        let forwards = sum(&mut numbers.iter());
        assert_eq!(
            forwards.value().to_bits(),
            sum(&mut numbers.iter().rev()).value().to_bits()
        );
        let mut halves = sum(&mut numbers[..3333].iter());
        halves.merge(sum(&mut numbers[3333..].iter()));
        assert_eq!(forwards.value().to_bits(), halves.value().to_bits());
        assert_eq!(Sum::from_words(halves.words()), halves);
        // The test can fail: plain addition depends on the order.
        let plain =
            |terms: &mut dyn Iterator<Item = &f64>| terms.map(|t| t * t * 1e-3).sum::<f64>();
        assert_ne!(
            plain(&mut numbers.iter()).to_bits(),
            plain(&mut numbers.iter().rev()).to_bits()
        );
    }

    #[test]
    #[allow(clippy::cast_possible_truncation, reason = "whole numbers below 2^56")]
    fn whole_sums_are_the_same_however_they_are_split() {
        // Units of 2^-60, the terms' lowest bits.
        let units: Vec<i128> = numbers()
            .iter()
            .zip(0..)
            .map(|(&x, i)| {
                let whole = (x * 2.0_f64.powi(16)) as i64;
                let units = i128::from(whole) << 44;
                if i % 3 == 0 { -units } else { units }
            })
            .collect();
        let sum = |runs: usize| {
            let mut sum = Sum::default();
            for run in units.chunks(runs) {
                sum.add_units(run.iter().sum(), -60);
            }
            sum
        };
        let one_by_one = sum(1);
        for runs in [7, 64, 10_000] {
            // To the last bit of both parts, not their value only.
            assert_eq!(sum(runs), one_by_one, "{runs}");
        }
        let mut plain = Sum::default();
        for (&x, i) in numbers().iter().zip(0..) {
            plain.add(if i % 3 == 0 { -x } else { x });
        }
        assert_eq!(plain.value().to_bits(), one_by_one.value().to_bits());
    }

    #[test]
    fn fixed_sums_round_to_a_billionth() {
        let (mut sum, mut expected) = (FixedSum::default(), 0.0);
        for i in 0..1000_u16 {
            let term = f32::from(i) * 1e-3;
            sum.add(term);
            expected += f64::from(term);
        }
        sum.add(f32::NAN);
        assert!((sum.value() - expected).abs() < 1000.0 * FixedSum::UNIT);
        let mut twice = sum;
        twice.merge(sum);
        assert_eq!(twice.value(), 2.0 * sum.value());
        assert_eq!(FixedSum::from_word(sum.word()), sum);
        sum.add(-100.0);
        assert_eq!(FixedSum::from_word(sum.word()), sum);
        let units = |term: f32| {
            let mut sum = FixedSum::default();
            sum.add(term);
            sum.0
        };
        let unit = 2.0_f32.powi(-30);
        for (term, expected) in [(0.49, 0), (0.5, 1), (1.49, 1), (2.5, 3), (1e-30, 0)] {
            assert_eq!(units(term * unit), expected, "{term}");
            assert_eq!(units(-term * unit), -expected, "{term}");
        }
        // As many units as an `f32` has digits, and beyond the bound.
        assert_eq!(units(16_777_215.0 * unit), 16_777_215);
        assert_eq!(units(f32::INFINITY), 1 << 38);
        assert_eq!(units(-300.0), -(1 << 38));
    }
}
