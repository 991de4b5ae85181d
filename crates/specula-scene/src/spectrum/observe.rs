//! The CIE 1931 observer at any wavelength, for formats that sum spectra in their own way.

use std::sync::OnceLock;

use super::Spectrum;
use super::cie_1931::{FIRST_NM, XYZ_BAR};
use super::colour::{wavelengths, xyz};
use super::illuminants::illuminant_d65;

/// What the observer's curves are multiplied by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Weight {
    /// Nothing.
    Equal,
    /// Daylight D65.
    DaylightD65,
}

/// `(xbar, ybar, zbar) w / integral of ybar w` at a wavelength.
///
/// * `nm`: linear between whole nanometres, 0 outside 360 to 830 nm.
/// * Returns: 1/nm; `ybar w` integrates to 1.
///
/// Source: CIE 018:2019, tables 5 and 6; CIE 015:2018, D65.
#[must_use]
pub(crate) fn observe(nm: f64, weight: Weight) -> [f64; 3] {
    static D65: OnceLock<(Spectrum, f64)> = OnceLock::new();
    static EQUAL: OnceLock<f64> = OnceLock::new();
    let last = XYZ_BAR.len() - 1;
    let at = nm - FIRST_NM;
    if !(at >= 0.0 && at <= last as f64) {
        return [0.0; 3];
    }
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "from 0 to the length of a small table"
    )]
    let below = (at as usize).min(last - 1);
    let share = at - below as f64;
    let factor = match weight {
        Weight::Equal => {
            1.0 / EQUAL.get_or_init(|| wavelengths().zip(&XYZ_BAR).map(|(_, bar)| bar[1]).sum())
        }
        Weight::DaylightD65 => {
            let (d65, sum) = D65.get_or_init(|| {
                let d65 = illuminant_d65();
                let sum = xyz(&d65)[1];
                (d65, sum)
            });
            d65.value(nm) / sum
        }
    };
    std::array::from_fn(|i| {
        let (a, b) = (XYZ_BAR[below][i], XYZ_BAR[below + 1][i]);
        (a + (b - a) * share) * factor
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn luminance_integrates_to_one() {
        for weight in [Weight::Equal, Weight::DaylightD65] {
            let steps = 4 * 470;
            let sum: f64 = (0..=steps)
                .map(|i| observe(360.0 + f64::from(i) / 4.0, weight)[1] / 4.0)
                .sum();
            assert!((sum - 1.0).abs() < 1e-4, "{sum}");
        }
        assert_eq!(observe(359.0, Weight::Equal), [0.0; 3]);
        assert_eq!(observe(f64::NAN, Weight::Equal), [0.0; 3]);
    }
}
