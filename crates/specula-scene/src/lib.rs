//! Readers of scenes: pbrt-v4, Mitsuba 3 and glTF 2.0 into one model, with located errors.
//!
//! [`load`] reads a scene, in the format that its content tells. [`check`] lists all problems of one.
//! [`write_pbrt`](write_pbrt::write_pbrt) writes one. The model is [`Scene`], of the types in [`scene`].
//!
//! ```
//! use specula_scene::{LoadOptions, load_bytes};
//!
//! let text = b"Camera \"perspective\"
//!     WorldBegin
//!     LightSource \"infinite\"
//!     Material \"copper\"
//!     Shape \"sphere\"";
//! let error = load_bytes("a.pbrt".as_ref(), text.to_vec(), &LoadOptions::default()).unwrap_err();
//! assert_eq!(error.place().to_string(), "a.pbrt:4:14");
//! assert!(error.message().contains("copper"), "{error}");
//!
//! let text = String::from_utf8_lossy(text).replace("copper", "conductor");
//! let loaded = load_bytes("a.pbrt".as_ref(), text.into(), &LoadOptions::default())?;
//! assert_eq!(loaded.scene.shapes.len(), 1);
//! for warning in &loaded.warnings {
//!     println!("{}: {warning}", warning.place());
//! }
//! # Ok::<(), specula_scene::SceneError>(())
//! ```
#![forbid(unsafe_code)]

pub mod atomic;
pub mod bounds;
pub mod builtin;
mod curves;
#[cfg(feature = "miette")]
mod diagnostic;
pub mod energy;
pub mod error;
mod faults;
mod feature;
pub mod features;
mod fingerprint;
mod format;
mod gltf;
mod grid;
pub mod image;
mod limits;
pub mod material_text;
pub mod measured;
mod media;
mod mesh;
mod missing;
mod mitsuba;
mod num;
mod obj;
mod pbrt;
mod ply;
mod pressed;
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
mod transform;
mod triangulate;
pub mod validate;
pub mod write_pbrt;

use std::path::{Path, PathBuf};
use std::time::Duration;

pub use energy::{Energy, UnknownEnergy};
pub use error::{ErrorKind, MissingFile, Place, SceneError, SourceText, Warning};
pub use feature::{Feature, Support};
pub use format::Format;
pub use image::{Image, Indexed, Pixels};
pub use limits::Limits;
pub use missing::Missing;
pub use report::{CheckReport, Problem, Severity};
pub use scene::Scene;
pub use summary::Summary;
pub use validate::Invalid;

use problems::Problems;
use read_file::Files;
use search::Search;

/// How a scene is read.
///
/// ```
/// use specula_scene::{Limits, LoadOptions};
///
/// let mut options = LoadOptions::from(Limits::strict());
/// options.folders.push("textures".into());
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct LoadOptions {
    /// Bounds on what is read.
    pub limits: Limits,
    /// Values of `$name` in a Mitsuba scene; they override its `<default>`.
    pub parameters: Vec<(String, String)>,
    /// Folders that are searched for files that the scene names and that are not beside it.
    pub folders: Vec<PathBuf>,
    /// What is done about files that the scene names and that do not exist.
    pub missing: Missing,
    /// A folder: files outside of it are not read, nor through links. For scenes of strangers.
    pub confined_to: Option<PathBuf>,
    /// The moment of a glTF file's animations that is rendered; `None`: nodes stand where the file puts them.
    pub exposure: Option<Exposure>,
    /// The animation of a glTF file that is played, by its name or its number from 0; `None`: all together, or the
    /// first alone where they animate the same.
    pub animation: Option<String>,
}

/// When the shutter is open, in the time of a file's animations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Exposure {
    /// When it opens.
    pub time: Duration,
    /// For how long: nodes move from where they are then to where they are when it closes. The exposure is no brighter
    /// for it.
    pub shutter: Duration,
}

impl From<Limits> for LoadOptions {
    fn from(limits: Limits) -> Self {
        Self {
            limits,
            ..Self::default()
        }
    }
}

/// A scene that was read, with warnings.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The scene; it satisfies [`Scene::validate`].
    pub scene: Scene,
    /// Stand-ins, unused parameters and dropped geometry, in the order of reading.
    pub warnings: Vec<Warning>,
    /// The format that it was read as.
    pub format: Format,
    /// Every file that was read for the scene, the scene's own first, as the path that was opened; each
    /// once, in the order in which the reader met them.
    pub files: Vec<PathBuf>,
    /// The files that do not exist and that something stands in for, as [`Missing::StandIn`] says.
    pub missing: Vec<PathBuf>,
}

impl Loaded {
    fn new(format: Format, scene: Scene, warnings: Vec<Warning>, files: &Files) -> Self {
        Self {
            scene,
            warnings,
            format,
            files: files.list(),
            missing: Vec::new(),
        }
    }
}

/// Reads a scene with default options.
///
/// The content tells the format: pbrt-v4, Mitsuba's XML, glTF 2.0 (JSON or binary), or a single mesh
/// (OBJ, PLY), which gets a camera, light and a floor. Files may be packed by gzip. The file's extension
/// decides only where the content does not, as in an empty file.
///
/// # Errors
///
/// Where a file cannot be read or is damaged, and where a picture would be meaningless. The error
/// says what was expected and where.
pub fn load(path: &Path) -> Result<Loaded, SceneError> {
    load_with(path, &LoadOptions::default())
}

/// Reads a scene as [`load`] does, with options.
///
/// # Errors
///
/// Those of [`load`].
pub fn load_with(path: &Path, options: &LoadOptions) -> Result<Loaded, SceneError> {
    let files = Files::of(options);
    read(path, options, &files, &Problems::loading(options.missing))
}

/// Reads a scene of a known format, whatever its content looks like.
///
/// # Errors
///
/// Those of [`load`].
pub fn load_as(path: &Path, format: Format, options: &LoadOptions) -> Result<Loaded, SceneError> {
    let files = Files::of(options);
    let problems = Problems::loading(options.missing);
    read_as(format, path, options, &files, &problems)
}

/// Reads a scene and lists all its problems: every error, and everything that would be rendered otherwise
/// than the file says. A scene without errors here loads.
///
/// ```no_run
/// let report = specula_scene::check("scene.pbrt".as_ref(), &Default::default());
/// for problem in report.problems() {
///     println!("{} {}: {problem}", problem.severity().name(), problem.place());
/// }
/// ```
#[must_use]
pub fn check(path: &Path, options: &LoadOptions) -> CheckReport {
    let problems = Problems::collecting(options.missing);
    let files = Files::of(options);
    let loaded = read(path, options, &files, &problems);
    CheckReport::new(loaded, problems.take(), files.list())
}

/// Reads a scene from memory.
///
/// * `name`: its path in messages; files that the scene names are searched for beside it.
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
    let files = Files::of(options);
    let format = files.give(name, bytes);
    let problems = Problems::loading(options.missing);
    read_as(format, name, options, &files, &problems)
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
            // A pipe has no folder: files that the scene names are searched for in the working folder.
            let name = if is_file { path } else { Path::new("<pipe>") };
            (files.give(name, bytes), name)
        }
        // The reader will meet the error, and reports where.
        Err(message) => (files.refuse(path, message), path),
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
    let mut loaded = match format {
        Format::Mitsuba => mitsuba::read(path, options, files, problems),
        Format::Gltf => gltf::read(path, options, files, problems),
        Format::Obj => {
            let search = Search::new(path, &options.folders);
            let read = |path: &Path, files: &Files, collects: bool| {
                obj::read_looks(path, files, collects, &search)
            };
            single::read(path, files, problems, (format, read))
        }
        Format::Ply => {
            let read = |path: &Path, files: &Files, collects: bool| {
                ply::read(path, files, collects).map(single::Staged::of)
            };
            single::read(path, files, problems, (format, read))
        }
        Format::Pbrt => pbrt::read(path, options, files, problems),
    };
    if let (Ok(loaded), Some(_)) = (&mut loaded, options.exposure)
        && format != Format::Gltf
    {
        let start = Place::start(&SourceText::unread(path));
        let message = "only glTF files have animations: the scene is the same at all times";
        loaded.warnings.push(Warning::new(&start, message));
    }
    problems.settled(loaded)
}
