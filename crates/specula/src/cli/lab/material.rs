//! `specula lab material`.

use crate::cli::ExitCode;
use std::path::Path;

use crate::lab::material::{self, MaterialOptions};
use crate::lab::{LabError, Progress, report};
use crate::scene::material_text::parse_material;

use super::super::Failure;
use super::arguments::MaterialArguments;
use super::{Desk, announce, failure, folder, is_page, line, scratch, write_page};

/// Measures a material, and writes its page or its files.
pub(crate) fn run(arguments: &MaterialArguments) -> Result<ExitCode, Failure> {
    let kind = parse_material(&arguments.text).map_err(Failure::bad_input)?;
    let options = MaterialOptions {
        text: &arguments.text,
        kind: &kind,
        quality: arguments.quality.into(),
        seed: arguments.effort.seed,
    };
    let output = &arguments.output;
    let desk = Desk::new(&arguments.effort)?;
    let done = if is_page(output) {
        let (temporary, place) = scratch(output)?;
        let done = measure(&options, &place, &desk)?;
        if done {
            announce(&report::write_to(&place, output).map_err(failure)?);
        }
        drop(temporary);
        done
    } else {
        folder(output)?;
        let done = measure(&options, output, &desk)?;
        if done {
            write_page(output)?;
        }
        done
    };
    if done {
        Ok(ExitCode::SUCCESS)
    } else {
        Ok(desk.stopped("nothing is written"))
    }
}

/// Whether it was finished.
fn measure(options: &MaterialOptions<'_>, place: &Path, desk: &Desk) -> Result<bool, Failure> {
    let progress = |p: Progress| desk.tell(p.share, &p.what);
    let result = desk.work(|| material::run(options, place, desk.stop(), &progress));
    desk.finish();
    match result {
        Ok(record) => {
            desk.print(&line(&record))?;
            Ok(true)
        }
        Err(LabError::Stopped) => Ok(false),
        Err(error) => Err(failure(error)),
    }
}
