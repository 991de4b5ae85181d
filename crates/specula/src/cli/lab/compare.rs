//! `specula lab compare`.

use crate::cli::ExitCode;

use crate::bsdf::vndf::Sampler;
use crate::lab::compare::{self, CompareOptions};
use crate::lab::{LabError, Progress};
use crate::render::RenderOptions;
use crate::render::picture::{PictureError, read_exr};
use crate::scene::Energy;

use super::super::file_id::Inputs;
use super::super::{Failure, load};
use super::arguments::LabCompareArguments;
use super::{Desk, command_line, failure, folder, line, write_page};

/// Renders all combinations and says which sampler to take.
pub(crate) fn run(arguments: &LabCompareArguments) -> Result<ExitCode, Failure> {
    let samplers: Vec<Sampler> = distinct(arguments.samplers.iter().map(|s| (*s).into()));
    let energies: Vec<Energy> = distinct(arguments.energy.iter().copied());
    if arguments.reference.is_some() && energies.len() > 1 {
        return Err(Failure::bad_input(
            "--reference goes with one treatment of energy: each converges to a picture of its own",
        ));
    }
    let reference = arguments
        .reference
        .as_ref()
        .map(|path| read_exr(path).map_err(|e: PictureError| Failure::bad_input(e)))
        .transpose()?;
    let loading = arguments.loading.options(&arguments.parameters);
    let mut named = load::scene(arguments.scene.as_deref(), &loading)?;
    if !arguments.effort.quiet {
        load::print_warnings(&named.warnings);
    }
    if let Some(kind) = arguments.material {
        named.scene.replace_materials(kind);
    }
    let inputs = Inputs::new(named.files.iter().chain(&arguments.reference));
    let result = arguments.output.join(compare::id(&named.name));
    if let Some(input) = inputs.inside(&result) {
        return Err(Failure::bad_input(format_args!(
            "the result would take the place of '{}', where the scene reads '{}'. Name another folder \
             with -o",
            result.display(),
            input.display()
        )));
    }
    folder(&arguments.output)?;
    let desk = Desk::new(&arguments.effort)?;
    let mut render = RenderOptions {
        resolution: arguments.resolution,
        crop: arguments.crop,
        ..RenderOptions::from_scene(&named.scene)
    };
    if let Some(depth) = arguments.max_depth {
        render.max_depth = depth;
    }
    let options = CompareOptions {
        scene: &named.scene,
        name: &named.name,
        samplers,
        energies,
        seconds: arguments.time.as_secs_f64(),
        reference,
        render,
        exposure_stops: arguments.exposure,
        seed: arguments.effort.seed,
        command: command_line(),
    };
    let progress = |p: Progress| desk.tell(p.share, &p.what);
    let result = desk.work(|| compare::run(&options, &arguments.output, desk.stop(), &progress));
    desk.finish();
    match result {
        Ok(record) => {
            let printed = desk.print(&line(&record));
            write_page(&arguments.output)?;
            printed?;
            Ok(ExitCode::SUCCESS)
        }
        Err(LabError::Stopped) => Ok(desk.stopped("nothing is written")),
        Err(LabError::Picture(error)) if arguments.reference.is_some() => {
            Err(Failure::bad_input(format_args!("--reference: {error}")))
        }
        Err(error) => Err(failure(error)),
    }
}

/// Each once, in their order.
fn distinct<T: PartialEq>(all: impl Iterator<Item = T>) -> Vec<T> {
    let mut unique = Vec::new();
    for one in all {
        if !unique.contains(&one) {
            unique.push(one);
        }
    }
    unique
}
