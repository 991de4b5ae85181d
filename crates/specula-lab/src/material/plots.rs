//! Plots and tables of a material.

use specula_bsdf::Bsdf;

use super::lobes::{Named, Variants, direction, f_cos};
use super::trials::{Reflected, Trial};
use crate::output::Table;
use crate::plot::{Axis, Content, Figure, Panel, Series};
use crate::{Lab, Result};

/// Angles of view of the plots, degrees.
const VIEWS_DEG: [f64; 4] = [0.0, 30.0, 60.0, 80.0];

/// Lobes and densities in the plane of incidence.
pub(super) fn lobes(variants: &Variants, lab: &mut Lab<'_>) -> Result<()> {
    let azimuths: &[f64] = if variants.is_anisotropic {
        &[0.0, 90.0]
    } else {
        &[0.0]
    };
    let walks = lab.pick(256, 4096);
    let values = |named: &Named, wo, wi| f_cos(&named.lobe, wo, wi, walks).luminance();
    let panels = panels(
        variants,
        azimuths,
        "f cos theta [1/sr]",
        |wo_deg, azimuth| {
            let energies = variants.energies.iter();
            energies
                .map(|n| line(variants, n, wo_deg, azimuth, lab, values))
                .collect()
        },
    );
    let caption = "The lobe in the plane of incidence, f cos theta as luminance; the mirror direction is at \
                   theta_i = theta_o.";
    lab.table(table("lobes", caption, "f cos [1/sr]", &panels))?;
    lab.plot("lobes", caption, &Figure::grid(2, panels))?;
    let densities = |n: &Named, wo, wi| f64::from(n.lobe.pdf(wo, wi));
    let panels = self::panels(variants, azimuths, "pdf [1/sr]", |wo_deg, azimuth| {
        let samplers = variants.samplers.iter();
        samplers
            .map(|n| line(variants, n, wo_deg, azimuth, lab, densities))
            .collect()
    });
    let caption = "Densities of the samplers in the plane of incidence.";
    lab.table(table("densities", caption, "pdf [1/sr]", &panels))?;
    lab.plot("densities", caption, &Figure::grid(2, panels))
}

/// A panel for each angle of view and azimuth.
fn panels(
    variants: &Variants,
    azimuths: &[f64],
    label: &str,
    lines: impl Fn(f64, f64) -> Vec<Series>,
) -> Vec<Panel> {
    let most = if variants.lets_pass() { 180.0 } else { 90.0 };
    let mut panels = Vec::new();
    for &azimuth in azimuths {
        for theta_o in VIEWS_DEG {
            let plane = match azimuths.len() {
                1 => String::new(),
                _ => format!(", azimuth {azimuth} deg"),
            };
            panels.push(Panel {
                title: format!("theta_o = {theta_o} deg{plane}"),
                x: Axis::linear("theta_i [deg]").from_to(-most, most),
                y: Axis::linear(label),
                content: Content::Lines(lines(theta_o, azimuth)),
            });
        }
    }
    panels
}

fn line(
    variants: &Variants,
    named: &Named,
    theta_o: f64,
    azimuth: f64,
    lab: &Lab<'_>,
    value: impl Fn(&Named, specula_bsdf::Vec3<f32>, specula_bsdf::Vec3<f32>) -> f64,
) -> Series {
    let steps = lab.pick(90, 360);
    let most = if variants.lets_pass() { 180.0 } else { 90.0 };
    // The view stands on the other side of the normal than mirrored light.
    let wo = direction(-theta_o, azimuth);
    let points = (-steps..=steps).map(|i| {
        let theta_i = most * f64::from(i) / f64::from(steps);
        [theta_i, value(named, wo, direction(theta_i, azimuth))]
    });
    Series::new(&named.name, named.style, points.collect())
}

/// The points of all lines of panels.
fn table(name: &str, caption: &str, quantity: &str, panels: &[Panel]) -> Table {
    let mut table = Table::new(name, caption, &["view", "line", "theta_i [deg]", quantity]);
    for panel in panels {
        let Content::Lines(lines) = &panel.content else {
            continue;
        };
        for line in lines {
            for [x, y] in &line.points {
                let names = [panel.title.as_str(), line.label.as_str()].map(Into::into);
                let [title, label] = names;
                table.push([title, label, (*x).into(), (*y).into()]);
            }
        }
    }
    table
}

/// Lines of equal names, in the order in which they come.
fn lines<T>(
    all: &[T],
    name: impl Fn(&T) -> (&str, usize),
    point: impl Fn(&T) -> [f64; 2],
) -> Vec<Series> {
    let mut lines: Vec<Series> = Vec::new();
    for one in all {
        let (label, style) = name(one);
        match lines.last_mut() {
            Some(line) if line.label == label => line.points.push(point(one)),
            _ => lines.push(Series::new(label, style, vec![point(one)])),
        }
    }
    lines
}

/// Albedo over the angle of view, in colour and in a white furnace.
pub(super) fn reflected(all: &[Reflected], lab: &mut Lab<'_>) -> Result<()> {
    let mut table = Table::new(
        "albedo",
        "Light that is sent back, of what arrives from all sides; furnace: the same with white in place of \
         all colours.",
        &[
            "energy",
            "theta_o [deg]",
            "red",
            "green",
            "blue",
            "furnace",
            "its standard error",
        ],
    );
    for r in all {
        let [red, green, blue] = r.own.map(Into::into);
        table.push([
            r.energy.as_str().into(),
            r.theta_deg.into(),
            red,
            green,
            blue,
            r.white[1].into(),
            r.error.into(),
        ]);
    }
    lab.table(table)?;
    let panel = |title: &str, value: fn(&Reflected) -> f64| Panel {
        title: title.to_owned(),
        x: Axis::linear("theta_o [deg]").from_to(0.0, 90.0),
        y: Axis::linear("albedo").from_to(0.0, 1.05),
        content: Content::Lines(lines(
            all,
            |r| (r.energy.as_str(), r.style),
            |r| [r.theta_deg, value(r)],
        )),
    };
    let luminance = |r: &Reflected| specula_bsdf::Rgb::from(r.own).luminance();
    let panels = vec![
        panel("albedo (luminance)", luminance),
        panel("white furnace", |r| r.white[1]),
    ];
    let caption = "Directional albedo by treatment of energy, of the material and of a white one.";
    lab.plot("albedo", caption, &Figure::grid(2, panels))
}

/// Rejected samples.
pub(super) fn samplers(all: &[Trial], lab: &mut Lab<'_>) -> Result<()> {
    let mut table = Table::new(
        "samplers",
        "What each sampler does with its samples: rejected ones count as 0.",
        &[
            "sampler",
            "theta_o [deg]",
            "rejected [%]",
            "mean weight",
            "variance of the weight",
        ],
    );
    for t in all {
        table.push([
            t.sampler.as_str().into(),
            t.theta_deg.into(),
            (100.0 * t.rejected).into(),
            t.mean.into(),
            t.variance.into(),
        ]);
    }
    lab.table(table)?;
    let panel = |title: &str, label: &str, value: fn(&Trial) -> f64| Panel {
        title: title.to_owned(),
        x: Axis::linear("theta_o [deg]").from_to(0.0, 90.0),
        y: Axis::linear(label),
        content: Content::Lines(lines(
            all,
            |t| (t.sampler.as_str(), t.style),
            |t| [t.theta_deg, value(t)],
        )),
    };
    let panels = vec![
        panel("rejected samples", "share of samples [%]", |t| {
            100.0 * t.rejected
        }),
        panel("variance of the weight", "variance", |t| t.variance),
    ];
    let caption = "Rejected samples and the variance of the weight's luminance, over the angle of view; single \
                   scattering.";
    lab.plot("samplers", caption, &Figure::grid(2, panels))
}
