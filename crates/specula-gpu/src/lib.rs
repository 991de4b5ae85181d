//! The path tracer on the GPU.

pub mod adapter;
pub mod compute;
mod experimental;
mod program;
mod queries;
mod schedule;
mod stage;
mod taker;
mod tracer;
mod wave;

pub use adapter::{AdapterChoice, AdapterDescription, AdapterKind, Gpu, GpuError, adapters};
pub use compute::{Arrays, Kernel};
pub use queries::{Rays, Structures};
pub use schedule::{Schedule, UnknownSchedule};
pub use tracer::{Tracer, TracerError, TracerOptions, missing};
