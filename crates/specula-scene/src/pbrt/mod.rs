//! Reader of pbrt-v4 scenes: tokens, parameters, directives and the attribute stack, then one file
//! for each kind of thing that a directive describes.

mod assemble;
mod camera;
mod colour;
mod context;
mod directive;
mod features;
mod geometry;
mod light;
mod material;
mod medium;
mod motion;
mod number_list;
mod param;
mod shape;
mod state;
mod texture;
mod token;
mod transform;
mod unknown;
mod v3;
mod world;

use std::path::Path;

pub(crate) use features::FEATURES;
pub(crate) use v3::FEATURES as V3_FEATURES;

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
    let mut reader = directive::Reader::new(path, options, files, problems);
    reader.read_main(path)?;
    assemble::assemble(reader)
}
