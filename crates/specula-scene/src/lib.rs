//! Scenes that people have, read into one model with located errors.
#![forbid(unsafe_code)]

pub mod image;
pub mod scene;

pub use image::Image;
pub use scene::Scene;
