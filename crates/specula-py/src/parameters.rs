//! Colours, alphas and names out of Python's arguments.

use std::fmt::Display;
use std::str::FromStr;

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use specula_bsdf::math::{Real, Rgb, rgb};
use specula_bsdf::ndf::{Beckmann, Ggx, Masking};
use specula_bsdf::{Alpha, Transport};

/// A `ValueError`.
pub(crate) fn invalid(message: impl Display) -> PyErr {
    PyValueError::new_err(message.to_string())
}

/// A colour in linear sRGB: three numbers, or one for a grey.
#[derive(Clone, Copy, FromPyObject)]
pub(crate) enum Colour {
    #[pyo3(transparent, annotation = "float")]
    Grey(f64),
    #[pyo3(transparent, annotation = "three floats")]
    Rgb([f64; 3]),
}

impl Colour {
    pub(crate) const WHITE: Self = Self::Grey(1.0);

    /// The channels, which must be in a range.
    pub(crate) fn within(self, name: &str, [low, high]: [f64; 2]) -> PyResult<Rgb<f64>> {
        let [r, g, b] = match self {
            Self::Grey(grey) => [grey; 3],
            Self::Rgb(channels) => channels,
        };
        for channel in [r, g, b] {
            in_range(name, channel, [low, high])?;
        }
        Ok(rgb(r, g, b))
    }

    /// The channels, in `[0, 1]`.
    pub(crate) fn share(self, name: &str) -> PyResult<Rgb<f64>> {
        self.within(name, [0.0, 1.0])
    }
}

/// A number that must be in a range, ends included.
pub(crate) fn in_range(name: &str, value: f64, [low, high]: [f64; 2]) -> PyResult<f64> {
    if value >= low && value <= high {
        Ok(value)
    } else if high == f64::MAX {
        Err(invalid(format!(
            "{name}: expected {low} or more, got {value}"
        )))
    } else {
        Err(invalid(format!(
            "{name}: expected a number in [{low}, {high}], got {value}"
        )))
    }
}

/// One alpha, or those along x and y.
#[derive(Clone, Copy, FromPyObject)]
pub(crate) enum Alphas {
    #[pyo3(transparent, annotation = "float")]
    One(f64),
    #[pyo3(transparent, annotation = "two floats")]
    Two([f64; 2]),
}

impl Alphas {
    pub(crate) fn checked(self) -> PyResult<Alpha<f64>> {
        let [x, y] = match self {
            Self::One(alpha) => [alpha; 2],
            Self::Two(alphas) => alphas,
        };
        Alpha::new(x, y).map_err(invalid)
    }
}

/// A value by its name.
pub(crate) fn named<T: FromStr<Err: Display>>(name: &str) -> PyResult<T> {
    name.parse().map_err(invalid)
}

/// Alphas in a precision.
pub(crate) fn cast<T: Real>(alpha: Alpha<f64>) -> Alpha<T> {
    Alpha::clamped(T::of(alpha.x), T::of(alpha.y))
}

/// The name of a distribution of normals.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Distribution {
    Ggx,
    Beckmann,
}

impl Distribution {
    pub(crate) fn named(name: &str) -> PyResult<Self> {
        match name {
            "ggx" => Ok(Self::Ggx),
            "beckmann" => Ok(Self::Beckmann),
            _ => Err(invalid(format!(
                "no such distribution: '{name}' (expected ggx or beckmann)"
            ))),
        }
    }
}

/// GGX in a precision.
pub(crate) fn ggx<T: Real>(alpha: Alpha<f64>) -> Ggx<T> {
    Ggx::new(cast(alpha))
}

/// Beckmann in a precision.
pub(crate) fn beckmann<T: Real>(alpha: Alpha<f64>) -> Beckmann<T> {
    Beckmann::new(cast(alpha))
}

pub(crate) fn masking(name: &str) -> PyResult<Masking> {
    match name {
        "height-correlated" => Ok(Masking::HeightCorrelated),
        "separable" => Ok(Masking::Separable),
        _ => Err(invalid(format!(
            "no such masking: '{name}' (expected height-correlated or separable)"
        ))),
    }
}

pub(crate) fn transport(name: &str) -> PyResult<Transport> {
    match name {
        "radiance" => Ok(Transport::Radiance),
        "importance" => Ok(Transport::Importance),
        _ => Err(invalid(format!(
            "no such transport: '{name}' (expected radiance or importance)"
        ))),
    }
}
