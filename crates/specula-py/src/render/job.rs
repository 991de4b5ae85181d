//! A render under way: passes without the interpreter's lock, and Ctrl-C.

use std::io::ErrorKind;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, MutexGuard, TryLockError};
use std::time::{Duration, Instant};

use pyo3::exceptions::{PyMemoryError, PyRuntimeError};
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use specula::render::picture::Metadata;
use specula::render::{
    FilmBuffer, FilmFile, FilmFileError, Label, MOST_SAMPLES, MemoryEstimate, PassReport,
    PreparedScene, RenderGoal, RenderOptions, Renderer, available_memory,
};

use super::io_error;
use super::picture::PictureData;
use super::scene::SceneData;
use crate::parameters::{in_range, invalid, named};

/// Between two looks for Ctrl-C.
const POLL: Duration = Duration::from_millis(50);
/// Where a render by time ends in any case.
const MOST_BY_TIME: u32 = RenderGoal::MOST_BY_TIME;

/// A render of a scene as it was when the render began.
#[pyclass(frozen, module = "specula_render._native")]
pub(crate) struct RenderJob {
    prepared: Arc<PreparedScene>,
    options: RenderOptions,
    scene: String,
    pool: ThreadPool,
    /// The file that the film is saved in.
    checkpoint: Option<PathBuf>,
    label: Label,
    state: Mutex<State>,
}

/// What has been done.
struct State {
    /// `None` before the first pass, and while one is under way.
    film: Option<FilmBuffer>,
    rays: u64,
    seconds: f64,
}

/// Between two writes of a checkpoint, at least.
const SAVE_EVERY: Duration = Duration::from_secs(30);
/// Writing a checkpoint takes at most one part in so many of the time.
const SAVE_SHARE: u32 = 20;

impl RenderJob {
    fn state(&self) -> PyResult<MutexGuard<'_, State>> {
        match self.state.try_lock() {
            Ok(state) => Ok(state),
            Err(TryLockError::Poisoned(poisoned)) => Ok(poisoned.into_inner()),
            Err(TryLockError::WouldBlock) => Err(PyRuntimeError::new_err(
                "the render is under way in another thread",
            )),
        }
    }

    fn run(&self, goal: RenderGoal, progress: Option<&Py<PyAny>>) -> PyResult<()> {
        let mut state = self.state()?;
        let start = Instant::now();
        let options = self.options.clone();
        let mut renderer = match state.film.take() {
            None => Renderer::new(&self.prepared, options),
            Some(film) => Renderer::resume(&self.prepared, options, film)
                .map_err(|e| PyRuntimeError::new_err(e.to_string()))?,
        };
        let ended = self.passes(&mut renderer, &mut state, goal, start, progress);
        let film = renderer.into_film();
        state.seconds += start.elapsed().as_secs_f64();
        let saved = self.save(&film, state.seconds);
        state.film = Some(film);
        ended.and(saved)
    }

    /// Writes the checkpoint, where there is one.
    fn save(&self, film: &FilmBuffer, seconds: f64) -> PyResult<()> {
        let Some(path) = &self.checkpoint else {
            return Ok(());
        };
        let label = Label {
            seconds,
            ..self.label.clone()
        };
        FilmFile::write(path, &label, film).map_err(|e| io_error(path, &e))
    }

    fn passes(
        &self,
        renderer: &mut Renderer<'_>,
        state: &mut State,
        goal: RenderGoal,
        start: Instant,
        progress: Option<&Py<PyAny>>,
    ) -> PyResult<()> {
        let mut last = None;
        let (mut saved, mut cost) = (Instant::now(), Duration::ZERO);
        while let Some(done) = renderer.samples_done() {
            let Some(next) = goal.next_pass(done, last, start.elapsed()) else {
                break;
            };
            let pass_start = Instant::now();
            let report = self.pass(renderer, next)?;
            last = Some((next, pass_start.elapsed()));
            state.rays += report.rays;
            if let Some(progress) = progress {
                let film = renderer.film();
                let of_samples = renderer.share_done(goal.most_samples);
                let told = (
                    goal.share_done(of_samples, start.elapsed()),
                    film.most_and_mean_samples().1,
                    film.noise(),
                    state.rays,
                );
                Python::attach(|py| progress.call1(py, told))?;
            }
            let is_due = saved.elapsed() >= SAVE_EVERY.max(cost * SAVE_SHARE);
            if report.complete && is_due {
                let begun = Instant::now();
                let seconds = state.seconds + start.elapsed().as_secs_f64();
                self.save(renderer.film(), seconds)?;
                (saved, cost) = (Instant::now(), begun.elapsed());
            }
        }
        Ok(())
    }

    /// One pass, in the pool. This thread looks for signals meanwhile: only Python's main thread sees them.
    fn pass(&self, renderer: &mut Renderer<'_>, samples: u32) -> PyResult<PassReport> {
        let stop = AtomicBool::new(false);
        let (sender, receiver) = channel();
        let failed = || PyRuntimeError::new_err("the renderer failed: please report this scene");
        self.pool.in_place_scope(|scope| {
            scope.spawn(|_| {
                let pass = || renderer.render_pass(samples, &stop);
                // The receiver is gone where the render was stopped.
                let _ = sender.send(catch_unwind(AssertUnwindSafe(pass)));
            });
            loop {
                match receiver.recv_timeout(POLL) {
                    Ok(report) => return report.map_err(|_| failed()),
                    Err(RecvTimeoutError::Disconnected) => return Err(failed()),
                    Err(RecvTimeoutError::Timeout) => {
                        if let Err(interrupt) = Python::attach(|py| py.check_signals()) {
                            stop.store(true, Ordering::Relaxed);
                            return Err(interrupt);
                        }
                    }
                }
            }
        })
    }
}

/// The film of a checkpoint, with the seconds that it took; `None` where there is no file.
fn resumed(path: &Path, label: &Label) -> PyResult<Option<(FilmBuffer, f64)>> {
    let FilmFile { label: found, film } = match FilmFile::read(path) {
        Ok(file) => file,
        Err(FilmFileError::Io(e)) if e.kind() == ErrorKind::NotFound => return Ok(None),
        Err(FilmFileError::Io(e)) => return Err(io_error(path, &e)),
        Err(e) => {
            return Err(invalid(format!(
                "checkpoint: '{}' cannot be read: {e}",
                path.display()
            )));
        }
    };
    match label.difference(&found) {
        None => Ok(Some((film, found.seconds))),
        Some(difference) => Err(invalid(format!(
            "checkpoint: '{}' holds another render: {difference}",
            path.display()
        ))),
    }
}

/// Bytes in mebibytes, for people.
fn mebibytes(bytes: u64) -> u64 {
    bytes.div_ceil(1 << 20)
}

/// Fails where a render would take more memory than is allowed, or than there is.
fn check_memory(
    scene: &SceneData,
    options: &RenderOptions,
    threads: usize,
    most: Option<u64>,
) -> PyResult<()> {
    let estimate = MemoryEstimate::of_process(scene.scene(), options, threads);
    // What an earlier render has prepared is in the process already, and is taken over or replaced.
    let needed = match scene.is_prepared() {
        true => estimate.film + estimate.pictures,
        false => estimate.still_needed(),
    };
    let peak = estimate.scene + estimate.program + needed;
    if let Some(most) = most.filter(|most| peak > *most) {
        return Err(PyMemoryError::new_err(format!(
            "the process would take {} MiB with this render, more than max_memory, {} MiB",
            mebibytes(peak),
            mebibytes(most)
        )));
    }
    match available_memory() {
        Some(available) if most.is_none() && needed > available => {
            Err(PyMemoryError::new_err(format!(
                "the render would take {} MiB more, and {} MiB are available; max_memory= says what it may take",
                mebibytes(needed),
                mebibytes(available)
            )))
        }
        _ => Ok(()),
    }
}

fn options(
    scene: &SceneData,
    spp: Option<u32>,
    is_bounded: bool,
    seed: u32,
    max_depth: Option<u32>,
    energy: Option<&str>,
    sampler: Option<&str>,
) -> PyResult<RenderOptions> {
    let asked = RenderOptions::from_scene(scene.scene());
    if spp.is_some_and(|n| !(1..=MOST_BY_TIME).contains(&n)) {
        let given = spp.unwrap_or_default();
        return Err(invalid(format!(
            "spp: expected samples in [1, {MOST_BY_TIME}], got {given}"
        )));
    }
    let most = match is_bounded {
        true => MOST_BY_TIME,
        false => asked.samples_per_pixel,
    };
    Ok(RenderOptions {
        samples_per_pixel: spp.unwrap_or(most),
        seed,
        max_depth: max_depth.unwrap_or(asked.max_depth),
        energy: energy.map(named).transpose()?.unwrap_or(asked.energy),
        vndf_sampler: sampler
            .map(named)
            .transpose()?
            .unwrap_or(asked.vndf_sampler),
        ..asked
    })
}

#[pymethods]
impl RenderJob {
    /// Prepares a render; the scene may change afterwards.
    ///
    /// * `spp`: `None` for what the scene asks for; where `is_bounded` by a noise or a time, for any number.
    /// * `noise`: aims at it; 0: samples are spread by their error, and as many as were asked for.
    /// * `checkpoint`: the file that the film is saved in, and gone on with if it is there.
    /// * `max_memory`: bytes that the process may take; `None`: what is available.
    #[new]
    #[pyo3(signature = (scene, *, spp, is_bounded, seed, threads, max_depth, energy, sampler, texture_filter,
        filter_normal_maps, noise, resolution, clamp, regularize, checkpoint, max_memory))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn new(
        py: Python<'_>,
        scene: &Bound<'_, SceneData>,
        spp: Option<u32>,
        is_bounded: bool,
        seed: u32,
        threads: usize,
        max_depth: Option<u32>,
        energy: Option<&str>,
        sampler: Option<&str>,
        texture_filter: &str,
        filter_normal_maps: bool,
        noise: Option<f64>,
        resolution: Option<[u32; 2]>,
        clamp: Option<f64>,
        regularize: bool,
        checkpoint: Option<PathBuf>,
        max_memory: Option<u64>,
    ) -> PyResult<Self> {
        let mut scene = scene.try_borrow_mut()?;
        let mut options = options(&scene, spp, is_bounded, seed, max_depth, energy, sampler)?;
        let single = super::microfacets::single;
        let noise = noise.map(|n| in_range("noise", n, [0.0, 1.0]));
        options.noise = noise.transpose()?.map(single);
        if options.noise.is_some() {
            options.samples_per_pixel = options.samples_per_pixel.min(MOST_SAMPLES);
        }
        options.clamp = match clamp {
            Some(most) if !(most > 0.0 && most.is_finite()) => {
                return Err(invalid(format!(
                    "clamp: expected a number above 0, got {most}"
                )));
            }
            most => most.map(single),
        };
        options.regularize = regularize;
        options.texture_filter = named(texture_filter)?;
        options.filter_normal_maps = filter_normal_maps;
        options.resolution = resolution;
        let pool = ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .map_err(|e| PyRuntimeError::new_err(format!("cannot start threads: {e}")))?;
        check_memory(&scene, &options, pool.current_num_threads(), max_memory)?;
        let (label, film) = match &checkpoint {
            None => (Label::default(), None),
            Some(path) => {
                let label = Label::of(scene.name(), scene.scene(), &options);
                let film = resumed(path, &label)?;
                (label, film)
            }
        };
        let seconds = film.as_ref().map_or(0.0, |(_, seconds)| *seconds);
        Ok(Self {
            prepared: scene.prepare(py, &options, &pool)?,
            scene: scene.name().to_owned(),
            options,
            pool,
            checkpoint,
            label,
            state: Mutex::new(State {
                film: film.map(|(film, _)| film),
                rays: 0,
                seconds,
            }),
        })
    }

    /// Takes samples until every pixel has so many, or the time is over.
    ///
    /// * `samples`: `None` for those of the options, or what the noise takes.
    /// * `progress`: called after every pass with the share that is done, the samples of a pixel on
    ///   average, the estimated noise and the rays so far.
    fn advance(
        &self,
        py: Python<'_>,
        samples: Option<u32>,
        time: Option<f64>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<()> {
        let time = match time {
            None => None,
            Some(seconds) => Some(
                Duration::try_from_secs_f64(seconds)
                    .map_err(|_| invalid(format!("time: expected seconds, got {seconds}")))?,
            ),
        };
        let all = match self.options.noise {
            // What is done is the film's to say.
            Some(_) => MOST_SAMPLES,
            None => self.options.samples_per_pixel,
        };
        let samples = samples.unwrap_or(all);
        let goal = RenderGoal {
            most_samples: samples,
            time,
        };
        py.detach(|| self.run(goal, progress.as_ref()))
    }

    /// Samples per pixel that the render aims at.
    #[getter]
    fn samples(&self) -> u32 {
        self.options.samples_per_pixel
    }

    /// The picture as it is now, with its samples per pixel on average, the estimated noise, the samples
    /// that were not finite, the rays and the seconds.
    fn picture(&self) -> PyResult<(PictureData, f64, f32, u64, u64, f64)> {
        let state = self.state()?;
        let film = (state.film.as_ref()).ok_or_else(|| invalid("the render has not begun"))?;
        let mean = film.most_and_mean_samples().1;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "for people: the nearest number is near enough, and none is below 0"
        )]
        let (samples, seconds) = (mean.round() as u32, state.seconds as f32);
        let metadata = Metadata {
            software: Some(format!("specula {}", env!("CARGO_PKG_VERSION"))),
            scene: Some(self.scene.clone()),
            samples_per_pixel: Some(samples),
            seed: Some(self.options.seed),
            render_seconds: Some(seconds),
            bias: self.options.bias(),
            missing: None,
        };
        let picture = PictureData::new(film.picture(), metadata);
        let noise = film.noise();
        let invalid_samples = film.invalid_samples();
        Ok((
            picture,
            mean,
            noise,
            invalid_samples,
            state.rays,
            state.seconds,
        ))
    }
}
