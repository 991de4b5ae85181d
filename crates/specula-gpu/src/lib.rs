//! The path tracer on the GPU.
//!
//! Without the feature `device`, which is on by default, there is [`SceneProgram`] alone, and no wgpu: text and arrays
//! for programs with a device of their own, such as pages.

#[cfg(feature = "device")]
pub mod adapter;
#[cfg(feature = "device")]
mod cast;
#[cfg(feature = "device")]
pub mod compute;
#[cfg(feature = "device")]
mod dead_branches;
#[cfg(feature = "device")]
mod error;
#[cfg(feature = "device")]
mod experimental;
#[cfg(feature = "device")]
mod path_kernels;
mod program;
#[cfg(feature = "device")]
mod queries;
#[cfg(feature = "device")]
mod sample_batch;
mod scene_program;
#[cfg(feature = "device")]
mod schedule;
#[cfg(feature = "device")]
mod several;
#[cfg(feature = "device")]
mod shader;
#[cfg(feature = "device")]
mod stage;
#[cfg(feature = "device")]
mod tracer;
mod tree;

#[cfg(all(test, feature = "device"))]
extern crate self as specula_gpu;
#[cfg(all(test, feature = "device"))]
#[path = "../tests/common/mod.rs"]
mod common;

#[cfg(feature = "device")]
pub use adapter::{AdapterChoice, AdapterDescription, AdapterKind, Gpu, GpuError, adapters};
#[cfg(feature = "device")]
pub use cast::{RayBatch, RayCaster, RayHit, RayWords};
#[cfg(feature = "device")]
pub use compute::{Arrays, ComputeKernel};
#[cfg(feature = "device")]
pub use error::TracerError;
#[cfg(feature = "device")]
pub use queries::{Rays, Structures};
pub use scene_program::{MissingFeatures, SceneProgram, missing};
#[cfg(feature = "device")]
pub use schedule::{Schedule, UnknownSchedule};
#[cfg(feature = "device")]
pub use several::{LostGpu, Tracers};
#[cfg(feature = "device")]
pub use shader::Shader;
#[cfg(feature = "device")]
pub use tracer::{Tracer, TracerOptions};
pub use tree::Tree;
