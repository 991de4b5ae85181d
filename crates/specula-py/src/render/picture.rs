//! Pictures: layers as arrays, files, comparisons.

use std::path::{Path, PathBuf};

use numpy::{PyArray1, PyArrayDyn, PyArrayMethods as _};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use specula::render::picture::{self, Display, Metadata, Picture, PictureError, ToneMap};
use specula_bsdf::math::Rgb;

use super::io_error;
use crate::arrays::Argument;
use crate::parameters::invalid;

/// A picture, with what its file says about it.
#[pyclass(frozen, module = "specula_render._native")]
pub(crate) struct PictureData {
    picture: Picture,
    metadata: Metadata,
}

fn picture_error(error: PictureError) -> PyErr {
    match error {
        PictureError::Io { path, source } => io_error(&path, &source),
        other => invalid(other),
    }
}

/// Reads an OpenEXR file by any program.
#[pyfunction]
pub(crate) fn read_exr(py: Python<'_>, path: PathBuf) -> PyResult<PictureData> {
    let picture = py
        .detach(|| picture::read_exr(&path))
        .map_err(picture_error)?;
    Ok(PictureData::new(picture, Metadata::default()))
}

impl PictureData {
    pub(super) fn new(picture: Picture, metadata: Metadata) -> Self {
        Self { picture, metadata }
    }

    fn array<'py>(
        &self,
        py: Python<'py>,
        values: Vec<f32>,
        channels: usize,
    ) -> PyResult<Option<Bound<'py, PyArrayDyn<f32>>>> {
        if values.is_empty() {
            return Ok(None);
        }
        let mut shape = vec![self.picture.height as usize, self.picture.width as usize];
        if channels > 1 {
            shape.push(channels);
        }
        PyArray1::from_vec(py, values).reshape(shape).map(Some)
    }
}

fn flat(layer: &[Rgb<f32>]) -> Vec<f32> {
    layer.iter().flat_map(|c| c.to_array()).collect()
}

#[pymethods]
impl PictureData {
    /// A picture of colours only, of an array of shape (h, w, 3).
    #[staticmethod]
    fn from_rgb(rgb: &Bound<'_, PyAny>) -> PyResult<Self> {
        let argument = Argument::new("rgb", rgb)?;
        let &[height, width, 3] = argument.shape() else {
            return Err(invalid(format!(
                "rgb: expected an array of shape (h, w, 3), got {:?}",
                argument.shape()
            )));
        };
        let size = |n: usize| match u32::try_from(n) {
            Ok(n @ 1..) => Ok(n),
            _ => Err(invalid(format!(
                "rgb: a picture of {width} x {height} pixels"
            ))),
        };
        let (columns, lines) = (size(width)?, size(height)?);
        let array = argument.numbers::<f32>()?;
        let (pixels, _) = array.as_slice()?.as_chunks::<3>();
        let colours = pixels.iter().map(|&p| Rgb::from(p)).collect();
        let picture = Picture::from_colour(columns, lines, colours);
        Ok(Self::new(picture, Metadata::default()))
    }

    /// Width and height.
    #[getter]
    fn size(&self) -> [u32; 2] {
        [self.picture.width, self.picture.height]
    }

    /// Column and row of the first pixel in the whole picture, and the size of that.
    #[getter]
    fn window(&self) -> ([u32; 2], [u32; 2]) {
        (self.picture.offset, self.picture.full_resolution)
    }

    /// A layer as a new array; `None` where it is not known.
    fn layer<'py>(
        &self,
        py: Python<'py>,
        name: &str,
    ) -> PyResult<Option<Bound<'py, PyArrayDyn<f32>>>> {
        let picture = &self.picture;
        let (values, channels) = match name {
            "rgb" => (flat(&picture.colour), 3),
            "albedo" => (flat(&picture.albedo), 3),
            "variance" => (flat(&picture.variance), 3),
            "normal" => {
                let all = picture.normal.iter().flat_map(|n| n.to_array());
                (all.collect(), 3)
            }
            "depth" => (picture.depth.clone(), 1),
            "sample_count" => (picture.sample_count.clone(), 1),
            _ => return Err(invalid(format!("no such layer: '{name}'"))),
        };
        self.array(py, values, channels)
    }

    /// Writes 8-bit sRGB; returns how many values were not finite.
    ///
    /// * `exposure`: in stops; `tone_map`: `clamp` or `filmic`.
    fn to_png(
        &self,
        py: Python<'_>,
        path: PathBuf,
        exposure: f32,
        tone_map: &str,
    ) -> PyResult<usize> {
        let tone_map = match tone_map {
            "clamp" => ToneMap::Clamp,
            "filmic" => ToneMap::Filmic,
            _ => {
                return Err(invalid(format!(
                    "no such tone map: '{tone_map}' (expected clamp or filmic)"
                )));
            }
        };
        if !exposure.is_finite() {
            return Err(invalid(format!("exposure: expected stops, got {exposure}")));
        }
        let display = Display {
            tone_map,
            exposure_stops: exposure,
        };
        py.detach(|| picture::write_png(&path, &self.picture, display))
            .map_err(picture_error)
    }

    /// Writes OpenEXR, all layers; returns how many values were not finite.
    fn to_exr(&self, py: Python<'_>, path: PathBuf) -> PyResult<usize> {
        let write = || picture::write_exr(Path::new(&path), &self.picture, &self.metadata);
        py.detach(write).map_err(picture_error)
    }

    /// Distances to a reference, by name, and the map of HDR-FLIP.
    fn compare<'py>(
        &self,
        py: Python<'py>,
        reference: &Self,
    ) -> PyResult<(Bound<'py, PyDict>, Bound<'py, PyArrayDyn<f32>>)> {
        let c = py
            .detach(|| picture::compare(&reference.picture, &self.picture))
            .map_err(picture_error)?;
        let metrics = PyDict::new(py);
        metrics.set_item("rmse", c.rmse)?;
        metrics.set_item("rel_mse", c.rel_mse)?;
        metrics.set_item("mae", c.mae)?;
        metrics.set_item("bias", c.bias)?;
        metrics.set_item("rel_bias", c.rel_bias)?;
        metrics.set_item("max_difference", c.max_difference)?;
        metrics.set_item("psnr_db", c.psnr_db)?;
        metrics.set_item("flip", c.flip)?;
        metrics.set_item("hdr_flip", c.hdr_flip)?;
        metrics.set_item("skipped", c.skipped)?;
        let size = [self.picture.height as usize, self.picture.width as usize];
        let map = PyArray1::from_vec(py, c.flip_map).reshape(size.to_vec())?;
        Ok((metrics, map))
    }
}
