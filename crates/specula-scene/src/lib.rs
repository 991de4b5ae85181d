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
mod format;
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
pub use format::Format;
pub use image::{Image, Indexed, Pixels};
pub use limits::Limits;
pub use report::{Problem, Report, Severity};
pub use scene::Scene;
pub use summary::Summary;
pub use validate::Invalid;

use problems::Problems;
use read_file::Files;

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
    /// The format that it was read as.
    pub format: Format,
    /// Every file that was read for the scene, the scene's own first, as the path that was opened; each
    /// once, in the order in which the reader met them.
    pub files: Vec<PathBuf>,
}

impl Loaded {
    fn new(format: Format, scene: Scene, warnings: Vec<Warning>, files: &Files) -> Self {
        Self {
            scene,
            warnings,
            format,
            files: files.list(),
        }
    }
}

/// Reads a scene within the default [`Limits`], in the format that its content tells, packed by gzip or not:
/// pbrt-v4, Mitsuba's XML, glTF 2.0 (JSON or binary), or a mesh alone (OBJ, PLY), which is staged. The end of
/// the name decides only where the content does not, as in an empty file.
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
    let files = Files::new(options.limits);
    read(path, options, &files, &Problems::default())
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
    let files = Files::new(options.limits);
    let loaded = read(path, options, &files, &problems);
    Report::new(loaded, problems.take(), files.list())
}

/// Reads a scene from memory: what a pipe contributed, say.
///
/// * `name`: what messages call it; files that it names are looked for beside this path.
///
/// # Errors
///
/// Those of [`load`].
///
/// ```
/// let text = b"Camera \"perspective\"\nWorldBegin\nShape \"sphere\"\n".to_vec();
/// let loaded = specula_scene::load_bytes("<stdin>".as_ref(), text, &Default::default())?;
/// assert_eq!(loaded.scene.shapes.len(), 1);
/// # Ok::<(), specula_scene::SceneError>(())
/// ```
pub fn load_bytes(
    name: &Path,
    bytes: Vec<u8>,
    options: &LoadOptions,
) -> Result<Loaded, SceneError> {
    let files = Files::new(options.limits);
    let format = files.give(name, bytes);
    read_as(format, name, options, &files, &Problems::default())
}

fn read(
    path: &Path,
    options: &LoadOptions,
    files: &Files,
    problems: &Problems,
) -> Result<Loaded, SceneError> {
    let is_file = std::fs::metadata(path).is_ok_and(|m| m.is_file());
    let (format, name) = match files.scene(path) {
        Ok(bytes) => {
            // A pipe is no place for the files that a scene names: those are looked for here.
            let name = if is_file { path } else { Path::new("<pipe>") };
            (files.give(name, bytes), name)
        }
        // The reader meets the same fault, and knows where to say it.
        Err(_) => (Format::of_name(path).unwrap_or(Format::Pbrt), path),
    };
    read_as(format, name, options, files, problems)
}

fn read_as(
    format: Format,
    path: &Path,
    options: &LoadOptions,
    files: &Files,
    problems: &Problems,
) -> Result<Loaded, SceneError> {
    match format {
        Format::Mitsuba => mitsuba::read_into(path, options, files, problems),
        Format::Gltf => gltf::read(path, options, files, problems),
        Format::Obj => single::read(path, files, problems, (format, obj::read)),
        Format::Ply => single::read(path, files, problems, (format, ply::read)),
        Format::Pbrt => pbrt::read(path, options, files, problems),
    }
}
