//! Azimuthal scattering: around the fibre, a logistic distribution about the direction of a smooth cylinder, trimmed
//! to one turn.
//!
//! ```text
//! N(phi) = l(phi - Phi) / tanh(pi / (2s)),   l(x) = exp(-|x|/s) / (s (1 + exp(-|x|/s))^2),   x in [-pi, pi]
//! Phi = 2 p gamma_t - 2 gamma_o + p pi
//! ```
//!
//! Source: Chiang et al. 2016, sections 3.3 and 4.1; the deflection `Phi` by Marschner et al. 2003.

use crate::math::Real;

/// Scale of the logistic distribution of an azimuthal roughness.
pub(super) fn scale<T: Real>(beta_n: T) -> T {
    /// `sqrt(pi / 8)`.
    const SQRT_PI_8: f64 = 0.626_657_068_657_750_1;
    let b = beta_n.to_f64();
    let b2 = b * b;
    let b4 = b2 * b2;
    let b22 = b2 * b4 * b4 * b4 * b4 * b4;
    T::of(SQRT_PI_8 * (0.265 * b + 1.194 * b2 + 5.372 * b22))
}

/// The azimuth, relative to the viewer's, at which light leaves a smooth cylinder after `p` passages.
pub(super) fn deflection<T: Real>(p: usize, gamma_o: T, gamma_t: T) -> T {
    let p = T::of(p as f64);
    T::TWO * p * gamma_t - T::TWO * gamma_o + p * T::PI
}

/// Density of the azimuth at a distance `x` from the deflection, in turns of any number.
pub(super) fn density<T: Real>(s: T, x: T) -> T {
    let turn = T::TWO * T::PI;
    let within = x - turn * ((x + T::PI) / turn).floor();
    let e = (-within.abs() / s).exp();
    e / (s * (T::ONE + e).squared() * within_one_turn(s))
}

/// Samples a distance from the deflection, in `[-pi, pi]`, with [`density`].
pub(super) fn sample<T: Real>(s: T, u: T) -> T {
    let share = T::HALF * (T::ONE - within_one_turn(s)) + u * within_one_turn(s);
    let x = s * (share / (T::ONE - share).at_least(T::TINY)).ln();
    x.within(-T::PI, T::PI)
}

/// Share of the logistic distribution in `[-pi, pi]`: `tanh(pi / (2s))`.
fn within_one_turn<T: Real>(s: T) -> T {
    let e = (-T::PI / s).exp();
    -(-T::PI / s).exp_m1() / (T::ONE + e)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn densities_integrate_to_one_around_the_fibre() {
        for beta in [0.01, 0.1, 0.3, 0.8, 1.0] {
            let s = scale::<f64>(beta);
            for centre in [0.0, 3.0, -7.5] {
                let n = 100_000;
                let step = core::f64::consts::TAU / f64::from(n);
                let sum: f64 = (0..n)
                    .map(|k| density(s, step * (f64::from(k) + 0.5) - centre) * step)
                    .sum();
                assert!((sum - 1.0).abs() < 1e-4, "{beta}: {sum}");
            }
        }
    }

    /// Samples are quantiles: their share below `x` is the integral of the density up to there.
    #[test]
    fn samples_are_quantiles_of_the_density() {
        for beta in [0.05, 0.3, 1.0] {
            let s = scale::<f64>(beta);
            let n = 20_000;
            let mut share = 0.0;
            let step = core::f64::consts::TAU / f64::from(n);
            for k in 0..n {
                let x = -core::f64::consts::PI + step * (f64::from(k) + 0.5);
                share += 0.5 * step * density(s, x);
                if k % 500 == 250 && share > 1e-6 && share < 1.0 - 1e-6 {
                    let found = sample(s, share);
                    assert!((found - x).abs() < 1e-3, "{beta}: {found} {x}");
                }
                share += 0.5 * step * density(s, x);
            }
            for u in [0.0, 1.0] {
                let end = sample(s, u).abs();
                assert!((end - core::f64::consts::PI).abs() < 1e-5, "{beta}: {end}");
            }
        }
    }
}
