//! Cui et al. 2023, fig. 7: three pots with different densities of multiple importance sampling.

use specula_bsdf::multibounce::MisPdf;
use specula_render::RenderOptions;

use super::cui23_models::{CUI, CUI_BIDIRECTIONAL, SPECULA, Shown};
use super::cui23_renders::{Reference, Trial, Way, insets, reference, trials};
use crate::output::{PictureComparison, Table};
use crate::scenes::pots::pots;
use crate::{Answer, Claim, Experiment, Lab, Result, Source, Verdict};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    id: "cui23-fig7",
    source: Source::Cui23,
    item: "fig. 7",
    title: "three pots with different densities of multiple importance sampling",
    statement: "On three aluminium pots (alpha 0.15, 0.2 and 0.1) in an environment's light at 16 \
                samples per pixel, the density with Hapke's term leaves less noise than single bounce \
                and a Lambertian term.",
    run,
};

const SAMPLES: u32 = 16;
const DIRECT: u32 = 1;
/// Pictures that are shown.
const SHOTS: [usize; 5] = [0, 1, 3, 4, 8];

fn run(lab: &mut Lab<'_>) -> Result<Verdict> {
    lab.step(0.0, "rendering the reference")?;
    let scene = pots(lab.pick([96, 48], [320, 160]));
    let truth = reference(lab, &scene, SPECULA.model, lab.pick(512, 2048), DIRECT)?;
    let way = |shown: Shown, label: &'static str, mis_pdf: MisPdf| Way {
        label,
        options: RenderOptions {
            mis_pdf,
            // As the paper's renderer.
            mis_compensation: false,
            ..Way::of(shown, SAMPLES, DIRECT).options
        },
    };
    let ways = [
        way(CUI, "Cui 2023, Lambert", MisPdf::Lambert),
        way(CUI, "Cui 2023, Hapke", MisPdf::Hapke),
        way(CUI, "Cui 2023, normalised", MisPdf::Normalised),
        way(
            CUI_BIDIRECTIONAL,
            "Cui bidirectional, Lambert",
            MisPdf::Lambert,
        ),
        way(CUI_BIDIRECTIONAL, "Cui bidirectional, Hapke", MisPdf::Hapke),
        way(
            CUI_BIDIRECTIONAL,
            "Cui bidirectional, normalised",
            MisPdf::Normalised,
        ),
        way(SPECULA, "Specula, Lambert", MisPdf::Lambert),
        way(SPECULA, "Specula, Hapke", MisPdf::Hapke),
        way(SPECULA, "Specula, normalised", MisPdf::Normalised),
    ];
    let rounds = lab.pick(10, 12);
    let done = trials(lab, &scene, &ways, rounds, &truth, [0.4, 0.95])?;
    lab.table(table(&done))?;
    lab.comparison(&PictureComparison {
        name: "pots",
        caption: "Aluminium, alpha 0.15, 0.2 and 0.1, environment, 16 samples per pixel: estimator and \
                  density.",
        shots: SHOTS.map(|i| done[i].shot()).into(),
        reference: Some(&truth.picture),
        insets: insets(&truth.picture, [[0.2, 0.6], [0.5, 0.6], [0.8, 0.6]], 0.3),
        exposure_stops: 0.0,
    })?;
    Ok(verdict(&done, &truth))
}

fn table(trials: &[Trial]) -> Table {
    let mut table = Table::new(
        "errors",
        "At 16 samples per pixel, over seeds; time of the processor, median.",
        &["density", "MSE, median", "MSE, mean", "time [ms]"],
    );
    for trial in trials {
        table.push([
            trial.label.into(),
            trial.error().into(),
            trial.mean_error().into(),
            (1e3 * trial.time()).into(),
        ]);
    }
    table
}

fn verdict(trials: &[Trial; 9], truth: &Reference) -> Verdict {
    let [
        one_lambert,
        one_hapke,
        _,
        lambert,
        hapke,
        normalised,
        specula_lambert,
        specula_hapke,
        specula,
    ] = trials;
    let ratio = |a: &Trial, b: &Trial| a.error() / b.error();
    let compared = |a: &Trial, b: &Trial| {
        format!(
            "MSE ratio {:.3}, {:.1} standard errors",
            ratio(a, b),
            a.deviations_below(b).abs()
        )
    };
    Verdict {
        summary: format!(
            "MSE with Hapke's term over that with Lambert's: {:.2} with Cui's bidirectional \
             estimator, {:.2} with the unidirectional one, {:.2} with Specula's.",
            ratio(hapke, lambert),
            ratio(one_hapke, one_lambert),
            ratio(specula_hapke, specula_lambert)
        ),
        claims: vec![
            Claim::law(
                "With the bidirectional estimator Hapke's term leaves less noise than Lambert's",
                "less noise",
                compared(hapke, lambert),
                hapke.deviations_below(lambert) > 4.0,
            ),
            Claim::measured(
                "With the unidirectional one too",
                "less noise",
                compared(one_hapke, one_lambert),
                Answer::beyond(one_hapke.deviations_below(one_lambert)),
            ),
            Claim::law(
                "Specula's normalised density leaves less noise than Lambert's",
                "no statement",
                format!(
                    "{} with Cui's bidirectional estimator, {:.3} with Specula's",
                    compared(normalised, lambert),
                    ratio(specula, specula_lambert)
                ),
                normalised.deviations_below(lambert) > 4.0,
            ),
        ],
        caveat: format!(
            "Pots and environment of our own, on a floor so dark that noise is of the metal; direct \
             light only, the environment sampled by luminance. (Sampled by what exceeds \
             the environment's mean, as Specula does, it leaves Cui's bidirectional estimator the same noise \
             with each density.) The paper does not say which of its estimators it shows. A smaller density \
             gives samples of the light more weight, whose evaluation is noisy: that pays only with a \
             good estimator. The H of eq. 15 is the repaired one. The reference's own error is {:.1e} \
             of its mean.",
            truth.relative_error()
        ),
    }
}
