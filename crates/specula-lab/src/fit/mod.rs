//! Fits of rough metals to a measured reflection.
//!
//! ```text
//! r    = ln((f cos + e) / (m + e))           per node and channel; e = 1e-3 of the view's largest value
//! loss = 2 c^2 (sqrt(1 + (r / c)^2) - 1)     c = 0.1, summed: pseudo-Huber
//! ```
//!
//! Logarithms weigh the tails of a lobe as its peak (Low, Kronander, Ynnerman and Unger 2012, "BRDF Models for
//! Accurate and Efficient Rendering of Glossy Surfaces"); beyond c, a residual counts by its size and not by its
//! square, so that stray nodes do not lead the fit. Levenberg and Marquardt's method finds the least sum.

mod candidates;
mod measurement;
mod plots;
mod solve;
mod text;

pub use candidates::{Bounces, Distribution, FresnelModel};

use std::path::Path;
use std::sync::atomic::AtomicBool;

use specula_bsdf::measured::{Measured, MeasuredTables};

use crate::output::Table;
use crate::output::comparison::file_name;
use crate::output::table::significant;
use crate::runner::{Subject, carry_out};
use crate::{Claim, Lab, LabError, Progress, Quality, Record, Result, RunOptions, Source, Verdict};

use candidates::Candidate;
use measurement::Measurement;
use solve::{Fit, fit};

/// A simpler lobe is preferred while its loss is at most this many times the least.
const SIMPLER: f64 = 1.01;

/// Options of a fit.
#[derive(Clone, Copy, Debug)]
pub struct FitOptions<'a> {
    /// The measurement's name, such as its file's.
    pub name: &'a str,
    /// The measurement.
    pub tables: &'a MeasuredTables,
    /// Distributions of normals to try; at least one.
    pub distributions: &'a [Distribution],
    /// Treatments of several bounces to try; at least one.
    pub bounces: &'a [Bounces],
    /// Reflectances to try; at least one.
    pub fresnel: &'a [FresnelModel],
    /// How much work.
    pub quality: Quality,
    /// Of all random numbers.
    pub seed: u64,
}

/// The record's name for a measurement: also that of its folder.
#[must_use]
pub fn id(name: &str) -> String {
    format!("fit-{}", file_name(name))
}

/// Fits; the record and its files go to `folder/ID`, whole or not at all.
///
/// # Errors
///
/// Where the tables are no measurement or all black, a file cannot be written, or the caller asks to stop.
pub fn run(
    options: &FitOptions<'_>,
    folder: &Path,
    stop: &AtomicBool,
    progress: &(dyn Fn(Progress) + Sync),
) -> Result<Record> {
    let subject = Subject {
        id: id(options.name),
        source: Source::Specula,
        item: "fit".to_owned(),
        title: options.name.to_owned(),
        statement: String::new(),
        command: format!("specula lab fit {}", options.name),
    };
    let effort = RunOptions {
        quality: options.quality,
        seed: options.seed,
    };
    carry_out(subject, effort, folder, stop, progress, |lab| {
        measure(options, lab)
    })
}

fn measure(options: &FitOptions<'_>, lab: &mut Lab<'_>) -> Result<Verdict> {
    lab.step(0.0, "nodes")?;
    let wrong = |e: &dyn std::fmt::Display| LabError::Material(format!("{}: {e}", options.name));
    let measured = Measured::<f64>::new(options.tables).map_err(|e| wrong(&e))?;
    let most = lab.pick(4_000, 40_000);
    let measurement = Measurement::new(&measured, most)
        .ok_or_else(|| wrong(&"has no value above 0 below 84 degrees"))?;
    let mut fits = Vec::new();
    let candidates = Candidate::all(options);
    for (i, candidate) in candidates.iter().enumerate() {
        let share = 0.9 * i as f64 / candidates.len() as f64;
        fits.push(fit(candidate, &measurement, share, lab)?);
    }
    let best = best(&fits).ok_or_else(|| wrong(&"no lobe could be fitted"))?;
    lab.step(0.9, "plots")?;
    lab.table(table(&fits, best))?;
    lab.table(reflectance(best))?;
    lab.table(text::table(best))?;
    plots::lobes(&measured, &fits, best, lab)?;
    plots::residuals(&measured, best, lab)?;
    let [median, most] = best.ratios;
    Ok(Verdict {
        summary: format!(
            "Nearest: {}. Half of the nodes are within {} %, nine of ten within {} %.",
            best.lobe,
            significant(100.0 * median, 2),
            significant(100.0 * most, 2)
        ),
        claims: vec![Claim::measured(
            "A rough metal stands for the measurement",
            "half of the nodes within 10 %",
            format!("within {} %", significant(100.0 * median, 2)),
            median < 0.1,
        )],
        caveat:
            "Views beyond 84 degrees and light below 3 degrees are left out; so are black nodes."
                .to_owned(),
    })
}

/// The chosen reflectance by channel.
fn reflectance(fit: &Fit) -> Table {
    let [first, second] = match fit.candidate.fresnel {
        FresnelModel::Index => ["eta", "k"],
        FresnelModel::F82 => ["f0", "f82 tint"],
    };
    let mut table = Table::new(
        "reflectance",
        "The chosen lobe's reflectance, with one standard deviation of the fit. Large errors of eta and k: many pairs \
         reflect alike, and the one of small k is taken.",
        &["channel", first, "+-", second, "+-"],
    );
    let from = fit.candidate.alphas();
    for (i, channel) in ["red", "green", "blue"].into_iter().enumerate() {
        let (a, b) = (from + i, from + 3 + i);
        table.push([
            channel.into(),
            fit.parameters[a].into(),
            fit.errors[a].into(),
            fit.parameters[b].into(),
            fit.errors[b].into(),
        ]);
    }
    table
}

/// The first of those that are nearest, but for a percent: they stand from simple to costly.
fn best(fits: &[Fit]) -> Option<&Fit> {
    let least = fits.iter().map(|f| f.loss).reduce(f64::min)?;
    fits.iter().find(|f| f.loss <= SIMPLER * least)
}

fn table(fits: &[Fit], best: &Fit) -> Table {
    let mut table = Table::new(
        "fits",
        "Lobes fitted to the measurement, and how far they are from it: the loss per node and channel; half and nine \
         tenths of the nodes are within so much. Errors of alpha are one standard deviation of the fit.",
        &[
            "lobe",
            "alpha x",
            "+-",
            "alpha y",
            "+-",
            "loss",
            "half within [%]",
            "nine tenths within [%]",
            "chosen",
        ],
    );
    let mut order: Vec<&Fit> = fits.iter().collect();
    order.sort_by(|a, b| a.loss.total_cmp(&b.loss));
    for fit in order {
        let [x, y] = fit.alpha;
        let [dx, dy] = fit.alpha_errors;
        let [median, most] = fit.ratios;
        let chosen = if std::ptr::eq(fit, best) { "yes" } else { "" };
        table.push([
            fit.lobe.to_string().into(),
            x.into(),
            dx.into(),
            y.into(),
            dy.into(),
            fit.loss.into(),
            (100.0 * median).into(),
            (100.0 * most).into(),
            chosen.into(),
        ]);
    }
    table
}
