//! The path tracer on the GPU.

pub mod adapter;
mod cast;
pub mod compute;
mod dead_branches;
mod error;
mod experimental;
mod path_kernels;
mod program;
mod queries;
mod sample_batch;
mod schedule;
mod shader;
mod stage;
mod tracer;
mod tree;

#[cfg(test)]
extern crate self as specula_gpu;
#[cfg(test)]
#[path = "../tests/common/mod.rs"]
mod common;

pub use adapter::{AdapterChoice, AdapterDescription, AdapterKind, Gpu, GpuError, adapters};
pub use cast::{RayBatch, RayCaster, RayHit, RayWords};
pub use compute::{Arrays, ComputeKernel};
pub use error::TracerError;
pub use queries::{Rays, Structures};
pub use schedule::{Schedule, UnknownSchedule};
pub use shader::Shader;
pub use tracer::{Tracer, TracerOptions, missing};
pub use tree::Tree;
