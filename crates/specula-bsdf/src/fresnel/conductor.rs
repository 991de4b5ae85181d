//! Exact reflectance of a conductor.

use crate::math::{Real, Rgb, rgb};

/// Unpolarised reflectance of an interface with a complex index of refraction, per channel.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Conductor<T> {
    /// Real part of the index relative to the outer medium.
    pub eta: Rgb<T>,
    /// Imaginary part, at least 0.
    pub k: Rgb<T>,
}

impl<T: Real> Conductor<T> {
    /// Reflectance at `cos`, in `[0, 1]`.
    ///
    /// With `a^2 + b^2 = sqrt((eta^2 - k^2 - sin^2)^2 + 4 eta^2 k^2)` and
    /// `a^2 = (a^2 + b^2 + eta^2 - k^2 - sin^2) / 2`:
    ///
    /// ```text
    /// Rs = (a^2 + b^2 - 2 a cos + cos^2) / (a^2 + b^2 + 2 a cos + cos^2)
    /// Rp = Rs (cos^2 (a^2 + b^2) - 2 a cos sin^2 + sin^4)
    ///         / (cos^2 (a^2 + b^2) + 2 a cos sin^2 + sin^4)
    /// F = (Rs + Rp) / 2
    /// ```
    ///
    /// NaN does not leave: a cosine that is NaN counts as 0, an index as 1000, at which all reflects.
    ///
    /// Source: Born and Wolf, Principles of Optics, 14.2; Fresnel's equations for a complex index.
    #[inline(always)]
    pub fn eval(&self, cos: T) -> Rgb<T> {
        let cos = cos.within(T::ZERO, T::ONE);
        let quotient = |eta, k| quotient(cos, eta, k);
        let (r, g, b) = (
            quotient(self.eta.r, self.k.r),
            quotient(self.eta.g, self.k.g),
            quotient(self.eta.b, self.k.b),
        );
        // One division for the three: each denominator lies in [1e-12, 5e12].
        let green_blue = g.1 * b.1;
        let inverse = T::ONE / (r.1 * green_blue);
        let red = r.1 * inverse;
        let f = |x: T| x.within(T::ZERO, T::ONE);
        rgb(
            f(r.0 * (green_blue * inverse)),
            f(g.0 * (b.1 * red)),
            f(b.0 * (g.1 * red)),
        )
    }

    /// The same metal under a medium of index `eta` instead of vacuum.
    #[inline(always)]
    pub fn under(&self, eta: T) -> Self {
        let inverse = T::ONE / eta;
        Self {
            eta: self.eta * inverse,
            k: self.k * inverse,
        }
    }
}

/// Numerator and denominator of `(Rs + Rp) / 2`.
#[inline(always)]
fn quotient<T: Real>(cos: T, eta: T, k: T) -> (T, T) {
    // Beyond 1000 everything reflects alike; the limit bounds products of denominators.
    let limit = T::of(1e3);
    let (eta, k) = (eta.at_most(limit), k.at_most(limit));
    let (eta2, k2) = (eta * eta, k * k);
    let cos2 = cos * cos;
    let sin2 = T::ONE - cos2;
    // eta^2 - k^2 - sin^2, added up so that at an index of 1 nothing cancels at grazing angles.
    let t = (eta2 - T::ONE - k2) + cos2;
    let a2_plus_b2 = t.mad(t, T::of(4.0) * eta2 * k2).sqrt();
    let s = a2_plus_b2 + cos2;
    let s2 = cos * (T::TWO * (a2_plus_b2 + t)).safe_sqrt();
    let p = cos2.mad(a2_plus_b2, sin2 * sin2);
    let p2 = s2.mad(sin2, p);
    // An index of exactly 1 reflects nothing, and at grazing angles leaves 0/0.
    ((s - s2) * p, ((s + s2) * p2).at_least(T::of(1e-12)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_incidence_and_grazing_angles_have_their_closed_forms() {
        let f = Conductor {
            eta: rgb(0.2_f64, 1.5, 3.0),
            k: rgb(3.9, 0.0, 2.0),
        };
        let r = f.eval(1.0);
        let f0 = |n: f64, k: f64| ((n - 1.0).powi(2) + k * k) / ((n + 1.0).powi(2) + k * k);
        assert!((r.r - f0(0.2, 3.9)).abs() < 1e-14);
        assert!((r.g - f0(1.5, 0.0)).abs() < 1e-14);
        assert!((r.b - f0(3.0, 2.0)).abs() < 1e-14);
        assert!((f.eval(0.0).r - 1.0).abs() < 1e-14);
    }

    #[test]
    fn nan_reflects() {
        let gold = |eta, k| Conductor {
            eta: Rgb::splat(eta),
            k: Rgb::splat(k),
        };
        assert_eq!(gold(0.2_f32, 3.0).eval(f32::NAN), gold(0.2, 3.0).eval(0.0));
        for (eta, k) in [(f32::NAN, 3.0), (0.2, f32::NAN), (f32::NAN, f32::NAN)] {
            assert!(gold(eta, k).eval(0.7).g > 0.99, "{eta} {k}");
        }
    }

    #[test]
    fn without_absorption_it_is_the_dielectric() {
        for i in 0..=100 {
            let cos = f64::from(i) / 100.0;
            let f = Conductor {
                eta: Rgb::splat(1.5),
                k: Rgb::splat(0.0),
            };
            let expected = crate::fresnel::dielectric(cos, 1.5).reflectance;
            assert!((f.eval(cos).r - expected).abs() < 1e-12, "{cos}");
        }
    }

    #[test]
    fn an_index_near_1_reflects_as_the_dielectric_in_single_precision() {
        for (cos, eta) in [
            (1e-3_f32, 1.0_f32),
            (1e-3, 1.001),
            (0.02, 0.999_9),
            (0.5, 1.01),
        ] {
            let f = Conductor {
                eta: Rgb::splat(eta),
                k: Rgb::splat(0.0),
            };
            let exact = crate::fresnel::dielectric(f64::from(cos), f64::from(eta)).reflectance;
            let single = f64::from(f.eval(cos).r);
            assert!(
                (single - exact).abs() < 1e-6 + 3e-4 * exact,
                "{cos} {eta}: {single} {exact}"
            );
        }
    }

    #[test]
    fn complex_arithmetic_gives_the_same() {
        // Rs = |(cos - w)/(cos + w)|^2, w = sqrt(n^2 - sin^2), by hand in complex values.
        for &(eta, k, cos) in &[(0.2, 3.0, 0.3), (2.5, 1.0, 0.7), (0.05, 6.0, 0.01)] {
            let sin2: f64 = 1.0 - cos * cos;
            let n2: (f64, f64) = (eta * eta - k * k, 2.0 * eta * k);
            let z = (n2.0 - sin2, n2.1);
            let modulus = z.0.hypot(z.1);
            let w = (
                (0.5 * (modulus + z.0)).sqrt(),
                (0.5 * (modulus - z.0)).sqrt(),
            );
            let rs = ((cos - w.0).powi(2) + w.1 * w.1) / ((cos + w.0).powi(2) + w.1 * w.1);
            let top = (n2.0 * cos - w.0, n2.1 * cos - w.1);
            let bottom = (n2.0 * cos + w.0, n2.1 * cos + w.1);
            let rp = (top.0.hypot(top.1) / bottom.0.hypot(bottom.1)).powi(2);
            let f = Conductor {
                eta: Rgb::splat(eta),
                k: Rgb::splat(k),
            };
            assert!((f.eval(cos).g - 0.5 * (rs + rp)).abs() < 1e-12);
        }
    }
}
