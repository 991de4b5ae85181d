//! Reader of Mitsuba 3 scenes, and of the 0.6 dialect, which is upgraded as it is read.
//!
//! The crate `roxmltree` parses XML; `document` makes of it a tree of plugins with typed
//! properties (parameters, includes and folders resolved on the way), and one file for each kind
//! of plugin turns that into the scene. Spectra become RGB as Mitsuba's own RGB mode makes them.
//!
//! | Mitsuba | here |
//! |---|---|
//! | camera space has +x to the left | a mirroring of x ahead of `to_world` |
//! | rows of pictures run with v | `t = 1 - v` in every picture's mapping |
//! | masking is `G1(wi) G1(wo)`, alpha is as given | `Masking::Separable`, `RoughnessMapping::Alpha` |
//! | opaque surfaces are black from behind unless `twosided` | `Material::one_sided` |
//! | `max_depth` counts the camera's segment, -1 is without end | one less, or the largest number |
//! | rows of environment maps lie on the poles, y is up | `LatitudeLongitudePoles` and a turn |
//! | a sphere's v runs from +z, a disk's u along its radius | mappings composed with the change |

mod assemble;
mod bsdf;
mod context;
mod document;
mod element;
mod emitter;
mod features;
mod film;
mod geometry;
mod glass;
mod layered;
mod medium;
mod metal;
mod microfacet;
mod number;
mod plain_value;
mod primitive;
mod principled;
mod sensor;
mod shape;
mod sky;
mod sky_table;
mod spectrum;
mod sun;
mod texture;
mod transform;
mod upgrade;
mod value;

use std::path::{Path, PathBuf};

pub use features::FEATURES;

use crate::error::SceneError;
use crate::problems::Problems;
use crate::read_file::Files;
use crate::{Limits, LoadOptions, Loaded};

/// What a caller may add to a scene's file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Values of `$name`, which win over the file's `<default>`.
    pub parameters: Vec<(String, String)>,
    /// Folders in which files are looked for after those that the scene names.
    pub folders: Vec<PathBuf>,
}

/// Reads the scene in `path` and all that it refers to.
///
/// # Errors
///
/// Where the scene cannot be read, or a picture of it would be meaningless.
pub fn read(path: &Path, limits: &Limits, options: &Options) -> Result<Loaded, SceneError> {
    let options = LoadOptions {
        limits: *limits,
        parameters: options.parameters.clone(),
        folders: options.folders.clone(),
    };
    let files = Files::new(*limits);
    read_into(path, &options, &files, &Problems::default())
}

/// [`read`] with a sink for errors.
pub(crate) fn read_into(
    path: &Path,
    options: &LoadOptions,
    files: &Files,
    problems: &Problems,
) -> Result<Loaded, SceneError> {
    let document = document::read(path, options, files, problems)?;
    assemble::assemble(document, files)
}
