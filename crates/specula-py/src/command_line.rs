//! The program `specula`.

use std::ffi::OsString;
use std::io::Write as _;

use pyo3::prelude::*;

/// Runs the program `specula` with these arguments, its own name first.
///
/// Returns the exit code. It installs handlers for signals, so a process should run it once and end.
#[pyfunction]
pub(crate) fn command_line(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| {
        let code = specula::command_line(arguments);
        // Nobody does it for a library. A reader that went away is no failure.
        let _ = std::io::stdout().flush();
        code
    })
}
