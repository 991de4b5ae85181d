//! Tokuyoshi and Eto 2024, fig. 1: path tracing of interiors with caps and with bounded caps.

use specula_render::Strategy;

use super::room_pictures::{
    Budget, RoomResult, add_rows, fireplace_room, kitchen_room, render_room, show, table,
};
use super::sampler_trials::{deviations_above, mean, reference};
use crate::{Answer, Claim, Experiment, Lab, Result, Source, Verdict};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    id: "tokuyoshi24-fig1",
    source: Source::Tokuyoshi24,
    item: "fig. 1",
    title: "path tracing of interiors",
    statement: "Bounded caps reduce the noise of caps at equal samples while they increase the depth of \
                paths, especially for rough surfaces.",
    run,
};

fn run(lab: &mut Lab<'_>) -> Result<Verdict> {
    let budget = Budget {
        width: lab.pick(96, 384),
        samples: lab.pick(8, 16),
        rounds: 4,
        reference_samples: lab.pick(64, 256),
    };
    let mut table = table();
    let mut all = Vec::new();
    for (i, room) in [fireplace_room(), kitchen_room()].into_iter().enumerate() {
        let at = |within: f64| 0.5 * (i as f64 + within);
        let strategy = Strategy::BsdfOnly;
        let reference = reference(
            lab,
            &room.scene,
            &budget.options(strategy),
            budget.reference_samples,
            at(0.0),
        )?;
        let shares = [at(0.4), at(0.95)];
        let found = render_room(lab, &room, &budget, strategy, &reference, shares)?;
        let caption = format!(
            "The {} by path tracing without rays to lights, Turquin's compensation.",
            room.name
        );
        show(lab, &room, &budget, &caption, &found, &reference)?;
        add_rows(&mut table, &room, &budget, strategy, &found, &reference);
        all.push((room.name, found));
    }
    lab.table(table)?;
    Ok(verdict(&all))
}

fn verdict(all: &[(&str, Vec<RoomResult>)]) -> Verdict {
    let each = |value: &dyn Fn(&[RoomResult]) -> String| -> String {
        (all.iter())
            .map(|(name, found)| format!("{name}: {}", value(found)))
            .collect::<Vec<_>>()
            .join("; ")
    };
    let rmse = each(&|f| {
        let [cap, bounded, exact] = [0, 1, 2].map(|i| f[i].rmse);
        format!("cap {cap:.4}, bounded {bounded:.4}, exact {exact:.4}")
    });
    let below = |f: &[RoomResult], i: usize, j: usize| {
        deviations_above(&f[i].trial.variance, &f[j].trial.variance)
    };
    let rays = each(&|f| {
        let [cap, bounded, exact] = [0, 1, 2].map(|i| mean(&f[i].trial.rays));
        format!("cap {cap:.3}, bounded {bounded:.3}, exact {exact:.3}")
    });
    let longer =
        |f: &[RoomResult], i: usize, j: usize| mean(&f[i].trial.rays) > mean(&f[j].trial.rays);
    let less = |f: &[RoomResult], i: usize, j: usize| {
        mean(&f[i].trial.variance) > mean(&f[j].trial.variance)
    };
    Verdict {
        summary: format!("RMSE at equal samples: {rmse}."),
        claims: vec![
            Claim::law(
                "Bounded caps have less noise than caps at equal samples",
                "less",
                each(&|f| {
                    let ratio = f[1].rmse / f[0].rmse;
                    format!(
                        "RMSE x {ratio:.3}; variance of a sample less by {:.0} standard errors",
                        below(f, 0, 1)
                    )
                }),
                all.iter().all(|(_, f)| less(f, 0, 1)),
            ),
            Claim::law(
                "They increase the depth of paths",
                "longer paths",
                format!("rays per sample, {rays}"),
                all.iter().all(|(_, f)| longer(f, 1, 0)),
            ),
            Claim::law(
                "The exact sampler goes further in depth",
                "not in the paper",
                format!("rays per sample, {rays}"),
                all.iter().all(|(_, f)| longer(f, 2, 1)),
            ),
            Claim::measured(
                "The exact sampler has less noise than bounded caps",
                "not in the paper",
                each(&|f| {
                    let ratio = f[2].rmse / f[1].rmse;
                    format!(
                        "RMSE x {ratio:.3}; variance of a sample less by {:.1} standard errors",
                        below(f, 1, 2)
                    )
                }),
                Answer::all(all.iter().map(|(_, f)| Answer::beyond(below(f, 1, 2)))),
            ),
        ],
        caveat:
            "Rooms of our own; the paper's pictures are 3840 x 2160 from a graphics card. Russian \
                 roulette from the third bounce."
                .to_owned(),
    }
}
