//! The GPU: samplers and renders beside the papers' figures, as Markdown.
//!
//! `cargo bench -p specula-gpu --bench gpu -- [--quick] [--adapter INDEX|NAME] [--publish]`
//!
//! Medians of rounds, in which all sides of a ratio take their turns. `--quick` takes fewer and
//! smaller ones, `--publish` writes `docs/gpu/README.md`. Where no GPU is found, the bench says so
//! and succeeds; `SPECULA_GPU=require` makes that a failure.
#![allow(clippy::print_stdout, reason = "a bench reports on standard output")]
#![allow(clippy::print_stderr, reason = "and says there what went wrong")]

#[path = "gpu/renders.rs"]
mod renders;
#[path = "gpu/samples.rs"]
mod samples;
#[path = "gpu/scenes.rs"]
mod scenes;

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use specula_gpu::{AdapterChoice, AdapterKind, Gpu, GpuError};

/// What a part of the bench returns.
type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<()> {
    let options = Options::read(std::env::args().skip(1))?;
    let gpu = match Gpu::open(&options.adapter) {
        Ok(gpu) => gpu,
        Err(error) => return skip(error),
    };
    let effort = options.effort();
    let mut report = Report::default();
    report.add(&machine(&gpu, &options));
    report.add(&samples::normals(&gpu, &effort)?);
    report.add(&samples::furnace(&gpu, &effort)?);
    report.add(&renders::longest_paths(&gpu, &effort)?);
    report.add(&renders::speeds(&gpu, &effort)?);
    if options.publish {
        let path = root().join("docs/gpu/README.md");
        fs::create_dir_all(path.parent().ok_or("the document has no folder")?)?;
        fs::write(&path, format!("{HEAD}\n{}", report.text))?;
        println!("wrote {}", path.display());
    }
    Ok(())
}

/// Says that nothing is measured; a failure where a GPU is required.
fn skip(error: GpuError) -> Result<()> {
    let required = std::env::var("SPECULA_GPU").is_ok_and(|v| v == "require");
    if required || !matches!(error, GpuError::NoAdapter) {
        return Err(error.into());
    }
    println!("SKIPPED: the bench of the GPU measures nothing: {error}");
    Ok(())
}

/// What the command line says.
#[derive(Default)]
struct Options {
    quick: bool,
    publish: bool,
    adapter: AdapterChoice,
}

impl Options {
    fn read(arguments: impl Iterator<Item = String>) -> Result<Self> {
        let mut options = Self::default();
        let mut arguments = arguments;
        while let Some(argument) = arguments.next() {
            match argument.as_str() {
                // What `cargo bench` says to every bench.
                "--bench" => {}
                "--quick" => options.quick = true,
                "--publish" => options.publish = true,
                "--adapter" => {
                    let adapter = arguments
                        .next()
                        .ok_or("--adapter needs an index or a name")?;
                    let Ok(choice) = adapter.parse();
                    options.adapter = choice;
                }
                other => return Err(format!("no such option: '{other}'").into()),
            }
        }
        Ok(options)
    }

    fn effort(&self) -> Effort {
        match self.quick {
            true => Effort {
                quick: true,
                sample_rounds: 7,
                render_rounds: 5,
                side: 64,
                seconds: 0.1,
            },
            false => Effort {
                quick: false,
                sample_rounds: 51,
                render_rounds: 11,
                side: 256,
                seconds: 0.5,
            },
        }
    }
}

/// How much is measured.
struct Effort {
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
}

/// What was measured so far; printed as it comes.
#[derive(Default)]
struct Report {
    text: String,
}

impl Report {
    fn add(&mut self, part: &str) {
        println!("{part}");
        self.text += part;
        self.text.push('\n');
    }
}

/// What was measured where.
fn machine(gpu: &Gpu, options: &Options) -> String {
    let adapter = &gpu.adapter;
    let mut text = format!(
        "## This run\n\n\
         - GPU: {} ({}, {}), driver {}\n\
         - Processor: {}, {} threads\n",
        adapter.name,
        adapter.kind,
        adapter.backend,
        adapter.driver,
        processor(),
        rayon::current_num_threads(),
    );
    if options.quick {
        text += "- `--quick`: few rounds of short runs.\n";
    }
    if cfg!(debug_assertions) {
        text += "- Built with debug assertions: the processor's figures are too low.\n";
    }
    if adapter.kind == AdapterKind::Software {
        text += "\n**No real GPU has been measured yet.** This adapter is software on the processor. Its \
                 figures show that the bench works, and nothing of a GPU.\n";
        if std::env::var("GALLIVM_PERF").is_ok_and(|v| v.contains("nopt")) {
            text +=
                "It compiles without optimisation (`GALLIVM_PERF=nopt` in `.cargo/config.toml`).\n";
        }
    }
    text
}

/// The processor's name, as Linux knows it.
fn processor() -> String {
    let text = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let line = text.lines().find(|l| l.starts_with("model name"));
    let name = line.and_then(|l| l.split_once(": "));
    name.map_or(std::env::consts::ARCH, |(_, name)| name)
        .to_owned()
}

/// The workspace.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The middle of values.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    match values.len() {
        0 => f64::NAN,
        n if n % 2 == 1 => values[n / 2],
        n => 0.5 * (values[n / 2 - 1] + values[n / 2]),
    }
}

/// The least and the greatest of values.
fn range(values: impl IntoIterator<Item = f64>) -> [f64; 2] {
    let wider = |[low, high]: [f64; 2], v: f64| [low.min(v), high.max(v)];
    let none = [f64::INFINITY, f64::NEG_INFINITY];
    values.into_iter().fold(none, wider)
}

/// Three digits that count.
fn figure(value: f64) -> String {
    let digits = match value.abs() {
        v if v >= 100.0 => 0,
        v if v >= 10.0 => 1,
        v if v >= 1.0 => 2,
        v if v >= 0.1 => 3,
        v if v >= 0.01 => 4,
        _ => 5,
    };
    format!("{value:.digits$}")
}

/// A table of Markdown, the first row its head.
fn table(rows: &[Vec<String>]) -> String {
    let mut text = String::new();
    for (place, row) in rows.iter().enumerate() {
        let _ = writeln!(text, "| {} |", row.join(" | "));
        if place == 0 {
            let _ = writeln!(text, "|{}", "---|".repeat(row.len()));
        }
    }
    text
}

/// A row of a table.
fn row<const N: usize>(cells: [&str; N]) -> Vec<String> {
    cells.map(str::to_owned).to_vec()
}

const HEAD: &str = "\
# The GPU

Written by the bench below, which runs on any GPU that offers Vulkan, Metal or Direct3D 12.

    cargo bench -p specula-gpu --bench gpu -- --publish

- **Time** is the clock's around whole runs, with submitting the work and waiting for it, each run so much
  work that it lasts 0.1 s or more. Compilation and uploading come before and are told apart.
- **Medians** of rounds; in a round all that is compared takes its turn. Ratios are medians of the rounds'
  ratios; where other programs run, single rounds stray from them as far as each table says.
- `--adapter` chooses a GPU by its index or a part of its name, `--quick` takes fewer and smaller ones.
";
