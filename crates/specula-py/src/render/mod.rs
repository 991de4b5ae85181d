//! Scenes, renders and pictures.

mod geometry;
mod job;
mod material;
mod microfacets;
mod paint;
mod picture;
mod scene;

pub(crate) use job::RenderJob;
pub(crate) use material::Material;
pub(crate) use picture::{PictureData, read_exr};
pub(crate) use scene::{SceneData, builtin, load};

use std::io;
use std::path::Path;

use pyo3::prelude::*;

use crate::arrays::Argument;
use crate::parameters::invalid;

/// An `OSError` of the kind that the system told, with the file's name.
fn io_error(path: &Path, source: &io::Error) -> PyErr {
    let message = format!("{}: {source}", path.display());
    io::Error::new(source.kind(), message).into()
}

/// Rows of `N` finite numbers; the message names the first row that is not.
///
/// * `row`: what a row is, in words.
fn rows<const N: usize>(name: &'static str, given: &Bound<'_, PyAny>) -> PyResult<Vec<[f32; N]>> {
    let argument = Argument::new(name, given)?;
    if !matches!(argument.shape(), [_, n] if *n == N) {
        return Err(invalid(format!(
            "{name}: expected an array of shape (n, {N}), got {:?}",
            argument.shape()
        )));
    }
    let array = argument.numbers::<f32>()?;
    let (rows, _) = array.as_slice()?.as_chunks::<N>();
    match rows.iter().position(|r| r.iter().any(|x| !x.is_finite())) {
        None => Ok(rows.to_vec()),
        Some(i) => Err(invalid(format!(
            "{name}[{i}]: expected finite numbers, got {:?}",
            rows[i]
        ))),
    }
}
