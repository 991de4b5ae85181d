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
        let weights = weights(place - T::of_integer(first));
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped to the axis above"
        )]
        let first = first as u16;
        Self { first, weights }
    }

    /// The first index and the weights of [`new`](Self::new), as numbers of a batch.
    #[inline(always)]
    pub(crate) fn numbers(x: T, count: usize) -> (T, [T; 4]) {
        #[allow(clippy::cast_precision_loss, reason = "some dozen knots")]
        let last = T::of((count - 1) as f64);
        let place = (x * last).within(T::ZERO, last);
        let first = (place.floor_of_small() - T::ONE).within(T::ZERO, last - T::of(3.0));
        (first, weights(place - first))
    }

    /// What [`numbers`](Self::numbers) returned.
    #[inline(always)]
    pub(crate) fn of_numbers(first: T, weights: [T; 4]) -> Self {
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "an index of an axis"
        )]
        let first = first.truncated() as u16;
        Self { first, weights }
    }

    /// The weighted sum of the values at the four knots.
    #[inline(always)]
    pub fn sum(&self, value: impl Fn(usize) -> T) -> T {
        let first = usize::from(self.first);
        let [a, b, c, d] = self.weights;
        (a * value(first) + b * value(first + 1)) + (c * value(first + 2) + d * value(first + 3))
    }

    /// [`sum`](Self::sum) over the elements of an array, which are checked to be there once.
    #[inline(always)]
    pub(crate) fn sum_of<E, const N: usize>(&self, all: &[E; N], value: impl Fn(&E) -> T) -> T {
        let near = all[usize::from(self.first)..].first_chunk::<4>();
        let Some([p, q, r, s]) = near else {
            // A stencil of another axis.
            return T::ZERO;
        };
        let [a, b, c, d] = self.weights;
        (a * value(p) + b * value(q)) + (c * value(r) + d * value(s))
    }

    /// [`sum`](Self::sum) of a row's values, without an address.
    #[inline(always)]
    pub(crate) fn sum_in<const N: usize>(&self, row: &[T; N]) -> T {
        let [p, q, r, s] = neighbours(row, usize::from(self.first));
        let [a, b, c, d] = self.weights;
        (a * p + b * q) + (c * r + d * s)
    }
}

/// Lagrange's weights of the knots 0 to 3 at `a`.
#[inline(always)]
fn weights<T: Real>(a: T) -> [T; 4] {
    let (b, c, d) = (a - T::ONE, a - T::TWO, a - T::of(3.0));
    let (sixth, half) = (T::of(1.0 / 6.0), T::HALF);
    [
        -b * c * d * sixth,
        a * c * d * half,
        -a * b * d * half,
        a * b * c * sixth,
    ]
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
            let (first, weights) = Stencil::numbers(x, 10);
            assert_eq!(Stencil::of_numbers(first, weights), Stencil::new(x, 10));
        }
        assert!((Stencil::new(-3.0, 10).sum(at) - cubic(0.0)).abs() < 1e-14);
        assert!((Stencil::new(7.0, 10).sum(at) - cubic(1.0)).abs() < 1e-13);
        assert!(Stencil::new(f64::NAN, 10).sum(at).is_finite());
    }
}
