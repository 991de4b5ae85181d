//! Lobes over arrays.

mod compound;
mod hair;
mod kernels;
mod lobes;
mod measured;
mod samples;

pub(crate) use compound::{CoatedDiffuse, Gltf, Layered, Plastic, Principled};
pub(crate) use hair::Hair;
pub(crate) use lobes::{
    DiffuseTransmission, Eon, Lambert, MultibounceConductor, MultibounceDielectric, RoughConductor,
    RoughDielectric, SmoothConductor, SmoothDielectric, ThinDielectric,
};
pub(crate) use measured::MeasuredBrdf;
pub(crate) use samples::Samples;

use pyo3::PyClass;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyDict;
use specula_bsdf::Transport;
use specula_lobes::AnyLobe;

use crate::arrays::{
    Argument, Axis, Must, Output, Scalar, Source, Vectors, are_double, common_shape, finished,
    output,
};
use crate::parallel::{Outputs, run};
use crate::parameters;
use kernels::Kernels;

/// A BSDF in both precisions. The classes of lobes derive from it.
#[pyclass(subclass, frozen, module = "specula_render")]
pub(crate) struct Bsdf {
    single: AnyLobe<f32>,
    double: AnyLobe<f64>,
    repr: String,
}

impl Bsdf {
    /// * `repr`: as Python would make it again.
    fn new(single: impl Into<AnyLobe<f32>>, double: impl Into<AnyLobe<f64>>, repr: String) -> Self {
        Self {
            single: single.into(),
            double: double.into(),
            repr,
        }
    }

    /// As the base of an object of a derived class.
    fn derived<S: PyClass<BaseType = Self>>(self, class: S) -> PyClassInitializer<S> {
        PyClassInitializer::from(self).add_subclass(class)
    }

    fn double(&self) -> &dyn specula_bsdf::Bsdf<f64> {
        self.double.as_bsdf()
    }
}

/// What every call is told.
#[derive(Clone, Copy)]
struct Options {
    axis: Axis,
    transport: Transport,
    seed: u64,
    threads: usize,
}

impl Options {
    fn new(axis: isize, transport: &str, seed: u64, threads: usize) -> PyResult<Self> {
        Ok(Self {
            axis: Axis::numbered(axis)?,
            transport: parameters::transport(transport)?,
            seed,
            threads,
        })
    }
}

/// A pair of arguments, and the elements that they are over.
struct Pair<'py, T: Scalar> {
    vectors: [Vectors<'py, T>; 2],
    elements: Vec<usize>,
}

impl<'py, T: Scalar> Pair<'py, T> {
    fn new(a: &Argument<'py>, b: &Argument<'py>, axis: Axis) -> PyResult<Self> {
        let vectors = [a.vectors::<T>(axis)?, b.vectors::<T>(axis)?];
        let shapes = vectors.each_ref().map(|v| (v.name, &v.elements[..]));
        let elements = common_shape(&shapes)?;
        Ok(Self { vectors, elements })
    }

    /// * `second`: what must hold of the second argument; the first is a direction.
    fn sources(&self, second: Must) -> PyResult<[Source<'_, T>; 2]> {
        let [a, b] = &self.vectors;
        Ok([a.source(Must::Unit)?, b.source(second)?])
    }

    fn count(&self) -> usize {
        self.elements.iter().product()
    }
}

type AnyArray<'py> = Bound<'py, PyAny>;

fn eval<'py, T: Scalar>(
    py: Python<'py>,
    lobe: &AnyLobe<T>,
    [wo, wi]: [&Argument<'py>; 2],
    options: Options,
    out: Option<&AnyArray<'py>>,
) -> PyResult<AnyArray<'py>> {
    let pair = Pair::<T>::new(wo, wi, options.axis)?;
    let shape = options.axis.around(&pair.elements);
    let (array, mut written) = output::<T>(py, &shape, out)?;
    let outputs = Outputs {
        vectors: [
            Some(Output::new(written.as_slice_mut()?, options.axis)),
            None,
        ],
        ..Outputs::default()
    };
    let kernels = Kernels::new(lobe, options.transport, options.seed);
    let sources = pair.sources(Must::Unit)?;
    run(
        py,
        pair.count(),
        options.threads,
        &sources,
        outputs,
        |block| kernels.eval(block),
    )?;
    drop(written);
    Ok(array.into_any())
}

fn pdf<'py, T: Scalar>(
    py: Python<'py>,
    lobe: &AnyLobe<T>,
    [wo, wi]: [&Argument<'py>; 2],
    options: Options,
    out: Option<&AnyArray<'py>>,
) -> PyResult<AnyArray<'py>> {
    let pair = Pair::<T>::new(wo, wi, options.axis)?;
    let (array, mut written) = output::<T>(py, &pair.elements, out)?;
    let outputs = Outputs {
        numbers: Some(written.as_slice_mut()?),
        ..Outputs::default()
    };
    let kernels = Kernels::new(lobe, options.transport, options.seed);
    let sources = pair.sources(Must::Unit)?;
    run(
        py,
        pair.count(),
        options.threads,
        &sources,
        outputs,
        |block| kernels.pdf(block),
    )?;
    drop(written);
    finished(array)
}

fn eval_pdf<'py, T: Scalar>(
    py: Python<'py>,
    lobe: &AnyLobe<T>,
    [wo, wi]: [&Argument<'py>; 2],
    options: Options,
) -> PyResult<(AnyArray<'py>, AnyArray<'py>)> {
    let pair = Pair::<T>::new(wo, wi, options.axis)?;
    let shape = options.axis.around(&pair.elements);
    let (f_cos, mut f_written) = output::<T>(py, &shape, None)?;
    let (pdf, mut p_written) = output::<T>(py, &pair.elements, None)?;
    let outputs = Outputs {
        vectors: [
            Some(Output::new(f_written.as_slice_mut()?, options.axis)),
            None,
        ],
        numbers: Some(p_written.as_slice_mut()?),
        outcomes: None,
    };
    let kernels = Kernels::new(lobe, options.transport, options.seed);
    let sources = pair.sources(Must::Unit)?;
    run(
        py,
        pair.count(),
        options.threads,
        &sources,
        outputs,
        |block| kernels.eval_pdf(block),
    )?;
    drop((f_written, p_written));
    Ok((f_cos.into_any(), finished(pdf)?))
}

fn sample<'py, T: Scalar>(
    py: Python<'py>,
    lobe: &AnyLobe<T>,
    [wo, u]: [&Argument<'py>; 2],
    options: Options,
    out: Option<&Samples>,
) -> PyResult<Samples> {
    let pair = Pair::<T>::new(wo, u, options.axis)?;
    let shape = options.axis.around(&pair.elements);
    let given = out.map(|out| out.wi.bind(py));
    let (wi, mut wi_written) = output::<T>(py, &shape, given)?;
    let given = out.map(|out| out.weight.bind(py));
    let (weight, mut weight_written) = output::<T>(py, &shape, given)?;
    let given = out.map(|out| out.pdf.bind(py));
    let (pdf, mut pdf_written) = output::<T>(py, &pair.elements, given)?;
    let given = out.map(|out| out.outcome.bind(py));
    let (outcome, mut outcome_written) = output::<u8>(py, &pair.elements, given)?;
    let outputs = Outputs {
        vectors: [
            Some(Output::new(wi_written.as_slice_mut()?, options.axis)),
            Some(Output::new(weight_written.as_slice_mut()?, options.axis)),
        ],
        numbers: Some(pdf_written.as_slice_mut()?),
        outcomes: Some(outcome_written.as_slice_mut()?),
    };
    let kernels = Kernels::new(lobe, options.transport, options.seed);
    // The first number chooses between lobes: to read it for one that has no choice costs a tenth of all time.
    let numbers = if lobe.takes_two_numbers() {
        Must::RandomPair
    } else {
        Must::Random
    };
    let sources = pair.sources(numbers)?;
    run(
        py,
        pair.count(),
        options.threads,
        &sources,
        outputs,
        |block| kernels.sample(block),
    )?;
    drop((wi_written, weight_written, pdf_written, outcome_written));
    Ok(Samples::new(
        wi.into_any().unbind(),
        weight.into_any().unbind(),
        finished(pdf)?.unbind(),
        finished(outcome)?.unbind(),
    ))
}

/// Runs `$call` with the lobe of the arguments' precision.
macro_rules! in_precision {
    ($bsdf:expr, $arguments:expr, $lobe:ident => $call:expr) => {
        if are_double($arguments)? {
            let $lobe = &$bsdf.double;
            $call
        } else {
            let $lobe = &$bsdf.single;
            $call
        }
    };
}

#[pymethods]
impl Bsdf {
    /// Return ``f(wo, wi) |cos theta_i|``, in 1/sr, without Dirac deltas.
    ///
    /// Parameters
    /// ----------
    /// wo, wi : (..., 3) array
    ///     Directions to the viewer and to the light, unit, local: float32 or float64. A single
    ///     vector serves for all. What offers DLPack is taken, and lists.
    /// axis
    ///     -1 for vectors of shape ``(..., 3)``, 0 for ``(3, ...)``, which are not copied.
    /// transport
    ///     ``"radiance"``, where ``wo`` leads to the camera, or ``"importance"``.
    /// seed
    ///     Of lobes that are themselves estimates (`is_stochastic`): each element has its own
    ///     stream of random numbers.
    /// threads
    ///     Threads that share the work; 0 for all. The result does not depend on it.
    /// out
    ///     A C-contiguous array to fill, of the result's shape and type.
    ///
    /// Returns
    /// -------
    /// (..., 3) ndarray
    ///     Of the type of the arguments.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If shapes do not fit, or a vector is not unit; the message names the first.
    /// TypeError
    ///     If an array is neither of float32 nor of float64.
    #[pyo3(signature = (wo, wi, *, axis = -1, transport = "radiance", seed = 0, threads = 1, out = None))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn eval<'py>(
        &self,
        py: Python<'py>,
        wo: &Bound<'py, PyAny>,
        wi: &Bound<'py, PyAny>,
        axis: isize,
        transport: &str,
        seed: u64,
        threads: usize,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<AnyArray<'py>> {
        let options = Options::new(axis, transport, seed, threads)?;
        let (wo, wi) = (Argument::new("wo", wo)?, Argument::new("wi", wi)?);
        in_precision!(self, &[&wo, &wi], lobe => eval(py, lobe, [&wo, &wi], options, out))
    }

    /// Return the density with which `sample` samples ``wi``, in 1/sr, without Dirac deltas.
    ///
    /// Parameters
    /// ----------
    /// wo, wi : (..., 3) array
    ///     As for `eval`.
    /// axis
    ///     -1 for vectors of shape ``(..., 3)``, 0 for ``(3, ...)``, which are not copied.
    /// threads
    ///     Threads that share the work; 0 for all. The result does not depend on it.
    /// out
    ///     A C-contiguous array to fill.
    ///
    /// Returns
    /// -------
    /// (...) ndarray
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If shapes do not fit, or a vector is not unit; the message names the first.
    /// TypeError
    ///     If an array is neither of float32 nor of float64.
    #[pyo3(signature = (wo, wi, *, axis = -1, threads = 1, out = None))]
    fn pdf<'py>(
        &self,
        py: Python<'py>,
        wo: &Bound<'py, PyAny>,
        wi: &Bound<'py, PyAny>,
        axis: isize,
        threads: usize,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<AnyArray<'py>> {
        let options = Options::new(axis, "radiance", 0, threads)?;
        let (wo, wi) = (Argument::new("wo", wo)?, Argument::new("wi", wi)?);
        in_precision!(self, &[&wo, &wi], lobe => pdf(py, lobe, [&wo, &wi], options, out))
    }

    /// Return `eval` and `pdf` together, at little more than the price of one.
    ///
    /// Returns
    /// -------
    /// f_cos : (..., 3) ndarray
    /// pdf : (...) ndarray
    #[pyo3(signature = (wo, wi, *, axis = -1, transport = "radiance", seed = 0, threads = 1))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn eval_pdf<'py>(
        &self,
        py: Python<'py>,
        wo: &Bound<'py, PyAny>,
        wi: &Bound<'py, PyAny>,
        axis: isize,
        transport: &str,
        seed: u64,
        threads: usize,
    ) -> PyResult<(AnyArray<'py>, AnyArray<'py>)> {
        let options = Options::new(axis, transport, seed, threads)?;
        let (wo, wi) = (Argument::new("wo", wo)?, Argument::new("wi", wi)?);
        in_precision!(self, &[&wo, &wi], lobe => eval_pdf(py, lobe, [&wo, &wi], options))
    }

    /// Sample directions to the light.
    ///
    /// Parameters
    /// ----------
    /// wo : (..., 3) array
    ///     Directions to the viewer, unit, local.
    /// u : (..., 3) array, optional
    ///     Uniform random numbers in [0, 1): the first chooses among lobes, if there are several,
    ///     the others the direction. By default those of ``rng``, or of a generator with this seed.
    /// rng : numpy.random.Generator, optional
    /// axis
    ///     -1 for vectors of shape ``(..., 3)``, 0 for ``(3, ...)``, which are not copied.
    /// transport, seed
    ///     As for `eval`.
    /// threads
    ///     Threads that share the work; 0 for all. The result does not depend on it.
    /// out : Samples, optional
    ///     What an earlier call returned, over as many elements: its arrays are filled again, which
    ///     saves the time that the system takes to hand out memory.
    ///
    /// Returns
    /// -------
    /// Samples
    ///     ``wi`` (..., 3), ``weight = f |cos| / pdf`` (..., 3), ``pdf`` (...) in 1/sr or a probability
    ///     where specular, ``outcome`` (...): 0 rejected, 1 reflection, 2 transmission, 3 specular
    ///     reflection, 4 specular transmission. All but the outcome is zero where rejected.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If shapes do not fit, or a vector is not unit; the message names the first.
    /// TypeError
    ///     If an array is neither of float32 nor of float64.
    #[pyo3(signature = (
        wo, u = None, *, rng = None, axis = -1, transport = "radiance", seed = 0, threads = 1, out = None
    ))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn sample<'py>(
        &self,
        py: Python<'py>,
        wo: &Bound<'py, PyAny>,
        u: Option<&Bound<'py, PyAny>>,
        rng: Option<&Bound<'py, PyAny>>,
        axis: isize,
        transport: &str,
        seed: u64,
        threads: usize,
        out: Option<&Bound<'py, Samples>>,
    ) -> PyResult<Samples> {
        let options = Options::new(axis, transport, seed, threads)?;
        let wo = Argument::new("wo", wo)?;
        let u = match u {
            Some(u) => Argument::new("u", u)?,
            None => random_like(py, &wo, rng, seed)?,
        };
        in_precision!(self, &[&wo, &u], lobe => {
            sample(py, lobe, [&wo, &u], options, out.map(Bound::get))
        })
    }

    /// Whether values are estimates.
    #[getter]
    fn is_stochastic(&self) -> bool {
        self.double().is_stochastic()
    }

    /// Whether nothing but Dirac deltas is left.
    #[getter]
    fn is_specular(&self) -> bool {
        self.double().is_specular()
    }

    /// A representative colour; no integral.
    #[getter]
    fn colour(&self) -> (f64, f64, f64) {
        let colour = self.double().albedo();
        (colour.r, colour.g, colour.b)
    }

    fn __repr__(&self) -> &str {
        &self.repr
    }
}

/// Uniform random numbers for each direction, of the caller's generator or of one with this seed.
fn random_like<'py>(
    py: Python<'py>,
    wo: &Argument<'py>,
    rng: Option<&Bound<'py, PyAny>>,
    seed: u64,
) -> PyResult<Argument<'py>> {
    static DEFAULT_RNG: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
    let rng = match rng {
        Some(rng) => rng.clone(),
        None => {
            let make = DEFAULT_RNG.import(py, "numpy.random", "default_rng")?;
            make.call1((seed,))?
        }
    };
    let precision = if are_double(&[wo])? {
        "float64"
    } else {
        "float32"
    };
    let keywords = PyDict::new(py);
    keywords.set_item("dtype", precision)?;
    let u = rng.call_method("random", (wo.shape(),), Some(&keywords))?;
    Argument::new("u", &u)
}
