//! What the header declares: types, constants and functions, one file per subject.
//!
//! The functions are `unsafe` to call: pointers must be what their documentation says. Their bodies are not; they turn
//! pointers into values by `pointers`.
#![allow(
    unsafe_code,
    reason = "exported names, and functions that only their callers can call safely"
)]
#![allow(
    clippy::missing_safety_doc,
    reason = "the documentation of each function says what its pointers point to, for C"
)]

mod batch;
mod lobe;
mod picture;
mod render;
mod scene;
mod status;

pub use crate::failure::Status;
pub use crate::lobe::LobeHandle;
pub use crate::options::*;
pub use crate::picture::{
    PictureHandle, SPECULA_LAYER_ALBEDO, SPECULA_LAYER_COLOUR, SPECULA_LAYER_DEPTH,
    SPECULA_LAYER_NORMAL, SPECULA_LAYER_SAMPLE_COUNT, SPECULA_LAYER_VARIANCE,
};
pub use crate::scene::SceneHandle;
pub use batch::*;
pub use lobe::*;
pub use picture::*;
pub use render::*;
pub use scene::*;
pub use status::*;
