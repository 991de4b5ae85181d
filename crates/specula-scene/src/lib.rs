//! Scenes that people have, read into one model with located errors.
//!
//! ```no_run
//! let loaded = specula_scene::load(std::path::Path::new("scene.pbrt"))?;
//! for warning in &loaded.warnings {
//!     eprintln!("{}: {warning}", warning.place());
//! }
//! # Ok::<(), specula_scene::SceneError>(())
//! ```
#![forbid(unsafe_code)]

pub mod bounds;
pub mod builtin;
#[cfg(feature = "miette")]
mod diagnostic;
pub mod energy;
pub mod error;
pub mod image;
mod mesh;
mod num;
mod pbrt;
mod ply;
mod read_file;
pub mod scene;
pub mod spectrum;
pub mod summary;
pub mod validate;

use std::path::Path;

pub use energy::{Energy, UnknownEnergy};
pub use error::{ErrorKind, Place, SceneError, Source, Warning};
pub use image::Image;
pub use scene::Scene;
pub use summary::Summary;
pub use validate::Invalid;

/// A scene with what was read otherwise than its file says.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The scene; it satisfies [`Scene::validate`].
    pub scene: Scene,
    /// Stand-ins, unused parameters and dropped geometry, in the order in which they were met.
    pub warnings: Vec<Warning>,
}

/// Reads a scene in the format of pbrt-v4 (also gzipped).
///
/// # Errors
///
/// Where a file cannot be read or is damaged, and where a picture would be meaningless. The error
/// says what was expected and where.
pub fn load(path: &Path) -> Result<Loaded, SceneError> {
    pbrt::load(path)
}
