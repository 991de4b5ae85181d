//! Runs experiments one after another, each into a folder of its own.

use std::fs;
use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use crate::{
    Experiment, Lab, LabError, Machine, Progress, Quality, Record, Result, Source, Verdict,
};

/// Options of [`run`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RunOptions {
    /// How much work.
    pub quality: Quality,
    /// Seed of all random numbers.
    pub seed: u64,
}

/// An event during [`run`].
#[derive(Clone, Debug)]
pub enum RunEvent<'a> {
    /// An experiment begins: the so-many-th of so many.
    Began(&'a Experiment, usize, usize),
    /// It goes on.
    Step(&'a Experiment, Progress),
    /// It is done.
    Done(&'a Experiment, &'a Record),
}

/// Runs experiments; their records, in order. Files go to `folder/ID`, which is replaced when the
/// experiment is done, not before.
///
/// # Errors
///
/// The first experiment's that fails, or [`LabError::Stopped`]; what was done before is written.
pub fn run(
    experiments: &[&Experiment],
    options: RunOptions,
    folder: &Path,
    stop: &AtomicBool,
    events: &(dyn Fn(RunEvent<'_>) + Sync),
) -> Result<Vec<Record>> {
    fs::create_dir_all(folder).map_err(LabError::io(folder))?;
    let mut records = Vec::new();
    for (i, experiment) in experiments.iter().enumerate() {
        events(RunEvent::Began(experiment, i, experiments.len()));
        let record = run_one(experiment, options, folder, stop, events)?;
        events(RunEvent::Done(experiment, &record));
        records.push(record);
    }
    Ok(records)
}

fn run_one(
    experiment: &Experiment,
    options: RunOptions,
    folder: &Path,
    stop: &AtomicBool,
    events: &(dyn Fn(RunEvent<'_>) + Sync),
) -> Result<Record> {
    let subject = Subject {
        id: experiment.id.to_owned(),
        source: experiment.source,
        item: experiment.item.to_owned(),
        title: experiment.title.to_owned(),
        statement: experiment.statement.to_owned(),
        command: format!(
            "specula lab run {} --quality {}",
            experiment.id,
            options.quality.name()
        ),
    };
    let progress = |p| events(RunEvent::Step(experiment, p));
    carry_out(subject, options, folder, stop, &progress, experiment.run)
}

/// The subject of a record.
pub(crate) struct Subject {
    pub(crate) id: String,
    pub(crate) source: Source,
    pub(crate) item: String,
    pub(crate) title: String,
    pub(crate) statement: String,
    pub(crate) command: String,
}

/// Measures, and writes the results to `folder/ID`, whole or not at all.
///
/// # Errors
///
/// That of the measurement, or where a file cannot be written.
pub(crate) fn carry_out(
    subject: Subject,
    options: RunOptions,
    folder: &Path,
    stop: &AtomicBool,
    progress: &(dyn Fn(Progress) + Sync),
    measure: impl FnOnce(&mut Lab<'_>) -> Result<Verdict>,
) -> Result<Record> {
    let place = folder.join(&subject.id);
    let unfinished = folder.join(format!(".{}.unfinished", subject.id));
    remove(&unfinished)?;
    fs::create_dir_all(&unfinished).map_err(LabError::io(&unfinished))?;
    let mut lab = Lab::new(options.quality, options.seed, &unfinished, stop, progress);
    let begin = Instant::now();
    let verdict = match measure(&mut lab) {
        Ok(verdict) => verdict,
        Err(error) => {
            remove(&unfinished)?;
            return Err(error);
        }
    };
    let record = Record {
        id: subject.id,
        source: subject.source,
        item: subject.item,
        title: subject.title,
        statement: subject.statement,
        command: subject.command,
        quality: options.quality,
        seed: options.seed,
        version: env!("CARGO_PKG_VERSION").to_owned(),
        machine: Machine::here(),
        seconds: begin.elapsed().as_secs_f64(),
        outcome: verdict.outcome(),
        verdict,
        tables: lab.tables,
        plots: lab.plots,
        comparisons: lab.comparisons,
    };
    record.write(&unfinished)?;
    remove(&place)?;
    fs::rename(&unfinished, &place).map_err(LabError::io(&place))?;
    Ok(record)
}

/// Removes a folder of Specula's, where it is there.
fn remove(folder: &Path) -> Result<()> {
    match fs::remove_dir_all(folder) {
        Err(e) if e.kind() != std::io::ErrorKind::NotFound => Err(LabError::io(folder)(e)),
        _ => Ok(()),
    }
}
