//! Progressive renders.

use serde_json::{Map, Value};

use crate::{Answer, AskError};

/// The open renders.
#[derive(Debug, Default)]
pub(crate) struct Renders {}

impl Renders {
    /// Answers `render.{what}`.
    pub(crate) fn answer(
        &self,
        what: &str,
        _request: Map<String, Value>,
    ) -> Result<Answer, AskError> {
        Err(AskError::unknown(&format!("render.{what}")))
    }
}
