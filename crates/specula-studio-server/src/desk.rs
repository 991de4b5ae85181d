//! Results of the laboratory, and the run that is under way, in a thread of its own.

mod status;

use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use serde_json::Value;
use specula_lab::{Experiment, LabError, RunEvent, RunOptions};

use status::{Running, Status};

/// What the end of the server waits for a run.
const GRACE: Duration = Duration::from_secs(3);

/// Results of this session and the run that is under way.
pub(crate) struct Desk {
    folder: tempfile::TempDir,
    status: Arc<Mutex<Status>>,
    run: Mutex<Option<Run>>,
}

/// A run that was begun.
struct Run {
    stop: Arc<AtomicBool>,
    thread: JoinHandle<()>,
}

impl Desk {
    /// With a temporary folder for results.
    pub(crate) fn new() -> io::Result<Self> {
        let folder = tempfile::Builder::new()
            .prefix("specula-studio-lab-")
            .tempdir()?;
        Ok(Self {
            folder,
            status: Arc::default(),
            run: Mutex::new(None),
        })
    }

    /// The folder of results.
    pub(crate) fn folder(&self) -> &Path {
        self.folder.path()
    }

    /// As pages see it.
    pub(crate) fn status(&self) -> Value {
        locked(&self.status).shown()
    }

    /// Begins a run; `false`: one is under way.
    pub(crate) fn start(
        &self,
        chosen: Vec<&'static Experiment>,
        options: RunOptions,
    ) -> io::Result<bool> {
        let mut run = locked(&self.run);
        let mut status = locked(&self.status);
        if status.running.is_some() {
            return Ok(false);
        }
        let stop = Arc::new(AtomicBool::new(false));
        let work = {
            let end = EndOfRun(Arc::clone(&self.status));
            let (folder, stop) = (self.folder.path().to_owned(), Arc::clone(&stop));
            let chosen = chosen.clone();
            move || {
                let work = Work {
                    folder: &folder,
                    status: &end.0,
                    stop: &stop,
                };
                work.run(&chosen, options);
            }
        };
        let thread = std::thread::Builder::new().name("laboratory".to_owned());
        status.running = Some(Running {
            id: chosen.first().map_or_else(String::new, |e| e.id.to_owned()),
            index: 1,
            count: chosen.len(),
            share: 0.0,
            what: String::new(),
            begun: Instant::now(),
        });
        status.error = None;
        // Where there is no thread, the work's end is dropped, and takes this lock.
        drop(status);
        *run = Some(Run {
            thread: thread.spawn(work)?,
            stop,
        });
        Ok(true)
    }

    /// Asks the run to end.
    pub(crate) fn stop(&self) {
        if let Some(run) = locked(&self.run).as_ref() {
            run.stop.store(true, Ordering::Relaxed);
        }
    }

    /// Ends the run that is under way, and waits for it a little.
    pub(crate) fn end(&self) {
        self.stop();
        let Some(run) = locked(&self.run).take() else {
            return;
        };
        let start = Instant::now();
        while !run.thread.is_finished() && start.elapsed() < GRACE {
            std::thread::sleep(Duration::from_millis(20));
        }
    }
}

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
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

/// What the thread of a run has.
struct Work<'a> {
    folder: &'a PathBuf,
    status: &'a Mutex<Status>,
    stop: &'a AtomicBool,
}

impl Work<'_> {
    fn run(&self, chosen: &[&'static Experiment], options: RunOptions) {
        let events = |event: RunEvent<'_>| self.show(event, chosen.len());
        let result = specula_lab::run(chosen, options, self.folder, self.stop, &events);
        let page = write_page(self.folder);
        let mut status = locked(self.status);
        status.has_report = matches!(page, Ok(true));
        status.error = match (result, page) {
            (Err(LabError::Stopped), _) => Some("stopped; what was finished is kept".to_owned()),
            (Err(error), _) | (_, Err(error)) => Some(error.to_string()),
            _ => None,
        };
        status.running = None;
    }

    /// Shows what happens.
    fn show(&self, event: RunEvent<'_>, count: usize) {
        let mut status = locked(self.status);
        if let RunEvent::Done(_, record) = event {
            status.add(record);
        }
        let Some(running) = &mut status.running else {
            return;
        };
        let count = count as f64;
        match event {
            RunEvent::Began(experiment, before, _) => {
                experiment.id.clone_into(&mut running.id);
                running.what.clear();
                running.index = before + 1;
                running.share = before as f64 / count;
            }
            RunEvent::Step(_, step) => {
                running.share = (running.index as f64 - 1.0 + step.share.clamp(0.0, 1.0)) / count;
                running.what = step.what;
            }
            RunEvent::Done(..) => running.share = running.index as f64 / count,
        }
    }
}

/// The page about all results of the session; whether there are any.
fn write_page(folder: &Path) -> Result<bool, LabError> {
    match specula_lab::report::write(folder) {
        Err(LabError::NoResults(_)) => Ok(false),
        written => written.map(|_| true),
    }
}
