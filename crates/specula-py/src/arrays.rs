//! Arrays of Python as slices: `float32` or `float64`, vectors along the last axis or along the first.

use numpy::{
    Element, PyArrayDescrMethods, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn,
    PyReadwriteArrayDyn, PyUntypedArray, PyUntypedArrayMethods, dtype,
};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyTuple;
use specula_lobes::Precision;

use crate::parameters::invalid;

/// `float32` or `float64`.
pub(crate) trait Scalar: Precision + Element {
    /// NumPy's name.
    const NAME: &'static str;
}

impl Scalar for f32 {
    const NAME: &'static str = "float32";
}

impl Scalar for f64 {
    const NAME: &'static str = "float64";
}

/// Where an array has its vectors' components.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Axis {
    /// `(..., 3)`.
    Last,
    /// `(3, ...)`.
    First,
}

impl Axis {
    pub(crate) fn numbered(axis: isize) -> PyResult<Self> {
        match axis {
            -1 => Ok(Self::Last),
            0 => Ok(Self::First),
            _ => Err(invalid(format!(
                "axis: expected -1 for vectors in the last axis or 0 for the first, got {axis}"
            ))),
        }
    }

    fn shape(self) -> &'static str {
        match self {
            Self::Last => "(3,) or (..., 3)",
            Self::First => "(3,) or (3, ...)",
        }
    }

    /// The shape of vectors over elements of this shape.
    pub(crate) fn around(self, elements: &[usize]) -> Vec<usize> {
        match self {
            Self::Last => elements.iter().copied().chain([3]).collect(),
            Self::First => [3].into_iter().chain(elements.iter().copied()).collect(),
        }
    }
}

/// An argument as an array, and whether it came as one: a list takes the type of the others.
pub(crate) struct Argument<'py> {
    name: &'static str,
    array: Bound<'py, PyUntypedArray>,
    is_array: bool,
}

/// NumPy's function of this name.
fn numpy_function<'py>(
    py: Python<'py>,
    cell: &'static PyOnceLock<Py<PyAny>>,
    name: &str,
) -> PyResult<&'py Bound<'py, PyAny>> {
    cell.import(py, "numpy", name)
}

impl<'py> Argument<'py> {
    /// An array of NumPy, what offers DLPack, or a sequence of numbers.
    pub(crate) fn new(name: &'static str, given: &Bound<'py, PyAny>) -> PyResult<Self> {
        static FROM_DLPACK: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
        static ASARRAY: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
        let py = given.py();
        if let Ok(array) = given.cast::<PyUntypedArray>() {
            let array = array.clone();
            let is_array = true;
            return Ok(Self {
                name,
                array,
                is_array,
            });
        }
        let (array, is_array) = if given.hasattr("__dlpack__")? {
            let convert = numpy_function(py, &FROM_DLPACK, "from_dlpack")?;
            (convert.call1((given,))?, true)
        } else {
            let convert = numpy_function(py, &ASARRAY, "asarray")?;
            (convert.call1((given, "float64"))?, false)
        };
        let array = array.cast_into::<PyUntypedArray>()?;
        Ok(Self {
            name,
            array,
            is_array,
        })
    }

    /// Whether it asks for `float64`; an error where it is of another type than the two.
    fn is_double(&self) -> PyResult<bool> {
        let py = self.array.py();
        let found = self.array.dtype();
        if !self.is_array || found.is_equiv_to(&dtype::<f32>(py)) {
            Ok(false)
        } else if found.is_equiv_to(&dtype::<f64>(py)) {
            Ok(true)
        } else {
            let name = self.name;
            Err(PyTypeError::new_err(format!(
                "{name}: expected an array of float32 or float64, got {found}"
            )))
        }
    }

    /// In a precision and contiguous: the very same array where it is so.
    fn contiguous<T: Scalar>(&self) -> PyResult<PyReadonlyArrayDyn<'py, T>> {
        static ASCONTIGUOUS: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
        let array = match self.array.cast::<PyArrayDyn<T>>() {
            Ok(array) if array.is_c_contiguous() => array.clone(),
            _ => {
                let py = self.array.py();
                let convert = numpy_function(py, &ASCONTIGUOUS, "ascontiguousarray")?;
                // It makes a vector of a scalar, which keeps its meaning here.
                let array = convert.call1((&self.array, T::NAME))?;
                array.cast_into::<PyArrayDyn<T>>()?
            }
        };
        Ok(array.try_readonly()?)
    }

    /// As vectors in a precision.
    pub(crate) fn vectors<T: Scalar>(&self, axis: Axis) -> PyResult<Vectors<'py, T>> {
        let shape = self.array.shape();
        let elements = match (axis, shape) {
            (Axis::Last, [elements @ .., 3]) | (Axis::First, [3, elements @ ..]) => elements,
            _ => {
                return Err(invalid(format!(
                    "{}: expected vectors of shape {}, got {shape:?}",
                    self.name,
                    axis.shape()
                )));
            }
        };
        Ok(Vectors {
            name: self.name,
            elements: elements.to_vec(),
            array: self.contiguous()?,
            axis,
        })
    }

    /// As numbers in a precision.
    pub(crate) fn numbers<T: Scalar>(&self) -> PyResult<PyReadonlyArrayDyn<'py, T>> {
        self.contiguous()
    }

    pub(crate) fn py(&self) -> Python<'py> {
        self.array.py()
    }

    /// The shape it came with.
    pub(crate) fn shape(&self) -> &[usize] {
        self.array.shape()
    }
}

/// Whether any of the arguments asks for `float64`, or all of them are mere lists.
pub(crate) fn are_double(arguments: &[&Argument<'_>]) -> PyResult<bool> {
    let mut is_double = arguments.iter().all(|a| !a.is_array);
    for argument in arguments {
        is_double |= argument.is_double()?;
    }
    Ok(is_double)
}

/// Vectors of Python.
pub(crate) struct Vectors<'py, T: Element> {
    pub(crate) name: &'static str,
    /// The shape without the vectors' axis; empty for a single vector.
    pub(crate) elements: Vec<usize>,
    array: PyReadonlyArrayDyn<'py, T>,
    axis: Axis,
}

impl<T: Scalar> Vectors<'_, T> {
    /// As what a loop reads.
    pub(crate) fn source(&self, must: Must) -> PyResult<Source<'_, T>> {
        Ok(Source {
            name: self.name,
            vectors: self.input()?,
            must,
        })
    }

    fn input(&self) -> PyResult<Input<'_, T>> {
        let all = self.array.as_slice()?;
        let n = all.len() / 3;
        Ok(match self.axis {
            _ if self.elements.is_empty() => Input::One([all[0], all[1], all[2]]),
            Axis::Last => Input::Rows(all),
            Axis::First => {
                let (x, rest) = all.split_at(n);
                let (y, z) = rest.split_at(n);
                Input::Columns([x, y, z])
            }
        })
    }
}

/// The shape of the elements of a call: that of every argument which is no single vector.
pub(crate) fn common_shape(shapes: &[(&'static str, &[usize])]) -> PyResult<Vec<usize>> {
    let mut common: Option<(&'static str, &[usize])> = None;
    for &(name, shape) in shapes {
        match common {
            _ if shape.is_empty() => {}
            None => common = Some((name, shape)),
            Some((first, expected)) if expected != shape => {
                return Err(invalid(format!(
                    "{first} is over elements of shape {expected:?}, {name} over {shape:?}: \
                     expected the same, or a single vector"
                )));
            }
            Some(_) => {}
        }
    }
    Ok(common.map_or_else(Vec::new, |(_, shape)| shape.to_vec()))
}

/// What a vector of the input must be.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Must {
    /// Length 1, within what `float32` leaves of a normalisation.
    Unit,
    /// Components in `[0, 1)`.
    Random,
    /// The last two components in `[0, 1)`; nothing reads the first.
    RandomPair,
}

/// Vectors to read, by the name that the caller knows them by.
pub(crate) struct Source<'a, T> {
    pub(crate) name: &'static str,
    pub(crate) vectors: Input<'a, T>,
    pub(crate) must: Must,
}

/// Vectors to read.
#[derive(Clone, Copy)]
pub(crate) enum Input<'a, T> {
    /// The same for all elements.
    One([T; 3]),
    /// `(n, 3)`.
    Rows(&'a [T]),
    /// `(3, n)`.
    Columns([&'a [T]; 3]),
}

/// Vectors to write.
pub(crate) enum Output<'a, T> {
    /// `(n, 3)`.
    Rows(&'a mut [T]),
    /// `(3, n)`.
    Columns([&'a mut [T]; 3]),
}

impl<'a, T> Output<'a, T> {
    pub(crate) fn new(all: &'a mut [T], axis: Axis) -> Self {
        match axis {
            Axis::Last => Self::Rows(all),
            Axis::First => {
                let n = all.len() / 3;
                let (x, rest) = all.split_at_mut(n);
                let (y, z) = rest.split_at_mut(n);
                Self::Columns([x, y, z])
            }
        }
    }

    /// The first `n` vectors, and the rest.
    pub(crate) fn split(self, n: usize) -> [Self; 2] {
        match self {
            Self::Rows(all) => {
                let (a, b) = all.split_at_mut(3 * n);
                [Self::Rows(a), Self::Rows(b)]
            }
            Self::Columns([x, y, z]) => {
                let (x, x_rest) = x.split_at_mut(n);
                let (y, y_rest) = y.split_at_mut(n);
                let (z, z_rest) = z.split_at_mut(n);
                [
                    Self::Columns([x, y, z]),
                    Self::Columns([x_rest, y_rest, z_rest]),
                ]
            }
        }
    }
}

/// A new array of zeros, or the one that the caller wants filled.
pub(crate) fn output<'py, T: Element>(
    py: Python<'py>,
    shape: &[usize],
    given: Option<&Bound<'py, PyAny>>,
) -> PyResult<(Bound<'py, PyArrayDyn<T>>, PyReadwriteArrayDyn<'py, T>)> {
    let array = match given {
        None => PyArrayDyn::<T>::zeros(py, shape, false),
        Some(out) => {
            let wrong = || {
                let wanted = dtype::<T>(py);
                invalid(format!(
                    "out: expected a C-contiguous array of {wanted} of shape {shape:?}"
                ))
            };
            let array = out.cast::<PyArrayDyn<T>>().map_err(|_| wrong())?;
            if array.shape() != shape || !array.is_c_contiguous() {
                return Err(wrong());
            }
            array.clone()
        }
    };
    let write = array.try_readwrite()?;
    Ok((array, write))
}

/// An array as Python gets it: one element of no shape as a number.
pub(crate) fn finished<'py, T: Element>(
    array: Bound<'py, PyArrayDyn<T>>,
) -> PyResult<Bound<'py, PyAny>> {
    let py = array.py();
    match array.ndim() {
        0 => array.as_any().get_item(PyTuple::empty(py)),
        _ => Ok(array.into_any()),
    }
}
