//! `specula gpu-report`.

use crate::cli::ExitCode;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

use crate::lab::gpu_report::{
    AdapterChoice, Gpu, GpuError, GpuReportOptions, GpuReportPart, gpu_report,
};
use crate::scene::atomic;
use clap::Args;

use super::console::say;
use super::device::Device;
use super::progress::Progress;
use super::stop::StopFlag;
use super::{Failure, print};

const GPU_REPORT_EXAMPLES: &str = "\
Examples:
  specula gpu-report
      everything about the best GPU, a few minutes on a card, to gpu-report/README.md
  specula gpu-report --device gpu:1 --part pictures,scenes -o second-card
      whether the second one's pictures are the processor's, and how fast it renders
  specula gpu-report --quick --scene kitchen.pbrt
      a short look, with a scene of yours

The part scenes tells --device auto whether this GPU is faster than the processor.

Needs a driver for Vulkan, Metal or Direct3D 12, and nothing else. What a GPU lacks is said in the report.

Exit codes: 0 done; 1 pictures differ from the processor's, or the GPU failed; 2 the arguments are wrong, or there is no
GPU; 130 stopped by Ctrl-C: the parts that were measured are written.";

#[derive(Args, Debug)]
#[command(after_help = GPU_REPORT_EXAMPLES)]
pub(crate) struct GpuReportArguments {
    /// Which GPU: gpu (the best one), gpu:INDEX, gpu:NAME
    #[arg(long, value_name = "DEVICE", default_value = "gpu", value_parser = device)]
    device: Device,

    /// Parts, separated by commas: pictures, samplers, furnace, depth, rays, scenes [default: all]
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    part: Vec<GpuReportPart>,

    /// Another scene to render. May be repeated
    #[arg(long, value_name = "FILE")]
    scene: Vec<PathBuf>,

    /// Few rounds of short runs, without the largest scene
    #[arg(long)]
    quick: bool,

    /// Folder for README.md, made where there is none
    #[arg(short, long, value_name = "DIR", default_value = "gpu-report")]
    output: PathBuf,

    /// Print the report and errors only
    #[arg(short, long)]
    quiet: bool,
}

fn device(text: &str) -> Result<Device, String> {
    match text.parse()? {
        Device::Gpu(which) => Ok(Device::Gpu(which)),
        _ => Err("expected gpu, gpu:INDEX or gpu:NAME (`specula devices` lists them)".to_owned()),
    }
}

/// Measures a GPU and writes the report.
pub(crate) fn run(arguments: &GpuReportArguments) -> Result<ExitCode, Failure> {
    for file in &arguments.scene {
        crate::scene::load(file).map_err(|e| Failure::bad_input(e.to_string()))?;
    }
    let gpu = open(&arguments.device)?;
    if !arguments.quiet {
        say!("measuring {}", gpu.adapter);
    }
    let options = GpuReportOptions {
        quick: arguments.quick,
        parts: arguments.part.clone(),
        scenes: arguments.scene.clone(),
        date: date(SystemTime::now()),
    };
    let stop = StopFlag::listen("stopping; what is finished is saved")?;
    let mut progress = Progress::new(arguments.quiet);
    let mut tell = |share: f64, what: &str| progress.tell(share, what);
    let report = gpu_report(&gpu, &options, &mut tell, &stop.asked).map_err(Failure::other);
    progress.finish();
    let report = report?;
    print(&report.text)?;
    write(&arguments.output, &report.text)?;
    #[cfg(feature = "gpu")]
    if let Some(time) = report.time_over_processor.filter(|_| report.agrees) {
        keep(&gpu, time);
    }
    if report.is_stopped {
        let signal = stop.signal();
        say!("stopped by {}", signal.name());
        return Ok(ExitCode::from(signal.exit_code()));
    }
    if !report.agrees {
        return Err(Failure::other(
            "pictures of the GPU differ from the processor's: see the report",
        ));
    }
    Ok(ExitCode::SUCCESS)
}

fn open(device: &Device) -> Result<Gpu, Failure> {
    let which = match device {
        Device::Gpu(Some(which)) => which,
        _ => "best",
    };
    let choice: AdapterChoice = match which.parse() {
        Ok(choice) => choice,
        Err(never) => match never {},
    };
    Gpu::open(&choice).map_err(|error| match error {
        GpuError::NoAdapter => Failure::bad_input(format_args!(
            "{error}; on Linux, the loader is the package libvulkan1 (Debian, Ubuntu) or vulkan-loader (Fedora), \
             and the driver comes with the card's"
        )),
        GpuError::NoSuchAdapter { .. } => Failure::bad_input(error),
        error => Failure::other(error),
    })
}

fn write(folder: &Path, text: &str) -> Result<(), Failure> {
    let path = folder.join("README.md");
    let failed = |e: std::io::Error| Failure::other(format_args!("{}: {e}", path.display()));
    std::fs::create_dir_all(folder).map_err(failed)?;
    atomic::replace(&path, |file| file.write_all(text.as_bytes())).map_err(failed)?;
    say!("wrote {}", path.display());
    Ok(())
}

/// Keeps what `--device auto` chooses by: of a GPU whose pictures agree. Where that cannot be written, the report stays good.
#[cfg(feature = "gpu")]
fn keep(gpu: &Gpu, time: f64) {
    use super::device::measured::{self, Measurement};
    use crate::gpu::AdapterKind;
    use crate::lab::Machine;
    if gpu.adapter.kind == AdapterKind::Software {
        return;
    }
    let measurement = Measurement::new(&gpu.adapter, &Machine::here(), time);
    match measured::keep(&measurement) {
        Ok(Some(_)) => say!("--device auto knows: {measurement} to equal error"),
        Ok(None) => {}
        Err(error) => say!("note: --device auto will not know of it: {error}"),
    }
}

/// The day in UTC, as 2026-11-26.
///
/// By the proleptic Gregorian calendar, years that begin in March: 400 of them have 146,097 days.
fn date(now: SystemTime) -> String {
    let seconds = now.duration_since(UNIX_EPOCH).map_or(0, |d| d.as_secs());
    // From 0000-03-01.
    let days = seconds / 86_400 + 719_468;
    let (era, day) = (days / 146_097, days % 146_097);
    let year = (day - day / 1460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let month = (5 * day + 2) / 153;
    let day = day - (153 * month + 2) / 5 + 1;
    let (month, next) = if month < 10 {
        (month + 3, 0)
    } else {
        (month - 9, 1)
    };
    format!("{:04}-{month:02}-{day:02}", 400 * era + year + next)
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    #[test]
    fn days_have_their_dates() {
        for (seconds, expected) in [
            (0, "1970-01-01"),
            (951_782_399, "2000-02-28"),
            (951_782_400, "2000-02-29"),
            (1_709_251_200, "2024-03-01"),
            (1_795_651_200, "2026-11-26"),
            (4_107_542_399, "2100-02-28"),
            (4_107_542_400, "2100-03-01"),
        ] {
            assert_eq!(date(UNIX_EPOCH + Duration::from_secs(seconds)), expected);
        }
    }
}
