//! Renders of one scene by several samplers of visible normals, in turns: errors, times and rays.

use specula_bsdf::Rgb;
use specula_bsdf::energy::{EnergyModel, FmsVariant};
use specula_bsdf::vndf::Sampler;
use specula_render::picture::Picture;
use specula_render::{PreparedScene, RenderOptions};
use specula_scene::{Energy, Scene};
use specula_stat::z_test::Moments;

use super::stopwatch::{median, processor_seconds};
use crate::rendered::render_prepared;
use crate::{Lab, Result};

/// Turquin's compensation with the reflectance along the normal, as Tokuyoshi and Eto 2024 render.
pub(super) const TURQUIN: Energy =
    Energy::Compensated(EnergyModel::Turquin(FmsVariant::NormalIncidence));

/// A sampler as tables and plots show it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Way {
    pub(super) name: &'static str,
    pub(super) sampler: Sampler,
    pub(super) style: usize,
}

const fn way(name: &'static str, sampler: Sampler, style: usize) -> Way {
    Way {
        name,
        sampler,
        style,
    }
}

/// The cap first: others are compared with it.
pub(super) const CAP_BOUNDED_EXACT: [Way; 3] = [
    way("cap", Sampler::Cap, 3),
    way("bounded", Sampler::Bounded, 2),
    way("exact", Sampler::Exact, 1),
];

/// All four, the cap first.
pub(super) const ALL_WAYS: [Way; 4] = [
    CAP_BOUNDED_EXACT[0],
    CAP_BOUNDED_EXACT[1],
    CAP_BOUNDED_EXACT[2],
    way("heitz", Sampler::Heitz, 6),
];

/// Options of the renders by each sampler.
pub(super) struct Plan {
    /// But for sampler and seed.
    pub(super) options: RenderOptions,
    /// Renders of different seeds, an even number.
    pub(super) rounds: u32,
}

/// The results of a sampler.
pub(super) struct Trial {
    pub(super) way: Way,
    /// The mean of all rounds, with its estimated variance.
    pub(super) picture: Picture,
    /// Variance of a render of independent samples, mean over pixels and channels, a value per round.
    pub(super) variance: Vec<f64>,
    /// Mean squared error of a render, from the difference of two, a value per two rounds. Samples are
    /// stratified: it is below `variance`.
    pub(super) squares: Vec<f64>,
    /// Processor time, a value per round.
    pub(super) seconds: Vec<f64>,
    /// Rays of a sample, a value per round.
    pub(super) rays: Vec<f64>,
    /// Directions sampled for a sample, a value per round.
    pub(super) directions: Vec<f64>,
    /// Share of them that was rejected, a value per round.
    pub(super) rejected: Vec<f64>,
    /// Of an even round, until that of the next.
    waiting: Option<Picture>,
}

/// A picture to compare with, and its own mean squared error.
pub(super) struct Reference {
    pub(super) picture: Picture,
    pub(super) square: f64,
}

impl Trial {
    /// Root of the mean squared distance of the picture from a reference, without the reference's own
    /// share.
    pub(super) fn rmse(&self, reference: &Reference) -> f64 {
        let square = mean_square(&reference.picture, &self.picture) - reference.square;
        square.max(0.0).sqrt()
    }

    /// Root of the mean variance of one sample.
    ///
    /// * `samples`: of a pixel and a round.
    pub(super) fn sample_deviation(&self, samples: u32) -> f64 {
        (mean(&self.variance) * f64::from(samples)).sqrt()
    }

    fn empty(way: Way, like: &Picture) -> Self {
        let black = Rgb::BLACK;
        let mut picture =
            Picture::from_colour(like.width, like.height, vec![black; like.colour.len()]);
        picture.variance = picture.colour.clone();
        Self {
            way,
            picture,
            variance: Vec::new(),
            squares: Vec::new(),
            seconds: Vec::new(),
            rays: Vec::new(),
            directions: Vec::new(),
            rejected: Vec::new(),
            waiting: None,
        }
    }

    /// Adds a render's share of so many to the mean of all.
    fn add(&mut self, rendered: Picture, rounds: u32) {
        let share = 1.0 / f64::from(rounds);
        let pairs = self.picture.colour.iter_mut().zip(&rendered.colour);
        pairs.for_each(|(sum, c)| *sum += *c * narrow(share));
        let pairs = self.picture.variance.iter_mut().zip(&rendered.variance);
        pairs.for_each(|(sum, c)| *sum += *c * narrow(share * share));
        self.variance.push(mean_variance(&rendered));
        match self.waiting.take() {
            Some(first) => self.squares.push(0.5 * mean_square(&first, &rendered)),
            None => self.waiting = Some(rendered),
        }
    }

    /// `time / that of base`, the median over rounds.
    pub(super) fn time_ratio(&self, base: &Self) -> f64 {
        median(self.seconds.iter().zip(&base.seconds).map(|(a, b)| a / b))
    }

    /// Rays over those of `base`.
    pub(super) fn ray_ratio(&self, base: &Self) -> f64 {
        mean(&self.rays) / mean(&base.rays)
    }
}

/// By how many standard errors the mean of `a` lies above that of `b`, a value per round.
pub(super) fn deviations_above(a: &[f64], b: &[f64]) -> f64 {
    let mut apart = Moments::default();
    apart.extend(a.iter().zip(b).map(|(a, b)| a - b));
    apart.mean() / apart.variance_of_mean().sqrt()
}

/// The mean; not a number where there is no value.
pub(super) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// The mean of two renders by the exact sampler with multiple importance sampling, of seeds of their own.
///
/// * `samples`: of a pixel, both renders together.
/// * `share`: of the progress.
pub(super) fn reference(
    lab: &Lab<'_>,
    scene: &Scene,
    options: &RenderOptions,
    samples: u32,
    share: f64,
) -> Result<Reference> {
    let half = |seed| {
        lab.step(share, "reference")?;
        let options = RenderOptions {
            samples_per_pixel: samples / 2,
            vndf_sampler: Sampler::Exact,
            strategy: specula_render::Strategy::Mis,
            seed: lab.render_seed().wrapping_add(seed),
            ..options.clone()
        };
        lab.render(scene, &options)
    };
    let [mut picture, second] = [half(0x5eed)?.picture, half(0x5eee)?.picture];
    let square = 0.25 * mean_square(&picture, &second);
    let pairs = picture.colour.iter_mut().zip(&second.colour);
    pairs.for_each(|(a, b)| *a = (*a + *b) * 0.5);
    Ok(Reference { picture, square })
}

/// A scene that is prepared for each of several samplers.
pub(super) struct Prepared(Vec<(Way, PreparedScene)>);

impl Prepared {
    /// * `options`: their treatment of energy and their resolution hold for all renders.
    pub(super) fn new(scene: &Scene, ways: &[Way], options: &RenderOptions) -> Result<Self> {
        let prepare = |way: &Way| {
            let options = RenderOptions {
                vndf_sampler: way.sampler,
                ..options.clone()
            };
            Ok((*way, PreparedScene::new(scene, &options)?))
        };
        ways.iter().map(prepare).collect::<Result<_>>().map(Self)
    }
}

/// Renders by each sampler in turns; all renders are independent.
///
/// * `shares`: where the experiment's progress begins and ends.
pub(super) fn trials(
    lab: &Lab<'_>,
    prepared: &Prepared,
    plan: &Plan,
    shares: [f64; 2],
) -> Result<Vec<Trial>> {
    let mut trials: Vec<Trial> = Vec::new();
    let mut render = 0;
    for round in 0..plan.rounds {
        for (i, (way, scene)) in prepared.0.iter().enumerate() {
            let done = f64::from(round) + i as f64 / prepared.0.len() as f64;
            let share = shares[0] + (shares[1] - shares[0]) * done / f64::from(plan.rounds);
            lab.step(share, way.name)?;
            let options = RenderOptions {
                vndf_sampler: way.sampler,
                seed: lab.render_seed().wrapping_add(render),
                ..plan.options.clone()
            };
            let begin = processor_seconds();
            let rendered = render_prepared(scene, &options, lab.stop())?;
            let seconds = processor_seconds() - begin;
            render += 1;
            let picture = rendered.picture;
            let samples = f64::from(plan.options.samples_per_pixel) * picture.colour.len() as f64;
            if round == 0 {
                trials.push(Trial::empty(*way, &picture));
            }
            let trial = &mut trials[i];
            trial.add(picture, plan.rounds);
            trial.seconds.push(seconds);
            trial.rays.push(rendered.rays as f64 / samples);
            let sampled = rendered.scattered.sampled as f64;
            trial.directions.push(sampled / samples);
            trial.rejected.push(rendered.scattered.rejected_share());
        }
    }
    Ok(trials)
}

/// Mean over pixels and channels of a render's estimate of its variance.
fn mean_variance(picture: &Picture) -> f64 {
    let sum: f64 = (picture.variance.iter().flat_map(|c| c.to_array()))
        .map(f64::from)
        .sum();
    sum / (3 * picture.variance.len()) as f64
}

#[expect(clippy::cast_possible_truncation, reason = "pictures are in f32")]
fn narrow(value: f64) -> f32 {
    value as f32
}

fn mean_square(a: &Picture, b: &Picture) -> f64 {
    let pairs = a.colour.iter().zip(&b.colour);
    let sum: f64 = pairs
        .flat_map(|(a, b)| (*a - *b).to_array())
        .map(|d| f64::from(d).powi(2))
        .sum();
    sum / (3 * a.colour.len()) as f64
}
