//! `specula convert`.

use crate::cli::ExitCode;

use crate::scene::write_pbrt::{assets_folder, write_pbrt};

use super::arguments::ConvertArguments;
use super::console::say;
use super::file_id::Inputs;
use super::outputs::refuse_input;
use super::{Failure, load};

/// Writes a scene in another format, and says what that format cannot hold.
pub(crate) fn run(arguments: &ConvertArguments) -> Result<ExitCode, Failure> {
    let (from, to) = (&arguments.scene, &arguments.output);
    // Before reading, which may take long.
    refuse_input(to, &Inputs::new([from]))?;
    let options = arguments.loading.options(&arguments.parameters);
    let named = load::scene(Some(from), &options)?;
    load::print_warnings(&named.warnings);
    let inputs = Inputs::new(named.files);
    refuse_input(to, &inputs)?;
    let assets = assets_folder(to);
    if let Some(input) = inputs.inside(&assets) {
        return Err(Failure::bad_input(format_args!(
            "meshes and pictures would go into '{}', where the scene reads '{}'. Name another output",
            assets.display(),
            input.display()
        )));
    }
    let notes = write_pbrt(&named.scene, to).map_err(Failure::other)?;
    for note in notes {
        say!("note: {note}");
    }
    say!("wrote {}", to.display());
    Ok(ExitCode::SUCCESS)
}
