//! Four neighbouring knots of a uniform axis, with Lagrange's cubic weights.

use super::neighbours::neighbours;
use crate::math::Real;

/// Where a place lies among the knots of `[0, 1]`.
///
/// The interpolant is continuous and exact at the knots; its error falls with the fourth power of
/// the knots' distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stencil<T> {
    first: u16,
    weights: [T; 4],
}

impl<T: Real> Stencil<T> {
    /// The stencil of `x`, clamped to `[0, 1]`, among `count >= 4` knots.
    #[inline(always)]
    pub fn new(x: T, count: usize) -> Self {
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_possible_wrap,
            reason = "some dozen knots"
        )]
        let count = count as i32;
        let last = T::of_integer(count - 1);
        let place = (x * last).within(T::ZERO, last);
        let first = (place.truncated() - 1).max(0).min(count - 4);
        let a = place - T::of_integer(first);
        let (b, c, d) = (a - T::ONE, a - T::TWO, a - T::of(3.0));
        let (sixth, half) = (T::of(1.0 / 6.0), T::HALF);
        let weights = [
            -b * c * d * sixth,
            a * c * d * half,
            -a * b * d * half,
            a * b * c * sixth,
        ];
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped to the axis above"
        )]
        let first = first as u16;
        Self { first, weights }
    }

    /// The weighted sum of the values at the four knots.
    #[inline(always)]
    pub fn sum(&self, value: impl Fn(usize) -> T) -> T {
        let first = usize::from(self.first);
        let [a, b, c, d] = self.weights;
        (a * value(first) + b * value(first + 1)) + (c * value(first + 2) + d * value(first + 3))
    }

    /// [`sum`](Self::sum) of a row's values, without an address.
    #[inline(always)]
    pub(crate) fn sum_in<const N: usize>(&self, row: &[T; N]) -> T {
        let [p, q, r, s] = neighbours(row, usize::from(self.first));
        let [a, b, c, d] = self.weights;
        (a * p + b * q) + (c * r + d * s)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cubics_are_met_everywhere_and_the_ends_are_held() {
        let cubic = |x: f64| 1.0 - 2.0 * x + 3.0 * x * x - 5.0 * x * x * x;
        #[allow(clippy::cast_precision_loss, reason = "ten knots")]
        let at = |i: usize| cubic(i as f64 / 9.0);
        for i in 0..=100 {
            let x = f64::from(i) / 100.0;
            let got = Stencil::new(x, 10).sum(at);
            assert!((got - cubic(x)).abs() < 1e-13, "{x}");
        }
        assert!((Stencil::new(-3.0, 10).sum(at) - cubic(0.0)).abs() < 1e-14);
        assert!((Stencil::new(7.0, 10).sum(at) - cubic(1.0)).abs() < 1e-13);
        assert!(Stencil::new(f64::NAN, 10).sum(at).is_finite());
    }
}
