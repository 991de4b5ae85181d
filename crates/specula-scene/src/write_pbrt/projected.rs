//! Lights that project images.

use glam::{DMat4, DVec4};
use specula_bsdf::Rgb;

use super::{WriteError, Writer, list, quoted, rgb_list};
use crate::image::Image;
use crate::scene::{Channel, ColourParam, ImageId, ImageProjection, Profile, Texture};

impl Writer<'_> {
    /// The place and the directive of a light that projects an image.
    pub(super) fn projected(
        &mut self,
        index: usize,
        to_world: &DMat4,
        intensity: ColourParam,
        image_projection: &ImageProjection,
    ) -> Result<(DMat4, String), WriteError> {
        let Some((id, channel, factor)) = self.picture_of(intensity) else {
            self.note(
                "lights that project what is no image are written as point lights of its mean",
            );
            let position = to_world.w_axis.truncate().to_array();
            let directive = format!(
                "\"point\" \"point3 from\" [ {} ] \"rgb I\" [ {} ]",
                list(&position),
                rgb_list(self.mean(intensity))
            );
            return Ok((DMat4::IDENTITY, directive));
        };
        let ImageProjection::Window { half, profile } = image_projection else {
            if channel == Channel::Rgb {
                self.note("goniometric lights lose the colours of their pictures");
            }
            let file = self.image(id, channel)?;
            let swap_y_and_z = DMat4::from_cols(DVec4::X, DVec4::Z, DVec4::Y, DVec4::W);
            let directive = format!(
                "\"goniometric\" \"string filename\" [ {} ] \"rgb I\" [ {} ]",
                quoted(&file),
                rgb_list(factor)
            );
            return Ok((*to_world * swap_y_and_z, directive));
        };
        if *profile != Profile::Intensity {
            self.note("projected pictures are written as intensities, without a cone");
        }
        let image = &self.scene.images[id.0];
        let aspect = f64::from(image.width) / f64::from(image.height);
        if (half[0] / half[1] / aspect - 1.0).abs() > 1e-3 {
            self.note("pictures are projected in their own proportions");
        }
        // pbrt has no factor on a picture's colour: it is multiplied into the pixels.
        let scaled = Image {
            name: String::new(),
            width: image.width,
            height: image.height,
            pixels: (image.pixels.iter())
                .map(|p| (Rgb::from(p) * factor).to_array())
                .collect(),
        };
        let file = self.picture(&format!("projection-{index}.exr"), &scaled, |c| c)?;
        let fov_deg = 2.0 * half[0].min(half[1]).atan().to_degrees();
        let directive = format!(
            "\"projection\" \"string filename\" [ {} ] \"float fov\" [ {fov_deg} ]",
            quoted(&file)
        );
        Ok((*to_world, directive))
    }

    /// The picture of a texture, of which channels, and the factor on it.
    fn picture_of(&self, p: ColourParam) -> Option<(ImageId, Channel, Rgb<f32>)> {
        let ColourParam::Texture(id) = p else {
            return None;
        };
        match &self.scene.textures[id.0] {
            Texture::Image {
                image,
                invert: false,
                scale,
                channel,
                ..
            } => Some((*image, *channel, Rgb::splat(*scale))),
            Texture::Scale { a, b } => {
                let (image, channel, factor) = self.picture_of(ColourParam::Texture(*a))?;
                match self.scene.textures[b.0] {
                    Texture::Constant(c) => Some((image, channel, factor * c)),
                    _ => None,
                }
            }
            _ => None,
        }
    }
}
