//! `cargo xtask versus`: time to equal error against other renderers.

mod block;
mod flip;
mod measure;
#[path = "../../../specula-lab/src/gpu_report/mesh.rs"]
pub(crate) mod mesh;
mod metals;
mod outcome;
mod plan;
mod reference;
pub(crate) mod renderers;
mod report;
pub(crate) mod scenes;
mod sheet;
#[path = "../../../specula-lab/src/gpu_report/sky.rs"]
mod sky;
pub(crate) mod statistics;
mod table;
mod trial;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use clap::{Args, ValueEnum};

use crate::{Result, workspace};
use block::Block;
use flip::Denoiser;
use measure::Contestant;
use metals::Metals;
use outcome::Outcome;
use plan::Plan;
use renderers::{Pbrt, Served, Specula};
use scenes::{SCENES, Scene};

/// Most that the means of references may differ by, as a share.
const CLOSE: f64 = 0.005;
/// The same for a renderer that computes with spectra.
const SPECTRAL: f64 = 0.02;
/// A picture of the report is smaller, in bytes.
const LARGEST_PICTURE: u64 = 600_000;

const MITSUBA_SAMPLERS: [&str; 5] = [
    "independent",
    "stratified",
    "multijitter",
    "orthogonal",
    "ldsampler",
];

const CYCLES_SAMPLERS: [&str; 3] = ["TABULATED_SOBOL", "BLUE_NOISE", "TABULATED_SOBOL,adaptive"];

const PBRT_SAMPLERS: [&str; 1] = ["zsobol"];

/// Which seconds are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Clock {
    /// Seconds by the clock: for a machine that does nothing else.
    Wall,
    /// Seconds of user and system over the number of threads: for a machine that is shared.
    Cpu,
}

/// What to compare, and how.
#[derive(Args)]
pub(crate) struct Versus {
    /// Scenes of your own, in Mitsuba's form (FILE.xml: against Mitsuba and Cycles) or in pbrt's (FILE.pbrt: against pbrt)
    #[arg(value_name = "FILE", conflicts_with_all = ["scene", "publish"])]
    files: Vec<PathBuf>,
    /// A Python that has Mitsuba 3
    #[arg(long, value_name = "PYTHON")]
    mitsuba: Option<PathBuf>,
    /// A Python that has Blender's `bpy`
    #[arg(long, value_name = "PYTHON")]
    cycles: Option<PathBuf>,
    /// pbrt-v4
    #[arg(long, value_name = "PROGRAM")]
    pbrt: Option<PathBuf>,
    /// Specula [default: built from this workspace]
    #[arg(long, value_name = "PROGRAM")]
    specula: Option<PathBuf>,
    /// Folder for pictures, references (which are reused) and the report
    #[arg(long, value_name = "DIR", default_value = "target/versus")]
    out: PathBuf,
    /// Scenes to render [default: all]
    #[arg(long, value_name = "NAME", value_parser = scene_names())]
    scene: Vec<String>,
    /// Metals of the scenes of the list; with gold and with white, Specula without shared paths against Mitsuba alone
    #[arg(long, value_enum, value_delimiter = ',', default_values = ["own", "gold", "white"])]
    metals: Vec<Metals>,
    /// Samplers to choose from, of the renderers that have one of them [default: all]
    #[arg(long, value_name = "NAME", value_parser = sampler_names())]
    sampler: Vec<String>,
    /// Rounds, in each of which everybody renders once; pairs of them are compared [default: 5, quick 3]
    #[arg(long, value_parser = clap::value_parser!(u32).range(2..))]
    rounds: Option<u32>,
    /// Seconds that a render should take [default: 2, quick 0.5]
    #[arg(long)]
    seconds: Option<f64>,
    /// Samples of a reference over those of a render
    #[arg(long, default_value_t = 8)]
    reference: u32,
    /// Threads of every renderer
    #[arg(long, default_value_t = 2)]
    threads: u32,
    /// Which seconds are compared
    #[arg(long, value_enum, default_value_t = Clock::Wall)]
    clock: Clock,
    /// Mitsuba's variant
    #[arg(long, default_value = "llvm_ad_rgb")]
    variant: String,
    /// What Cycles renders on: CPU, or an interface of GPUs as it names them (CUDA, OPTIX, HIP, ONEAPI, METAL)
    #[arg(long, value_name = "NAME", default_value = "CPU")]
    cycles_device: String,
    /// What Specula renders on, as `specula render --device` takes it; with a GPU, compare with `--variant cuda_ad_rgb`
    /// and `--cycles-device OPTIX`
    #[arg(long, default_value = "cpu")]
    device: String,
    /// Short renders and few rounds, for a look
    #[arg(long)]
    quick: bool,
    /// Copy the report and its pictures to docs/versus
    #[arg(long)]
    publish: bool,
}

fn scene_names() -> Vec<&'static str> {
    SCENES.iter().map(|s| s.name).collect()
}

fn sampler_names() -> Vec<&'static str> {
    [
        &Specula::SAMPLERS[..],
        &MITSUBA_SAMPLERS,
        &CYCLES_SAMPLERS,
        &PBRT_SAMPLERS,
    ]
    .concat()
}

/// Renders, compares, prints and writes the report.
pub(crate) fn run(root: &Path, versus: &Versus) -> Result<()> {
    let start = Instant::now();
    fs::create_dir_all(&versus.out)?;
    let out = fs::canonicalize(&versus.out)?;
    let specula = workspace::program(root, versus.specula.as_deref())?;
    let denoiser = Denoiser::of(&specula, &out)?;
    let mut outcomes: Vec<Outcome> = Vec::new();
    for scene in versus.scenes(root, &out)? {
        println!("== {}: {}", scene.name, scene.title);
        let mut outcome = versus.compare(root, &out, &specula, scene)?;
        flip::measure(&mut outcome, denoiser.as_ref(), &out)?;
        print!("{}", table::scene(&outcome));
        outcomes.push(outcome);
    }
    let minutes = start.elapsed().as_secs_f64() / 60.0;
    let text = report::document(versus, &outcomes, minutes);
    fs::write(out.join("README.md"), &text)?;
    print!("{}", report::summary(&outcomes));
    println!("{minutes:.1} minutes; report in {}", out.display());
    let faults: Vec<&str> = outcomes.iter().flat_map(Outcome::faults).collect();
    if !faults.is_empty() {
        return Err(faults.join("\n").into());
    }
    if versus.publish {
        publish(root, &out, &text, &outcomes)?;
    }
    Ok(())
}

/// Copies the report and its pictures to the documents.
fn publish(root: &Path, out: &Path, text: &str, outcomes: &[Outcome]) -> Result<()> {
    let docs = root.join("docs/versus");
    fs::create_dir_all(&docs)?;
    fs::write(docs.join("README.md"), text)?;
    for outcome in outcomes.iter().filter(|o| o.is_shown()) {
        let name = format!("{}.png", outcome.scene.name);
        let size = fs::copy(out.join(&name), docs.join(&name))?;
        if size >= LARGEST_PICTURE {
            return Err(format!("{name} is too large to publish: {size} bytes").into());
        }
    }
    Ok(())
}

impl Versus {
    fn plan(&self) -> Plan {
        Plan {
            rounds: self.rounds.unwrap_or(if self.quick { 3 } else { 5 }),
            seconds: self.seconds.unwrap_or(if self.quick { 0.5 } else { 2.0 }),
            reference: self.reference.max(1),
            threads: self.threads,
            clock: self.clock,
        }
    }

    /// The files, or else those of the list that are named or all.
    fn scenes(&self, root: &Path, out: &Path) -> Result<Vec<Scene>> {
        if !self.files.is_empty() {
            return self.files.iter().map(|f| Scene::of_file(f)).collect();
        }
        let is_named = |name: &str| self.scene.is_empty() || self.scene.iter().any(|n| n == name);
        let folder = out.join("scenes");
        let with = |metals: Metals| {
            let listed = SCENES.iter().filter(|s| is_named(s.name));
            listed.map(|s| s.scene(root, &folder, metals)).collect()
        };
        // Mitsuba alone renders the others.
        let metals = self.metals.iter().copied();
        let metals = metals.filter(|&m| m == Metals::Own || self.mitsuba.is_some());
        let scenes: Result<Vec<Vec<Scene>>> = metals.map(with).collect();
        Ok(scenes?.concat())
    }

    fn compare(&self, root: &Path, out: &Path, specula: &Path, scene: Scene) -> Result<Outcome> {
        let contestants = self.contestants(root, specula, &scene)?;
        if contestants.is_empty() {
            let title = &scene.title;
            return Err(format!("{title}: no renderer of its form is named: see --help").into());
        }
        let pictures = out.join(&scene.name);
        let picture = out.join(format!("{}.png", scene.name));
        let key = scene.key()?;
        let outcome = measure::run(scene, &self.plan(), contestants, &pictures, key)?;
        sheet::write(&outcome, &picture)?;
        Ok(outcome)
    }

    /// Everybody who renders a form of the scene.
    fn contestants(&self, root: &Path, specula: &Path, scene: &Scene) -> Result<Vec<Contestant>> {
        let mut contestants = Vec::new();
        // Cycles, whose masking is pbrt's, builds its scene from Mitsuba's form.
        let mut beside_cycles = "specula-xml";
        if let Some(file) = scene.mitsuba.as_ref() {
            if self.mitsuba.is_some() || scene.pbrt.is_none() && self.cycles.is_some() {
                contestants.extend(self.specula("specula-xml", specula, file));
            }
            if let Some(python) = &self.mitsuba {
                let mut command = Command::new(python);
                command
                    .arg(root.join("data/versus/mitsuba_peer.py"))
                    .arg(file)
                    .args([&self.variant, &self.threads.to_string()]);
                let engine = Served::start("Mitsuba", &mut command)?;
                let mitsuba = Contestant::new("mitsuba", &MITSUBA_SAMPLERS, engine);
                contestants.push(mitsuba.against("specula-xml", CLOSE));
            }
        }
        if scene.metals != Metals::Own {
            contestants.retain(|c| !c.shares_paths());
            let named = contestants.into_iter().map(|c| c.among(&self.sampler));
            return Ok(named.collect());
        }
        let of_pbrt = scene
            .pbrt
            .as_ref()
            .filter(|_| self.pbrt.is_some() || scene.mitsuba.is_some() && self.cycles.is_some());
        if let Some(file) = of_pbrt {
            contestants.extend(self.specula("specula-pbrt", specula, file));
            beside_cycles = "specula-pbrt";
        }
        if let (Some(python), Some(file)) = (&self.cycles, &scene.mitsuba) {
            let mut command = Command::new(python);
            command
                .arg(root.join("data/versus/cycles_peer.py"))
                .arg(file)
                .args([&self.threads.to_string(), &self.cycles_device]);
            let engine = Served::start("Cycles", &mut command)?;
            let cycles = Contestant::new("cycles", &CYCLES_SAMPLERS, engine);
            contestants.push(cycles.against(beside_cycles, CLOSE));
        }
        if let (Some(program), Some(file)) = (&self.pbrt, &scene.pbrt) {
            let engine = Pbrt {
                program: program.clone(),
                scene: file.clone(),
                threads: self.threads,
                loading: None,
            };
            let pbrt = Contestant::new("pbrt", &PBRT_SAMPLERS, engine);
            contestants.push(pbrt.against("specula-pbrt", SPECTRAL));
        }
        let named = contestants.into_iter().map(|c| c.among(&self.sampler));
        Ok(named.collect())
    }

    /// Specula with one form of a scene, once for each block that the device has samplers for.
    fn specula(&self, form: &'static str, program: &Path, scene: &Path) -> Vec<Contestant> {
        let contestant = |block: Block| {
            let samplers = block.samplers(&self.device);
            let engine = Specula {
                program: program.to_owned(),
                scene: scene.to_owned(),
                threads: self.threads,
                device: self.device.clone(),
                writing: None,
            };
            let contestant = Contestant::new(form, samplers, engine).in_block(block);
            (!samplers.is_empty()).then_some(contestant)
        };
        Block::ALL.into_iter().filter_map(contestant).collect()
    }
}
