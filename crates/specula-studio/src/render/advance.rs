//! `render.advance`: passes of samples, and the picture so far.

use std::sync::atomic::AtomicBool;

use serde::Deserialize;
use serde_json::json;
use specula_render::{RenderGoal, Renderer};

use super::session::{Progress, Session};
use crate::clock::seconds;
use crate::{Answer, AskError};

/// Longest time that can be asked for at once, in seconds.
const MOST_SECONDS: f64 = 60.0;
/// Most samples that can be asked for at once.
const MOST_SAMPLES: u32 = 1 << 16;
/// Most samples of a pixel in all.
const MOST_IN_ALL: u32 = RenderGoal::MOST_BY_TIME;
/// Share of the time that is left which a pass is to take: the rate is a guess.
const SHARE: f64 = 0.8;

/// `render.advance`
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Advance {
    pub(super) session: u64,
    seconds: Option<f64>,
    samples: Option<u32>,
    #[serde(default)]
    wants: Vec<Layer>,
}

/// A layer of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Layer {
    Colour,
    Variance,
    Albedo,
    Normal,
    Depth,
}

/// When to stop.
#[derive(Clone, Copy)]
struct Goal {
    seconds: f64,
    samples: u32,
}

impl Advance {
    fn goal(&self) -> Result<Goal, AskError> {
        if self.seconds.is_none() && self.samples.is_none() {
            return Err(AskError::new("expected seconds or samples"));
        }
        let seconds = self.seconds.unwrap_or(f64::INFINITY);
        if self.seconds.is_some() && !(0.0..=MOST_SECONDS).contains(&seconds) {
            return Err(AskError::new(format!(
                "seconds: expected a time in [0, {MOST_SECONDS}], got {seconds}"
            )));
        }
        let samples = self.samples.unwrap_or(MOST_SAMPLES);
        if !(1..=MOST_SAMPLES).contains(&samples) {
            return Err(AskError::new(format!(
                "samples: expected a number in [1, {MOST_SAMPLES}], got {samples}"
            )));
        }
        Ok(Goal { seconds, samples })
    }
}

impl Session {
    /// Answers `render.advance`.
    pub(super) fn advance(&mut self, asked: &Advance) -> Result<Answer, AskError> {
        let goal = asked.goal()?;
        let done = self.film().map_or(0, |film| film.complete_samples());
        let samples = goal.samples.min(MOST_IN_ALL - done.min(MOST_IN_ALL));
        let goal = Goal { samples, ..goal };
        self.with_renderer(|renderer, progress| passes(renderer, progress, goal))?;
        Ok(self.shown(&asked.wants))
    }

    /// What is known of the picture, and the layers that are wanted.
    fn shown(&self, wants: &[Layer]) -> Answer {
        let Some(film) = self.film() else {
            return Answer::default();
        };
        let [width, height] = self.resolution().map(|side| side as usize);
        let colour = film.colour();
        let count = colour.len().max(1) as f64;
        let sum = colour.iter().fold([0.0; 3], |sum: [f64; 3], c| {
            let c = c.to_array();
            [0, 1, 2].map(|i| sum[i] + f64::from(c[i]))
        });
        let noise = film.noise();
        let mut answer = Answer::new(json!({
            "samples": film.complete_samples(),
            "seconds": self.progress.seconds,
            "rays": self.progress.rays,
            "invalid": film.invalid_samples(),
            "mean": sum.map(|s| s / count),
            // JSON has no infinity; nothing is known of the error below two samples.
            "noise": if noise.is_finite() { noise } else { 1.0 },
        }));
        let wanted = |layer| wants.contains(&layer);
        if wanted(Layer::Colour) {
            answer = answer.with_f32(
                "colour",
                &[height, width, 3],
                &flat(&colour, |c| c.to_array()),
            );
        }
        if !wants.iter().any(|&layer| layer != Layer::Colour) {
            return answer;
        }
        let picture = film.picture();
        let of_colours = [
            (Layer::Variance, "variance", &picture.variance),
            (Layer::Albedo, "albedo", &picture.albedo),
        ];
        for (layer, name, values) in of_colours {
            if wanted(layer) {
                answer =
                    answer.with_f32(name, &[height, width, 3], &flat(values, |c| c.to_array()));
            }
        }
        if wanted(Layer::Normal) {
            let normal = flat(&picture.normal, |n| n.to_array());
            answer = answer.with_f32("normal", &[height, width, 3], &normal);
        }
        if wanted(Layer::Depth) {
            answer = answer.with_f32("depth", &[height, width], &picture.depth);
        }
        answer
    }
}

/// Takes samples until so many are taken, or the time is over; one at least.
fn passes(renderer: &mut Renderer<'_>, progress: &mut Progress, goal: Goal) {
    let start = seconds();
    let (mut taken, mut elapsed) = (0, 0.0);
    while taken < goal.samples {
        let rest = goal.seconds - elapsed;
        let fitting = fitting(rest, progress.per_sample);
        if taken > 0 && fitting < 0.5 {
            break;
        }
        let samples = whole(SHARE * fitting).clamp(1, goal.samples - taken);
        let report = renderer.render_pass(samples, &AtomicBool::new(false));
        let now = seconds() - start;
        progress.per_sample = Some((now - elapsed) / f64::from(samples));
        progress.rays += report.rays;
        taken += samples;
        elapsed = now;
    }
    progress.seconds += elapsed;
}

/// Samples that fit into a time.
fn fitting(rest: f64, per_sample: Option<f64>) -> f64 {
    match per_sample {
        _ if rest == f64::INFINITY => f64::INFINITY,
        _ if rest <= 0.0 => 0.0,
        Some(per_sample) => rest / per_sample.max(1e-9),
        None => 1.0,
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "saturates, which is what is wanted"
)]
fn whole(samples: f64) -> u32 {
    samples as u32
}

fn flat<T>(values: &[T], array: impl Fn(&T) -> [f32; 3]) -> Vec<f32> {
    values.iter().flat_map(array).collect()
}
