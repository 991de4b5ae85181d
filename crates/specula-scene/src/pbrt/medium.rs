//! `MakeNamedMedium`: absorption by media. Scattering is not simulated.

use specula_bsdf::Rgb;

use super::colour;
use super::context::{Context, Entity};
use super::param::ParamList;
use crate::error::{ErrorKind, Place, SceneError};
use crate::media::{self, Coefficients, Homogeneous};
use crate::num::{f32_of, shorten};
use crate::scene::{ColourParam, MaterialKind};

/// pbrt's integrators that render media.
const SEE_MEDIA: [&str; 4] = ["volpath", "bdpt", "mlt", "simplevolpath"];

/// Media that vary in space.
const VARYING: [&str; 4] = ["uniformgrid", "rgbgrid", "cloud", "nanovdb"];

/// Parameters of such media.
const OF_GRIDS: [&str; 20] = [
    "density",
    "filename",
    "frequency",
    "g",
    "Le",
    "Lescale",
    "nx",
    "ny",
    "nz",
    "p0",
    "p1",
    "preset",
    "scale",
    "sigma_a",
    "sigma_s",
    "temperature",
    "temperaturecutoff",
    "temperatureoffset",
    "temperaturescale",
    "wispiness",
];

/// A medium of the file.
pub(super) struct MediumEntity {
    pub(super) entity: Entity,
    /// The first boundary that names it.
    pub(super) used: Option<Place>,
}

/// The media inside and outside of a shape, by number in the file.
pub(super) type Sides = [Option<usize>; 2];

/// Absorption per scene unit of all media; black where they are empty space.
///
/// * `camera`: the medium that the camera is in, which is empty space everywhere.
/// * `integrator`: pbrt-v4's default where the file names none.
pub(super) fn read_all(
    context: &mut Context,
    media: &[MediumEntity],
    camera: Option<usize>,
    integrator: Option<&Entity>,
) -> Result<Vec<Rgb<f32>>, SceneError> {
    let integrator = integrator.map_or("volpath", |i| i.name.as_str());
    let mut all = Vec::with_capacity(media.len());
    for (i, MediumEntity { entity, used }) in media.iter().enumerate() {
        let read = read(context, entity);
        let medium = entity.or(read, || None)?;
        context.warn_unused(&entity.params);
        let Some(place) = used else {
            all.push(Rgb::BLACK);
            continue;
        };
        let title = format!("medium \"{}\"", shorten(&entity.name));
        let sees_media = SEE_MEDIA.contains(&integrator);
        let (absorption, warning) = match medium {
            _ if !sees_media => (
                Rgb::BLACK,
                Some(format!(
                    "{title} is empty space, as with pbrt-v4's integrator \"{}\"",
                    shorten(integrator)
                )),
            ),
            None => (
                Rgb::BLACK,
                Some(format!("{title} varies in space: it is empty space here")),
            ),
            Some(_) if camera == Some(i) => (
                Rgb::BLACK,
                Some(format!(
                    "the camera is in {title}, which is empty space here"
                )),
            ),
            Some(medium) => (medium.absorption, medium.left_out(&title)),
        };
        if let Some(warning) = warning {
            context.warn(place, warning);
        }
        all.push(absorption);
    }
    Ok(all)
}

/// Whether light may pass through a material.
pub(super) fn lets_pass(kind: &MaterialKind) -> bool {
    matches!(
        kind,
        MaterialKind::Dielectric { .. }
            | MaterialKind::ThinDielectric { .. }
            | MaterialKind::DiffuseTransmission { .. }
            | MaterialKind::Mix { .. }
            | MaterialKind::Interface
    )
}

/// A medium; `None` for one that varies in space.
fn read(context: &mut Context, entity: &Entity) -> Result<Option<Homogeneous>, SceneError> {
    let params = &entity.params;
    let fault = |message: String| SceneError::new(ErrorKind::Parameter, &entity.place, message);
    let Some((kind, place)) = params.string("type")? else {
        return Err(fault("a medium needs its \"string type\"".to_owned()));
    };
    if VARYING.contains(&kind) {
        params.ignore(&OF_GRIDS);
        return Ok(None);
    }
    if kind != "homogeneous" {
        let message = format!("unknown medium type \"{}\"", shorten(kind));
        let names = VARYING.join(", ");
        return Err(SceneError::new(ErrorKind::Parameter, place, message)
            .with_help(format!("expected homogeneous or one of {names}")));
    }
    let (absorption, scattering) = match preset(context, params)? {
        Some(preset) => preset,
        None => (
            coefficient(context, params, "sigma_a")?,
            coefficient(context, params, "sigma_s")?,
        ),
    };
    if let Some(light) = colour::emission(context, params, "Le")?
        && !light.is_black()
    {
        let place = params.place_of("Le");
        context.warn(&place, "a medium's own light is not rendered");
    }
    params.ignore(&["Lescale"]);
    let scale = params.float_from_zero("scale", 1.0)?;
    let reduction = scale * (1.0 - params.float("g", 0.0)?.clamp(-1.0, 1.0));
    Ok(Some(Homogeneous {
        absorption: absorption * f32_of(scale),
        reduced_scattering: scattering * f32_of(reduction),
    }))
}

/// Absorption and scattering of a medium that pbrt knows by name.
fn preset(context: &mut Context, params: &ParamList) -> Result<Option<Coefficients>, SceneError> {
    let Some((name, place)) = params.string("preset")? else {
        return Ok(None);
    };
    let Some(coefficients) = media::named(name) else {
        let message = format!("no preset \"{}\" is known: it is left out", shorten(name));
        context.warn(place, message);
        return Ok(None);
    };
    params.ignore(&["sigma_a", "sigma_s"]);
    Ok(Some(coefficients))
}

/// A coefficient before `scale`; 1 where absent, as in pbrt-v4.
fn coefficient(context: &Context, params: &ParamList, name: &str) -> Result<Rgb<f32>, SceneError> {
    let Some(colour) = colour::colour(context, params, name)? else {
        return Ok(Rgb::WHITE);
    };
    match colour.under_white() {
        ColourParam::Value(c) => Ok(c),
        ColourParam::Texture(_) => {
            let message = format!("\"{name}\": expected a colour, found a texture");
            let place = params.place_of(name);
            Err(SceneError::new(ErrorKind::Parameter, &place, message))
        }
    }
}
