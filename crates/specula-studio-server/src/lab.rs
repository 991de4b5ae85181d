//! The laboratory's routes: experiments, runs of them, their report.

mod report;
mod run;
mod status;

use std::io;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use axum::Router;
use axum::body::Body;
use axum::extract::State;
use axum::http::{HeaderMap, StatusCode};
use axum::response::Response;
use axum::routing::{get, post};
use serde::Deserialize;
use serde_json::{Value, json};
use specula_lab::{Quality, RunOptions, experiments};

use crate::body;
use crate::error::{Refusal, json_response};
use crate::shared::Shared;
use run::Run;
use status::Status;

/// Results of this session and the run that is under way.
pub(crate) struct Desk {
    folder: tempfile::TempDir,
    status: Arc<Mutex<Status>>,
    run: Mutex<Option<Run>>,
}

impl Desk {
    /// With a temporary folder for results.
    pub(crate) fn new() -> io::Result<Self> {
        let folder = tempfile::Builder::new()
            .prefix("specula-studio-lab-")
            .tempdir()?;
        Ok(Self {
            folder,
            status: Arc::default(),
            run: Mutex::new(None),
        })
    }

    /// Ends the run that is under way, and waits for it a little.
    pub(crate) fn end(&self) {
        if let Some(run) = locked(&self.run).take() {
            run.end();
        }
    }
}

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// All routes of the laboratory.
pub(crate) fn routes() -> Router<Arc<Shared>> {
    Router::new()
        .route("/api/lab", get(list))
        .route("/api/lab/run", post(start))
        .route("/api/lab/status", get(status))
        .route("/api/lab/stop", post(stop))
        .route("/lab/report/", get(report::page))
}

/// `GET /api/lab`: what can be run, and about how long it takes.
async fn list() -> Response {
    let all: Vec<Value> = experiments::ALL
        .iter()
        .map(|e| {
            json!({
                "id": e.id,
                "title": e.title,
                "source": e.source,
                "paper": e.source.cite(),
                "item": e.item,
                "statement": e.statement,
            })
        })
        .collect();
    let qualities = json!([
        {"name": Quality::Draft.name(), "takes": "seconds for each", "doc": "enough for the direction of every claim"},
        {"name": Quality::Paper.name(), "takes": "up to minutes for each", "doc": "enough for print"},
    ]);
    json_response(&json!({ "experiments": all, "qualities": qualities }))
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Start {
    ids: Vec<String>,
    #[serde(default)]
    quality: Quality,
    #[serde(default)]
    seed: u64,
}

/// `POST /api/lab/run`: begins a run; one at a time.
async fn start(
    State(shared): State<Arc<Shared>>,
    headers: HeaderMap,
    body: Body,
) -> Result<Response, Refusal> {
    let Start { ids, quality, seed } = body::json(&headers, body, shared.limits.body_time).await?;
    if ids.is_empty() {
        return Err(Refusal::bad("'ids' names no experiment"));
    }
    let chosen = experiments::named(&ids).map_err(|e| Refusal::bad(e.to_string()))?;
    let mut run = locked(&shared.lab.run);
    if locked(&shared.lab.status).running.is_some() {
        let message = "a run is under way: stop it, or wait for its end";
        return Err(Refusal::new(StatusCode::CONFLICT, message));
    }
    let begun = Run::start(Arc::clone(&shared), chosen, RunOptions { quality, seed });
    *run = Some(begun.map_err(|e| Refusal::internal(e.to_string()))?);
    Ok(json_response(&json!({})))
}

/// `GET /api/lab/status`: how far the run is, and what it has found.
async fn status(State(shared): State<Arc<Shared>>) -> Response {
    json_response(&locked(&shared.lab.status).shown())
}

/// `POST /api/lab/stop`: ends the run; what is finished stays.
async fn stop(State(shared): State<Arc<Shared>>) -> Response {
    if let Some(run) = locked(&shared.lab.run).as_ref() {
        run.stop();
    }
    json_response(&json!({}))
}
