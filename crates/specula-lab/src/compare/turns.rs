//! Renders of all combinations in turns, so that other load of the machine affects all of them alike.

use std::time::Instant;

use specula_bsdf::vndf::Sampler;
use specula_render::picture::Picture;
use specula_render::{FilmBuffer, PreparedScene, RenderOptions, Renderer, ScatterCounts};
use specula_scene::Energy;

use super::reference::Reference;
use super::{Clock, CompareOptions, estimate};
use crate::{Lab, LabError, Result};

/// Rounds in which each combination has one turn, all of the same length.
const ROUNDS: u32 = 8;
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
    /// The result of each round; `None` where the one before had used up its time.
    pub(super) rounds: Vec<Option<Round>>,
}

/// The result of a combination in a round.
#[derive(Clone, Copy, Debug)]
pub(super) struct Round {
    /// Seconds per sample of all pixels.
    pub(super) pace: f64,
    /// Share of the directions that were rejected.
    pub(super) rejected_share: f64,
}

/// A render that is interrupted and gone on with.
pub(super) struct Render {
    options: RenderOptions,
    film: Option<FilmBuffer>,
    pub(super) seconds: f64,
    pub(super) scattered: ScatterCounts,
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
            rounds: Vec::new(),
        }
    }

    /// Goes on until so many seconds have been rendered for.
    ///
    /// * `share`: of all the work, with so many seconds of this turn.
    fn turn(
        &mut self,
        until: f64,
        scene: &PreparedScene,
        lab: &Lab<'_>,
        share: impl Fn(f64) -> f64,
    ) -> Result<()> {
        let what = self.label();
        let render = &self.render;
        let (seconds, samples, scattered) = (render.seconds, render.samples, render.scattered);
        let step = |now: f64| lab.step(share(now - seconds), &what);
        self.render.until(until, scene, lab, step)?;
        let render = &self.render;
        let taken = render.samples - samples;
        self.rounds.push((taken > 0).then(|| {
            Round {
                pace: (render.seconds - seconds) / f64::from(taken),
                rejected_share: ScatterCounts {
                    sampled: render.scattered.sampled - scattered.sampled,
                    rejected: render.scattered.rejected - scattered.rejected,
                }
                .rejected_share(),
            }
        }));
        Ok(())
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
            scattered: ScatterCounts::default(),
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

    /// Samples that fit into the time that is left.
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
///
/// Every other round goes the other way: a machine that slows down meets all alike, and the scene that is
/// ready is used twice.
pub(super) fn take(
    options: &CompareOptions<'_>,
    entries: &mut [Entry],
    references: &[Reference],
    clock: &Clock,
    lab: &Lab<'_>,
) -> Result<()> {
    let mut before: f64 = references.iter().map(|r| r.seconds).sum();
    let mut ready: Option<(usize, PreparedScene)> = None;
    for round in 0..ROUNDS {
        let until = options.seconds * f64::from(round + 1) / f64::from(ROUNDS);
        for number in order(round, entries.len()) {
            let entry = &mut entries[number];
            let scene = match ready.take() {
                Some((same, scene)) if same == number => scene,
                other => {
                    drop(other);
                    entry.render.prepare(options)?
                }
            };
            let seconds = entry.render.seconds;
            entry.turn(until, &scene, lab, |now| clock.share(before + now))?;
            before += entry.render.seconds - seconds;
            let picture = entry.render.picture()?;
            let mse = estimate::mse(&picture, &references[entry.reference]);
            entry
                .course
                .push([entry.render.seconds, mse.max(0.0).sqrt()]);
            ready = Some((number, scene));
        }
    }
    Ok(())
}

/// There and back.
fn order(round: u32, entries: usize) -> Vec<usize> {
    if round.is_multiple_of(2) {
        (0..entries).collect()
    } else {
        (0..entries).rev().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_have_the_same_mean_turn() {
        let mut sums = [0; 4];
        for round in 0..ROUNDS {
            for (place, number) in order(round, 4).into_iter().enumerate() {
                sums[number] += round as usize * 4 + place;
            }
        }
        assert!(sums.iter().all(|s| *s == sums[0]), "{sums:?}");
    }
}
