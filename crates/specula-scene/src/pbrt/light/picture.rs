//! Lights that throw pictures. The model has none: point and spot lights of the same power stand in.

use std::f64::consts::PI;

use glam::{DMat4, DVec3};
use specula_bsdf::Rgb;

use super::{picture_id, point, scaled, wish};
use crate::error::{ErrorKind, SceneError};
use crate::image::Image;
use crate::num::f32_of;
use crate::pbrt::context::{Context, Entity};
use crate::scene::{Light, SpotFalloff};

/// Reads the light `goniometric` as a point light with the mean of its picture.
pub(super) fn goniometric(
    context: &mut Context,
    entity: &Entity,
    to_world: DMat4,
) -> Result<Light, SceneError> {
    let message =
        "light \"goniometric\" is not supported: a point light of its mean intensity is used";
    context.warn(&entity.place, message);
    let mean = match picture_id(context, entity)? {
        // Equal-area pictures: every pixel counts the same. pbrt-v4 takes the mean of channels.
        Some(id) => mean(&context.images[id.0], |_, _| 1.0).mean(),
        None => 1.0,
    };
    let light = point(context, entity, to_world)?;
    match light {
        // A wish for a power holds whatever the picture.
        Light::Point {
            position,
            intensity,
        } if wish(entity, "power")?.is_none() => Ok(Light::Point {
            position,
            intensity: intensity.map(|x| x * mean),
        }),
        _ => Ok(light),
    }
}

/// Reads the light `projection` as a spot light with the mean colour and the solid angle of its
/// picture.
pub(super) fn projection(
    context: &mut Context,
    entity: &Entity,
    to_world: DMat4,
) -> Result<Light, SceneError> {
    let message =
        "light \"projection\" is not supported: a spot light of its mean colour and angle is used";
    context.warn(&entity.place, message);
    let wrong =
        |message: &str| SceneError::new(ErrorKind::Parameter, &entity.place, message.to_owned());
    let id = picture_id(context, entity)?
        .ok_or_else(|| wrong("light \"projection\" needs its \"string filename\""))?;
    let fov_deg = entity.params.float("fov", 90.0)?;
    if !(fov_deg > 0.0 && fov_deg < 180.0) {
        return Err(wrong(
            "\"fov\": expected an angle between 0 and 180 degrees",
        ));
    }
    let image = &context.images[id.0];
    let aspect = f64::from(image.width) / f64::from(image.height);
    // The field of view spans the shorter side.
    let short = (fov_deg.to_radians() / 2.0).tan();
    let (tan_x, tan_y) = (short * aspect.max(1.0), short * (1.0 / aspect).max(1.0));
    // Solid angle of a rectangle seen from above its middle, and dw / dA = cos^3.
    let corner = tan_x * tan_y / ((1.0 + tan_x * tan_x) * (1.0 + tan_y * tan_y)).sqrt();
    let solid_angle = 4.0 * corner.asin();
    let colour = mean(image, |u, v| {
        let (x, y) = ((2.0 * u - 1.0) * tan_x, (2.0 * v - 1.0) * tan_y);
        (1.0 + x * x + y * y).powf(-1.5)
    });
    let power = f64::from(colour.luminance()) * solid_angle;
    let factor = wish(entity, "power")?.map_or(1.0, |p| p / power.max(1e-30));
    let axis = to_world.transform_vector3(DVec3::Z).normalize_or(DVec3::Z);
    let cone_angle_deg = (1.0 - solid_angle / (2.0 * PI)).acos().to_degrees();
    Ok(Light::Spot {
        position: to_world.transform_point3(DVec3::ZERO).to_array(),
        axis: axis.to_array(),
        intensity: scaled(context, entity, "I", factor)?.zip(colour, |a, b| a * b),
        cone_angle_deg,
        // A picture has a hard edge.
        falloff_start_deg: 0.98 * cone_angle_deg,
        falloff: SpotFalloff::SmoothCosine,
    })
}

/// Mean colour of a picture under a weight of its coordinates in `[0, 1]^2`.
pub(super) fn mean(image: &Image, weight: impl Fn(f64, f64) -> f64) -> Rgb<f32> {
    let (width, height) = (f64::from(image.width), f64::from(image.height));
    let (mut sum, mut weights) = (DVec3::ZERO, 0.0);
    for (y, row) in image.pixels.chunks(image.width as usize).enumerate() {
        for (x, pixel) in row.iter().enumerate() {
            let w = weight((x as f64 + 0.5) / width, (y as f64 + 0.5) / height);
            sum += w * DVec3::from(pixel.map(f64::from));
            weights += w;
        }
    }
    let [r, g, b] = (sum / f64::max(weights, 1e-300)).to_array().map(f32_of);
    Rgb { r, g, b }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_are_weighted() {
        let image = Image {
            name: String::new(),
            width: 2,
            height: 1,
            pixels: vec![[1.0, 0.0, 4.0], [3.0, 0.0, 0.0]],
        };
        assert_eq!(mean(&image, |_, _| 1.0).to_array(), [2.0, 0.0, 2.0]);
        let left = mean(&image, |u, _| if u < 0.5 { 1.0 } else { 0.0 });
        assert_eq!(left.to_array(), [1.0, 0.0, 4.0]);
    }
}
