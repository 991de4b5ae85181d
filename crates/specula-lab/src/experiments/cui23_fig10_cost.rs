//! Cui et al. 2023, fig. 10 (left): the cost of the segment term over bounces.

use std::hint::black_box;
use std::time::Instant;

use specula_bsdf::Alpha;
use specula_bsdf::math::{Stream, vec3};
use specula_bsdf::ndf::Ggx;

use super::cui23_segment_terms::{Depths, Exponentials, Segment, Step, Term, by_recursion};
use super::cui23_walks::walk;
use super::stopwatch::median;
use crate::output::Table;
use crate::plot::{Axis, Content, Figure, Panel, Series};
use crate::{Claim, Experiment, Lab, Result, Source, Verdict};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    id: "cui23-fig10-cost",
    source: Source::Cui23,
    item: "fig. 10, left",
    title: "cost of the segment term over bounces",
    statement: "The segment term takes O(N M) time for N upward and M downward flights, quadratic \
                in the bounces at worst, but close to linear in practice up to 10 bounces; it is \
                cheaper than the form of Bitterli and d'Eon 2022 and avoids its singularities.",
    run,
};

/// Of the metals, each in a third of the paths.
const ALPHAS: [f64; 3] = [0.1, 0.5, 1.0];
/// Most bounces.
const BOUNCES: usize = 16;
/// Up to where the recursion of eq. 14 is followed: its cost doubles with every bounce.
const RECURSION: usize = 10;
/// The paper's range.
const TEN: usize = 10;

const NAMES: [(&str, usize); 3] = [
    ("Cui 2023, segment term", 2),
    ("Bitterli, d'Eon 2022", 5),
    ("Specula, depth state", 1),
];

/// A walk and the rate of the flight that leaves.
type Path = (Vec<Step>, f64);

/// Means for one number of bounces, in the order of [`NAMES`].
struct Row {
    ns: [f64; 3],
    operations: [f64; 3],
    /// Largest relative difference from the recursion; not a number beyond [`RECURSION`].
    errors: [f64; 3],
    /// Of the segment term where as many flights go down as up.
    worst: f64,
}

fn run(lab: &mut Lab<'_>) -> Result<Verdict> {
    lab.step(0.0, "walking")?;
    let paths = paths(lab);
    let mut rows = Vec::new();
    for bounces in 1..=BOUNCES {
        lab.step(bounces as f64 / BOUNCES as f64, "timing")?;
        rows.push(row(lab, &paths, bounces));
    }
    lab.table(table(&rows))?;
    let caption = "Cost of the probability of leaving over bounces, means over walks on metals of \
                   alpha 0.1, 0.5 and 1, seen as on a ball: time, and additions, multiplications \
                   and divisions.";
    lab.plot("cost", caption, &figure(&rows))?;
    Ok(verdict(&rows))
}

fn paths(lab: &Lab<'_>) -> Vec<Path> {
    let each = lab.pick(300, 2000);
    let mut stream = Stream::new(lab.seed());
    let mut all = Vec::new();
    for alpha in ALPHAS {
        let ndf = Ggx::new(Alpha::isotropic(alpha));
        for _ in 0..each {
            let mut towards = || {
                let cos = stream.next::<f64>().sqrt();
                vec3((1.0 - cos * cos).sqrt(), 0.0, cos)
            };
            let (wo, wi) = (towards(), towards());
            let path = walk(&ndf, wo, BOUNCES, &mut stream);
            let out = specula_bsdf::ndf::Ndf::lambda(&ndf, wi);
            all.push((path, out));
        }
    }
    all
}

fn row(lab: &Lab<'_>, paths: &[Path], bounces: usize) -> Row {
    let mut times = [const { Vec::new() }; 3];
    for _ in 0..lab.pick(5, 15) {
        let turn = [
            time_of::<Segment>(paths, bounces),
            time_of::<Exponentials>(paths, bounces),
            time_of::<Depths>(paths, bounces),
        ];
        for (times, ns) in times.iter_mut().zip(turn) {
            times.push(ns);
        }
    }
    Row {
        ns: times.map(median),
        operations: [
            operations_of::<Segment>(paths, bounces),
            operations_of::<Exponentials>(paths, bounces),
            operations_of::<Depths>(paths, bounces),
        ],
        errors: errors(paths, bounces),
        worst: worst(bounces),
    }
}

/// Operations of the segment term where as many flights go down as up.
fn worst(bounces: usize) -> f64 {
    let step = |i: usize| Step {
        rate: 1.5,
        down: 2 * i < bounces,
    };
    let path = (0..bounces).map(step).collect();
    operations_of::<Segment>(&[(path, 0.5)], bounces)
}

/// Mean time of a path, in nanoseconds.
fn time_of<T: Term>(paths: &[Path], bounces: usize) -> f64 {
    let begin = Instant::now();
    for (path, out) in paths {
        black_box(exit::<T>(&path[..bounces], black_box(*out)));
    }
    begin.elapsed().as_secs_f64() * 1e9 / paths.len() as f64
}

#[inline(always)]
fn exit<T: Term>(path: &[Step], out: f64) -> f64 {
    let mut term = T::new(out);
    for step in path {
        term.add(*step);
    }
    term.exit()
}

/// Mean number of operations of a path.
fn operations_of<T: Term>(paths: &[Path], bounces: usize) -> f64 {
    let mut sum = 0.0;
    for (path, out) in paths {
        let mut term = T::new(*out);
        for step in &path[..bounces] {
            sum += f64::from(term.cost_of_adding(*step));
            term.add(*step);
        }
        sum += f64::from(term.cost_of_exit());
    }
    sum / paths.len() as f64
}

fn errors(paths: &[Path], bounces: usize) -> [f64; 3] {
    if bounces > RECURSION {
        return [f64::NAN; 3];
    }
    let mut worst = [0.0_f64; 3];
    for (path, out) in paths {
        let path = &path[..bounces];
        let exact = by_recursion(path, *out);
        let found = [
            exit::<Segment>(path, *out),
            exit::<Exponentials>(path, *out),
            exit::<Depths>(path, *out),
        ];
        for (worst, found) in worst.iter_mut().zip(found) {
            *worst = worst.max((found / exact - 1.0).abs());
        }
    }
    worst
}

fn table(rows: &[Row]) -> Table {
    let mut table = Table::new(
        "cost",
        "Means over paths; operations are additions, multiplications and divisions; errors are the \
         largest relative differences from the recursion of eq. 14.",
        &["bounces", "form", "time [ns]", "operations", "error"],
    );
    for (row, bounces) in rows.iter().zip(1_u32..) {
        for (i, (name, _)) in NAMES.into_iter().enumerate() {
            table.push([
                bounces.into(),
                name.into(),
                row.ns[i].into(),
                row.operations[i].into(),
                row.errors[i].into(),
            ]);
        }
        table.push([
            bounces.into(),
            "Cui 2023, as many down as up".into(),
            f64::NAN.into(),
            row.worst.into(),
            f64::NAN.into(),
        ]);
    }
    table
}

fn figure(rows: &[Row]) -> Figure {
    let line = |value: &dyn Fn(&Row) -> f64| {
        let points = rows.iter().zip(1_u32..);
        points.map(|(row, k)| [f64::from(k), value(row)]).collect()
    };
    let all = |value: fn(&Row) -> &[f64; 3]| -> Vec<Series> {
        let named = NAMES.into_iter().enumerate();
        named
            .map(|(i, (name, style))| Series::new(name, style, line(&|row| value(row)[i])))
            .collect()
    };
    let mut operations = all(|row| &row.operations);
    let worst = line(&|row| row.worst);
    operations.push(Series::new("Cui 2023, as many down as up", 7, worst));
    let panel = |title: &str, y: &str, series| Panel {
        title: title.to_owned(),
        x: Axis::linear("bounces").from_to(0.0, BOUNCES as f64),
        y: Axis::linear(y),
        content: Content::Lines(series),
    };
    Figure::grid(
        2,
        vec![
            panel("time", "time [ns]", all(|row| &row.ns)),
            panel("arithmetic", "operations", operations),
        ],
    )
}

/// Exponent of growth from half the bounces to ten.
fn exponent(rows: &[Row], value: impl Fn(&Row) -> f64) -> f64 {
    let at = |bounces: usize| value(&rows[bounces - 1]);
    (at(TEN) / at(TEN / 2)).log2()
}

fn verdict(rows: &[Row]) -> Verdict {
    let operations = exponent(rows, |row| row.operations[0]);
    let worst = (worst(4 * BOUNCES) / worst(2 * BOUNCES)).log2();
    let time = exponent(rows, |row| row.ns[0]);
    let ten = &rows[TEN - 1];
    let error = |i: usize| rows.iter().map(|r| r.errors[i]).fold(0.0, f64::max);
    let [segment, exponentials, depths] = [0, 1, 2].map(error);
    let [ops, ops_bitterli, ops_specula] = ten.operations;
    let [ns, ns_bitterli, ns_specula] = ten.ns;
    Verdict {
        summary: format!(
            "Operations grow as bounces^{operations:.2} (quadratic case: {worst:.2}); at ten bounces \
             {ops:.0}, Bitterli and d'Eon {ops_bitterli:.0}."
        ),
        claims: vec![
            Claim::law(
                "The cost is close to linear up to ten bounces",
                "very close to a linear function",
                format!(
                    "operations grow as bounces^{operations:.2} from 5 to 10; where as many flights \
                     go down as up, from {} to {} as bounces^{worst:.2}",
                    2 * BOUNCES,
                    4 * BOUNCES
                ),
                operations < 1.25 && worst > 1.7,
            ),
            Claim::measured(
                "So is the time",
                "almost linear",
                format!("bounces^{time:.2}; {ns:.0} ns at ten"),
                time < 1.4,
            ),
            Claim::law(
                "The segment term takes fewer operations than Bitterli and d'Eon's form",
                "simpler, more efficient",
                format!(
                    "{ops:.1} against {ops_bitterli:.1} at ten bounces (Specula {ops_specula:.1}; the product \
                     of rates, which the other two include, would be ten more)"
                ),
                ops < ops_bitterli,
            ),
            Claim::measured(
                "And less time",
                "less time",
                format!(
                    "{ns:.0} against {ns_bitterli:.0} ns at ten bounces (Specula {ns_specula:.0})"
                ),
                ns < ns_bitterli,
            ),
            Claim::law(
                "Both give the same probability as the recursion; only Bitterli and d'Eon's cancels",
                "equivalent; singularities avoided",
                format!(
                    "largest relative error {segment:.0e}, Bitterli and d'Eon {exponentials:.0e}, \
                     Specula {depths:.0e} in double precision"
                ),
                segment < 1e-10 && depths < 1e-10 && exponentials > 1e2 * segment,
            ),
        ],
        caveat:
            "The forms alone, in double precision, on walks that were sampled before; Bitterli and \
                 d'Eon's with its signs, which the supplement's algorithm 5 lost. The segment term's operations \
                 are counted without the product of rates, its time with it."
                .to_owned(),
    }
}
