//! `specula lab material`.

use crate::cli::ExitCode;

use crate::lab::Progress;
use crate::lab::material::{self, MaterialOptions};
use crate::scene::material_text::parse_material;

use super::super::Failure;
use super::arguments::MaterialArguments;
use super::one_record;

/// Measures a material, and writes its page or its files.
pub(crate) fn run(arguments: &MaterialArguments) -> Result<ExitCode, Failure> {
    let kind = parse_material(&arguments.text).map_err(Failure::bad_input)?;
    let options = MaterialOptions {
        text: &arguments.text,
        kind: &kind,
        quality: arguments.record.quality.into(),
        seed: arguments.record.effort.seed,
    };
    one_record(&arguments.record, &|place, desk| {
        let progress = |p: Progress| desk.tell(p.share, &p.what);
        material::run(&options, place, desk.stop(), &progress)
    })
}
