//! Renders of one scene by several models in turns: errors against a reference, and times.

use specula_bsdf::multibounce::MultibounceModel;
use specula_render::picture::Picture;
use specula_render::{PreparedScene, RenderOptions};
use specula_scene::{Energy, Scene};
use specula_stat::z_test::Moments;

use super::cui23_models::Shown;
use super::stopwatch::{median, processor_seconds};
use crate::output::{Inset, Shot};
use crate::rendered::render_prepared;
use crate::{Lab, Result};

/// Offset of the seeds of references.
const OTHER_SEED: u32 = 0x5eed;

/// A way to render a scene.
#[derive(Clone, Debug)]
pub(super) struct Way {
    /// In tables.
    pub(super) label: &'static str,
    /// All but the seed.
    pub(super) options: RenderOptions,
}

impl Way {
    /// By a model, with so many samples and paths of so many scatterings at most.
    pub(super) fn of(shown: Shown, samples_per_pixel: u32, max_depth: u32) -> Self {
        Self {
            label: shown.label,
            options: RenderOptions {
                samples_per_pixel,
                max_depth,
                energy: Energy::Multibounce(shown.model),
                ..RenderOptions::default()
            },
        }
    }

    fn with_seed(&self, lab: &Lab<'_>, offset: u32) -> RenderOptions {
        RenderOptions {
            seed: lab.render_seed().wrapping_add(offset),
            ..self.options.clone()
        }
    }
}

/// A picture to compare with.
pub(super) struct Reference {
    /// The picture.
    pub(super) picture: Picture,
    /// Its own variance, mean over pixels and channels.
    pub(super) variance: f64,
}

impl Reference {
    /// Mean squared difference over pixels and channels, without the reference's own variance.
    pub(super) fn mse(&self, picture: &Picture) -> f64 {
        mean_square(&self.picture, picture) - self.variance
    }

    /// Root of the own variance over the mean of the picture.
    pub(super) fn relative_error(&self) -> f64 {
        let sum: f64 = (self.picture.colour.iter())
            .map(|c| f64::from(c.mean()))
            .sum();
        self.variance.sqrt() * self.picture.colour.len() as f64 / sum
    }
}

/// Renders a reference: the mean of two pictures of other seeds, whose difference
/// gives its variance. (The films' own estimates take samples for independent, and are too large.)
pub(super) fn reference(
    lab: &Lab<'_>,
    scene: &Scene,
    model: MultibounceModel,
    samples_per_pixel: u32,
    max_depth: u32,
) -> Result<Reference> {
    let half = |offset: u32| -> Result<Picture> {
        let options = RenderOptions {
            samples_per_pixel: samples_per_pixel / 2,
            max_depth,
            energy: Energy::Multibounce(model),
            seed: lab.render_seed().wrapping_add(OTHER_SEED + offset),
            ..RenderOptions::default()
        };
        Ok(lab.render(scene, &options)?.picture)
    };
    let (a, b) = (half(0)?, half(1)?);
    let variance = 0.25 * mean_square(&a, &b);
    let mut picture = sum(&a, &b);
    for colour in &mut picture.colour {
        *colour *= 0.5;
    }
    Ok(Reference { picture, variance })
}

/// Mean over pixels and channels of the squared difference.
fn mean_square(a: &Picture, b: &Picture) -> f64 {
    let pairs = a.colour.iter().zip(&b.colour);
    let squares = pairs.map(|(a, b)| {
        let d = (*a - *b).cast::<f64>();
        (d.r * d.r + d.g * d.g + d.b * d.b) / 3.0
    });
    squares.sum::<f64>() / a.colour.len() as f64
}

/// The result of a way to render.
pub(super) struct Trial {
    /// The way's.
    pub(super) label: &'static str,
    /// The way's.
    pub(super) samples_per_pixel: u32,
    /// Of the last round.
    pub(super) picture: Picture,
    /// Mean squared error of each round.
    pub(super) mse: Vec<f64>,
    /// Half the mean squared difference of each round from the one before: the variance.
    pub(super) variance: Vec<f64>,
    /// Processor time of each round.
    pub(super) seconds: Vec<f64>,
}

impl Trial {
    /// As it is shown beside others.
    pub(super) fn shot(&self) -> Shot<'_> {
        Shot {
            label: self.label,
            picture: &self.picture,
            note: format!("{} spp, MSE {:.2e}", self.samples_per_pixel, self.error()),
        }
    }

    /// Median of the mean squared errors of the rounds: of a render as one sees it, without the rare
    /// firefly.
    pub(super) fn error(&self) -> f64 {
        median(self.mse.iter().copied())
    }

    /// Mean of them.
    pub(super) fn mean_error(&self) -> f64 {
        mean(&self.mse)
    }

    /// Median time.
    pub(super) fn time(&self) -> f64 {
        median(self.seconds.iter().copied())
    }

    /// By how many standard errors the logarithm of its error is below another's, paired by round.
    pub(super) fn deviations_below(&self, other: &Self) -> f64 {
        let mut apart = Moments::default();
        for (a, b) in self.mse.iter().zip(&other.mse) {
            apart.push((b.max(1e-30) / a.max(1e-30)).ln());
        }
        apart.mean() / apart.variance_of_mean().sqrt()
    }

    /// Samples that take `seconds`, to the next multiple of four: the renderer's points within a
    /// pixel are evenly spread there, and one more makes edges worse.
    pub(super) fn samples_in(&self, seconds: f64) -> u32 {
        let samples = f64::from(self.samples_per_pixel) * seconds / self.time();
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a number of samples"
        )]
        let fours = (0.25 * samples).round().max(1.0) as u32;
        4 * fours
    }
}

/// The mean.
pub(super) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Renders each way in turns, `rounds` times with seeds of their own.
///
/// * `shares`: where the experiment's progress begins and ends.
pub(super) fn trials<const N: usize>(
    lab: &Lab<'_>,
    scene: &Scene,
    ways: &[Way; N],
    rounds: u32,
    reference: &Reference,
    shares: [f64; 2],
) -> Result<[Trial; N]> {
    let prepared = (ways.iter())
        .map(|way| Ok(PreparedScene::new(scene, &way.options)?))
        .collect::<Result<Vec<_>>>()?;
    let mut trials = ways.each_ref().map(|way| Trial {
        label: way.label,
        samples_per_pixel: way.options.samples_per_pixel,
        picture: Picture::default(),
        mse: Vec::new(),
        variance: Vec::new(),
        seconds: Vec::new(),
    });
    for round in 0..rounds {
        for (i, (way, prepared)) in ways.iter().zip(&prepared).enumerate() {
            let done = f64::from(round) + i as f64 / ways.len() as f64;
            let share = shares[0] + (shares[1] - shares[0]) * done / f64::from(rounds);
            lab.step(share, way.label)?;
            let begin = processor_seconds();
            let rendered = render_prepared(prepared, &way.with_seed(lab, round), lab.stop())?;
            let seconds = processor_seconds() - begin;
            let picture = rendered.picture;
            let trial = &mut trials[i];
            trial.mse.push(reference.mse(&picture));
            if round > 0 {
                let half = 0.5 * mean_square(&trial.picture, &picture);
                trial.variance.push(half);
            }
            trial.seconds.push(seconds);
            trial.picture = picture;
        }
    }
    Ok(trials)
}

/// The ways with as many samples as take what the first does with `first_samples`; each trial is
/// that of the way.
pub(super) fn at_equal_time<const N: usize>(
    ways: &[Way; N],
    trials: &[Trial; N],
    first_samples: u32,
) -> [Way; N] {
    let mut ways = ways.clone();
    let first = &trials[0];
    let seconds = first.time() * f64::from(first_samples) / f64::from(first.samples_per_pixel);
    for (way, trial) in ways.iter_mut().zip(trials) {
        way.options.samples_per_pixel = trial.samples_in(seconds);
    }
    ways
}

/// The sum of the colours of pictures of equal size: of the same scene in different lights.
pub(super) fn sum(a: &Picture, b: &Picture) -> Picture {
    let pairs = a.colour.iter().zip(&b.colour);
    Picture::from_colour(a.width, a.height, pairs.map(|(a, b)| *a + *b).collect())
}

/// Squares about places that are given as shares of width and height; `share` of the height wide.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "pixels of a picture"
)]
pub(super) fn insets<const N: usize>(
    picture: &Picture,
    places: [[f64; 2]; N],
    share: f64,
) -> Vec<Inset> {
    let [width, height] = [picture.width, picture.height].map(f64::from);
    let side = (share * height).round().max(4.0);
    let from = |place: f64, size: f64| (place * size - 0.5 * side).clamp(0.0, size - side) as u32;
    let inset = |[x, y]: [f64; 2]| Inset {
        x: from(x, width),
        y: from(y, height),
        width: side as u32,
        height: side as u32,
    };
    places.map(inset).into()
}
