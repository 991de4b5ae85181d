//! What a comparison leaves: tables, the course of the errors as a plot, pictures with error maps.

use specula_bsdf::vndf::Sampler;

use super::CompareOptions;
use super::estimate::Judged;
use super::reference::Reference;
use crate::output::table::significant;
use crate::output::{Comparison, Shot, Table};
use crate::plot::{Axis, Content, Figure, Panel, Series};
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
    references: &[Reference],
    lab: &mut Lab<'_>,
) -> Result<()> {
    lab.table(table(judged))?;
    lab.table(brightness(options, references))?;
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
        lab.comparison(&Comparison {
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

fn table(judged: &[Judged]) -> Table {
    let mut table = Table::new(
        "samplers",
        "Every combination after the same time. RMSE and relMSE are without the reference's own error; \
         efficiency is 1 / (MSE x time), relative to the best of the same energy.",
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
            "its standard error",
        ],
    );
    for j in judged {
        let taken = f64::from(j.samples) * j.picture.colour.len() as f64;
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
            j.efficiency[0].into(),
            j.efficiency[1].into(),
        ]);
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
