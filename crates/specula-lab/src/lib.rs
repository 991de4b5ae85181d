//! The laboratory: every table and figure of the papers, one file each, from one command.
//!
//! An [`Experiment`] measures what a paper states, writes its data, plots and pictures through a
//! [`Lab`], and answers with a [`Verdict`] made of [`Claim`]s. [`experiments::ALL`] lists them;
//! [`run`] runs them, each into a folder of its own, with a [`Record`] (`result.json`) that says what
//! was measured, when the quality, seed, version and machine.
#![forbid(unsafe_code)]

pub mod compare;
mod error;
mod experiment;
pub mod experiments;
mod lab;
mod machine;
pub mod material;
pub mod output;
pub mod plot;
mod publish;
mod rendered;
pub mod report;
mod runner;
pub mod scenes;
mod typeset;

pub use error::LabError;
pub use experiment::{Answer, Claim, Experiment, Kind, Outcome, Quality, Source, Verdict};
pub use lab::{Lab, Progress};
pub use machine::Machine;
pub use output::record::Record;
pub use publish::publish;
pub use rendered::{Errors, Rendered, errors, render};
pub use runner::{Event, RunOptions, run};

/// What a step of the laboratory returns.
pub type Result<T, E = LabError> = std::result::Result<T, E>;
