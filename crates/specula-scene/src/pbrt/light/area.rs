//! `AreaLightSource`: light that shapes send out.

use std::f64::consts::PI;

use specula_bsdf::Rgb;

use super::picture::mean;
use super::{picture_id, scaled, wish};
use crate::error::{ErrorKind, SceneError};
use crate::num::shorten;
use crate::pbrt::context::{Context, Entity};
use crate::scene::{Channel, ColourParam, Emission, Interpolation, Texture, TextureMapping, Wrap};

/// Reads the emission of a shape.
///
/// * `area`: of all its pieces, in the world.
/// * `pieces`: how many shapes pbrt-v4 makes of it. Each triangle of a mesh is one, and each gets
///   the whole `"power"`; here the mesh gets the sum, spread evenly over its area.
pub(in crate::pbrt) fn area(
    context: &mut Context,
    entity: &Entity,
    area: f64,
    pieces: usize,
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
    let picture = picture_id(context, entity)?;
    if picture.is_some() && params.find("L").is_some() {
        let message = "\"L\" and \"filename\" exclude each other";
        let place = params.place_of("L");
        return Err(SceneError::new(ErrorKind::Parameter, &place, message));
    }
    let luminance = picture.map_or(1.0, |id| {
        f64::from(mean(&context.images[id.0], |_, _| 1.0).luminance())
    });
    let sides = if two_sided { 2.0 } else { 1.0 };
    let exitance = luminance * sides * area * PI;
    let factor = wish(entity, "power")?.map_or(1.0, |p| p * pieces as f64 / exitance.max(1e-30));
    let radiance = scaled(context, entity, "L", factor)?;
    context.warn_unused(params);
    let radiance = match picture {
        None => ColourParam::Value(radiance),
        Some(image) => {
            // There is no "L": the factor is the same in all channels.
            let Rgb { r: scale, .. } = radiance;
            ColourParam::Texture(context.add_texture(Texture::Image {
                image,
                mapping: TextureMapping::default(),
                wrap: [Wrap::Clamp; 2],
                filter: Interpolation::Bilinear,
                invert: false,
                scale,
                channel: Channel::Rgb,
            }))
        }
    };
    Ok(Emission {
        radiance,
        two_sided,
    })
}
