//! Visible Beckmann normals by inversion (Heitz and d'Eon 2014; Jakob 2014).
//!
//! In the space of unit roughness, turned so that the view lies in the x-z plane, the slopes
//! `(x, y)` seen from a view with `a = cot theta` are independent:
//!
//! ```text
//! p(y) = exp(-y^2) / sqrt(pi),      p(x) ~ (a - x) exp(-x^2)   for x < a
//! ```
//!
//! `y` is an inverse error function. `x` is the root of its distribution function, by
//! Newton's method inside a bracket: the map from `u` is monotone, so stratified points stay
//! stratified (Jakob's improvement over the fitted table of 2014). For `a < 0` (views below the
//! horizon) the excess `y' = a - x >= 0` is solved for instead, with the scaled complementary
//! error function, so that nothing underflows; beyond `a = -25` the quadratic term of the exponent
//! is dropped (it changes the density by less than 1e-3, where the visible area itself is below
//! exp(-625)).
//!
//! The roots are computed in f64 whatever the type: f32 cannot hold the tails.

use super::{above, reflect};
use crate::alpha::Alpha;
use crate::math::{Real, Vec3, vec3};
use crate::ndf::{Beckmann, Ndf};

const SQRT_PI: f64 = 1.772_453_850_905_516;

/// A visible normal, unit, with `wm.z > 0`.
///
/// * `wo`: unit, any hemisphere.
/// * `u`: uniform in `[0, 1)^2`; `u[0]` is the slope along the view, `u[1]` the one across.
#[inline]
pub fn sample_wm<T: Real>(alpha: Alpha<T>, wo: Vec3<T>, u: [T; 2]) -> Vec3<T> {
    let i = alpha.stretch(wo);
    let sine = (i.x * i.x + i.y * i.y).sqrt();
    let (cos_phi, sin_phi) = if sine > T::TINY {
        (i.x / sine, i.y / sine)
    } else {
        (T::ONE, T::ZERO)
    };
    let along = T::of(slope_along(i.z.to_f64(), sine.to_f64(), u[0].to_f64()));
    let across = T::of(erf_inverse(2.0 * u[1].to_f64() - 1.0));
    let slope_x = cos_phi * along - sin_phi * across;
    let slope_y = sin_phi * along + cos_phi * across;
    alpha.stretch(vec3(-slope_x, -slope_y, T::ONE)).normalize()
}

/// Density of [`sample_wm`], `D(wm) max(wo . wm, 0) / sigma(wo)`, in 1/sr.
#[inline(always)]
pub fn pdf_wm<T: Real>(alpha: Alpha<T>, wo: Vec3<T>, wm: Vec3<T>) -> T {
    Beckmann::new(alpha).d_visible(wo, wm)
}

/// The reflection of `wo` off a visible normal; `None` below the horizon.
#[inline]
pub fn sample_reflection<T: Real>(alpha: Alpha<T>, wo: Vec3<T>, u: [T; 2]) -> Option<Vec3<T>> {
    above(reflect(wo, sample_wm(alpha, wo, u)))
}

/// Density of [`sample_reflection`] in 1/sr: `D(wm) / (4 sigma(wo))`; 0 where `wi.z <= 0`.
#[inline(always)]
pub fn reflection_pdf<T: Real>(alpha: Alpha<T>, wo: Vec3<T>, wi: Vec3<T>) -> T {
    let ndf = Beckmann::new(alpha);
    let wm = (wo + wi).normalize_any();
    let pdf = ndf.d(wm) / (T::of(4.0) * ndf.projected_area(wo));
    T::select(wi.z > T::ZERO && wm.z > T::ZERO, pdf, T::ZERO)
}

/// The slope `x` with distribution function `u`, seen from a view `(sine, 0, cosine)`.
fn slope_along(cosine: f64, sine: f64, u: f64) -> f64 {
    let a = cosine / sine.max(1e-300);
    if a >= 0.0 {
        slope_from_above(1.0 / a.max(1e-300), u)
    } else {
        a - excess_from_below(-a, u)
    }
}

/// Root of `C(x)/C(a) = u`, `C(x) = erfc(-x)/2 + tan theta exp(-x^2) / (2 sqrt pi)`, `x <= a`.
///
/// The iteration starts between the roots of its two limits, the normal distribution of a view from straight above and
/// the Rayleigh distribution of one along the surface.
fn slope_from_above(tangent: f64, u: f64) -> f64 {
    let a = 1.0 / tangent;
    let cumulative = |x: f64| 0.5 * libm::erfc(-x) + tangent * (-x * x).exp() / (2.0 * SQRT_PI);
    let target = u * cumulative(a);
    let (low, high) = (-9.0_f64, a.min(9.0));
    let normal = erf_inverse_estimate(2.0 * u - 1.0);
    let rayleigh = -(-u.max(1e-30).ln()).max(0.0).sqrt();
    let start = (normal * a + rayleigh) / (a + 1.0);
    newton_in_bracket([low, start, high], |x| {
        let slope = (1.0 - tangent * x) * (-x * x).exp() / SQRT_PI;
        (cumulative(x) - target, slope)
    })
}

/// Root `y` of `S(y)/S(0) = u`, where `S(y)` is the integral of `t exp(-t^2 - 2 b t)` above `y`:
///
/// ```text
/// S(y) = exp(-y^2 - 2 b y) (1 - b sqrt(pi) erfcx(y + b)) / 2
/// ```
fn excess_from_below(b: f64, u: f64) -> f64 {
    // A zero u would mean an endless tail.
    let u = u.max(1e-16);
    if b > 25.0 {
        let y = newton_in_bracket([0.0, 30.0, 60.0], |w| {
            ((1.0 + w) * (-w).exp() - u, -w * (-w).exp())
        });
        return y / (2.0 * b);
    }
    let scaled = |y: f64| {
        let c = y + b;
        let erfcx = (c * c).exp() * libm::erfc(c);
        0.5 * (-y * y - 2.0 * b * y).exp() * (1.0 - b * SQRT_PI * erfcx)
    };
    let target = u * scaled(0.0);
    // exp(-y^2) alone bounds the tail at 6.5, exp(-2 b y) at 45 / (2 b): below 26 - b, so that erfcx stays finite.
    let high = (6.5_f64).min(45.0 / (2.0 * b).max(1e-3)).max(0.02);
    newton_in_bracket([0.0, 0.5 * high, high], |y| {
        (scaled(y) - target, -y * (-y * y - 2.0 * b * y).exp())
    })
}

/// Root of a monotone function in `[low, high]`, by Newton's steps from `start` with bisection where they leave
/// the bracket; the end nearer to the root where there is none.
///
/// A step below 1e-8 is the last one: what it leaves is as small as its square. Smaller steps than that go on for long, as
/// rounding makes them.
fn newton_in_bracket([low, start, high]: [f64; 3], f: impl Fn(f64) -> (f64, f64)) -> f64 {
    let (mut low, mut high) = (low, high);
    let mut x = start.clamp(low, high);
    for _ in 0..64 {
        let (value, slope) = f(x);
        // The sign of the slope is the function's: it is monotone.
        if (value > 0.0) == (slope >= 0.0) {
            high = x;
        } else {
            low = x;
        }
        let step = x - value / slope;
        let is_within = step > low && step < high;
        let next = if is_within { step } else { 0.5 * (low + high) };
        let least = if is_within { 1e-8 } else { 1e-14 };
        if (next - x).abs() <= least * (1.0 + x.abs()) {
            return next;
        }
        x = next;
    }
    x
}

/// Inverse of the error function on `(-1, 1)`; clamped to 6 in absolute value.
///
/// Two Newton steps take the [estimate](erf_inverse_estimate) to the accuracy of f64.
fn erf_inverse(x: f64) -> f64 {
    let x = x.clamp(-1.0 + 1e-16, 1.0 - 1e-16);
    let mut y = erf_inverse_estimate(x);
    for _ in 0..2 {
        let error = if y < 0.0 {
            libm::erfc(-y) - (1.0 + x)
        } else {
            (1.0 - x) - libm::erfc(y)
        };
        y -= error * SQRT_PI * 0.5 * (y * y).exp();
    }
    y.clamp(-6.0, 6.0)
}

/// The same to the accuracy of f32.
///
/// Source: Giles 2010, Approximating the erfinv function, table 5.
fn erf_inverse_estimate(x: f64) -> f64 {
    let x = x.clamp(-1.0 + 1e-16, 1.0 - 1e-16);
    let w = -((1.0 - x) * (1.0 + x)).ln();
    let factor = if w < 5.0 {
        polynomial(
            w - 2.5,
            &[
                1.501_409_41,
                0.246_640_727,
                -0.004_177_681_64,
                -0.001_253_725_03,
                0.000_218_580_87,
                -4.391_506_54e-6,
                -3.523_387_7e-6,
                3.432_739_39e-7,
                2.810_226_36e-8,
            ],
        )
    } else {
        polynomial(
            w.sqrt() - 3.0,
            &[
                2.832_976_82,
                1.001_674_06,
                0.009_438_870_47,
                -0.007_622_461_3,
                0.005_739_507_73,
                -0.003_676_842_45,
                0.001_349_343_22,
                0.000_100_950_558,
                -0.000_200_214_257,
            ],
        )
    };
    factor * x
}

fn polynomial(x: f64, coefficients: &[f64]) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inverse_error_function_inverts() {
        for i in 1..2000 {
            let x = f64::from(i) / 1000.0 - 1.0;
            let error = (libm::erf(erf_inverse(x)) - x).abs();
            assert!(error < 1e-14, "{x}: {error:e}");
        }
    }

    #[test]
    fn slopes_are_the_roots_of_their_distribution_functions() {
        for &(cosine, sine) in &[(1.0, 0.0), (0.8, 0.6), (0.1, 0.99), (0.001, 1.0)] {
            let tangent = sine / cosine;
            let cumulative =
                |x: f64| 0.5 * libm::erfc(-x) + tangent * (-x * x).exp() / (2.0 * SQRT_PI);
            for i in 1..100 {
                let u = f64::from(i) / 100.0;
                let x = slope_along(cosine, sine, u);
                let total = if sine == 0.0 {
                    1.0
                } else {
                    cumulative(1.0 / tangent)
                };
                assert!((cumulative(x) / total - u).abs() < 1e-10, "{cosine} {u}");
            }
        }
    }

    #[test]
    fn views_from_below_agree_with_quadrature_of_the_tail() {
        for &b in &[0.01_f64, 0.3, 1.0, 5.0, 20.0] {
            let density = |t: f64| t * (-t * t - 2.0 * b * t).exp();
            let integral = |from: f64, to: f64| {
                let n = 20_000;
                let h = (to - from) / f64::from(n);
                (0..n)
                    .map(|i| density(from + (f64::from(i) + 0.5) * h) * h)
                    .sum::<f64>()
            };
            let end = (8.0_f64).min(40.0 / b);
            let total = integral(0.0, end);
            for &u in &[0.05, 0.3, 0.7, 0.99] {
                let y = excess_from_below(b, u);
                let tail = integral(y, end) / total;
                assert!((tail - u).abs() < 1e-5, "b {b}, u {u}: {tail}");
            }
        }
    }
}
