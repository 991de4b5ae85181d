//! Scenes, whole and broken, from their files to the model.
#![allow(
    clippy::unwrap_used,
    clippy::cast_possible_truncation,
    reason = "helpers of tests fail loudly and cut numbers on purpose"
)]

mod animation;
mod broken;
mod budget;
mod check;
mod check_files;
mod check_gltf;
mod common;
mod deform;
mod directives;
mod features;
mod files;
mod film;
mod formats;
mod graph;
mod materials;
#[path = "../common/measured.rs"]
mod measured;
mod measured_files;
mod media;
mod missing;
mod motion;
mod mutations;
mod obj_looks;
mod pressed;
mod range;
#[path = "../common/report.rs"]
mod report;
mod shared_scenes;
mod staged;
mod v3;
mod written;
