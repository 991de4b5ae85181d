//! Fresnel terms over arrays, and measured metals.

use std::fmt;

use numpy::{PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use specula_bsdf::fresnel::{self, Conductor, F82Tint, Schlick};
use specula_bsdf::math::{Real, Rgb};
use specula_bsdf::metals::{METALS, by_symbol};

use crate::arrays::{Argument, Scalar, are_double, finished};
use crate::parameters::{Colour, invalid};

/// What is known of a reflectance, in double precision.
#[derive(Clone, Copy)]
enum Model {
    Constant(Rgb<f64>),
    Conductor(Rgb<f64>, Rgb<f64>),
    Schlick(Rgb<f64>),
    F82Tint(Rgb<f64>, Rgb<f64>),
}

/// Reflectance of an opaque microfacet: a Fresnel term.
#[pyclass(frozen, from_py_object, module = "specula_render")]
#[derive(Clone, Copy)]
pub(crate) struct Reflectance {
    model: Model,
    tint: Rgb<f64>,
}

const ANY: [f64; 2] = [0.0, f64::MAX];

impl Reflectance {
    fn of(model: Model) -> Self {
        Self {
            model,
            tint: Rgb::WHITE,
        }
    }

    /// In a precision.
    pub(crate) fn cast<T: Real>(&self) -> fresnel::Reflectance<T> {
        let untinted = match self.model {
            Model::Constant(colour) => fresnel::Reflectance::Constant(colour.cast()),
            Model::Conductor(eta, k) => fresnel::Reflectance::Conductor(Conductor {
                eta: eta.cast(),
                k: k.cast(),
            }),
            Model::Schlick(f0) => fresnel::Reflectance::Schlick(Schlick { f0: f0.cast() }),
            Model::F82Tint(f0, tint) => {
                fresnel::Reflectance::F82Tint(F82Tint::new(f0.cast(), tint.cast()))
            }
        };
        untinted.tinted(self.tint.cast())
    }
}

#[pymethods]
impl Reflectance {
    /// The same at every angle.
    #[staticmethod]
    fn constant(colour: Colour) -> PyResult<Self> {
        Ok(Self::of(Model::Constant(colour.share("colour")?)))
    }

    /// Exact, for a complex index of refraction.
    #[staticmethod]
    fn conductor(eta: Colour, k: Colour) -> PyResult<Self> {
        let (eta, k) = (eta.within("eta", ANY)?, k.within("k", ANY)?);
        Ok(Self::of(Model::Conductor(eta, k)))
    }

    /// A measured metal, by its chemical symbol.
    #[staticmethod]
    fn metal(symbol: &str) -> PyResult<Self> {
        let Some(metal) = by_symbol(symbol) else {
            let known: Vec<_> = METALS.iter().map(|m| m.symbol).collect();
            return Err(invalid(format!(
                "no such metal: '{symbol}' (expected one of {})",
                known.join(", ")
            )));
        };
        Ok(Self::of(Model::Conductor(metal.eta.into(), metal.k.into())))
    }

    /// Schlick's approximation.
    #[staticmethod]
    fn schlick(f0: Colour) -> PyResult<Self> {
        Ok(Self::of(Model::Schlick(f0.share("f0")?)))
    }

    /// Schlick's approximation with a chosen colour at 82 degrees.
    #[staticmethod]
    fn f82_tint(f0: Colour, tint: Colour) -> PyResult<Self> {
        let (f0, tint) = (f0.share("f0")?, tint.share("tint")?);
        Ok(Self::of(Model::F82Tint(f0, tint)))
    }

    /// The same times a colour.
    fn tinted(&self, tint: Colour) -> PyResult<Self> {
        let tint = tint.share("tint")? * self.tint;
        Ok(Self { tint, ..*self })
    }

    /// Reflectance at cosines between the direction and the facet's normal.
    fn eval<'py>(&self, py: Python<'py>, cos: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let cos = Argument::new("cos", cos)?;
        if are_double(&[&cos])? {
            colours::<f64>(py, &cos, &self.cast())
        } else {
            colours::<f32>(py, &cos, &self.cast())
        }
    }

    fn __repr__(&self) -> String {
        self.to_string()
    }
}

impl fmt::Display for Reflectance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let of = |c: Rgb<f64>| format!("({}, {}, {})", c.r, c.g, c.b);
        let model = match self.model {
            Model::Constant(colour) => format!("Reflectance.constant({})", of(colour)),
            Model::Conductor(eta, k) => {
                format!("Reflectance.conductor({}, {})", of(eta), of(k))
            }
            Model::Schlick(f0) => format!("Reflectance.schlick({})", of(f0)),
            Model::F82Tint(f0, tint) => {
                format!("Reflectance.f82_tint({}, {})", of(f0), of(tint))
            }
        };
        match self.tint == Rgb::WHITE {
            true => f.write_str(&model),
            false => write!(f, "{model}.tinted({})", of(self.tint)),
        }
    }
}

/// A reflectance as lobes take it: made here, a metal's symbol, or a colour for all angles.
#[derive(FromPyObject)]
pub(crate) enum AnyReflectance {
    #[pyo3(transparent, annotation = "Reflectance")]
    Made(Reflectance),
    #[pyo3(transparent, annotation = "the symbol of a metal")]
    Metal(String),
    #[pyo3(transparent, annotation = "a colour")]
    Constant(Colour),
}

impl AnyReflectance {
    pub(crate) fn resolved(self) -> PyResult<Reflectance> {
        match self {
            Self::Made(reflectance) => Ok(reflectance),
            Self::Metal(symbol) => Reflectance::metal(&symbol),
            Self::Constant(colour) => Reflectance::constant(colour),
        }
    }
}

/// Cosines, each in `[-1, 1]`.
fn cosines<'py, T: Scalar>(cos: &Argument<'py>, low: f64) -> PyResult<PyReadonlyArrayDyn<'py, T>> {
    let cosines = cos.numbers::<T>()?;
    let all = cosines.as_slice()?;
    let holds = |c: &T| *c >= T::of(low) && *c <= T::ONE;
    match all.iter().position(|c| !holds(c)) {
        None => Ok(cosines),
        Some(i) => Err(invalid(format!(
            "cos[{i}]: expected a cosine in [{low}, 1], got {}",
            all[i].to_f64()
        ))),
    }
}

fn colours<'py, T: Scalar>(
    py: Python<'py>,
    cos: &Argument<'py>,
    reflectance: &fresnel::Reflectance<T>,
) -> PyResult<Bound<'py, PyAny>> {
    let cosines = cosines::<T>(cos, 0.0)?;
    let shape: Vec<usize> = cos.shape().iter().copied().chain([3]).collect();
    let array = PyArrayDyn::<T>::zeros(py, shape, false);
    let mut written = array.try_readwrite()?;
    let (rows, _) = written.as_slice_mut()?.as_chunks_mut::<3>();
    for (row, &cos) in rows.iter_mut().zip(cosines.as_slice()?) {
        let colour = reflectance.eval(cos);
        *row = [colour.r, colour.g, colour.b];
    }
    drop(written);
    finished(array)
}

/// Reflectance of a smooth dielectric for unpolarised light.
#[pyfunction]
pub(crate) fn dielectric<'py>(
    py: Python<'py>,
    cos: &Bound<'py, PyAny>,
    eta: f64,
) -> PyResult<Bound<'py, PyAny>> {
    fn over<'py, T: Scalar>(
        py: Python<'py>,
        cos: &Argument<'py>,
        eta: f64,
    ) -> PyResult<Bound<'py, PyAny>> {
        let cosines = cosines::<T>(cos, -1.0)?;
        let array = PyArrayDyn::<T>::zeros(py, cos.shape(), false);
        let mut written = array.try_readwrite()?;
        for (to, &cos) in written.as_slice_mut()?.iter_mut().zip(cosines.as_slice()?) {
            // From inside, the same interface with the index inverted.
            let eta = T::of(if cos < T::ZERO { 1.0 / eta } else { eta });
            *to = fresnel::dielectric(cos.abs(), eta).reflectance;
        }
        drop(written);
        finished(array)
    }
    let eta = crate::parameters::in_range("eta", eta, [1e-3, 1e3])?;
    let cos = Argument::new("cos", cos)?;
    if are_double(&[&cos])? {
        over::<f64>(py, &cos, eta)
    } else {
        over::<f32>(py, &cos, eta)
    }
}

/// The measured metals: by symbol, name, index, and where it was measured.
#[pyfunction]
pub(crate) fn metals(py: Python<'_>) -> PyResult<Bound<'_, PyList>> {
    let list = PyList::empty(py);
    for metal in METALS {
        let entry = PyDict::new(py);
        entry.set_item("symbol", metal.symbol)?;
        entry.set_item("name", metal.name)?;
        entry.set_item("eta", metal.eta)?;
        entry.set_item("k", metal.k)?;
        entry.set_item("f0", metal.f0())?;
        entry.set_item("source", metal.source)?;
        list.append(entry)?;
    }
    Ok(list)
}
