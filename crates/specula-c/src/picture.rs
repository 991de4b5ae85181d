//! Pictures: layers into arrays, and files.

use std::path::Path;

use specula_bsdf::math::Rgb;
use specula_render::picture::{self, Display, Metadata, Picture, PictureError};

use crate::failure::{Failure, Status};
use crate::pointers::Caller;

/// Layer of 3 channels: radiance times exposure, in linear sRGB.
pub const SPECULA_LAYER_COLOUR: u32 = 0;
/// Layer of 3 channels: albedo of the first visible surface.
pub const SPECULA_LAYER_ALBEDO: u32 = 1;
/// Layer of 3 channels: shading normal of the first visible surface, in the world.
pub const SPECULA_LAYER_NORMAL: u32 = 2;
/// Layer of 1 channel: distance along the camera ray to the first visible surface, in scene units; 0 where none is.
pub const SPECULA_LAYER_DEPTH: u32 = 3;
/// Layer of 1 channel: samples taken.
pub const SPECULA_LAYER_SAMPLE_COUNT: u32 = 4;
/// Layer of 3 channels: estimated variance of the colour.
pub const SPECULA_LAYER_VARIANCE: u32 = 5;

/// A picture: layers of pixels. `specula_picture_free` frees it.
pub struct PictureHandle {
    pub(crate) picture: Picture,
    pub(crate) metadata: Metadata,
}

/// Where a layer goes.
pub(crate) struct Place {
    pub(crate) to: *mut f32,
    /// Floats that there is room for.
    pub(crate) room: usize,
    /// Floats from one pixel to the next; 0: no gap.
    pub(crate) pixel_stride: usize,
    /// Floats from one row to the next; 0: no gap.
    pub(crate) row_stride: usize,
}

impl PictureHandle {
    /// Copies a layer, rows from the top.
    pub(crate) fn read(&self, caller: &Caller, layer: u32, place: &Place) -> Result<(), Failure> {
        let picture = &self.picture;
        let rgb = |layer: &[Rgb<f32>], c: usize| layer.iter().map(|p| p.to_array()[c]).collect();
        let channels: Vec<Vec<f32>> = match layer {
            SPECULA_LAYER_COLOUR => (0..3).map(|c| rgb(&picture.colour, c)).collect(),
            SPECULA_LAYER_ALBEDO => (0..3).map(|c| rgb(&picture.albedo, c)).collect(),
            SPECULA_LAYER_VARIANCE => (0..3).map(|c| rgb(&picture.variance, c)).collect(),
            SPECULA_LAYER_NORMAL => {
                let along = |c: usize| picture.normal.iter().map(move |n| n.to_array()[c]);
                (0..3).map(|c| along(c).collect()).collect()
            }
            SPECULA_LAYER_DEPTH => vec![picture.depth.clone()],
            SPECULA_LAYER_SAMPLE_COUNT => vec![picture.sample_count.clone()],
            _ => {
                return Err(Failure::invalid(format!(
                    "layer: there is no layer {layer} (expected one of SPECULA_LAYER_...)"
                )));
            }
        };
        let [width, height] = [picture.width, picture.height].map(|n| n as usize);
        let pixel_stride = at_least(channels.len(), place.pixel_stride, "pixel_stride")?;
        let filled = (width.saturating_sub(1))
            .saturating_mul(pixel_stride)
            .saturating_add(channels.len());
        // Rows may interleave with those of other pictures, but not with one another.
        let tight = width.saturating_mul(pixel_stride);
        let row_stride = match place.row_stride {
            0 => tight,
            stride => at_least(filled, stride, "row_stride")?,
        };
        let needed = (height.saturating_sub(1))
            .saturating_mul(row_stride)
            .saturating_add(filled);
        if place.room < needed {
            return Err(Failure::invalid(format!(
                "room: expected {needed} floats or more, got {}",
                place.room
            )));
        }
        caller.place("to", place.to)?;
        for (channel, values) in channels.iter().enumerate() {
            for (y, row) in values.chunks_exact(width).enumerate() {
                let first = place.to.wrapping_add(y * row_stride + channel);
                caller
                    .target(["to"], [first], pixel_stride, width)?
                    .write(0, [row]);
            }
        }
        Ok(())
    }

    /// Writes a file of the format that its name ends with.
    pub(crate) fn write(&self, path: &str) -> Result<(), Failure> {
        let path = Path::new(path);
        let extension = path.extension().unwrap_or_default().to_string_lossy();
        let written = match extension.to_ascii_lowercase().as_str() {
            "exr" => picture::write_exr(path, &self.picture, &self.metadata),
            "png" => picture::write_png(path, &self.picture, Display::default()),
            _ => {
                return Err(Failure::invalid(format!(
                    "path: expected a name that ends with .exr or .png, got '{}'",
                    path.display()
                )));
            }
        };
        written
            .map(drop)
            .map_err(|e: PictureError| Failure::new(Status::Unwritable, e))
    }
}

/// A stride: what is given, or without a gap where that is 0.
fn at_least(least: usize, given: usize, name: &str) -> Result<usize, Failure> {
    match given {
        0 => Ok(least),
        stride if stride < least => Err(Failure::invalid(format!(
            "{name}: expected {least} floats or more, or 0, got {stride}"
        ))),
        stride => Ok(stride),
    }
}
