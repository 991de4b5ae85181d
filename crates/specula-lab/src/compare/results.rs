//! Output of a comparison: tables, a plot of errors over time, pictures with error maps.

use specula_bsdf::vndf::Sampler;

use super::CompareOptions;
use super::advice::{choice, decided};
use super::estimate::{Field, Judged};
use super::interval::Interval;
use super::reference::Reference;
use crate::output::table::significant;
use crate::output::{PictureComparison, Shot, Table};
use crate::plot::{Axis, Content, Figure, Intervals, Panel, Series};
use crate::{Lab, Result};

/// Style of a sampler's lines, the same in all plots.
pub(crate) fn style(sampler: Sampler) -> usize {
    match sampler {
        Sampler::Heitz => 6,
        Sampler::Cap => 3,
        Sampler::Bounded => 2,
        Sampler::Exact => 1,
    }
}

/// Writes all.
pub(super) fn write(
    options: &CompareOptions<'_>,
    judged: &[Judged],
    fields: &[Field],
    references: &[Reference],
    lab: &mut Lab<'_>,
) -> Result<()> {
    lab.table(table(judged, fields))?;
    lab.table(pairs(fields))?;
    lab.table(brightness(options, references))?;
    efficiencies(fields, lab)?;
    plot(options, judged, lab)?;
    for (number, reference) in references.iter().enumerate() {
        let own = judged.iter().filter(|j| j.reference == number);
        let energy = options.energies[number];
        let shots = own.map(|j| Shot {
            label: &j.label,
            picture: &j.picture,
            note: format!("{} spp, {} s", j.samples, significant(j.seconds, 3)),
        });
        let origin = if reference.halves.is_some() {
            format!(
                "rendered by the exact sampler for {} s with other seeds",
                significant(reference.seconds, 3)
            )
        } else {
            "as given".to_owned()
        };
        lab.comparison(&PictureComparison {
            name: &format!("energy-{energy}").replace('=', "-"),
            caption: &format!(
                "Energy {energy}: the same time for each sampler. The reference is {origin}; errors under \
                 the pictures contain its own."
            ),
            shots: shots.collect(),
            reference: Some(&reference.picture),
            insets: Vec::new(),
            exposure_stops: options.exposure_stops,
        })?;
    }
    Ok(())
}

fn table(judged: &[Judged], fields: &[Field]) -> Table {
    let mut table = Table::new(
        "samplers",
        "Every combination after the same time. RMSE and relMSE are without the reference's own error; \
         efficiency is 1 / (MSE x time), over that of the sampler that is recommended for the same energy, with \
         its interval of 95 % confidence.",
        &[
            "energy",
            "sampler",
            "samples [1/px]",
            "time [s]",
            "time per sample [us]",
            "RMSE",
            "relMSE",
            "fireflies [ppm]",
            "rejected [%]",
            "efficiency",
            "from",
            "to",
        ],
    );
    for j in judged {
        let taken = f64::from(j.samples) * j.picture.colour.len() as f64;
        let efficiency = over_the_recommended(j, fields).unwrap_or(Interval::unknown(f64::NAN));
        table.push([
            j.energy.to_string().into(),
            j.sampler.to_string().into(),
            j.samples.into(),
            j.seconds.into(),
            (1e6 * j.seconds / taken).into(),
            j.mse.sqrt().into(),
            j.rel_mse.into(),
            j.errors.fireflies_ppm.into(),
            (100.0 * j.rejected_share).into(),
            efficiency.middle.into(),
            efficiency.low.into(),
            efficiency.high.into(),
        ]);
    }
    table
}

fn over_the_recommended(judged: &Judged, fields: &[Field]) -> Option<Interval> {
    let field = fields.iter().find(|f| f.energy == judged.energy)?;
    let own = field.samplers.iter().position(|&s| s == judged.sampler)?;
    Some(field.ratios[own][choice(field)?.taken])
}

/// Every two samplers of a treatment.
fn pairs(fields: &[Field]) -> Table {
    let mut table = Table::new(
        "pairs",
        "Efficiency of each sampler over that of another, with intervals that all hold together at 95 % \
         confidence.",
        &[
            "energy",
            "sampler",
            "over",
            "efficiency",
            "from",
            "to",
            "decided",
        ],
    );
    for field in fields {
        let count = field.samplers.len();
        let each = (0..count).flat_map(|a| (a + 1..count).map(move |b| (a, b)));
        for (a, b) in each {
            let ratio = field.ratios[b][a];
            table.push([
                field.energy.to_string().into(),
                field.samplers[b].to_string().into(),
                field.samplers[a].to_string().into(),
                ratio.middle.into(),
                ratio.low.into(),
                ratio.high.into(),
                decided(ratio).into(),
            ]);
        }
    }
    table
}

/// Mean brightness of each treatment's reference.
fn brightness(options: &CompareOptions<'_>, references: &[Reference]) -> Table {
    let mut table = Table::new(
        "energy",
        "What each treatment of energy converges to: mean luminance over the picture.",
        &[
            "energy",
            "mean luminance",
            "its standard error",
            "over the first [%]",
            "its standard error [%]",
        ],
    );
    for (energy, reference) in options.energies.iter().zip(references) {
        let [mean, error] = reference.brightness();
        let [gain, gain_error] = gain(&references[0], reference);
        table.push([
            energy.to_string().into(),
            mean.into(),
            error.into(),
            (100.0 * gain).into(),
            (100.0 * gain_error).into(),
        ]);
    }
    table
}

/// How much brighter a reference is than another, as a share, and the standard error of that.
pub(super) fn gain(first: &Reference, other: &Reference) -> [f64; 2] {
    if std::ptr::eq(first, other) {
        return [0.0; 2];
    }
    let ([a, error_a], [b, error_b]) = (first.brightness(), other.brightness());
    let relative = (error_a / a).hypot(error_b / b);
    [b / a - 1.0, relative * b / a]
}

/// Points with their intervals, a panel for each treatment.
fn efficiencies(fields: &[Field], lab: &mut Lab<'_>) -> Result<()> {
    let panels = fields.iter().filter_map(|field| {
        let taken = choice(field)?.taken;
        let rows = field.samplers.iter().enumerate().map(|(i, &sampler)| {
            let Interval { middle, low, high } = field.ratios[i][taken];
            (sampler.to_string(), style(sampler), [middle, low, high])
        });
        Some(Panel {
            title: format!("energy {}", field.energy),
            x: Axis::linear(&format!(
                "efficiency over that of {}",
                field.samplers[taken]
            )),
            y: Axis::linear(""),
            content: Content::Intervals(Intervals {
                rows: rows.collect(),
                mark: 1.0,
            }),
        })
    });
    let panels: Vec<Panel> = panels.collect();
    if panels.is_empty() {
        return Ok(());
    }
    let figure = Figure {
        panel: [420.0, 190.0],
        ..Figure::grid(panels.len().min(3), panels)
    };
    lab.plot(
        "efficiency",
        "Efficiency, 1 / (MSE x time), over that of the sampler that is recommended, with intervals of 95 % \
         confidence. Whose interval holds 1 is not told apart from it.",
        &figure,
    )
}

fn plot(options: &CompareOptions<'_>, judged: &[Judged], lab: &mut Lab<'_>) -> Result<()> {
    let panels = options.energies.iter().enumerate().map(|(number, energy)| {
        let own = judged.iter().filter(|j| j.reference == number);
        let lines = own.map(|j| {
            let told = j.course.iter().copied().filter(|p| p[1] > 0.0);
            Series::new(&j.sampler.to_string(), style(j.sampler), told.collect())
        });
        Panel {
            title: format!("energy {energy}"),
            x: Axis::logarithmic("time [s]"),
            y: Axis::logarithmic("RMSE [radiance]"),
            content: Content::Lines(lines.collect()),
        }
    });
    let panels: Vec<Panel> = panels.collect();
    let caption = "Root of the mean squared error over time; both axes are logarithmic.";
    lab.plot(
        "course",
        caption,
        &Figure::grid(panels.len().min(3), panels),
    )
}
