//! `specula render`.

use crate::cli::ExitCode;
use std::path::PathBuf;
use std::time::Instant;

use crate::render::{
    FilmBuffer, Label, MOST_SAMPLES, PrepareError, PreparedScene, RenderGoal, RenderOptions,
    Renderer,
};
use crate::scene::Scene;

use super::arguments::{Adaptive, RenderArguments};
use super::checkpoint::{Checkpoint, Start};
use super::console::say;
use super::device::{self, Gpu, Samples};
use super::file_id::Inputs;
use super::job::Job;
use super::live_view::LiveView;
use super::load::{self, Named};
use super::outputs::{self, Outputs};
use super::progress::short;
use super::stop::Stop;
use super::{Failure, denoise, machine, memory, watch};

/// Samples per pixel from which on they are spread by the picture's error where nothing else is asked for: of fewer,
/// the first round is all.
const ADAPTIVE_FROM: u32 = 8;

/// Renders and writes; code 130 where Ctrl-C ended it early.
pub(crate) fn run(arguments: &RenderArguments) -> Result<ExitCode, Failure> {
    if arguments.denoise {
        denoise::ensure_available()?;
    }
    let stop = Stop::listen()?;
    let threads = arguments.machine.thread_count();
    let context = Context {
        arguments,
        stop: &stop,
        threads,
        gpus: device::open(&arguments.device, &arguments.gpu)?,
    };
    let pool = machine::pool(threads, arguments.machine.nice)?;
    if arguments.watch {
        return pool.install(|| watch::run(&context));
    }
    let loaded = load(arguments)?;
    let mut live_view = connect(arguments, &loaded.name)?;
    let ready = context.ready(loaded)?;
    pool.install(|| {
        let prepared = context.prepare(ready.scene, &ready.options, None)?;
        context.render(&prepared, ready.rest, live_view.as_mut())
    })
}

/// What all renders of a command have in common.
pub(crate) struct Context<'a> {
    pub(crate) arguments: &'a RenderArguments,
    pub(crate) stop: &'a Stop,
    threads: usize,
    gpus: Vec<Gpu>,
}

/// A scene that was checked, and what its render needs.
pub(crate) struct Ready {
    pub(crate) scene: ReadyScene,
    pub(crate) options: RenderOptions,
    pub(crate) rest: Rest,
}

/// A scene with its name.
pub(crate) struct ReadyScene {
    name: String,
    scene: Scene,
    /// When its reading began.
    since: Instant,
}

/// What a render needs beside the scene.
pub(crate) struct Rest {
    options: RenderOptions,
    outputs: Outputs,
    checkpoint: Checkpoint,
    /// The film that it goes on with.
    begun: Option<FilmBuffer>,
}

/// Reads the scene, and gives it the materials that were asked for.
pub(crate) fn load(arguments: &RenderArguments) -> Result<Named, Failure> {
    let options = arguments.loading.options(&arguments.parameters);
    let mut named = load::scene(arguments.scene.as_deref(), &options)?;
    for material in &arguments.material {
        material.apply(&mut named.scene)?;
    }
    if !arguments.quiet {
        load::print_warnings(&named.warnings);
    }
    Ok(named)
}

/// The viewer that was asked for.
pub(crate) fn connect(
    arguments: &RenderArguments,
    name: &str,
) -> Result<Option<LiveView>, Failure> {
    let address = arguments.display_server.as_ref();
    address.map(|a| LiveView::connect(a, name)).transpose()
}

impl Context<'_> {
    /// Checks all that could stop the render later: memory, outputs, a film that is there already.
    pub(crate) fn ready(&self, loaded: Named) -> Result<Ready, Failure> {
        let arguments = self.arguments;
        let Named {
            name,
            scene,
            files,
            missing,
            since,
            is_photometric,
            ..
        } = loaded;
        let mut options = options(arguments, &scene)?;
        options.triangulate_exact_shapes = !self.gpus.is_empty();
        let most = arguments.machine.max_memory;
        memory::check(&scene, &options, self.threads, most, arguments.quiet)?;
        let inputs = Inputs::new(files);
        let paths = paths(arguments, &name, &inputs);
        let mut outputs = Outputs::new(paths, arguments.display.choice(is_photometric), &inputs)?;
        outputs.claim_checkpoint(&inputs)?;
        let start = start(arguments);
        if arguments.adaptive.is_none() && arguments.noise.is_none() {
            // As in the film that it goes on with.
            let spread = start.is_adaptive(&outputs.checkpoint());
            options.noise = spread.map_or(options.noise, |is| is.then_some(0.0));
        }
        let mut checkpoint = checkpoint(
            arguments,
            &outputs,
            Label::of(&name, &scene, &options).with_missing(&missing),
        );
        if arguments.round_share.is_some() {
            checkpoint.leave_earlier_time_out();
        }
        let begun = match start {
            Start::New if checkpoint.path().is_none() => None,
            start => checkpoint.open(&start)?,
        };
        outputs.sweep();
        let rest = Rest {
            options: options.clone(),
            outputs,
            checkpoint,
            begun,
        };
        Ok(Ready {
            scene: ReadyScene { name, scene, since },
            options,
            rest,
        })
    }

    /// Prepares the scene; of an earlier one, what has not changed is taken over.
    pub(crate) fn prepare(
        &self,
        ReadyScene { name, scene, since }: ReadyScene,
        options: &RenderOptions,
        earlier: Option<PreparedScene>,
    ) -> Result<PreparedScene, Failure> {
        let prepared = PreparedScene::consume_after(scene, options, earlier)
            .map_err(|e: PrepareError| Failure::bad_input(format_args!("{name}: {e}")))?;
        if !self.arguments.quiet {
            let [width, height] = prepared.resolution();
            let ready = short(since.elapsed().as_secs_f64());
            say!("{name}: {width}x{height}, ready after {ready}");
        }
        Ok(prepared)
    }

    /// Renders and writes.
    pub(crate) fn render(
        &self,
        prepared: &PreparedScene,
        rest: Rest,
        live_view: Option<&mut LiveView>,
    ) -> Result<ExitCode, Failure> {
        let arguments = self.arguments;
        let options = rest.options;
        let chosen = (&arguments.device, &arguments.gpu);
        let source = Samples::new(chosen, &self.gpus, prepared, &options, arguments.quiet)?;
        let renderer = match rest.begun {
            None => Renderer::new(prepared, options.clone()),
            Some(film) => Renderer::resume(prepared, options.clone(), film).map_err(|e| {
                Failure::bad_input(format_args!("cannot go on with the checkpoint: {e}"))
            })?,
        };
        Job {
            goal: goal(arguments, &options),
            renderer,
            source,
            outputs: &rest.outputs,
            checkpoint: rest.checkpoint,
            stop: self.stop,
            live_view,
            denoised: arguments.denoise,
            quiet: arguments.quiet,
            stats: arguments.stats,
            is_watched: arguments.watch,
        }
        .run()
    }
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
    let noise = arguments.noise;
    if noise.is_some() && arguments.adaptive == Some(Adaptive::Off) {
        return Err(Failure::bad_input(
            "--noise spreads samples by their error: leave out --adaptive=off",
        ));
    }
    let is_asked_for = noise.is_some() || arguments.adaptive == Some(Adaptive::On);
    if arguments.round_share.is_some() && !is_asked_for {
        return Err(Failure::bad_input(
            "--round-share is of a round of --adaptive or --noise: name one of them",
        ));
    }
    let by_samples = arguments.noise.is_none() && arguments.time.is_none();
    let samples = match by_samples {
        true => from_scene.samples_per_pixel,
        false => MOST_SAMPLES,
    };
    let samples = arguments.spp.unwrap_or(samples);
    let is_adaptive = match arguments.adaptive {
        Some(adaptive) => adaptive == Adaptive::On,
        None => arguments.samples.is_none() && samples >= ADAPTIVE_FROM,
    };
    Ok(RenderOptions {
        samples_per_pixel: samples,
        max_depth: arguments.max_depth.unwrap_or(from_scene.max_depth),
        seed: arguments.seed,
        share_paths: arguments.share_paths,
        vndf_sampler: arguments.sampler.into(),
        energy: arguments.energy.unwrap_or(from_scene.energy),
        resolution: arguments.resolution,
        crop: arguments.crop,
        first_sample: arguments.samples.map_or(0, |[from, _]| from),
        noise: noise.or(is_adaptive.then_some(0.0)),
        round_share: arguments.round_share,
        clamp: arguments.clamp,
        regularize: arguments.regularize,
        texture_filter: arguments.texture_filter.into(),
        filter_normal_maps: arguments.filter_normal_maps,
        ..from_scene
    })
}

fn goal(arguments: &RenderArguments, options: &RenderOptions) -> RenderGoal {
    match (arguments.time, arguments.samples) {
        (Some(time), _) => RenderGoal::time(time),
        // What is done is the film's to say.
        (None, _) if options.noise.is_some() => RenderGoal::samples(MOST_SAMPLES),
        (None, Some([from, to])) => RenderGoal::samples(to - from),
        (None, None) => RenderGoal::samples(options.samples_per_pixel),
    }
}

/// The files asked for; else names after the scene, in the current folder.
fn paths(arguments: &RenderArguments, scene: &str, inputs: &Inputs) -> Vec<PathBuf> {
    if !arguments.output.is_empty() {
        return arguments.output.clone();
    }
    match arguments.samples {
        Some([from, to]) => outputs::default_names(scene, &[&format!("{from}-{to}.film")], inputs),
        None => outputs::default_names(scene, &["exr", "png"], inputs),
    }
}

fn start(arguments: &RenderArguments) -> Start {
    match (&arguments.resume, arguments.restart) {
        (Some(Some(film)), _) => Start::ResumeFrom(film.clone()),
        (Some(None), _) => Start::Resume,
        (None, true) => Start::Restart,
        (None, false) => Start::New,
    }
}

fn checkpoint(arguments: &RenderArguments, outputs: &Outputs, label: Label) -> Checkpoint {
    // What is watched changes: there is nothing to go on with.
    let every = arguments.checkpoint.0.filter(|_| !arguments.watch);
    Checkpoint::new(outputs.checkpoint(), label, every, outputs.film().is_some())
}
