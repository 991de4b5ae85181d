//! Cui et al. 2023, fig. 9: three vases in equal time.

use glam::dvec3;

use super::cui23_equal_time::{Judged, Lit, judge};
use super::cui23_models::{CUI_BIDIRECTIONAL, HEITZ, IMPLEMENTATIONS, SPECULA, WANG};
use super::cui23_renders::Trial;
use crate::scenes::lighting::Lighting;
use crate::scenes::statues::vases;
use crate::{Answer, Claim, Experiment, Lab, Result, Source, Verdict};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    id: "cui23-fig9",
    source: Source::Cui23,
    item: "fig. 9",
    title: "three vases in equal time",
    statement: "On three vases (copper, GGX 0.1; aluminium, Beckmann 0.6; gold, GGX 0.5) in direct \
                light of an environment and a point, the bidirectional estimator has the least error \
                in equal time (17 samples per pixel against 34 of Heitz et al. 2016 and 23 of Wang et \
                al. 2022); Wang et al. have little noise but a bias.",
    run,
};

/// Of the bidirectional estimator under the point light; the paper's 17, as a power of two for the sampler.
const SAMPLES: u32 = 16;
const DIRECT: u32 = 1;

fn run(lab: &mut Lab<'_>) -> Result<Verdict> {
    let size = lab.pick([96, 60], [320, 200]);
    let point = Lighting::Point(dvec3(-2.6, -3.4, 3.6), 40.0);
    let environment = Lighting::Studio(0.6);
    let lit = Lit {
        name: "vases",
        caption: "Copper (GGX, 0.1), aluminium (Beckmann, 0.6), gold (GGX, 0.5), direct light of an \
                  environment at equal samples and of a point in equal time.",
        timed: vases(size, &[point]),
        environment: vases(size, &[environment]),
        environment_samples: lab.pick(16, 256),
        samples: SAMPLES,
        max_depth: DIRECT,
        reference_samples: lab.pick(256, 1024),
        rounds: lab.pick(6, 8),
        places: [[0.18, 0.45], [0.48, 0.6], [0.78, 0.6]],
    };
    let models = [CUI_BIDIRECTIONAL, HEITZ, WANG, SPECULA];
    let judged = judge(lab, &lit, &models)?;
    Ok(verdict(&judged))
}

fn verdict(judged: &Judged<4>) -> Verdict {
    let [cui, heitz, wang, specula] = &judged.equal_time;
    let [cui_same, heitz_same, wang_same, specula_same] = &judged.equal_samples;
    let over = |trial: &Trial| trial.error() / heitz.error();
    let same = |trial: &Trial| trial.error() / heitz_same.error();
    Verdict {
        summary: format!(
            "In equal time the MSE over that of Heitz 2016 is: Cui bidirectional {:.2}, Wang {:.2}, \
             Specula {:.2}.",
            over(cui),
            over(wang),
            over(specula)
        ),
        claims: vec![
            Claim::measured(
                "In equal time the bidirectional estimator has less error than Heitz 2016",
                "highest quality",
                format!(
                    "{:.2} of its MSE, {} against {} spp",
                    over(cui),
                    cui.samples_per_pixel,
                    heitz.samples_per_pixel
                ),
                Answer::beyond(cui.deviations_below(heitz)),
            ),
            Claim::measured(
                "And less than Wang 2022",
                "highest quality; Wang is biased",
                format!(
                    "{:.2} of its MSE, {} against {} spp",
                    cui.error() / wang.error(),
                    cui.samples_per_pixel,
                    wang.samples_per_pixel
                ),
                Answer::beyond(cui.deviations_below(wang)),
            ),
            Claim::law(
                "At equal samples the bidirectional estimator has less error than both",
                "less noise",
                format!(
                    "{:.2} of Heitz's MSE (Wang's is {:.2})",
                    same(cui_same),
                    same(wang_same)
                ),
                cui_same.deviations_below(heitz_same) > 4.0
                    && cui_same.deviations_below(wang_same) > 4.0,
            ),
            Claim::measured(
                "Specula has the least error in equal time",
                "no statement",
                format!(
                    "{:.2} of Heitz's MSE at {} spp (at equal samples {:.2})",
                    over(specula),
                    specula.samples_per_pixel,
                    same(specula_same)
                ),
                Answer::all(
                    [cui, heitz, wang].map(|other| Answer::beyond(specula.deviations_below(other))),
                ),
            ),
        ],
        caveat: format!(
            "Vases and environment of our own; processor time instead of seconds on the wall; Wang 2022 \
             from one end. Errors are of the point light's part, which alone takes equal time; the \
             pictures show both. {IMPLEMENTATIONS} The reference's own error is {:.1e} of its mean.",
            judged.reference_error
        ),
    }
}
