//! The lost energy of isotropic GGX as short formulas, for shaders that hold no table.
//!
//! ```text
//! p = sqrt(mu (1 + alpha) / (mu + alpha)),   m = 1 - sqrt(1 - p),   q = alpha / (1 + alpha)
//! sqrt(1 - E)     = alpha p / (mu + alpha) sum_j sum_i c_ji (2 m - 1)^i (4 q - 1)^j,   i < 8, j < 5
//! sqrt(1 - E_avg) = q sum_i a_i q^(i / 4),                                             i < 6
//! ```
//!
//! for height-correlated masking and alpha in `[1e-4, 1]`: error of E at most 8e-4 (test `the_fit_holds_its_bound`).
//! The factor is the root's own behaviour where little is lost: at the horizon, where it falls as `m`, and far above
//! it, where it falls as `alpha / mu`. The average is that of the fit, not of the surface, to 2.5e-3 of itself, so that
//! what Kulla and Conty's lobe adds is what the fit says is lost.
//!
//! Coefficients: `cargo xtask tables`.

use super::fit_coefficients::{AVERAGE, DIRECTIONAL};
use crate::math::Real;

/// Powers of `2 m - 1`.
pub const POWERS_OF_COSINE: usize = 8;
/// Powers of `4 q - 1`.
pub const POWERS_OF_ALPHA: usize = 5;
/// Powers of `q^(1/4)`.
pub const POWERS_OF_AVERAGE: usize = 6;

/// `1 - E(mu)` of height-correlated isotropic GGX, in `[0, 1]`.
///
/// * `alpha`: in `[1e-4, 1]`; beyond, the nearest is taken.
/// * `cosine`: in `[0, 1]`.
#[inline]
pub fn ggx_loss<T: Real>(alpha: T, cosine: T) -> T {
    let [x, y, factor] = coordinates(alpha, cosine);
    let row = |powers: [f64; POWERS_OF_COSINE]| horner(powers.map(T::of), x);
    let root = factor * horner(DIRECTIONAL.map(row), y);
    (root * root).at_most(T::ONE)
}

/// `1 - E_avg` of [`ggx_loss`], in `(0, 1]`: its integral over the hemisphere by the cosine, over pi.
///
/// * `alpha`: in `[1e-4, 1]`; beyond, the nearest is taken.
#[inline]
pub fn ggx_average_loss<T: Real>(alpha: T) -> T {
    let alpha = held(alpha);
    let q = alpha / (T::ONE + alpha);
    let root = q * horner(AVERAGE.map(T::of), q.sqrt().sqrt());
    root * root
}

/// `2 m - 1`, `4 q - 1`, and the factor of the directional root.
#[inline(always)]
pub fn coordinates<T: Real>(alpha: T, cosine: T) -> [T; 3] {
    let alpha = held(alpha);
    let inverse = T::ONE / (cosine + alpha);
    let p = (cosine * (T::ONE + alpha) * inverse).sqrt();
    // 1 - p without cancellation.
    let rest = alpha * inverse * (T::ONE - cosine) / (T::ONE + p);
    let x = T::ONE - T::TWO * rest.safe_sqrt();
    let y = T::of(4.0) * alpha / (T::ONE + alpha) - T::ONE;
    [x, y, alpha * inverse * p]
}

#[inline(always)]
fn held<T: Real>(alpha: T) -> T {
    alpha.within(T::of(1e-4), T::ONE)
}

#[inline(always)]
fn horner<T: Real, const N: usize>(coefficients: [T; N], x: T) -> T {
    let highest_first = coefficients.into_iter().rev();
    highest_first.fold(T::ZERO, |sum, c| sum * x + c)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::alpha::Alpha;
    use crate::energy::Loss;
    use crate::math::vec3;
    use crate::ndf::{Ggx, Masking};

    /// Alphas, dense where they are small.
    fn alphas() -> impl Iterator<Item = f64> {
        (0..=200).map(|i| 1e-4 + (f64::from(i) / 200.0).powi(3) * (1.0 - 1e-4))
    }

    #[test]
    fn the_fit_holds_its_bound() {
        let mut worst = 0.0_f64;
        let mut squares = 0.0;
        for alpha in alphas() {
            let loss = Loss::new(Ggx::new(Alpha::isotropic(alpha)), Masking::default());
            for k in 0..=400 {
                let cosine = (f64::from(k) / 400.0).powi(4);
                let wo = vec3((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
                let error = (ggx_loss(alpha, cosine) - loss.directional(wo)).abs();
                assert!(error < 8e-4, "{alpha} {cosine}: {error}");
                worst = worst.max(error);
                squares += error * error / (201.0 * 401.0);
            }
        }
        println!("largest error {worst:.1e}, rms {:.1e}", squares.sqrt());
        assert!(worst > 1e-4, "the comparison compares nothing");
        // The same in f32, where a shader runs.
        let single = f64::from(ggx_loss(0.37_f32, 0.21));
        assert!((single - ggx_loss(0.37, 0.21)).abs() < 1e-5);
    }

    #[test]
    fn the_average_is_that_of_the_fit() {
        let (mut worst, mut from_surface) = (0.0_f64, 0.0_f64);
        for alpha in alphas() {
            let n = 4000;
            let mean = (0..n).fold(0.0, |sum, i| {
                // With mu = t^4, 2 mu dmu is 8 t^7 dt.
                let t = (f64::from(i) + 0.5) / f64::from(n);
                sum + ggx_loss(alpha, t.powi(4)) * 8.0 * t.powi(7) / f64::from(n)
            });
            let quotient = ggx_average_loss(alpha) / mean;
            worst = worst.max((quotient - 1.0).abs());
            let loss = Loss::new(Ggx::new(Alpha::isotropic(alpha)), Masking::default());
            from_surface = from_surface.max((mean - loss.average()).abs());
        }
        println!(
            "largest relative error {worst:.1e}; from the surface's average {from_surface:.1e}"
        );
        assert!(worst < 2.5e-3, "{worst}");
        assert!(from_surface > 1e-6 && from_surface < 4e-4, "{from_surface}");
    }
}
