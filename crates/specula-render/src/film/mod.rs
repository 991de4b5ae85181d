//! What samples are gathered in: the reconstruction filter and the sums per pixel.

mod buffer;
pub(crate) mod develop;
pub(crate) mod filter;

pub use buffer::{FilmBuffer, MergeError};
pub(crate) use buffer::{PixelSample, Tile};
