//! Why a scene is not rendered on a device.

use crate::adapter::GpuError;
use crate::scene_program::MissingFeatures;

/// Why a scene cannot be rendered on a device.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TracerError {
    /// The scene has features that shaders do not support.
    #[error(transparent)]
    Missing(#[from] MissingFeatures),
    /// The scene's arrays are larger than the device takes.
    #[error("the GPU does not hold the scene: its largest array has {needed} bytes, {limit} fit")]
    TooLarge {
        /// Bytes of the largest array.
        needed: u64,
        /// Bytes that the device takes.
        limit: u64,
    },
    /// The library's modules do not fit together.
    #[error(transparent)]
    Program(#[from] specula_shaders::ComposeError),
    /// Ray queries are asked for, and cannot be had.
    #[error("no ray queries: {0}")]
    Queries(String),
    /// The device failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
}
