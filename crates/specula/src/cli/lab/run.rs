//! `specula lab run`.

use crate::cli::ExitCode;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use crate::lab::report::read;
use crate::lab::{LabError, RunEvent, RunOptions, experiments};

use super::super::Failure;
use super::arguments::RunArguments;
use super::{Desk, failure, folder, line, write_page};

/// Runs experiments; the page is written in the end, after Ctrl-C too.
pub(crate) fn run(arguments: &RunArguments) -> Result<ExitCode, Failure> {
    let chosen = experiments::named(&arguments.ids).map_err(failure)?;
    folder(&arguments.output)?;
    let desk = Desk::new(&arguments.effort)?;
    let options = RunOptions {
        quality: arguments.quality.into(),
        seed: arguments.effort.seed,
    };
    let (done, all) = (AtomicUsize::new(0), chosen.len() as f64);
    let show = |share: f64, what: &str| {
        let before = done.load(Ordering::Relaxed) as f64;
        desk.tell((before + share) / all, what);
    };
    let unprinted = Mutex::new(None);
    let events = |event: RunEvent<'_>| match event {
        RunEvent::Began(e, ..) => show(0.0, e.id),
        RunEvent::Step(e, p) => show(p.share.clamp(0.0, 1.0), &format!("{}: {}", e.id, p.what)),
        RunEvent::Done(_, record) => {
            done.fetch_add(1, Ordering::Relaxed);
            if let Err(failure) = desk.print(&line(record)) {
                unprinted
                    .lock()
                    .unwrap_or_else(PoisonError::into_inner)
                    .get_or_insert(failure);
            }
        }
    };
    let output = &arguments.output;
    let result = desk.work(|| crate::lab::run(&chosen, options, output, desk.stop(), &events));
    desk.finish();
    match result {
        Ok(_) => write_page(output)?,
        Err(LabError::Stopped) => {
            let finished = done.load(Ordering::Relaxed);
            // Earlier results may be there.
            match read(output) {
                Err(LabError::NoResults(_)) => {}
                _ => write_page(output)?,
            }
            let what = format!("{finished} of {all} experiments are finished");
            return Ok(desk.stopped(&what));
        }
        Err(error) => return Err(failure(error)),
    }
    match unprinted
        .into_inner()
        .unwrap_or_else(PoisonError::into_inner)
    {
        Some(failure) => Err(failure),
        None => Ok(ExitCode::SUCCESS),
    }
}
