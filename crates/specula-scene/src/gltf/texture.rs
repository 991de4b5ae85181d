//! Textures: pictures with samplers, transforms and channels.

use std::collections::HashMap;
use std::io::Cursor;

use gltf::texture::{MagFilter, WrappingMode};
use specula_bsdf::Rgb;

use super::Reader;
use super::texture_ref::TextureRef;
use crate::error::{ErrorKind, SceneError};
use crate::image::{self, Content, Encoding, Format, Image};
use crate::scene::{
    Channel, ColourParam, FloatParam, ImageId, Interpolation, Texture, TextureId, TextureMapping,
    UvMapping, Wrap,
};

/// Sets of coordinates of a mesh.
pub(super) const MOST_SETS: usize = 2;

/// Pictures that have been decoded: by number, whether as colours, and what of them.
pub(super) type Decoded = HashMap<(usize, bool, Content), ImageId>;

/// Which data of a picture are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Meaning {
    /// Colours with the sRGB curve.
    Colour,
    /// Numbers without a curve, in this channel.
    Data(Channel),
    /// The alpha channel.
    Alpha,
}

impl Reader<'_> {
    /// The texture node of a reference.
    pub(super) fn texture(
        &mut self,
        reference: TextureRef,
        meaning: Meaning,
    ) -> Result<TextureId, SceneError> {
        let what = format!("textures[{}]", reference.index);
        let Some(texture) = self.document.textures().nth(reference.index) else {
            let message = format!("a material refers to {what}, which does not exist");
            return Err(self.error(ErrorKind::UnknownName, message));
        };
        let (encoding, content, channel) = match meaning {
            Meaning::Colour => (Encoding::Srgb, Content::Colour, Channel::Rgb),
            Meaning::Data(channel) => (Encoding::Linear, Content::Colour, channel),
            Meaning::Alpha => (Encoding::Linear, Content::Alpha, Channel::Red),
        };
        let image = self.picture(&texture.source(), encoding, content)?;
        let coordinates = mapping(&reference);
        let mapping = match self.place_of_set(&what, reference.set) {
            0 => TextureMapping::Uv(coordinates),
            _ => TextureMapping::SecondUv(coordinates),
        };
        let sampler = texture.sampler();
        Ok(self.add_texture(Texture::Image {
            image,
            mapping,
            wrap: [wrap(sampler.wrap_s()), wrap(sampler.wrap_t())],
            filter: filter(sampler.mag_filter()),
            invert: false,
            scale: 1.0,
            channel,
        }))
    }

    /// Which of a mesh's two sets of coordinates is the file's set: those that the material used
    /// first.
    ///
    /// * `what`: the texture, for the warning of a third.
    fn place_of_set(&mut self, what: &str, set: u32) -> usize {
        if let Some(place) = self.sets.iter().position(|s| *s == set) {
            return place;
        }
        if self.sets.len() == MOST_SETS {
            let first = self.sets[0];
            self.warn(format!(
                "{what} lies by TEXCOORD_{set}, the third set of coordinates of a material: \
                 TEXCOORD_{first} stands in for it"
            ));
            return 0;
        }
        self.sets.push(set);
        self.sets.len() - 1
    }

    fn picture(
        &mut self,
        picture: &gltf::Image<'_>,
        encoding: Encoding,
        content: Content,
    ) -> Result<ImageId, SceneError> {
        let key = (picture.index(), encoding == Encoding::Srgb, content);
        if let Some(id) = self.decoded.get(&key) {
            return Ok(*id);
        }
        let read = self.read_picture(picture, encoding, content);
        let image = self.problems.or(read, Image::stand_in)?;
        self.images.push(image);
        let id = ImageId(self.images.len() - 1);
        self.decoded.insert(key, id);
        Ok(id)
    }

    fn read_picture(
        &self,
        picture: &gltf::Image<'_>,
        encoding: Encoding,
        content: Content,
    ) -> Result<Image, SceneError> {
        let what = format!("images[{}]", picture.index());
        let bytes;
        let (data, mime, name) = match picture.source() {
            gltf::image::Source::View { view, mime_type } => {
                (self.view(&what, &view)?, Some(mime_type), what.clone())
            }
            gltf::image::Source::Uri { uri, mime_type } => {
                bytes = (self.resource(&what, uri))
                    .map_err(|error| error.of_missing(ErrorKind::Image))?;
                let name = if uri.starts_with("data:") {
                    what.clone()
                } else {
                    uri.to_owned()
                };
                (bytes.as_slice(), mime_type, name)
            }
        };
        let format = Format::of_content(data).ok_or_else(|| {
            let found = mime.map_or_else(String::new, |m| format!(", found {m}"));
            let message = format!("{what}: expected a PNG, JPEG or WebP picture{found}");
            self.error(ErrorKind::Image, message)
        })?;
        image::decode(
            Cursor::new(data),
            format,
            &name,
            encoding,
            content,
            self.limits,
        )
        .map_err(|message| SceneError::new(ErrorKind::Image, &self.place_of(&what), message))
    }

    /// A factor and a texture as a colour.
    pub(super) fn colour(
        &mut self,
        factor: Rgb<f32>,
        reference: Option<TextureRef>,
    ) -> Result<ColourParam, SceneError> {
        let Some(reference) = reference else {
            return Ok(ColourParam::Value(factor));
        };
        let texture = self.texture(reference, Meaning::Colour)?;
        Ok(ColourParam::Texture(self.scaled(texture, factor)))
    }

    /// A factor and a channel of a texture as a number.
    pub(super) fn float(
        &mut self,
        factor: f32,
        reference: Option<TextureRef>,
        meaning: Meaning,
    ) -> Result<FloatParam, SceneError> {
        let Some(reference) = reference else {
            return Ok(FloatParam::Value(factor));
        };
        let texture = self.texture(reference, meaning)?;
        Ok(FloatParam::Texture(
            self.scaled(texture, Rgb::splat(factor)),
        ))
    }

    /// A texture times a colour.
    pub(super) fn scaled(&mut self, texture: TextureId, factor: Rgb<f32>) -> TextureId {
        if factor == Rgb::WHITE {
            return texture;
        }
        let b = self.add_texture(Texture::Constant(factor));
        self.add_texture(Texture::Scale { a: texture, b })
    }
}

/// Meshes hold `(u, 1 - v)`, and pictures are read at `(s, 1 - t)`:
///
/// ```text
/// (s, t') = offset + R(rotation) (scale (u, v)),   t = 1 - t'
/// ```
///
/// Source: KHR_texture_transform; its rotation is counterclockwise in coordinates that run down.
fn mapping(reference: &TextureRef) -> UvMapping {
    let (sin, cos) = reference.rotation.sin_cos();
    let [sx, sy] = reference.scale;
    let [ox, oy] = reference.offset;
    // Rows of the map of (u, v) with v downwards.
    let s = [cos * sx, sin * sy, ox];
    let t = [-sin * sx, cos * sy, oy];
    // v = 1 - w, where w is the mesh's second coordinate.
    let upwards = |[u, v, one]: [f32; 3]| [u, -v, one + v];
    let [u, w, one] = upwards(t);
    UvMapping([upwards(s), [-u, -w, 1.0 - one]])
}

/// `minFilter` does not count: what it asks for at one sample of a pixel, many samples do without a blur.
fn filter(magnified: Option<MagFilter>) -> Interpolation {
    match magnified {
        Some(MagFilter::Nearest) => Interpolation::Nearest,
        Some(MagFilter::Linear) | None => Interpolation::Bilinear,
    }
}

fn wrap(mode: WrappingMode) -> Wrap {
    match mode {
        WrappingMode::ClampToEdge => Wrap::Clamp,
        WrappingMode::MirroredRepeat => Wrap::Mirror,
        WrappingMode::Repeat => Wrap::Repeat,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn apply(reference: &TextureRef, [u, v]: [f32; 2]) -> [f32; 2] {
        let UvMapping(rows) = mapping(reference);
        let w = 1.0 - v;
        let [s, t] = rows.map(|[a, b, c]| a * u + b * w + c);
        [s, 1.0 - t]
    }

    #[test]
    fn transforms_follow_the_extension() {
        let plain = TextureRef::plain(0, 0);
        assert_eq!(mapping(&plain), UvMapping::default());
        // The matrix of KHR_texture_transform: translation * rotation * scale, with
        // rotation = [[cos, sin], [-sin, cos]].
        let reference = TextureRef {
            offset: [0.25, -0.5],
            rotation: core::f32::consts::FRAC_PI_2,
            scale: [2.0, 3.0],
            ..plain
        };
        for (from, to) in [
            ([0.0, 0.0], [0.25, -0.5]),
            ([1.0, 0.0], [0.25, -2.5]),
            ([0.0, 1.0], [3.25, -0.5]),
        ] {
            let found = apply(&reference, from);
            for (a, b) in found.into_iter().zip(to) {
                assert!((a - b).abs() < 1e-5, "{from:?}: {found:?} {to:?}");
            }
        }
    }
}
