//! From scene-referred colours to what a screen can show.

use specula_bsdf::Rgb;

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
