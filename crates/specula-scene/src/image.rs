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

/// The name of a picture that stands in for one that cannot be read.
pub(crate) const STAND_IN: &str = "stand-in";

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
    /// A grey checker in place of a picture that cannot be read.
    pub(crate) fn stand_in() -> Self {
        const SIDE: u32 = 64;
        let grey = |i: u32| {
            let is_dark = (i % SIDE / 8 + i / SIDE / 8).is_multiple_of(2);
            [if is_dark { 0.25 } else { 0.5 }; 3]
        };
        Self {
            name: STAND_IN.to_owned(),
            width: SIDE,
            height: SIDE,
            pixels: (0..SIDE * SIDE).map(grey).collect::<Vec<_>>().into(),
        }
    }
}
