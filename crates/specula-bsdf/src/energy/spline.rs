//! Neighbouring coefficients of a uniform B-spline, and their weights.
//!
//! A B-spline through the knots' values has a ninth of the error of Lagrange's cubic through the
//! nearest four, at the same cost and from as many values: its coefficients know all knots. Weights
//! are positive and sum to 1, so that rounded coefficients leave no larger error than one of them.

use crate::math::Real;

/// Where a place of `[0, 1]` lies among the coefficients of an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spline<T, const N: usize> {
    first: u16,
    weights: [T; N],
}

/// Four coefficients: error of the fourth order, two continuous derivatives.
pub type Cubic<T> = Spline<T, 4>;

/// Three coefficients: error of the third order, one continuous derivative.
pub type Quadratic<T> = Spline<T, 3>;

impl<T: Real> Spline<T, 4> {
    /// The coefficients about `x`, clamped to `[0, 1]`, among `count >= 4` coefficients.
    #[inline(always)]
    pub fn cubic(x: T, count: usize) -> Self {
        let (first, weights) = Self::cubic_numbers(x, count);
        Self::of_numbers(first, weights)
    }

    /// The first index and the weights of [`cubic`](Self::cubic), as numbers of a batch.
    #[inline(always)]
    pub(crate) fn cubic_numbers(x: T, count: usize) -> (T, [T; 4]) {
        let (first, t) = cell(x, count - 3);
        let u = T::ONE - t;
        let (t2, u2) = (t * t, u * u);
        let (sixth, two_thirds) = (T::of(1.0 / 6.0), T::of(2.0 / 3.0));
        let weights = [
            u2 * u * sixth,
            two_thirds - t2 * (T::ONE - T::HALF * t),
            two_thirds - u2 * (T::ONE - T::HALF * u),
            t2 * t * sixth,
        ];
        (first, weights)
    }
}

impl<T: Real> Spline<T, 3> {
    /// The coefficients about `x`, clamped to `[0, 1]`, among `count >= 3` coefficients.
    #[inline(always)]
    pub fn quadratic(x: T, count: usize) -> Self {
        let (first, t) = cell(x, count - 2);
        let u = T::ONE - t;
        let weights = [T::HALF * u * u, T::HALF + t * u, T::HALF * t * t];
        Self::of_numbers(first, weights)
    }
}

/// The index of the interval among `cells` that holds `x`, and the place in it.
#[inline(always)]
fn cell<T: Real>(x: T, cells: usize) -> (T, T) {
    #[allow(clippy::cast_precision_loss, reason = "some dozen cells")]
    let end = T::of(cells as f64);
    let place = (x * end).within(T::ZERO, end);
    let first = place.floor_of_small().at_most(end - T::ONE);
    (first, place - first)
}

impl<T: Real, const N: usize> Spline<T, N> {
    /// * `first`: an index.
    #[inline(always)]
    pub(crate) fn of_numbers(first: T, weights: [T; N]) -> Self {
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "an index of an axis"
        )]
        let first = first.truncated() as u16;
        Self { first, weights }
    }

    /// Index of the first coefficient.
    #[inline(always)]
    pub fn first(&self) -> usize {
        usize::from(self.first)
    }

    /// Weights of the coefficients from the first on.
    #[inline(always)]
    pub fn weights(&self) -> &[T; N] {
        &self.weights
    }

    /// The weighted sum of the values of the coefficients.
    #[inline(always)]
    pub fn sum(&self, value: impl Fn(usize) -> T) -> T {
        let mut sum = T::ZERO;
        for (k, &weight) in self.weights.iter().enumerate() {
            sum += weight * value(self.first() + k);
        }
        sum
    }

    /// [`sum`](Self::sum) over the elements of an array, which are checked to be there once.
    #[inline(always)]
    pub(crate) fn sum_of<E, const M: usize>(&self, all: &[E; M], value: impl Fn(&E) -> T) -> T {
        let mut sum = T::ZERO;
        let Some(near) = all[self.first()..].first_chunk::<N>() else {
            // A place on another axis.
            return sum;
        };
        for (element, &weight) in near.iter().zip(&self.weights) {
            sum += weight * value(element);
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[allow(clippy::cast_precision_loss, reason = "ten coefficients")]
    fn index(i: usize) -> f64 {
        i as f64
    }

    #[test]
    fn weights_sum_to_one_and_lines_are_met() {
        // The coefficient i of N stands for the place i - (N - 2) / 2 in cells.
        for i in 0..=100 {
            let x = f64::from(i) / 100.0;
            let cubic = Spline::cubic(x, 10);
            assert!((cubic.weights().iter().sum::<f64>() - 1.0).abs() < 1e-15);
            assert!((cubic.sum(|i| (index(i) - 1.0) / 7.0) - x).abs() < 1e-14);
            let quadratic = Spline::quadratic(x, 10);
            assert!((quadratic.weights().iter().sum::<f64>() - 1.0).abs() < 1e-15);
            assert!((quadratic.sum(|i| (index(i) - 0.5) / 8.0) - x).abs() < 1e-14);
        }
    }

    #[test]
    fn nothing_breaks_outside() {
        let square = |i: usize| index(i) * index(i);
        for x in [-3.0, f64::NEG_INFINITY] {
            assert_eq!(Spline::cubic(x, 10), Spline::cubic(0.0, 10));
        }
        assert_eq!(Spline::quadratic(7.0, 10), Spline::quadratic(1.0, 10));
        assert!(Spline::cubic(f64::NAN, 10).sum(square).is_finite());
        assert!(Spline::quadratic(f64::NAN, 10).sum(square).is_finite());
    }
}
