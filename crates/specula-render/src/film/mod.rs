//! The film: reconstruction filter, sums per pixel, noise estimates, film files.

mod adaptive;
mod buffer;
pub(crate) mod develop;
mod file;
pub(crate) mod filter;
mod noise;
mod rows;
mod run;
mod scatter_counts;
mod sum;
mod tile;
mod trend;
mod vertex_counts;

pub(crate) use adaptive::Aim;
pub use adaptive::MOST_SAMPLES;
pub use buffer::{FilmBuffer, MergeError};
pub(crate) use buffer::{PixelSample, PixelSums};
pub use file::{FilmFile, FilmFileError, FilmHead, Label};
pub use noise::NoiseEstimate;
pub(crate) use rows::{ROWS, SampleRows};
pub(crate) use run::LONGEST_RUN;
pub use run::RunSums;
pub use scatter_counts::ScatterCounts;
pub(crate) use tile::{BYTES_PER_TILE, TILE, Tile};
pub use trend::{NoiseOutlook, NoiseTrend};
pub use vertex_counts::VertexCounts;
