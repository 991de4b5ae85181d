//! Large tables of spline coefficients, read as the text that they are stored in.
//!
//! Two digits to the base 94 are two characters, and a row is a line: decoding a coefficient costs a
//! multiplication, and compiling the crate nothing.

use super::spline::Spline;
use crate::math::Real;

/// Rows of `N` coefficients of two digits each.
#[derive(Clone, Copy, Debug)]
pub struct Rows<'a, const N: usize> {
    text: &'a [u8],
}

/// Smallest coefficient. Splines that bend at an end need some outside of the values' range.
pub const LOW: f64 = -2.0;
/// Largest coefficient.
pub const HIGH: f64 = 3.0;
/// Smallest coefficient of the averages' tables.
pub const AVERAGE_LOW: f64 = -4.0;
/// Largest coefficient of the averages' tables.
pub const AVERAGE_HIGH: f64 = 12.0;
/// Largest code of two digits.
const LARGEST: f64 = 8835.0;
/// The digits of 0, `!!`, as they are read.
const ZERO: f64 = 33.0 * 95.0;

impl<'a, const N: usize> Rows<'a, N> {
    /// The table of a text.
    ///
    /// # Panics
    /// Where the text is not `rows` lines of `2 N` characters. A text with other line ends is none.
    pub const fn new(text: &'a [u8], rows: usize) -> Self {
        assert!(text.len() == rows * (2 * N + 1), "rows of another length");
        assert!(text[2 * N] == b'\n', "lines of another length");
        Self { text }
    }

    /// A row's sum, as values from which [`Self::coefficient`] makes a value.
    #[inline(always)]
    pub fn sum<T: Real, const K: usize>(&self, row: usize, stencil: &Spline<T, K>) -> T {
        let start = row * (2 * N + 1) + 2 * stencil.first();
        let (digits, _) = self.text[start..start + 2 * K].as_chunks::<2>();
        let mut sum = T::ZERO;
        for (&[first, second], &weight) in digits.iter().zip(stencil.weights()) {
            let code = u16::from(first) * 94 + u16::from(second);
            sum += weight * T::of(f64::from(code));
        }
        sum
    }

    /// All coefficients, row by row.
    pub fn values(&self) -> impl Iterator<Item = f32> + use<'a, N> {
        self.text.chunks(2 * N + 1).flat_map(|line| {
            line[..2 * N].as_chunks::<2>().0.iter().map(|digits| {
                let [first, second] = digits.map(f64::from);
                #[allow(clippy::cast_possible_truncation, reason = "rounding is meant")]
                let code = Self::coefficient(first * 94.0 + second) as f32;
                code
            })
        })
    }

    /// The value of a sum of values whose weights sum to 1.
    #[inline(always)]
    pub fn coefficient<T: Real>(sum: T) -> T {
        const SCALE: f64 = (HIGH - LOW) / LARGEST;
        sum * T::of(SCALE) + T::of(LOW - ZERO * SCALE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_read() {
        // 0, 1, 94 and the largest; then the same from the end.
        let rows = Rows::<4>::new(b"!!!\"\"!~~\n~~\"!!\"!!\n", 2);
        let stencil = Spline::cubic(0.0_f64, 4);
        let [a, b, c, d] = *stencil.weights();
        let expected = b + 94.0 * c + 8835.0 * d;
        let step = (HIGH - LOW) / LARGEST;
        let got = Rows::<4>::coefficient(rows.sum(0, &stencil));
        assert!((got - (LOW + step * expected)).abs() < 1e-12);
        let expected = 8835.0 * a + 94.0 * b + c;
        let got = Rows::<4>::coefficient(rows.sum(1, &stencil));
        assert!((got - (LOW + step * expected)).abs() < 1e-12);
    }
}
