//! The laboratory's routes: experiments, runs of them, their report.

mod report;

use std::sync::Arc;

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
    let begun = shared.lab.start(chosen, RunOptions { quality, seed });
    match begun.map_err(|e| Refusal::internal(e.to_string()))? {
        true => Ok(json_response(&json!({}))),
        false => {
            let message = "a run is under way: stop it, or wait for its end";
            Err(Refusal::new(StatusCode::CONFLICT, message))
        }
    }
}

/// `GET /api/lab/status`: how far the run is, and what it has found.
async fn status(State(shared): State<Arc<Shared>>) -> Response {
    json_response(&shared.lab.status())
}

/// `POST /api/lab/stop`: ends the run; what is finished stays.
async fn stop(State(shared): State<Arc<Shared>>) -> Response {
    shared.lab.stop();
    json_response(&json!({}))
}
