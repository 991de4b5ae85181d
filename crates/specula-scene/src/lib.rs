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

pub mod atomic;
pub mod bounds;
pub mod builtin;
#[cfg(feature = "miette")]
mod diagnostic;
pub mod energy;
pub mod error;
mod faults;
pub mod features;
mod fingerprint;
pub mod gltf;
pub mod image;
mod limits;
pub mod material_text;
mod media;
mod mesh;
pub mod mitsuba;
mod num;
mod obj;
mod pbrt;
mod ply;
mod problems;
mod read_file;
pub mod report;
pub mod scene;
mod search;
mod serialized;
mod single;
pub mod spectrum;
mod stage;
pub mod summary;
pub mod validate;
pub mod write_pbrt;

use std::path::{Path, PathBuf};

pub use energy::{Energy, UnknownEnergy};
pub use error::{ErrorKind, Place, SceneError, Source, Warning};
pub use features::{Feature, Support};
pub use image::Image;
pub use limits::Limits;
pub use report::{Problem, Report, Severity};
pub use scene::Scene;
pub use summary::Summary;
pub use validate::Invalid;

use problems::Problems;

/// What a caller may say about how a scene is read.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LoadOptions {
    /// Bounds on what is read.
    pub limits: Limits,
    /// Values of `$name` in a Mitsuba scene, which win over its `<default>`.
    pub parameters: Vec<(String, String)>,
    /// Folders in which files that the scene names are looked for where they are not beside it.
    pub folders: Vec<PathBuf>,
}

/// A scene with what was read otherwise than its file says.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The scene; it satisfies [`Scene::validate`].
    pub scene: Scene,
    /// Stand-ins, unused parameters and dropped geometry, in the order in which they were met.
    pub warnings: Vec<Warning>,
}

/// Reads a scene in the format that its name's end tells, within the default [`Limits`]: `.xml` is
/// Mitsuba's, `.gltf` and `.glb` are glTF 2.0, `.obj` and `.ply` (also gzipped) meshes alone, which are
/// staged, and anything else is pbrt-v4's (also gzipped).
///
/// # Errors
///
/// Where a file cannot be read or is damaged, and where a picture would be meaningless. The error
/// says what was expected and where.
pub fn load(path: &Path) -> Result<Loaded, SceneError> {
    load_with(path, &Limits::default())
}

/// Reads a scene, as [`load`] does, within limits of the caller's choice.
///
/// # Errors
///
/// Those of [`load`].
pub fn load_with(path: &Path, limits: &Limits) -> Result<Loaded, SceneError> {
    let options = LoadOptions {
        limits: *limits,
        ..LoadOptions::default()
    };
    load_with_options(path, &options)
}

/// Reads a scene, as [`load`] does, with all that a caller may say about it.
///
/// # Errors
///
/// Those of [`load`].
pub fn load_with_options(path: &Path, options: &LoadOptions) -> Result<Loaded, SceneError> {
    read(path, options, &Problems::default())
}

/// Reads a scene for its problems: all errors that reading meets, with a stand-in for what has one,
/// and all that would be rendered otherwise than the file says. A scene without errors here loads.
///
/// ```no_run
/// let report = specula_scene::check("scene.pbrt".as_ref(), &Default::default());
/// for problem in report.problems() {
///     println!("{} {}: {problem}", problem.severity().name(), problem.place());
/// }
/// ```
#[must_use]
pub fn check(path: &Path, options: &LoadOptions) -> Report {
    let problems = Problems::collecting();
    let loaded = read(path, options, &problems);
    Report::new(loaded, problems.take())
}

fn read(path: &Path, options: &LoadOptions, problems: &Problems) -> Result<Loaded, SceneError> {
    let extension = |path: &Path| {
        let extension = path.extension()?.to_string_lossy().to_ascii_lowercase();
        Some(extension)
    };
    let extension = match extension(path) {
        Some(gz) if gz == "gz" => extension(&path.with_extension("")),
        other => other,
    };
    match extension.as_deref() {
        Some("xml") => mitsuba::read_into(path, options, problems),
        Some("gltf" | "glb") => gltf::read(path, options, problems),
        Some("obj") => single::read(path, options, problems, obj::read),
        Some("ply") => single::read(path, options, problems, ply::read),
        _ => pbrt::read(path, options, problems),
    }
}
