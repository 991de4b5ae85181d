//! Cui et al. 2023, fig. 5: reflectance and inverse efficiency over the angle of reflection.

use std::hint::black_box;
use std::time::Instant;

use rayon::prelude::*;
use specula_bsdf::bsdf::MultibounceConductor;
use specula_bsdf::fresnel::Reflectance;
use specula_bsdf::math::{Stream, vec3};
use specula_bsdf::ndf::Ggx;
use specula_bsdf::{Alpha, Rgb, Vec3};
use specula_stat::z_test::{Moments, equal_means, sidak};

use super::cui23_models::{
    BITTERLI, CUI, CUI_BIDIRECTIONAL, HEITZ, IMPLEMENTATIONS, SPECULA, Shown, WANG,
    WANG_UNCORRELATED,
};
use super::stopwatch::median;
use crate::output::Table;
use crate::plot::{Axis, Content, Figure, Panel, Series};
use crate::{Claim, Experiment, Lab, Result, Source, Verdict};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    id: "cui23-fig5",
    source: Source::Cui23,
    item: "fig. 5",
    title: "reflectance and inverse efficiency over the angle of reflection",
    statement: "The reflectance is that of Heitz et al. 2016 and of Bitterli and d'Eon 2022, and the \
                estimator is more efficient than theirs in all cases. Wang et al. 2022 does not match \
                the truth, but is more efficient at theta_o = 0 for alpha = 1.",
    run,
};

/// Alpha and angle of incidence of each column.
const COLUMNS: [(f32, f32); 4] = [(0.5, 0.0), (0.5, 60.0), (1.0, 0.0), (1.0, 60.0)];

/// Index of each model within a [`Point`].
const MODELS: [Shown; 7] = [
    HEITZ,
    BITTERLI,
    WANG,
    WANG_UNCORRELATED,
    CUI,
    CUI_BIDIRECTIONAL,
    SPECULA,
];
const AT_HEITZ: usize = 0;
const AT_BITTERLI: usize = 1;
const AT_WANG: usize = 2;
const AT_CUI: usize = 4;
const AT_BIDIRECTIONAL: usize = 5;
const AT_SPECULA: usize = 6;
/// Those that estimate what Heitz 2016 does.
const UNBIASED: [usize; 4] = [AT_BITTERLI, AT_CUI, AT_BIDIRECTIONAL, AT_SPECULA];

/// Probability that a true "all agree" is denied.
const SIGNIFICANCE: f64 = 1e-4;

type Lobe = MultibounceConductor<f32, Ggx<f32>>;

/// The result for one pair of directions.
struct Point {
    column: usize,
    theta_o_deg: f32,
    values: [Moments; MODELS.len()],
    ns: [f64; MODELS.len()],
}

impl Point {
    /// Variance times time, in sr^-2 ns.
    fn inverse_efficiency(&self, model: usize) -> f64 {
        self.values[model].variance() * self.ns[model]
    }

    /// Of `a` over `b`.
    fn variance_ratio(&self, a: usize, b: usize) -> f64 {
        self.values[a].variance() / self.values[b].variance()
    }

    /// Probability of so large a difference from Heitz 2016, were there none.
    fn p_value(&self, model: usize) -> f64 {
        let [a, b] =
            [model, AT_HEITZ].map(|i| (self.values[i].mean(), self.values[i].variance_of_mean()));
        equal_means(a, b)
    }

    fn relative_difference(&self, model: usize) -> f64 {
        self.values[model].mean() / self.values[AT_HEITZ].mean() - 1.0
    }
}

fn run(lab: &mut Lab<'_>) -> Result<Verdict> {
    let mut points = Vec::new();
    let step_deg = lab.pick(5.0, 2.5);
    let steps = lab.pick(17_u16, 34);
    for column in 0..COLUMNS.len() {
        lab.step(0.2 * column as f64, "estimating reflectances")?;
        let mut row: Vec<Point> = (0..=steps)
            .into_par_iter()
            .map(|i| estimate(lab, column, f32::from(i) * step_deg))
            .collect();
        measure_times(lab, &mut row);
        points.extend(row);
    }
    lab.step(0.9, "plotting")?;
    lab.table(values(&points))?;
    lab.table(means(&points))?;
    let caption = "Above: mean f cos of a white rough metal, forward in the plane of incidence. Below: \
                   variance of one evaluation times its time.";
    lab.plot("reflectance", caption, &figure(&points))?;
    Ok(verdict(&points))
}

/// Directions of the papers' i and o: our `wo` and `wi`.
fn directions(theta_i_deg: f32, theta_o_deg: f32) -> (Vec3<f32>, Vec3<f32>) {
    let at = |degrees: f32| degrees.to_radians().sin_cos();
    let ((si, ci), (so, co)) = (at(theta_i_deg), at(theta_o_deg));
    (vec3(-si, 0.0, ci), vec3(so, 0.0, co))
}

fn lobes(alpha: f32) -> [Lobe; MODELS.len()] {
    let white = Reflectance::Constant(Rgb::splat(1.0));
    let ndf = Ggx::new(Alpha::isotropic(alpha));
    MODELS.map(|shown| MultibounceConductor::new(ndf, white, shown.model))
}

fn estimate(lab: &Lab<'_>, column: usize, theta_o_deg: f32) -> Point {
    let evaluations = lab.pick(12_000, 200_000);
    let (alpha, theta_i_deg) = COLUMNS[column];
    let (wo, wi) = directions(theta_i_deg, theta_o_deg);
    let mut number = 0;
    let values = lobes(alpha).map(|lobe| {
        number += 1;
        let place = u64::from((theta_o_deg * 8.0).to_bits()) << 16 | (column as u64) << 8 | number;
        let mut stream = Stream::new(lab.seed().wrapping_mul(0x9e37_79b9) ^ place << 20);
        let mut moments = Moments::default();
        for _ in 0..evaluations {
            moments.push(f64::from(lobe.estimate(wo, wi, &mut stream).g));
        }
        moments
    });
    Point {
        column,
        theta_o_deg,
        values,
        ns: [0.0; MODELS.len()],
    }
}

/// All models and angles of a column take turns; medians.
fn measure_times(lab: &Lab<'_>, row: &mut [Point]) {
    let evaluations = lab.pick(300_u32, 1000);
    let mut stream = Stream::new(lab.seed());
    let mut times = vec![[const { Vec::new() }; MODELS.len()]; row.len()];
    for _ in 0..lab.pick(5, 15) {
        for (point, times) in row.iter().zip(&mut times) {
            let (alpha, theta_i_deg) = COLUMNS[point.column];
            let (wo, wi) = directions(theta_i_deg, point.theta_o_deg);
            for (lobe, times) in lobes(alpha).iter().zip(times) {
                let begin = Instant::now();
                for _ in 0..evaluations {
                    let (wo, wi) = black_box((wo, wi));
                    black_box(lobe.estimate(wo, wi, &mut stream));
                }
                times.push(begin.elapsed().as_secs_f64() * 1e9 / f64::from(evaluations));
            }
        }
    }
    for (point, times) in row.iter_mut().zip(times) {
        point.ns = times.map(median);
    }
}

fn values(points: &[Point]) -> Table {
    let mut table = Table::new(
        "reflectance",
        "Mean f cos, variance of one evaluation and its time, F = 1.",
        &[
            "alpha",
            "theta_i [deg]",
            "theta_o [deg]",
            "model",
            "f cos [1/sr]",
            "standard error [1/sr]",
            "variance [1/sr^2]",
            "time [ns]",
            "variance x time [ns/sr^2]",
        ],
    );
    for point in points {
        let (alpha, theta_i) = COLUMNS[point.column];
        for (i, shown) in MODELS.iter().enumerate() {
            let value = &point.values[i];
            table.push([
                alpha.into(),
                theta_i.into(),
                point.theta_o_deg.into(),
                shown.label.into(),
                value.mean().into(),
                value.variance_of_mean().sqrt().into(),
                value.variance().into(),
                point.ns[i].into(),
                point.inverse_efficiency(i).into(),
            ]);
        }
    }
    table
}

/// Geometric mean over the points of a column, or of all.
fn mean_ratio(points: &[Point], column: Option<usize>, ratio: impl Fn(&Point) -> f64) -> f64 {
    let chosen = points
        .iter()
        .filter(|p| column.is_none_or(|c| c == p.column));
    let logs: Vec<f64> = chosen.map(|p| ratio(p).ln()).collect();
    (logs.iter().sum::<f64>() / logs.len() as f64).exp()
}

fn means(points: &[Point]) -> Table {
    let mut table = Table::new(
        "efficiency",
        "Over Heitz 2016, geometric means over theta_o: variance, time and their product.",
        &[
            "alpha",
            "theta_i [deg]",
            "model",
            "variance",
            "time",
            "product",
        ],
    );
    for (column, (alpha, theta_i)) in COLUMNS.into_iter().enumerate() {
        for (i, shown) in MODELS.iter().enumerate() {
            let over = |ratio: &dyn Fn(&Point) -> f64| mean_ratio(points, Some(column), ratio);
            let variance = over(&|p| p.variance_ratio(i, AT_HEITZ));
            let time = over(&|p| p.ns[i] / p.ns[AT_HEITZ]);
            table.push([
                alpha.into(),
                theta_i.into(),
                shown.label.into(),
                variance.into(),
                time.into(),
                (variance * time).into(),
            ]);
        }
    }
    table
}

fn figure(points: &[Point]) -> Figure {
    let panel =
        |column: usize, label: &str, logarithmic: bool, value: &dyn Fn(&Point, usize) -> f64| {
            let (alpha, theta_i) = COLUMNS[column];
            let line = |i: usize| {
                let here = points.iter().filter(|p| p.column == column);
                here.map(|p| [f64::from(p.theta_o_deg), value(p, i)])
                    .collect()
            };
            // The truth first, so that the others lie over it.
            let series = (0..MODELS.len())
                .map(|i| Series::new(MODELS[i].label, MODELS[i].style, line(i)))
                .collect();
            let y = if logarithmic {
                Axis::logarithmic(label).from_to(1e-3, 1e2)
            } else {
                Axis::linear(label)
            };
            Panel {
                title: format!("alpha = {alpha}, theta_i = {theta_i} deg"),
                x: Axis::linear("theta_o [deg]").from_to(0.0, 90.0),
                y,
                content: Content::Lines(series),
            }
        };
    let mut panels = Vec::new();
    for column in 0..COLUMNS.len() {
        panels.push(panel(column, "f cos theta_o [1/sr]", false, &|p, i| {
            p.values[i].mean()
        }));
    }
    for column in 0..COLUMNS.len() {
        let label = "variance x time [ns/sr^2]";
        panels.push(panel(column, label, true, &Point::inverse_efficiency));
    }
    Figure::grid(COLUMNS.len(), panels)
}

/// Lowest and highest relative difference of Wang 2022 up to an angle, in percent.
fn wang_range(points: &[Point], to_deg: f32) -> [f64; 2] {
    let near = points.iter().filter(|p| p.theta_o_deg <= to_deg);
    near.map(|p| 100.0 * p.relative_difference(AT_WANG))
        .fold([0.0; 2], |[low, high]: [f64; 2], d| {
            [low.min(d), high.max(d)]
        })
}

/// Geometric mean of the inverse efficiency of one model over another's.
fn efficiency_ratio(points: &[Point], model: usize, over: usize) -> f64 {
    mean_ratio(points, None, |p| {
        p.inverse_efficiency(model) / p.inverse_efficiency(over)
    })
}

fn verdict(points: &[Point]) -> Verdict {
    let [low, high] = wang_range(points, 90.0);
    let [cui, specula] = [AT_CUI, AT_SPECULA].map(|i| efficiency_ratio(points, i, AT_HEITZ));
    let mut claims = claims_of_means(points);
    claims.extend(claims_of_efficiency(points));
    claims.extend(claims_of_variance(points));
    Verdict {
        summary: format!(
            "Wang 2022 differs by {low:.0} to {high:+.0} %; variance x time over that of Heitz 2016: \
             Cui 2023 {cui:.2}, Specula {specula:.2}."
        ),
        claims,
        caveat: format!(
            "{IMPLEMENTATIONS} Reflectance 1, f32, one thread. The variance of connections of Heitz \
             2016 and of Bitterli and d'Eon diverges at theta_o = 0."
        ),
    }
}

fn claims_of_means(points: &[Point]) -> Vec<Claim> {
    let pairs = || points.iter().flat_map(|p| UNBIASED.map(|i| (p, i)));
    let count = pairs().count();
    let least = pairs().map(|(p, i)| p.p_value(i)).fold(1.0, f64::min);
    let bound = sidak(SIGNIFICANCE, count);
    let [_, high] = wang_range(points, 90.0);
    let [low_60, high_60] = wang_range(points, 60.0);
    let denied = points.iter().filter(|p| p.p_value(AT_WANG) < bound).count();
    let of = points.len();
    vec![
        Claim::law(
            "Cui, Bitterli and d'Eon (and Specula) have the mean of Heitz 2016",
            "the same reflectance",
            format!("least p-value {least:.1e} of {count} (bound {bound:.1e})"),
            least > bound,
        ),
        Claim::law(
            "Wang 2022 does not match the truth",
            "biased",
            format!(
                "{low_60:.0} to {high_60:+.0} % up to 60 degrees, to {high:+.0} % at 85; denied at \
                 {denied} of {of} angles"
            ),
            denied > of / 2,
        ),
    ]
}

fn claims_of_efficiency(points: &[Point]) -> Vec<Claim> {
    let better = [AT_HEITZ, AT_BITTERLI].map(|than| {
        let is_better = |p: &&Point| p.inverse_efficiency(AT_CUI) < p.inverse_efficiency(than);
        points.iter().filter(is_better).count()
    });
    let of = points.len();
    let [over_heitz, over_bitterli] =
        [AT_HEITZ, AT_BITTERLI].map(|than| efficiency_ratio(points, AT_CUI, than));
    let along_normal = points
        .iter()
        .filter(|p| COLUMNS[p.column].0 >= 1.0 && p.theta_o_deg == 0.0)
        .map(|p| p.inverse_efficiency(AT_WANG) / p.inverse_efficiency(AT_CUI))
        .fold(0.0, f64::max);
    vec![
        Claim::measured(
            "Cui is more efficient than Heitz and than Bitterli and d'Eon",
            "in all cases",
            format!(
                "than Heitz at {}, than Bitterli at {} of {of} angles; mean over Heitz \
                 {over_heitz:.2}, over Bitterli {over_bitterli:.2}",
                better[0], better[1]
            ),
            better == [of, of],
        ),
        Claim::measured(
            "Wang is more efficient than Cui at theta_o = 0, alpha = 1",
            "higher performance",
            format!("ratio of variance x time at most {along_normal:.2}"),
            along_normal < 1.0,
        ),
    ]
}

fn claims_of_variance(points: &[Point]) -> Vec<Claim> {
    let ratio = |a: usize, b: usize| mean_ratio(points, None, |p| p.variance_ratio(a, b));
    let (heitz, bitterli) = (ratio(AT_CUI, AT_HEITZ), ratio(AT_CUI, AT_BITTERLI));
    let specula = ratio(AT_SPECULA, AT_CUI);
    vec![
        Claim::law(
            "At equal samples Cui has less variance than Heitz",
            "less noise",
            format!("mean ratio {heitz:.2}"),
            heitz < 1.0,
        ),
        Claim::refuted(
            "At equal samples Cui has the variance of Bitterli and d'Eon",
            "the same",
            format!("mean ratio {bitterli:.2}: less"),
            (bitterli - 1.0).abs() < 0.1,
        ),
        Claim::law(
            "Specula has less variance than Cui at equal samples",
            "no statement",
            format!("mean ratio {specula:.2}"),
            specula < 1.0,
        ),
    ]
}
