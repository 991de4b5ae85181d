//! A deterministic path tracer on the CPU.

pub mod accel;
mod bump;
mod camera;
mod codes;
mod convert;
mod device;
mod disk;
mod film;
mod flat;
mod geometry;
mod goal;
mod huge_pages;
mod integrator;
mod layout;
mod light;
mod machine_memory;
mod material;
mod medium_stack;
mod memory;
mod movement;
mod offset;
mod options;
pub mod picture;
mod places;
mod points;
mod prepared;
mod ray_cone;
mod renderer;
mod sampler;
mod simd;
mod slopes;
mod soa;
mod texture;
mod words;

/// Constants of the path estimator, from which shaders are made.
#[doc(hidden)]
pub mod estimator {
    pub use crate::integrator::estimator::{
        HASH_CANDIDATE, INDIRECT_FROM, MOST_PASSES, ROULETTE_BELOW, ROULETTE_FROM, ROULETTE_LEAST,
        ROULETTE_SCALE, SHADOW_RAY_END, STREAM_SCATTER, stream_of_candidate,
    };
    pub use crate::light::{FINER, LEAST_SHARE};
    pub use crate::medium_stack::MOST_MEDIA;
    pub use crate::offset::RELATIVE_ERROR;
}

pub use camera::screen_window;
pub use device::{Most, Run, SampleDevice, Wanted};
pub use film::{
    FilmBuffer, FilmFile, FilmFileError, FilmHead, Label, MOST_SAMPLES, MergeError, NoiseEstimate,
    NoiseOutlook, NoiseTrend, RunSums, ScatterCounts, VertexCounts,
};
pub use flat::{FlatGroup, FlatInstance, FlatScene};
pub use goal::RenderGoal;
pub use machine_memory::available_memory;
pub use material::MaterialShader;
pub use memory::MemoryEstimate;
pub use options::{RenderOptions, Strategy, TextureFilter};
pub use points::{
    FilteredNormal, LitPoint, PointLighting, PrimitivePoint, SeenSurface, SoftenedNormal,
    TextureFootprint, TexturePoint,
};
pub use prepared::{PrepareError, PreparedScene};
pub use renderer::{InvalidSample, PassReport, Renderer, ResumeError};
