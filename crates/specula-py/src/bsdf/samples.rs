//! What `sample` returns.

use pyo3::prelude::*;
use pyo3::types::{PyIterator, PyTuple};

/// Sampled directions with their weights, densities and outcomes.
#[pyclass(frozen, get_all, module = "specula_render")]
pub(crate) struct Samples {
    /// Towards the light, unit; zero where rejected.
    pub(super) wi: Py<PyAny>,
    /// `f |cos| / pdf`; zero where rejected.
    pub(super) weight: Py<PyAny>,
    /// Per steradian, or a probability where specular; zero where rejected.
    pub(super) pdf: Py<PyAny>,
    /// 0 rejected, 1 reflection, 2 transmission, 3 specular reflection, 4 specular transmission.
    pub(super) outcome: Py<PyAny>,
}

impl Samples {
    pub(crate) fn new(
        wi: Py<PyAny>,
        weight: Py<PyAny>,
        pdf: Py<PyAny>,
        outcome: Py<PyAny>,
    ) -> Self {
        Self {
            wi,
            weight,
            pdf,
            outcome,
        }
    }
}

#[pymethods]
impl Samples {
    /// `wi, weight, pdf, outcome = samples`.
    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyIterator>> {
        let parts = [&self.wi, &self.weight, &self.pdf, &self.outcome];
        PyTuple::new(py, parts)?.try_iter()
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let shape = self.wi.bind(py).getattr("shape")?;
        Ok(format!("Samples(wi of shape {shape})"))
    }
}
