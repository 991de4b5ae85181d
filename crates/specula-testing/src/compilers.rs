//! Compilers of tests that no distribution has: variables name them.

use std::path::PathBuf;

use crate::skip;

/// A Python that has DXC, of `SPECULA_DXC_PYTHON`; else a line that `what` is skipped.
#[must_use]
#[track_caller]
pub fn dxc_python(what: &str) -> Option<PathBuf> {
    let remedy = "pip install compushady";
    named(
        "SPECULA_DXC_PYTHON",
        "Python that has compushady",
        remedy,
        what,
    )
}

/// Slang's compiler, of `SPECULA_SLANGC`; else a line that `what` is skipped.
#[must_use]
#[track_caller]
pub fn slangc(what: &str) -> Option<PathBuf> {
    let remedy = "pip install --no-deps --target FOLDER slangtorch; it has bin/slangc";
    named("SPECULA_SLANGC", "slangc", remedy, what)
}

#[track_caller]
fn named(variable: &str, thing: &str, remedy: &str, what: &str) -> Option<PathBuf> {
    let program = std::env::var_os(variable).map(PathBuf::from);
    if program.is_none() {
        skip(what, format!("{variable} names no {thing}"), remedy);
    }
    program
}
