//! Lights at infinity.

use std::f64::consts::PI;

use glam::DMat4;
use specula_bsdf::Rgb;

use super::{picture_id, scaled, wish};
use crate::error::{ErrorKind, SceneError};
use crate::image::Image;
use crate::pbrt::context::{Context, Entity};
use crate::pbrt::param::ParamList;
use crate::scene::{EnvironmentMapping, Light};
use crate::validate::is_rectangle;

/// Reads the light `infinite`.
pub(super) fn infinite(
    context: &mut Context,
    entity: &Entity,
    to_world: DMat4,
) -> Result<Light, SceneError> {
    let params = &entity.params;
    let portal = portal(params)?;
    let made = |radiance, image| match portal {
        Some(corners) => Light::Portal {
            radiance,
            image,
            to_world,
            corners,
        },
        None => Light::Infinite {
            radiance,
            image,
            to_world,
        },
    };
    let illuminance = wish(entity, "illuminance")?;
    let Some(id) = picture_id(context, entity)? else {
        // A uniform sky of radiance L gives the ground the irradiance pi L.
        let radiance = scaled(context, entity, "L", illuminance.map_or(1.0, |e| e / PI))?;
        return Ok(made(radiance, None));
    };
    if params.find("L").is_some() {
        let message = "\"L\" and \"filename\" exclude each other";
        return Err(SceneError::new(
            ErrorKind::Parameter,
            &params.place_of("L"),
            message,
        ));
    }
    let image = &context.images[id.0];
    let is_v3 = context.v3.is_some();
    let mapping = if image.width == image.height && !is_v3 {
        EnvironmentMapping::EqualAreaOctahedral
    } else {
        EnvironmentMapping::LatitudeLongitude
    };
    let factor = match illuminance {
        None => 1.0,
        Some(wanted) => wanted / estimated_illuminance(image, mapping).max(1e-30),
    };
    let message = format!(
        "the picture is {} x {}; pbrt-v4 expects a square: it is read as latitude and longitude, z up",
        image.width, image.height
    );
    if mapping == EnvironmentMapping::LatitudeLongitude && !is_v3 {
        context.warn(&params.place_of("filename"), message);
    }
    let radiance = scaled(context, entity, "L", factor)?;
    Ok(made(radiance, Some((id, mapping))))
}

/// The corners of a portal, in the world: pbrt-v4 does not transform them.
fn portal(params: &ParamList) -> Result<Option<[[f64; 3]; 4]>, SceneError> {
    let Some(numbers) = params.numbers("portal", &["point3"])? else {
        return Ok(None);
    };
    if numbers.is_empty() {
        return Ok(None);
    }
    let wrong = |message: &str| {
        let message = format!("\"portal\": expected {message}");
        SceneError::new(ErrorKind::Parameter, &params.place_of("portal"), message)
    };
    let (points, rest) = numbers.as_chunks::<3>();
    match points {
        &[a, b, c, d] if rest.is_empty() => {
            let corners = [a, b, c, d];
            match is_rectangle(&corners) {
                true => Ok(Some(corners)),
                false => Err(wrong("the corners of a rectangle, one after the other")),
            }
        }
        _ => Err(wrong("four points")),
    }
}

/// What pbrt-v4 takes for the illuminance of a picture on a surface that faces +z: it gives each
/// pixel of a square 2 pi / n steradians instead of 4 pi / n, so that pictures with
/// `"illuminance"` come out twice as bright as they say. Scenes are made for that.
fn estimated_illuminance(image: &Image, mapping: EnvironmentMapping) -> f64 {
    let true_one = upper_illuminance(image, mapping);
    match mapping {
        EnvironmentMapping::EqualAreaOctahedral => true_one / 2.0,
        EnvironmentMapping::LatitudeLongitude | EnvironmentMapping::LatitudeLongitudePoles => {
            true_one
        }
    }
}

/// Illuminance on a surface that faces +z.
fn upper_illuminance(image: &Image, mapping: EnvironmentMapping) -> f64 {
    let (width, height) = (f64::from(image.width), f64::from(image.height));
    let mut sum = 0.0;
    for (y, row) in image.pixels.rows(image.width).enumerate() {
        let v = (y as f64 + 0.5) / height;
        for (x, [r, g, b]) in row.enumerate() {
            let u = (x as f64 + 0.5) / width;
            let (z, solid_angle) = match mapping {
                EnvironmentMapping::EqualAreaOctahedral => {
                    // Clarberg 2008: z = 1 - r^2 in the inner diamond, r = |u| + |v| in [-1, 1]^2.
                    let r = (2.0 * u - 1.0).abs() + (2.0 * v - 1.0).abs();
                    let z = if r < 1.0 { 1.0 - r * r } else { 0.0 };
                    (z, 4.0 * PI / (width * height))
                }
                EnvironmentMapping::LatitudeLongitude
                | EnvironmentMapping::LatitudeLongitudePoles => {
                    let (sin, cos) = (PI * v).sin_cos();
                    (cos.max(0.0), 2.0 * PI * PI * sin / (width * height))
                }
            };
            sum += f64::from(Rgb { r, g, b }.luminance()) * z * solid_angle;
        }
    }
    sum
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
            pixels: vec![[1.0; 3]; (width * height) as usize].into(),
        };
        let square = upper_illuminance(&sky(256, 256), EnvironmentMapping::EqualAreaOctahedral);
        let oblong = upper_illuminance(&sky(512, 256), EnvironmentMapping::LatitudeLongitude);
        assert!((square - PI).abs() < 1e-3, "{square}");
        assert!((oblong - PI).abs() < 1e-3, "{oblong}");
    }
}
