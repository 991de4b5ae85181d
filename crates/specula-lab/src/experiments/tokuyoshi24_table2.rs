//! Tokuyoshi and Eto 2024, table 2: time of a sample and of a density.

use specula_bsdf::Alpha;
use specula_bsdf::vndf::Sampler;

use super::sample_times::{self, Inputs, Run};
use super::stopwatch::median;
use crate::output::Table;
use crate::plot::{Axis, Content, Figure, Panel, Series};
use crate::{Claim, Experiment, Lab, Result, Source, Verdict};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    id: "tokuyoshi24-table2",
    source: Source::Tokuyoshi24,
    item: "table 2",
    title: "time of a sample and of a density",
    statement: "A sample takes 8.32 ns by the cap and 10.43 ns by the bounded cap, a density 5.00 and \
                6.57 ns (AMD Ryzen 9 7950X): a negligible overhead.",
    run,
};

const SAMPLERS: [(Sampler, &str, usize); 4] = [
    (Sampler::Heitz, "Heitz 2018", 6),
    (Sampler::Cap, "cap", 3),
    (Sampler::Bounded, "bounded", 2),
    (Sampler::Exact, "exact", 1),
];
const CAP: usize = 1;
const BOUNDED: usize = 2;

/// Makes a timed run of a sampler.
type Made = for<'a> fn(&'a Inputs, Sampler) -> Run<'a>;

/// Nanoseconds of the samplers: samples, densities, both in batches.
type Times = [Vec<f64>; 4];

const HEADS: [&str; 4] = [
    "sample, scalar [ns]",
    "density, scalar [ns]",
    "sample, batch [ns]",
    "density, batch [ns]",
];

fn run(lab: &mut Lab<'_>) -> Result<Verdict> {
    let rounds = lab.pick(31, 301);
    let alphas: &[f32] = lab.pick(
        &[0.1, 0.4, 0.7, 1.0],
        &[0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0],
    );
    let mut table = Table::new(
        "times",
        "Medians per element, f32, one thread, views over the hemisphere.",
        &[
            "alpha_x", "alpha_y", "sampler", HEADS[0], HEADS[1], HEADS[2], HEADS[3],
        ],
    );
    let mut lines: [Vec<Series>; 4] = Default::default();
    for lines in &mut lines {
        *lines = SAMPLERS
            .iter()
            .map(|&(_, name, style)| Series::new(name, style, Vec::new()))
            .collect();
    }
    let mut all: Vec<Times> = Vec::new();
    for (i, &alpha) in alphas.iter().enumerate() {
        lab.step(i as f64 / (alphas.len() + 1) as f64, "timing equal alphas")?;
        let times = measure(lab, Alpha::isotropic(alpha), rounds);
        for (lines, times) in lines.iter_mut().zip(&times) {
            for (line, &time) in lines.iter_mut().zip(times) {
                line.points.push([f64::from(alpha), time]);
            }
        }
        add(&mut table, (alpha, alpha), &times);
        all.push(times);
    }
    lab.step(0.9, "timing unequal alphas")?;
    let unequal = measure(lab, Alpha::clamped(0.6, 0.3), rounds);
    add(&mut table, (0.6, 0.3), &unequal);
    lab.table(table)?;
    let panels = (lines.into_iter().zip(HEADS))
        .map(|(series, head)| {
            let highest = (series.iter().flat_map(|s| &s.points))
                .map(|p| p[1])
                .fold(0.0, f64::max);
            Panel {
                title: head.replace(" [ns]", ""),
                x: Axis::linear("alpha").from_to(0.0, 1.0),
                y: Axis::linear("time [ns]").from_to(0.0, 1.1 * highest),
                content: Content::Lines(series),
            }
        })
        .collect();
    let caption = "Time per element over equal alphas, f32, one thread.";
    lab.plot("times", caption, &Figure::grid(2, panels))?;
    Ok(verdict(&all, &unequal))
}

fn measure(lab: &Lab<'_>, alpha: Alpha<f32>, rounds: usize) -> Times {
    let inputs = Inputs::all_views(alpha, lab.seed());
    let made: [Made; 4] = [
        sample_times::reflections,
        sample_times::densities,
        sample_times::batch_reflections,
        sample_times::batch_densities,
    ];
    let mut runs: Vec<Run<'_>> = made
        .iter()
        .flat_map(|make| SAMPLERS.map(|(sampler, ..)| make(&inputs, sampler)))
        .collect();
    let times = sample_times::medians(&mut runs, rounds);
    let mut parts = times.chunks(SAMPLERS.len()).map(<[f64]>::to_vec);
    [(); 4].map(|()| parts.next().unwrap_or_default())
}

fn add(table: &mut Table, (ax, ay): (f32, f32), times: &Times) {
    for (i, (_, name, _)) in SAMPLERS.iter().enumerate() {
        let [a, b, c, d] = [0, 1, 2, 3].map(|kind| times[kind][i].into());
        table.push([ax.into(), ay.into(), (*name).into(), a, b, c, d]);
    }
}

/// Median over the alphas of a sampler's time.
fn typical(all: &[Times], kind: usize, sampler: usize) -> f64 {
    median(all.iter().map(|times| times[kind][sampler]))
}

fn verdict(all: &[Times], unequal: &Times) -> Verdict {
    let of = |kind, sampler| typical(all, kind, sampler);
    let pair = |kind| (of(kind, CAP), of(kind, BOUNDED));
    let compare = |statement: &str, stated: &str, kind: usize| {
        let (cap, bounded) = pair(kind);
        let overhead = bounded - cap;
        Claim::measured(
            statement,
            stated,
            format!(
                "cap {cap:.2} ns, bounded {bounded:.2} ns: {overhead:+.2} ns, {:.2} times",
                bounded / cap
            ),
            overhead < 5.0,
        )
    };
    let (cap, bounded) = pair(0);
    let (cap_pdf, bounded_pdf) = pair(1);
    Verdict {
        summary: format!(
            "Sample {cap:.1} ns by the cap, {bounded:.1} by the bounded cap ({:.2} times; paper 1.25); \
             density {cap_pdf:.1} and {bounded_pdf:.1} ns ({:.2} times; paper 1.31).",
            bounded / cap,
            bounded_pdf / cap_pdf
        ),
        claims: vec![
            compare(
                "The bounded sample costs a few nanoseconds more than the cap's",
                "8.32 and 10.43 ns: +2.11 ns, 1.25 times",
                0,
            ),
            compare(
                "The bounded density costs a few nanoseconds more than the cap's",
                "5.00 and 6.57 ns: +1.57 ns, 1.31 times",
                1,
            ),
            Claim::measured(
                "So it is in batches, with the machine's vectors",
                "not in the paper",
                format!(
                    "sample {:.2} and {:.2} ns, density {:.2} and {:.2} ns",
                    of(2, CAP),
                    of(2, BOUNDED),
                    of(3, CAP),
                    of(3, BOUNDED)
                ),
                of(2, BOUNDED) - of(2, CAP) < 5.0,
            ),
            Claim::measured(
                "The exact sample costs less than 100 ns",
                "not in the paper",
                format!(
                    "equal alphas {:.1} ns, density {:.1} ns; unequal {:.1} and {:.1} ns",
                    of(0, 3),
                    of(1, 3),
                    unequal[0][3],
                    unequal[1][3]
                ),
                unequal[0][3] < 100.0,
            ),
        ],
        caveat: "Another processor; medians over alphas of medians over rounds, one thread. Our \
                 samplers keep sines, square roots and minima free of branches and calls."
            .to_owned(),
    }
}
