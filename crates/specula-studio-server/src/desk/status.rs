//! What pages are told of the laboratory.

use std::time::Instant;

use serde::Serialize;
use serde_json::{Value, json};
use specula_lab::{Answer, Claim, Outcome, Record};

/// The run that is under way, and what was found in this session.
#[derive(Default)]
pub(super) struct Status {
    pub(super) running: Option<Running>,
    results: Vec<Found>,
    /// Why the last run ended early.
    pub(super) error: Option<String>,
    /// Whether there is a report.
    pub(super) has_report: bool,
}

/// How far a run is.
pub(super) struct Running {
    pub(super) id: String,
    /// From 1.
    pub(super) index: usize,
    pub(super) count: usize,
    /// Of the whole run, in `[0, 1]`.
    pub(super) share: f64,
    /// What is being done.
    pub(super) what: String,
    pub(super) begun: Instant,
}

/// What an experiment has found.
#[derive(Serialize)]
struct Found {
    id: String,
    title: String,
    seconds: f64,
    quality: &'static str,
    seed: u64,
    outcome: Outcome,
    summary: String,
    caveat: String,
    claims: Vec<Value>,
}

impl From<&Record> for Found {
    fn from(record: &Record) -> Self {
        Self {
            id: record.id.clone(),
            title: record.title.clone(),
            seconds: record.seconds,
            quality: record.quality.name(),
            seed: record.seed,
            outcome: record.outcome,
            summary: record.verdict.summary.clone(),
            caveat: record.verdict.caveat.clone(),
            claims: record.verdict.claims.iter().map(claim).collect(),
        }
    }
}

/// `holds`: `null` where the figures are too uncertain.
fn claim(claim: &Claim) -> Value {
    let holds = match claim.holds {
        Answer::Yes => Some(true),
        Answer::No => Some(false),
        Answer::Undecided => None,
    };
    json!({"text": claim.statement, "stated": claim.stated, "measured": claim.measured, "holds": holds})
}

impl Status {
    /// Adds a result, in the place of an earlier one of the same experiment.
    pub(super) fn add(&mut self, record: &Record) {
        let found = Found::from(record);
        match self.results.iter_mut().find(|of| of.id == found.id) {
            Some(earlier) => *earlier = found,
            None => self.results.push(found),
        }
    }

    /// As pages see it: `Status` in `web/src/pages/laboratory/status.ts`.
    pub(super) fn shown(&self) -> Value {
        let running = self.running.as_ref().map(|run| {
            json!({
                "id": run.id,
                "index": run.index,
                "count": run.count,
                "share": run.share,
                "what": run.what,
                "seconds": run.begun.elapsed().as_secs_f64(),
            })
        });
        json!({
            "running": running,
            "results": self.results,
            "error": self.error,
            "report": self.has_report.then_some("/lab/report/"),
        })
    }
}
