//! Parity: every function of the shader modules, run on the GPU, beside its Rust twins in `f32` and
//! `f64`.
//!
//! One file for each family. Where no GPU is found, the tests say that they are skipped;
//! `SPECULA_GPU=require` makes that a failure. `cpp.rs` runs the same cases as C++, which needs a compiler only,
//! `languages.rs` in the other languages.
#![allow(clippy::print_stdout, reason = "a suite says how much it checked")]

mod bsdf;
#[path = "../common/mod.rs"]
mod common;
mod cpp;
mod energy;
mod fresnel;
mod harness;
mod languages;
mod layered;
mod math;
mod measured;
mod multibounce;
mod ndf;
mod vndf;
mod vndf_statistics;
