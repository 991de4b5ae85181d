//! `specula lab tabulate`.

use crate::cli::ExitCode;
use std::io::{self, Write};

use crate::bsdf::measured::Resolution;
use crate::lab::material;
use crate::scene::material_text::parse_material;
use crate::scene::{atomic, measured};

use super::super::Failure;
use super::super::console::say;
use super::arguments::TabulateArguments;
use super::failure;

/// Writes a rough metal as a measured material.
pub(crate) fn run(arguments: &TabulateArguments) -> Result<ExitCode, Failure> {
    let kind = parse_material(&arguments.text).map_err(Failure::bad_input)?;
    let size = |n: u16| usize::from(n);
    let resolution = Resolution {
        theta: size(arguments.views),
        phi: size(arguments.views),
        normals: [size(arguments.normals); 2],
        colours: size(arguments.colours),
    };
    let path = &arguments.output;
    let bytes = if path
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("binary"))
    {
        material::merl(&kind).map_err(failure)?
    } else {
        let tables = material::tables(&kind, resolution).map_err(failure)?;
        measured::to_bytes(&tables, &arguments.text)
    };
    atomic::replace(path, |out| out.write_all(&bytes)).map_err(|e: io::Error| {
        Failure::other(format_args!("cannot write '{}': {e}", path.display()))
    })?;
    say!("wrote {}", path.display());
    Ok(ExitCode::SUCCESS)
}
