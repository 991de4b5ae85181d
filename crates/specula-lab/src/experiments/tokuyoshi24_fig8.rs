//! Tokuyoshi and Eto 2024, fig. 8: multiple importance sampling in a room with rough surfaces.

use specula_render::Strategy;

use super::room_pictures::{
    Budget, RoomResult, add_rows, fireplace_room, render_room, show, table,
};
use super::sampler_trials::{deviations_above, mean, reference};
use crate::{Answer, Claim, Experiment, Lab, Result, Source, Verdict};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    id: "tokuyoshi24-fig8",
    source: Source::Tokuyoshi24,
    item: "fig. 8",
    title: "multiple importance sampling in the fireplace room",
    statement: "Multiple importance sampling reduces the noise of caps, but on rough surfaces that are \
                lit indirectly caps are still noisy; bounded caps reduce that noise significantly.",
    run,
};

fn run(lab: &mut Lab<'_>) -> Result<Verdict> {
    let budget = Budget {
        width: lab.pick(96, 384),
        samples: lab.pick(8, 16),
        rounds: 4,
        reference_samples: lab.pick(128, 512),
    };
    let room = fireplace_room();
    let options = budget.options(Strategy::Mis);
    let reference = reference(lab, &room.scene, &options, budget.reference_samples, 0.0)?;
    let mut table = table();
    let mut render = |strategy, shares| -> Result<Vec<RoomResult>> {
        let found = render_room(lab, &room, &budget, strategy, &reference, shares)?;
        add_rows(&mut table, &room, &budget, strategy, &found, &reference);
        Ok(found)
    };
    let mis = render(Strategy::Mis, [0.3, 0.65])?;
    let plain = render(Strategy::BsdfOnly, [0.65, 0.95])?;
    let caption = "The fireplace room with multiple importance sampling, Turquin's compensation.";
    show(lab, &room, &budget, caption, &mis, &reference)?;
    lab.table(table)?;
    Ok(verdict(&mis, &plain))
}

fn verdict(mis: &[RoomResult], plain: &[RoomResult]) -> Verdict {
    let rmse = |found: &[RoomResult]| [0, 1, 2].map(|i| found[i].rmse);
    let [cap, bounded, exact] = rmse(mis);
    let plain_rmse = rmse(plain);
    let below =
        |a: &RoomResult, b: &RoomResult| deviations_above(&a.trial.variance, &b.trial.variance);
    let less = |a: &RoomResult, b: &RoomResult| mean(&a.trial.variance) > mean(&b.trial.variance);
    let outliers = [0, 1, 2].map(|i| mis[i].outlier);
    Verdict {
        summary: format!(
            "RMSE with multiple importance sampling: cap {cap:.4}, bounded {bounded:.4}, exact {exact:.4}; \
             without: {:.4}, {:.4}, {:.4}.",
            plain_rmse[0], plain_rmse[1], plain_rmse[2]
        ),
        claims: vec![
            Claim::law(
                "Multiple importance sampling reduces the noise of caps",
                "less",
                format!(
                    "RMSE x {:.3}; variance of a sample less by {:.0} standard errors",
                    cap / plain_rmse[0],
                    below(&plain[0], &mis[0])
                ),
                less(&plain[0], &mis[0]),
            ),
            Claim::law(
                "With it, bounded caps have less noise than caps",
                "significantly less",
                format!(
                    "RMSE x {:.3}; variance of a sample less by {:.0} standard errors",
                    bounded / cap,
                    below(&mis[0], &mis[1])
                ),
                less(&mis[0], &mis[1]),
            ),
            Claim::measured(
                "What is left of outliers with caps, bounded caps reduce more than the noise",
                "fireflies are significantly reduced",
                format!(
                    "brightest pixel of a thousand too bright by: cap {:.3}, bounded {:.3}, exact {:.3}",
                    outliers[0], outliers[1], outliers[2]
                ),
                outliers[1] / outliers[0] < bounded / cap,
            ),
            Claim::measured(
                "The exact sampler has less noise than bounded caps",
                "not in the paper",
                format!(
                    "RMSE x {:.3}; variance of a sample less by {:.1} standard errors; rays x {:.4}",
                    exact / bounded,
                    below(&mis[1], &mis[2]),
                    mean(&mis[2].trial.rays) / mean(&mis[1].trial.rays)
                ),
                Answer::beyond(below(&mis[1], &mis[2])),
            ),
        ],
        caveat:
            "A room of our own; the paper's pictures are 3840 x 2160 from a graphics card. Russian \
                 roulette from the third bounce."
                .to_owned(),
    }
}
