//! A running render: passes, progress, checkpoints, and what is written in the end.

use crate::cli::ExitCode;
use std::time::{Duration, Instant};

use crate::render::{FilmBuffer, InvalidSample, RenderGoal, Renderer, ScatterCounts, VertexCounts};

use super::checkpoint::Checkpoint;
use super::console::say;
use super::device::{self, GpuError, Samples};
use super::live_view::LiveView;
use super::noise_report::{self, NoiseWatch};
use super::outputs::{self, Outputs};
use super::progress::{Progress, State, short};
use super::stop::{Signal, Stop};
use super::{Failure, watch};

/// A render that is about to begin.
pub(crate) struct Job<'a> {
    pub(crate) goal: RenderGoal,
    pub(crate) renderer: Renderer<'a>,
    pub(crate) source: Samples<'a>,
    pub(crate) outputs: &'a Outputs,
    pub(crate) checkpoint: Checkpoint,
    pub(crate) stop: &'a Stop,
    pub(crate) live_view: Option<&'a mut LiveView>,
    pub(crate) denoised: bool,
    pub(crate) quiet: bool,
    /// Whether the counts of the render are printed.
    pub(crate) stats: bool,
    /// Whether pictures are written every few seconds, for somebody who looks at them.
    pub(crate) is_watched: bool,
}

/// Results of the passes so far.
#[derive(Default)]
struct Sum {
    rays: u64,
    /// `None`: nothing counts them.
    counts: Option<(VertexCounts, ScatterCounts)>,
    invalid: u64,
    one_invalid: Option<InvalidSample>,
    /// Whether a picture could not be written during the render.
    is_warned: bool,
}

impl Job<'_> {
    /// Renders and writes; code 130 where Ctrl-C ended it early, 143 and 129 where SIGTERM and SIGHUP did.
    pub(crate) fn run(mut self) -> Result<ExitCode, Failure> {
        let start = Instant::now();
        let mut progress = Progress::new(self.quiet);
        let sum = self.passes(start, &mut progress)?;
        progress.finish();
        if let Some(view) = &mut self.live_view {
            match self.is_watched {
                true => view.show(self.renderer.film()),
                false => view.finish(self.renderer.film()),
            }
        }
        let seconds = start.elapsed().as_secs_f64();
        let signal = self.stop.signal();
        if signal.is_some() {
            // First: nothing is lost if a picture cannot be written.
            self.checkpoint.save(self.renderer.film(), seconds);
        }
        if self.stop.changed() {
            // Another render begins at once, of what the scene is by now.
            return Ok(ExitCode::SUCCESS);
        }
        self.write_all(seconds, signal.is_some())?;
        if sum.invalid > 0 {
            let one = (sum.one_invalid).map_or_else(String::new, |s| self.describe(&s));
            let count = sum.invalid;
            say!("warning: {count} samples were not finite and count as black{one}");
        }
        if !self.quiet || signal.is_some() {
            self.print_summary(sum.rays, seconds, signal);
        }
        if self.stats {
            say!("{}", statistics(sum.counts));
        }
        Ok(ExitCode::from(signal.map_or(0, Signal::exit_code)))
    }

    /// Takes samples until the goal is reached, or somebody stops it.
    fn passes(&mut self, start: Instant, progress: &mut Progress) -> Result<Sum, Failure> {
        let mut sum = Sum {
            invalid: self.renderer.film().invalid_samples(),
            ..Sum::default()
        };
        let mut noise = NoiseWatch::new(self.renderer.options());
        let mut last = None;
        let mut written: Option<Instant> = None;
        while !self.stop.asked() && !self.stop.changed() {
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
            sum.rays += report.rays;
            if let (Some(vertices), Some(scattered)) = (report.vertices, report.scattered) {
                let so_far = sum.counts.unwrap_or_default();
                sum.counts = Some((so_far.0.and(vertices), so_far.1.and(scattered)));
            }
            sum.invalid = report.invalid_samples;
            sum.one_invalid = sum.one_invalid.or(report.invalid);
            let film = self.renderer.film();
            // An estimate reads the whole film.
            if progress.is_due() || noise.is_watching() {
                let estimate = film.noise_estimate();
                let of_samples = self.renderer.share_done(self.goal.most_samples);
                progress.show(&State {
                    share_done: self.goal.share_done(of_samples, start.elapsed()),
                    samples: samples(film),
                    rays_per_second: sum.rays as f64 / start.elapsed().as_secs_f64(),
                    noise: estimate.relative,
                });
                let most = self.renderer.options().samples_per_pixel;
                let mean = film.most_and_mean_samples().1;
                let time = (start.elapsed(), self.goal.time);
                let note = noise.after_pass((mean, &estimate), time, most);
                if let Some(note) = note.filter(|_| !self.quiet) {
                    progress.aside(|| say!("{note}"));
                }
            }
            if let Some(view) = &mut self.live_view {
                view.update(film);
            }
            let seconds = start.elapsed().as_secs_f64();
            if report.complete && self.checkpoint.is_due() {
                self.checkpoint.save(self.renderer.film(), seconds);
                self.write_meanwhile(seconds, &mut sum);
            } else if report.complete
                && self.is_watched
                && written.is_none_or(|at| at.elapsed() >= watch::PICTURE_EVERY)
            {
                self.write_meanwhile(seconds, &mut sum);
                written = Some(Instant::now());
            }
        }
        Ok(sum)
    }

    /// Writes the pictures so far. A render goes on where that fails: there may be room again in the end.
    fn write_meanwhile(&self, seconds: f64, sum: &mut Sum) {
        if let Err(failure) = self.write_pictures(seconds, false) {
            if !sum.is_warned {
                say!("warning: {}; the render goes on", failure.message());
            }
            sum.is_warned = true;
        }
    }

    /// Writes the pictures and the film, each whether or not the others can be written. Where one cannot,
    /// the samples are saved.
    fn write_all(&mut self, seconds: f64, interrupted: bool) -> Result<(), Failure> {
        let pictures = self.write_pictures(seconds, self.denoised);
        let film = match (interrupted, &pictures) {
            // Written already.
            (true, _) => Ok(()),
            (false, Ok(())) => self.checkpoint.finish(self.renderer.film(), seconds),
            (false, Err(_)) => Ok(()),
        };
        Failure::join(pictures, film)
            .map_err(|failure| failure.and(&self.checkpoint.rescue(self.renderer.film(), seconds)))
    }

    /// Saves the samples so far where the device failed.
    fn give_up<T>(&mut self, error: &GpuError, elapsed: Duration) -> Result<T, Failure> {
        let seconds = elapsed.as_secs_f64();
        let saved = self.checkpoint.rescue(self.renderer.film(), seconds);
        Err(device::failed(error, &format!("; {saved}")))
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
            sample.sample
        )
    }

    /// * `seconds`: of this run.
    fn write_pictures(&self, seconds: f64, denoised: bool) -> Result<(), Failure> {
        let film = self.renderer.film();
        let label = self.checkpoint.label(seconds);
        let seed = Some(self.renderer.options().seed);
        let metadata = outputs::metadata(film, &label, seed);
        self.outputs.write_pictures(film, &metadata, denoised)
    }

    fn print_summary(&self, rays: u64, seconds: f64, signal: Option<Signal>) {
        let names = self.outputs.names();
        let options = self.renderer.options();
        let asked_for = options.noise.is_some_and(|noise| noise > 0.0);
        let noise = noise_report::summary(self.renderer.film(), asked_for);
        let bias = (options.bias()).map_or_else(String::new, |b| format!(", biased ({b})"));
        let lead = signal.map_or_else(
            || "wrote".to_owned(),
            |s| format!("stopped by {}; wrote what there is to", s.name()),
        );
        let end = match (signal, self.checkpoint.path()) {
            (Some(_), Some(path)) => format!("; --resume goes on with {}", path.display()),
            _ => String::new(),
        };
        say!(
            "{lead} {names}: {}, energy {}{noise}{bias}, {} ({:.2} Mrays/s){end}",
            samples(self.renderer.film()),
            options.energy,
            short(seconds),
            rays as f64 * 1e-6 / seconds.max(1e-9),
        );
    }
}

/// What `--stats` prints.
fn statistics(counts: Option<(VertexCounts, ScatterCounts)>) -> String {
    let Some((vertices, scattered)) = counts else {
        return "statistics: none, as only the processor counts".to_owned();
    };
    let [batched, bound, single] = vertices.shares().map(|share| 100.0 * share);
    format!(
        "statistics: {} vertices, {batched:.2} % shaded in batches, {bound:.2} % but for their lobes, {single:.2} % \
         singly; {:.2} % of {} samples of lobes rejected",
        vertices.total(),
        100.0 * scattered.rejected_share(),
        scattered.sampled,
    )
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
