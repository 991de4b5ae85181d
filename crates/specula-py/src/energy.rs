//! The tables of the energy that single scattering loses, as arrays: the Mitsuba plugins look them up.

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use specula_bsdf::internal::raw_tables;
use specula_bsdf::ndf::Masking;

use crate::parameters::{self, Distribution};

/// The tables of one distribution and masking by name: coefficients of splines, flat.
///
/// Shapes and coordinates are those of `specula_bsdf::energy`'s `albedo` and `dielectric_albedo`.
#[pyfunction]
pub(crate) fn energy_tables<'py>(
    py: Python<'py>,
    distribution: &str,
    masking: &str,
) -> PyResult<Bound<'py, PyDict>> {
    let first = match Distribution::named(distribution)? {
        Distribution::Ggx => 0,
        Distribution::Beckmann => 2,
    };
    let second = match parameters::masking(masking)? {
        Masking::HeightCorrelated => 0,
        Masking::Separable => 1,
    };
    let tables = PyDict::new(py);
    for (name, values) in raw_tables::losses(first + second) {
        tables.set_item(name.to_lowercase(), PyArray1::from_vec(py, values))?;
    }
    Ok(tables)
}
