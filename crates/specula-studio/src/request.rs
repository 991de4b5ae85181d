//! Requests: JSON objects whose `ask` says what is wanted.

use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

/// Why a request has no answer, in words for a person.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct AskError(String);

impl AskError {
    /// An error of these words.
    pub fn new(message: impl Into<String>) -> Self {
        Self(message.into())
    }

    /// Nothing answers to this name.
    pub(crate) fn unknown(ask: &str) -> Self {
        Self(format!("nothing answers to '{ask}'"))
    }
}

/// The name of what is asked for, and the rest of the request.
pub(crate) fn read(bytes: &[u8]) -> Result<(String, Map<String, Value>), AskError> {
    let value: Value =
        serde_json::from_slice(bytes).map_err(|e| AskError(format!("not a request: {e}")))?;
    let Value::Object(mut request) = value else {
        return Err(AskError::new("not a request: expected an object"));
    };
    match request.remove("ask") {
        Some(Value::String(ask)) => Ok((ask, request)),
        _ => Err(AskError::new("not a request: expected a string 'ask'")),
    }
}

/// The request's fields as a type, which should deny unknown ones.
pub(crate) fn fields<T: DeserializeOwned>(request: Map<String, Value>) -> Result<T, AskError> {
    serde_json::from_value(Value::Object(request)).map_err(|e| AskError(e.to_string()))
}
