//! From scene-referred colours to what a screen can show.

use specula_bsdf::{Real, Rgb};

use super::srgb;

/// How values above 1 are mapped to those that a screen can show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ToneMap {
    /// They are clamped; values in `[0, 1]` are shown exactly.
    #[default]
    Clamp,
    /// A filmic shoulder per channel.
    ///
    /// ```text
    /// x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14)
    /// ```
    ///
    /// Source: Narkowicz 2015, ACES Filmic Tone Mapping Curve: a fit of the ACES reference and
    /// output transforms. Departure: none; as there, mid grey comes out brighter than with ACES
    /// unless the exposure is lowered by about 0.7 stops.
    Filmic,
}

/// How a picture is shown: exposure first, tone map second, sRGB encoding last.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Display {
    /// Tone map.
    pub tone_map: ToneMap,
    /// Exposure in stops: colours are multiplied by 2 to this power.
    pub exposure_stops: f32,
}

impl ToneMap {
    /// One linear channel to linear `[0, 1]`; NaN and negative values to 0.
    #[must_use]
    pub fn apply(self, x: f32) -> f32 {
        let x = x.max(0.0);
        match self {
            Self::Clamp => x.min(1.0),
            // Beyond 1e4 the curve is flat to single precision, and infinity would give NaN.
            Self::Filmic => {
                let x = x.min(1.0e4);
                ((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14)).min(1.0)
            }
        }
    }
}

impl Display {
    /// The colour as sRGB-encoded bytes.
    #[must_use]
    pub fn to_rgb8(self, colour: Rgb<f32>) -> [u8; 3] {
        let gain = self.exposure_stops.exp2();
        colour
            .to_array()
            .map(|c| srgb::to_byte(srgb::encode(self.tone_map.apply(c * gain))))
    }
}

/// The stops that show what is not black as mid grey, 0.18, on geometric average; 0 where all is black.
///
/// What is darker than a ten-thousandth of the mean counts as black.
#[must_use]
pub fn automatic_exposure(colours: &[Rgb<f32>]) -> f32 {
    const MID_GREY: f64 = 0.18;
    const BLACK: f64 = 1e-4;
    let lights = || {
        let all = colours.iter().map(|c| f64::from(c.luminance()));
        all.filter(|l| *l > 0.0 && l.is_finite())
    };
    let mean = lights().sum::<f64>() / (colours.len() as f64).max(1.0);
    let seen = || lights().filter(|l| *l > BLACK * mean);
    let count = seen().count();
    if count == 0 {
        return 0.0;
    }
    let logarithm = seen().map(f64::log2).sum::<f64>() / count as f64;
    f32::of(MID_GREY.log2() - logarithm)
}

#[cfg(test)]
mod tests {
    use super::*;
    use specula_bsdf::math::rgb;

    #[test]
    fn both_maps_start_at_black_stay_in_range_and_rise() {
        for map in [ToneMap::Clamp, ToneMap::Filmic] {
            assert_eq!(map.apply(0.0), 0.0);
            assert_eq!(map.apply(f32::NAN), 0.0);
            assert_eq!(map.apply(-3.0), 0.0);
            assert_eq!(map.apply(f32::INFINITY), 1.0);
            let mut last = 0.0;
            for i in 0..4000u16 {
                let y = map.apply(f32::from(i) * 0.005);
                assert!(y >= last && y <= 1.0, "{map:?} at {i}: {y} after {last}");
                last = y;
            }
        }
    }

    #[test]
    fn automatic_exposure_takes_what_is_seen_to_mid_grey() {
        let grey = |l: &[f32]| l.iter().map(|l| Rgb::splat(*l)).collect::<Vec<_>>();
        let stops = |l: &[f32]| automatic_exposure(&grey(l));
        assert!((stops(&[0.18; 3])).abs() < 1e-6);
        // The geometric mean of 0.72 and 0.045 is 0.18; black and what is no number count for nothing.
        assert!((stops(&[0.72, 0.045, 0.0, 1e-9, f32::NAN])).abs() < 1e-6);
        assert!((stops(&[720.0, 45.0]) + 1000.0_f32.log2()).abs() < 1e-5);
        assert_eq!(stops(&[0.0, f32::INFINITY]), 0.0);
        assert_eq!(stops(&[]), 0.0);
    }

    #[test]
    fn exposure_is_in_stops() {
        let display = Display {
            exposure_stops: 1.0,
            ..Display::default()
        };
        let plain = Display::default();
        assert_eq!(
            display.to_rgb8(rgb(0.25, 0.1, 0.4)),
            plain.to_rgb8(rgb(0.5, 0.2, 0.8))
        );
    }
}
