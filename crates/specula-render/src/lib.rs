//! A deterministic path tracer on the CPU.

pub mod accel;
mod bump;
mod camera;
mod codes;
mod convert;
mod device;
mod film;
mod flat;
mod geometry;
mod integrator;
mod light;
mod material;
mod medium_stack;
mod memory;
mod offset;
mod options;
pub mod picture;
mod points;
mod prepared;
mod renderer;
mod sampler;
mod texture;
mod words;

pub use device::{Run, Wanted};
pub use film::{
    FilmBuffer, FilmFile, FilmFileError, Label, MOST_SAMPLES, MergeError, NoiseEstimate,
    NoiseOutlook, NoiseTrend, RunSums,
};
pub use flat::{FlatGroup, FlatInstance, FlatScene};
pub use material::MaterialShader;
pub use memory::MemoryEstimate;
pub use options::{RenderOptions, Strategy};
pub use points::{LitPoint, PointLighting, PrimitivePoint, SoftenedNormal, TexturePoint};
pub use prepared::{PrepareError, PreparedScene};
pub use renderer::{InvalidSample, PassReport, Renderer, ResumeError, ScatterCounts};
