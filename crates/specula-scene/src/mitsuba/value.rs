//! Values of properties.

use std::rc::Rc;

use glam::{DMat4, DVec3};

use super::element::Element;

/// A property's value.
#[derive(Clone, Debug)]
pub(super) enum Value {
    Number(f64),
    Integer(i64),
    Boolean(bool),
    Text(String),
    Vector(DVec3),
    /// Linear RGB.
    Colour([f64; 3]),
    Spectrum(Samples),
    Transform(DMat4),
    Element(Rc<Element>),
    /// The id of an element that may stand anywhere in the document.
    Reference(String),
}

/// A spectrum as a file gives it.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Samples {
    /// The same at every wavelength.
    Uniform(f64),
    /// `(nm, value)`, wavelengths strictly increasing.
    List(Vec<(f64, f64)>),
    /// A black body's temperature in kelvin, and a factor.
    BlackBody(f64, f64),
}

impl Value {
    /// The tag that gives such a value, for messages.
    pub(super) fn kind(&self) -> &'static str {
        match self {
            Self::Number(_) => "float",
            Self::Integer(_) => "integer",
            Self::Boolean(_) => "boolean",
            Self::Text(_) => "string",
            Self::Vector(_) => "vector",
            Self::Colour(_) => "rgb",
            Self::Spectrum(_) => "spectrum",
            Self::Transform(_) => "transform",
            Self::Element(_) => "plugin",
            Self::Reference(_) => "ref",
        }
    }
}
