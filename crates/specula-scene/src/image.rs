//! Decoded pictures.

/// A picture in linear RGB (sRGB primaries), row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Name of the file, for messages.
    pub name: String,
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// `width * height` linear RGB values.
    pub pixels: Vec<[f32; 3]>,
}
