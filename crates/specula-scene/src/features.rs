//! The features of every format, and what a reader does with each.

pub use crate::feature::{Feature, Support};

/// Every format that is read, with its features.
pub const FORMATS: &[(&str, &[Feature])] = &[
    ("pbrt-v4", crate::pbrt::FEATURES),
    ("pbrt-v3", crate::pbrt::V3_FEATURES),
    ("Mitsuba 3", crate::mitsuba::FEATURES),
    ("glTF 2.0", crate::gltf::FEATURES),
];
