//! `POST /api/ask`: a request to the library, and the bytes of its answer.

use std::sync::Arc;

use axum::body::{Body, Bytes};
use axum::extract::State;
use axum::http::{HeaderMap, header};
use axum::response::{IntoResponse, Response};

use crate::body;
use crate::error::Refusal;
use crate::shared::Shared;

/// Answers in a thread of its own. A request whose page goes away while it waits is not begun; one that was begun
/// keeps its place until it is done, so that there are never more at once.
pub(crate) async fn ask(
    State(shared): State<Arc<Shared>>,
    headers: HeaderMap,
    body: Body,
) -> Result<Response, Refusal> {
    let limits = &shared.limits;
    let request = body::whole(&headers, body, limits.ask_bytes, limits.body_time).await?;
    let answer = answer(shared, request).await?;
    let headers = [
        (header::CONTENT_TYPE, "application/octet-stream"),
        (header::CACHE_CONTROL, "no-store"),
    ];
    Ok((headers, answer).into_response())
}

async fn answer(shared: Arc<Shared>, request: Bytes) -> Result<Vec<u8>, Refusal> {
    let place = Arc::clone(&shared.asking).acquire_owned().await;
    let place = place.map_err(|_| Refusal::internal("the studio is ending"))?;
    let answer = move || {
        let _place = place;
        // Not in a worker: one that waits for parts of a render would take up a request that waits for that render.
        shared.studio.answer(&request)
    };
    tokio::task::spawn_blocking(answer).await.map_err(|_| {
        Refusal::internal("this request met a fault in Specula; its terminal says more")
    })
}
