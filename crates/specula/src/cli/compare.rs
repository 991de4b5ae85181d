//! `specula compare`.

use crate::cli::ExitCode;
use std::path::Path;

use crate::render::picture::{self, Comparison, Picture, PictureError};

use super::arguments::{CompareArguments, MetricName};
use super::console::say;
use super::file_id::Inputs;
use super::outputs::refuse_input;
use super::{Failure, print};

/// Prints the distances; code 1 where the chosen one is above the limit.
pub(crate) fn run(arguments: &CompareArguments) -> Result<ExitCode, Failure> {
    if let Some(path) = &arguments.diff {
        refuse_input(path, &Inputs::new([&arguments.reference, &arguments.test]))?;
    }
    let reference = read(&arguments.reference)?;
    let test = read(&arguments.test)?;
    let comparison = picture::compare(&reference, &test).map_err(Failure::bad_input)?;
    print(&describe(&comparison))?;
    if let Some(path) = &arguments.diff {
        let pixels = picture::difference_rgb8(&comparison.flip_map);
        picture::write_rgb8(path, reference.width, reference.height, &pixels)
            .map_err(|e| Failure::other(format_args!("cannot write the difference: {e}")))?;
    }
    let Some(limit) = arguments.fail_above else {
        return Ok(ExitCode::SUCCESS);
    };
    let value = metric(&comparison, arguments.metric);
    if value > limit || value.is_nan() {
        say!("{} is {value:.6}, above {limit}", arguments.metric);
        return Ok(ExitCode::from(1));
    }
    Ok(ExitCode::SUCCESS)
}

fn read(path: &Path) -> Result<Picture, Failure> {
    picture::read_exr(path).map_err(|e: PictureError| Failure::bad_input(e))
}

fn metric(c: &Comparison, name: MetricName) -> f64 {
    match name {
        MetricName::HdrFlip => c.hdr_flip,
        MetricName::Flip => c.flip,
        MetricName::Rmse => c.rmse,
        MetricName::RelMse => c.rel_mse,
        MetricName::Mae => c.mae,
    }
}

fn describe(c: &Comparison) -> String {
    let psnr = if c.psnr_db.is_finite() {
        format!("{:.2} dB", c.psnr_db)
    } else {
        "infinite".to_owned()
    };
    let mut text = format!(
        "RMSE      {:.6}\nrelMSE    {:.6}\nMAE       {:.6}\n\
         bias      {:+.6} ({:+.3} % of the reference)\nmaximum   {:.6}\nPSNR      {psnr} as displayed\n\
         FLIP      {:.6} as displayed\nHDR-FLIP  {:.6}\n",
        c.rmse,
        c.rel_mse,
        c.mae,
        c.bias,
        100.0 * c.rel_bias,
        c.max_difference,
        c.flip,
        c.hdr_flip
    );
    if c.skipped > 0 {
        text += &format!(
            "{} pixels are not finite in one of the two and were left out of all but FLIP\n",
            c.skipped
        );
    }
    text
}
