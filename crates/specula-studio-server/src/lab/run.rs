//! A run of experiments in a thread of its own.

use std::io;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use specula_lab::{Experiment, LabError, RunEvent, RunOptions};

use super::locked;
use super::status::{Running, Status};
use crate::shared::Shared;

/// What the end of the server waits for a run.
const GRACE: Duration = Duration::from_secs(3);

/// A run that was begun.
pub(super) struct Run {
    stop: Arc<AtomicBool>,
    thread: JoinHandle<()>,
}

impl Run {
    /// Begins.
    pub(super) fn start(
        shared: Arc<Shared>,
        chosen: Vec<&'static Experiment>,
        options: RunOptions,
    ) -> io::Result<Self> {
        let stop = Arc::new(AtomicBool::new(false));
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
        if status.running.take().is_some() {
            status.error =
                Some("the laboratory met a fault in Specula; its terminal says more".to_owned());
        }
    }
}

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
}
