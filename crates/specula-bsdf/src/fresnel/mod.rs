//! Fresnel reflectance, one file per model.

mod conductor;
mod dielectric;
mod f82;
mod schlick;
mod tinted;

pub use conductor::Conductor;
pub(crate) use dielectric::refraction;
pub use dielectric::{Refraction, dielectric, dielectric_average, refract};
pub use f82::F82Tint;
pub use schlick::Schlick;
pub use tinted::Tinted;
pub(crate) use tinted::Untinted;

use crate::math::{Real, Rgb};

/// Reflectance of an opaque microfacet by one of the models.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reflectance<T> {
    /// The same at every angle.
    Constant(Rgb<T>),
    /// Exact, for a complex index of refraction.
    Conductor(Conductor<T>),
    /// Schlick's approximation.
    Schlick(Schlick<T>),
    /// Schlick's approximation with a chosen colour at 82 degrees.
    F82Tint(F82Tint<T>),
    /// Another one times a colour.
    Tinted(Tinted<T>),
}

impl<T: Real> Reflectance<T> {
    /// Reflectance at the cosine between the direction and the facet's normal.
    ///
    /// * `cos`: in `[0, 1]`.
    #[inline(always)]
    pub fn eval(&self, cos: T) -> Rgb<T> {
        match self {
            Self::Constant(colour) => *colour,
            Self::Conductor(f) => f.eval(cos),
            Self::Schlick(f) => f.eval(cos),
            Self::F82Tint(f) => f.eval(cos),
            Self::Tinted(f) => f.eval(cos),
        }
    }
}
