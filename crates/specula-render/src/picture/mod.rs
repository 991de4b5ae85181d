//! Finished pictures: the results of renders, as files and by metrics.
//!
//! Files are written whole or not at all ([`write_exr`], [`write_png`]): into a temporary file
//! in the same folder, synchronised, then renamed over the old one.

mod atomic;
mod colour_map;
mod compare;
mod error;
mod exr_read;
mod exr_write;
mod flip;
mod png_write;
mod srgb;
mod tone;

use specula_bsdf::{Rgb, Vec3};

pub use atomic::check_writable;
pub use colour_map::{difference_rgb8, inferno};
pub use compare::{Comparison, compare};
pub use error::PictureError;
pub use exr_read::read_exr;
pub(crate) use exr_write::{ALL_CHANNELS, blocks_size};
pub use exr_write::{Metadata, exr_bytes, write_exr};
pub use flip::{PIXELS_PER_DEGREE, flip_map, hdr_flip_map};
pub use png_write::{png_bytes, write_png, write_rgb8};
pub use tone::{Display, ToneMap, automatic_exposure};

/// A picture with what a renderer knows about each pixel. Rows run from the top.
///
/// Every layer but `colour` is either empty (unknown, as in files by other programs) or one value
/// per pixel, `width * height` of them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Picture {
    /// Pixels in a row of this (possibly cropped) picture.
    pub width: u32,
    /// Rows of this (possibly cropped) picture.
    pub height: u32,
    /// Width and height of the whole picture that this one is a window of.
    pub full_resolution: [u32; 2],
    /// Column and row, in the whole picture, of this one's first pixel.
    pub offset: [u32; 2],
    /// Radiance times exposure: linear RGB, sRGB primaries, D65 white.
    pub colour: Vec<Rgb<f32>>,
    /// Albedo of the first visible surface.
    pub albedo: Vec<Rgb<f32>>,
    /// Shading normal of the first visible surface, in the world.
    pub normal: Vec<Vec3<f32>>,
    /// Distance along the camera ray to the first visible surface, in scene units; 0 where there is none.
    pub depth: Vec<f32>,
    /// Samples taken.
    pub sample_count: Vec<f32>,
    /// Estimated variance of `colour`.
    pub variance: Vec<Rgb<f32>>,
}

impl Picture {
    /// A picture of colours only, whole: neither cropped nor with other layers.
    ///
    /// # Panics
    ///
    /// Where `colour` does not hold `width * height` values.
    #[must_use]
    pub fn from_colour(width: u32, height: u32, colour: Vec<Rgb<f32>>) -> Self {
        assert_eq!(
            colour.len(),
            width as usize * height as usize,
            "one colour per pixel"
        );
        Self {
            width,
            height,
            full_resolution: [width, height],
            colour,
            ..Self::default()
        }
    }

    /// Values that are infinite or not a number, over all layers.
    ///
    /// The writers replace them by 0 and return this number.
    #[must_use]
    pub fn non_finite_count(&self) -> usize {
        let colours = [&self.colour, &self.albedo, &self.variance];
        let in_colours: usize = colours
            .iter()
            .flat_map(|layer| layer.iter())
            .map(|c| count_non_finite(&c.to_array()))
            .sum();
        let in_normals: usize = self
            .normal
            .iter()
            .map(|n| count_non_finite(&n.to_array()))
            .sum();
        in_colours
            + in_normals
            + count_non_finite(&self.depth)
            + count_non_finite(&self.sample_count)
    }
}

fn count_non_finite(values: &[f32]) -> usize {
    values.iter().filter(|v| !v.is_finite()).count()
}

/// `value`, or 0 where it is infinite or not a number.
fn finite(value: f32) -> f32 {
    if value.is_finite() { value } else { 0.0 }
}
