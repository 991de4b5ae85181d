//! Densities of multiple importance sampling against the lobe that they approximate: shared by fig. 8 of
//! Cui et al. 2023 and fig. 1 of its supplement.
//!
//! The lobe is `f cos` of a metal that reflects all light: it integrates to 1, and directions that
//! are sampled follow it exactly.

use std::f64::consts::PI;

use rayon::prelude::*;
use specula_bsdf::bsdf::MultibounceConductor;
use specula_bsdf::fresnel::Reflectance;
use specula_bsdf::internal::{normalised_pdf, sample_normalised};
use specula_bsdf::math::{Stream, vec3, warp};
use specula_bsdf::multibounce::{MisPdf, MultibounceModel};
use specula_bsdf::ndf::Ggx;
use specula_bsdf::{Alpha, Bsdf as _, Rgb, Vec3};

use crate::output::Table;
use crate::plot::{Axis, Content, Figure, Panel, Series};
use crate::{Lab, Result};

/// The densities in the order of [`MisPdf::ALL`], with their styles.
pub(super) const NAMES: [(&str, usize); 3] = [
    ("single bounce + Lambert", 3),
    ("single bounce + Hapke (Cui 2023)", 2),
    ("normalised (Specula)", 1),
];
pub(super) const LAMBERT: usize = 0;
pub(super) const HAPKE: usize = 1;
pub(super) const NORMALISED: usize = 2;

/// Panels in a row: alphas of one angle.
const COLUMNS: usize = 4;
/// Estimates of each distance, for its standard error.
const REPLICATES: usize = 8;

/// A metal and a view.
#[derive(Clone, Copy, Debug)]
pub(super) struct Case {
    /// Alphas along and across the plane of incidence.
    pub(super) alpha: [f64; 2],
    /// Of the view.
    pub(super) theta_deg: f64,
}

impl Case {
    /// Whether both alphas are the same.
    pub(super) fn is_isotropic(self) -> bool {
        self.alpha[0] == self.alpha[1]
    }

    fn ndf(self) -> Ggx<f64> {
        Ggx::new(Alpha::clamped(self.alpha[0], self.alpha[1]))
    }

    fn lobe(self, mis: MisPdf) -> MultibounceConductor<f64> {
        let white = Reflectance::Constant(Rgb::splat(1.0));
        MultibounceConductor::new(self.ndf(), white, MultibounceModel::StratifiedBidirectional)
            .with_mis_pdf(mis)
    }

    fn wo(self) -> Vec3<f64> {
        let (sin, cos) = self.theta_deg.to_radians().sin_cos();
        vec3(-sin, 0.0, cos)
    }

    /// Mean of so many estimates of `f cos`.
    fn truth(self, wi: Vec3<f64>, evaluations: u32, stream: &mut Stream) -> f64 {
        let lobe = self.lobe(MisPdf::Normalised);
        let wo = self.wo();
        let sum: f64 = (0..evaluations)
            .map(|_| lobe.estimate(wo, wi, stream).g)
            .sum();
        sum / f64::from(evaluations)
    }

    fn densities(self, wi: Vec3<f64>) -> [f64; 3] {
        MisPdf::ALL.map(|mis| self.lobe(mis).pdf(self.wo(), wi))
    }
}

/// A number with its standard error.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Estimate {
    /// Mean of the replicates.
    pub(super) value: f64,
    /// Standard error.
    pub(super) error: f64,
}

impl Estimate {
    fn of(replicates: &[f64]) -> Self {
        let n = replicates.len() as f64;
        let value = replicates.iter().sum::<f64>() / n;
        let squares: f64 = replicates.iter().map(|x| (x - value).powi(2)).sum();
        Self {
            value,
            error: (squares / (n * (n - 1.0))).sqrt(),
        }
    }

    /// Whether it is below the other by more than four standard errors of the difference.
    pub(super) fn is_below(self, other: Self) -> bool {
        other.value - self.value > 4.0 * self.error.hypot(other.error)
    }
}

/// Distances of a density from the lobe.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Distance {
    /// Of the density over the hemisphere.
    pub(super) integral: Estimate,
    /// Of `|pdf - f cos|`.
    pub(super) absolute: Estimate,
    /// Of `|pdf / integral - f cos|`.
    pub(super) of_shape: Estimate,
    /// Kullback-Leibler: of `f cos ln(f cos integral / pdf)`.
    pub(super) divergence: Estimate,
}

/// A case with its densities' distances.
pub(super) struct Judged {
    /// The case.
    pub(super) case: Case,
    /// In the order of [`NAMES`].
    pub(super) distances: [Distance; 3],
}

/// One direction: `(1 / density it was sampled with, f cos, densities)`.
type DirectionSample = (f64, f64, [f64; 3]);

/// Judges every case, writes table and plot.
///
/// * `is_plotted`: four of each angle.
pub(super) fn judge(
    lab: &mut Lab<'_>,
    cases: &[Case],
    is_plotted: impl Fn(&Case) -> bool,
    caption: &str,
) -> Result<Vec<Judged>> {
    let mut judged = Vec::new();
    let mut panels = Vec::new();
    for (i, case) in cases.iter().enumerate() {
        lab.step(i as f64 / cases.len() as f64, "integrating lobes")?;
        judged.push(distances(lab, *case));
        if is_plotted(case) {
            panels.push(panel(lab, *case));
        }
    }
    lab.table(table(&judged))?;
    lab.plot("densities", caption, &Figure::grid(COLUMNS, panels))?;
    Ok(judged)
}

fn distances(lab: &Lab<'_>, case: Case) -> Judged {
    let points: u32 = lab.pick(200, 1500);
    let evaluations = lab.pick(60, 400);
    let replicates: Vec<Vec<DirectionSample>> = (0..REPLICATES)
        .into_par_iter()
        .map(|r| {
            let mut stream = Stream::new(lab.seed().wrapping_mul(1013) + r as u64);
            let shift = [stream.next(), stream.next(), stream.next()];
            let sample = |i| {
                sample_direction(
                    case,
                    evaluations,
                    lattice(shift, i / 2),
                    i % 2 == 0,
                    &mut stream,
                )
            };
            (0..2 * points).map(sample).collect()
        })
        .collect();
    let over = |term: &dyn Fn(&DirectionSample) -> f64| {
        let means = replicates.iter().map(|sampled| {
            let sum: f64 = sampled.iter().map(|d| d.0 * term(d)).sum();
            sum / sampled.len() as f64
        });
        Estimate::of(&means.collect::<Vec<f64>>())
    };
    let distances = [LAMBERT, HAPKE, NORMALISED].map(|k| {
        let integral = over(&|d| d.2[k]);
        let scale = 1.0 / integral.value;
        Distance {
            integral,
            absolute: over(&|d| (d.2[k] - d.1).abs()),
            of_shape: over(&|d| (scale * d.2[k] - d.1).abs()),
            divergence: over(&|d| d.1 * (d.1 / (scale * d.2[k])).ln()),
        }
    });
    Judged { case, distances }
}

/// The i-th point of a shifted lattice in the unit cube: powers of the inverse of the root of
/// `x^4 = x + 1`.
fn lattice(shift: [f64; 3], i: u32) -> [f64; 3] {
    const STEPS: [f64; 3] = [
        0.819_172_513_396_164_5,
        0.671_043_606_703_789_3,
        0.549_700_477_901_970_3,
    ];
    [0, 1, 2].map(|k| (shift[k] + STEPS[k] * f64::from(i)).fract())
}

/// A direction, by Specula's density or by a cosine in turns.
fn sample_direction(
    case: Case,
    evaluations: u32,
    u: [f64; 3],
    by_cosine: bool,
    stream: &mut Stream,
) -> DirectionSample {
    let (ndf, wo) = (case.ndf(), case.wo());
    let sampled = if by_cosine {
        Some(warp::cosine_hemisphere([u[0], u[1]]))
    } else {
        sample_normalised(&ndf, wo, u)
    };
    let Some(wi) = sampled.filter(|wi| wi.z > 0.0) else {
        return (0.0, 1.0, [1.0; 3]);
    };
    let density = 0.5 * normalised_pdf(&ndf, wo, wi) + 0.5 * wi.z / PI;
    let truth = case.truth(wi, evaluations, stream);
    (1.0 / density, truth.max(1e-30), case.densities(wi))
}

/// The plane of incidence.
fn panel(lab: &Lab<'_>, case: Case) -> Panel {
    let evaluations = lab.pick(400, 20_000);
    let angles: Vec<i32> = (-89..90).collect();
    let values: Vec<[f64; 5]> = angles
        .into_par_iter()
        .map(|degrees| {
            let theta = f64::from(degrees);
            let (sin, cos) = theta.to_radians().sin_cos();
            let wi = vec3(sin, 0.0, cos);
            let mut stream = Stream::new(lab.seed() ^ u64::from(degrees.unsigned_abs()) << 32);
            let truth = case.truth(wi, evaluations, &mut stream);
            let [a, b, c] = case.densities(wi);
            [theta, truth, a, b, c]
        })
        .collect();
    let line = |i: usize| values.iter().map(|v| [v[0], v[i]]).collect();
    let mut series = vec![Series::new("f cos, mean of evaluations", 0, line(1))];
    for (i, (name, style)) in NAMES.into_iter().enumerate() {
        series.push(Series::new(name, style, line(i + 2)));
    }
    let [x, y] = case.alpha;
    let alpha = if case.is_isotropic() {
        format!("{x}")
    } else {
        format!("({x}, {y})")
    };
    let highest = values
        .iter()
        .flat_map(|v| &v[1..])
        .fold(0.0_f64, |a, b| a.max(*b));
    let lowest = values.iter().fold(highest, |a, v| a.min(v[1]));
    Panel {
        title: format!("alpha = {alpha}, theta_i = {} deg", case.theta_deg),
        x: Axis::linear("theta_o [deg]").from_to(-90.0, 90.0),
        y: Axis::logarithmic("f cos, pdf [1/sr]").from_to(0.5 * lowest, 2.0 * highest),
        content: Content::Lines(series),
    }
}

fn table(judged: &[Judged]) -> Table {
    let mut table = Table::new(
        "distances",
        "Integrals over the hemisphere: of each density, of its difference from f cos (F = 1), of \
         that after scaling it to integrate to 1, and the Kullback-Leibler divergence then.",
        &[
            "alpha_x",
            "alpha_y",
            "theta_i [deg]",
            "density",
            "integral",
            "|pdf - f cos|",
            "standard error",
            "|scaled pdf - f cos|",
            "standard error of that",
            "divergence",
            "standard error of divergence",
        ],
    );
    for Judged { case, distances } in judged {
        for (distance, (name, _)) in distances.iter().zip(NAMES) {
            table.push([
                case.alpha[0].into(),
                case.alpha[1].into(),
                case.theta_deg.into(),
                name.into(),
                distance.integral.value.into(),
                distance.absolute.value.into(),
                distance.absolute.error.into(),
                distance.of_shape.value.into(),
                distance.of_shape.error.into(),
                distance.divergence.value.into(),
                distance.divergence.error.into(),
            ]);
        }
    }
    table
}

/// Lowest and highest value of `of` for the density `k`.
pub(super) fn range(judged: &[Judged], k: usize, of: impl Fn(&Distance) -> Estimate) -> [f64; 2] {
    let values = judged.iter().map(|j| of(&j.distances[k]).value);
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| {
        [low.min(v), high.max(v)]
    })
}

/// Mean over the cases of `of`, for each density.
pub(super) fn means(judged: &[Judged], of: impl Fn(&Distance) -> Estimate) -> [f64; 3] {
    [LAMBERT, HAPKE, NORMALISED].map(|k| {
        let sum: f64 = judged.iter().map(|j| of(&j.distances[k]).value).sum();
        sum / judged.len().max(1) as f64
    })
}
