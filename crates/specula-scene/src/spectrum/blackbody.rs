//! Colour of thermal light.

use specula_bsdf::Rgb;

use super::colour::{emission_to_rgb, integrate};

/// Second radiation constant `c2 = h c / k` in nm K, from the exact values of CODATA 2018
/// (h = 6.62607015e-34 J s, c = 299792458 m/s, k = 1.380649e-23 J/K).
const C2_NM_K: f64 = 6.626_070_15e-34 * 299_792_458.0 / 1.380_649e-23 * 1e9;

/// Colour of a black body at luminance 1.
///
/// ```text
/// L(nm) ~ nm^-5 / (exp(c2 / (nm T)) - 1)
/// ```
///
/// * `kelvin`: temperature `T`.
/// * Returns: linear sRGB of luminance 1, clamped as [`super::illuminant_to_rgb`] does (blue is
///   outside the gamut below about 1900 K); black where `kelvin` is not a positive number.
///
/// Source: Planck 1901, constants CODATA 2018. Departure: pbrt normalises to the peak of the
/// spectrum first; with the luminance set to 1 afterwards, nothing is left of that.
#[must_use]
pub fn blackbody_to_rgb(kelvin: f32) -> Rgb<f32> {
    let t = f64::from(kelvin);
    if !(t.is_finite() && t > 0.0) {
        return Rgb::BLACK;
    }
    emission_to_rgb(xyz_of_blackbody(t))
}

/// Tristimulus values of a black body, in units of its radiance at 830 nm.
///
/// * `kelvin`: finite, above 0.
pub(super) fn xyz_of_blackbody(kelvin: f64) -> [f64; 3] {
    integrate(|nm| planck(nm, kelvin))
}

/// Planck's law over its value at 830 nm, the end of the visible where cold bodies are brightest:
/// written as a ratio, it underflows for no temperature.
fn planck(nm: f64, kelvin: f64) -> f64 {
    const END_NM: f64 = 830.0;
    let x = C2_NM_K / (nm * kelvin);
    let end = C2_NM_K / (END_NM * kelvin);
    (END_NM / nm).powi(5) * (end - x).exp() * ((-end).exp_m1() / (-x).exp_m1())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Chromaticities of the Planckian locus, Kelly 1963 as tabulated in Wyszecki and Stiles 1982,
    /// table 1(3.11), converted to xy: 2856 K is that of illuminant A.
    #[test]
    fn chromaticities_lie_on_the_planckian_locus() {
        for (kelvin, x, y) in [
            (1000.0, 0.6527, 0.3445),
            (2000.0, 0.5267, 0.4133),
            (2856.0, 0.4475, 0.4074),
            (6500.0, 0.3135, 0.3237),
            (10000.0, 0.2806, 0.2883),
        ] {
            let [cx, cy, cz] = integrate(|nm| planck(nm, kelvin));
            let s = cx + cy + cz;
            assert!((cx / s - x).abs() < 5e-4, "{kelvin} K: x = {}", cx / s);
            assert!((cy / s - y).abs() < 5e-4, "{kelvin} K: y = {}", cy / s);
        }
    }

    #[test]
    fn planck_is_the_plain_formula() {
        let plain = |nm: f64, t: f64| nm.powi(-5) / (C2_NM_K / (nm * t)).exp_m1();
        for t in [800.0, 3000.0, 2e4] {
            for nm in [360.0, 555.0, 829.0] {
                let ratio = plain(nm, t) / plain(830.0, t);
                assert!(
                    (planck(nm, t) / ratio - 1.0).abs() < 1e-12,
                    "{nm} nm, {t} K"
                );
            }
        }
    }

    #[test]
    fn luminance_is_one_and_colours_run_from_red_to_blue() {
        for kelvin in [100.0, 800.0, 1500.0, 2700.0, 6500.0, 2e4, 1e6] {
            let c = blackbody_to_rgb(kelvin);
            assert!((c.luminance() - 1.0).abs() < 1e-3, "{kelvin} K: {c:?}");
            assert!(c.r >= 0.0 && c.g >= 0.0 && c.b >= 0.0, "{kelvin} K: {c:?}");
        }
        let (cold, hot) = (blackbody_to_rgb(2700.0), blackbody_to_rgb(2e4));
        assert!(cold.r > cold.g && cold.g > cold.b);
        assert!(hot.r < hot.g && hot.g < hot.b);
    }

    #[test]
    fn no_temperature_no_light() {
        for kelvin in [0.0, -5.0, f32::NAN, f32::INFINITY] {
            assert_eq!(blackbody_to_rgb(kelvin), Rgb::BLACK);
        }
    }
}
