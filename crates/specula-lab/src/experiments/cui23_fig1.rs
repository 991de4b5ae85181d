//! Cui et al. 2023, fig. 1: a set of statues in equal time.

use glam::dvec3;

use super::cui23_equal_time::{Judged, Lit, judge};
use super::cui23_models::{BITTERLI, CUI, HEITZ, IMPLEMENTATIONS, SPECULA};
use super::cui23_renders::Trial;
use crate::scenes::lighting::Lighting;
use crate::scenes::statues::decorative_set;
use crate::{Answer, Claim, Experiment, Lab, Result, Source, Verdict};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    id: "cui23-fig1",
    source: Source::Cui23,
    item: "fig. 1",
    title: "a set of statues in equal time",
    statement: "On several statues of different roughness, in direct and indirect light of an \
                environment, a direction and a point, the unidirectional estimator has less noise in \
                equal time than Heitz et al. 2016 (which takes more samples) and Bitterli and d'Eon \
                2022 (which takes fewer).",
    run,
};

fn run(lab: &mut Lab<'_>) -> Result<Verdict> {
    let size = lab.pick([120, 54], [384, 172]);
    let lights = [
        Lighting::Parallel(dvec3(0.6, -0.5, 0.65), 0.6),
        Lighting::Point(dvec3(-2.8, -3.2, 3.4), 12.0),
    ];
    let lit = Lit {
        name: "set",
        caption: "Gold 0.3, aluminium 0.8, copper 1, silver 0.5, brass 0.15; light of an environment \
                  at equal samples, of a direction and a point in equal time, direct and indirect.",
        timed: decorative_set(size, &lights),
        environment: decorative_set(size, &[Lighting::Studio(0.4)]),
        environment_samples: lab.pick(8, 128),
        samples: 16,
        max_depth: 4,
        reference_samples: lab.pick(256, 768),
        rounds: lab.pick(5, 8),
        places: [[0.34, 0.55], [0.51, 0.45], [0.68, 0.6]],
    };
    let models = [CUI, HEITZ, BITTERLI, SPECULA];
    let judged = judge(lab, &lit, &models)?;
    Ok(verdict(&judged))
}

fn verdict(judged: &Judged<4>) -> Verdict {
    let [cui, heitz, bitterli, specula] = &judged.equal_time;
    let [cui_same, heitz_same, bitterli_same, specula_same] = &judged.equal_samples;
    let over = |trial: &Trial| trial.error() / heitz.error();
    let same = |trial: &Trial| trial.error() / heitz_same.error();
    let samples = |trial: &Trial| trial.samples_per_pixel;
    Verdict {
        summary: format!(
            "In equal time the MSE over that of Heitz 2016 is: Cui {:.2}, Bitterli {:.2}, Specula \
             {:.2}.",
            over(cui),
            over(bitterli),
            over(specula)
        ),
        claims: vec![
            Claim::measured(
                "In equal time Cui has less error than Heitz 2016",
                "less noise",
                format!(
                    "{:.2} of its MSE, {} against {} spp",
                    over(cui),
                    samples(cui),
                    samples(heitz)
                ),
                Answer::beyond(cui.deviations_below(heitz)),
            ),
            Claim::measured(
                "And less than Bitterli and d'Eon 2022",
                "less noise",
                format!(
                    "{:.2} of its MSE, {} against {} spp",
                    cui.error() / bitterli.error(),
                    samples(cui),
                    samples(bitterli)
                ),
                Answer::beyond(cui.deviations_below(bitterli)),
            ),
            Claim::measured(
                "Heitz 2016 takes most samples, Bitterli and d'Eon fewest",
                "Heitz more, Bitterli fewer",
                format!(
                    "Heitz {}, Cui {}, Bitterli {}",
                    samples(heitz),
                    samples(cui),
                    samples(bitterli)
                ),
                samples(heitz) > samples(cui) && samples(cui) > samples(bitterli),
            ),
            Claim::law(
                "At equal samples Cui has less error than Heitz 2016",
                "less noise",
                format!(
                    "{:.2} of its MSE (Bitterli {:.2})",
                    same(cui_same),
                    same(bitterli_same)
                ),
                cui_same.deviations_below(heitz_same) > 4.0,
            ),
            Claim::measured(
                "Specula has the least error in equal time",
                "no statement",
                format!(
                    "{:.2} of Heitz's MSE at {} spp (at equal samples {:.2})",
                    over(specula),
                    samples(specula),
                    same(specula_same)
                ),
                Answer::all(
                    [cui, heitz, bitterli]
                        .map(|other| Answer::beyond(specula.deviations_below(other))),
                ),
            ),
        ],
        caveat: format!(
            "Statues and environment of our own; processor time instead of seconds on the wall. Errors \
             are of the directional and the point light's part, which alone takes equal time; the \
             pictures show all. {IMPLEMENTATIONS} The reference's own error is {:.1e} of its mean.",
            judged.reference_error
        ),
    }
}
