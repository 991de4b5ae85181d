//! `specula lab`: what its commands share, and those that measure nothing.

mod arguments;
mod compare;
mod fit;
mod material;
mod run;
mod tabulate;

use crate::cli::ExitCode;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::sync::{Mutex, PoisonError};

use crate::lab::report::{LARGE, Page};
use crate::lab::{Experiment, LabError, Outcome, Record, Source, experiments, publish, report};
use serde_json::json;

use super::console::say;
use super::file_id::FileId;
use super::progress::Progress;
use super::stop::StopFlag;
use super::{Failure, machine, print};
use arguments::{EffortArguments, LabCommand, ListArguments, RecordArguments};

pub(crate) use arguments::LabArguments;

/// Runs the command that was asked for.
pub(crate) fn run(arguments: &LabArguments) -> Result<ExitCode, Failure> {
    match &arguments.command {
        LabCommand::List(a) => {
            print(&list(a))?;
            Ok(ExitCode::SUCCESS)
        }
        LabCommand::Run(a) => run::run(a),
        LabCommand::Report(a) => {
            if let Some(to) = &a.markdown {
                refuse_results(to, &a.folder)?;
            }
            write_page(&a.folder)?;
            if let Some(to) = &a.markdown {
                folder(to)?;
                publish(&a.folder, to).map_err(failure)?;
                say!("wrote {}", to.join("README.md").display());
            }
            Ok(ExitCode::SUCCESS)
        }
        LabCommand::Compare(a) => compare::run(a),
        LabCommand::Material(a) => material::run(a),
        LabCommand::Tabulate(a) => tabulate::run(a),
        LabCommand::Fit(a) => fit::run(a),
    }
}

/// Fails where Markdown would take the place of the results that it is about.
fn refuse_results(markdown: &Path, results: &Path) -> Result<(), Failure> {
    let target = FileId::of(markdown);
    let above = results.join("..");
    let is_same =
        |folder: &Path| matches!((FileId::of(folder), &target), (Ok(a), Ok(b)) if a == *b);
    if is_same(results) || is_same(&above) {
        return Err(Failure::bad_input(format_args!(
            "--markdown {}: the pages would take the place of the results; expected another folder",
            markdown.display()
        )));
    }
    Ok(())
}

/// Every experiment on a line.
fn list(arguments: &ListArguments) -> String {
    if arguments.json {
        let line = |e: &Experiment| {
            let line = json!({
                "id": e.id,
                "source": e.source.cite(),
                "item": e.item,
                "title": e.title,
                "statement": e.statement,
            });
            format!("{line}\n")
        };
        return experiments::ALL.iter().map(line).collect();
    }
    let width = |of: fn(&Experiment) -> usize| experiments::ALL.iter().map(of).max().unwrap_or(0);
    let (ids, items) = (width(|e| e.id.len()), width(|e| e.item.len()));
    let mut text = String::new();
    let mut source = None;
    for e in experiments::ALL {
        if source != Some(e.source) {
            source = Some(e.source);
            text += &format!("\n{}\n", e.source.cite());
        }
        text += &format!("  {:ids$}  {:items$}  {}\n", e.id, e.item, e.title);
    }
    text
}

/// The folder that results go to, made where there is none.
pub(crate) fn folder(path: &Path) -> Result<(), Failure> {
    let name = path.display();
    if path.exists() && !path.is_dir() {
        let message = format!("'{name}' is a file; the results need a folder");
        return Err(Failure::bad_input(message));
    }
    std::fs::create_dir_all(path).map_err(|e: io::Error| {
        Failure::other(format_args!("cannot make the folder '{name}': {e}"))
    })
}

/// The page about a folder, which is then named.
pub(crate) fn write_page(folder: &Path) -> Result<(), Failure> {
    if !folder.is_dir() {
        let message = format!("'{}' is no folder with results", folder.display());
        return Err(Failure::bad_input(message));
    }
    announce(&report::write(folder).map_err(failure)?);
    Ok(())
}

/// Names a page that was written.
pub(crate) fn announce(page: &Page) {
    say!("wrote {}", page.path.display());
    if page.bytes > LARGE {
        say!(
            "note: the page has {} MB and opens slowly; pictures of draft quality are smaller",
            page.bytes >> 20
        );
    }
}

/// An error with its exit code.
pub(crate) fn failure(error: LabError) -> Failure {
    match error {
        LabError::UnknownExperiment { .. }
        | LabError::NoResults(_)
        | LabError::NotAResult { .. }
        | LabError::Material(_)
        | LabError::Prepare(_) => Failure::bad_input(error),
        other => Failure::other(other),
    }
}

/// How a result came out, in a line or two.
pub(crate) fn line(record: &Record) -> String {
    let outcome = match (record.source, record.outcome) {
        (Source::Specula, Outcome::Reproduced) => "holds",
        (Source::Specula, Outcome::NotReproduced) => "does not hold",
        (_, outcome) => outcome.name(),
    };
    format!("{}: {outcome}. {}\n", record.id, record.verdict.summary)
}

/// What the machine does for a command, and how it is stopped.
pub(crate) struct Desk {
    stop: StopFlag,
    progress: Mutex<Progress>,
    pool: rayon::ThreadPool,
}

impl Desk {
    /// Listens for Ctrl-C from now on.
    pub(crate) fn new(effort: &EffortArguments) -> Result<Self, Failure> {
        Ok(Self {
            pool: machine::pool(machine::count(effort.threads), false)?,
            stop: StopFlag::listen("stopping; what is finished is saved")?,
            progress: Mutex::new(Progress::new(effort.quiet)),
        })
    }

    /// The flag that the first signal sets.
    pub(crate) fn stop(&self) -> &AtomicBool {
        &self.stop.asked
    }

    /// Names the signal that ended the work, and `what` of it there is; returns the exit code.
    pub(crate) fn stopped(&self, what: &str) -> ExitCode {
        let signal = self.stop.signal();
        say!("stopped by {}: {what}", signal.name());
        ExitCode::from(signal.exit_code())
    }

    /// Works with its threads.
    pub(crate) fn work<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        self.pool.install(work)
    }

    /// Shows how far it is.
    pub(crate) fn tell(&self, share: f64, what: &str) {
        self.locked().tell(share, what);
    }

    /// Prints a result.
    pub(crate) fn print(&self, text: &str) -> Result<(), Failure> {
        self.locked().aside(|| print(text))
    }

    /// Takes the bar away.
    pub(crate) fn finish(&self) {
        self.locked().finish();
    }

    fn locked(&self) -> std::sync::MutexGuard<'_, Progress> {
        self.progress.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The command as it was typed, to be typed again.
pub(crate) fn command_line() -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_=.,:/+".contains(c);
    let quoted = |word: String| {
        if !word.is_empty() && word.chars().all(is_plain) {
            word
        } else {
            format!("'{}'", word.replace('\'', r"'\''"))
        }
    };
    let words = super::given().map(quoted);
    let all: Vec<String> = std::iter::once("specula".to_owned()).chain(words).collect();
    all.join(" ")
}

/// Makes one record, and writes its page alone, or its files and the page about their folder.
///
/// * `measure`: makes the record in a folder.
pub(crate) fn one_record(
    arguments: &RecordArguments,
    measure: &(dyn Fn(&Path, &Desk) -> crate::lab::Result<Record> + Sync),
) -> Result<ExitCode, Failure> {
    let output = &arguments.output;
    let desk = Desk::new(&arguments.effort)?;
    // Whether it was finished.
    let finished = |place: &Path| {
        let result = desk.work(|| measure(place, &desk));
        desk.finish();
        match result {
            Ok(record) => desk.print(&line(&record)).map(|()| true),
            Err(LabError::Stopped) => Ok(false),
            Err(error) => Err(failure(error)),
        }
    };
    let done = if is_page(output) {
        let (temporary, place) = scratch(output)?;
        let done = finished(&place)?;
        if done {
            announce(&report::write_to(&place, output).map_err(failure)?);
        }
        drop(temporary);
        done
    } else {
        folder(output)?;
        let done = finished(output)?;
        if done {
            write_page(output)?;
        }
        done
    };
    if done {
        Ok(ExitCode::SUCCESS)
    } else {
        Ok(desk.stopped("nothing is written"))
    }
}

/// Whether a path names a page.
pub(crate) fn is_page(path: &Path) -> bool {
    let end = path.extension();
    end.is_some_and(|e| e.eq_ignore_ascii_case("html") || e.eq_ignore_ascii_case("htm"))
}

/// A temporary folder.
pub(crate) fn scratch(page: &Path) -> Result<(tempfile::TempDir, PathBuf), Failure> {
    let parent = match page.parent() {
        Some(p) if !p.as_os_str().is_empty() => p.to_owned(),
        _ => PathBuf::from("."),
    };
    let cannot =
        |e: io::Error| Failure::bad_input(format_args!("cannot write '{}': {e}", page.display()));
    // Where the page goes, a fault is to be found before the work is done.
    let folder = tempfile::Builder::new()
        .prefix(".specula-lab-")
        .tempdir_in(&parent)
        .map_err(cannot)?;
    let path = folder.path().to_owned();
    Ok((folder, path))
}
