//! The class of measured materials.

use std::path::{Path, PathBuf};

use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;
use specula::scene::measured;
use specula_bsdf::measured::Measured;

use super::Bsdf;
use super::lobes::repr;
use crate::parameters::invalid;

/// A measured material: reflection that was measured by a gonioreflectometer, with its own sampling.
///
/// Source: Dupuy and Jakob 2018, "An Adaptive Parameterization for Efficient Material Acquisition and
/// Rendering". It is black where ``wo`` or ``wi`` are below the horizon.
///
/// Parameters
/// ----------
/// file : path
///     A ``.bsdf`` file of the RGL database, in RGB or spectral, isotropic or anisotropic, or a
///     ``.binary`` file of the MERL database.
///
/// Raises
/// ------
/// OSError
///     If the file cannot be read.
/// ValueError
///     If it is no such file; the message has its name.
#[pyclass(extends = Bsdf, frozen, module = "specula_render")]
pub(crate) struct MeasuredBrdf {
    /// Whether it looks the same however it is turned about its normal.
    #[pyo3(get)]
    is_isotropic: bool,
}

#[pymethods]
impl MeasuredBrdf {
    #[new]
    fn new(py: Python<'_>, file: PathBuf) -> PyResult<PyClassInitializer<Self>> {
        let name = file.display().to_string();
        let is_there = std::fs::metadata(&file);
        is_there
            .map_err(|e| PyOSError::new_err((e.raw_os_error(), e.to_string(), name.clone())))?;
        let (single, double) = py
            .detach(|| both(&file))
            .map_err(|message| invalid(format!("{name}: {message}")))?;
        let is_isotropic = double.is_isotropic();
        let bsdf = Bsdf::new(single, double, repr("MeasuredBrdf", &[format!("{name:?}")]));
        Ok(bsdf.derived(Self { is_isotropic }))
    }
}

/// The material of a file in both precisions, or what is wrong with it.
fn both(file: &Path) -> Result<(Measured<f32>, Measured<f64>), String> {
    let tables = measured::read_tables(file).map_err(|e| e.to_string())?;
    let single = Measured::new(&tables).map_err(|e| e.to_string())?;
    let double = Measured::new(&tables).map_err(|e| e.to_string())?;
    Ok((single, double))
}
