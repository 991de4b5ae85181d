//! `specula merge`.

use crate::cli::ExitCode;
use std::path::{Path, PathBuf};

use crate::render::{FilmBuffer, FilmFile, FilmFileError, Label};

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
        arguments.display.choice(false),
        &inputs,
    )?;
    let (film, label) = sum(&arguments.films)?;
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

/// The sum of films, with the label of all. It holds two of them at a time, however many there are.
fn sum(films: &[PathBuf]) -> Result<(FilmBuffer, Label), Failure> {
    let mut heads = Vec::new();
    for path in films {
        let head = FilmFile::read_head(path).map_err(|e| unreadable(path, &e))?;
        heads.push((path.as_path(), head));
    }
    // In the order of their samples, so that adjoining films stay one range.
    heads.sort_by_key(|(_, head)| head.first_sample);
    let mut heads = heads.into_iter();
    let Some((first, head)) = heads.next() else {
        return Err(Failure::bad_input("no films"));
    };
    let others: Vec<_> = heads.collect();
    for (path, other) in &others {
        if let Some(difference) = head.label.difference(&other.label) {
            return Err(Failure::bad_input(format_args!(
                "'{}' and '{}' are not parts of one render: {difference}",
                first.display(),
                path.display()
            )));
        }
    }
    let FilmFile {
        mut label,
        mut film,
    } = read(first)?;
    for (path, _) in others {
        let other = read(path)?;
        film.merge(&other.film).map_err(|e| {
            let name = path.display();
            Failure::bad_input(format_args!("cannot add '{name}' to those before it: {e}"))
        })?;
        label.seconds += other.label.seconds;
    }
    Ok((film, label))
}

fn read(path: &Path) -> Result<FilmFile, Failure> {
    FilmFile::read(path).map_err(|e| unreadable(path, &e))
}

fn unreadable(path: &Path, error: &FilmFileError) -> Failure {
    Failure::bad_input(format_args!("cannot read '{}': {error}", path.display()))
}

fn ranges(samples: &[[u32; 2]]) -> String {
    let ranges: Vec<String> = samples
        .iter()
        .map(|[from, to]| format!("{from}..{to}"))
        .collect();
    ranges.join(", ")
}
