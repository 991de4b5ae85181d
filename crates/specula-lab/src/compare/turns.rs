//! Renders of all combinations in turns, so that what else the machine does meets all of them alike.

use std::time::Instant;

use specula_bsdf::vndf::Sampler;
use specula_render::picture::Picture;
use specula_render::{FilmBuffer, PreparedScene, RenderOptions, Renderer, Scattered};
use specula_scene::Energy;

use super::reference::Reference;
use super::{Clock, CompareOptions, estimate};
use crate::{Lab, LabError, Result};

/// Times at which each combination has had its turns, as shares of the whole.
pub(super) const TURNS: [f64; 5] = [1.0 / 16.0, 0.125, 0.25, 0.5, 1.0];
/// Seconds of a pass at most, so that progress is seen.
const LONGEST_PASS: f64 = 1.0;

/// A combination and what it has rendered.
pub(super) struct Entry {
    pub(super) sampler: Sampler,
    pub(super) energy: Energy,
    /// Which of the references is its own.
    pub(super) reference: usize,
    /// From here on as [`Render`].
    pub(super) render: Render,
    /// Time and root of the mean squared error after each turn.
    pub(super) course: Vec<[f64; 2]>,
    /// Seconds per sample of each turn.
    pub(super) paces: Vec<f64>,
}

/// A render that is interrupted and gone on with.
pub(super) struct Render {
    options: RenderOptions,
    film: Option<FilmBuffer>,
    pub(super) seconds: f64,
    pub(super) scattered: Scattered,
    pub(super) samples: u32,
}

impl Entry {
    /// * `number`: of the combination, for its seed.
    pub(super) fn new(
        options: &CompareOptions<'_>,
        sampler: Sampler,
        energy: Energy,
        reference: usize,
        number: usize,
    ) -> Self {
        Self {
            sampler,
            energy,
            reference,
            render: Render::new(options, sampler, energy, number),
            course: Vec::new(),
            paces: Vec::new(),
        }
    }

    /// Sampler and treatment in words.
    pub(super) fn label(&self) -> String {
        format!("{}, {}", self.sampler, self.energy)
    }
}

impl Render {
    /// * `number`: renders of different ones are independent.
    #[expect(
        clippy::cast_possible_truncation,
        reason = "the low bits of a seed will do"
    )]
    pub(super) fn new(
        options: &CompareOptions<'_>,
        vndf_sampler: Sampler,
        energy: Energy,
        number: usize,
    ) -> Self {
        let seed = (options.seed as u32).wrapping_mul(1024);
        Self {
            options: RenderOptions {
                vndf_sampler,
                energy,
                seed: seed.wrapping_add(number as u32),
                first_sample: 0,
                noise: None,
                ..options.render.clone()
            },
            film: None,
            seconds: 0.0,
            scattered: Scattered::default(),
            samples: 0,
        }
    }

    /// Goes on until so many seconds have been rendered for, one sample per pixel at least.
    ///
    /// * `step`: says how far it is, in seconds.
    pub(super) fn until(
        &mut self,
        seconds: f64,
        scene: &PreparedScene,
        lab: &Lab<'_>,
        step: impl Fn(f64) -> Result<()>,
    ) -> Result<()> {
        let wrong = |e| LabError::Output(format!("{e}"));
        let mut renderer = match self.film.take() {
            None => Renderer::new(scene, self.options.clone()),
            Some(film) => Renderer::resume(scene, self.options.clone(), film).map_err(wrong)?,
        };
        while self.seconds < seconds || self.samples == 0 {
            let pass = self.next_pass(seconds);
            let begin = Instant::now();
            let report = renderer.render_pass(pass, lab.stop());
            self.seconds += begin.elapsed().as_secs_f64();
            if !report.complete {
                return Err(LabError::Stopped);
            }
            self.samples = report.samples_done_total;
            self.scattered = self.scattered.and(report.scattered.unwrap_or_default());
            step(self.seconds)?;
        }
        self.film = Some(renderer.film().clone());
        Ok(())
    }

    /// Samples that fit into what is left.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "saturates, and is not below 1"
    )]
    fn next_pass(&self, until: f64) -> u32 {
        if self.samples == 0 {
            return 1;
        }
        let pace = self.seconds / f64::from(self.samples);
        let left = (until - self.seconds).min(LONGEST_PASS);
        (left / pace).round().max(1.0) as u32
    }

    pub(super) fn prepare(&self, options: &CompareOptions<'_>) -> Result<PreparedScene> {
        Ok(PreparedScene::new(options.scene, &self.options)?)
    }

    /// What has been rendered so far.
    pub(super) fn picture(&self) -> Result<Picture> {
        match &self.film {
            Some(film) => Ok(film.picture()),
            None => Err(LabError::Output("nothing has been rendered".to_owned())),
        }
    }
}

/// Renders all entries. Only one of them has its scene made ready at a time.
pub(super) fn take(
    options: &CompareOptions<'_>,
    entries: &mut [Entry],
    references: &[Reference],
    clock: &Clock,
    lab: &Lab<'_>,
) -> Result<()> {
    let mut before: f64 = references.iter().map(|r| r.seconds).sum();
    for turn in TURNS {
        for entry in entries.iter_mut() {
            let scene = entry.render.prepare(options)?;
            let (seconds, samples) = (entry.render.seconds, entry.render.samples);
            let what = entry.label();
            let step = |now: f64| lab.step(clock.share(before + now - seconds), &what);
            let until = turn * options.seconds;
            entry.render.until(until, &scene, lab, step)?;
            let taken = entry.render.samples - samples;
            if taken > 0 {
                let pace = (entry.render.seconds - seconds) / f64::from(taken);
                entry.paces.push(pace);
            }
            before += entry.render.seconds - seconds;
            let picture = entry.render.picture()?;
            let mse = estimate::mse(&picture, &references[entry.reference]);
            entry
                .course
                .push([entry.render.seconds, mse.max(0.0).sqrt()]);
        }
    }
    Ok(())
}
