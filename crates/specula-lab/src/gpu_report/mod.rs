//! A report about a GPU: whether it computes what the processor does, and how fast.
//!
//! Needs no toolchain and no network: scenes and shaders are in the program.

mod mesh;
mod rays;
mod renders;
mod samplers;
mod scenes;
mod sky;
mod text;

use std::fmt;
use std::path::PathBuf;
use std::str::FromStr;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use specula_gpu::AdapterKind;
pub use specula_gpu::{AdapterChoice, Gpu, GpuError};

use crate::{LabError, Machine};

/// What a part of the report returns.
type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// A part of the report.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GpuReportPart {
    /// Pictures of the same samples beside the processor's.
    Pictures,
    /// Samplers of visible normals (Dupuy and Benyoub 2023, section 4).
    Samplers,
    /// The white furnace (Tokuyoshi and Eto 2024, section 6).
    Furnace,
    /// What longer paths cost (Tokuyoshi and Eto 2024, table 3).
    Depth,
    /// Rays alone.
    Rays,
    /// Renders beside the processor's.
    Scenes,
}

impl GpuReportPart {
    /// All, by their names, in the order of the report, with the seconds that each takes a fast card.
    const TABLE: [(Self, &'static str, f64); 6] = [
        (Self::Pictures, "pictures", 15.0),
        (Self::Samplers, "samplers", 30.0),
        (Self::Furnace, "furnace", 20.0),
        (Self::Depth, "depth", 60.0),
        (Self::Rays, "rays", 10.0),
        (Self::Scenes, "scenes", 90.0),
    ];

    /// All, in the order of the report.
    pub const ALL: [Self; 6] = [
        Self::Pictures,
        Self::Samplers,
        Self::Furnace,
        Self::Depth,
        Self::Rays,
        Self::Scenes,
    ];

    fn entry(self) -> (Self, &'static str, f64) {
        let found = Self::TABLE.into_iter().find(|entry| entry.0 == self);
        found.unwrap_or(Self::TABLE[0])
    }
}

impl fmt::Display for GpuReportPart {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.entry().1)
    }
}

/// A name that no part has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected pictures, samplers, furnace, depth, rays or scenes")]
pub struct UnknownGpuReportPart;

impl FromStr for GpuReportPart {
    type Err = UnknownGpuReportPart;

    fn from_str(text: &str) -> std::result::Result<Self, UnknownGpuReportPart> {
        let found = Self::TABLE.iter().find(|entry| entry.1 == text);
        found.map(|entry| entry.0).ok_or(UnknownGpuReportPart)
    }
}

/// What to report.
#[derive(Clone, Debug, Default)]
pub struct GpuReportOptions {
    /// Few rounds of short runs.
    pub quick: bool,
    /// The parts; none: all.
    pub parts: Vec<GpuReportPart>,
    /// More scenes to render.
    pub scenes: Vec<PathBuf>,
    /// When it is made, as the report says it.
    pub date: String,
}

/// A report.
#[derive(Clone, Debug)]
pub struct GpuReport {
    /// Markdown.
    pub text: String,
    /// Whether all pictures agree with the processor's.
    pub agrees: bool,
    /// Whether it was stopped before its end.
    pub is_stopped: bool,
    /// Time to equal error over the processor's, by the defaults of a render: geometric mean over the scenes. `None`
    /// where [`GpuReportPart::Scenes`] was not measured.
    pub time_over_processor: Option<f64>,
}

/// What a part has measured.
struct Measured {
    text: String,
    /// Whether what it compares agrees.
    agrees: bool,
    /// As of [`GpuReport`].
    time_over_processor: Option<f64>,
}

impl Measured {
    /// A part that compares nothing.
    fn table(text: String) -> Self {
        Self {
            text,
            agrees: true,
            time_over_processor: None,
        }
    }
}

/// How much is measured.
struct Effort<'a> {
    /// Without the largest scene.
    quick: bool,
    /// Rounds of the tables of samplers.
    sample_rounds: usize,
    /// Rounds of the tables of renders.
    render_rounds: usize,
    /// Side of the pictures in pixels.
    side: u32,
    /// Least seconds of a render's pass; a run of a sampler lasts 0.1 s.
    seconds: f64,
    /// Whether to stop.
    stop: &'a AtomicBool,
}

impl<'a> Effort<'a> {
    fn new(quick: bool, stop: &'a AtomicBool) -> Self {
        match quick {
            true => Self {
                quick,
                sample_rounds: 5,
                render_rounds: 3,
                side: 64,
                seconds: 0.1,
                stop,
            },
            false => Self {
                quick,
                sample_rounds: 15,
                render_rounds: 5,
                side: 512,
                seconds: 0.4,
                stop,
            },
        }
    }

    /// Fails where the caller asked to stop: a part ends between two of its steps.
    fn go_on(&self) -> Result<()> {
        match self.stop.load(Ordering::Relaxed) {
            true => Err(LabError::Stopped.into()),
            false => Ok(()),
        }
    }
}

/// Measures.
///
/// A part that fails is left out, with the reason in its place.
///
/// * `tell`: is called with the share that is done, in [0, 1], and what comes next.
/// * `stop`: ends the report; what is measured by then stays.
///
/// # Errors
/// Where the device is lost.
pub fn gpu_report(
    gpu: &Gpu,
    options: &GpuReportOptions,
    tell: &mut dyn FnMut(f64, &str),
    stop: &AtomicBool,
) -> crate::Result<GpuReport> {
    let effort = Effort::new(options.quick, stop);
    let parts = match options.parts.as_slice() {
        [] => &GpuReportPart::ALL[..],
        parts => parts,
    };
    let whole: f64 = parts.iter().map(|part| part.entry().2).sum();
    let mut report = GpuReport {
        text: head(gpu, options),
        agrees: true,
        is_stopped: false,
        time_over_processor: None,
    };
    let mut done = 0.0;
    for part in parts {
        tell(done / whole, &part.to_string());
        let start = Instant::now();
        let measured = part.measure(gpu, &effort, &options.scenes);
        done += part.entry().2;
        match measured {
            Ok(measured) => {
                report.agrees &= measured.agrees;
                report.time_over_processor =
                    (measured.time_over_processor).or(report.time_over_processor);
                let seconds = start.elapsed().as_secs_f64();
                report.text += &format!(
                    "\n{}\n\nThis part took {seconds:.0} s.\n",
                    measured.text.trim_end()
                );
            }
            Err(_) if stop.load(Ordering::Relaxed) => {
                report.text += "\n**Stopped before its end.**\n";
                report.is_stopped = true;
                break;
            }
            Err(error) => {
                if let Some(lost @ GpuError::Lost(_)) = error.downcast_ref::<GpuError>() {
                    return Err(LabError::Gpu(lost.clone()));
                }
                report.agrees &= *part != GpuReportPart::Pictures;
                report.text += &format!("\n## {part}\n\nNot measured: {error}\n");
            }
        }
    }
    tell(1.0, "done");
    Ok(report)
}

impl GpuReportPart {
    fn measure(self, gpu: &Gpu, effort: &Effort<'_>, scenes: &[PathBuf]) -> Result<Measured> {
        effort.go_on()?;
        Ok(match self {
            Self::Pictures => renders::agreement(gpu, effort, scenes)?,
            Self::Samplers => Measured::table(samplers::normals(gpu, effort)?),
            Self::Furnace => Measured::table(samplers::furnace(gpu, effort)?),
            Self::Depth => Measured::table(renders::longest_paths(gpu, effort)?),
            Self::Rays => Measured::table(rays::rays(gpu, effort)?),
            Self::Scenes => renders::speeds(gpu, effort, scenes)?,
        })
    }
}

/// What is measured where.
fn head(gpu: &Gpu, options: &GpuReportOptions) -> String {
    let adapter = &gpu.adapter;
    let machine = Machine::here();
    let mut text = format!(
        "# {name}\n\n\
         Written by `specula gpu-report`.\n\n\
         - GPU: {name} ({kind}, {backend}), driver {driver}\n\
         - Ray queries: {queries}. Largest array: {largest} MiB.\n\
         - Processor: {processor}, {threads} threads, {system}\n\
         - {date}, specula {version}\n",
        name = adapter.name,
        kind = adapter.kind,
        backend = adapter.backend,
        driver = adapter.driver,
        queries = if adapter.ray_queries { "yes" } else { "no" },
        largest = adapter.largest_array >> 20,
        processor = machine.processor,
        threads = machine.threads,
        system = machine.system,
        date = options.date,
        version = env!("CARGO_PKG_VERSION"),
    );
    if options.quick {
        text += "- `--quick`: few rounds of short runs, and no large scene.\n";
    }
    if cfg!(debug_assertions) {
        text += "- Built with debug assertions: the processor's figures are too low.\n";
    }
    if adapter.kind == AdapterKind::Software {
        text += "\nThis adapter is software on the processor. Its figures show that the report works, and say nothing of a GPU.\n";
    }
    text + "\nTime is the clock's around whole runs, with submitting the work and waiting for it. Compiling and uploading come \
     before and are told apart. Medians of rounds; in a round all that is compared takes its turn, and ratios are medians of \
     the rounds' ratios.\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_read_and_written() {
        assert_eq!(
            GpuReportPart::ALL,
            GpuReportPart::TABLE.map(|entry| entry.0)
        );
        for part in GpuReportPart::ALL {
            assert_eq!(part.to_string().parse(), Ok(part));
        }
        assert_eq!("".parse::<GpuReportPart>(), Err(UnknownGpuReportPart));
    }
}
