//! The record of an experiment, `result.json`: what was measured, on which machine, with which outcome.

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::output::Table;
use crate::output::comparison::WrittenComparison;
use crate::plot::WrittenPlot;
use crate::{LabError, Machine, Outcome, Quality, Result, Source, Verdict};

/// Name of the file in an experiment's folder.
pub const FILE: &str = "result.json";

/// The results of an experiment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// The experiment's name.
    pub id: String,
    /// The source of the table or figure.
    pub source: Source,
    /// Which table or figure.
    pub item: String,
    /// What it shows.
    pub title: String,
    /// What the source states.
    pub statement: String,
    /// The command that makes it.
    pub command: String,
    /// How much work was done.
    pub quality: Quality,
    /// Seed of all random numbers.
    pub seed: u64,
    /// Version of the program.
    pub version: String,
    /// The machine that ran it.
    pub machine: Machine,
    /// How long it took.
    pub seconds: f64,
    /// The outcome.
    pub outcome: Outcome,
    /// Claims and summary.
    pub verdict: Verdict,
    /// Data; each also as CSV of its name.
    pub tables: Vec<Table>,
    /// Plots.
    pub plots: Vec<WrittenPlot>,
    /// Pictures.
    pub comparisons: Vec<WrittenComparison>,
}

impl Record {
    /// Reads it from an experiment's folder.
    ///
    /// # Errors
    ///
    /// Where there is none, or it is damaged.
    pub fn read(folder: &Path) -> Result<Self> {
        let path = folder.join(FILE);
        let text = std::fs::read_to_string(&path).map_err(LabError::io(&path))?;
        serde_json::from_str(&text).map_err(|e| LabError::NotAResult {
            path,
            message: e.to_string(),
        })
    }

    /// Writes it into an experiment's folder.
    ///
    /// # Errors
    ///
    /// Where the file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<()> {
        let path = folder.join(FILE);
        let text = serde_json::to_string_pretty(self)
            .map_err(|e| LabError::Output(format!("{}: {e}", path.display())))?;
        specula_scene::atomic::replace(&path, |file| {
            use std::io::Write as _;
            writeln!(file, "{text}")
        })
        .map_err(LabError::io(&path))
    }
}
