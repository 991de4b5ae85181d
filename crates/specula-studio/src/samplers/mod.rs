//! Requests about samplers.

use serde_json::{Map, Value};

use crate::{Answer, AskError};

/// Answers `samplers.{what}`.
pub(crate) fn answer(what: &str, _request: Map<String, Value>) -> Result<Answer, AskError> {
    Err(AskError::unknown(&format!("samplers.{what}")))
}
