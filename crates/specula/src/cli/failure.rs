//! Errors as they reach the user, with the exit code that goes with them.

use crate::cli::ExitCode;

use miette::{Diagnostic, Report};

use super::console::say;

/// Exit code for arguments and scenes that are wrong.
pub(crate) const BAD_INPUT: u8 = 2;
/// Exit code for everything else that fails.
const FAILED: u8 = 1;

/// An error that ends the program.
pub(crate) struct Failure {
    report: Report,
    code: u8,
}

impl Failure {
    /// The arguments or the scene are wrong.
    pub(crate) fn input(error: impl Diagnostic + Send + Sync + 'static) -> Self {
        Self {
            report: Report::new(error),
            code: BAD_INPUT,
        }
    }

    /// The arguments or the scene are wrong, in words.
    pub(crate) fn bad_input(message: impl std::fmt::Display) -> Self {
        Self {
            report: miette::miette!("{message}"),
            code: BAD_INPUT,
        }
    }

    /// Something else failed, in words.
    pub(crate) fn other(message: impl std::fmt::Display) -> Self {
        Self {
            report: miette::miette!("{message}"),
            code: FAILED,
        }
    }

    /// The same with another sentence on a line of its own.
    pub(crate) fn and(self, more: &str) -> Self {
        Self {
            report: miette::miette!("{}\n{more}", self.report),
            code: self.code,
        }
    }

    /// Both: the first one's exit code.
    pub(crate) fn join(first: Result<(), Self>, second: Result<(), Self>) -> Result<(), Self> {
        match (first, second) {
            (Err(a), Err(b)) => Err(a.and(&b.report.to_string())),
            (a, b) => a.and(b),
        }
    }

    /// The words.
    pub(crate) fn message(&self) -> String {
        self.report.to_string()
    }

    /// The exit code and the words.
    #[cfg(test)]
    pub(crate) fn told(&self) -> (u8, String) {
        (self.code, self.report.to_string())
    }

    /// Prints the report to standard error; returns the exit code.
    pub(crate) fn print(&self) -> ExitCode {
        say!("{:?}", self.report);
        ExitCode::from(self.code)
    }
}
