//! What the tests of the workspace share: a line for what a machine does not let them do, the scenes of
//! `data/scenes`, compilers, and directions near the horizon.
//!
//! Every such line has one form and goes to standard error, past the capture of the test harness. `cargo
//! xtask test` names a file by [`FILE`]; the lines are appended to it, and printed again at the end.
#![forbid(unsafe_code)]

pub mod compilers;
pub mod horizon;

use std::fmt::{self, Display};
use std::io::Write as _;
use std::panic::Location;
use std::path::{Path, PathBuf};

/// The variable that names the file of all lines.
pub const FILE: &str = "SPECULA_SKIPS";

/// Why a test, or a part of it, does not run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// Something is not installed that could be: a failure under `cargo xtask test --strict`.
    Skipped,
    /// The machine's hardware does not have it.
    Hardware,
}

impl Reason {
    /// What its lines begin with.
    #[must_use]
    pub fn label(self) -> &'static str {
        match self {
            Self::Skipped => "SKIPPED",
            Self::Hardware => "NOT OF THIS MACHINE",
        }
    }
}

impl Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.label())
    }
}

/// Says that `what` is not tested here.
///
/// * `why`: what is absent; `remedy`: how to have it.
#[track_caller]
pub fn skip(what: impl Display, why: impl Display, remedy: impl Display) {
    let at = Location::caller();
    tell(&line(
        Reason::Skipped,
        at,
        &format!("{what}: {why} ({remedy})"),
    ));
}

/// Says that `what` is not tested here since the machine's hardware lacks something.
#[track_caller]
pub fn not_of_this_machine(what: impl Display, lacks: impl Display) {
    let at = Location::caller();
    tell(&line(Reason::Hardware, at, &format!("{what}: {lacks}")));
}

/// A file of `data/scenes`, or a folder.
///
/// # Panics
/// Where it is not there.
#[must_use]
pub fn scene(path: &str) -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let root = here.ancestors().nth(2).unwrap_or(here);
    let scene = root.join("data/scenes").join(path);
    assert!(scene.exists(), "{} is not there", scene.display());
    scene
}

/// One line, whatever its parts hold.
fn line(reason: Reason, at: &Location<'_>, text: &str) -> String {
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    format!("{reason} {}:{}: {text}\n", at.file(), at.line())
}

fn tell(line: &str) {
    // Not `eprint`, whose output the harness captures. Nobody may read it.
    let _ = std::io::stderr().write_all(line.as_bytes());
    if let Some(file) = std::env::var_os(FILE) {
        let appended = append(Path::new(&file), line);
        assert!(appended.is_ok(), "{FILE}: {appended:?}");
    }
}

fn append(file: &Path, line: &str) -> std::io::Result<()> {
    let mut file = std::fs::File::options()
        .append(true)
        .create(true)
        .open(file)?;
    // One write: tests append at the same time.
    file.write_all(line.as_bytes())
}

/// The Rust of the repository's README compiles and runs.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_whole_and_are_appended() {
        let at = Location::caller();
        let one = line(Reason::Skipped, at, "a\nb:  no c (install d)");
        assert!(one.starts_with("SKIPPED "), "{one}");
        assert!(one.contains("lib.rs:"), "{one}");
        assert!(one.ends_with(": a b: no c (install d)\n"), "{one}");
        let two = line(Reason::Hardware, at, "e");
        let name = format!("specula-testing-{}", std::process::id());
        let file = std::env::temp_dir().join(name);
        append(&file, &one).unwrap();
        append(&file, &two).unwrap();
        let text = std::fs::read_to_string(&file).unwrap();
        std::fs::remove_file(&file).unwrap();
        assert_eq!(text, one + &two);
    }

    #[test]
    fn scenes_are_there() {
        assert!(scene("README.md").is_file());
    }
}
