//! `specula merge`.

use crate::cli::ExitCode;
use std::path::Path;

use crate::render::FilmFile;

use super::Failure;
use super::arguments::MergeArguments;
use super::console::say;
use super::file_id::Inputs;
use super::outputs::{self, Outputs};

/// Adds films of distinct samples; code 2 where they overlap or are of different renders.
pub(crate) fn run(arguments: &MergeArguments) -> Result<ExitCode, Failure> {
    let inputs = Inputs::new(&arguments.films);
    let outputs = Outputs::new(
        arguments.output.clone(),
        arguments.display.display(),
        &inputs,
    )?;
    let mut files = arguments
        .films
        .iter()
        .map(|path| Ok((path.as_path(), read(path)?)))
        .collect::<Result<Vec<_>, Failure>>()?;
    // In the order of their samples, so that adjoining films stay one range.
    files.sort_by_key(|(_, file)| file.film.first_sample());
    let mut files = files.into_iter();
    let Some((
        first_path,
        FilmFile {
            mut label,
            mut film,
        },
    )) = files.next()
    else {
        return Err(Failure::bad_input("no films"));
    };
    for (path, other) in files {
        let (a, b) = (first_path.display(), path.display());
        if let Some(difference) = label.difference(&other.label) {
            return Err(Failure::bad_input(format_args!(
                "'{a}' and '{b}' are not parts of one render: {difference}"
            )));
        }
        film.merge(&other.film).map_err(|e| {
            Failure::bad_input(format_args!("cannot add '{b}' to those before it: {e}"))
        })?;
        label.seconds += other.label.seconds;
    }
    let written = outputs.write_film(&film, &label);
    let metadata = outputs::metadata(&film, &label, None);
    Failure::join(written, outputs.write_pictures(&film, &metadata, false))?;
    if !arguments.quiet {
        say!(
            "wrote {}: {} spp of {} (samples {})",
            outputs.names(),
            film.complete_samples(),
            label.scene,
            ranges(&film.samples())
        );
    }
    Ok(ExitCode::SUCCESS)
}

fn read(path: &Path) -> Result<FilmFile, Failure> {
    FilmFile::read(path)
        .map_err(|e| Failure::bad_input(format_args!("cannot read '{}': {e}", path.display())))
}

fn ranges(samples: &[[u32; 2]]) -> String {
    let ranges: Vec<String> = samples
        .iter()
        .map(|[from, to]| format!("{from}..{to}"))
        .collect();
    ranges.join(", ")
}
