//! `specula convert`.

use std::path::Path;
use std::process::ExitCode;

use specula::scene::write_pbrt::write_pbrt;

use super::arguments::ConvertArguments;
use super::{Failure, load};

/// Writes a scene in another format, and says what that format cannot hold.
pub(crate) fn run(arguments: &ConvertArguments) -> Result<ExitCode, Failure> {
    let (from, to) = (&arguments.scene, &arguments.output);
    if same_file(from, to) {
        return Err(Failure::bad_input(format!(
            "{} would be written over itself; expected another name",
            from.display()
        )));
    }
    let options = arguments.loading.options(&arguments.parameters);
    let named = load::scene(Some(from), &options)?;
    load::print_warnings(&named.warnings);
    let notes = write_pbrt(&named.scene, to).map_err(Failure::other)?;
    for note in notes {
        eprintln!("note: {note}");
    }
    eprintln!("wrote {}", to.display());
    Ok(ExitCode::SUCCESS)
}

fn same_file(a: &Path, b: &Path) -> bool {
    match (a.canonicalize(), b.canonicalize()) {
        (Ok(a), Ok(b)) => a == b,
        // One of them does not exist.
        _ => false,
    }
}
