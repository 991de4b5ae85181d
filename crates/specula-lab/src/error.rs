//! Errors of the laboratory.

use std::io;
use std::path::{Path, PathBuf};

/// Why an experiment or a comparison has no result.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LabError {
    /// The caller asked to stop. What was finished before is written.
    #[error("stopped")]
    Stopped,
    /// No experiment has that name.
    #[error("no experiment is called '{name}'; `specula lab list` names them{nearest}")]
    UnknownExperiment {
        /// What was asked for.
        name: String,
        /// ` (nearest: ...)`, or nothing.
        nearest: String,
    },
    /// A file or folder could not be read or written.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A file of results is not one, or is damaged.
    #[error("{}: not a result of the laboratory: {message}", path.display())]
    NotAResult {
        /// The file.
        path: PathBuf,
        /// What was expected.
        message: String,
    },
    /// A folder holds no results.
    #[error("{}: no results of the laboratory here; `specula lab run` makes some", .0.display())]
    NoResults(PathBuf),
    /// A material cannot be measured by itself.
    #[error("{0}")]
    Material(String),
    /// A scene could not be prepared.
    #[error(transparent)]
    Prepare(#[from] specula_render::PrepareError),
    /// A picture could not be written or compared.
    #[error(transparent)]
    Picture(#[from] specula_render::picture::PictureError),
    /// The GPU failed.
    #[error(transparent)]
    Gpu(#[from] specula_gpu::GpuError),
    /// A plot, a table or a page could not be made.
    #[error("{0}")]
    Output(String),
}

impl LabError {
    /// [`LabError::Io`] of `path`.
    pub fn io(path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_owned();
        move |source| Self::Io { path, source }
    }
}
