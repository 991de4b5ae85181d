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
mod hair;
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

use std::path::Path;

pub(crate) use features::FEATURES;

use crate::error::SceneError;
use crate::problems::Problems;
use crate::read_file::Files;
use crate::{LoadOptions, Loaded};

/// Reads the scene in `path` and all that it refers to.
///
/// # Errors
///
/// Where the scene cannot be read, or a picture of it would be meaningless.
pub(crate) fn read(
    path: &Path,
    options: &LoadOptions,
    files: &Files,
    problems: &Problems,
) -> Result<Loaded, SceneError> {
    let document = document::read(path, options, files, problems)?;
    assemble::assemble(document, files)
}
