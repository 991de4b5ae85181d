//! Textures from pictures.

use super::mapping::mapping;
use super::{TextureNode, TextureType};
use crate::error::{ErrorKind, SceneError};
use crate::image::{Content, Encoding, Format};
use crate::num::{f32_of, shorten};
use crate::pbrt::context::Context;
use crate::pbrt::param::ParamList;
use crate::scene::{Channel, Interpolation, Texture, TextureId, Wrap};

/// Reads the class `imagemap`.
pub(super) fn read(context: &mut Context, node: &TextureNode<'_>) -> Result<TextureId, SceneError> {
    let params = node.params();
    let mapping = mapping(node)?;
    let filter = filter(context, params)?;
    let Some((name, place)) = params.string("filename")? else {
        let message = "texture \"imagemap\" needs its \"string filename\"";
        let place = &node.entity.place;
        return Err(SceneError::new(ErrorKind::Parameter, place, message));
    };
    let encoding = encoding(context, params, name)?;
    let (content, channel) = match node.kind {
        TextureType::Float => (Content::Number, Channel::Mean),
        TextureType::Colour => (Content::Colour, Channel::Rgb),
    };
    let wrap = wrap(context, params)?;
    let scale = f32_of(params.float("scale", 1.0)?);
    let invert = params.bool("invert", false)?;
    // pbrt-v4 inverts what is scaled, 1 - scale * value; the model scales what is inverted.
    let apart = invert && scale != 1.0;
    let texture = Texture::Image {
        image: context.image(name, place, encoding, content),
        mapping,
        wrap: [wrap; 2],
        filter,
        invert: invert && !apart,
        scale: if apart { -scale } else { scale },
        channel,
    };
    let picture = context.add_texture(texture);
    if !apart {
        return Ok(picture);
    }
    let one = context.constant(1.0);
    Ok(context.add_texture(Texture::Sum { a: one, b: picture }))
}

/// Departure: pbrt-v4's `point` and `bilinear` take a level of the pyramid by the footprint, too; here they take the
/// picture itself.
fn filter(context: &mut Context, params: &ParamList) -> Result<Interpolation, SceneError> {
    let max_anisotropy = max_anisotropy(context, params)?;
    match params.string("filter")? {
        Some(("point", _)) => Ok(Interpolation::Nearest),
        None | Some(("bilinear", _)) => Ok(Interpolation::Bilinear),
        Some(("trilinear", _)) => Ok(Interpolation::Trilinear),
        Some(("ewa" | "EWA", _)) => Ok(Interpolation::Ewa { max_anisotropy }),
        Some((other, place)) => {
            let message = format!("unknown filter \"{}\"", shorten(other));
            let error = SceneError::new(ErrorKind::Parameter, place, message);
            Err(error.with_help("expected point, bilinear, trilinear or ewa"))
        }
    }
}

/// Ratio of the axes of the longest ellipses.
fn max_anisotropy(context: &mut Context, params: &ParamList) -> Result<f32, SceneError> {
    const NAME: &str = "maxanisotropy";
    let value = f32_of(params.float(NAME, 8.0)?);
    let place = &params.place_of(NAME);
    if value.is_nan() || value < 1.0 {
        let message = format!("\"{NAME}\" is the ratio of an ellipse's axes: {value} is below 1");
        return Err(SceneError::new(ErrorKind::Parameter, place, message));
    }
    let most = Interpolation::MOST_ANISOTROPY;
    if value > most {
        context.warn(
            place,
            format!("\"{NAME}\" {value} is more than is filtered: {most} is used"),
        );
    }
    Ok(value.min(most))
}

fn wrap(context: &mut Context, params: &ParamList) -> Result<Wrap, SceneError> {
    match params.string("wrap")? {
        None | Some(("repeat", _)) => Ok(Wrap::Repeat),
        Some(("black", _)) => Ok(Wrap::Black),
        Some(("clamp", _)) => Ok(Wrap::Clamp),
        Some(("octahedralsphere", place)) => {
            let message = "wrap \"octahedralsphere\" is not supported: \"clamp\" is used";
            context.warn(place, message);
            Ok(Wrap::Clamp)
        }
        Some((other, place)) => {
            let message = format!(
                "expected wrap \"repeat\", \"black\" or \"clamp\", found \"{}\"",
                shorten(other)
            );
            Err(SceneError::new(ErrorKind::Parameter, place, message))
        }
    }
}

/// pbrt-v4 heeds `encoding` for PNG alone; other 8-bit formats are sRGB and float formats linear.
fn encoding(context: &mut Context, params: &ParamList, file: &str) -> Result<Encoding, SceneError> {
    let Some((name, place)) = params.string("encoding")? else {
        return Ok(Encoding::Srgb);
    };
    let gamma = || {
        let exponent = name.strip_prefix("gamma")?.trim().parse::<f32>().ok()?;
        (exponent.is_finite() && exponent > 0.0).then_some(Encoding::Gamma(exponent))
    };
    let encoding = match name {
        "sRGB" => Some(Encoding::Srgb),
        "linear" => Some(Encoding::Linear),
        _ => gamma(),
    };
    let Some(encoding) = encoding else {
        let message = format!(
            "expected encoding \"sRGB\", \"linear\" or \"gamma 2.2\", found \"{}\"",
            shorten(name)
        );
        return Err(SceneError::new(ErrorKind::Parameter, place, message));
    };
    let format = Format::of_name(&context.resolve(file));
    if matches!(format, Some(Format::Tga | Format::Jpeg)) && encoding != Encoding::Srgb {
        context.warn(
            place,
            "\"encoding\" holds for PNG alone, as in pbrt-v4: the picture is read as sRGB",
        );
        return Ok(Encoding::Srgb);
    }
    Ok(encoding)
}
