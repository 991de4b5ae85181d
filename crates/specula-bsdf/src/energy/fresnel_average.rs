//! Cosine-averaged reflectance, the `F_avg` of multiple scattering.

use crate::fresnel::Reflectance;
use crate::math::{Real, Rgb};

/// `2 int_0^1 F(mu) mu dmu` per channel.
///
/// ```text
/// constant   F
/// Schlick    F0 + (1 - F0) / 21
/// others     Gauss and Jacobi's five points of the weight mu
/// ```
///
/// The rule's error is below 1e-3 for measured metals and F82 (test `rules_are_the_integral`).
#[inline]
pub fn reflectance_average<T: Real>(reflectance: &Reflectance<T>) -> Rgb<T> {
    match reflectance {
        Reflectance::Constant(colour) => *colour,
        Reflectance::Schlick(schlick) => {
            schlick.f0.map(|f0| f0 + (T::ONE - f0) * T::of(1.0 / 21.0))
        }
        other => RULE.iter().fold(Rgb::BLACK, |sum, &[mu, weight]| {
            sum + other.eval(T::of(mu)) * T::of(weight)
        }),
    }
}

/// Nodes and weights of Gauss and Jacobi's rule for `2 int_0^1 f(mu) mu dmu`: exact for polynomials
/// up to degree 9.
const RULE: [[f64; 2]; 5] = [
    [0.098_535_085_798_826, 0.031_495_829_043_385],
    [0.304_535_726_646_364, 0.147_817_740_145_233],
    [0.562_025_189_752_614, 0.292_773_974_169_339],
    [0.801_986_582_126_392, 0.334_349_276_188_739],
    [0.960_190_142_948_531, 0.193_563_180_453_303],
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::{Conductor, F82Tint, Schlick};
    use crate::metals::METALS;

    fn integral(reflectance: &Reflectance<f64>) -> Rgb<f64> {
        let n = 20_000;
        (0..n).fold(Rgb::BLACK, |sum, i| {
            let mu = (f64::from(i) + 0.5) / f64::from(n);
            sum + reflectance.eval(mu) * (2.0 * mu / f64::from(n))
        })
    }

    #[test]
    fn rules_are_the_integral() {
        let mut cases = vec![
            Reflectance::Constant(Rgb::splat(0.3)),
            Reflectance::Schlick(Schlick {
                f0: Rgb::splat(0.04),
            }),
            Reflectance::F82Tint(F82Tint::new(Rgb::splat(0.9), Rgb::splat(0.5))),
        ];
        cases.extend(METALS.iter().map(|metal| {
            Reflectance::Conductor(Conductor {
                eta: metal.eta.into(),
                k: metal.k.into(),
            })
        }));
        assert!(cases.len() > 10);
        for case in &cases {
            let difference = (reflectance_average(case) - integral(case)).map(f64::abs);
            assert!(difference.max_channel() < 1e-3, "{case:?}: {difference:?}");
        }
    }
}
