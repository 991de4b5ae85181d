//! What samples are gathered in: the reconstruction filter and the sums per pixel.

mod buffer;
pub(crate) mod develop;
mod file;
pub(crate) mod filter;
mod sum;

pub use buffer::{FilmBuffer, MergeError};
pub(crate) use buffer::{PixelSample, Tile};
pub use file::{FilmFile, FilmFileError, Label};
