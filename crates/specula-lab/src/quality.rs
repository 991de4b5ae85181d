//! How much work experiments do.

use serde::{Deserialize, Serialize};

/// How much work an experiment does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Quality {
    /// Enough for the direction of every claim: seconds.
    #[default]
    Draft,
    /// Enough for print: minutes.
    Paper,
}

impl Quality {
    /// The name on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Draft => "draft",
            Self::Paper => "paper",
        }
    }
}
