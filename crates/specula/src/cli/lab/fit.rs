//! `specula lab fit`.

use crate::cli::ExitCode;

use crate::lab::Progress;
use crate::lab::fit::{self, FitOptions};
use crate::scene::measured;

use super::super::Failure;
use super::arguments::FitArguments;
use super::one_record;

/// Fits rough metals to a measurement, and writes the page or the files.
pub(crate) fn run(arguments: &FitArguments) -> Result<ExitCode, Failure> {
    let path = &arguments.file;
    let wrong =
        |e: &dyn std::fmt::Display| Failure::bad_input(format_args!("{}: {e}", path.display()));
    let tables = measured::read_tables(path).map_err(|e| wrong(&e))?;
    let name = path.file_name().map(|n| n.to_string_lossy().into_owned());
    let name = name.unwrap_or_default();
    let options = FitOptions {
        name: &name,
        tables: &tables,
        distributions: &all(&arguments.distributions),
        bounces: &all(&arguments.bounces),
        fresnel: &all(&arguments.fresnel),
        quality: arguments.record.quality.into(),
        seed: arguments.record.effort.seed,
    };
    one_record(&arguments.record, &|place, desk| {
        let progress = |p: Progress| desk.tell(p.share, &p.what);
        fit::run(&options, place, desk.stop(), &progress)
    })
}

/// What names stand for, each once.
fn all<N: Copy + Into<T>, T: PartialEq>(names: &[N]) -> Vec<T> {
    let mut all: Vec<T> = Vec::new();
    for name in names {
        let one = (*name).into();
        if !all.contains(&one) {
            all.push(one);
        }
    }
    all
}
