//! Mitsuba scenes, whole and broken, from their files to the model.
#![allow(
    clippy::unwrap_used,
    clippy::cast_possible_truncation,
    reason = "helpers of tests fail loudly and cut numbers on purpose"
)]

mod broken;
mod budget;
mod check;
mod common;
mod conventions;
mod dialect;
mod document;
mod features;
mod hair;
#[path = "../common/measured.rs"]
#[allow(dead_code, reason = "shared with the other suite")]
mod measured;
mod media;
mod missing;
mod mutations;
mod range;
#[path = "../common/report.rs"]
mod report;
mod shared_scenes;
