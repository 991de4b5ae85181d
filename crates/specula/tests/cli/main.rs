//! The command line, end to end: one test file for each command or promise, in one program, which is
//! linked once.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail loudly")]

mod absent;
mod broken;
mod check;
mod checkpoint;
mod common;
mod compare;
mod convert;
mod denoise;
#[cfg(feature = "gpu")]
mod device;
#[cfg(all(target_os = "linux", feature = "gpu", feature = "lab"))]
mod empty_root;
#[cfg(feature = "shaders")]
mod export;
mod farm;
#[cfg(unix)]
mod interrupt;
#[cfg(feature = "lab")]
mod lab;
#[cfg(feature = "tev")]
mod live_view;
mod memory;
#[cfg(target_os = "linux")]
mod messages;
mod missing;
mod motion;
mod outputs;
mod render;
#[cfg(all(unix, feature = "studio"))]
mod studio;
mod v3;
#[cfg(unix)]
mod watch;
