//! The C interface of Specula: lobes over arrays, scenes, renders and pictures.
//!
//! `include/specula.h` is made from [`abi`]; what stands there is the interface. Behind it:
//! `lobe` holds lobes, `batch` loops over blocks of elements, `scene`, `render` and `picture` are what their
//! names say. `pointers` alone has `unsafe` blocks.

pub mod abi;
mod batch;
mod border;
mod failure;
mod lobe;
mod options;
mod picture;
mod pointers;
mod render;
mod scene;
