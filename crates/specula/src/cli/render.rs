//! `specula render`.

use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

use specula::render::{Label, PrepareError, PreparedScene, RenderOptions, Renderer};
use specula::scene::Scene;

use super::Failure;
use super::arguments::RenderArguments;
use super::checkpoint::{Checkpoint, Start};
use super::load::{self, Named};
use super::outputs::Outputs;
use super::progress::{Progress, State, short};
use super::schedule::Goal;
use super::stop::{INTERRUPTED, Stop};

/// Renders and writes; code 130 where Ctrl-C ended it early.
pub(crate) fn run(arguments: &RenderArguments) -> Result<ExitCode, Failure> {
    let stop = Stop::listen()?;
    let Named {
        name,
        mut scene,
        warnings,
    } = load::scene(
        arguments.scene.as_deref(),
        &arguments.loading.options(&arguments.parameters),
    )?;
    if let Some(material) = arguments.material {
        scene.replace_materials(material);
    }
    if !arguments.quiet {
        load::print_warnings(&warnings);
    }
    let options = options(arguments, &scene)?;
    let outputs = Outputs::new(paths(arguments, &name), arguments.display.display())?;
    let mut checkpoint = checkpoint(arguments, &outputs, &name, &scene, &options);
    let begun = match start(arguments) {
        Start::New if checkpoint.path().is_none() => None,
        start => checkpoint.open(start)?,
    };
    outputs.sweep();
    let mut pool = rayon::ThreadPoolBuilder::new();
    if let Some(threads) = arguments.threads {
        pool = pool.num_threads(usize::from(threads));
    }
    let pool = pool
        .build()
        .map_err(|e| Failure::other(format_args!("cannot start threads: {e}")))?;
    pool.install(|| {
        let start = Instant::now();
        let prepared = PreparedScene::consume(scene, &options)
            .map_err(|e: PrepareError| Failure::bad_input(format_args!("{name}: {e}")))?;
        if !arguments.quiet {
            let [width, height] = prepared.resolution();
            let ready = short(start.elapsed().as_secs_f64());
            eprintln!("{name}: {width}x{height}, ready after {ready}");
        }
        let renderer = match begun {
            None => Renderer::new(&prepared, options.clone()),
            Some(film) => Renderer::resume(&prepared, options.clone(), film).map_err(|e| {
                Failure::bad_input(format_args!("cannot go on with the checkpoint: {e}"))
            })?,
        };
        Job {
            goal: goal(arguments, &options),
            renderer,
            outputs: &outputs,
            checkpoint,
            stop: &stop,
            quiet: arguments.quiet,
        }
        .run()
    })
}

fn options(arguments: &RenderArguments, scene: &Scene) -> Result<RenderOptions, Failure> {
    let from_scene = RenderOptions::from_scene(scene);
    if let Some([x0, x1, y0, y1]) = arguments.crop {
        let [width, height] = arguments.resolution.unwrap_or(scene.film.resolution);
        if x1 > width || y1 > height {
            return Err(Failure::bad_input(format_args!(
                "--crop {x0},{x1},{y0},{y1} reaches beyond the picture of {width}x{height} pixels"
            )));
        }
    }
    Ok(RenderOptions {
        samples_per_pixel: arguments.spp.unwrap_or(from_scene.samples_per_pixel),
        max_depth: arguments.max_depth.unwrap_or(from_scene.max_depth),
        seed: arguments.seed,
        vndf_sampler: arguments.sampler.into(),
        energy: arguments.energy,
        resolution: arguments.resolution,
        crop: arguments.crop,
        first_sample: arguments.samples.map_or(0, |[from, _]| from),
        ..from_scene
    })
}

fn goal(arguments: &RenderArguments, options: &RenderOptions) -> Goal {
    match (arguments.time, arguments.noise, arguments.samples) {
        (Some(time), _, _) => Goal::Time(time),
        (None, Some(noise), _) => Goal::Noise(noise),
        (None, None, Some([from, to])) => Goal::Samples(to - from),
        (None, None, None) => Goal::Samples(options.samples_per_pixel),
    }
}

/// The files asked for; else names after the scene, in the current folder.
fn paths(arguments: &RenderArguments, scene_name: &str) -> Vec<PathBuf> {
    if !arguments.output.is_empty() {
        return arguments.output.clone();
    }
    // Appended: with_extension would cut `a.b` down to `a`.
    match arguments.samples {
        Some([from, to]) => vec![PathBuf::from(format!("{scene_name}.{from}-{to}.film"))],
        None => ["exr", "png"]
            .map(|e| PathBuf::from(format!("{scene_name}.{e}")))
            .to_vec(),
    }
}

fn start(arguments: &RenderArguments) -> Start {
    match (arguments.resume, arguments.restart) {
        (true, _) => Start::Resume,
        (_, true) => Start::Restart,
        _ => Start::New,
    }
}

fn checkpoint(
    arguments: &RenderArguments,
    outputs: &Outputs,
    name: &str,
    scene: &Scene,
    options: &RenderOptions,
) -> Checkpoint {
    // Pictures do not hold the fingerprint, and it takes a second for each gigabyte of the scene.
    let every = arguments.checkpoint.0;
    let has_film = every.is_some() || outputs.film().is_some() || start(arguments) != Start::New;
    let label = Label {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        scene: name.to_owned(),
        fingerprint: if has_film { scene.fingerprint() } else { 0 },
        settings: options.settings(),
        seconds: 0.0,
    };
    Checkpoint::new(outputs.checkpoint(), label, every, outputs.film().is_some())
}

/// A render on its way.
struct Job<'a> {
    goal: Goal,
    renderer: Renderer<'a>,
    outputs: &'a Outputs,
    checkpoint: Checkpoint,
    stop: &'a Stop,
    quiet: bool,
}

impl Job<'_> {
    fn run(mut self) -> Result<ExitCode, Failure> {
        let start = Instant::now();
        let mut progress = Progress::new(self.quiet);
        let film = self.renderer.film();
        let (mut samples, mut invalid) = (film.complete_samples(), film.invalid_samples());
        let (mut rays, mut last) = (0_u64, None);
        while !self.stop.asked() {
            let film = self.renderer.film();
            let next = self
                .goal
                .next_pass(samples, last, start.elapsed(), || film.noise());
            let Some(next) = next else { break };
            let pass_start = Instant::now();
            let report = self.renderer.render_pass(next, self.stop.flag());
            last = Some((next, pass_start.elapsed()));
            samples = report.samples_done_total;
            rays += report.rays;
            invalid = report.invalid_samples;
            let noise = self.renderer.film().noise();
            progress.show(&State {
                share_done: self.goal.share_done(samples, start.elapsed(), noise),
                samples,
                rays_per_second: rays as f64 / start.elapsed().as_secs_f64(),
                noise,
            });
            if report.complete && self.checkpoint.is_due() {
                let seconds = start.elapsed().as_secs_f64();
                self.checkpoint.save(self.renderer.film(), seconds);
                self.write_pictures(seconds)?;
            }
        }
        progress.finish();
        let seconds = start.elapsed().as_secs_f64();
        let interrupted = self.stop.asked();
        if interrupted {
            // First: nothing is lost if a picture cannot be written.
            self.checkpoint.save(self.renderer.film(), seconds);
        }
        self.write_pictures(seconds)?;
        if !interrupted {
            self.checkpoint.finish(self.renderer.film(), seconds)?;
        }
        if invalid > 0 {
            eprintln!("warning: {invalid} samples were not finite and count as black");
        }
        if !self.quiet || interrupted {
            self.print_summary(samples, rays, seconds, interrupted);
        }
        Ok(ExitCode::from(if interrupted { INTERRUPTED } else { 0 }))
    }

    /// * `seconds`: of this run.
    fn write_pictures(&self, seconds: f64) -> Result<(), Failure> {
        let seed = self.renderer.options().seed;
        let label = self.checkpoint.label(seconds);
        self.outputs
            .write_pictures(self.renderer.film(), &label, Some(seed))
    }

    fn print_summary(&self, samples: u32, rays: u64, seconds: f64, interrupted: bool) {
        let names = self.outputs.names();
        let noise = self.renderer.film().noise();
        let noise = if noise.is_finite() {
            format!(", noise {:.2} %", 100.0 * noise)
        } else {
            String::new()
        };
        let (lead, end) = match (interrupted, self.checkpoint.path()) {
            (true, Some(path)) => (
                "stopped by Ctrl-C; wrote what there is to",
                format!("; --resume goes on with {}", path.display()),
            ),
            (true, None) => ("stopped by Ctrl-C; wrote what there is to", String::new()),
            _ => ("wrote", String::new()),
        };
        eprintln!(
            "{lead} {names}: {samples} spp{noise}, {} ({:.2} Mrays/s){end}",
            short(seconds),
            rays as f64 * 1e-6 / seconds.max(1e-9),
        );
    }
}
