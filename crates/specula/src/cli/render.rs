//! `specula render`.

use std::process::ExitCode;
use std::time::{Duration, Instant};

use specula::render::picture::{Display, Metadata, ToneMap};
use specula::render::{PrepareError, PreparedScene, RenderOptions, Renderer};
use specula::scene::Scene;

use super::Failure;
use super::arguments::{RenderArguments, ToneName};
use super::load::{self, Named};
use super::outputs::Outputs;
use super::progress::{Progress, State, short};
use super::schedule::Goal;
use super::stop::{INTERRUPTED, Stop};

/// Between two writes of what there is.
const SAVE_EVERY: Duration = Duration::from_secs(30);

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
    let outputs = Outputs::new(&arguments.output, &name, display(arguments))?;
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
        Job {
            goal: goal(arguments, &options),
            renderer: Renderer::new(&prepared, options.clone()),
            outputs: &outputs,
            name: &name,
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
        ..from_scene
    })
}

fn goal(arguments: &RenderArguments, options: &RenderOptions) -> Goal {
    match (arguments.time, arguments.noise) {
        (Some(time), _) => Goal::Time(time),
        (None, Some(noise)) => Goal::Noise(noise),
        (None, None) => Goal::Samples(options.samples_per_pixel),
    }
}

fn display(arguments: &RenderArguments) -> Display {
    Display {
        tone_map: match arguments.tone {
            ToneName::Clamp => ToneMap::Clamp,
            ToneName::Filmic => ToneMap::Filmic,
        },
        exposure_stops: arguments.exposure,
    }
}

/// A render on its way.
struct Job<'a> {
    goal: Goal,
    renderer: Renderer<'a>,
    outputs: &'a Outputs,
    name: &'a str,
    stop: &'a Stop,
    quiet: bool,
}

impl Job<'_> {
    fn run(mut self) -> Result<ExitCode, Failure> {
        let start = Instant::now();
        let mut progress = Progress::new(self.quiet);
        let (mut samples, mut rays, mut invalid) = (0, 0u64, 0);
        let mut last = None;
        let mut saved = Instant::now();
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
            if saved.elapsed() >= SAVE_EVERY && report.complete {
                self.save(samples, start)?;
                saved = Instant::now();
            }
        }
        progress.finish();
        let seconds = start.elapsed().as_secs_f64();
        self.save(samples, start)?;
        if invalid > 0 {
            eprintln!("warning: {invalid} samples were not finite and count as black");
        }
        let interrupted = self.stop.asked();
        if !self.quiet || interrupted {
            self.print_summary(samples, rays, seconds, interrupted);
        }
        Ok(ExitCode::from(if interrupted { INTERRUPTED } else { 0 }))
    }

    fn save(&self, samples: u32, start: Instant) -> Result<(), Failure> {
        let metadata = Metadata {
            software: Some(concat!("specula ", env!("CARGO_PKG_VERSION")).to_owned()),
            scene: Some(self.name.to_owned()),
            samples_per_pixel: Some(samples),
            seed: Some(self.renderer.options().seed),
            render_seconds: Some(start.elapsed().as_secs_f32()),
        };
        let picture = self.renderer.film().picture();
        let replaced = self
            .outputs
            .write(&picture, &metadata)
            .map_err(|e| Failure::other(format_args!("cannot write the picture: {e}")))?;
        if replaced > 0 {
            eprintln!("warning: {replaced} values were not finite and are written as 0");
        }
        Ok(())
    }

    fn print_summary(&self, samples: u32, rays: u64, seconds: f64, interrupted: bool) {
        let names = self.outputs.names();
        let noise = self.renderer.film().noise();
        let noise = if noise.is_finite() {
            format!(", noise {:.2} %", 100.0 * noise)
        } else {
            String::new()
        };
        let lead = if interrupted {
            "stopped by Ctrl-C; wrote what there is to"
        } else {
            "wrote"
        };
        eprintln!(
            "{lead} {names}: {samples} spp{noise}, {} ({:.2} Mrays/s)",
            short(seconds),
            rays as f64 * 1e-6 / seconds.max(1e-9),
        );
    }
}
