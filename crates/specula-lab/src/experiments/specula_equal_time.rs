//! Ours: variance times processor time of all samplers, in rooms and on orbs, with and without
//! compensation.

use specula_render::RenderOptions;
use specula_scene::{Energy, Scene};

use super::room_pictures::{bathroom_room, fireplace_room, kitchen_room};
use super::sampler_trials::{ALL_WAYS, Plan, Prepared, TURQUIN, Trial, deviations_above, mean, trials};
use super::stopwatch::median;
use crate::output::Table;
use crate::plot::{Axis, Content, Figure, Panel, Series};
use crate::{Claim, Experiment, Lab, Result, Source, Verdict};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    id: "specula-equal-time",
    source: Source::Specula,
    item: "equal time",
    title: "variance at equal time of all samplers",
    statement: "What a sampler costs in time it more than gives back in variance: at equal time bounded \
                caps are better than caps and the exact sampler than bounded caps wherever rough metal \
                lights rough metal, and none is worse elsewhere.",
    run,
};

/// Four scenes: name, scene, columns and rows of the picture.
fn scenes() -> [(&'static str, Scene, [u32; 2]); 4] {
    [
        ("fireplace room", fireplace_room().scene, [16, 9]),
        ("kitchen", kitchen_room().scene, [16, 9]),
        ("bathroom", bathroom_room().scene, [16, 9]),
        ("orbs", specula_scene::builtin::orbs(), [12, 5]),
    ]
}

/// One sampler in one scene.
struct Row {
    scene: &'static str,
    energy: &'static str,
    sampler: &'static str,
    /// Variance of a sample over the cap's.
    variance: f64,
    /// Mean squared error of a picture over the cap's.
    square: f64,
    /// Time over the cap's.
    cost: f64,
    /// By how many standard errors the variance lies below the cap's.
    below: f64,
}

impl Row {
    fn inefficiency(&self) -> f64 {
        self.square * self.cost
    }
}

fn run(lab: &mut Lab<'_>) -> Result<Verdict> {
    let mut table = Table::new(
        "equal-time",
        "Variance of a sample and mean squared error (MSE) of pictures of stratified samples, means over \
         pixels; multiple importance sampling, paths of up to 1024 bounces. Processor times in turns, \
         medians of quotients.",
        &[
            "scene",
            "energy",
            "sampler",
            "variance of a sample [radiance^2]",
            "time of a sample [us]",
            "rays per sample",
            "variance over cap's",
            "MSE over cap's",
            "time over cap's",
            "MSE x time over cap's",
        ],
    );
    let mut rows = Vec::new();
    let mut panels = Vec::new();
    for (i, (name, scene, aspect)) in scenes().iter().enumerate() {
        for (j, (energy_name, energy)) in [("turquin", TURQUIN), ("none", Energy::None)]
            .into_iter()
            .enumerate()
        {
            let at = |n: usize| n as f64 / 8.0;
            let shares = [at(2 * i + j), at(2 * i + j + 1)];
            let options = options(lab, *aspect, energy);
            let samples = f64::from(options.samples_per_pixel);
            let plan = Plan {
                options,
                rounds: lab.pick(4, 6),
            };
            let prepared = Prepared::new(scene, &ALL_WAYS, &plan.options)?;
            let trials = trials(lab, &prepared, &plan, shares)?;
            for trial in &trials {
                let row = Row {
                    scene: name,
                    energy: energy_name,
                    sampler: trial.way.name,
                    variance: mean(&trial.variance) / mean(&trials[0].variance),
                    square: mean(&trial.squares) / mean(&trials[0].squares),
                    cost: trial.time_ratio(&trials[0]),
                    below: deviations_above(&trials[0].variance, &trial.variance),
                };
                let pixels = trial.picture.colour.len() as f64;
                table.push([
                    (*name).into(),
                    energy_name.into(),
                    trial.way.name.into(),
                    (mean(&trial.variance) * samples).into(),
                    (1e6 * median(trial.seconds.iter().copied()) / samples / pixels).into(),
                    mean(&trial.rays).into(),
                    row.variance.into(),
                    row.square.into(),
                    row.cost.into(),
                    row.inefficiency().into(),
                ]);
                rows.push(row);
            }
            panels.push(panel(&format!("{name}, {energy_name}"), &trials, samples));
        }
    }
    lab.table(table)?;
    let caption = "Variance of a pixel of 4 to 256 independent samples over the time of the picture.";
    lab.plot("equal-time", caption, &Figure::grid(4, by_energy(panels)))?;
    Ok(verdict(&rows))
}

fn options(lab: &Lab<'_>, [across, up]: [u32; 2], energy: Energy) -> RenderOptions {
    let height = lab.pick(36, 135);
    RenderOptions {
        samples_per_pixel: lab.pick(8, 12),
        max_depth: 1024,
        energy,
        resolution: Some([height * across / up, height]),
        ..RenderOptions::default()
    }
}

/// Panels of the first treatment in the first row.
fn by_energy(panels: Vec<Panel>) -> Vec<Panel> {
    let (first, second): (Vec<_>, Vec<_>) =
        (panels.into_iter().enumerate()).partition(|(i, _)| i % 2 == 0);
    first.into_iter().chain(second).map(|(_, p)| p).collect()
}

/// Variance falls with the number of samples as its reciprocal, and time grows with it.
fn panel(title: &str, trials: &[Trial], samples: f64) -> Panel {
    let line = |trial: &Trial| -> Vec<[f64; 2]> {
        let time = median(trial.seconds.iter().copied()) / samples;
        let variance = mean(&trial.variance) * samples;
        [4.0, 16.0, 64.0, 256.0]
            .map(|n| [time * n, variance / n])
            .to_vec()
    };
    Panel {
        title: title.to_owned(),
        x: Axis::logarithmic("processor time [s]"),
        y: Axis::logarithmic("variance [radiance^2]"),
        content: Content::Lines(
            (trials.iter())
                .map(|t| Series::new(t.way.name, t.way.style, line(t)))
                .collect(),
        ),
    }
}

fn verdict(rows: &[Row]) -> Verdict {
    let of = |sampler: &str, energy: &str, value: &dyn Fn(&Row) -> f64| -> Vec<(String, f64)> {
        (rows.iter())
            .filter(|r| r.sampler == sampler && r.energy == energy)
            .map(|r| (r.scene.to_owned(), value(r)))
            .collect()
    };
    let text = |found: &[(String, f64)]| -> String {
        (found.iter())
            .map(|(scene, value)| format!("{scene} {value:.3}"))
            .collect::<Vec<_>>()
            .join(", ")
    };
    let variance = |r: &Row| r.variance;
    let both = Row::inefficiency;
    let bounded = of("bounded", "turquin", &variance);
    let exact = of("exact", "turquin", &variance);
    let below = ["bounded", "exact"].map(|s| of(s, "turquin", &|r| r.below)[0].clone());
    let bounded_cost = of("bounded", "turquin", &both);
    let exact_cost = of("exact", "turquin", &both);
    let plain = of("exact", "none", &variance);
    let heitz = of("heitz", "none", &|r| r.cost);
    Verdict {
        summary: format!(
            "MSE x time over the cap's under Turquin's compensation: bounded {}; exact {}.",
            text(&bounded_cost),
            text(&exact_cost)
        ),
        claims: vec![
            Claim::law(
                "Bounded caps and the exact sampler have less variance than caps by samples, in the \
                 fireplace room under Turquin's compensation",
                "below 1",
                format!(
                    "bounded x {:.3}, exact x {:.3}; {:.0} and {:.0} standard errors",
                    bounded[0].1, exact[0].1, below[0].1, below[1].1
                ),
                bounded[0].1 < 1.0 && exact[0].1 < 1.0,
            ),
            Claim::measured(
                "At equal time bounded caps are no worse than caps",
                "at most 1.02",
                text(&bounded_cost),
                bounded_cost.iter().all(|b| b.1 <= 1.02),
            ),
            Claim::measured(
                "At equal time the exact sampler is no worse than caps",
                "at most 1.02",
                text(&exact_cost),
                exact_cost.iter().all(|b| b.1 <= 1.02),
            ),
            Claim::measured(
                "Without compensation the exact sampler has less variance than caps, too",
                "below 1",
                text(&plain),
                plain.iter().all(|p| p.1 < 1.0),
            ),
            Claim::measured(
                "Caps take less time than Heitz 2018 at equal samples",
                "above 1: time of Heitz 2018 over the cap's",
                text(&heitz),
                heitz.iter().all(|h| h.1 > 1.0),
            ),
        ],
        caveat: "Variances are of independent samples; mean squared errors come from the differences of \
                 pictures of stratified samples, and carry an error of some per cent. No reference enters. \
                 Russian roulette from the third bounce."
            .to_owned(),
    }
}
