//! A run of experiments in a thread of its own.

use std::io;
<<<<<<< HEAD
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use specula_lab::{Experiment, LabError, RunEvent, RunOptions};

use super::locked;
use super::status::{Running, Status};
=======
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use serde::Serialize;
use serde_json::Value;
use specula_lab::{Claim, Experiment, LabError, Outcome, Record, RunEvent, RunOptions};

>>>>>>> main
use crate::shared::Shared;

/// What the end of the server waits for a run.
const GRACE: Duration = Duration::from_secs(3);

/// A run that was begun.
pub(super) struct Run {
    stop: Arc<AtomicBool>,
<<<<<<< HEAD
    thread: JoinHandle<()>,
}

=======
    status: Arc<Mutex<Status>>,
    thread: JoinHandle<()>,
}

#[derive(Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
enum Phase {
    Running,
    Done,
    Stopped,
    Failed,
}

/// As pages see it.
#[derive(Serialize)]
struct Status {
    state: Phase,
    /// In `[0, 1]`.
    share: f64,
    /// What is being done.
    what: String,
    quality: &'static str,
    seed: u64,
    count: usize,
    results: Vec<Found>,
    /// `/lab/report/` shows the results.
    report: bool,
    error: Option<String>,
}

/// What an experiment has found.
#[derive(Serialize)]
struct Found {
    id: String,
    title: String,
    seconds: f64,
    outcome: Outcome,
    summary: String,
    caveat: String,
    claims: Vec<Claim>,
}

impl From<&Record> for Found {
    fn from(record: &Record) -> Self {
        Self {
            id: record.id.clone(),
            title: record.title.clone(),
            seconds: record.seconds,
            outcome: record.outcome,
            summary: record.verdict.summary.clone(),
            caveat: record.verdict.caveat.clone(),
            claims: record.verdict.claims.clone(),
        }
    }
}

>>>>>>> main
impl Run {
    /// Begins.
    pub(super) fn start(
        shared: Arc<Shared>,
        chosen: Vec<&'static Experiment>,
        options: RunOptions,
    ) -> io::Result<Self> {
        let stop = Arc::new(AtomicBool::new(false));
<<<<<<< HEAD
        let asked = Arc::clone(&stop);
        let running = Running {
            id: chosen.first().map_or_else(String::new, |e| e.id.to_owned()),
            index: 1,
            count: chosen.len(),
            share: 0.0,
            what: String::new(),
            begun: Instant::now(),
        };
        let status = Arc::clone(&shared.lab.status);
        {
            let mut status = locked(&status);
            status.running = Some(running);
            status.error = None;
        }
        let work = move || {
            let _end = EndOfRun(Arc::clone(&shared.lab.status));
            work(&shared, &chosen, options, &asked);
        };
        let thread = std::thread::Builder::new()
            .name("laboratory".to_owned())
            .spawn(work)
            .inspect_err(|_| locked(&status).running = None)?;
        Ok(Self { stop, thread })
=======
        let status = Arc::new(Mutex::new(Status {
            state: Phase::Running,
            share: 0.0,
            what: String::new(),
            quality: options.quality.name(),
            seed: options.seed,
            count: chosen.len(),
            results: Vec::new(),
            report: false,
            error: None,
        }));
        let work = {
            let (stop, status) = (Arc::clone(&stop), Arc::clone(&status));
            move || {
                let end = EndOfRun(Arc::clone(&status));
                work(&shared, &chosen, options, &stop, &status);
                std::mem::drop(end);
            }
        };
        let thread = std::thread::Builder::new()
            .name("laboratory".to_owned())
            .spawn(work)?;
        Ok(Self {
            stop,
            status,
            thread,
        })
    }

    pub(super) fn is_under_way(&self) -> bool {
        locked(&self.status).state == Phase::Running
    }

    pub(super) fn status(&self) -> Value {
        serde_json::to_value(&*locked(&self.status)).unwrap_or_default()
>>>>>>> main
    }

    pub(super) fn stop(&self) {
        self.stop.store(true, Ordering::Relaxed);
    }

    /// Stops, and waits a little for the end.
    pub(super) fn end(self) {
        self.stop();
        let start = Instant::now();
        while !self.thread.is_finished() && start.elapsed() < GRACE {
            std::thread::sleep(Duration::from_millis(20));
        }
    }
}

/// Sees to it that a run which panics does not look as if it went on.
struct EndOfRun(Arc<Mutex<Status>>);

impl Drop for EndOfRun {
    fn drop(&mut self) {
        let mut status = locked(&self.0);
<<<<<<< HEAD
        if status.running.take().is_some() {
=======
        if status.state == Phase::Running {
            status.state = Phase::Failed;
>>>>>>> main
            status.error =
                Some("the laboratory met a fault in Specula; its terminal says more".to_owned());
        }
    }
}

<<<<<<< HEAD
fn work(shared: &Shared, chosen: &[&'static Experiment], options: RunOptions, stop: &AtomicBool) {
    let (folder, status) = (shared.lab.folder.path(), &shared.lab.status);
    let events = |event: RunEvent<'_>| show(status, event, chosen.len());
    let result = shared
        .pool
        .install(|| specula_lab::run(chosen, options, folder, stop, &events));
    let page = write_page(folder);
    let mut status = locked(status);
    status.has_report = matches!(page, Ok(true));
    status.error = match (result, page) {
        (Err(LabError::Stopped), _) => Some("stopped; what was finished is kept".to_owned()),
        (Err(error), _) | (_, Err(error)) => Some(error.to_string()),
        _ => None,
    };
    status.running = None;
}

/// Shows what happens.
fn show(status: &Mutex<Status>, event: RunEvent<'_>, count: usize) {
    let mut status = locked(status);
    if let RunEvent::Done(_, record) = event {
        status.add(record);
    }
    let Some(running) = &mut status.running else {
        return;
    };
    match event {
        RunEvent::Began(experiment, before, _) => {
            experiment.id.clone_into(&mut running.id);
            running.what.clear();
            running.index = before + 1;
            running.share = before as f64 / count as f64;
        }
        RunEvent::Step(_, step) => {
            running.share =
                (running.index as f64 - 1.0 + step.share.clamp(0.0, 1.0)) / count as f64;
            running.what = step.what;
        }
        RunEvent::Done(..) => running.share = running.index as f64 / count as f64,
    }
}

/// The page about all results of the session; whether there are any.
fn write_page(folder: &Path) -> Result<bool, LabError> {
    match specula_lab::report::write(folder) {
        Err(LabError::NoResults(_)) => Ok(false),
        written => written.map(|_| true),
    }
=======
fn work(
    shared: &Shared,
    chosen: &[&'static Experiment],
    options: RunOptions,
    stop: &AtomicBool,
    status: &Mutex<Status>,
) {
    let folder = shared.lab.folder();
    let count = chosen.len() as f64;
    let events = |event: RunEvent<'_>| {
        let mut status = locked(status);
        let done = status.results.len() as f64;
        match event {
            RunEvent::Began(experiment, ..) => experiment.id.clone_into(&mut status.what),
            RunEvent::Step(experiment, step) => {
                status.share = (done + step.share.clamp(0.0, 1.0)) / count;
                status.what = format!("{}: {}", experiment.id, step.what);
            }
            RunEvent::Done(_, record) => {
                status.results.push(Found::from(record));
                status.share = (done + 1.0) / count;
            }
        }
    };
    let result = shared
        .pool
        .install(|| specula_lab::run(chosen, options, &folder, stop, &events));
    // Also of earlier runs.
    let page = match specula_lab::report::write(&folder) {
        Err(LabError::NoResults(_)) => Ok(false),
        written => written.map(|_| true),
    };
    let mut status = locked(status);
    status.report = matches!(page, Ok(true));
    let failed = |error: LabError| (Phase::Failed, Some(error.to_string()));
    (status.state, status.error) = match (result, page) {
        (Err(LabError::Stopped), _) => (Phase::Stopped, None),
        (Err(error), _) | (_, Err(error)) => failed(error),
        _ => (Phase::Done, None),
    };
}

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
>>>>>>> main
}
