//! Parameters that give a colour: rgb, spectra (named, in files, inline), blackbodies, textures.

use std::borrow::Cow;

use specula_bsdf::Rgb;

use super::context::Context;
use super::param::{Param, ParamList, Values};
use crate::error::{ErrorKind, Place, SceneError, SourceText};
use crate::num::{f32_of, shorten};
use crate::scene::{ColourParam, TextureId};
use crate::spectrum::{self, ColourSpace, Spectrum};

/// Types that a colour may have.
const KINDS: [&str; 4] = ["rgb", "spectrum", "blackbody", "texture"];

/// A colour as the file gives it.
#[derive(Clone, Debug)]
pub(super) enum Colour {
    /// As given, in its space.
    Rgb(Rgb<f32>, ColourSpace),
    Spectrum(Spectrum, OutsideRange),
    /// Temperature in kelvin.
    Blackbody(f32),
    Texture(TextureId),
}

/// Values of a spectrum outside of its samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum OutsideRange {
    /// Its end values: pbrt-v4's built-in spectra, and every index of refraction.
    Held,
    /// 0: spectra of the scene as colours.
    Zero,
}

impl OutsideRange {
    fn applied(self, spectrum: &Spectrum) -> Cow<'_, Spectrum> {
        match self {
            Self::Held => Cow::Borrowed(spectrum),
            Self::Zero => Cow::Owned(spectrum.zero_outside()),
        }
    }
}

impl Colour {
    /// As a reflectance, or another ratio.
    pub(super) fn under_white(&self) -> ColourParam {
        ColourParam::Value(match self {
            // Colours outside of sRGB's gamut are clamped.
            Self::Rgb(c, space) => space.surface(*c).map(|x| x.max(0.0)),
            Self::Spectrum(s, ends) => spectrum::reflectance_to_rgb(&ends.applied(s)),
            Self::Blackbody(kelvin) => spectrum::blackbody_to_rgb(*kelvin),
            Self::Texture(id) => return ColourParam::Texture(*id),
        })
    }
}

/// Reads a colour.
pub(super) fn colour(
    context: &Context,
    params: &ParamList,
    name: &str,
) -> Result<Option<Colour>, SceneError> {
    let Some(param) = params.find(name) else {
        return Ok(None);
    };
    let read = read(context, param, name);
    read.or_else(|error| params.record(error).map(|()| None))
}

fn read(context: &Context, param: &Param, name: &str) -> Result<Option<Colour>, SceneError> {
    match (param.kind, &param.values) {
        ("rgb", Values::Numbers(numbers)) => {
            let [r, g, b] = numbers.as_slice() else {
                return Err(param.wrong_type(&KINDS));
            };
            let c = Rgb {
                r: f32_of(*r),
                g: f32_of(*g),
                b: f32_of(*b),
            };
            Ok(Some(Colour::Rgb(
                not_negative(c, name, &param.place)?,
                param.space,
            )))
        }
        ("blackbody", Values::Numbers(numbers)) => match numbers.as_slice() {
            [kelvin] if (100.0..=1e6).contains(kelvin) => {
                Ok(Some(Colour::Blackbody(f32_of(*kelvin))))
            }
            _ => {
                let message =
                    format!("\"{name}\": expected one temperature from 100 to 1e6 kelvin");
                Err(SceneError::new(ErrorKind::Parameter, &param.place, message))
            }
        },
        ("spectrum", _) => {
            let (spectrum, ends) = read_spectrum(context, param)?;
            Ok(Some(Colour::Spectrum(spectrum, ends)))
        }
        ("texture", _) => {
            let id = context.texture_named(param, &context.colour_textures, "spectrum")?;
            Ok(Some(Colour::Texture(id)))
        }
        _ => Err(param.wrong_type(&KINDS)),
    }
}

/// A reflectance in `[0, 1]`.
pub(super) fn albedo(
    context: &mut Context,
    params: &ParamList,
    name: &str,
    default: f32,
) -> Result<ColourParam, SceneError> {
    Ok(albedo_or_none(context, params, name)?.unwrap_or(ColourParam::Value(Rgb::splat(default))))
}

/// A reflectance in `[0, 1]`, if the file gives one.
pub(super) fn albedo_or_none(
    context: &mut Context,
    params: &ParamList,
    name: &str,
) -> Result<Option<ColourParam>, SceneError> {
    let Some(colour) = colour(context, params, name)? else {
        return Ok(None);
    };
    let ColourParam::Value(c) = colour.under_white() else {
        return Ok(Some(colour.under_white()));
    };
    if let Colour::Rgb(given, _) = colour
        && (given.r > 1.0 || given.g > 1.0 || given.b > 1.0)
    {
        let message = format!("\"{name}\" is above 1; it is cut to 1");
        context.warn(&params.place_of(name), message);
    }
    // A spectrum may lie outside of sRGB's triangle: the nearest reflectance is used.
    Ok(Some(ColourParam::Value(c.map(|x| x.clamp(0.0, 1.0)))))
}

/// Emitted light. Spectra and blackbodies have luminance 1, as pbrt-v4 normalises them.
pub(super) fn emission(
    context: &Context,
    params: &ParamList,
    name: &str,
) -> Result<Option<Rgb<f32>>, SceneError> {
    let Some(colour) = colour(context, params, name)? else {
        return Ok(None);
    };
    let place = params.place_of(name);
    let c = match colour {
        Colour::Rgb(c, space) => space.light(c).map(|x| x.max(0.0)),
        // A monochromatic lamp lies outside of sRGB; no light is negative.
        Colour::Spectrum(s, ends) => {
            spectrum::illuminant_to_rgb(&ends.applied(&s)).map(|x| x.max(0.0))
        }
        Colour::Blackbody(kelvin) => spectrum::blackbody_to_rgb(kelvin).map(|x| x.max(0.0)),
        Colour::Texture(_) => {
            let message = format!(
                "\"{name}\": a light cannot have a texture; expected rgb, spectrum or blackbody"
            );
            return Err(SceneError::new(ErrorKind::Parameter, &place, message));
        }
    };
    if c.r.is_finite() && c.g.is_finite() && c.b.is_finite() {
        return Ok(Some(c));
    }
    let message = format!("\"{name}\": expected a spectrum that the eye can see");
    Err(SceneError::new(ErrorKind::Spectrum, &place, message))
}

/// An index of refraction: a number, or a spectrum at the sodium D line (587.6 nm). 0 means 1, as
/// in pbrt-v4.
pub(super) fn index(context: &Context, params: &ParamList, name: &str) -> Result<f32, SceneError> {
    let Some(param) = params.find(name) else {
        return Ok(1.5);
    };
    let eta = match param.kind {
        "float" => f32_of(params.float(name, 1.5)?),
        _ => match colour(context, params, name)? {
            Some(Colour::Spectrum(s, _)) => f32_of(s.value(spectrum::D_LINE_NM)),
            Some(Colour::Rgb(c, _)) => c.mean(),
            _ => return Err(param.wrong_type(&["float", "spectrum", "rgb"])),
        },
    };
    if eta == 0.0 {
        return Ok(1.0);
    }
    if eta > 0.0 && eta.is_finite() {
        return Ok(eta);
    }
    let message = format!("\"{name}\": expected an index of refraction above 0, found {eta}");
    Err(SceneError::new(ErrorKind::Parameter, &param.place, message))
}

/// Complex index of a metal as two colours.
pub(super) fn complex_index(eta: &Colour, k: &Colour) -> (ColourParam, ColourParam) {
    let curve = |c: &Colour| match c {
        Colour::Spectrum(s, _) => Some(s.clone()),
        Colour::Rgb(c, _) if c.r == c.g && c.g == c.b => Some(Spectrum::constant(f64::from(c.r))),
        _ => None,
    };
    if let (Some(eta), Some(k)) = (curve(eta), curve(k)) {
        let (eta, k) = spectrum::conductor_index_to_rgb(&eta, &k);
        return (ColourParam::Value(eta), ColourParam::Value(k));
    }
    (eta.under_white(), k.under_white())
}

fn not_negative(c: Rgb<f32>, name: &str, place: &Place) -> Result<Rgb<f32>, SceneError> {
    if c.r >= 0.0 && c.g >= 0.0 && c.b >= 0.0 {
        return Ok(c);
    }
    let message = format!(
        "\"{name}\": expected a colour that is not negative, found {} {} {}",
        c.r, c.g, c.b
    );
    Err(SceneError::new(ErrorKind::Parameter, place, message))
}

fn read_spectrum(context: &Context, param: &Param) -> Result<(Spectrum, OutsideRange), SceneError> {
    match &param.values {
        Values::Numbers(numbers) => {
            let wrong =
                |message: String| SceneError::new(ErrorKind::Spectrum, &param.place, message);
            let (pairs, rest) = numbers.as_chunks::<2>();
            if !rest.is_empty() {
                return Err(wrong(format!(
                    "\"{}\": expected pairs of wavelength and value",
                    param.name
                )));
            }
            let samples = pairs.iter().map(|[nm, v]| (*nm, *v)).collect();
            let spectrum =
                Spectrum::new(samples).map_err(|e| wrong(format!("\"{}\": {e}", param.name)))?;
            Ok((spectrum, OutsideRange::Zero))
        }
        Values::Texts(texts) => {
            let [(name, place)] = texts.as_slice() else {
                return Err(param.wrong_type(&["spectrum"]));
            };
            match spectrum::named(name).or_else(|| metal(context, name)) {
                Some(spectrum) => Ok((spectrum, OutsideRange::Held)),
                None => Ok((spectrum_file(context, name, place)?, OutsideRange::Zero)),
            }
        }
        Values::Bools(_) => Err(param.wrong_type(&["spectrum"])),
    }
}

/// The metal of one of pbrt-v3's own files, such as `spds/Cu.eta.spd`, where the file is not there.
fn metal(context: &Context, name: &str) -> Option<Spectrum> {
    if context.v3.is_none() || context.resolve(name).exists() {
        return None;
    }
    let file = name.rsplit(['/', '\\']).next()?.strip_suffix(".spd")?;
    let (metal, part) = file.rsplit_once('.')?;
    spectrum::named(&format!("metal-{metal}-{part}"))
}

fn spectrum_file(context: &Context, name: &str, place: &Place) -> Result<Spectrum, SceneError> {
    let path = context.resolve(name);
    let bytes = context.files.plain(&path).map_err(|e| {
        let expected = "expected a name such as metal-Au-eta or glass-BK7, or a .spd file";
        let hint = context.search.hint(&path);
        let hint = hint.map(|hint| format!("{expected}; {hint}"));
        let message = format!(
            "\"{}\" is no known spectrum, nor a file that can be read: it {e}",
            shorten(name)
        );
        SceneError::new(ErrorKind::Spectrum, place, message)
            .with_help(expected)
            .if_missing(hint, &path)
    })?;
    let text = String::from_utf8_lossy(&bytes).into_owned();
    spectrum::parse_spd(&text).map_err(|e| {
        let start: usize = text
            .split_inclusive('\n')
            .take(e.line.saturating_sub(1))
            .map(str::len)
            .sum();
        let length = text[start..].lines().next().map_or(0, str::len);
        let file = Place::new(
            &SourceText::new(path.display().to_string(), text.as_str()),
            start,
            length,
        );
        SceneError::new(
            ErrorKind::Spectrum,
            &file,
            format!("spectrum {}: {e}", path.display()),
        )
    })
}
