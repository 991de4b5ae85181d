//! Tokuyoshi and Eto 2024, fig. 7: error over anisotropic alpha on the orb of fig. 6.

use super::coarse_orb::{renders, rmse, scene, squares_by_stripe};
use super::orb_render::{SAMPLERS, mean_and_error};
use crate::output::Table;
use crate::plot::{Axis, Content, Figure, Panel, Series};
use crate::{Claim, Experiment, Lab, Result, Source, Verdict};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    id: "tokuyoshi24-fig7",
    source: Source::Tokuyoshi24,
    item: "fig. 7",
    title: "error over unequal alphas on an orb with backfacing shading normals",
    statement: "The bounded cap reduces the error most where both alphas are large and nearly equal, and \
                little where they are very unequal.",
    run,
};

/// Renders by each sampler.
const RENDERS: u32 = 3;

/// Errors of cap, bounded, exact.
type Errors = [f64; 3];

/// A point of the plots.
struct Point {
    alpha: (f64, f64),
    errors: Errors,
    /// Standard error of the quotient bounded / cap.
    uncertainty: f64,
}

fn run(lab: &mut Lab<'_>) -> Result<Verdict> {
    let side = lab.pick(48, 96);
    let xs: &[f64] = lab.pick(
        &[0.1, 0.4, 0.7, 1.0],
        &[0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0],
    );
    let ys: &[f64] = lab.pick(&[0.1, 0.4, 1.0], &[0.1, 0.2, 0.4, 0.6, 0.8, 1.0]);
    let mut points = Vec::new();
    for (i, &y) in ys.iter().enumerate() {
        for (j, &x) in xs.iter().enumerate() {
            let share = (i * xs.len() + j) as f64 / (ys.len() * xs.len()) as f64;
            points.push(measure(lab, (x, y), side, share)?);
        }
    }
    let mut table = Table::new(
        "errors",
        "Root mean squared errors, 16 samples per pixel.",
        &[
            "alpha_x",
            "alpha_y",
            "cap",
            "bounded",
            "exact",
            "bounded / cap",
            "standard error of the quotient",
            "exact / cap",
        ],
    );
    for point in &points {
        let [cap, bounded, exact] = point.errors;
        table.push([
            point.alpha.0.into(),
            point.alpha.1.into(),
            cap.into(),
            bounded.into(),
            exact.into(),
            (bounded / cap).into(),
            point.uncertainty.into(),
            (exact / cap).into(),
        ]);
    }
    lab.table(table)?;
    plot(lab, ys, &points)?;
    Ok(verdict(&points))
}

fn measure(lab: &Lab<'_>, alpha: (f64, f64), side: u32, share: f64) -> Result<Point> {
    let scene = scene(alpha, side);
    let mut errors = [0.0; 3];
    let mut stripes = Vec::new();
    for (error, (sampler, name, _)) in errors.iter_mut().zip(SAMPLERS) {
        lab.step(share, &format!("{name}, alpha ({}, {})", alpha.0, alpha.1))?;
        let renders = renders(lab, &scene, sampler, RENDERS)?;
        *error = rmse(&renders);
        stripes.push(squares_by_stripe(&renders));
    }
    let quotients: Vec<f64> = stripes[1]
        .iter()
        .zip(&stripes[0])
        .map(|(bounded, cap)| (bounded / cap).sqrt())
        .collect();
    Ok(Point {
        alpha,
        errors,
        uncertainty: mean_and_error(&quotients).1,
    })
}

fn plot(lab: &mut Lab<'_>, ys: &[f64], points: &[Point]) -> Result<()> {
    let errors = || points.iter().flat_map(|p| p.errors);
    let (least, greatest) = (
        errors().fold(f64::INFINITY, f64::min),
        errors().fold(0.0, f64::max),
    );
    let panels = ys
        .iter()
        .map(|&y| {
            let series = SAMPLERS.iter().enumerate().map(|(i, &(_, name, style))| {
                let of = points.iter().filter(|p| p.alpha.1 == y);
                Series::new(name, style, of.map(|p| [p.alpha.0, p.errors[i]]).collect())
            });
            Panel {
                title: format!("alpha_y = {y}"),
                x: Axis::linear("alpha_x").from_to(0.0, 1.0),
                y: Axis::logarithmic("RMSE").from_to(0.8 * least, 1.25 * greatest),
                content: Content::Lines(series.collect()),
            }
        })
        .collect();
    let caption = "Error over alpha_x, Turquin's compensation, 16 samples per pixel.";
    lab.plot("errors", caption, &Figure::grid(3, panels))
}

fn verdict(points: &[Point]) -> Verdict {
    let at = |x: f64, y: f64| {
        let found = points.iter().find(|p| p.alpha == (x, y));
        found.map_or([f64::NAN; 3], |p| {
            let [cap, bounded, exact] = p.errors;
            [bounded / cap, exact / cap, p.uncertainty]
        })
    };
    let text = |[bounded, _, error]: [f64; 3]| format!("{bounded:.2} +- {error:.2}");
    let (rough, fine) = (at(1.0, 1.0), at(0.1, 0.1));
    let (unequal, turned) = (at(1.0, 0.1), at(0.1, 1.0));
    Verdict {
        summary: format!(
            "RMSE of the bounded cap over the cap's: {} at (1, 1), {} at (1, 0.1), {} at (0.1, 1), {} at \
             (0.1, 0.1); of the exact sampler {:.2}, {:.2}, {:.2}, {:.2}.",
            text(rough),
            text(unequal),
            text(turned),
            text(fine),
            rough[1],
            unequal[1],
            turned[1],
            fine[1]
        ),
        claims: vec![
            Claim::law(
                "The bounded cap reduces the error of rough surfaces of low anisotropy",
                "effective",
                format!("{} at (1, 1)", text(rough)),
                rough[0] < 0.9,
            ),
            Claim::law(
                "It reduces it little at high anisotropy",
                "room for improvement",
                format!(
                    "{} at (1, 0.1), {} at (0.1, 1)",
                    text(unequal),
                    text(turned)
                ),
                (0.85..1.15).contains(&unequal[0]),
            ),
            Claim::law(
                "The exact sampler reduces it there too",
                "not in the paper",
                format!(
                    "{:.2} at (1, 0.1), {:.2} at (0.1, 1)",
                    unequal[1], turned[1]
                ),
                unequal[1] < 0.85 && turned[1] < 0.85,
            ),
        ],
        caveat:
            "An orb and light of our own. Errors are those of renders that are independent of each \
                 other, without a reference; directions are sampled by the sampler alone."
                .to_owned(),
    }
}
