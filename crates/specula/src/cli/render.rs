//! `specula render`.

use std::path::PathBuf;
use std::process::ExitCode;
use std::time::{Duration, Instant};

use specula::gpu::{GpuError, TracerOptions};
use specula::render::{
    FilmBuffer, InvalidSample, Label, MOST_SAMPLES, PrepareError, PreparedScene, RenderOptions,
    Renderer,
};
use specula::scene::Scene;

use super::arguments::RenderArguments;
use super::checkpoint::{Checkpoint, Start};
use super::device::{self, Samples};
use super::live_view::LiveView;
use super::load::{self, Named};
use super::outputs::Outputs;
use super::progress::{Progress, State, short};
use super::schedule::Goal;
use super::stop::{INTERRUPTED, Stop};
use super::{Failure, denoise, machine, memory};

/// Renders and writes; code 130 where Ctrl-C ended it early.
pub(crate) fn run(arguments: &RenderArguments) -> Result<ExitCode, Failure> {
    if arguments.denoise {
        denoise::ensure_available()?;
    }
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
    let gpu = device::open(&arguments.device, arguments.gpu_rays)?;
    let threads = arguments.machine.thread_count();
    let most = arguments.machine.max_memory;
    memory::check(&scene, &options, threads, most, arguments.quiet)?;
    let outputs = Outputs::new(paths(arguments, &name), arguments.display.display())?;
    let mut checkpoint = checkpoint(arguments, &outputs, &name, &scene, &options);
    let begun = match start(arguments) {
        Start::New if checkpoint.path().is_none() => None,
        start => checkpoint.open(start)?,
    };
    outputs.sweep();
    let live_view = match &arguments.display_server {
        Some(address) => Some(LiveView::connect(address, &name)?),
        None => None,
    };
    machine::pool(threads, arguments.machine.nice)?.install(|| {
        let start = Instant::now();
        let prepared = PreparedScene::consume(scene, &options)
            .map_err(|e: PrepareError| Failure::bad_input(format_args!("{name}: {e}")))?;
        if !arguments.quiet {
            let [width, height] = prepared.resolution();
            let ready = short(start.elapsed().as_secs_f64());
            eprintln!("{name}: {width}x{height}, ready after {ready}");
        }
        let on_gpu = TracerOptions {
            rays: arguments.gpu_rays,
            schedule: arguments.gpu_schedule,
        };
        let chosen = (&arguments.device, on_gpu);
        let source = Samples::new(chosen, gpu.as_ref(), &prepared, &options, arguments.quiet)?;
        let renderer = match begun {
            None => Renderer::new(&prepared, options.clone()),
            Some(film) => Renderer::resume(&prepared, options.clone(), film).map_err(|e| {
                Failure::bad_input(format_args!("cannot go on with the checkpoint: {e}"))
            })?,
        };
        Job {
            goal: goal(arguments, &options),
            renderer,
            source,
            outputs: &outputs,
            checkpoint,
            stop: &stop,
            live_view,
            denoised: arguments.denoise,
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
    let by_samples = arguments.noise.is_none() && arguments.time.is_none();
    let samples = match by_samples {
        true => from_scene.samples_per_pixel,
        false => MOST_SAMPLES,
    };
    Ok(RenderOptions {
        samples_per_pixel: arguments.spp.unwrap_or(samples),
        max_depth: arguments.max_depth.unwrap_or(from_scene.max_depth),
        seed: arguments.seed,
        share_paths: arguments.share_paths,
        vndf_sampler: arguments.sampler.into(),
        energy: arguments.energy,
        resolution: arguments.resolution,
        crop: arguments.crop,
        first_sample: arguments.samples.map_or(0, |[from, _]| from),
        noise: arguments.noise.or(arguments.adaptive.then_some(0.0)),
        ..from_scene
    })
}

fn goal(arguments: &RenderArguments, options: &RenderOptions) -> Goal {
    match (arguments.time, arguments.samples) {
        (Some(time), _) => Goal::time(time),
        // What is done is the film's to say.
        (None, _) if options.noise.is_some() => Goal::samples(MOST_SAMPLES),
        (None, Some([from, to])) => Goal::samples(to - from),
        (None, None) => Goal::samples(options.samples_per_pixel),
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
    source: Samples<'a>,
    outputs: &'a Outputs,
    checkpoint: Checkpoint,
    stop: &'a Stop,
    live_view: Option<LiveView>,
    denoised: bool,
    quiet: bool,
}

impl Job<'_> {
    fn run(mut self) -> Result<ExitCode, Failure> {
        let start = Instant::now();
        let mut progress = Progress::new(self.quiet);
        let mut invalid = self.renderer.film().invalid_samples();
        let (mut rays, mut last, mut one_invalid) = (0_u64, None, None);
        while !self.stop.asked() {
            let next = self
                .renderer
                .samples_done()
                .and_then(|done| self.goal.next_pass(done, last, start.elapsed()));
            let Some(next) = next else { break };
            let pass_start = Instant::now();
            self.stop.pass_begins(expected(next, last));
            let taken = self
                .source
                .pass(&mut self.renderer, next, self.stop.at_once());
            self.stop.pass_ends();
            let report = taken.or_else(|error| self.give_up(&error, start.elapsed()))?;
            last = Some((next, pass_start.elapsed()));
            rays += report.rays;
            invalid = report.invalid_samples;
            one_invalid = one_invalid.or(report.invalid);
            let film = self.renderer.film();
            let of_samples = self.renderer.share_done(self.goal.most_samples);
            progress.show(&State {
                share_done: self.goal.share_done(of_samples, start.elapsed()),
                samples: samples(film),
                rays_per_second: rays as f64 / start.elapsed().as_secs_f64(),
                noise: film.noise(),
            });
            if let Some(view) = &mut self.live_view {
                view.update(self.renderer.film());
            }
            if report.complete && self.checkpoint.is_due() {
                let seconds = start.elapsed().as_secs_f64();
                self.checkpoint.save(self.renderer.film(), seconds);
                self.write_pictures(seconds, false)?;
            }
        }
        progress.finish();
        if let Some(view) = &mut self.live_view {
            view.show(self.renderer.film());
        }
        let seconds = start.elapsed().as_secs_f64();
        let interrupted = self.stop.asked();
        if interrupted {
            // First: nothing is lost if a picture cannot be written.
            self.checkpoint.save(self.renderer.film(), seconds);
        }
        self.write_pictures(seconds, self.denoised)?;
        if !interrupted {
            self.checkpoint.finish(self.renderer.film(), seconds)?;
        }
        if invalid > 0 {
            let one = one_invalid.map_or_else(String::new, |s| self.describe(&s));
            eprintln!("warning: {invalid} samples were not finite and count as black{one}");
        }
        if !self.quiet || interrupted {
            self.print_summary(rays, seconds, interrupted);
        }
        Ok(ExitCode::from(if interrupted { INTERRUPTED } else { 0 }))
    }

    /// Keeps what there is where the device failed.
    fn give_up<T>(&mut self, error: &GpuError, elapsed: Duration) -> Result<T, Failure> {
        let seconds = elapsed.as_secs_f64();
        self.checkpoint.save(self.renderer.film(), seconds);
        let kept = self.checkpoint.path().map_or_else(String::new, |path| {
            format!("; --resume goes on with {}", path.display())
        });
        Err(device::failed(error, &kept))
    }

    /// Where a sample went wrong, after a colon.
    fn describe(&self, sample: &InvalidSample) -> String {
        let [x, y] = sample.pixel;
        let at = match sample.material {
            None => "beyond all surfaces".to_owned(),
            Some(m) => match self.renderer.scene().material_name(m) {
                Some(name) => format!("at a surface of material {m} (\"{name}\")"),
                None => format!("at a surface of material {m}"),
            },
        };
        format!(
            ": one is sample {} of pixel ({x}, {y}), {at}",
            sample.number
        )
    }

    /// * `seconds`: of this run.
    fn write_pictures(&self, seconds: f64, denoised: bool) -> Result<(), Failure> {
        let seed = self.renderer.options().seed;
        let label = self.checkpoint.label(seconds);
        self.outputs
            .write_pictures(self.renderer.film(), &label, Some(seed), denoised)
    }

    fn print_summary(&self, rays: u64, seconds: f64, interrupted: bool) {
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
            "{lead} {names}: {}{noise}, {} ({:.2} Mrays/s){end}",
            samples(self.renderer.film()),
            short(seconds),
            rays as f64 * 1e-6 / seconds.max(1e-9),
        );
    }
}

/// How long a pass of `samples` will take, from the samples and the duration of the last.
fn expected(samples: u32, last: Option<(u32, Duration)>) -> Option<Duration> {
    last.map(|(taken, duration)| duration.mul_f64(f64::from(samples) / f64::from(taken.max(1))))
}

/// `64 spp`; where pixels differ, `32 to 512 spp, 77 on average`.
fn samples(film: &FilmBuffer) -> String {
    let least = film.complete_samples();
    let (most, mean) = film.most_and_mean_samples();
    if least == most {
        format!("{least} spp")
    } else {
        format!("{least} to {most} spp, {mean:.0} on average")
    }
}
