//! How PNG files look: `--exposure` and `--tone`.

use std::fmt;
use std::str::FromStr;

use clap::{Args, ValueEnum};

use crate::bsdf::Rgb;
use crate::render::picture::{Display, ToneMap, automatic_exposure};

use super::values;

/// How PNG files look.
#[derive(Args, Debug)]
pub(crate) struct DisplayArguments {
    /// Exposure of PNG files, in stops: +1 shows twice the light. `auto`: what is not black is mid grey on (geometric)
    /// average [default: 0; auto where a glTF file has lights, whose units are lux and candela]
    #[arg(long, value_name = "STOPS", allow_negative_numbers = true)]
    exposure: Option<ExposureChoice>,

    /// How PNG files show what is brighter than white
    #[arg(long, value_name = "NAME", default_value_t = ToneName::Clamp)]
    tone: ToneName,
}

/// `--exposure`.
#[derive(Clone, Copy, Debug, PartialEq)]
enum ExposureChoice {
    Stops(f32),
    Auto,
}

impl FromStr for ExposureChoice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        if text == "auto" {
            return Ok(Self::Auto);
        }
        let stops = values::finite(text).map_err(|e| format!("{e}, or `auto`"))?;
        Ok(Self::Stops(stops))
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ToneName {
    /// Cut off: all below white is shown exactly
    Clamp,
    /// Rolled off as film does (Narkowicz 2015)
    Filmic,
}

impl fmt::Display for ToneName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.to_possible_value()
            .map_or(Ok(()), |v| f.write_str(v.get_name()))
    }
}

/// How a picture is shown, once it is there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DisplayChoice {
    exposure: ExposureChoice,
    tone_map: ToneMap,
}

impl DisplayArguments {
    /// What was asked for.
    ///
    /// * `is_photometric`: whether lights are in units that say nothing of what is white.
    pub(crate) fn choice(&self, is_photometric: bool) -> DisplayChoice {
        let default = match is_photometric {
            true => ExposureChoice::Auto,
            false => ExposureChoice::Stops(0.0),
        };
        DisplayChoice {
            exposure: self.exposure.unwrap_or(default),
            tone_map: match self.tone {
                ToneName::Clamp => ToneMap::Clamp,
                ToneName::Filmic => ToneMap::Filmic,
            },
        }
    }
}

impl DisplayChoice {
    /// As the library takes it.
    pub(crate) fn of(&self, colours: &[Rgb<f32>]) -> Display {
        Display {
            tone_map: self.tone_map,
            exposure_stops: match self.exposure {
                ExposureChoice::Stops(stops) => stops,
                ExposureChoice::Auto => automatic_exposure(colours),
            },
        }
    }

    /// Whether the picture says how it is exposed.
    pub(crate) fn is_automatic(&self) -> bool {
        self.exposure == ExposureChoice::Auto
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stops_are_finite_or_automatic() {
        for (text, expected) in [
            ("auto", Some(ExposureChoice::Auto)),
            ("-1.5", Some(ExposureChoice::Stops(-1.5))),
            ("65", None),
            ("inf", None),
            ("NaN", None),
            ("bright", None),
        ] {
            assert_eq!(text.parse::<ExposureChoice>().ok(), expected, "{text}");
        }
    }

    #[test]
    fn photometric_scenes_are_exposed_by_what_they_show() {
        let arguments = |exposure| DisplayArguments {
            exposure,
            tone: ToneName::Clamp,
        };
        let bright = [Rgb::splat(1440.0); 4];
        let stops = |exposure, photometric| {
            let choice = arguments(exposure).choice(photometric);
            choice.of(&bright).exposure_stops
        };
        assert!((stops(None, true) + 12.966).abs() < 0.001);
        assert_eq!(stops(None, false), 0.0);
        assert_eq!(stops(Some(ExposureChoice::Stops(2.0)), true), 2.0);
    }
}
