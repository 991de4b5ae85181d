//! Decoded pictures, and the formats they are read from.

mod exr_file;
mod format;
mod integers;
mod pfm;
mod pixels;
mod read;

pub use exr_file::guarded;
pub(crate) use format::Format;
pub use pixels::{Indexed, Pixels};
pub(crate) use read::{Content, Encoding, decode, read};

/// A picture in linear RGB (sRGB primaries), row by row from the top.
///
/// Invariant (from readers): `pixels` holds `width * height` values, finite and not negative.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Name of the file, for messages.
    pub name: String,
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// `width * height` linear RGB values.
    pub pixels: Pixels,
}

impl Image {
    /// A grey pixel in place of a picture that cannot be read.
    pub(crate) fn stand_in() -> Self {
        Self {
            name: String::new(),
            width: 1,
            height: 1,
            pixels: vec![[0.5; 3]].into(),
        }
    }
}
