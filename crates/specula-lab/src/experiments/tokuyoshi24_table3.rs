//! Tokuyoshi and Eto 2024, table 3: how much longer rendering takes where fewer samples are rejected,
//! by the longest path.

use specula_render::RenderOptions;
use specula_scene::Scene;

use super::room_pictures::{bathroom_room, fireplace_room, kitchen_room, rough_orbs};
use super::sampler_trials::{
    CAP_BOUNDED_EXACT, Plan, Prepared, TURQUIN, Trial, deviations_above, mean, trials,
};
use crate::output::Table;
use crate::plot::{Axis, Content, Figure, Panel, Series};
use crate::{Claim, Experiment, Lab, Result, Source, Verdict};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    id: "tokuyoshi24-table3",
    source: Source::Tokuyoshi24,
    item: "table 3",
    title: "increase in rendering time over the longest path",
    statement: "Bounded caps reject fewer samples and so lengthen paths: rendering takes 0.2 to 10.4 % \
                longer than with caps, the more the longer paths may be.",
    run,
};

/// Longest paths in bounces.
const DEPTHS: [u32; 4] = [1, 2, 4, 1024];

/// A scene, and the paper's increase of time with bounded caps at each of [`DEPTHS`], in per cent.
struct Case {
    name: &'static str,
    scene: Scene,
    paper: [f64; 4],
    aspect: [u32; 2],
}

fn cases() -> [Case; 4] {
    let case = |name, scene, paper, aspect| Case {
        name,
        scene,
        paper,
        aspect,
    };
    [
        case(
            "fireplace room",
            fireplace_room().scene,
            [1.33, 2.91, 4.72, 8.92],
            [16, 9],
        ),
        case(
            "kitchen",
            kitchen_room().scene,
            [0.23, 0.31, 0.46, 1.18],
            [16, 9],
        ),
        case("orbs", rough_orbs(), [0.86, 2.93, 6.19, 10.4], [3, 1]),
        case(
            "bathroom",
            bathroom_room().scene,
            [0.39, 0.85, 1.23, 3.56],
            [16, 9],
        ),
    ]
}

/// Increase of time at one depth of one scene, in per cent: bounded, exact.
struct Point {
    rays: [f64; 2],
    times: [f64; 2],
    /// Of the bounded sampler's rays above the cap's.
    deviations: f64,
}

fn run(lab: &mut Lab<'_>) -> Result<Verdict> {
    let mut table = Table::new(
        "increase",
        "Increase against caps, multiple importance sampling, Turquin's compensation. Times: of the \
         processor, in turns, medians.",
        &[
            "scene",
            "longest path [bounces]",
            "cap [rays per sample]",
            "bounded, rays [%]",
            "exact, rays [%]",
            "bounded, time [%]",
            "exact, time [%]",
            "bounded, time in the paper [%]",
        ],
    );
    let mut panels = Vec::new();
    let mut found = Vec::new();
    for (i, case) in cases().iter().enumerate() {
        let mut points = Vec::new();
        let options = options(lab, case.aspect);
        let prepared = Prepared::new(&case.scene, &CAP_BOUNDED_EXACT, &options)?;
        for (j, depth) in DEPTHS.into_iter().enumerate() {
            let at = |n: usize| n as f64 / 16.0;
            let plan = Plan {
                options: RenderOptions {
                    max_depth: depth,
                    ..options.clone()
                },
                rounds: lab.pick(4, 8),
            };
            let shares = [at(4 * i + j), at(4 * i + j + 1)];
            let trials = trials(lab, &prepared, &plan, shares)?;
            let point = Point::of(&trials);
            let [bounded, exact] = point.rays.map(Into::into);
            let [bounded_time, exact_time] = point.times.map(Into::into);
            let cap = mean(&trials[0].rays).into();
            let paper = case.paper[j].into();
            table.push([
                case.name.into(),
                depth.into(),
                cap,
                bounded,
                exact,
                bounded_time,
                exact_time,
                paper,
            ]);
            points.push(point);
        }
        panels.push(panel(case, &points));
        found.push((case.name, points));
    }
    lab.table(table)?;
    let caption = "Increase of rays and of processor time against caps over the longest path.";
    lab.plot("increase", caption, &Figure::grid(2, panels))?;
    Ok(verdict(&found))
}

fn options(lab: &Lab<'_>, [across, up]: [u32; 2]) -> RenderOptions {
    let height = lab.pick(45, 162);
    RenderOptions {
        samples_per_pixel: lab.pick(3, 4),
        energy: TURQUIN,
        resolution: Some([height * across / up, height]),
        ..RenderOptions::default()
    }
}

impl Point {
    fn of(trials: &[Trial]) -> Self {
        let cap = &trials[0];
        let others = [&trials[1], &trials[2]];
        let per_cent = |ratio: f64| 100.0 * (ratio - 1.0);
        Self {
            rays: others.map(|t| per_cent(t.ray_ratio(cap))),
            times: others.map(|t| per_cent(t.time_ratio(cap))),
            deviations: deviations_above(&trials[1].rays, &cap.rays),
        }
    }
}

fn panel(case: &Case, points: &[Point]) -> Panel {
    let line = |value: &dyn Fn(usize) -> f64| -> Vec<[f64; 2]> {
        (DEPTHS.iter().enumerate())
            .map(|(i, &depth)| [f64::from(depth), value(i)])
            .collect()
    };
    Panel {
        title: case.name.to_owned(),
        x: Axis::logarithmic("longest path [bounces]").from_to(1.0, 1024.0),
        y: Axis::linear("increase against caps [%]"),
        content: Content::Lines(vec![
            Series::new("bounded, rays", 2, line(&|i| points[i].rays[0])),
            Series::new("exact, rays", 1, line(&|i| points[i].rays[1])),
            Series::new("bounded, time", 4, line(&|i| points[i].times[0])),
            Series::new("bounded, time in the paper", 0, line(&|i| case.paper[i])),
        ]),
    }
}

fn verdict(found: &[(&str, Vec<Point>)]) -> Verdict {
    let longest = |value: &dyn Fn(&Point) -> f64| -> String {
        (found.iter())
            .map(|(name, points)| format!("{name} {:.2} %", value(&points[3])))
            .collect::<Vec<_>>()
            .join(", ")
    };
    let grows = |depths: usize| {
        let grows = |p: &[Point]| p[..depths].windows(2).all(|w| w[1].rays[0] > w[0].rays[0]);
        found.iter().all(|(_, p)| grows(p))
    };
    let all = || found.iter().flat_map(|(_, p)| p);
    let fewest = all().map(|p| p.deviations).fold(f64::INFINITY, f64::min);
    let exact_more = all().all(|p| p.rays[1] > p.rays[0]);
    let steps = (found.iter())
        .map(|(name, p)| {
            let [a, b, c, d] = [0, 1, 2, 3].map(|i| p[i].rays[0]);
            format!("{name} {a:.2}, {b:.2}, {c:.2}, {d:.2} %")
        })
        .collect::<Vec<_>>()
        .join("; ");
    let time = |p: &Point| p.times[0];
    Verdict {
        summary: format!(
            "Rays of bounded caps against caps up to 1024 bounces: {}.",
            longest(&|p| p.rays[0])
        ),
        claims: vec![
            Claim::law(
                "Bounded caps trace more rays than caps at every longest path",
                "more time in all 16 cases",
                format!("more rays in all, by {fewest:.0} standard errors at least"),
                all().all(|p| p.rays[0] > 0.0),
            ),
            Claim::law(
                "The increase grows with the longest path up to 4 bounces",
                "in all four scenes",
                format!("rays at 1, 2, 4, 1024 bounces: {steps}"),
                grows(3),
            ),
            Claim::measured(
                "It goes on growing up to 1024 bounces",
                "in all four scenes",
                format!("rays at 1, 2, 4, 1024 bounces: {steps}"),
                grows(4),
            ),
            Claim::law(
                "The exact sampler, which rejects nothing, traces more still",
                "not in the paper",
                longest(&|p| p.rays[1]),
                exact_more,
            ),
            Claim::measured(
                "The time that bounded caps add up to 1024 bounces is small",
                "8.92 %, 1.18 %, 10.4 %, 3.56 %",
                longest(&time),
                found.iter().all(|(_, p)| time(&p[3]) < 15.0),
            ),
        ],
        caveat: "Scenes of our own in the places of the paper's, on a processor in place of a graphics \
                 card. Paths end by Russian roulette here from the third bounce on, which may be why the increase does \
                 not go on growing. Rays are counted; times of single cases \
                 carry an error of about 1 %."
            .to_owned(),
    }
}
