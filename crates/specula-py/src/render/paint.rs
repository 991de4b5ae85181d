//! What colours a material: a number, a colour or a picture, out of Python's arguments.

use pyo3::prelude::*;
use specula::scene::scene::{
    Channel, ColourParam, FloatParam, ImageId, Interpolation, Texture, TextureId, TextureMapping,
    Wrap,
};
use specula::scene::{Image, Scene};
use specula_bsdf::math::Rgb;

use crate::arrays::Argument;
use crate::parameters::invalid;

/// The range of a share of light.
pub(super) const SHARE: [f32; 2] = [0.0, 1.0];
/// The range of what has no upper bound.
pub(super) const ANY: [f32; 2] = [0.0, f32::MAX];

/// The range of heights.
pub(super) const SIGNED: [f32; 2] = [-f32::MAX, f32::MAX];

/// A value that may vary over a surface.
#[derive(Clone)]
pub(super) enum Paint {
    Value(Rgb<f32>),
    Picture(Image),
}

impl Paint {
    /// A number, three, or an array of shape (h, w) or (h, w, 3), all within a range.
    pub(super) fn new(
        name: &'static str,
        given: &Bound<'_, PyAny>,
        [low, high]: [f32; 2],
    ) -> PyResult<Self> {
        let argument = Argument::new(name, given)?;
        let array = argument.numbers::<f32>()?;
        let values = array.as_slice()?;
        if let Some(wrong) = values.iter().find(|v| !(low..=high).contains(*v)) {
            let wanted = match (low == -f32::MAX, high == f32::MAX) {
                (true, true) => "finite numbers".to_owned(),
                (_, true) => format!("{low} or more"),
                _ => format!("numbers in [{low}, {high}]"),
            };
            return Err(invalid(format!("{name}: expected {wanted}, got {wrong}")));
        }
        match (argument.shape(), values) {
            ([], &[grey]) => Ok(Self::Value(Rgb::splat(grey))),
            ([3], &[r, g, b]) => Ok(Self::Value(Rgb { r, g, b })),
            (&[height, width, 3], _) if width * height > 0 => {
                let (pixels, _) = values.as_chunks::<3>();
                picture(name, [width, height], pixels.to_vec())
            }
            (&[height, width], _) if width * height > 0 => {
                let pixels = values.iter().map(|&v| [v; 3]).collect();
                picture(name, [width, height], pixels)
            }
            (shape, _) => Err(invalid(format!(
                "{name}: expected a number, three numbers, or a picture of shape (h, w) or (h, w, 3), \
                 got an array of shape {shape:?}"
            ))),
        }
    }

    /// The same everywhere, as it is the default.
    pub(super) fn or(
        name: &'static str,
        given: Option<&Bound<'_, PyAny>>,
        range: [f32; 2],
        default: f32,
    ) -> PyResult<Self> {
        match given {
            None => Ok(Self::Value(Rgb::splat(default))),
            Some(given) => Self::new(name, given, range),
        }
    }

    /// As a colour of a scene's material.
    pub(super) fn colour(&self, scene: &mut Scene) -> ColourParam {
        match self {
            Self::Value(value) => ColourParam::Value(*value),
            Self::Picture(image) => ColourParam::Texture(texture(scene, image)),
        }
    }

    /// As a number of a scene's material.
    pub(super) fn number(&self, scene: &mut Scene) -> FloatParam {
        match self {
            Self::Value(value) => FloatParam::Value(value.r),
            Self::Picture(image) => FloatParam::Texture(texture(scene, image)),
        }
    }
}

fn picture(name: &str, [width, height]: [usize; 2], pixels: Vec<[f32; 3]>) -> PyResult<Paint> {
    let size = |n: usize| u32::try_from(n).map_err(|_| invalid(format!("{name}: too large")));
    Ok(Paint::Picture(Image {
        name: name.to_owned(),
        width: size(width)?,
        height: size(height)?,
        pixels: pixels.into(),
    }))
}

/// Adds a picture, rows from the top, over the unit square of surface coordinates.
fn texture(scene: &mut Scene, image: &Image) -> TextureId {
    scene.images.push(image.clone());
    scene.textures.push(Texture::Image {
        image: ImageId(scene.images.len() - 1),
        mapping: TextureMapping::default(),
        wrap: [Wrap::Repeat; 2],
        filter: Interpolation::Bilinear,
        invert: false,
        scale: 1.0,
        channel: Channel::Rgb,
    });
    TextureId(scene.textures.len() - 1)
}
