//! Lights that project images.

use std::f64::consts::PI;

use glam::{DMat4, DVec3, DVec4};
use specula_bsdf::Rgb;

use super::{picture_id, point, scaled, wish};
use crate::error::{ErrorKind, SceneError};
use crate::image::Image;
use crate::num::f32_of;
use crate::pbrt::context::{Context, Entity};
use crate::scene::{
    Channel, ColourParam, ImageId, ImageProjection, Interpolation, Light, Profile, Texture,
    TextureMapping, Wrap,
};

/// Reads the light `goniometric`: a square of intensities by direction, whose middle is +y.
pub(super) fn goniometric(
    context: &mut Context,
    entity: &Entity,
    to_world: DMat4,
) -> Result<Light, SceneError> {
    let Some(id) = picture_id(context, entity)? else {
        let message = "light \"goniometric\" has no \"string filename\": it emits evenly";
        context.warn(&entity.place, message);
        return point(context, entity, to_world);
    };
    let image = &context.images[id.0];
    if image.width != image.height {
        let message = format!(
            "light \"goniometric\" expects a square picture by equal areas, found {} x {}",
            image.width, image.height
        );
        return Err(SceneError::new(ErrorKind::Image, &entity.place, message));
    }
    // Every pixel counts the same, and pbrt-v4 takes the mean of the channels.
    let power = 4.0 * PI * f64::from(mean(image, |_, _| 1.0).mean());
    let factor = wish(entity, "power")?.map_or(1.0, |p| p / power.max(1e-30));
    let colour = scaled(context, entity, "I", factor)?;
    let swap_y_and_z = DMat4::from_cols(DVec4::X, DVec4::Z, DVec4::Y, DVec4::W);
    Ok(Light::Picture {
        to_world: to_world * swap_y_and_z,
        intensity: projected(context, id, Channel::Mean, colour),
        image_projection: ImageProjection::Sphere,
    })
}

/// Reads the light `projection`.
pub(super) fn projection(
    context: &mut Context,
    entity: &Entity,
    to_world: DMat4,
) -> Result<Light, SceneError> {
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
    let half = [short * aspect.max(1.0), short * (1.0 / aspect).max(1.0)];
    let factor = match wish(entity, "power")? {
        None => 1.0,
        Some(wanted) => wanted / power(image, half).max(1e-30),
    };
    let colour = scaled(context, entity, "I", factor)?;
    Ok(Light::Picture {
        to_world,
        intensity: projected(context, id, Channel::Rgb, colour),
        image_projection: ImageProjection::Window {
            half,
            profile: Profile::Intensity,
        },
    })
}

/// Power of a picture through a window: the integral of its luminance over directions, with
/// `dw = cos^3 dA`, by the middles of its pixels (pbrt-v4's rule).
fn power(image: &Image, [tan_x, tan_y]: [f64; 2]) -> f64 {
    let cos3 = |u: f64, v: f64| {
        let (x, y) = ((2.0 * u - 1.0) * tan_x, (2.0 * v - 1.0) * tan_y);
        (1.0 + x * x + y * y).powf(-1.5)
    };
    let (width, height) = (f64::from(image.width), f64::from(image.height));
    let sum: f64 = (image.pixels.rows(image.width).enumerate())
        .flat_map(|(y, row)| row.enumerate().map(move |(x, p)| (x, y, p)))
        .map(|(x, y, p)| {
            let weight = cos3((x as f64 + 0.5) / width, (y as f64 + 0.5) / height);
            weight * f64::from(Rgb::from(p).luminance())
        })
        .sum();
    4.0 * tan_x * tan_y * sum / (width * height)
}

/// The texture of a picture that is projected: pbrt-v4 takes the nearest pixel.
fn projected(
    context: &mut Context,
    image: ImageId,
    channel: Channel,
    factor: Rgb<f32>,
) -> ColourParam {
    let picture = context.add_texture(Texture::Image {
        image,
        mapping: TextureMapping::default(),
        wrap: [Wrap::Clamp; 2],
        filter: Interpolation::Nearest,
        invert: false,
        scale: 1.0,
        channel,
    });
    if factor == Rgb::WHITE {
        return ColourParam::Texture(picture);
    }
    let b = context.add_texture(Texture::Constant(factor));
    ColourParam::Texture(context.add_texture(Texture::Scale { a: picture, b }))
}

/// Mean colour of a picture under a weight of its coordinates in `[0, 1]^2`.
pub(super) fn mean(image: &Image, weight: impl Fn(f64, f64) -> f64) -> Rgb<f32> {
    let (width, height) = (f64::from(image.width), f64::from(image.height));
    let (mut sum, mut weights) = (DVec3::ZERO, 0.0);
    for (y, row) in image.pixels.rows(image.width).enumerate() {
        for (x, pixel) in row.enumerate() {
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

    fn image(pixels: Vec<[f32; 3]>, width: u32) -> Image {
        Image {
            name: String::new(),
            width,
            height: u32::try_from(pixels.len()).unwrap() / width,
            pixels: pixels.into(),
        }
    }

    #[test]
    fn means_are_weighted() {
        let image = image(vec![[1.0, 0.0, 4.0], [3.0, 0.0, 0.0]], 2);
        assert_eq!(mean(&image, |_, _| 1.0).to_array(), [2.0, 0.0, 2.0]);
        let left = mean(&image, |u, _| if u < 0.5 { 1.0 } else { 0.0 });
        assert_eq!(left.to_array(), [1.0, 0.0, 4.0]);
    }

    #[test]
    fn a_white_window_has_its_solid_angle() {
        // A pyramid of 60 degrees both ways: 4 asin(sin^2 30) steradians.
        let half = [30.0_f64.to_radians().tan(); 2];
        let found = power(&image(vec![[1.0; 3]; 128 * 128], 128), half);
        assert!((found - 4.0 * 0.25_f64.asin()).abs() < 1e-4, "{found}");
    }
}
