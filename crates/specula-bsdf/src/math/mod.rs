//! Scalars, vectors, colours, frames and warps: what every formula stands on.

mod arccosine;
mod exponential;
mod frame;
mod fused;
mod platform;
mod real;
mod rgb;
mod stream;
mod turns;
mod vec3;
pub mod warp;
#[cfg(feature = "glam")]
mod with_glam;
#[cfg(feature = "mint")]
mod with_mint;

pub(crate) use arccosine::acos;
pub use frame::Frame;
#[doc(hidden)]
pub use fused::Fused;
pub use real::Real;
pub use rgb::{Rgb, rgb};
pub use stream::Stream;
pub use vec3::{Vec3, vec3};
