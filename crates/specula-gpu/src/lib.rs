//! The path tracer on the GPU.
#![forbid(unsafe_code)]

pub mod adapter;
pub mod compute;
mod program;
mod tracer;

pub use adapter::{AdapterChoice, AdapterDescription, AdapterKind, Gpu, GpuError, adapters};
pub use compute::{Arrays, Kernel};
pub use tracer::{Tracer, TracerError, missing};
