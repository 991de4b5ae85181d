//! Where the tables of lost energy have their knots: coordinates in `[0, 1]` along which the square
//! root of a loss is smooth.
//!
//! ```text
//! alpha      t(alpha), affine in sqrt(alpha / (alpha + 2)), alpha in [1e-4, 10]
//! azimuth    v = ln(a / l) / ln(h / l),   a^2 = (l^2 x^2 + h^2 y^2) / (x^2 + y^2)
//! cosine     m = 1 - sqrt(1 - sqrt(mu (1 + a) / (mu + a)))
//! ```
//!
//! `a` is the alpha along the view, between the alphas `l < h` along x and y. Off an anisotropic
//! surface the loss changes where `tan phi ~ l / h`: the logarithm has room there at every ratio.
//! For narrow lobes everything happens at `mu ~ a`, for which `m` has room at every alpha, and the
//! inner root makes room for Beckmann's steep loss about normal incidence.
//!
//! Interfaces seen from the denser side have edges besides, along which light begins to pass: where
//! the sine of the view is `eta`, and for a small alpha the view's part along it. With the bend
//!
//! ```text
//! w = y (1 - e) / (y (1 - 2e) + e),   x = 2w - 1,   bend(y, e) = (1 + x sqrt(3 / (2 x^2 + 1))) / 2
//! ```
//!
//! which puts `y = e` in the middle and makes room there, `e = eta^2` (1/2 from the thinner side),
//!
//! ```text
//! azimuth    (v + 1 - bend(x^2 / (x^2 + y^2), e)) / 2
//! cosine     (7 m + 3 bend(mu^2, 1 - e)) / 10
//! ```
//!
//! so that the edges lie at the same place of the tables for every index.

use crate::math::Real;

/// The coordinate of an alpha.
#[inline(always)]
pub fn alpha_coordinate<T: Real>(alpha: T) -> T {
    let root = (alpha / (alpha + T::TWO)).sqrt();
    (root - T::of(ROOT_START)) * T::of(1.0 / (ROOT_END - ROOT_START))
}

/// The alpha of a coordinate.
pub fn alpha_at(t: f64) -> f64 {
    let root = ROOT_START + t * (ROOT_END - ROOT_START);
    let share = root * root;
    2.0 * share / (1.0 - share)
}

/// `sqrt(1e-4 / 2.0001)`.
const ROOT_START: f64 = 0.007_070_891_041_799;
/// `sqrt(10 / 12)`.
const ROOT_END: f64 = 0.912_870_929_175_276_9;

/// The coordinate of a cosine at an alpha along the view.
#[inline(always)]
pub fn cosine_coordinate<T: Real>(cosine: T, alpha: T) -> T {
    let share = cosine * (T::ONE + alpha) / (cosine + alpha);
    T::ONE - (T::ONE - share.sqrt()).safe_sqrt()
}

/// The coordinate of a cosine for an interface.
///
/// * `edge`: see [`edge`].
#[inline(always)]
pub fn interface_cosine_coordinate<T: Real>(cosine: T, alpha: T, edge: T) -> T {
    T::of(0.7) * cosine_coordinate(cosine, alpha)
        + T::of(0.3) * bend(cosine * cosine, T::ONE - edge)
}

/// Two alphas, in ascending order, and which axis is the wider.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AlphaPair<T> {
    low: T,
    high: T,
    /// `(h / l)^2 - 1`.
    excess: T,
    /// `1 / ln((h / l)^2)`.
    per_logarithm: T,
    /// Whether x is the wider axis.
    swapped: bool,
}

/// A view as the tables see it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Azimuth<T> {
    /// Alpha along the view.
    pub alpha: T,
    /// Coordinate of the azimuth.
    pub v: T,
    /// Share of the squared sine along the narrow axis.
    pub narrow: T,
}

impl<T: Real> AlphaPair<T> {
    /// The alphas along x and y, in any order.
    #[inline]
    pub fn new(x: T, y: T) -> Self {
        let (low, high) = (x.at_most(y), x.at_least(y));
        let excess = (high - low) * (high + low) / (low * low);
        Self {
            low,
            high,
            excess,
            // Equal alphas have no azimuth; the floor prevents 0 / 0.
            per_logarithm: T::ONE / ((T::ONE + excess).ln()).at_least(T::EPSILON),
            swapped: x > y,
        }
    }

    /// The smaller and the larger.
    #[inline(always)]
    pub fn ordered(&self) -> (T, T) {
        (self.low, self.high)
    }

    /// Where a view with the tangential part `(x, y)` lies.
    #[inline(always)]
    pub fn azimuth(&self, x: T, y: T) -> Azimuth<T> {
        let (x2, y2) = (x * x, y * y);
        let length2 = x2 + y2;
        let along = T::select(self.swapped, y2, x2);
        // Straight from above, every azimuth has the same value.
        let narrow = T::select(length2 > T::TINY, along / length2, T::HALF);
        let square = T::ONE + self.excess * (T::ONE - narrow);
        Azimuth {
            alpha: self.low * square.sqrt(),
            v: square.ln() * self.per_logarithm,
            narrow,
        }
    }
}

impl<T: Real> Azimuth<T> {
    /// Coordinate of the azimuth for an interface.
    #[inline(always)]
    pub fn interface(&self, edge: T) -> T {
        T::HALF * (self.v + (T::ONE - bend(self.narrow, edge)))
    }
}

/// `e` of an index.
#[inline(always)]
pub fn edge<T: Real>(eta: T) -> T {
    T::select(eta < T::ONE, eta * eta, T::HALF)
}

/// A map of `[0, 1]` to itself that is steepest at `edge` and takes it to the middle.
#[inline(always)]
fn bend<T: Real>(y: T, edge: T) -> T {
    let w = y * (T::ONE - edge) / (y * (T::ONE - T::TWO * edge) + edge);
    let x = T::TWO * w - T::ONE;
    T::HALF + T::HALF * x * (T::of(1.5) / (x * x + T::HALF)).sqrt()
}

/// What the tables of averages are scaled with: smooth, and the quotient varies slowly.
#[inline(always)]
pub fn average_scale<T: Real>(x: T, y: T) -> T {
    let alpha = ((x * x + y * y) * T::HALF).sqrt();
    alpha / (T::ONE + alpha)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_are_ends_and_every_coordinate_rises() {
        assert!(alpha_coordinate(1e-4_f64).abs() < 1e-12);
        assert!((alpha_coordinate(10.0_f64) - 1.0).abs() < 1e-12);
        for alpha in [1e-3, 0.05, 0.7, 4.0] {
            assert!((alpha_at(alpha_coordinate(alpha)) / alpha - 1.0).abs() < 1e-12);
        }
        for (x, y) in [(0.02, 2.0), (0.3, 0.3001), (1.5, 0.05)] {
            for edge in [0.5, 0.1, 0.9_f64] {
                let alphas = AlphaPair::new(x, y);
                let mut before = [-1e-9; 3];
                for i in 0..=200 {
                    let u = f64::from(i) / 200.0;
                    let turn = if x < y { u } else { 1.0 - u };
                    let (sine, cosine) = (turn * core::f64::consts::FRAC_PI_2).sin_cos();
                    let azimuth = alphas.azimuth(cosine, sine);
                    let now = [
                        azimuth.v,
                        azimuth.interface(edge),
                        interface_cosine_coordinate(u, azimuth.alpha, edge),
                    ];
                    for (now, before) in now.into_iter().zip(before) {
                        assert!(now >= before - 1e-9 && now < 1.0 + 1e-9, "{u} {edge}");
                    }
                    before = now;
                }
                assert!(
                    before.iter().all(|end| (end - 1.0).abs() < 1e-6),
                    "{before:?}"
                );
            }
        }
        assert!((bend(0.3_f64, 0.3) - 0.5).abs() < 1e-15);
    }

    #[test]
    fn equal_alphas_and_the_pole_are_finite() {
        let azimuth = AlphaPair::new(0.3_f32, 0.3).azimuth(0.2, 0.1);
        assert!(azimuth.v.is_finite() && azimuth.interface(0.4).is_finite());
        assert!(AlphaPair::new(0.1_f32, 0.3).azimuth(0.0, 0.0).v.is_finite());
    }
}
