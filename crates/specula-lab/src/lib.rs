//! The laboratory: every table and figure of the papers, one file each, from one command.
//!
//! An [`Experiment`] measures what a paper states, writes its data, plots and pictures through a
//! [`Lab`], and returns a [`Verdict`] made of [`Claim`]s. [`experiments::ALL`] lists them;
//! [`run`] runs them, each into a folder of its own, with a [`Record`] (`result.json`) that says what
//! was measured, at which quality, with which seed, by which version, on which machine.
//!
//! ```
//! let experiments = specula_lab::experiments::named(&["tokuyoshi24-fig7".to_owned()])?;
//! assert_eq!(experiments[0].source.cite(), "Tokuyoshi and Eto 2024");
//! # Ok::<(), specula_lab::LabError>(())
//! ```
#![forbid(unsafe_code)]

pub mod compare;
mod direction;
mod error;
mod experiment;
pub mod experiments;
pub mod fit;
pub mod gpu_report;
mod lab;
mod machine;
pub mod material;
pub mod output;
pub mod plot;
mod publish;
mod quality;
pub mod record;
mod rendered;
pub mod report;
mod runner;
mod scenes;
mod typeset;

pub use error::LabError;
pub use experiment::{Answer, Claim, ClaimKind, Experiment, Outcome, Source, Verdict};
pub use lab::{Lab, Progress};
pub use machine::Machine;
pub use publish::publish;
pub use quality::Quality;
pub use record::Record;
pub use rendered::{Errors, Rendered, errors, render};
pub use runner::{RunEvent, RunOptions, run};

/// Result of the laboratory's functions.
pub type Result<T, E = LabError> = std::result::Result<T, E>;
