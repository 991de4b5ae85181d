//! CIE standard illuminants: A by its formula, the daylight series D from its components.
//!
//! Source: CIE 015:2018, sections 4.1 (A and D65, equations 4.1 to 4.8) and table 6 (components of
//! the daylight series); values are facts of the standard.

use super::Spectrum;

/// CIE standard illuminant A: a tungsten lamp.
///
/// ```text
/// S(nm) = 100 (560/nm)^5 (exp(1.435e7/(2848 * 560)) - 1) / (exp(1.435e7/(2848 nm)) - 1)
/// ```
///
/// * Returns: relative power, 100 at 560 nm, sampled every 5 nm from 300 to 830 nm.
pub(super) fn illuminant_a() -> Spectrum {
    Spectrum::sampled(300.0, 830.0, 5.0, |nm| {
        let planck = |nm: f64| (1.435e7 / (2848.0 * nm)).exp_m1();
        100.0 * (560.0 / nm).powi(5) * planck(560.0) / planck(nm)
    })
}

/// CIE standard illuminant D65.
pub(super) fn illuminant_d65() -> Spectrum {
    daylight(6500.0)
}

/// CIE illuminant D50.
pub(super) fn illuminant_d50() -> Spectrum {
    daylight(5000.0)
}

/// The D60 of ACES: the daylight of nominally 6000 K.
pub(super) fn illuminant_d60() -> Spectrum {
    daylight(6000.0)
}

/// Daylight of a nominal correlated colour temperature.
///
/// ```text
/// T = kelvin 1.4388/1.4380                      (c2 was revised after the series was named)
/// x = -4.6070e9/T^3 + 2.9678e6/T^2 + 99.11/T + 0.244063
/// y = -3 x^2 + 2.87 x - 0.275
/// M1, M2 rounded to three decimals,   S = S0 + M1 S1 + M2 S2
/// ```
///
/// * `kelvin`: nominal, 4000 to 7000.
/// * Returns: relative power, 100 at 560 nm, every 10 nm from 300 to 830 nm; in between it is
///   linear, as the standard prescribes.
fn daylight(kelvin: f64) -> Spectrum {
    let t = kelvin * 1.4388 / 1.4380;
    let x = -4.6070e9 / t.powi(3) + 2.9678e6 / t.powi(2) + 99.11 / t + 0.244_063;
    let y = -3.0 * x * x + 2.870 * x - 0.275;
    let round = |m: f64| (m * 1000.0).round() / 1000.0;
    let m = 0.0241 + 0.2562 * x - 0.7341 * y;
    let m1 = round((-1.3515 - 1.7703 * x + 5.9114 * y) / m);
    let m2 = round((0.0300 - 31.4424 * x + 30.0717 * y) / m);
    let samples = (30..).zip(&COMPONENTS);
    Spectrum::from_ordered(
        samples
            .map(|(i, [s0, s1, s2])| (f64::from(i) * 10.0, s0 + m1 * s1 + m2 * s2))
            .collect(),
    )
}

/// `(S0, S1, S2)` every 10 nm from 300 to 830 nm.
#[rustfmt::skip]
#[allow(clippy::approx_constant, reason = "values of a standard")]
static COMPONENTS: [[f64; 3]; 54] = [
    [0.04, 0.02, 0.0],
    [6.0, 4.5, 2.0],
    [29.6, 22.4, 4.0],
    [55.3, 42.0, 8.5],
    [57.3, 40.6, 7.8],
    [61.8, 41.6, 6.7],
    [61.5, 38.0, 5.3],
    [68.8, 42.4, 6.1],
    [63.4, 38.5, 3.0],
    [65.8, 35.0, 1.2],
    [94.8, 43.4, -1.1],
    [104.8, 46.3, -0.5],
    [105.9, 43.9, -0.7],
    [96.8, 37.1, -1.2],
    [113.9, 36.7, -2.6],
    [125.6, 35.9, -2.9],
    [125.5, 32.6, -2.8],
    [121.3, 27.9, -2.6],
    [121.3, 24.3, -2.6],
    [113.5, 20.1, -1.8],
    [113.1, 16.2, -1.5],
    [110.8, 13.2, -1.3],
    [106.5, 8.6, -1.2],
    [108.8, 6.1, -1.0],
    [105.3, 4.2, -0.5],
    [104.4, 1.9, -0.3],
    [100.0, -0., 0.],
    [96.0, -1.6, 0.2],
    [95.1, -3.5, 0.5],
    [89.1, -3.5, 2.1],
    [90.5, -5.8, 3.2],
    [90.3, -7.2, 4.1],
    [88.4, -8.6, 4.7],
    [84.0, -9.5, 5.1],
    [85.1, -10.9, 6.7],
    [81.9, -10.7, 7.3],
    [82.6, -12.0, 8.6],
    [84.9, -14.0, 9.8],
    [81.3, -13.6, 10.2],
    [71.9, -12.0, 8.3],
    [74.3, -13.3, 9.6],
    [76.4, -12.9, 8.5],
    [63.3, -10.6, 7.0],
    [71.7, -11.6, 7.6],
    [77.0, -12.2, 8.0],
    [65.2, -10.2, 6.7],
    [47.7, -7.8, 5.2],
    [68.6, -11.2, 7.4],
    [65.0, -10.4, 6.8],
    [66.0, -10.6, 7.0],
    [61.0, -9.7, 6.4],
    [53.3, -8.3, 5.5],
    [58.9, -9.3, 6.1],
    [61.9, -9.8, 6.5],
];

#[cfg(test)]
mod tests {
    use super::*;

    /// Published values of CIE 015:2018, table 5, to the rounding of the series (0.001).
    #[test]
    fn d65_and_d50_are_the_published_tables() {
        let d65 = illuminant_d65();
        for (nm, s) in [
            (380.0, 49.9755),
            (450.0, 117.008),
            (560.0, 100.0),
            (650.0, 80.0268),
            (780.0, 63.3828),
        ] {
            assert!((d65.value(nm) - s).abs() < 1e-3, "{nm}: {}", d65.value(nm));
        }
        let d50 = illuminant_d50();
        for (nm, s) in [(380.0, 24.488), (500.0, 95.724), (700.0, 91.604)] {
            assert!((d50.value(nm) - s).abs() < 1e-3, "{nm}: {}", d50.value(nm));
        }
    }

    #[test]
    fn a_is_the_published_table() {
        let a = illuminant_a();
        for (nm, s) in [(380.0, 9.795), (560.0, 100.0), (780.0, 241.675)] {
            assert!((a.value(nm) - s).abs() < 1e-3, "{nm}: {}", a.value(nm));
        }
    }
}
