//! Scenes, whole and broken, from their files to the model.
#![allow(
    clippy::unwrap_used,
    clippy::cast_possible_truncation,
    reason = "helpers of tests fail loudly and cut numbers on purpose"
)]

mod broken;
mod check;
mod check_files;
mod check_gltf;
mod common;
mod directives;
mod features;
mod film;
mod graph;
mod materials;
mod media;
mod mutations;
#[path = "../common/report.rs"]
mod report;
mod shared_scenes;
