//! Dupuy and Benyoub 2023, table 1: the share of a render's time that goes into sampling directions.

use std::hint::black_box;
use std::time::Instant;

use specula_bsdf::vndf::Sampler;
use specula_bsdf::{Alpha, Rgb};
use specula_render::RenderOptions;
use specula_scene::Scene;
use specula_scene::scene::{
    ColourParam, ConductorFresnel, FloatParam, MaterialKind, Roughness, RoughnessMapping,
};

use super::room_pictures::{bathroom_room, fireplace_room, kitchen_room};
use super::sample_times::{self, Inputs};
use super::sampler_trials::{ALL_WAYS, Plan, Prepared, deviations_above, mean, trials};
use super::stopwatch::median;
use crate::output::Table;
use crate::plot::{Axis, Content, Figure, Panel, Series};
use crate::{Claim, Experiment, Lab, Result, Source, Verdict};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    id: "dupuy23-table1",
    source: Source::Dupuy23,
    item: "table 1",
    title: "share of rendering time in the sampling of visible normals",
    statement: "With all surfaces rough metal or rough glass, sampling directions takes 0.48 to 3.71 % of a \
                render's time with Heitz 2018 and 0.20 to 1.49 % with caps, a factor of 2.4 to 2.55; so \
                rendering as a whole does not become much faster.",
    run,
};

/// The material of all surfaces of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stuff {
    Metal,
    Glass,
}

/// One scene of one material and alpha; pairs are of Heitz 2018 and caps.
struct Row {
    scene: &'static str,
    stuff: Stuff,
    alpha: f32,
    directions: [f64; 2],
    rejected: [f64; 2],
    /// Of a sample, nanoseconds.
    time: [f64; 2],
    /// Nanoseconds of a direction, one by one.
    scalar: [f64; 2],
    /// Nanoseconds of a direction in batches.
    batch: [f64; 2],
    /// By how many standard errors the shares of rejected directions differ.
    apart: f64,
}

impl Row {
    fn share(&self, cost: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|i| self.directions[i] * cost[i] / self.time[i])
    }
}

fn scenes() -> [(&'static str, Scene, [u32; 2]); 4] {
    [
        ("orbs", specula_scene::builtin::orbs(), [12, 5]),
        ("fireplace room", fireplace_room().scene, [16, 9]),
        ("kitchen", kitchen_room().scene, [16, 9]),
        ("bathroom", bathroom_room().scene, [16, 9]),
    ]
}

fn run(lab: &mut Lab<'_>) -> Result<Verdict> {
    let alphas: &[f32] = lab.pick(&[0.2, 0.8], &[0.1, 0.3, 0.5, 0.7, 1.0]);
    let mut rows = Vec::new();
    let scenes = scenes();
    for (i, (name, scene, aspect)) in scenes.iter().enumerate() {
        for (j, &alpha) in alphas.iter().enumerate() {
            let at = |n: usize| n as f64 / (4 * alphas.len()) as f64;
            let n = i * alphas.len() + j;
            rows.push(measure(
                lab,
                (name, scene, *aspect),
                Stuff::Metal,
                alpha,
                [at(n), at(n + 1)],
            )?);
            if i == 0 {
                let shares = [at(n), at(n + 1)];
                let case = (*name, scene, *aspect);
                rows.push(measure(lab, case, Stuff::Glass, alpha, shares)?);
            }
        }
    }
    lab.table(table(&rows))?;
    let caption = "Share of a render's processor time that goes into sampling directions, all surfaces rough \
                   metal: by the cost of single directions (above) and of directions in batches (below).";
    lab.plot("shares", caption, &Figure::grid(4, panels(&rows)))?;
    Ok(verdict(&rows))
}

fn measure(
    lab: &Lab<'_>,
    (name, scene, [across, up]): (&'static str, &Scene, [u32; 2]),
    stuff: Stuff,
    alpha: f32,
    shares: [f64; 2],
) -> Result<Row> {
    let height = lab.pick(45, 180);
    let plan = Plan {
        options: RenderOptions {
            samples_per_pixel: 4,
            max_depth: 8,
            resolution: Some([height * across / up, height]),
            ..RenderOptions::default()
        },
        rounds: lab.pick(2, 4),
    };
    let scene = made_of(scene, stuff, alpha);
    let ways = [ALL_WAYS[3], ALL_WAYS[0]];
    let prepared = Prepared::new(&scene, &ways, &plan.options)?;
    let trials = trials(lab, &prepared, &plan, shares)?;
    let samples = f64::from(plan.options.samples_per_pixel) * trials[0].picture.colour.len() as f64;
    let [scalar, batch] = direction_costs(lab, stuff, alpha);
    let both = |value: &dyn Fn(usize) -> f64| [value(0), value(1)];
    Ok(Row {
        scene: name,
        stuff,
        alpha,
        directions: both(&|i| mean(&trials[i].directions)),
        rejected: both(&|i| mean(&trials[i].rejected)),
        time: both(&|i| 1e9 * median(trials[i].seconds.iter().copied()) / samples),
        scalar,
        batch,
        apart: deviations_above(&trials[0].rejected, &trials[1].rejected).abs(),
    })
}

/// The scene with all of its surfaces of one material.
fn made_of(scene: &Scene, stuff: Stuff, alpha: f32) -> Scene {
    let roughness = Roughness::isotropic(FloatParam::Value(alpha), RoughnessMapping::Alpha);
    let kind = match stuff {
        Stuff::Metal => MaterialKind::Conductor {
            fresnel: ConductorFresnel::Reflectance(ColourParam::Value(Rgb::splat(0.8))),
            roughness,
            tint: ColourParam::WHITE,
        },
        Stuff::Glass => MaterialKind::Dielectric {
            eta: 1.5,
            roughness,
            reflection_tint: ColourParam::WHITE,
            transmission_tint: ColourParam::WHITE,
        },
    };
    let mut scene = scene.clone();
    for material in &mut scene.materials {
        material.kind = kind;
    }
    scene
}

/// Nanoseconds of a direction: one by one and in batches, each by Heitz 2018 and by caps. Views are
/// cosine-distributed. Glass samples normals, for which there are no batches: reflections stand in.
fn direction_costs(lab: &Lab<'_>, stuff: Stuff, alpha: f32) -> [[f64; 2]; 2] {
    let inputs = Inputs::all_views(Alpha::isotropic(alpha), lab.seed());
    let one = |sampler| match stuff {
        Stuff::Metal => sample_times::reflections(&inputs, sampler),
        Stuff::Glass => sample_times::normals(&inputs, sampler),
    };
    let mut runs = [
        one(Sampler::Heitz),
        one(Sampler::Cap),
        sample_times::batch_reflections(&inputs, Sampler::Heitz),
        sample_times::batch_reflections(&inputs, Sampler::Cap),
    ];
    let times = sample_times::medians(&mut runs, lab.pick(30, 400));
    [[times[0], times[1]], [times[2], times[3]]]
}

fn table(rows: &[Row]) -> Table {
    let mut table = Table::new(
        "shares",
        "Directions are counted in the render and timed by themselves, f32, one thread, 2048 a reading; times of \
         renders: of the processor, medians, multiple importance sampling, paths of up to 8 bounces.",
        &[
            "scene",
            "all surfaces",
            "alpha",
            "sampler",
            "directions per sample",
            "rejected [%]",
            "time of a sample [ns]",
            "single direction [ns]",
            "direction in batches [ns]",
            "share by single directions [%]",
            "share by batches [%]",
        ],
    );
    for row in rows {
        let (scalar, batch) = (row.share(row.scalar), row.share(row.batch));
        for (i, name) in ["heitz", "cap"].into_iter().enumerate() {
            table.push([
                row.scene.into(),
                match row.stuff {
                    Stuff::Metal => "metal".into(),
                    Stuff::Glass => "glass".into(),
                },
                row.alpha.into(),
                name.into(),
                row.directions[i].into(),
                (100.0 * row.rejected[i]).into(),
                row.time[i].into(),
                row.scalar[i].into(),
                row.batch[i].into(),
                (100.0 * scalar[i]).into(),
                (100.0 * batch[i]).into(),
            ]);
        }
    }
    table
}

fn panels(rows: &[Row]) -> Vec<Panel> {
    let metal = |r: &&Row| r.stuff == Stuff::Metal;
    let mut names: Vec<&str> = rows.iter().filter(metal).map(|r| r.scene).collect();
    names.dedup();
    let mut panels = Vec::new();
    for (title, is_batch) in [("single", false), ("batches", true)] {
        for &name in &names {
            let line = |i: usize| -> Vec<[f64; 2]> {
                (rows.iter().filter(metal))
                    .filter(|r| r.scene == name)
                    .map(|r| {
                        let cost = if is_batch { r.batch } else { r.scalar };
                        [f64::from(r.alpha), 100.0 * r.share(cost)[i]]
                    })
                    .collect()
            };
            panels.push(Panel {
                title: format!("{name}, {title}"),
                x: Axis::linear("alpha").from_to(0.0, 1.0),
                y: Axis::linear("share of time [%]").from_to(0.0, if is_batch { 0.8 } else { 6.0 }),
                content: Content::Lines(vec![
                    Series::new("heitz", 6, line(0)),
                    Series::new("cap", 3, line(1)),
                ]),
            });
        }
    }
    panels
}

fn verdict(rows: &[Row]) -> Verdict {
    let range = |values: &dyn Fn(&Row) -> f64| -> [f64; 2] {
        let all = rows.iter().map(values);
        all.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| {
            [a.min(v), b.max(v)]
        })
    };
    let [heitz, cap] = [0, 1].map(|i| range(&|r| 100.0 * r.share(r.scalar)[i]));
    let [heitz_batch, cap_batch] = [0, 1].map(|i| range(&|r| 100.0 * r.share(r.batch)[i]));
    let factor = range(&|r| r.share(r.scalar)[0] / r.share(r.scalar)[1]);
    let factor_batch = range(&|r| r.share(r.batch)[0] / r.share(r.batch)[1]);
    let whole = range(&|r| r.time[0] / r.time[1]);
    let apart = range(&|r| 100.0 * (r.rejected[0] - r.rejected[1]).abs());
    let errors = range(&|r| r.apart);
    let text = |[low, high]: [f64; 2]| format!("{low:.2} to {high:.2}");
    Verdict {
        summary: format!(
            "Share of time in batches, as the renderer samples: Heitz 2018 {} %, caps {} %, a factor of {}; by \
             the cost of single directions {} %, {} %, {}.",
            text(heitz_batch),
            text(cap_batch),
            text(factor_batch),
            text(heitz),
            text(cap),
            text(factor)
        ),
        claims: vec![
            Claim::law(
                "Both samplers reject the same share of directions",
                "the same distribution",
                format!(
                    "shares apart by {:.2} percentage points and {:.1} standard errors at most",
                    apart[1], errors[1]
                ),
                apart[1] < 0.5,
            ),
            Claim::measured(
                "Sampling directions takes less than 4 % of the time",
                "Heitz 2018 0.48 to 3.71 %, caps 0.20 to 1.49 %",
                format!(
                    "in batches {} %, {} %; single directions {} %, {} %",
                    text(heitz_batch),
                    text(cap_batch),
                    text(heitz),
                    text(cap)
                ),
                heitz_batch[1] < 4.0,
            ),
            Claim::measured(
                "Caps take less of the time in every scene, by a factor of two at least",
                "2.40 to 2.55",
                format!(
                    "in batches {}; single directions {}",
                    text(factor_batch),
                    text(factor)
                ),
                factor_batch[0] > 2.0,
            ),
            Claim::measured(
                "Rendering as a whole gains little",
                "not necessarily a significant boost",
                format!("time of Heitz 2018 over that of caps: {}", text(whole)),
                whole[1] < 1.08,
            ),
        ],
        caveat: format!(
            "Scenes of our own. Not a sampling profiler: directions are counted in the render and timed apart, \
             2048 at a time; a reading of the clock takes {:.0} ns, {:.3} ns of a direction. Glass samples by caps \
             in this renderer: its row for Heitz 2018 has the caps' render and the other's cost of a direction.",
            clock_cost(),
            clock_cost() / 2048.0
        ),
    }
}

/// Nanoseconds of a reading of the clock.
fn clock_cost() -> f64 {
    const READINGS: u32 = 10_000;
    let begin = Instant::now();
    for _ in 0..READINGS {
        black_box(Instant::now());
    }
    begin.elapsed().as_secs_f64() * 1e9 / f64::from(READINGS)
}
