//! Longitudinal scattering: along the fibre, a von Mises-Fisher distribution about the mirrored inclination, its
//! azimuth integrated out.
//!
//! ```text
//! M(theta_o, theta_i) = exp(-sin_i sin_o / v) I0(cos_i cos_o / v) / (2 v sinh(1/v))
//!                     = exp(-((cos_i - cos_o)^2 + (sin_i + sin_o)^2) / (2v)) I0(a) exp(-a) / (v (1 - exp(-2/v)))
//! a = cos_i cos_o / v
//! ```
//!
//! The second form follows from the first with `2 sinh(1/v) = exp(1/v) (1 - exp(-2/v))` and
//! `cos_i cos_o - sin_i sin_o - 1 = -((cos_i - cos_o)^2 + (sin_i + sin_o)^2) / 2`. Nothing in it overflows or cancels,
//! so that one form serves every variance.
//!
//! Source: d'Eon et al. 2011, "An Energy-Conserving Hair Reflectance Model"; its sampling by d'Eon et al. 2013,
//! "Importance Sampling for Physically-Based Hair Fiber Models"; variances by Chiang et al. 2016, section 4.1.

use crate::math::Real;

/// Sine and cosine of an inclination: of the angle to the plane across the fibre, in `[-pi/2, pi/2]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Inclination<T> {
    pub(super) sin: T,
    pub(super) cos: T,
}

/// Variance of the lobe R of a longitudinal roughness.
pub(super) fn variance<T: Real>(beta_m: T) -> T {
    let b = beta_m.to_f64();
    let b4 = b * b * b * b;
    let b20 = b4 * b4 * b4 * b4 * b4;
    let root = 0.726 * b + 0.812 * b * b + 3.7 * b20;
    T::of(root * root)
}

/// Density of the inclination `i`, over `cos_i d theta_i`.
pub(super) fn density<T: Real>(v: T, i: Inclination<T>, o: Inclination<T>) -> T {
    let [across, along] = [i.cos - o.cos, i.sin + o.sin];
    let apart = across * across + along * along;
    let scale = v * -(-T::TWO / v).exp_m1();
    (-apart / (T::TWO * v)).exp() * scaled_bessel(i.cos * o.cos / v) / scale
}

/// Samples the inclination with [`density`].
pub(super) fn sample<T: Real>(v: T, o: Inclination<T>, u: [T; 2]) -> Inclination<T> {
    let left = (-T::TWO / v).exp();
    // 1 - cos of the angle to the mean, which keeps its digits where that is small.
    let rest = -v * (u[0] + (T::ONE - u[0]) * left).ln();
    let rest = rest.within(T::ZERO, T::TWO);
    let (cos, sin) = (T::ONE - rest, (rest * (T::TWO - rest)).safe_sqrt());
    let (sin_turn, cos_turn) = u[1].sin_cos_turns();
    let forward = cos * o.cos + sin * cos_turn * o.sin;
    let aside = sin * sin_turn;
    Inclination {
        sin: sin * cos_turn * o.cos - cos * o.sin,
        cos: (forward * forward + aside * aside).sqrt(),
    }
}

/// `I0(a) exp(-a)`, the modified Bessel function, for `a >= 0`; relative error below 5e-7.
///
/// Source: Abramowitz and Stegun 1964, 9.8.1 and 9.8.2.
fn scaled_bessel<T: Real>(a: T) -> T {
    const SPLIT: f64 = 3.75;
    let small = a < T::of(SPLIT);
    let t = T::select(small, a / T::of(SPLIT), T::of(SPLIT) / a);
    let polynomial = |coefficients: &[f64], x: T| {
        let mut sum = T::ZERO;
        for c in coefficients.iter().rev() {
            sum = sum * x + T::of(*c);
        }
        sum
    };
    if small {
        polynomial(&NEAR, t * t) * (-a).exp()
    } else {
        polynomial(&FAR, t) / a.sqrt()
    }
}

/// Of `I0(a)` by powers of `(a / 3.75)^2`.
const NEAR: [f64; 7] = [
    1.0,
    3.515_622_9,
    3.089_942_4,
    1.206_749_2,
    0.265_973_2,
    0.036_076_8,
    0.004_581_3,
];

/// Of `sqrt(a) exp(-a) I0(a)` by powers of `3.75 / a`.
const FAR: [f64; 9] = [
    0.398_942_28,
    0.013_285_92,
    0.002_253_19,
    -0.001_575_65,
    0.009_162_81,
    -0.020_577_06,
    0.026_355_37,
    -0.016_476_33,
    0.003_923_77,
];

#[cfg(test)]
mod tests {
    use super::*;

    /// `I0(a) exp(-a)` as the mean of `exp(a (cos x - 1))`: the trapezoidal rule of a periodic function.
    fn mean_of_exponentials(a: f64) -> f64 {
        let n = 4096;
        let at = |i: i32| {
            (a * ((f64::from(i) / f64::from(n) * core::f64::consts::TAU).cos() - 1.0)).exp()
        };
        (0..n).map(at).sum::<f64>() / f64::from(n)
    }

    #[test]
    fn bessel_is_its_integral() {
        for i in 0..200 {
            let a = 0.05 * f64::from(i) * (1.0 + 0.5 * f64::from(i));
            let (found, expected) = (scaled_bessel(a), mean_of_exponentials(a));
            assert!(
                (found / expected - 1.0).abs() < 5e-7,
                "{a}: {found} {expected}"
            );
        }
    }

    fn inclination(theta: f64) -> Inclination<f64> {
        Inclination {
            sin: theta.sin(),
            cos: theta.cos(),
        }
    }

    /// Variances of both forms: where `sinh(1/v)` does not overflow the two are one.
    #[test]
    fn the_form_without_overflow_is_the_paper_s() {
        for v in [0.05, 0.2, 1.0, 27.0, 110.0] {
            for (o, i) in [(0.3, -0.2), (1.2, -1.5), (-0.7, 0.9)] {
                let (o, i) = (inclination(o), inclination(i));
                let a = i.cos * o.cos / v;
                let bessel = mean_of_exponentials(a) * a.exp();
                let plain = (-i.sin * o.sin / v).exp() * bessel / (2.0 * v * (1.0 / v).sinh());
                let found = density(v, i, o);
                assert!((found / plain - 1.0).abs() < 1e-6, "{v}: {found} {plain}");
            }
        }
    }

    #[test]
    fn densities_integrate_to_one_for_every_variance() {
        for beta in [0.01, 0.05, 0.3, 0.7, 1.0] {
            for scale in [0.25, 1.0, 4.0] {
                let v = scale * variance::<f64>(beta);
                for theta_o in [-1.57, -0.8, 0.0, 0.4, 1.5] {
                    let o = inclination(theta_o);
                    // The midpoint rule about the mirrored inclination, 12 deviations to each side.
                    let reach = (12.0 * v.sqrt()).min(core::f64::consts::PI);
                    let n = 20_000;
                    let step = 2.0 * reach / f64::from(n);
                    let sum: f64 = (0..n)
                        .map(|k| -theta_o - reach + step * (f64::from(k) + 0.5))
                        .filter(|theta| theta.abs() < core::f64::consts::FRAC_PI_2)
                        .map(|theta| density(v, inclination(theta), o) * theta.cos() * step)
                        .sum();
                    assert!((sum - 1.0).abs() < 1e-4, "{v}, {theta_o}: {sum}");
                }
            }
        }
    }
}
