//! The machine that ran an experiment.

use serde::{Deserialize, Serialize};

/// The machine, in words.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Machine {
    /// Name of the processor, or its architecture where the system does not say.
    pub processor: String,
    /// Threads that were used.
    pub threads: usize,
    /// Operating system.
    pub system: String,
}

impl Machine {
    /// This one.
    #[must_use]
    pub fn here() -> Self {
        Self {
            processor: processor().unwrap_or_else(|| std::env::consts::ARCH.to_owned()),
            threads: rayon::current_num_threads(),
            system: std::env::consts::OS.to_owned(),
        }
    }
}

/// As Linux reports it; elsewhere unknown.
fn processor() -> Option<String> {
    let text = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = text.lines().find(|l| l.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}
