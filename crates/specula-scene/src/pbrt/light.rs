//! `LightSource` and `AreaLightSource`.

mod area;
mod environment;
mod picture;

use std::f64::consts::PI;

use glam::{DMat4, DVec3};
use specula_bsdf::Rgb;

use super::colour;
use super::context::{Context, Entity};
use crate::error::{ErrorKind, SceneError};
use crate::image::{Content, Encoding};
use crate::num::{f32_of, shorten};
use crate::scene::{ImageId, Light, SpotFalloff};
use crate::transform::check_transform;

pub(super) use area::area;

/// Asks for the picture of a light, so that all pictures are decoded before any light is read.
pub(super) fn fetch_picture(context: &mut Context, entity: &Entity) -> Result<(), SceneError> {
    const WITH_PICTURES: [&str; 4] = ["infinite", "goniometric", "projection", "diffuse"];
    if WITH_PICTURES.contains(&entity.name.as_str()) {
        picture_id(context, entity)?;
    }
    Ok(())
}

fn picture_id(context: &mut Context, entity: &Entity) -> Result<Option<ImageId>, SceneError> {
    let Some((name, place)) = entity.params.string("filename")? else {
        return Ok(None);
    };
    Ok(Some(context.image(
        name,
        place,
        Encoding::Srgb,
        Content::Light,
    )))
}

/// Reads a light that is not a shape; its picture is decoded by now.
pub(super) fn read(
    context: &mut Context,
    entity: &Entity,
    to_world: DMat4,
) -> Result<Light, SceneError> {
    check_transform(&to_world)
        .map_err(|m| SceneError::new(ErrorKind::Transform, &entity.place, m))?;
    match entity.name.as_str() {
        "infinite" => environment::infinite(context, entity, to_world),
        "distant" => distant(context, entity, to_world),
        "point" => point(context, entity, to_world),
        "spot" => spot(context, entity, to_world),
        "goniometric" => picture::goniometric(context, entity, to_world),
        "projection" => picture::projection(context, entity, to_world),
        other => {
            let message = format!("unknown light \"{}\"", shorten(other));
            Err(
                SceneError::new(ErrorKind::Parameter, &entity.place, message).with_help(
                    "expected infinite, distant, point, spot, goniometric or projection",
                ),
            )
        }
    }
}

/// The colour `name` (white where absent) times `scale` and a factor.
fn scaled(
    context: &Context,
    entity: &Entity,
    name: &str,
    factor: f64,
) -> Result<Rgb<f32>, SceneError> {
    let colour = colour::emission(context, &entity.params, name)?.unwrap_or(Rgb::WHITE);
    let factor = factor * entity.params.float_from_zero("scale", 1.0)?;
    let limit = |x: f32| f32_of((f64::from(x) * factor).min(f64::from(f32::MAX)));
    Ok(colour.map(limit))
}

/// A photometric parameter; pbrt-v4 uses it where it is positive.
fn wish(entity: &Entity, name: &str) -> Result<Option<f64>, SceneError> {
    Ok(Some(entity.params.float(name, -1.0)?).filter(|x| *x > 0.0))
}

/// `from` and the unit vector from `from` to `to`, in the world.
fn from_to(entity: &Entity, to_world: &DMat4) -> Result<(DVec3, DVec3), SceneError> {
    let from = entity
        .params
        .array("from", &["point3"])?
        .map_or(DVec3::ZERO, DVec3::from);
    let to = entity
        .params
        .array("to", &["point3"])?
        .map_or(DVec3::Z, DVec3::from);
    let position = to_world.transform_point3(from);
    let along = to_world.transform_vector3(to - from).try_normalize();
    along.map(|a| (position, a)).ok_or_else(|| {
        let message = "\"from\" and \"to\" are the same point; expected two points";
        SceneError::new(ErrorKind::Parameter, &entity.place, message)
    })
}

fn distant(context: &Context, entity: &Entity, to_world: DMat4) -> Result<Light, SceneError> {
    let (_, along) = from_to(entity, &to_world)?;
    let factor = wish(entity, "illuminance")?.unwrap_or(1.0);
    let irradiance = scaled(context, entity, "L", factor)?;
    Ok(Light::Distant {
        irradiance,
        to_light: (-along).to_array(),
        half_angle_deg: 0.0,
    })
}

fn point(context: &Context, entity: &Entity, to_world: DMat4) -> Result<Light, SceneError> {
    let from = entity
        .params
        .array("from", &["point3"])?
        .map_or(DVec3::ZERO, DVec3::from);
    let factor = wish(entity, "power")?.map_or(1.0, |p| p / (4.0 * PI));
    let intensity = scaled(context, entity, "I", factor)?;
    Ok(Light::Point {
        position: to_world.transform_point3(from).to_array(),
        intensity,
    })
}

fn spot(context: &Context, entity: &Entity, to_world: DMat4) -> Result<Light, SceneError> {
    let (position, axis) = from_to(entity, &to_world)?;
    let cone_angle_deg = entity.params.float("coneangle", 30.0)?;
    let falloff_start_deg = cone_angle_deg - entity.params.float("conedeltaangle", 5.0)?;
    let cone = cone_angle_deg > 0.0 && cone_angle_deg <= 180.0;
    if !(cone && (0.0..=cone_angle_deg).contains(&falloff_start_deg)) {
        let message = format!(
            "expected \"coneangle\" within 0 and 180 degrees and \"conedeltaangle\" within it, \
             found {cone_angle_deg} and {}",
            cone_angle_deg - falloff_start_deg
        );
        return Err(SceneError::new(
            ErrorKind::Parameter,
            &entity.place,
            message,
        ));
    }
    let (end, start) = (
        cone_angle_deg.to_radians().cos(),
        falloff_start_deg.to_radians().cos(),
    );
    let solid_angle = 2.0 * PI * ((1.0 - start) + (start - end) / 2.0);
    let factor = wish(entity, "power")?.map_or(1.0, |p| p / solid_angle);
    Ok(Light::Spot {
        position: position.to_array(),
        axis: axis.to_array(),
        intensity: scaled(context, entity, "I", factor)?,
        cone_angle_deg,
        falloff_start_deg,
        falloff: SpotFalloff::SmoothCosine,
    })
}
