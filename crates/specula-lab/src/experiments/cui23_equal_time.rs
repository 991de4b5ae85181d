//! Renders of statues in equal time: shared by figs. 1 and 9 of Cui et al. 2023.
//!
//! As there, light of an environment is rendered with samples of its own, so that the difference in
//! the rest is the evaluation of the metals; the pictures are sums of both.

use specula_render::picture::Picture;
use specula_scene::Scene;

use super::cui23_models::{SPECULA, Shown};
use super::cui23_renders::{Trial, Way, at_equal_time, insets, reference, sum, trials};
use crate::output::{PictureComparison, Shot, Table};
use crate::{Lab, Result};

/// A scene in two lights.
pub(super) struct Lit {
    /// Of the files.
    pub(super) name: &'static str,
    /// Of the comparison.
    pub(super) caption: &'static str,
    /// In the lights that are rendered in equal time.
    pub(super) timed: Scene,
    /// In the environment's light.
    pub(super) environment: Scene,
    /// Of all models there.
    pub(super) environment_samples: u32,
    /// Of the first model in the other lights.
    pub(super) samples: u32,
    /// Scatterings of a path.
    pub(super) max_depth: u32,
    /// Of the references.
    pub(super) reference_samples: u32,
    /// Renders of each.
    pub(super) rounds: u32,
    /// What is shown enlarged, as shares of width and height.
    pub(super) places: [[f64; 2]; 3],
}

/// Results, by model.
pub(super) struct Judged<const N: usize> {
    /// In the timed lights, with as many samples for all.
    pub(super) equal_samples: [Trial; N],
    /// In as much time as the first takes.
    pub(super) equal_time: [Trial; N],
    /// Of the reference, over its mean.
    pub(super) reference_error: f64,
}

/// Renders, writes table and comparison.
pub(super) fn judge<const N: usize>(
    lab: &mut Lab<'_>,
    lit: &Lit,
    models: &[Shown; N],
) -> Result<Judged<N>> {
    lab.step(0.0, "rendering the references")?;
    let many = lit.reference_samples;
    let truth = reference(lab, &lit.timed, SPECULA.model, many, lit.max_depth)?;
    lab.step(0.15, "rendering the references")?;
    let under_sky = reference(lab, &lit.environment, SPECULA.model, many, lit.max_depth)?;
    let ways = models.map(|shown| Way::of(shown, lit.samples, lit.max_depth));
    let equal_samples = trials(lab, &lit.timed, &ways, lit.rounds, &truth, [0.3, 0.5])?;
    let timed = at_equal_time(&ways, &equal_samples, lit.samples);
    let equal_time = trials(lab, &lit.timed, &timed, lit.rounds, &truth, [0.5, 0.75])?;
    let ways = models.map(|shown| Way::of(shown, lit.environment_samples, lit.max_depth));
    let environment = trials(lab, &lit.environment, &ways, 1, &under_sky, [0.75, 0.95])?;
    lab.table(table(&equal_samples, &equal_time, &environment))?;
    let pictures: Vec<Picture> = (equal_time.iter().zip(&environment))
        .map(|(a, b)| sum(&a.picture, &b.picture))
        .collect();
    let shots = pictures
        .iter()
        .zip(&equal_time)
        .map(|(picture, trial)| Shot {
            label: trial.label,
            picture,
            note: format!(
                "{} spp, {:.2} s, MSE {:.2e}",
                trial.samples_per_pixel,
                trial.time(),
                trial.error()
            ),
        });
    lab.comparison(&PictureComparison {
        name: lit.name,
        caption: lit.caption,
        shots: shots.collect(),
        reference: Some(&sum(&truth.picture, &under_sky.picture)),
        insets: insets(&truth.picture, lit.places, 0.24),
        exposure_stops: 0.0,
    })?;
    Ok(Judged {
        equal_samples,
        equal_time,
        reference_error: truth.relative_error(),
    })
}

fn table<const N: usize>(
    equal_samples: &[Trial; N],
    equal_time: &[Trial; N],
    environment: &[Trial; N],
) -> Table {
    let mut table = Table::new(
        "errors",
        "Mean squared errors and processor time, medians over seeds.",
        &["part", "model", "samples per pixel", "time [s]", "MSE"],
    );
    for (part, trials) in [
        ("equal samples", equal_samples),
        ("equal time", equal_time),
        ("environment", environment),
    ] {
        for trial in trials {
            table.push([
                part.into(),
                trial.label.into(),
                trial.samples_per_pixel.into(),
                trial.time().into(),
                trial.error().into(),
            ]);
        }
    }
    table
}
