//! Requests about lobes.

use serde_json::{Map, Value};

use crate::{Answer, AskError};

/// Answers `lobes.{what}`.
pub(crate) fn answer(what: &str, _request: Map<String, Value>) -> Result<Answer, AskError> {
    Err(AskError::unknown(&format!("lobes.{what}")))
}
