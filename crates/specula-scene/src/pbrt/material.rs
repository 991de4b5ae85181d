//! Materials: pbrt-v4's parameters and their defaults.

mod hair;
mod stand_in;

use std::collections::HashMap;

use specula_bsdf::Rgb;

use super::colour::{self, Colour, OutsideRange};
use super::context::{Context, Entity};
use super::param::ParamList;
use super::v3;
use crate::energy::{Energy, UnknownEnergy};
use crate::error::{ErrorKind, Place, SceneError};
use crate::image::{Content, Encoding};
use crate::num::shorten;
use crate::scene::{
    Bump, Channel, CoatMedium, ColourParam, ConductorFresnel, FloatParam, Interpolation, Material,
    MaterialId, MaterialKind, Roughness, RoughnessMapping, Texture, TextureMapping, Wrap,
};
use crate::spectrum;

/// pbrt-v4's material for shapes that have none.
pub(super) const DEFAULT: MaterialKind = MaterialKind::Diffuse {
    reflectance: ColourParam::Value(Rgb {
        r: 0.5,
        g: 0.5,
        b: 0.5,
    }),
    roughness: FloatParam::Value(0.0),
};

/// Reads a material; `named` holds the named materials before it.
pub(super) fn read(
    context: &mut Context,
    entity: &Entity,
    named: &HashMap<&str, MaterialId>,
) -> Result<Material, SceneError> {
    let params = &entity.params;
    params.ignore(&["type"]);
    let energy = energy(params)?;
    let bump = bump(context, entity)?;
    params.ignore(&[v3::OPACITY]);
    let kind = match entity.name.as_str() {
        "diffuse" => MaterialKind::Diffuse {
            reflectance: colour::albedo(context, params, "reflectance", 0.5)?,
            roughness: FloatParam::Value(0.0),
        },
        "diffusetransmission" => diffuse_transmission(context, params)?,
        "conductor" => MaterialKind::Conductor {
            fresnel: conductor(context, params, "eta", "k", &entity.place)?,
            roughness: roughness(context, params, "")?,
            tint: ColourParam::WHITE,
        },
        "dielectric" => MaterialKind::Dielectric {
            eta: colour::index(context, params, "eta")?,
            roughness: roughness(context, params, "")?,
            reflection_tint: ColourParam::WHITE,
            transmission_tint: ColourParam::WHITE,
        },
        "thindielectric" => MaterialKind::ThinDielectric {
            eta: colour::index(context, params, "eta")?,
            reflection_tint: ColourParam::WHITE,
            transmission_tint: ColourParam::WHITE,
        },
        "coateddiffuse" => {
            let medium = coat_medium(context, params)?;
            MaterialKind::CoatedDiffuse {
                reflectance: colour::albedo(context, params, "reflectance", 0.5)?,
                eta: colour::index(context, params, "eta")?,
                roughness: roughness(context, params, "")?,
                medium,
                lossless: false,
            }
        }
        "coatedconductor" => {
            let medium = coat_medium(context, params)?;
            let names = ["conductor.eta", "conductor.k"];
            MaterialKind::CoatedConductor {
                coat_eta: colour::index(context, params, "interface.eta")?,
                coat_roughness: roughness(context, params, "interface.")?,
                fresnel: conductor(context, params, names[0], names[1], &entity.place)?,
                roughness: roughness(context, params, "conductor.")?,
                medium,
            }
        }
        "mix" => mix(context, entity, named)?,
        "interface" => MaterialKind::Interface,
        "" | "none" => {
            let message = "this name is deprecated: it means \"interface\"";
            context.warn(&entity.place, message);
            MaterialKind::Interface
        }
        "hair" => MaterialKind::Hair(hair::read(context, entity)?),
        "measured" => measured(context, entity)?,
        "subsurface" => stand_in::subsurface(context, entity)?,
        other => {
            let message = format!("unknown material \"{}\"", shorten(other));
            let error = SceneError::new(ErrorKind::Parameter, &entity.place, message);
            return Err(error.with_help(
                "expected diffuse, diffusetransmission, conductor, dielectric, thindielectric, \
                 coateddiffuse, coatedconductor, hair, measured, mix, subsurface or interface",
            ));
        }
    };
    context.warn_unused(params);
    Ok(Material {
        energy,
        bump,
        ..Material::new(kind)
    })
}

/// The bump or normal map: a normal map overrides a displacement, as in pbrt-v4, which bends no hair.
fn bump(context: &mut Context, entity: &Entity) -> Result<Option<Bump>, SceneError> {
    let params = &entity.params;
    if entity.name == "hair" {
        return Ok(None);
    }
    let height = context.float_or_none(params, "displacement")?;
    if let Some((name, place)) = params.string("normalmap")? {
        let image = context.image(name, place, Encoding::Linear, Content::Colour);
        let map = context.add_texture(Texture::Image {
            image,
            mapping: TextureMapping::default(),
            wrap: [Wrap::Repeat; 2],
            filter: Interpolation::Bilinear,
            invert: false,
            scale: 1.0,
            channel: Channel::Rgb,
        });
        return Ok(Some(Bump::Normal { map, scale: 1.0 }));
    }
    // A constant height has no effect.
    Ok(height
        .filter(|h| matches!(h, FloatParam::Texture(_)))
        .map(Bump::Height))
}

/// The parameter `"string specula:energy"`, an extension: treatment of multiple scattering. Renderers that do
/// not know it leave it unused.
fn energy(params: &ParamList) -> Result<Option<Energy>, SceneError> {
    let Some((name, place)) = params.string("specula:energy")? else {
        return Ok(None);
    };
    name.parse().map(Some).map_err(|error: UnknownEnergy| {
        SceneError::new(ErrorKind::Parameter, place, error.to_string())
    })
}

fn diffuse_transmission(
    context: &mut Context,
    params: &ParamList,
) -> Result<MaterialKind, SceneError> {
    let reflectance = colour::albedo(context, params, "reflectance", 0.25)?;
    let transmittance = colour::albedo(context, params, "transmittance", 0.25)?;
    let scale = crate::num::f32_of(params.float_from_zero("scale", 1.0)?);
    let mut scaled = |colour: ColourParam| match colour {
        _ if scale == 1.0 => colour,
        ColourParam::Value(c) => ColourParam::Value(c.map(|x| (x * scale).min(1.0))),
        ColourParam::Texture(a) => {
            let b = context.constant(scale);
            ColourParam::Texture(context.add_texture(Texture::Scale { a, b }))
        }
    };
    Ok(MaterialKind::DiffuseTransmission {
        reflectance: scaled(reflectance),
        transmittance: scaled(transmittance),
    })
}

/// `roughness`, `uroughness` and `vroughness` after a prefix; 0 where absent.
fn roughness(
    context: &mut Context,
    params: &ParamList,
    prefix: &str,
) -> Result<Roughness, SceneError> {
    let mapping = match params.bool("remaproughness", true)? {
        true => RoughnessMapping::Sqrt,
        false => RoughnessMapping::Alpha,
    };
    let mut read = |name: &str| {
        let name = format!("{prefix}{name}");
        let value = context.float_from_zero_or_none(params, &name)?;
        if let Some(FloatParam::Value(x)) = value
            && let Some((message, most)) = mapping.too_wide(&name, x)
        {
            context.warn(&params.place_of(&name), message);
            return Ok(Some(FloatParam::Value(most)));
        }
        Ok(value)
    };
    let both = read("roughness")?.unwrap_or(FloatParam::Value(0.0));
    Ok(Roughness {
        u: read("uroughness")?.unwrap_or(both),
        v: read("vroughness")?.unwrap_or(both),
        mapping,
        ..Roughness::smooth()
    })
}

fn conductor(
    context: &mut Context,
    params: &ParamList,
    eta_name: &str,
    k_name: &str,
    place: &Place,
) -> Result<ConductorFresnel, SceneError> {
    let eta = colour::colour(context, params, eta_name)?;
    let k = colour::colour(context, params, k_name)?;
    if let Some(reflectance) = colour::albedo_or_none(context, params, "reflectance")? {
        if eta.is_some() || k.is_some() {
            let message =
                format!("\"reflectance\" and \"{eta_name}\" or \"{k_name}\" exclude each other");
            return Err(SceneError::new(ErrorKind::Parameter, place, message));
        }
        return Ok(ConductorFresnel::Reflectance(reflectance));
    }
    let or_copper = |colour: Option<Colour>, name: &str| {
        colour
            .or_else(|| spectrum::named(name).map(|s| Colour::Spectrum(s, OutsideRange::Held)))
            .ok_or_else(|| {
                let message = format!("the spectrum {name} is missing from the library");
                SceneError::new(ErrorKind::Spectrum, place, message)
            })
    };
    let eta = or_copper(eta, "metal-Cu-eta")?;
    let k = or_copper(k, "metal-Cu-k")?;
    let (eta, k) = colour::complex_index(&eta, &k);
    for (name, colour) in [(eta_name, eta), (k_name, k)] {
        if let ColourParam::Value(c) = colour
            && !(c.r.min(c.g).min(c.b) >= 0.0 && (c.r + c.g + c.b).is_finite())
        {
            let message = format!("\"{name}\": expected an index that is not negative");
            return Err(SceneError::new(ErrorKind::Parameter, place, message));
        }
    }
    Ok(ConductorFresnel::Index { eta, k })
}

/// A measured reflection; grey where its file is missing or damaged and reading goes on.
fn measured(context: &mut Context, entity: &Entity) -> Result<MaterialKind, SceneError> {
    let Some((name, place)) = entity.params.string("filename")? else {
        let message = "material \"measured\" needs its \"string filename\"";
        let error = SceneError::new(ErrorKind::Parameter, &entity.place, message);
        return entity.params.record(error).map(|()| DEFAULT);
    };
    let read = context.measured(name, place).map(MaterialKind::Measured);
    let problems = context.problems.clone();
    problems.or(read, || DEFAULT)
}

/// The medium between coat and base.
fn coat_medium(context: &mut Context, params: &ParamList) -> Result<CoatMedium, SceneError> {
    let thickness = context.float_from_zero_or_none(params, "thickness")?;
    Ok(CoatMedium {
        thickness: thickness.unwrap_or(FloatParam::Value(0.01)),
        max_depth: Some(params.integer_within("maxdepth", 10, 0..=i32::MAX.unsigned_abs())?),
        samples: params.integer_within("nsamples", 1, 1..=i32::MAX.unsigned_abs())?,
        albedo: colour::albedo(context, params, "albedo", 0.0)?,
        g: asymmetry(context, params)?,
    })
}

/// The mean cosine of scattering.
fn asymmetry(context: &Context, params: &ParamList) -> Result<FloatParam, SceneError> {
    let g = context.float(params, "g", 0.0)?;
    if let FloatParam::Value(x) = g
        && x.abs() > 1.0
    {
        let message = format!("\"g\": expected a number from -1 to 1, found {x}");
        let error = SceneError::new(ErrorKind::Parameter, &params.place_of("g"), message);
        return params.record(error).map(|()| FloatParam::Value(0.0));
    }
    Ok(g)
}

fn mix(
    context: &Context,
    entity: &Entity,
    named: &HashMap<&str, MaterialId>,
) -> Result<MaterialKind, SceneError> {
    let params = &entity.params;
    let [a, b] = params.texts("materials", "string")? else {
        let message = "material \"mix\" needs two names in \"string materials\"";
        return Err(SceneError::new(
            ErrorKind::Parameter,
            &entity.place,
            message,
        ));
    };
    let find = |(name, place): &(String, Place)| {
        named.get(name.as_str()).copied().ok_or_else(|| {
            let message = format!("no material \"{}\" is defined before this", shorten(name));
            SceneError::new(ErrorKind::UnknownName, place, message)
        })
    };
    Ok(MaterialKind::Mix {
        materials: [find(a)?, find(b)?],
        amount: context
            .float_from_zero_or_none(params, "amount")?
            .unwrap_or(FloatParam::Value(0.5)),
    })
}

/// The opacity of pbrt-v3's `uber`, where it is not 1.
pub(super) fn opacity(
    context: &mut Context,
    params: &ParamList,
) -> Result<Option<FloatParam>, SceneError> {
    let Some(opacity) = colour::albedo_or_none(context, params, v3::OPACITY)? else {
        return Ok(None);
    };
    let message = "\"opacity\" of pbrt-v3's \"uber\" becomes the opacity of its shapes: light passes straight";
    context.warn(&params.place_of(v3::OPACITY), message);
    Ok(Some(match opacity {
        ColourParam::Value(c) => FloatParam::Value(c.mean()),
        ColourParam::Texture(id) => FloatParam::Texture(id),
    }))
}
