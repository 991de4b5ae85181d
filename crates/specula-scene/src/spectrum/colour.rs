//! Spectra to linear sRGB through the CIE 1931 observer.
//!
//! ```text
//! X = sum xbar(nm) S(nm),  Y and Z alike        (1 nm steps, 360 to 830 nm)
//! rgb = M (X, Y, Z)
//! ```
//!
//! `M` takes the chromaticities of the sRGB primaries (IEC 61966-2-1) and, as its white, the D65 of
//! these very tables, x = 0.31272, y = 0.32903, instead of the rounded (0.3127, 0.3290). The white
//! is then exactly `(1, 1, 1)`; the entries differ from the standard's by less than 1e-3.

use std::sync::OnceLock;

use glam::{DMat3, DVec3};
use specula_bsdf::{Rgb, math::rgb};

use super::Spectrum;
use super::cie_1931::{FIRST_NM, XYZ_BAR};
use super::illuminants::illuminant_d65;

/// Colour of a reflectance (or transmittance, or albedo) under D65.
///
/// ```text
/// rgb = M sum (xbar, ybar, zbar) D65 s / sum ybar D65
/// ```
///
/// * Returns: linear sRGB. Normalised by the integrated white: reflectance 1 is `(1, 1, 1)`. A
///   saturated spectrum may lie outside the gamut of sRGB: channels are then clamped to
///   `[0, max(1, largest sample)]`, so that a reflectance never creates energy.
///
/// Source: CIE 015:2018, section 7.1. Departure: the clamp.
/// Invariant: a constant spectrum is grey (test `constant_reflectance_is_grey`).
#[must_use]
pub fn reflectance_to_rgb(spectrum: &Spectrum) -> Rgb<f32> {
    let largest = spectrum.samples().iter().map(|s| s.1).fold(1.0, f64::max);
    to_f32(under_d65(|nm| spectrum.value(nm)).map(|c| c.clamp(0.0, largest)))
}

/// Colour of an emission spectrum at luminance 1.
///
/// ```text
/// rgb = M (X, Y, Z) / Y
/// ```
///
/// * Returns: linear sRGB of luminance 1, black where the luminance is not positive. The absolute
///   power is dropped, as pbrt does when it normalises emission, so a scene's scale alone decides
///   the brightness; D65 is `(1, 1, 1)`. A light outside the gamut (a candle, a laser) has its
///   negative channels set to 0 and is scaled to luminance 1 again.
///
/// Source: pbrt-v4, `PiecewiseLinearSpectrum::FromInterleaved` with `normalize`.
/// Departure: the clamp; pbrt renders spectra.
#[must_use]
pub fn illuminant_to_rgb(spectrum: &Spectrum) -> Rgb<f32> {
    emission_to_rgb(xyz(spectrum))
}

/// `(X, Y, Z)` of an emission to RGB at luminance 1.
pub(super) fn emission_to_rgb(xyz: [f64; 3]) -> Rgb<f32> {
    if !(xyz[1].is_finite() && xyz[1] > 0.0) {
        return Rgb::BLACK;
    }
    let space = Space::get();
    let inside = (space.rgb_from_xyz * (DVec3::from(xyz) / xyz[1])).max(DVec3::ZERO);
    let luminance = (space.xyz_from_rgb * inside).y;
    to_f32((inside / luminance).to_array())
}

/// Tristimulus values of an emission, in units of (spectrum) nm.
pub(super) fn xyz(spectrum: &Spectrum) -> [f64; 3] {
    integrate(|nm| spectrum.value(nm))
}

/// `sum (xbar, ybar, zbar) f`.
pub(super) fn integrate(f: impl Fn(f64) -> f64) -> [f64; 3] {
    let mut sum = DVec3::ZERO;
    for (nm, bar) in wavelengths().zip(&XYZ_BAR) {
        sum += DVec3::from(*bar) * f(nm);
    }
    sum.to_array()
}

/// Linear sRGB under D65 of a reflectance `f(nm)`, not clamped.
pub(super) fn under_d65(f: impl Fn(f64) -> f64) -> [f64; 3] {
    let mut sum = DVec3::ZERO;
    for (nm, weight) in wavelengths().zip(channel_weights()) {
        sum += *weight * f(nm);
    }
    sum.to_array()
}

/// Weights by which [`under_d65`] sums, one per nanometre; they sum to `(1, 1, 1)`, and some are
/// negative.
pub(super) fn channel_weights() -> &'static [DVec3] {
    &Space::get().channel_weights
}

/// The wavelengths of the sums, in nm.
pub(super) fn wavelengths() -> impl Iterator<Item = f64> {
    (0_u32..)
        .take(XYZ_BAR.len())
        .map(|i| FIRST_NM + f64::from(i))
}

/// CIE XYZ to linear sRGB.
pub(super) fn rgb_from_xyz() -> DMat3 {
    Space::get().rgb_from_xyz
}

/// Linear sRGB to CIE XYZ; white has Y = 1.
pub(super) fn xyz_from_rgb() -> DMat3 {
    Space::get().xyz_from_rgb
}

/// `f64` to the renderer's precision.
#[expect(clippy::cast_possible_truncation, reason = "the renderer is f32")]
pub(super) fn to_f32([r, g, b]: [f64; 3]) -> Rgb<f32> {
    rgb(r as f32, g as f32, b as f32)
}

/// Matrices and weights of the sums, computed once.
struct Space {
    rgb_from_xyz: DMat3,
    xyz_from_rgb: DMat3,
    channel_weights: Vec<DVec3>,
}

impl Space {
    fn get() -> &'static Self {
        static SPACE: OnceLock<Space> = OnceLock::new();
        SPACE.get_or_init(Self::new)
    }

    fn new() -> Self {
        let d65 = illuminant_d65();
        let sum = DVec3::from(xyz(&d65));
        let white = sum / sum.y;
        // Columns: the primaries of IEC 61966-2-1 as (x, y, 1 - x - y).
        let primaries = DMat3::from_cols(
            DVec3::new(0.64, 0.33, 0.03),
            DVec3::new(0.30, 0.60, 0.10),
            DVec3::new(0.15, 0.06, 0.79),
        );
        let scale = primaries.inverse() * white;
        let xyz_from_rgb = primaries * DMat3::from_diagonal(scale);
        let rgb_from_xyz = xyz_from_rgb.inverse();
        let channel_weights = wavelengths()
            .zip(&XYZ_BAR)
            .map(|(nm, bar)| rgb_from_xyz * DVec3::from(*bar) * (d65.value(nm) / sum.y))
            .collect();
        Self {
            rgb_from_xyz,
            xyz_from_rgb,
            channel_weights,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::illuminants::{illuminant_a, illuminant_d50, illuminant_d60};
    use super::*;

    fn chromaticity(s: &Spectrum) -> (f64, f64) {
        let [x, y, z] = xyz(s);
        (x / (x + y + z), y / (x + y + z))
    }

    fn close(found: Rgb<f32>, expected: [f32; 3], tolerance: f32) {
        for (f, e) in found.to_array().into_iter().zip(expected) {
            assert!((f - e).abs() <= tolerance, "{found:?} != {expected:?}");
        }
    }

    #[test]
    fn observer_has_the_published_sums_and_peak() {
        // CIE 018:2019: the three functions have equal areas (E is white), ybar peaks at 555 nm.
        let sums = integrate(|_| 1.0);
        for (s, e) in sums.into_iter().zip([106.8655, 106.8569, 106.8923]) {
            assert!((s - e).abs() < 1e-3, "{sums:?}");
        }
        let peak = wavelengths().zip(&XYZ_BAR).find(|(_, bar)| bar[1] == 1.0);
        assert_eq!(peak.map(|p| p.0), Some(555.0));
    }

    #[test]
    fn white_points_are_the_published_ones() {
        for (name, s, x, y) in [
            ("D65", illuminant_d65(), 0.3127, 0.3290),
            ("D50", illuminant_d50(), 0.3457, 0.3585),
            ("A", illuminant_a(), 0.44758, 0.40745),
            ("D60", illuminant_d60(), 0.32168, 0.33767),
        ] {
            let (cx, cy) = chromaticity(&s);
            assert!((cx - x).abs() < 1e-4, "{name}: x = {cx}");
            assert!((cy - y).abs() < 1e-4, "{name}: y = {cy}");
        }
    }

    /// IEC 61966-2-1:1999, equation for linear sRGB; Specula's has the white unrounded.
    #[test]
    fn matrix_is_that_of_srgb() {
        let iec = DMat3::from_cols_array_2d(&[
            [3.2406, -0.9689, 0.0557],
            [-1.5372, 1.8758, -0.2040],
            [-0.4986, 0.0415, 1.0570],
        ]);
        assert!(Space::get().rgb_from_xyz.abs_diff_eq(iec, 1e-3));
        let to_xyz = Space::get().xyz_from_rgb;
        let luminance = DVec3::new(to_xyz.x_axis.y, to_xyz.y_axis.y, to_xyz.z_axis.y);
        assert!(luminance.abs_diff_eq(DVec3::new(0.2126, 0.7152, 0.0722), 1e-4));
    }

    #[test]
    fn constant_reflectance_is_grey() {
        for v in [0.0, 0.18, 0.5, 1.0] {
            let c = reflectance_to_rgb(&Spectrum::constant(v));
            #[expect(clippy::cast_possible_truncation, reason = "a test value")]
            close(c, [v as f32; 3], 1e-6);
        }
    }

    #[test]
    fn reflectance_stays_inside_the_gamut() {
        // A sharp red edge is more saturated than the red primary: green and blue would be < 0.
        let edge = Spectrum::new(vec![(599.0, 0.0), (600.0, 1.0)]).unwrap();
        let raw = under_d65(|nm| edge.value(nm));
        assert!(raw[1] < 0.0, "{raw:?}");
        let c = reflectance_to_rgb(&edge);
        assert!(c.g == 0.0 && c.b >= 0.0 && c.r <= 1.0, "{c:?}");
        // A yellow edge has red above 1.
        let edge = Spectrum::new(vec![(519.0, 0.0), (520.0, 1.0)]).unwrap();
        assert!(under_d65(|nm| edge.value(nm))[0] > 1.0);
        assert_eq!(reflectance_to_rgb(&edge).r, 1.0);
    }

    #[test]
    fn d65_emits_white_and_power_does_not_matter() {
        let d65 = illuminant_d65();
        close(illuminant_to_rgb(&d65), [1.0; 3], 1e-6);
        let brighter = d65.samples().iter().map(|&(w, v)| (w, 7.0 * v)).collect();
        let brighter = Spectrum::new(brighter).unwrap();
        close(illuminant_to_rgb(&brighter), [1.0; 3], 1e-6);
    }

    #[test]
    fn lamp_a_is_orange_at_luminance_one() {
        // Chromaticity (0.44758, 0.40745) at Y = 1 through the matrix of IEC 61966-2-1.
        close(
            illuminant_to_rgb(&illuminant_a()),
            [1.8452, 0.8263, 0.2333],
            2e-3,
        );
    }

    #[test]
    fn emission_outside_the_gamut_keeps_its_luminance() {
        let laser = Spectrum::new(vec![(529.0, 0.0), (530.0, 1.0), (531.0, 0.0)]).unwrap();
        let c = illuminant_to_rgb(&laser);
        assert_eq!((c.r, c.b), (0.0, 0.0));
        assert!((c.luminance() - 1.0).abs() < 1e-3, "{c:?}");
        assert_eq!(illuminant_to_rgb(&Spectrum::constant(0.0)), Rgb::BLACK);
        assert_eq!(illuminant_to_rgb(&Spectrum::constant(-1.0)), Rgb::BLACK);
    }
}
