//! Experiments and their verdicts.

use serde::{Deserialize, Serialize};

use crate::{Lab, Result};

/// One table or figure of a paper, or of Specula.
#[derive(Clone, Copy, Debug)]
pub struct Experiment {
    /// Its name on the command line: source and item, such as `tokuyoshi24-fig7`. Also the name of
    /// its file here, with `_` for `-`.
    pub id: &'static str,
    /// The source.
    pub source: Source,
    /// Which table or figure, such as `fig. 7`.
    pub item: &'static str,
    /// What it shows, in a few words.
    pub title: &'static str,
    /// What the source states.
    pub statement: &'static str,
    /// Measures and writes its results.
    pub run: fn(&mut Lab<'_>) -> Result<Verdict>,
}

/// The source of a table or figure.
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

/// Whether a claim's result is the same on every machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ClaimKind {
    /// Holds on every machine at every quality, by a test.
    Law,
    /// Does not hold, on every machine at every quality, by a test: the source errs, or shows a special
    /// case.
    Refuted,
    /// Depends on the machine (times) or on much work: reported only.
    Measured,
}

/// Whether a claim holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Answer {
    /// It holds.
    Yes,
    /// It does not.
    No,
    /// The figures are too uncertain to tell.
    Undecided,
}

impl Answer {
    /// Its name, also in records.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Yes => "yes",
            Self::No => "no",
            Self::Undecided => "undecided",
        }
    }

    /// The answer for a figure that is this many standard errors on the claim's side: yes or no beyond
    /// [`DECIDED`](Self::DECIDED).
    #[must_use]
    pub fn beyond(deviations: f64) -> Self {
        if deviations > Self::DECIDED {
            Self::Yes
        } else if deviations < -Self::DECIDED {
            Self::No
        } else {
            Self::Undecided
        }
    }

    /// Standard errors that decide: 95 % confidence with half a dozen rounds and a few comparisons.
    pub const DECIDED: f64 = 3.0;

    /// The answer for a claim with several parts: no where one is refuted, yes where all hold.
    #[must_use]
    pub fn all(parts: impl IntoIterator<Item = Self>) -> Self {
        parts
            .into_iter()
            .fold(Self::Yes, |all, part| match (all, part) {
                (Self::No, _) | (_, Self::No) => Self::No,
                (Self::Undecided, _) | (_, Self::Undecided) => Self::Undecided,
                _ => Self::Yes,
            })
    }
}

impl From<bool> for Answer {
    fn from(holds: bool) -> Self {
        if holds { Self::Yes } else { Self::No }
    }
}

/// Records of version 0.1 say `true` and `false`.
impl<'de> Deserialize<'de> for Answer {
    fn deserialize<D: serde::Deserializer<'de>>(
        deserializer: D,
    ) -> std::result::Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(untagged)]
        enum Written {
            Whether(bool),
            Word(String),
        }
        match Written::deserialize(deserializer)? {
            Written::Whether(holds) => Ok(holds.into()),
            Written::Word(word) => [Self::Yes, Self::No, Self::Undecided]
                .into_iter()
                .find(|answer| answer.name() == word)
                .ok_or_else(|| {
                    serde::de::Error::custom(format!(
                        "expected yes, no or undecided, found '{word}'"
                    ))
                }),
        }
    }
}

/// A claim of a source, and the result here.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Claim {
    /// What is claimed, as a sentence.
    pub statement: String,
    /// The source's figure, or what it says in words.
    pub stated: String,
    /// Specula's figure.
    pub measured: String,
    /// Whether Specula's figure says the same.
    pub holds: Answer,
    /// Whether that is the same on every machine.
    pub kind: ClaimKind,
}

impl Claim {
    /// A claim that holds on every machine.
    pub fn law(statement: &str, stated: &str, measured: String, holds: impl Into<Answer>) -> Self {
        Self {
            statement: statement.to_owned(),
            stated: stated.to_owned(),
            measured,
            holds: holds.into(),
            kind: ClaimKind::Law,
        }
    }

    /// A claim that does not hold, on every machine.
    pub fn refuted(
        statement: &str,
        stated: &str,
        measured: String,
        holds: impl Into<Answer>,
    ) -> Self {
        Self {
            kind: ClaimKind::Refuted,
            ..Self::law(statement, stated, measured, holds)
        }
    }

    /// A claim about times, or one that takes much work to measure.
    pub fn measured(
        statement: &str,
        stated: &str,
        measured: String,
        holds: impl Into<Answer>,
    ) -> Self {
        Self {
            kind: ClaimKind::Measured,
            ..Self::law(statement, stated, measured, holds)
        }
    }
}

/// The outcome of an experiment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outcome {
    /// All claims hold.
    Reproduced,
    /// Some do.
    Partly,
    /// None does.
    NotReproduced,
    /// None is refuted, but some figures are too uncertain.
    Undecided,
}

impl Outcome {
    /// In words.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Reproduced => "reproduced",
            Self::Partly => "partly",
            Self::NotReproduced => "not reproduced",
            Self::Undecided => "undecided",
        }
    }
}

/// The result of an experiment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// One sentence with the figures that matter.
    pub summary: String,
    /// What was claimed, one by one; at least one.
    pub claims: Vec<Claim>,
    /// Differences from the source (another scene, no GPU), and limits of the result; may be empty.
    pub caveat: String,
}

impl Verdict {
    /// The outcome over all claims.
    #[must_use]
    pub fn outcome(&self) -> Outcome {
        let is_there = |answer| self.claims.iter().any(|c| c.holds == answer);
        match (
            is_there(Answer::Yes),
            is_there(Answer::No),
            is_there(Answer::Undecided),
        ) {
            (true, false, false) => Outcome::Reproduced,
            (true, true, _) => Outcome::Partly,
            (_, false, true) => Outcome::Undecided,
            (false, ..) => Outcome::NotReproduced,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outcomes_follow_from_the_answers() {
        use Answer::{No, Undecided, Yes};
        let claim = |holds| Claim::law("", "", String::new(), holds);
        for (answers, expected) in [
            (&[Yes, Yes][..], Outcome::Reproduced),
            (&[Yes, No], Outcome::Partly),
            (&[Yes, No, Undecided], Outcome::Partly),
            (&[Yes, Undecided], Outcome::Undecided),
            (&[Undecided], Outcome::Undecided),
            (&[No, Undecided], Outcome::NotReproduced),
            (&[No], Outcome::NotReproduced),
            (&[], Outcome::NotReproduced),
        ] {
            let verdict = Verdict {
                summary: String::new(),
                claims: answers.iter().map(|&a| claim(a)).collect(),
                caveat: String::new(),
            };
            assert_eq!(verdict.outcome(), expected, "{answers:?}");
        }
    }

    #[test]
    fn a_claim_of_several_parts_needs_them_all() {
        use Answer::{No, Undecided, Yes};
        assert_eq!(Answer::all([Yes, Yes]), Yes);
        assert_eq!(Answer::all([Yes, Undecided]), Undecided);
        assert_eq!(Answer::all([Undecided, No, Yes]), No);
        assert_eq!(Answer::all([]), Yes);
    }

    #[test]
    fn figures_decide_beyond_their_noise() {
        use Answer::{No, Undecided, Yes};
        for (deviations, expected) in [(3.5, Yes), (1.0, Undecided), (-1.0, Undecided), (-3.5, No)]
        {
            assert_eq!(Answer::beyond(deviations), expected, "{deviations}");
        }
        assert_eq!(Answer::beyond(f64::NAN), Undecided);
    }

    #[test]
    fn earlier_records_are_read() {
        let read = |text: &str| serde_json::from_str::<Answer>(text);
        assert_eq!(read("true").unwrap(), Answer::Yes);
        assert_eq!(read("false").unwrap(), Answer::No);
        for answer in [Answer::Yes, Answer::No, Answer::Undecided] {
            let text = serde_json::to_string(&answer).unwrap();
            assert_eq!(read(&text).unwrap(), answer, "{text}");
        }
        let error = read("\"maybe\"").unwrap_err().to_string();
        assert!(
            error.contains("expected yes, no or undecided, found 'maybe'"),
            "{error}"
        );
    }
}
