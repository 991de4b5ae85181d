//! Cui et al. 2023, fig. 6: a ball of rough copper at equal samples.

use super::cui23_models::{
    BITTERLI, CUI, CUI_BIDIRECTIONAL, HEITZ, IMPLEMENTATIONS, SPECULA, WANG,
};
use super::cui23_renders::{Reference, Trial, Way, insets, mean, reference, trials};
use crate::output::{PictureComparison, Table};
use crate::scenes::testball::testball;
use crate::{Answer, Claim, Experiment, Lab, Result, Source, Verdict};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    id: "cui23-fig6",
    source: Source::Cui23,
    item: "fig. 6",
    title: "copper ball at equal samples",
    statement: "On a copper ball (alpha = 1) in directional light at 4 samples per pixel the \
                bidirectional estimator has the lowest error, in slightly more time; Bitterli and \
                d'Eon 2022 have the variance of the unidirectional one, in more time; Wang et al. \
                2022 has little noise, but its bias.",
    run,
};

const SAMPLES: u32 = 4;
/// Light that the metal reflects at once: all noise is of its evaluation.
const DIRECT: u32 = 1;

fn run(lab: &mut Lab<'_>) -> Result<Verdict> {
    lab.step(0.0, "rendering the reference")?;
    let scene = testball(lab.pick(80, 160), 1.0);
    let truth = reference(lab, &scene, HEITZ.model, lab.pick(512, 2048), DIRECT)?;
    let shown = [CUI, CUI_BIDIRECTIONAL, WANG, BITTERLI, HEITZ, SPECULA];
    let ways = shown.map(|shown| Way::of(shown, SAMPLES, DIRECT));
    let rounds = lab.pick(16, 32);
    let done = trials(lab, &scene, &ways, rounds, &truth, [0.4, 0.9])?;
    lab.table(table(&done))?;
    lab.comparison(&PictureComparison {
        name: "ball",
        caption: "Copper, alpha = 1, directional light, 4 samples per pixel.",
        shots: done.iter().map(Trial::shot).collect(),
        reference: Some(&truth.picture),
        insets: insets(&truth.picture, [[0.4, 0.3], [0.45, 0.55]], 0.2),
        exposure_stops: 0.0,
    })?;
    Ok(verdict(&done, &truth))
}

fn table(trials: &[Trial]) -> Table {
    let mut table = Table::new(
        "errors",
        "At 4 samples per pixel, medians over seeds; time of the processor.",
        &["model", "MSE", "variance", "MSE - variance", "time [ms]"],
    );
    for trial in trials {
        let (error, variance) = (trial.error(), mean(&trial.variance));
        table.push([
            trial.label.into(),
            error.into(),
            variance.into(),
            (error - variance).into(),
            (1e3 * trial.time()).into(),
        ]);
    }
    table
}

fn verdict(trials: &[Trial; 6], truth: &Reference) -> Verdict {
    let [cui, both, wang, bitterli, heitz, specula] = trials;
    let ratio = |a: &Trial, b: &Trial| a.error() / b.error();
    let times = |a: &Trial, b: &Trial| a.time() / b.time();
    let published = [cui, wang, bitterli, heitz];
    let margin = published
        .iter()
        .map(|t| both.deviations_below(t))
        .fold(f64::INFINITY, f64::min);
    let variance = |t: &Trial| mean(&t.variance);
    Verdict {
        summary: format!(
            "MSE at 4 spp over that of Heitz 2016: Cui {:.2}, bidirectional {:.2}, Wang {:.2}, \
             Bitterli {:.2}, Specula {:.2}.",
            ratio(cui, heitz),
            ratio(both, heitz),
            ratio(wang, heitz),
            ratio(bitterli, heitz),
            ratio(specula, heitz)
        ),
        claims: vec![
            Claim::law(
                "The bidirectional estimator has the lowest error of the published ones",
                "lowest",
                format!(
                    "{:.2} of Cui from one end, {:.2} of Wang, {:.2} of Bitterli; {margin:.0} \
                     standard errors at least",
                    ratio(both, cui),
                    ratio(both, wang),
                    ratio(both, bitterli)
                ),
                margin > 4.0,
            ),
            Claim::measured(
                "It takes slightly longer than the unidirectional one",
                "slightly longer",
                format!("{:.2} times (of the whole render)", times(both, cui)),
                (1.0..1.5).contains(&times(both, cui)),
            ),
            Claim::refuted(
                "At equal samples Bitterli and d'Eon have the variance of the unidirectional one",
                "the same",
                format!(
                    "MSE of the unidirectional one over Bitterli {:.2}",
                    ratio(cui, bitterli)
                ),
                (ratio(cui, bitterli) - 1.0).abs() < 0.1,
            ),
            Claim::measured(
                "Bitterli and d'Eon take longer",
                "higher time cost",
                format!("{:.2} times (of the whole render)", times(bitterli, cui)),
                times(bitterli, cui) > 1.0,
            ),
            Claim::measured(
                "Wang 2022 has little noise, but by its bias more error than Heitz 2016",
                "larger error than Heitz 2016",
                format!(
                    "MSE {:.2} of its variance, but {:.2} of Heitz's MSE",
                    wang.error() / variance(wang),
                    ratio(wang, heitz)
                ),
                Answer::beyond(heitz.deviations_below(wang)),
            ),
            Claim::law(
                "Specula has less error than the unidirectional one at equal samples",
                "no statement",
                format!("{:.2}", ratio(specula, cui)),
                specula.deviations_below(cui) > 4.0,
            ),
        ],
        caveat: format!(
            "A ball of our own instead of Matpreview; direct light only, so that all noise is of the \
             metal's evaluation. Wang 2022 from one end (the paper also shows a bidirectional \
             version). {IMPLEMENTATIONS} The reference's own error is {:.1e} of its mean.",
            truth.relative_error()
        ),
    }
}
