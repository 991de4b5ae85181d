//! Specula: render rough metal right. This crate re-exports the libraries and holds the command
//! line.
//!
//! | feature | gives |
//! |---|---|
//! | `cli` (default) | the program `specula` |
//! | `tev` (default) | a live view in the viewer tev: `render --display-server` |
//! | `gpu` | the module `gpu`, `render --device gpu` |
//! | `lab` | the module `lab`, `specula lab` |
//! | `shaders` | the module `shaders`, `specula export` |
//! | `full` | all of these |
//! | `oidn` | Open Image Denoise, whose library must be installed: `specula denoise`, `render --denoise` |
//!
//! The library alone has no need of `cli` and what it depends on: `default-features = false`.
//!
//! ```no_run
//! use std::sync::atomic::AtomicBool;
//!
//! use specula::render::picture::{self, Metadata};
//! use specula::render::{PreparedScene, RenderOptions, Renderer};
//!
//! let scene = specula::scene::builtin::orbs();
//! let options = RenderOptions::from_scene(&scene);
//! let prepared = PreparedScene::new(&scene, &options)?;
//! let mut renderer = Renderer::new(&prepared, options);
//! renderer.render_pass(16, &AtomicBool::new(false));
//! picture::write_exr(
//!     "orbs.exr".as_ref(),
//!     &renderer.film().picture(),
//!     &Metadata::default(),
//! )?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![forbid(unsafe_code)]

#[cfg(feature = "cli")]
mod cli;

pub use specula_bsdf as bsdf;
#[cfg(feature = "gpu")]
pub use specula_gpu as gpu;
#[cfg(feature = "lab")]
pub use specula_lab as lab;
pub use specula_render as render;
pub use specula_scene as scene;
#[cfg(feature = "shaders")]
pub use specula_shaders as shaders;

/// Runs the program `specula` with these arguments, the program's name first.
///
/// Installs handlers for signals: of use to a process that does nothing else.
///
/// * Returns: the exit code; 0 where all went well, 2 for input that is wrong.
#[cfg(feature = "cli")]
pub fn command_line(arguments: impl IntoIterator<Item = std::ffi::OsString>) -> u8 {
    cli::command_line(arguments.into_iter().collect())
}
