//! The path tracer on the GPU.

pub mod adapter;
pub mod compute;
mod dead_branches;
mod error;
mod experimental;
mod path_kernels;
mod program;
mod queries;
mod sample_batch;
mod schedule;
mod stage;
mod tracer;

pub use adapter::{AdapterChoice, AdapterDescription, AdapterKind, Gpu, GpuError, adapters};
pub use compute::{Arrays, ComputeKernel};
pub use error::TracerError;
pub use queries::{Rays, Structures};
pub use schedule::{Schedule, UnknownSchedule};
pub use tracer::{Tracer, TracerOptions, missing};
