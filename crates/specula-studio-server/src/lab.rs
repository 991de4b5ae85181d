//! The laboratory's routes: experiments, runs of them, their report.

mod report;
mod run;
<<<<<<< HEAD
mod status;

use std::io;
=======

use std::io;
use std::path::PathBuf;
>>>>>>> main
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
<<<<<<< HEAD
use status::Status;
=======
>>>>>>> main

/// Results of this session and the run that is under way.
pub(crate) struct Desk {
    folder: tempfile::TempDir,
<<<<<<< HEAD
    status: Arc<Mutex<Status>>,
=======
>>>>>>> main
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
<<<<<<< HEAD
            status: Arc::default(),
=======
>>>>>>> main
            run: Mutex::new(None),
        })
    }

<<<<<<< HEAD
    /// Ends the run that is under way, and waits for it a little.
    pub(crate) fn end(&self) {
        if let Some(run) = locked(&self.run).take() {
=======
    fn folder(&self) -> PathBuf {
        self.folder.path().to_owned()
    }

    fn run(&self) -> MutexGuard<'_, Option<Run>> {
        self.run.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Ends the run that is under way, and waits for it a little.
    pub(crate) fn end(&self) {
        if let Some(run) = self.run().take() {
>>>>>>> main
            run.end();
        }
    }
}

<<<<<<< HEAD
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

=======
>>>>>>> main
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
<<<<<<< HEAD
                "source": e.source,
=======
>>>>>>> main
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
<<<<<<< HEAD
    let mut run = locked(&shared.lab.run);
    if locked(&shared.lab.status).running.is_some() {
        let message = "a run is under way: stop it, or wait for its end";
        return Err(Refusal::new(StatusCode::CONFLICT, message));
    }
    let begun = Run::start(Arc::clone(&shared), chosen, RunOptions { quality, seed });
    *run = Some(begun.map_err(|e| Refusal::internal(e.to_string()))?);
=======
    let mut run = shared.lab.run();
    if run.as_ref().is_some_and(Run::is_under_way) {
        return Err(Refusal::new(
            StatusCode::CONFLICT,
            "a run is under way: stop it, or wait for its end",
        ));
    }
    let options = RunOptions { quality, seed };
    *run = Some(
        Run::start(Arc::clone(&shared), chosen, options)
            .map_err(|e| Refusal::internal(e.to_string()))?,
    );
>>>>>>> main
    Ok(json_response(&json!({})))
}

/// `GET /api/lab/status`: how far the run is, and what it has found.
async fn status(State(shared): State<Arc<Shared>>) -> Response {
<<<<<<< HEAD
    json_response(&locked(&shared.lab.status).shown())
=======
    let value = shared
        .lab
        .run()
        .as_ref()
        .map_or_else(|| json!({"state": "idle"}), Run::status);
    json_response(&value)
>>>>>>> main
}

/// `POST /api/lab/stop`: ends the run; what is finished stays.
async fn stop(State(shared): State<Arc<Shared>>) -> Response {
<<<<<<< HEAD
    if let Some(run) = locked(&shared.lab.run).as_ref() {
=======
    if let Some(run) = shared.lab.run().as_ref() {
>>>>>>> main
        run.stop();
    }
    json_response(&json!({}))
}
