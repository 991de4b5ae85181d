//! Plots of a measurement and of what was fitted to it.

use specula_bsdf::math::Stream;
use specula_bsdf::measured::Measured;
use specula_bsdf::{Bsdf, Rgb, Transport, Vec3};

use super::solve::Fit;
use crate::direction::direction;
use crate::output::Table;
use crate::plot::{Axis, Content, Figure, Map, Panel, Series};
use crate::{Lab, Result};

/// Angles of view, degrees.
const VIEWS_DEG: [f64; 4] = [5.0, 30.0, 60.0, 75.0];
/// Cells of a map along the polar angle and around it.
const CELLS: [u32; 2] = [45, 90];

/// `f cos` of a lobe, the mean of walks where it is random.
fn f_cos(fit: &Fit, wo: Vec3<f64>, wi: Vec3<f64>, walks: u32) -> Rgb<f64> {
    let lobe = fit.lobe.double();
    if !fit.lobe.is_stochastic() {
        return lobe.eval(wo, wi, Transport::Radiance);
    }
    let mut stream = Stream::new(1);
    let mut sum = Rgb::BLACK;
    for _ in 0..walks {
        sum += lobe
            .eval_pdf_random(wo, wi, Transport::Radiance, &mut stream)
            .0;
    }
    sum * (1.0 / f64::from(walks))
}

/// Measurement, the chosen lobe and the nearest of the other distribution in the plane of incidence.
pub(super) fn lobes(
    measured: &Measured<f64>,
    fits: &[Fit],
    best: &Fit,
    lab: &mut Lab<'_>,
) -> Result<()> {
    let other = (fits.iter())
        .filter(|f| f.candidate.distribution != best.candidate.distribution)
        .min_by(|a, b| a.loss.total_cmp(&b.loss));
    let steps = lab.pick(180, 720);
    let walks = lab.pick(256, 4096);
    let azimuths: &[f64] = if measured.is_isotropic() {
        &[0.0]
    } else {
        &[0.0, 90.0]
    };
    let mut table = Table::new(
        "lobes",
        "f cos theta as luminance in the plane of incidence.",
        &["view", "line", "theta_i [deg]", "f cos [1/sr]"],
    );
    let mut panels = Vec::new();
    for &azimuth in azimuths {
        for theta_o in VIEWS_DEG {
            let wo = direction(-theta_o, azimuth);
            let line = |value: &dyn Fn(Vec3<f64>) -> Rgb<f64>| -> Vec<[f64; 2]> {
                (-steps..=steps)
                    .map(|i| 89.0 * f64::from(i) / f64::from(steps))
                    .map(|theta| [theta, value(direction(theta, azimuth)).luminance()])
                    .filter(|p| p[1] > 0.0)
                    .collect()
            };
            let own = line(&|wi| measured.eval(wo, wi, Transport::Radiance));
            let mut lines = vec![
                Series::new("measured", 4, own),
                Series::new(
                    &format!("chosen: {}", best.candidate.name()),
                    0,
                    line(&|wi| f_cos(best, wo, wi, walks)),
                ),
            ];
            if let Some(other) = other {
                let points = line(&|wi| f_cos(other, wo, wi, walks));
                lines.push(Series::new(&other.candidate.name(), 1, points));
            }
            let plane = match azimuths.len() {
                1 => String::new(),
                _ => format!(", azimuth {azimuth} deg"),
            };
            let title = format!("theta_o = {theta_o} deg{plane}");
            for line in &lines {
                for [x, y] in &line.points {
                    let names = [title.as_str(), line.label.as_str()].map(Into::into);
                    let [title, label] = names;
                    table.push([title, label, (*x).into(), (*y).into()]);
                }
            }
            let top = lines
                .iter()
                .flat_map(|l| &l.points)
                .map(|p| p[1])
                .fold(0.0, f64::max);
            panels.push(Panel {
                title,
                x: Axis::linear("theta_i [deg]").from_to(-90.0, 90.0),
                y: Axis::logarithmic("f cos theta [1/sr]").from_to(1e-4 * top, 2.0 * top),
                content: Content::Lines(lines),
            });
        }
    }
    let caption =
        "The measurement and the fitted lobes in the plane of incidence, f cos theta as luminance.";
    lab.table(table)?;
    lab.plot("lobes", caption, &Figure::grid(2, panels))
}

/// How far the chosen lobe is from the measurement, over the directions of light.
pub(super) fn residuals(measured: &Measured<f64>, best: &Fit, lab: &mut Lab<'_>) -> Result<()> {
    let walks = lab.pick(32, 1024);
    let [rows, columns] = CELLS;
    let middle = |i: u32, n: u32, most: f64| most * (f64::from(i) + 0.5) / f64::from(n);
    let panels = VIEWS_DEG.map(|theta_o| {
        let wo = direction(theta_o, 180.0);
        let cell = |theta: f64, phi: f64| {
            let wi = direction(theta, phi);
            let own = measured.eval(wo, wi, Transport::Radiance).luminance();
            let fitted = f_cos(best, wo, wi, walks).luminance();
            (fitted / own).log2()
        };
        let values = (0..rows).map(|i| {
            let theta = middle(i, rows, 90.0);
            let row = (0..columns).map(|j| cell(theta, middle(j, columns, 360.0) - 180.0));
            row.collect()
        });
        Panel {
            title: format!("theta_o = {theta_o} deg"),
            x: Axis::linear("phi_i [deg]").from_to(-180.0, 180.0),
            y: Axis::linear("theta_i [deg]").from_to(0.0, 90.0),
            content: Content::Map(Map {
                rows: values.collect(),
                x: [-180.0, 180.0],
                y: [0.0, 90.0],
                label: "fitted over measured [stops]".to_owned(),
                range: Some([-1.0, 1.0]),
            }),
        }
    });
    let caption = "How much brighter the chosen lobe is than the measurement, by direction of light; the mirror \
                   direction is at phi_i = 0. Cells without a measured value are empty.";
    lab.plot("residuals", caption, &Figure::grid(2, panels.into()))
}
