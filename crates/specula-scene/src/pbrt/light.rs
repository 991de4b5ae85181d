//! `LightSource` and `AreaLightSource`.

use std::f64::consts::PI;

use glam::{DMat4, DVec3};
use specula_bsdf::Rgb;

use super::colour;
use super::context::{Context, Entity};
use super::texture::mean;
use super::token::shorten;
use crate::error::{ErrorKind, SceneError};
use crate::image::{Content, Encoding, Image};
use crate::num::f32_of;
use crate::scene::{Emission, EnvironmentMapping, Light};

/// Reads a light that is not a shape.
pub(super) fn read(
    context: &mut Context,
    entity: &Entity,
    to_world: DMat4,
) -> Result<Light, SceneError> {
    match entity.name.as_str() {
        "infinite" => infinite(context, entity, to_world),
        "distant" => distant(context, entity, to_world),
        "point" => point(context, entity, to_world),
        "spot" => spot(context, entity, to_world),
        kind @ ("goniometric" | "projection") => {
            entity.params.ignore(&["filename", "fov"]);
            let message =
                format!("light \"{kind}\" is not supported: it shines evenly as \"point\"");
            context.warn(&entity.place, message);
            point(context, entity, to_world)
        }
        other => {
            let message = format!("unknown light \"{}\"", shorten(other));
            Err(
                SceneError::new(ErrorKind::Parameter, &entity.place, message)
                    .with_help("expected infinite, distant, point or spot"),
            )
        }
    }
}

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

/// A photometric wish of the file: pbrt-v4 heeds it where it is positive.
fn wish(entity: &Entity, name: &str) -> Result<Option<f64>, SceneError> {
    Ok(Some(entity.params.float(name, -1.0)?).filter(|x| *x > 0.0))
}

fn infinite(context: &mut Context, entity: &Entity, to_world: DMat4) -> Result<Light, SceneError> {
    let params = &entity.params;
    if params.numbers("portal", &["point3"])?.is_some() {
        context.warn(
            &params.place_of("portal"),
            "portals are not used: the light is sampled whole",
        );
    }
    let illuminance = wish(entity, "illuminance")?;
    let Some((name, place)) = params.string("filename")? else {
        // A uniform sky of radiance L gives the ground the irradiance pi L.
        let radiance = scaled(context, entity, "L", illuminance.map_or(1.0, |e| e / PI))?;
        return Ok(Light::Infinite {
            radiance,
            image: None,
            to_world,
        });
    };
    if params.find("L").is_some() {
        let message = "\"L\" and \"filename\" exclude each other";
        return Err(SceneError::new(
            ErrorKind::Parameter,
            &params.place_of("L"),
            message,
        ));
    }
    let id = context.image(name, place, Encoding::Srgb, Content::Colour)?;
    let image = &context.images[id.0];
    let mapping = if image.width == image.height {
        EnvironmentMapping::EqualAreaOctahedral
    } else {
        EnvironmentMapping::LatitudeLongitude
    };
    let factor = illuminance.map_or(1.0, |e| e / upper_illuminance(image, mapping).max(1e-30));
    let message = format!(
        "the picture is {} x {}; pbrt-v4 expects a square: it is read as latitude and longitude, z up",
        image.width, image.height
    );
    if mapping == EnvironmentMapping::LatitudeLongitude {
        context.warn(place, message);
    }
    let radiance = scaled(context, entity, "L", factor)?;
    Ok(Light::Infinite {
        radiance,
        image: Some((id, mapping)),
        to_world,
    })
}

/// Illuminance on a surface that faces +z.
fn upper_illuminance(image: &Image, mapping: EnvironmentMapping) -> f64 {
    let (width, height) = (f64::from(image.width), f64::from(image.height));
    let mut sum = 0.0;
    for (y, row) in image.pixels.chunks(image.width as usize).enumerate() {
        let v = (y as f64 + 0.5) / height;
        for (x, &[r, g, b]) in row.iter().enumerate() {
            let u = (x as f64 + 0.5) / width;
            let (z, solid_angle) = match mapping {
                EnvironmentMapping::EqualAreaOctahedral => {
                    // Clarberg 2008: z = 1 - r^2 in the inner diamond, r = |u| + |v| in [-1, 1]^2.
                    let r = (2.0 * u - 1.0).abs() + (2.0 * v - 1.0).abs();
                    let z = if r < 1.0 { 1.0 - r * r } else { 0.0 };
                    (z, 4.0 * PI / (width * height))
                }
                EnvironmentMapping::LatitudeLongitude => {
                    let (sin, cos) = (PI * v).sin_cos();
                    (cos.max(0.0), 2.0 * PI * PI * sin / (width * height))
                }
            };
            sum += f64::from(Rgb { r, g, b }.luminance()) * z * solid_angle;
        }
    }
    sum
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
    })
}

/// Reads the emission of a shape whose area in the world is `area`.
pub(super) fn area(
    context: &mut Context,
    entity: &Entity,
    area: f64,
) -> Result<Emission, SceneError> {
    let params = &entity.params;
    if entity.name != "diffuse" {
        let message = format!(
            "unknown area light \"{}\"; expected \"diffuse\"",
            shorten(&entity.name)
        );
        return Err(SceneError::new(
            ErrorKind::Parameter,
            &entity.place,
            message,
        ));
    }
    let two_sided = params.bool("twosided", false)?;
    let mut picture = Rgb::WHITE;
    if let Some((name, place)) = params.string("filename")? {
        if params.find("L").is_some() {
            let message = "\"L\" and \"filename\" exclude each other";
            return Err(SceneError::new(ErrorKind::Parameter, place, message));
        }
        let id = context.image(name, place, Encoding::Srgb, Content::Colour)?;
        picture = mean(&context.images[id.0]);
        context.warn(
            place,
            "a picture on an area light is not supported: its mean colour is used",
        );
    }
    let sides = if two_sided { 2.0 } else { 1.0 };
    // pbrt-v4 gives every triangle of a mesh the whole power; here the shape has it.
    let exitance = f64::from(picture.luminance()) * sides * area * PI;
    let factor = wish(entity, "power")?.map_or(1.0, |p| p / exitance.max(1e-30));
    let radiance = scaled(context, entity, "L", factor)?;
    context.warn_unused(params);
    Ok(Emission {
        radiance: radiance.zip(picture, |a, b| a * b),
        two_sided,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_white_sky_gives_pi() {
        let sky = |width, height| Image {
            name: String::new(),
            width,
            height,
            pixels: vec![[1.0; 3]; (width * height) as usize],
        };
        let square = upper_illuminance(&sky(256, 256), EnvironmentMapping::EqualAreaOctahedral);
        let oblong = upper_illuminance(&sky(512, 256), EnvironmentMapping::LatitudeLongitude);
        assert!((square - PI).abs() < 1e-3, "{square}");
        assert!((oblong - PI).abs() < 1e-3, "{oblong}");
    }
}
