//! Programs of tests: built by cargo, run two at a time.
//!
//! SwiftShader compiles one shader at a time in a process, so that programs of the GPU's tests leave cores idle. Beside
//! them run those of other crates.

use std::cmp::Reverse;
use std::collections::VecDeque;
use std::io::{PipeReader, PipeWriter, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Stdio};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Instant;

use serde_json::Value;

use super::deadline::Deadline;
use super::times::Suite;
use crate::{Result, workspace};

/// What is tested.
const SELECTION: [&str; 3] = ["--workspace", "--features", "specula/full"];

/// A package whose programs wait for the GPU's driver.
const GPU: &str = "specula-gpu";
/// The longest of them, which begins first.
const LONGEST: &str = "tests/pictures/main.rs";
/// A package whose programs come last: a machine that is too slow for all may leave them out.
const LABORATORY: &str = "specula-lab";

/// A program of tests.
#[derive(Clone, Debug, PartialEq)]
struct Program {
    /// Folder of its package, where it runs.
    folder: PathBuf,
    /// Its source, from there: `tests/batch.rs`.
    source: String,
    executable: PathBuf,
}

impl Program {
    /// From a line of cargo's messages; `None` where it tells of something else.
    fn from_message(line: &str) -> Option<Self> {
        let message: Value = serde_json::from_str(line).ok()?;
        if message["reason"] != "compiler-artifact" || message["profile"]["test"] != true {
            return None;
        }
        let path = |value: &Value| value.as_str().map(PathBuf::from);
        let folder = path(&message["manifest_path"])?.parent()?.to_owned();
        let source = path(&message["target"]["src_path"])?;
        let source = source.strip_prefix(&folder).unwrap_or(&source);
        Some(Self {
            source: source.to_string_lossy().replace('\\', "/"),
            executable: path(&message["executable"])?,
            folder,
        })
    }

    fn package(&self) -> String {
        let name = self.folder.file_name().unwrap_or_default();
        name.to_string_lossy().into_owned()
    }

    fn name(&self) -> String {
        format!("{} {}", self.package(), self.source)
    }

    /// What it printed, and how it ended.
    fn run(&self, environment: &[(&str, &str)]) -> Result<(Vec<u8>, ExitStatus)> {
        let mut command = Command::new(&self.executable);
        command.arg("--quiet").current_dir(&self.folder);
        command.env("CARGO_MANIFEST_DIR", &self.folder);
        captured(command.envs(environment.iter().copied()))
    }
}

/// What a program printed, to both of its outputs in order, and how it ended.
fn captured(command: &mut Command) -> Result<(Vec<u8>, ExitStatus)> {
    let (mut reader, writer): (PipeReader, PipeWriter) = std::io::pipe()?;
    command.stdin(Stdio::null());
    command.stdout(writer.try_clone()?).stderr(writer);
    let mut child = command.spawn()?;
    // The command holds the writing end, which must close for the reading to end.
    command.stdout(Stdio::null()).stderr(Stdio::null());
    let mut printed = Vec::new();
    reader.read_to_end(&mut printed)?;
    Ok((printed, child.wait()?))
}

/// Builds the programs, and runs each with these variables, and the examples of the documentation; notes in `suites` how
/// long each took.
///
/// # Errors
/// Where something does not compile, else the names of those that fail.
pub(super) fn run(
    root: &Path,
    environment: &[(&str, &str)],
    deadline: &Deadline,
    suites: &mut Vec<Suite>,
) -> Result<()> {
    let start = Instant::now();
    let programs = build(root)?;
    suites.push(Suite::new("compiling", start));
    let start = Instant::now();
    let mut failed = two_at_a_time(
        programs,
        |program| deadline.admits_program(&program.name()),
        |program| {
            let start = Instant::now();
            let outcome = program.run(environment);
            (Suite::new(&program.name(), start), outcome)
        },
        suites,
    );
    suites.push(Suite::new("running, two at a time", start));
    let start = Instant::now();
    let mut examples = workspace::cargo(root);
    examples
        .arg("test")
        .args(SELECTION)
        .args(["--doc", "--", "--quiet"]);
    let name = "examples of the documentation";
    if !examples
        .envs(environment.iter().copied())
        .status()?
        .success()
    {
        failed.push(name.to_owned());
    }
    suites.push(Suite::new(name, start));
    match failed.as_slice() {
        [] => Ok(()),
        failed => Err(format!("tests fail in\n  {}", failed.join("\n  ")).into()),
    }
}

/// Cargo's programs of tests, the GPU's first, then the laboratory's.
fn build(root: &Path) -> Result<VecDeque<Program>> {
    let mut cargo = workspace::cargo(root);
    cargo.arg("test").args(SELECTION);
    cargo.args(["--no-run", "--message-format", "json-render-diagnostics"]);
    let output = cargo.stderr(Stdio::inherit()).output()?;
    if !output.status.success() {
        return Err("tests do not compile".into());
    }
    let messages = String::from_utf8_lossy(&output.stdout);
    let programs = messages.lines().filter_map(Program::from_message);
    let mut programs: Vec<Program> = programs.collect();
    // The others end with those of the first names, which the second thread takes first: the library's own.
    programs.sort_by_key(|p| {
        let package = p.package();
        let [gpu, longest] = [package == GPU, p.source == LONGEST];
        let name = p.name();
        let reversed = (!gpu).then(|| Reverse(name.clone()));
        (!gpu, !longest, package != LABORATORY, reversed, name)
    });
    Ok(programs.into())
}

/// What a program printed and how it ended, or why it did not run.
pub(super) type Outcome = Result<(Vec<u8>, ExitStatus)>;

/// Runs programs from both ends of the queue, and prints what each printed when it has ended; the names of those that
/// failed.
///
/// * `admits`: whether one may begin still.
fn two_at_a_time(
    programs: VecDeque<Program>,
    admits: impl Fn(&Program) -> bool + Sync,
    run: impl Fn(&Program) -> (Suite, Outcome) + Sync,
    suites: &mut Vec<Suite>,
) -> Vec<String> {
    let queue = Mutex::new(programs);
    let ended = Mutex::new((Vec::new(), suites));
    let work = |take: fn(&mut VecDeque<Program>) -> Option<Program>| {
        loop {
            let Some(program) = take(&mut lock(&queue)) else {
                return;
            };
            if !admits(&program) {
                continue;
            }
            let (suite, outcome) = run(&program);
            let mut ended = lock(&ended);
            if !told(&program, outcome) {
                ended.0.push(program.name());
            }
            ended.1.push(suite);
        }
    };
    std::thread::scope(|scope| {
        scope.spawn(|| work(VecDeque::pop_front));
        work(VecDeque::pop_back);
    });
    ended.into_inner().unwrap_or_else(PoisonError::into_inner).0
}

pub(super) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Prints a program's output; whether it passed.
fn told(program: &Program, outcome: Outcome) -> bool {
    let name = program.name();
    println!("     Running {name} ({})", program.executable.display());
    match outcome {
        Ok((printed, status)) => {
            let _ = std::io::stdout().write_all(&printed);
            if !status.success() {
                println!("{name} failed: {status}");
            }
            status.success()
        }
        Err(error) => {
            println!("{name} did not run: {error}");
            false
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(package: &str, test: bool) -> String {
        format!(
            r#"{{"reason":"compiler-artifact","manifest_path":"/w/crates/{package}/Cargo.toml",
            "target":{{"src_path":"/w/crates/{package}/tests/a.rs"}},"profile":{{"test":{test}}},
            "executable":"/w/target/debug/deps/a-12"}}"#
        )
        .replace('\n', "")
    }

    #[test]
    fn programs_are_read_from_cargos_messages() {
        let program = Program::from_message(&message("specula-bsdf", true)).unwrap();
        assert_eq!(program.name(), "specula-bsdf tests/a.rs");
        assert_eq!(program.folder, Path::new("/w/crates/specula-bsdf"));
        assert_eq!(program.executable, Path::new("/w/target/debug/deps/a-12"));
        assert_eq!(Program::from_message(&message("specula", false)), None);
        assert_eq!(
            Program::from_message(r#"{"reason":"build-finished"}"#),
            None
        );
        assert_eq!(Program::from_message("no JSON"), None);
    }

    #[test]
    fn each_runs_once_and_those_that_fail_are_named() {
        let packages = ["specula-gpu", "a", "late", "b", "c"];
        let programs = packages.map(|p| Program::from_message(&message(p, true)).unwrap());
        let mut suites = Vec::new();
        let failed = two_at_a_time(
            programs.into(),
            |program| program.package() != "late",
            |program| {
                let outcome = match program.package() == "b" {
                    true => Err("no such file".into()),
                    false => Ok((Vec::new(), ExitStatus::default())),
                };
                (Suite::new(&program.name(), Instant::now()), outcome)
            },
            &mut suites,
        );
        assert_eq!(failed, ["b tests/a.rs"]);
        assert_eq!(suites.len(), packages.len() - 1);
    }

    #[test]
    #[cfg(unix)]
    fn what_a_program_prints_is_kept_in_order() {
        let folder = std::env::temp_dir();
        let script = folder.join(format!("specula-program-{}.sh", std::process::id()));
        let text = "#!/bin/sh\necho one; echo two $WORD >&2; echo three; exit 3\n";
        std::fs::write(&script, text).unwrap();
        let run = std::os::unix::fs::PermissionsExt::from_mode(0o755);
        std::fs::set_permissions(&script, run).unwrap();
        let program = Program {
            folder,
            source: String::new(),
            executable: script.clone(),
        };
        let (printed, status) = program.run(&[("WORD", "more")]).unwrap();
        std::fs::remove_file(script).unwrap();
        assert_eq!(printed, b"one\ntwo more\nthree\n");
        assert_eq!(status.code(), Some(3));
    }
}
