//! Measurements of one material: its lobe, its albedo, whether its samplers
//! are right, and how many samples they reject.

mod lobes;
mod plots;
mod tabulate;
mod trials;

pub use tabulate::{merl, tables};

use std::path::Path;
use std::sync::atomic::AtomicBool;

use specula_scene::scene::MaterialKind;

use crate::output::Table;
use crate::output::comparison::file_name;
use crate::output::table::significant;
use crate::runner::{Subject, carry_out};
use crate::{Claim, Lab, Progress, Quality, Record, Result, RunOptions, Source, Verdict};

use lobes::Variants;
use specula_stat::z_test::sidak;
use trials::{Fit, Reflected, Trial};

/// Chance of calling a right sampler wrong, over all tests of a page.
const SIGNIFICANCE: f64 = 1e-3;
/// Angles of the views of the tests, degrees.
const VIEWS_DEG: [f64; 4] = [0.0, 30.0, 60.0, 80.0];

/// Options of the measurement.
#[derive(Clone, Copy, Debug)]
pub struct MaterialOptions<'a> {
    /// The material as text.
    pub text: &'a str,
    /// The material; without textures.
    pub kind: &'a MaterialKind,
    /// How much work.
    pub quality: Quality,
    /// Of all random numbers.
    pub seed: u64,
}

/// The record's name for a material: also that of its folder.
#[must_use]
pub fn id(text: &str) -> String {
    format!("material-{}", file_name(text))
}

/// Measures; the record and its files go to `folder/ID`, whole or not at all.
///
/// # Errors
///
/// Where the material has textures, a file cannot be written, or the caller asks to stop.
pub fn run(
    options: &MaterialOptions<'_>,
    folder: &Path,
    stop: &AtomicBool,
    progress: &(dyn Fn(Progress) + Sync),
) -> Result<Record> {
    let subject = Subject {
        id: id(options.text),
        source: Source::Specula,
        item: "material".to_owned(),
        title: options.text.to_owned(),
        statement: String::new(),
        command: format!("specula lab material \"{}\"", options.text),
    };
    let effort = RunOptions {
        quality: options.quality,
        seed: options.seed,
    };
    carry_out(subject, effort, folder, stop, progress, |lab| {
        measure(options, lab)
    })
}

fn measure(options: &MaterialOptions<'_>, lab: &mut Lab<'_>) -> Result<Verdict> {
    lab.step(0.0, "lobes")?;
    let variants = Variants::new(options.kind)?;
    if !variants.is_specular() {
        plots::lobes(&variants, lab)?;
    }
    let reflected = trials::reflected(&variants, lab)?;
    plots::reflected(&reflected, lab)?;
    let trials = trials::samplers(&variants, lab)?;
    plots::samplers(&trials, lab)?;
    let fits = trials::fits(&variants, lab)?;
    if !fits.is_empty() {
        lab.table(table_of_fits(&fits))?;
    }
    Ok(verdict(&variants, &reflected, &trials, &fits))
}

fn table_of_fits(fits: &[Fit]) -> Table {
    let mut table = Table::new(
        "chi-square",
        "Samples against densities (chi-square) and mean weights against the quadrature of f cos (furnace): \
         the chance of a result at least as bad of a right sampler.",
        &[
            "sampler",
            "theta_o [deg]",
            "chi-square p",
            "degrees of freedom",
            "integral of the pdf",
            "rejected [%]",
            "furnace p",
        ],
    );
    for fit in fits {
        table.push([
            fit.sampler.as_str().into(),
            fit.theta_deg.into(),
            fit.chi_square.p_value.into(),
            fit.chi_square.degrees_of_freedom.into(),
            fit.chi_square.integral.into(),
            (100.0 * f64::from(fit.chi_square.rejected) / f64::from(fit.chi_square.samples)).into(),
            fit.furnace_p.unwrap_or(f64::NAN).into(),
        ]);
    }
    table
}

fn verdict(
    variants: &Variants,
    reflected: &[Reflected],
    trials: &[Trial],
    fits: &[Fit],
) -> Verdict {
    let mut claims = vec![no_energy_made(reflected)];
    claims.extend(right_densities(fits));
    claims.extend(rejected(trials));
    let least = reflected
        .iter()
        .min_by(|a, b| a.white[1].total_cmp(&b.white[1]));
    let lost = least.map_or_else(String::new, |r| {
        format!(
            "In a white furnace, energy {} sends back {:.1} % of the light at theta_o = {:.0} deg, the \
             least over all angles and treatments. ",
            r.energy,
            100.0 * r.white[1],
            r.theta_deg
        )
    });
    let along = trials.iter().filter(|t| t.theta_deg == 0.0);
    let waste: Vec<String> = along
        .map(|t| {
            format!(
                "{} {:.1} % (variance of the weight {})",
                t.sampler,
                100.0 * t.rejected,
                significant(t.variance, 2)
            )
        })
        .collect();
    let caveat = if variants.is_specular() {
        "The lobe is a Dirac delta: there is no density to sample or to test.".to_owned()
    } else if fits.is_empty() {
        "The lobe is estimated by walks: curves are means over many, and its density is an approximation \
         for multiple importance sampling that samples do not follow, so that it is not tested."
            .to_owned()
    } else if variants.is_stochastic() {
        "Simulated bounces are estimates: their curves are means over many walks.".to_owned()
    } else {
        String::new()
    };
    Verdict {
        summary: format!(
            "{lost}Samples rejected along the normal: {}.",
            waste.join(", ")
        ),
        claims,
        caveat,
    }
}

/// The claim of a white furnace: no more light leaves than arrives.
fn no_energy_made(reflected: &[Reflected]) -> Claim {
    let excess = |r: &Reflected| r.white[1] - 1.0 - 4.0 * r.error;
    let worst = reflected
        .iter()
        .max_by(|a, b| excess(a).total_cmp(&excess(b)));
    let (measured, holds) = worst.map_or((String::new(), true), |r| {
        let text = format!(
            "at most {:.4} ({}, theta_o = {:.0} deg; standard error {:.1e})",
            r.white[1], r.energy, r.theta_deg, r.error
        );
        // Fits of tables err by a thousandth or two.
        (text, excess(r) < 5e-3)
    });
    Claim::measured(
        "No treatment of energy sends back more light than arrives",
        "albedo at most 1 in a white furnace",
        measured,
        holds,
    )
}

/// All samplers sample their densities, and their weights have the right mean.
fn right_densities(fits: &[Fit]) -> Option<Claim> {
    let all: Vec<f64> = fits
        .iter()
        .flat_map(|f| [Some(f.chi_square.p_value), f.furnace_p])
        .flatten()
        .collect();
    let least = all.iter().copied().reduce(f64::min)?;
    let limit = sidak(SIGNIFICANCE, all.len());
    Some(Claim::measured(
        "Samplers sample their densities, and weights have the mean that the lobe has",
        "all p-values above the limit",
        format!(
            "least of {}: {}; limit {}",
            all.len(),
            significant(least, 2),
            significant(limit, 2)
        ),
        least >= limit,
    ))
}

/// The exact sampler rejects least.
fn rejected(trials: &[Trial]) -> Option<Claim> {
    let most = |name: &str| {
        let own = trials.iter().filter(|t| t.sampler == name);
        own.map(|t| t.rejected).reduce(f64::max)
    };
    let (cap, bounded, exact) = (most("cap")?, most("bounded")?, most("exact")?);
    let shares = [cap, bounded, exact].map(|v| 100.0 * v);
    Some(Claim::measured(
        "Bounded caps reject fewer directions than caps, and the exact sampler fewer still",
        "at most as many",
        format!(
            "most over all angles: cap {:.2} %, bounded {:.2} %, exact {:.2} %",
            shares[0], shares[1], shares[2]
        ),
        bounded <= cap + 1e-3 && exact <= bounded + 1e-3,
    ))
}
