//! `Texture`: nodes of the texture graph.

mod imagemap;
mod mapping;

use glam::{DMat4, DVec3};
use specula_bsdf::Rgb;

use super::colour::{self, Colour};
use super::context::{Context, Entity};
use super::param::ParamList;
use super::state::State;
use super::token::Tokens;
use super::v3;
use crate::error::{ErrorKind, SceneError};
use crate::num::{f32_of, shorten};
use crate::scene::{ColourParam, FloatParam, NoiseKind, Texture, TextureId};
use crate::transform::check_transform;
use mapping::mapping;

/// Whether a texture gives numbers or colours; each type has names of its own.
#[derive(Clone, Copy, PartialEq, Eq)]
enum TextureType {
    Float,
    Colour,
}

impl TextureType {
    fn name(self) -> &'static str {
        match self {
            Self::Float => "float",
            Self::Colour => "spectrum",
        }
    }
}

/// A texture node that is being read.
struct TextureNode<'a> {
    entity: &'a Entity,
    kind: TextureType,
    /// Texture space to world space.
    to_world: DMat4,
}

impl TextureNode<'_> {
    fn params(&self) -> &ParamList {
        &self.entity.params
    }

    /// World space to texture space.
    fn to_texture(&self) -> Result<DMat4, SceneError> {
        match check_transform(&self.to_world) {
            Ok(()) => Ok(self.to_world.inverse()),
            Err(m) => Err(SceneError::new(ErrorKind::Transform, &self.entity.place, m)),
        }
    }
}

/// Reads what follows the word `Texture`.
pub(super) fn read(
    context: &mut Context,
    state: &State,
    tokens: &mut Tokens<'_>,
) -> Result<(), SceneError> {
    let (mut name, name_place) = tokens.expect_text("the name of the texture")?;
    let (kind, kind_place) = tokens.expect_text("the texture's type")?;
    let kind = match kind.as_str() {
        "float" => TextureType::Float,
        "spectrum" | "color" => TextureType::Colour,
        other => {
            let message = format!(
                "expected \"float\" or \"spectrum\", found \"{}\"",
                shorten(other)
            );
            // Nothing that refers to it is reported again.
            let id = context.constant(0.5);
            for names in [&mut context.float_textures, &mut context.colour_textures] {
                names.define(name.clone(), id, name_place.clone());
            }
            return Err(SceneError::new(ErrorKind::Syntax, &kind_place, message));
        }
    };
    let (class, place) = tokens.expect_text("the texture's class")?;
    let params = ParamList::read(tokens, state.space)?.with_inherited(&state.attributes[4]);
    let mut entity = Entity {
        name: class,
        place,
        params,
    };
    v3::texture(context, kind == TextureType::Float, &mut entity);
    if let Some(names) = &mut context.v3 {
        names.define(v3::Kind::Texture(kind.name()), &mut name);
    }
    let node = TextureNode {
        entity: &entity,
        kind,
        to_world: state.transforms[0],
    };
    let read = texture(context, &node);
    let id = entity.or(read, || context.constant(0.5))?;
    context.warn_unused(&entity.params);
    let names = match kind {
        TextureType::Float => &mut context.float_textures,
        TextureType::Colour => &mut context.colour_textures,
    };
    let message = format!("texture \"{}\" is defined twice", shorten(&name));
    if names.define(name, id, name_place.clone()) {
        return Ok(());
    }
    let error = SceneError::new(ErrorKind::Duplicate, &name_place, message);
    context.problems.record(error)
}

fn texture(context: &mut Context, node: &TextureNode<'_>) -> Result<TextureId, SceneError> {
    let (params, kind) = (node.params(), node.kind);
    let texture = match (node.entity.name.as_str(), kind) {
        ("constant", _) => return input(context, params, "value", 1.0, kind),
        ("imagemap", _) => return imagemap::read(context, node),
        ("scale", _) => Texture::Scale {
            a: input(context, params, "tex", 1.0, kind)?,
            b: input(context, params, "scale", 1.0, TextureType::Float)?,
        },
        ("mix", _) => Texture::Mix {
            a: input(context, params, "tex1", 0.0, kind)?,
            b: input(context, params, "tex2", 1.0, kind)?,
            amount: context.float(params, "amount", 0.5)?,
        },
        ("directionmix", _) => direction_mix(context, node)?,
        ("checkerboard", _) => checkerboard(context, node)?,
        ("bilerp", _) => Texture::Bilinear {
            corners: [
                corner(context, node, "v00", 0.0)?,
                corner(context, node, "v01", 1.0)?,
                corner(context, node, "v10", 0.0)?,
                corner(context, node, "v11", 1.0)?,
            ],
            mapping: mapping(node)?,
        },
        ("dots", _) => Texture::Dots {
            inside: input(context, params, "inside", 1.0, kind)?,
            outside: input(context, params, "outside", 0.0, kind)?,
            mapping: mapping(node)?,
        },
        ("fbm", TextureType::Float) => noise(node, NoiseKind::Fbm)?,
        ("wrinkled", TextureType::Float) => noise(node, NoiseKind::Turbulence)?,
        ("windy", TextureType::Float) => Texture::Noise {
            kind: NoiseKind::Windy,
            octaves: 0,
            roughness: 0.0,
            to_texture: node.to_texture()?,
        },
        ("marble", TextureType::Colour) => {
            let scale = f32_of(params.float("scale", 1.0)?);
            let variation = f32_of(params.float("variation", 0.2)?);
            noise(node, NoiseKind::Marble { scale, variation })?
        }
        ("ptex", _) => {
            params.ignore(&["filename", "encoding", "scale"]);
            let message = "texture \"ptex\" is not supported: 0.5 everywhere is used";
            context.warn(&node.entity.place, message);
            return Ok(context.constant(0.5));
        }
        (other, _) => return Err(unknown(node, other)),
    };
    Ok(context.add_texture(texture))
}

fn unknown(node: &TextureNode<'_>, class: &str) -> SceneError {
    let both = "constant, imagemap, scale, mix, directionmix, checkerboard, bilerp, dots, ptex";
    let (kind, own) = match node.kind {
        TextureType::Float => ("float", "fbm, wrinkled or windy"),
        TextureType::Colour => ("spectrum", "marble"),
    };
    let message = format!("unknown class \"{}\" of {kind} textures", shorten(class));
    SceneError::new(ErrorKind::Parameter, &node.entity.place, message)
        .with_help(format!("expected {both}, {own}"))
}

/// A texture that is given by value or by name.
fn input(
    context: &mut Context,
    params: &ParamList,
    name: &str,
    default: f32,
    kind: TextureType,
) -> Result<TextureId, SceneError> {
    if kind == TextureType::Float {
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

/// A value at a corner: pbrt-v4 takes no textures there.
fn corner(
    context: &Context,
    node: &TextureNode<'_>,
    name: &str,
    default: f32,
) -> Result<Rgb<f32>, SceneError> {
    let params = node.params();
    if node.kind == TextureType::Float {
        let value = params.float(name, f64::from(default))?;
        return Ok(Rgb::splat(f32_of(value)));
    }
    let Some(colour) = colour::colour(context, params, name)? else {
        return Ok(Rgb::splat(default));
    };
    match colour.under_white() {
        ColourParam::Value(c) => Ok(c.map(|x| x.max(0.0))),
        ColourParam::Texture(_) => {
            let message = format!("\"{name}\": expected a value; textures are not taken here");
            let place = params.place_of(name);
            Err(SceneError::new(ErrorKind::Parameter, &place, message))
        }
    }
}

fn checkerboard(context: &mut Context, node: &TextureNode<'_>) -> Result<Texture, SceneError> {
    let params = node.params();
    let even = input(context, params, "tex1", 1.0, node.kind)?;
    let odd = input(context, params, "tex2", 0.0, node.kind)?;
    match params.integer_within("dimension", 2, 2..=3)? {
        2 => Ok(Texture::Checkerboard {
            even,
            odd,
            mapping: mapping(node)?,
        }),
        _ => Ok(Texture::Checkerboard3d {
            even,
            odd,
            to_texture: node.to_texture()?,
        }),
    }
}

fn direction_mix(context: &mut Context, node: &TextureNode<'_>) -> Result<Texture, SceneError> {
    let params = node.params();
    let given = params
        .array("dir", &["vector3"])?
        .map_or(DVec3::Y, DVec3::from);
    let axis = node.to_world.transform_vector3(given).try_normalize();
    let axis = axis.ok_or_else(|| {
        let message = "\"dir\": expected a direction that is not zero";
        SceneError::new(ErrorKind::Parameter, &params.place_of("dir"), message)
    })?;
    Ok(Texture::DirectionMix {
        a: input(context, params, "tex1", 0.0, node.kind)?,
        b: input(context, params, "tex2", 1.0, node.kind)?,
        axis: axis.to_array().map(f32_of),
    })
}

fn noise(node: &TextureNode<'_>, kind: NoiseKind) -> Result<Texture, SceneError> {
    let params = node.params();
    Ok(Texture::Noise {
        kind,
        octaves: params.integer_within("octaves", 8, 0..=64)?,
        roughness: f32_of(params.float("roughness", 0.5)?),
        to_texture: node.to_texture()?,
    })
}
