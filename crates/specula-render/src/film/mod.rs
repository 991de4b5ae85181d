//! The film: reconstruction filter, sums per pixel, noise estimates, film files.

mod adaptive;
mod buffer;
pub(crate) mod develop;
mod file;
pub(crate) mod filter;
mod noise;
mod run;
mod scatter_counts;
mod sum;
mod trend;
mod vertex_counts;

pub(crate) use adaptive::Aim;
pub use adaptive::MOST_SAMPLES;
pub(crate) use buffer::BYTES_PER_PIXEL;
pub use buffer::{FilmBuffer, MergeError};
pub(crate) use buffer::{PixelSample, PixelSums, Tile};
pub use file::{FilmFile, FilmFileError, FilmHead, Label};
pub use noise::NoiseEstimate;
pub(crate) use run::LONGEST_RUN;
pub use run::RunSums;
pub use scatter_counts::ScatterCounts;
pub use trend::{NoiseOutlook, NoiseTrend};
pub use vertex_counts::VertexCounts;
