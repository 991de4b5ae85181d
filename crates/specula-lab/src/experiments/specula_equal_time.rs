//! Specula: variance times processor time of all samplers, in rooms and on orbs, with and without
//! compensation.

use specula_render::RenderOptions;
use specula_scene::{Energy, Scene};

use super::room_pictures::{bathroom_room, fireplace_room, kitchen_room, rough_orbs};
use super::sampler_trials::{ALL_WAYS, Plan, Prepared, TURQUIN, Way, mean, trials};
use super::stopwatch::median;
use crate::output::Table;
use crate::plot::{Axis, Bars, Content, Figure, Panel};
use crate::{Claim, Experiment, Lab, Result, Source, Verdict};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    id: "specula-equal-time",
    source: Source::Specula,
    item: "equal time",
    title: "variance of all samplers at equal time",
    statement: "Fewer rejected samples cost time, since paths are longer. At equal time bounded caps and the \
                exact sampler are far better than caps where rough metal lights rough metal under a \
                compensation of energy, and about even in rooms with multiple importance sampling.",
    run,
};

/// Four scenes: name, scene, columns and rows of the picture.
fn scenes() -> [(&'static str, Scene, [u32; 2]); 4] {
    [
        ("fireplace room", fireplace_room().scene, [16, 9]),
        ("kitchen", kitchen_room().scene, [16, 9]),
        ("bathroom", bathroom_room().scene, [16, 9]),
        ("orbs", rough_orbs(), [3, 1]),
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
}

impl Row {
    /// At equal time, over the cap's.
    fn inefficiency(&self) -> f64 {
        self.variance * self.cost
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
            "variance x time over cap's",
        ],
    );
    let mut rows = Vec::new();
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
                rounds: lab.pick(2, 6),
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
        }
    }
    lab.table(table)?;
    let caption =
        "Variance of a sample times its time, over the cap's: below 1 is better at equal time.";
    lab.plot("equal-time", caption, &Figure::grid(2, panels(&rows)))?;
    Ok(verdict(&rows))
}

fn options(lab: &Lab<'_>, [across, up]: [u32; 2], energy: Energy) -> RenderOptions {
    let height = lab.pick(36, 135);
    RenderOptions {
        samples_per_pixel: lab.pick(8, 10),
        max_depth: 1024,
        energy,
        resolution: Some([height * across / up, height]),
        ..RenderOptions::default()
    }
}

/// Variance times time over the cap's, a panel for each treatment of energy.
fn panels(rows: &[Row]) -> Vec<Panel> {
    let mut groups: Vec<&str> = rows.iter().map(|r| r.scene).collect();
    groups.dedup();
    let panel = |energy: &str, title: &str| {
        let of = |way: &Way| -> Vec<f64> {
            (rows.iter())
                .filter(|r| r.energy == energy && r.sampler == way.name)
                .map(|r| r.variance * r.cost)
                .collect()
        };
        let bars = |way: &Way| (way.name.to_owned(), way.style, of(way));
        Panel {
            title: title.to_owned(),
            x: Axis::linear(""),
            y: Axis::linear("variance x time over the cap's").from_to(0.0, 1.4),
            content: Content::Bars(Bars {
                groups: groups.iter().map(|&g| g.to_owned()).collect(),
                bars: ALL_WAYS.iter().map(bars).collect(),
            }),
        }
    };
    vec![
        panel("turquin", "Turquin's compensation"),
        panel("none", "single scattering"),
    ]
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
    let bounded_cost = of("bounded", "turquin", &both);
    let exact_cost = of("exact", "turquin", &both);
    let plain = of("exact", "none", &variance);
    let heitz = of("heitz", "none", &|r| r.cost);
    Verdict {
        summary: format!(
            "Variance x time over the cap's under Turquin's compensation: bounded {}; exact {}.",
            text(&bounded_cost),
            text(&exact_cost)
        ),
        claims: vec![
            Claim::law(
                "Bounded caps and the exact sampler have far less variance than caps by samples, on orbs of \
                 rough silver under Turquin's compensation",
                "below 1",
                format!("x {:.3}, x {:.3}", bounded[3].1, exact[3].1),
                bounded[3].1 < 1.0 && exact[3].1 < 1.0,
            ),
            Claim::measured(
                "They do so in rooms, too",
                "below 1",
                format!("bounded {}; exact {}", text(&bounded), text(&exact)),
                bounded.iter().chain(&exact).all(|v| v.1 < 1.0),
            ),
            Claim::measured(
                "At equal time they have less than half of the cap's variance on those orbs",
                "below 0.5",
                format!("x {:.3}, x {:.3}", bounded_cost[3].1, exact_cost[3].1),
                bounded_cost[3].1.max(exact_cost[3].1) < 0.5,
            ),
            Claim::measured(
                "At equal time they are even with caps in rooms",
                "within 10 %",
                format!("bounded {}; exact {}", text(&bounded_cost[..3]), text(&exact_cost[..3])),
                (bounded_cost[..3].iter().chain(&exact_cost[..3])).all(|v| (v.1 - 1.0).abs() < 0.1),
            ),
            Claim::measured(
                "Without compensation the exact sampler has less variance than caps, too",
                "below 1",
                text(&plain),
                plain.iter().all(|p| p.1 < 1.0),
            ),
            Claim::measured(
                "Caps and Heitz 2018 take the same time, since sampling directions is a small part of it",
                "within 3 %: time of Heitz 2018 over the cap's",
                text(&heitz),
                heitz.iter().all(|h| (h.1 - 1.0).abs() < 0.03),
            ),
        ],
        caveat: "Variances are of independent samples; mean squared errors come from the differences of \
                 pictures of stratified samples, and carry an error of some per cent. No reference enters. \
                 Russian roulette from the third bounce."
            .to_owned(),
    }
}
