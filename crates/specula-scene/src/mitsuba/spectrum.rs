//! Spectra as Mitsuba's RGB mode converts them.
//!
//! ```text
//! reflectance list:  rgb = M sum (xbar, ybar, zbar) s D65 / sum ybar D65     clamped to [0, 1]
//! radiance list:     rgb = M sum (xbar, ybar, zbar) s / sum ybar             clamped to >= 0
//! index list:        as reflectance, clamped to >= 0
//! uniform radiance:  rgb = s M (1, 1, 1)
//! ```
//!
//! A list is 0 outside its wavelengths, and sums have Mitsuba's 1000 samples from 360 to 830 nm.

use std::path::Path;

use specula_bsdf::Rgb;

use super::number::{number, words};
use super::value::Samples;
use crate::num::f32_of;
use crate::read_file::Files;
use crate::spectrum::{Weight, observe};

/// What a spectrum is used for, which decides how it becomes a colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum SpectrumUse {
    /// A share in `[0, 1]`, seen under D65.
    Reflectance,
    /// Radiance, irradiance or intensity.
    Emission,
    /// An index of refraction, or another number without bound.
    Unbounded,
}

/// Linear RGB of a spectrum.
///
/// * `legacy`: the 0.6 dialect, in which a uniform spectrum is grey whatever its use.
pub(super) fn to_rgb(samples: &Samples, wanted: SpectrumUse, legacy: bool) -> Rgb<f32> {
    let rgb = match samples {
        Samples::Uniform(value) if wanted != SpectrumUse::Emission || legacy => [*value; 3],
        Samples::Uniform(value) => rgb_from_xyz([*value; 3]),
        Samples::BlackBody(kelvin, scale) => {
            rgb_from_xyz(black_body(*kelvin)).map(|c| c.max(0.0) * scale)
        }
        Samples::List(list) => {
            let weight = if wanted == SpectrumUse::Emission {
                Weight::Equal
            } else {
                Weight::DaylightD65
            };
            rgb_from_xyz(sum(list, weight))
        }
    };
    let most = if wanted == SpectrumUse::Reflectance {
        1.0
    } else {
        f64::from(f32::MAX)
    };
    let [r, g, b] = rgb.map(|c| f32_of(c.clamp(0.0, most)));
    Rgb { r, g, b }
}

/// Mitsuba's sum over a list.
fn sum(list: &[(f64, f64)], weight: Weight) -> [f64; 3] {
    const STEPS: u32 = 1000;
    const FIRST: f64 = 360.0;
    const RANGE: f64 = 470.0;
    let mut xyz = [0.0; 3];
    let (Some(first), Some(last)) = (list.first(), list.last()) else {
        return xyz;
    };
    for i in 0..STEPS {
        let nm = FIRST + RANGE * f64::from(i) / f64::from(STEPS - 1);
        if nm < first.0 || nm > last.0 {
            continue;
        }
        let above = list
            .partition_point(|s| s.0 <= nm)
            .clamp(1, list.len().max(2) - 1);
        let value = match (list.get(above - 1), list.get(above)) {
            (Some(&(w0, v0)), Some(&(w1, v1))) => v0 + (v1 - v0) * (nm - w0) / (w1 - w0),
            _ => first.1,
        };
        for (total, bar) in xyz.iter_mut().zip(observe(nm, weight)) {
            *total += bar * value;
        }
    }
    // Its norm for lights and indices makes up for weighing both ends whole; that for D65 does not.
    let intervals = match weight {
        Weight::Equal => STEPS - 1,
        Weight::DaylightD65 => STEPS,
    };
    xyz.map(|x| x * RANGE / f64::from(intervals))
}

/// Radiance of a black body in W/(m^2 sr nm), over the observer. Source: Planck 1901, CODATA 2018.
fn black_body(kelvin: f64) -> [f64; 3] {
    // 2 h c^2 in W m^2, and h c / k in m K.
    const C1: f64 = 2.0 * 6.626_070_15e-34 * 299_792_458.0 * 299_792_458.0;
    const C2: f64 = 6.626_070_15e-34 * 299_792_458.0 / 1.380_649e-23;
    let mut xyz = [0.0; 3];
    if kelvin <= 0.0 {
        return xyz;
    }
    for i in 0..=470_u32 {
        let nm = 360.0 + f64::from(i);
        let metres = nm * 1e-9;
        let radiance = 1e-9 * C1 / (metres.powi(5) * (C2 / (metres * kelvin)).exp_m1());
        for (total, bar) in xyz.iter_mut().zip(observe(nm, Weight::Equal)) {
            *total += bar * radiance;
        }
    }
    xyz
}

/// IEC 61966-2-1's matrix with the digits that Mitsuba has.
fn rgb_from_xyz([x, y, z]: [f64; 3]) -> [f64; 3] {
    [
        3.240_479 * x - 1.537_150 * y - 0.498_535 * z,
        -0.969_256 * x + 1.875_991 * y + 0.041_556 * z,
        0.055_648 * x - 0.204_043 * y + 1.057_311 * z,
    ]
}

/// IEC 61966-2-1.
pub(super) fn linear_from_srgb(x: f64) -> f64 {
    if x <= 0.04045 {
        x / 12.92
    } else {
        ((x + 0.055) / 1.055).powf(2.4)
    }
}

/// One number, or pairs `nm:value`.
///
/// # Errors
///
/// A message about the first word that is wrong.
pub(super) fn parse(text: &str) -> Result<Samples, String> {
    if !text.contains(':') {
        return match words(text).collect::<Vec<_>>().as_slice() {
            [one] => number(one).map(Samples::Uniform),
            other => Err(format!(
                "expected one number or pairs \"nm:value\", found {} numbers",
                other.len()
            )),
        };
    }
    let mut list = Vec::new();
    for word in words(text) {
        let (nm, value) = word
            .split_once(':')
            .ok_or_else(|| format!("expected \"nm:value\", found \"{word}\""))?;
        list.push((number(nm)?, number(value)?));
    }
    ordered(list)
}

/// A list whose wavelengths increase.
///
/// # Errors
///
/// A message about the first that does not.
pub(super) fn ordered(list: Vec<(f64, f64)>) -> Result<Samples, String> {
    if list.is_empty() {
        return Err("a spectrum needs at least one sample".to_owned());
    }
    if let Some(pair) = list.windows(2).find(|p| p[0].0 >= p[1].0) {
        return Err(format!(
            "wavelengths must increase: {} nm follows {} nm",
            pair[1].0, pair[0].0
        ));
    }
    Ok(Samples::List(list))
}

/// Reads a file of lines `nm value`; `#` starts a comment.
///
/// # Errors
///
/// A message that begins with the file's name.
pub(super) fn from_file(path: &Path, files: &Files) -> Result<Samples, String> {
    let wrong = |message: String| format!("spectrum {}: {message}", path.display());
    let bytes = files.plain(path).map_err(wrong)?;
    let text = String::from_utf8(bytes).map_err(|_| wrong("it is not UTF-8 text".to_owned()))?;
    let spectrum = crate::spectrum::parse_spd(&text).map_err(|e| wrong(e.to_string()))?;
    ordered(spectrum.samples().to_vec()).map_err(wrong)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of Mitsuba 3.9.1 (`scalar_rgb`), read with `mi.traverse`.
    #[test]
    fn lists_become_the_colours_that_mitsuba_gives() {
        let close = |text: &str, wanted, expected: [f32; 3]| {
            let c = to_rgb(&parse(text).unwrap(), wanted, false).to_array();
            for (f, e) in c.iter().zip(expected) {
                assert!((f - e).abs() <= 6e-4 * e.abs().max(0.1), "{text}: {c:?}");
            }
        };
        SPECTRA.iter().for_each(|(t, w, e)| close(t, *w, *e));
    }

    #[test]
    fn a_uniform_spectrum_is_grey_except_as_light() {
        let one = Samples::Uniform(0.5);
        assert_eq!(
            to_rgb(&one, SpectrumUse::Reflectance, false),
            Rgb::splat(0.5)
        );
        assert_eq!(to_rgb(&one, SpectrumUse::Emission, true), Rgb::splat(0.5));
        let light = to_rgb(&one, SpectrumUse::Emission, false);
        assert!(light.r > light.g && light.g > light.b, "{light:?}");
    }

    #[test]
    fn faults_are_named() {
        for (text, part) in [
            ("1 2", "found 2 numbers"),
            ("400:1 x", "expected \"nm:value\""),
            ("400:1 400:2", "400 nm follows 400 nm"),
            ("", "found 0 numbers"),
            ("400:y", "expected a number"),
        ] {
            let message = parse(text).unwrap_err();
            assert!(message.contains(part), "{message}");
        }
        assert_eq!(parse("500:1"), Ok(Samples::List(vec![(500.0, 1.0)])));
    }

    const SPECTRA: [(&str, SpectrumUse, [f32; 3]); 3] = [
        (
            "400:0, 500:8, 600:15.6, 700:18.4",
            SpectrumUse::Emission,
            [20.7108, 10.8546, 2.771_15],
        ),
        (
            "400:0.78, 500:0.78, 600:0.78, 700:0.78",
            SpectrumUse::Reflectance,
            [0.776_367, 0.779_81, 0.776_029],
        ),
        (
            "400:1.5, 550:0.7, 700:0.2",
            SpectrumUse::Unbounded,
            [0.370_591, 0.744_611, 1.270_49],
        ),
    ];
}
