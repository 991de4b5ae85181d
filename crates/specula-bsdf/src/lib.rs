//! Microfacet mathematics whose pdfs can be trusted.
#![forbid(unsafe_code)]

pub mod bsdf;
pub mod math;

pub use bsdf::{Bsdf, BsdfSample, Event, Transport};
pub use math::{Frame, Real, Rgb, Vec3};
