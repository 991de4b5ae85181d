//! What an experiment is, and what it answers.

use serde::{Deserialize, Serialize};

use crate::{Lab, Result};

/// One table or figure of a paper, or of ours.
#[derive(Clone, Copy, Debug)]
pub struct Experiment {
    /// What the command line calls it: source and item, such as `tokuyoshi24-fig7`. Also the name of
    /// its file here, with `_` for `-`.
    pub id: &'static str,
    /// Whose it is.
    pub source: Source,
    /// Which of the source's, such as `fig. 7`.
    pub item: &'static str,
    /// What it shows, in a few words.
    pub title: &'static str,
    /// What the source states.
    pub statement: &'static str,
    /// Measures.
    pub run: fn(&mut Lab<'_>) -> Result<Verdict>,
}

/// Whose table or figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Source {
    /// Tokuyoshi and Eto 2024, Bounded VNDF Sampling for the Smith-GGX BRDF.
    Tokuyoshi24,
    /// Eto and Tokuyoshi 2023, its supplementary document.
    Eto23,
    /// Dupuy and Benyoub 2023, Sampling Visible GGX Normals with Spherical Caps.
    Dupuy23,
    /// Cui et al. 2023, Multiple-bounce Smith Microfacet BRDFs using the Invariance Principle.
    Cui23,
    /// This project.
    Specula,
}

impl Source {
    /// Authors and year.
    #[must_use]
    pub fn cite(self) -> &'static str {
        match self {
            Self::Tokuyoshi24 => "Tokuyoshi and Eto 2024",
            Self::Eto23 => "Eto and Tokuyoshi 2023",
            Self::Dupuy23 => "Dupuy and Benyoub 2023",
            Self::Cui23 => "Cui et al. 2023",
            Self::Specula => "Specula",
        }
    }
}

/// How much work an experiment takes upon itself.
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

/// Whether a claim's result may be relied upon to come out again.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// Holds on every machine at every quality, by a test.
    Law,
    /// Does not hold, on every machine at every quality, by a test: the source errs, or shows a special
    /// case.
    Refuted,
    /// Depends on the machine (times) or on much work: reported only.
    Measured,
}

/// One thing that a source states, and what came out here.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Claim {
    /// What is claimed, as a sentence.
    pub statement: String,
    /// The source's figure, or what it says in words.
    pub stated: String,
    /// Ours.
    pub measured: String,
    /// Whether ours says the same.
    pub holds: bool,
    /// Whether that may be relied upon.
    pub kind: Kind,
}

impl Claim {
    /// A claim that holds on every machine.
    pub fn law(statement: &str, stated: &str, measured: String, holds: bool) -> Self {
        Self {
            statement: statement.to_owned(),
            stated: stated.to_owned(),
            measured,
            holds,
            kind: Kind::Law,
        }
    }

    /// A claim that is found not to hold, on every machine.
    pub fn refuted(statement: &str, stated: &str, measured: String, holds: bool) -> Self {
        Self {
            kind: Kind::Refuted,
            ..Self::law(statement, stated, measured, holds)
        }
    }

    /// A claim about times, or one that takes much work to see.
    pub fn measured(statement: &str, stated: &str, measured: String, holds: bool) -> Self {
        Self {
            kind: Kind::Measured,
            ..Self::law(statement, stated, measured, holds)
        }
    }
}

/// How an experiment came out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outcome {
    /// All claims hold.
    Reproduced,
    /// Some do.
    Partly,
    /// None does.
    NotReproduced,
}

impl Outcome {
    /// In words.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Reproduced => "reproduced",
            Self::Partly => "partly",
            Self::NotReproduced => "not reproduced",
        }
    }
}

/// What an experiment answers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// One sentence with the figures that matter.
    pub summary: String,
    /// What was claimed, one by one; at least one.
    pub claims: Vec<Claim>,
    /// What was done otherwise than by the source (another scene, no GPU), and what limits the
    /// result; empty where nothing.
    pub caveat: String,
}

impl Verdict {
    /// How it came out over all claims.
    #[must_use]
    pub fn outcome(&self) -> Outcome {
        let held = self.claims.iter().filter(|c| c.holds).count();
        match held {
            0 => Outcome::NotReproduced,
            n if n == self.claims.len() => Outcome::Reproduced,
            _ => Outcome::Partly,
        }
    }
}
