//! Cui et al. 2023, fig. 10 (middle): error over samples per pixel.

use specula_render::picture::Picture;
use specula_render::{PreparedScene, Renderer};

use super::cui23_models::{
    BITTERLI, CUI, CUI_BIDIRECTIONAL, HEITZ, IMPLEMENTATIONS, SPECULA, Shown, WANG,
};
use super::cui23_renders::{Reference, Way, reference};
use crate::output::Table;
use crate::plot::{Axis, Content, Figure, Panel, Series};
use crate::scenes::testball::testball;
use crate::{Claim, Experiment, Lab, LabError, Result, Source, Verdict};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    id: "cui23-fig10-error",
    source: Source::Cui23,
    item: "fig. 10, middle",
    title: "error over samples per pixel",
    statement: "On the copper ball both estimators converge to the result of Heitz et al. 2016, \
                faster than it does and the bidirectional one fastest; Wang et al. 2022 does not \
                converge to it.",
    run,
};

const MODELS: [Shown; 6] = [HEITZ, BITTERLI, WANG, CUI, CUI_BIDIRECTIONAL, SPECULA];
const AT_HEITZ: usize = 0;
const AT_WANG: usize = 2;
const AT_CUI: usize = 3;
const AT_BIDIRECTIONAL: usize = 4;
/// Light that the metal reflects at once.
const DIRECT: u32 = 1;

/// A model's way to the reference.
struct Curve {
    shown: Shown,
    /// Samples per pixel, mean squared error.
    points: Vec<[f64; 2]>,
}

impl Curve {
    /// A quarter of the samples, and all.
    fn ends(&self) -> [[f64; 2]; 2] {
        let all = self.points.last().copied().unwrap_or([f64::NAN; 2]);
        let quarter = self.points.iter().find(|p| 4.0 * p[0] >= all[0]);
        [quarter.copied().unwrap_or(all), all]
    }

    fn last(&self) -> [f64; 2] {
        self.ends()[1]
    }

    /// Slope of the logarithm of the error over that of the samples, over the last part.
    fn slope(&self) -> f64 {
        let [a, b] = self.ends();
        (b[1] / a[1]).ln() / (b[0] / a[0]).ln()
    }

    /// The same from the first sample on.
    fn whole_slope(&self) -> f64 {
        let [a, b] = [self.points[0], self.last()];
        (b[1] / a[1]).ln() / (b[0] / a[0]).ln()
    }

    /// The squared bias `b` of `b + v / samples` through the ends of the last part.
    fn squared_bias(&self) -> f64 {
        let [a, b] = self.ends();
        let variance = (a[1] - b[1]) / (1.0 / a[0] - 1.0 / b[0]);
        b[1] - variance / b[0]
    }
}

fn run(lab: &mut Lab<'_>) -> Result<Verdict> {
    lab.step(0.0, "rendering the reference")?;
    let scene = testball(lab.pick(48, 96), 1.0);
    let truth = reference(lab, &scene, HEITZ.model, lab.pick(1024, 8192), DIRECT)?;
    let mut curves = Vec::new();
    for (i, shown) in MODELS.into_iter().enumerate() {
        lab.step(0.3 + 0.1 * i as f64, shown.label)?;
        let mut options = Way::of(shown, 0, DIRECT).options;
        options.seed = lab.render_seed();
        let prepared = PreparedScene::new(&scene, &options)?;
        curves.push(curve(
            lab,
            shown,
            Renderer::new(&prepared, options),
            &truth,
        )?);
    }
    lab.table(table(&curves))?;
    let caption = "Mean squared error of a copper ball (alpha = 1, directional light) against a \
                   converged render by Heitz 2016.";
    lab.plot("error", caption, &figure(&curves))?;
    Ok(verdict(&curves, &truth))
}

/// Errors of one render as its samples grow.
fn curve(
    lab: &Lab<'_>,
    shown: Shown,
    mut renderer: Renderer<'_>,
    truth: &Reference,
) -> Result<Curve> {
    let mut points = Vec::new();
    let mut samples = 0;
    let factor = lab.pick(4, 2);
    let most = lab.pick(256, 1024);
    let mut next = 1;
    while next <= most {
        if !renderer.render_pass(next - samples, lab.stop()).complete {
            return Err(LabError::Stopped);
        }
        samples = next;
        next *= factor;
        let picture: Picture = renderer.film().picture();
        points.push([f64::from(samples), truth.mse(&picture)]);
    }
    Ok(Curve { shown, points })
}

fn table(curves: &[Curve]) -> Table {
    let mut table = Table::new(
        "error",
        "Mean squared error against Heitz 2016.",
        &["model", "samples per pixel", "MSE"],
    );
    for curve in curves {
        for [samples, error] in &curve.points {
            table.push([curve.shown.label.into(), (*samples).into(), (*error).into()]);
        }
    }
    table
}

fn figure(curves: &[Curve]) -> Figure {
    let most = curves.iter().map(|c| c.last()[0]).fold(1.0, f64::max);
    let series = curves.iter().map(|curve| {
        let points = curve.points.iter().map(|p| [p[0], p[1]]).collect();
        Series::new(curve.shown.label, curve.shown.style, points)
    });
    Figure::single(Panel {
        title: "copper ball, alpha = 1".to_owned(),
        x: Axis::logarithmic("samples per pixel").from_to(1.0, most),
        y: Axis::logarithmic("MSE"),
        content: Content::Lines(series.collect()),
    })
}

fn verdict(curves: &[Curve], truth: &Reference) -> Verdict {
    let last = |i: usize| curves[i].last()[1];
    let slopes = || curves.iter().enumerate().filter(|(i, _)| *i != AT_WANG);
    let worst = slopes()
        .map(|(_, c)| c.whole_slope())
        .fold(f64::NEG_INFINITY, f64::max);
    let wang = curves[AT_WANG].slope();
    let [samples, error] = curves[AT_WANG].last();
    let bias = curves[AT_WANG].squared_bias();
    let to_heitz = |i: usize| last(i) / last(AT_HEITZ);
    Verdict {
        summary: format!(
            "At {samples} spp the MSE over that of Heitz 2016 is: Cui {:.2}, bidirectional {:.2}, \
             Specula {:.2}, Wang {:.1}.",
            to_heitz(AT_CUI),
            to_heitz(AT_BIDIRECTIONAL),
            to_heitz(5),
            to_heitz(AT_WANG)
        ),
        claims: vec![
            Claim::law(
                "All but Wang converge to Heitz 2016 as samples grow",
                "MSE falls as 1 / samples",
                format!("slope at most {worst:.2} (1 / samples is -1)"),
                worst < -0.9,
            ),
            Claim::law(
                "Wang 2022 does not",
                "biased",
                format!(
                    "slope {wang:.2}; its MSE levels off at {bias:.1e}, {:.0} % of it at {samples} spp",
                    100.0 * bias / error
                ),
                wang > -0.5 && bias > 0.5 * error,
            ),
            Claim::law(
                "Cui's estimators converge faster than Heitz 2016",
                "both faster",
                format!(
                    "MSE over Heitz's: {:.2} from one end, {:.2} from both",
                    to_heitz(AT_CUI),
                    to_heitz(AT_BIDIRECTIONAL)
                ),
                to_heitz(AT_CUI) < 0.9 && to_heitz(AT_BIDIRECTIONAL) < 0.9,
            ),
            Claim::law(
                "The bidirectional one converges fastest",
                "the fastest",
                format!(
                    "{:.2} of Cui's from one end",
                    last(AT_BIDIRECTIONAL) / last(AT_CUI)
                ),
                last(AT_BIDIRECTIONAL) < 0.8 * last(AT_CUI),
            ),
        ],
        caveat: format!(
            "A ball of our own instead of Matpreview; direct light only. {IMPLEMENTATIONS} The \
             reference's own variance (relative error {:.1e}) is subtracted from all errors.",
            truth.relative_error()
        ),
    }
}
