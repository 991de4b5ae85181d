//! `Texture`: nodes of the texture graph.

use std::rc::Rc;

use specula_bsdf::Rgb;

use super::colour::{self, Colour};
use super::context::{Context, Entity};
use super::param::{Param, ParamList};
use super::token::{Tokens, shorten};
use crate::error::{ErrorKind, Place, SceneError};
use crate::image::{Content, Encoding, Format};
use crate::num::f32_of;
use crate::scene::{ColourParam, FloatParam, Texture, TextureId, UvMapping, Wrap};

/// Whether a texture gives numbers or colours; pbrt-v4 keeps their names apart.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Float,
    Colour,
}

/// Reads what follows the word `Texture`.
pub(super) fn read(
    context: &mut Context,
    inherited: &[Rc<Param>],
    tokens: &mut Tokens<'_>,
) -> Result<(), SceneError> {
    let (name, name_place) = tokens.expect_text("the name of the texture")?;
    let (kind, kind_place) = tokens.expect_text("the texture's type")?;
    let kind = match kind.as_str() {
        "float" => Kind::Float,
        "spectrum" | "color" => Kind::Colour,
        other => {
            let message = format!(
                "expected \"float\" or \"spectrum\", found \"{}\"",
                shorten(other)
            );
            return Err(SceneError::new(ErrorKind::Syntax, &kind_place, message));
        }
    };
    let (class, place) = tokens.expect_text("the texture's class")?;
    let params = ParamList::read(tokens)?.with_inherited(inherited);
    let entity = Entity {
        name: class,
        place,
        params,
    };
    let id = texture(context, &entity, kind)?;
    context.warn_unused(&entity.params);
    let names = match kind {
        Kind::Float => &mut context.float_textures,
        Kind::Colour => &mut context.colour_textures,
    };
    if names.insert(name.clone(), id).is_some() {
        let message = format!("texture \"{}\" is defined twice", shorten(&name));
        return Err(SceneError::new(ErrorKind::Duplicate, &name_place, message));
    }
    Ok(())
}

fn texture(context: &mut Context, entity: &Entity, kind: Kind) -> Result<TextureId, SceneError> {
    let params = &entity.params;
    match entity.name.as_str() {
        "constant" => input(context, params, "value", 1.0, kind),
        "imagemap" => image_map(context, entity, kind),
        "scale" => {
            let a = input(context, params, "tex", 1.0, kind)?;
            let b = input(context, params, "scale", 1.0, Kind::Float)?;
            Ok(context.add_texture(Texture::Scale { a, b }))
        }
        "mix" | "directionmix" => {
            let a = input(context, params, "tex1", 0.0, kind)?;
            let b = input(context, params, "tex2", 1.0, kind)?;
            let amount = if entity.name == "mix" {
                context.float(params, "amount", 0.5)?
            } else {
                params.ignore(&["dir"]);
                context.warn(
                    &entity.place,
                    "texture \"directionmix\" is not supported: the mean of both is used",
                );
                FloatParam::Value(0.5)
            };
            Ok(context.add_texture(Texture::Mix { a, b, amount }))
        }
        "checkerboard" => {
            if params.integer("dimension", 2)? != 2 {
                context.warn(
                    &entity.place,
                    "a checkerboard in 3 dimensions is rendered in 2",
                );
            }
            let even = input(context, params, "tex1", 1.0, kind)?;
            let odd = input(context, params, "tex2", 0.0, kind)?;
            let mapping = mapping(context, params, &entity.place)?;
            Ok(context.add_texture(Texture::Checkerboard { even, odd, mapping }))
        }
        class @ ("bilerp" | "dots" | "fbm" | "marble" | "ptex" | "windy" | "wrinkled") => {
            let message = format!("texture \"{class}\" is not supported: 0.5 everywhere is used");
            context.warn(&entity.place, message);
            Ok(context.constant(0.5))
        }
        other => {
            let message = format!("unknown texture class \"{}\"", shorten(other));
            Err(
                SceneError::new(ErrorKind::Parameter, &entity.place, message)
                    .with_help("expected constant, imagemap, scale, mix or checkerboard"),
            )
        }
    }
}

/// A texture that is given by value or by name.
fn input(
    context: &mut Context,
    params: &ParamList,
    name: &str,
    default: f32,
    kind: Kind,
) -> Result<TextureId, SceneError> {
    if kind == Kind::Float {
        return Ok(match context.float(params, name, default)? {
            FloatParam::Texture(id) => id,
            FloatParam::Value(v) => context.constant(v),
        });
    }
    Ok(match colour::colour(context, params, name)? {
        None => context.constant(default),
        Some(Colour::Texture(id)) => id,
        Some(colour) => match colour.under_white() {
            ColourParam::Texture(id) => id,
            ColourParam::Value(c) => context.add_texture(Texture::Constant(c.map(|x| x.max(0.0)))),
        },
    })
}

fn mapping(
    context: &mut Context,
    params: &ParamList,
    place: &Place,
) -> Result<UvMapping, SceneError> {
    if let Some((name, _)) = params.string("mapping")?
        && name != "uv"
    {
        let message = format!(
            "mapping \"{}\" is not supported: surface coordinates are used",
            shorten(name)
        );
        params.ignore(&["v1", "v2"]);
        context.warn(place, message);
    }
    let number = |name: &str, default: f64| params.float(name, default).map(f32_of);
    Ok(UvMapping {
        scale: [number("uscale", 1.0)?, number("vscale", 1.0)?],
        offset: [number("udelta", 0.0)?, number("vdelta", 0.0)?],
    })
}

fn image_map(context: &mut Context, entity: &Entity, kind: Kind) -> Result<TextureId, SceneError> {
    let params = &entity.params;
    let mapping = mapping(context, params, &entity.place)?;
    // Pictures are filtered bilinearly, whatever the file asks for.
    params.ignore(&["filter", "maxanisotropy"]);
    let wrap = match params.string("wrap")? {
        None | Some(("repeat", _)) => Wrap::Repeat,
        Some(("black", _)) => Wrap::Black,
        Some(("clamp", _)) => Wrap::Clamp,
        Some(("octahedralsphere", place)) => {
            context.warn(
                place,
                "wrap \"octahedralsphere\" is not supported: \"clamp\" is used",
            );
            Wrap::Clamp
        }
        Some((other, place)) => {
            let message = format!(
                "expected wrap \"repeat\", \"black\" or \"clamp\", found \"{}\"",
                shorten(other)
            );
            return Err(SceneError::new(ErrorKind::Parameter, place, message));
        }
    };
    let Some((name, place)) = params.string("filename")? else {
        let message = "texture \"imagemap\" needs its \"string filename\"";
        return Err(SceneError::new(
            ErrorKind::Parameter,
            &entity.place,
            message,
        ));
    };
    let encoding = encoding(context, params, name)?;
    let content = if kind == Kind::Float {
        Content::Number
    } else {
        Content::Colour
    };
    let image = context.image(name, place, encoding, content)?;
    Ok(context.add_texture(Texture::Image {
        image,
        mapping,
        wrap,
        invert: params.bool("invert", false)?,
        scale: f32_of(params.float("scale", 1.0)?),
        as_float: kind == Kind::Float,
    }))
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
    let format = Format::of(&context.resolve(file));
    if matches!(format, Some(Format::Tga | Format::Jpeg)) && encoding != Encoding::Srgb {
        context.warn(
            place,
            "\"encoding\" holds for PNG alone, as in pbrt-v4: the picture is read as sRGB",
        );
        return Ok(Encoding::Srgb);
    }
    Ok(encoding)
}

/// Mean colour of a picture.
pub(super) fn mean(image: &crate::image::Image) -> Rgb<f32> {
    let mut sum = [0.0f64; 3];
    for pixel in &image.pixels {
        for (s, p) in sum.iter_mut().zip(pixel) {
            *s += f64::from(*p);
        }
    }
    let [r, g, b] = sum.map(|s| f32_of(s / image.pixels.len().max(1) as f64));
    Rgb { r, g, b }
}
