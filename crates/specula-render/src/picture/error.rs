//! What can go wrong with picture files.

use std::path::PathBuf;

/// Why a picture could not be read, written or compared.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PictureError {
    /// The file could not be opened, read, written or renamed.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The file is not an EXR picture that can be read, or could not be written as one.
    #[error("{}: not a readable OpenEXR picture: {message}", path.display())]
    Exr {
        /// The file.
        path: PathBuf,
        /// What the codec said.
        message: String,
    },
    /// The EXR file holds no colours.
    #[error("{}: no channels R, G and B (nor Y) in it; it holds {found}", path.display())]
    NoColour {
        /// The file.
        path: PathBuf,
        /// The channels that it does hold.
        found: String,
    },
    /// The PNG codec refused.
    #[error("{}: {message}", path.display())]
    Png {
        /// The file.
        path: PathBuf,
        /// What the codec said.
        message: String,
    },
    /// The pictures cannot be compared pixel by pixel.
    #[error(
        "the pictures differ in size or crop: {}x{} at ({}, {}) of {}x{}, and {}x{} at ({}, {}) of {}x{}",
        a[0], a[1], a[2], a[3], a[4], a[5], b[0], b[1], b[2], b[3], b[4], b[5]
    )]
    DifferentSize {
        /// Width, height, offset and whole resolution of the first.
        a: [u32; 6],
        /// The same of the second.
        b: [u32; 6],
    },
}
