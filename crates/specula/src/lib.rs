//! Specula: render rough metal right. This crate re-exports the libraries and holds the command
//! line.
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

pub use specula_bsdf as bsdf;
pub use specula_gpu as gpu;
pub use specula_lab as lab;
pub use specula_render as render;
pub use specula_scene as scene;
pub use specula_shaders as shaders;
