//! Exact reflectance and refraction at a dielectric interface.

use crate::math::{Real, Vec3};

/// What becomes of light at a dielectric interface.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Refraction<T> {
    /// Share that is reflected, in `[0, 1]`; 1 beyond the critical angle.
    pub reflectance: T,
    /// Share that passes, `1 - reflectance` without its cancellation at grazing angles.
    pub transmittance: T,
    /// Cosine of the refracted direction; 0 beyond the critical angle.
    pub cos_t: T,
}

/// Unpolarised reflectance of a dielectric interface.
///
/// ```text
/// cos_t = sqrt(1 - (1 - cos^2) / eta^2) = sqrt((eta - 1) (eta + 1) + cos^2) / eta
/// rs = (cos - eta cos_t) / (cos + eta cos_t),   rp = (eta cos - cos_t) / (eta cos + cos_t)
/// F = (rs^2 + rp^2) / 2
/// 1 - F = 2 eta cos cos_t (1 / (cos + eta cos_t)^2 + 1 / (eta cos + cos_t)^2)
/// ```
///
/// * `cos`: cosine between the direction and the normal on its side, in `[0, 1]`.
/// * `eta`: index beyond the interface over the index on the direction's side, above 0.
///
/// NaN does not leave: a cosine that is NaN counts as 0, an index that is NaN reflects all.
///
/// Departure: the second form of `cos_t`, which does not cancel where `eta` is near 1 and the angle
/// grazing.
#[inline(always)]
pub fn dielectric<T: Real>(cos: T, eta: T) -> Refraction<T> {
    let cos = cos.within(T::ZERO, T::ONE);
    let refracted = (eta - T::ONE) * (eta + T::ONE) + cos * cos;
    refraction(cos, refracted / (eta * eta), eta)
}

/// [`dielectric`] where the square of the refracted cosine is known, 0 or less beyond the critical
/// angle.
#[inline(always)]
pub(crate) fn refraction<T: Real>(cos: T, cos2_t: T, eta: T) -> Refraction<T> {
    let passes = cos2_t > T::ZERO;
    let cos_t = cos2_t.safe_sqrt();
    let inverse_s = T::ONE / (cos + eta * cos_t).at_least(T::TINY);
    let inverse_p = T::ONE / (eta * cos + cos_t).at_least(T::TINY);
    let rs = (cos - eta * cos_t) * inverse_s;
    let rp = (eta * cos - cos_t) * inverse_p;
    let reflectance = (T::HALF * (rs * rs + rp * rp)).at_most(T::ONE);
    let fluxes = inverse_s * inverse_s + inverse_p * inverse_p;
    let transmittance = (T::TWO * eta * cos * cos_t * fluxes).at_most(T::ONE);
    Refraction {
        reflectance: T::select(passes, reflectance, T::ONE),
        transmittance: T::select(passes, transmittance, T::ZERO),
        cos_t,
    }
}

/// The direction `wo` refracted at a facet.
///
/// ```text
/// wi = (cos_o / eta - cos_t) wm - wo / eta
/// ```
///
/// * `wm`: unit, on the side of `wo`; `cos_o = wo . wm`; `cos_t` of [`dielectric`].
#[inline(always)]
pub fn refract<T: Real>(wo: Vec3<T>, wm: Vec3<T>, cos_o: T, cos_t: T, eta: T) -> Vec3<T> {
    let inverse = T::ONE / eta;
    wm * (inverse * cos_o - cos_t) - wo * inverse
}

/// Hemispherical reflectance of a smooth interface for light from every side,
/// `int F(mu) 2 mu dmu`, for `eta` from 1/4 to 4.
///
/// For light from inside: `1 - (1 - Fdr(eta)) / eta^2` (reciprocity).
///
/// For `eta >= 1` in closed form, linear below 1.002 (absolute error below 3e-6). Source: Walsh 1926, as given by Duntley 1942; a test holds it
/// against quadrature.
#[inline(always)]
pub fn dielectric_average<T: Real>(eta: T) -> T {
    let outside_in = eta >= T::ONE;
    let n = T::select(outside_in, eta, T::ONE / eta);
    // The closed form is 0/0 at 1: its limit is 0.
    let near_one = n < T::of(1.002);
    let safe = T::select(near_one, T::of(1.002), n);
    let entering = walsh(safe);
    let entering = T::select(
        near_one,
        entering * (n - T::ONE) / (safe - T::ONE),
        entering,
    );
    let leaving = T::ONE - (T::ONE - entering) / (n * n);
    T::select(outside_in, entering, leaving)
}

fn walsh<T: Real>(n: T) -> T {
    // In f64: the form cancels near 1.
    let n = n.to_f64();
    let n2 = n * n;
    let first = (n - 1.0) * (3.0 * n + 1.0) / (6.0 * (n + 1.0) * (n + 1.0));
    let log = ((n - 1.0) / (n + 1.0)).ln();
    let second = n2 * (n2 - 1.0) * (n2 - 1.0) / ((n2 + 1.0) * (n2 + 1.0) * (n2 + 1.0)) * log;
    let third = 2.0 * n2 * n * (n2 + 2.0 * n - 1.0) / ((n2 + 1.0) * (n2 * n2 - 1.0));
    let fourth = 8.0 * n2 * n2 * (n2 * n2 + 1.0) / ((n2 + 1.0) * (n2 * n2 - 1.0) * (n2 * n2 - 1.0));
    T::of(0.5 + first + second - third + fourth * n.ln())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::vec3;

    #[test]
    fn known_values() {
        assert!((dielectric(1.0_f64, 1.5).reflectance - 0.04).abs() < 1e-15);
        assert!((dielectric(0.0_f64, 1.5).reflectance - 1.0).abs() < 1e-15);
        // Beyond the critical angle of glass, 41.8 degrees.
        assert_eq!(dielectric(0.7_f64, 1.0 / 1.5).reflectance, 1.0);
        // At Brewster's angle only s-polarised light is reflected.
        let brewster = 1.0 / (1.0 + 1.5_f64 * 1.5).sqrt();
        let expected = 0.5 * ((1.0 - 2.25_f64) / (1.0 + 2.25)).powi(2);
        assert!((dielectric(brewster, 1.5).reflectance - expected).abs() < 1e-12);
    }

    #[test]
    fn nan_reflects_all() {
        for (cos, eta) in [(f32::NAN, 1.5), (0.7, f32::NAN), (f32::NAN, f32::NAN)] {
            let there = dielectric(cos, eta);
            let all = (there.reflectance, there.transmittance);
            assert_eq!(all, (1.0, 0.0), "{cos} {eta}");
        }
    }

    #[test]
    fn equal_indices_reflect_nothing_in_single_precision() {
        for cos in [1.0_f32, 0.1, 1e-3, 1e-6] {
            let there = dielectric(cos, 1.0);
            assert!(there.reflectance < 1e-12, "{cos}: {}", there.reflectance);
            assert!(
                (there.cos_t - cos).abs() <= 2.0 * f32::EPSILON * cos,
                "{cos}"
            );
        }
        for (cos, eta) in [(1e-4_f32, 1.000_01_f32), (1e-3, 1.001), (0.02, 0.999_9)] {
            let exact = dielectric(f64::from(cos), f64::from(eta)).reflectance;
            let single = f64::from(dielectric(cos, eta).reflectance);
            assert!(
                (single - exact).abs() < 1e-5 * exact,
                "{cos} {eta}: {single} {exact}"
            );
        }
    }

    #[test]
    fn both_sides_reflect_alike() {
        for i in 1..100 {
            let cos = f64::from(i) / 100.0;
            let there = dielectric(cos, 1.5);
            let back = dielectric(there.cos_t, 1.0 / 1.5);
            assert!((there.reflectance - back.reflectance).abs() < 1e-12);
            assert!((back.cos_t - cos).abs() < 1e-12);
            assert!((there.reflectance + there.transmittance - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn refraction_obeys_snell() {
        let wm = vec3(0.1_f64, -0.2, 0.9).normalize();
        let wo = vec3(0.5_f64, 0.3, 0.6).normalize();
        for eta in [1.5, 1.0 / 1.2, 1.0] {
            let cos_o = wo.dot(wm);
            let r = dielectric(cos_o, eta);
            let wi = refract(wo, wm, cos_o, r.cos_t, eta);
            assert!((wi.length() - 1.0).abs() < 1e-12);
            assert!((wi.dot(wm) + r.cos_t).abs() < 1e-12);
            assert!((wo.cross(wm).length() - eta * wi.cross(wm).length()).abs() < 1e-12);
        }
    }

    #[test]
    fn the_average_is_the_integral() {
        for &eta in &[
            1.001_f64,
            1.01,
            1.1,
            1.33,
            1.5,
            2.4,
            3.9,
            1.0 / 1.5,
            1.0 / 2.4,
        ] {
            let n = 400_000;
            let sum: f64 = (0..n)
                .map(|i| {
                    let mu = (f64::from(i) + 0.5) / f64::from(n);
                    dielectric(mu, eta).reflectance * 2.0 * mu
                })
                .sum::<f64>()
                / f64::from(n);
            let got = dielectric_average(eta);
            assert!(
                (got - sum).abs() < 1e-4 * sum.max(0.03),
                "{eta}: {got} {sum}"
            );
        }
    }
}
