//! What the printer of C++ does not know.

use std::fmt;

/// A construct that is not translated.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Failure {
    /// From 1.
    line: usize,
    message: String,
}

impl Failure {
    pub(super) fn new(line: usize, message: impl Into<String>) -> Self {
        Self {
            line,
            message: message.into(),
        }
    }

    /// The same below so many lines more.
    pub(super) fn behind(self, lines: usize) -> Self {
        Self {
            line: self.line + lines,
            ..self
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.line, self.message)
    }
}
