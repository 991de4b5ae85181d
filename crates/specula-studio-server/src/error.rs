//! Errors of the server as a whole, and refusals of single requests.

use std::io;
use std::net::SocketAddr;
use std::path::PathBuf;

use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde_json::{Value, json};

/// Why the studio is not served, or not exported.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ServerError {
    /// Another program listens there.
    #[error("port {} of {} is in use; `--port 0` takes a free one", .0.port(), .0.ip())]
    InUse(SocketAddr),
    /// The address cannot be listened on.
    #[error("cannot listen on {0}: {1}")]
    Listen(SocketAddr, io::Error),
    /// The system gives no random numbers.
    #[error("the system gives no random numbers for a token: {0}")]
    Random(String),
    /// Threads or sockets are missing.
    #[error("cannot serve: {0}")]
    Serve(io::Error),
    /// A file or folder could not be read or written.
    #[error("'{}': {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The folder of an export holds other files.
    #[error("'{}' has other files, such as '{other}': an export takes a folder for itself", folder.display())]
    NotEmpty {
        /// The folder.
        folder: PathBuf,
        /// One of them.
        other: String,
    },
}

impl ServerError {
    /// [`ServerError::Io`] of `path`.
    pub(crate) fn io(path: &std::path::Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_owned();
        move |source| Self::Io { path, source }
    }

    /// Whether it is for the user to give other arguments.
    #[must_use]
    pub fn is_bad_input(&self) -> bool {
        !matches!(self, Self::Random(_) | Self::Serve(_))
    }
}

/// Why a request is refused: a status, and JSON whose `error` says why in words.
#[derive(Debug)]
pub(crate) struct Refusal {
    status: StatusCode,
    value: Value,
}

impl Refusal {
    pub(crate) fn new(status: StatusCode, message: impl Into<String>) -> Self {
        let value = json!({ "error": message.into() });
        Self { status, value }
    }

    /// With more than words.
    pub(crate) fn of(status: StatusCode, value: Value) -> Self {
        Self { status, value }
    }

    pub(crate) fn forbidden(message: &str) -> Self {
        Self::new(StatusCode::FORBIDDEN, message)
    }

    pub(crate) fn bad(message: impl Into<String>) -> Self {
        Self::new(StatusCode::BAD_REQUEST, message)
    }

    pub(crate) fn too_large(message: impl Into<String>) -> Self {
        Self::new(StatusCode::PAYLOAD_TOO_LARGE, message)
    }

    pub(crate) fn internal(message: impl Into<String>) -> Self {
        Self::new(StatusCode::INTERNAL_SERVER_ERROR, message)
    }
}

impl IntoResponse for Refusal {
    fn into_response(self) -> Response {
        (self.status, json_response(&self.value)).into_response()
    }
}

/// JSON that no cache keeps.
pub(crate) fn json_response(value: &Value) -> Response {
    let headers = [
        (header::CONTENT_TYPE, "application/json"),
        (header::CACHE_CONTROL, "no-store"),
    ];
    (headers, value.to_string()).into_response()
}
