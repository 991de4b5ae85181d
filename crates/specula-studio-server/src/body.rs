//! Bodies of requests, which may be too long or never end.

use std::time::Duration;

use axum::body::{Body, Bytes};
use axum::http::{HeaderMap, StatusCode, header};
use http_body_util::BodyExt as _;
use serde::de::DeserializeOwned;

use crate::error::Refusal;

/// A body in pieces.
pub(crate) struct Pieces {
    body: Body,
    left: u64,
    most: u64,
    time: Duration,
}

impl Pieces {
    /// * `most`: bytes.
    /// * `time`: for each piece.
    pub(crate) fn new(
        headers: &HeaderMap,
        body: Body,
        most: u64,
        time: Duration,
    ) -> Result<Self, Refusal> {
        let promised = headers
            .get(header::CONTENT_LENGTH)
            .and_then(|v| v.to_str().ok()?.parse::<u64>().ok());
        match promised.is_some_and(|length| length > most) {
            true => Err(too_large(most)),
            false => Ok(Self {
                body,
                left: most,
                most,
                time,
            }),
        }
    }

    /// The next piece; `None` at the end.
    pub(crate) async fn next(&mut self) -> Result<Option<Bytes>, Refusal> {
        loop {
            let frame = tokio::time::timeout(self.time, self.body.frame()).await;
            let frame = frame.map_err(|_| {
                Refusal::new(StatusCode::REQUEST_TIMEOUT, "the request does not go on")
            })?;
            let Some(frame) = frame else {
                return Ok(None);
            };
            let frame = frame.map_err(|_| Refusal::bad("the request broke off"))?;
            if let Ok(data) = frame.into_data() {
                self.left = self
                    .left
                    .checked_sub(data.len() as u64)
                    .ok_or_else(|| too_large(self.most))?;
                return Ok(Some(data));
            }
        }
    }
}

fn too_large(most: u64) -> Refusal {
    Refusal::too_large(format!("the request has more than {most} bytes"))
}

/// A whole body of at most `most` bytes, in at most `time`.
pub(crate) async fn whole(
    headers: &HeaderMap,
    body: Body,
    most: usize,
    time: Duration,
) -> Result<Bytes, Refusal> {
    let mut pieces = Pieces::new(headers, body, most as u64, time)?;
    let read = async {
        let mut all = Vec::new();
        while let Some(piece) = pieces.next().await? {
            all.extend_from_slice(&piece);
        }
        Ok(Bytes::from(all))
    };
    let read = tokio::time::timeout(time, read).await;
    read.unwrap_or_else(|_| {
        Err(Refusal::new(
            StatusCode::REQUEST_TIMEOUT,
            "the request takes too long",
        ))
    })
}

/// A small body of JSON.
pub(crate) async fn json<T: DeserializeOwned>(
    headers: &HeaderMap,
    body: Body,
    time: Duration,
) -> Result<T, Refusal> {
    let bytes = whole(headers, body, 1 << 16, time).await?;
    serde_json::from_slice(&bytes).map_err(|e| Refusal::bad(format!("not a request: {e}")))
}
