//! Tokuyoshi and Eto 2024, fig. 3: the reflections above the surface in the space of unit roughness, and
//! the caps around them.

use std::f64::consts::{PI, TAU};

use specula_bsdf::Vec3;
use specula_bsdf::vndf::Sampler;

use super::stretched_bounds::View;
use crate::output::Table;
use crate::plot::{Axis, Content, Figure, Panel, Series};
use crate::{Claim, Experiment, Lab, Result, Source, Verdict};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    id: "tokuyoshi24-fig3",
    source: Source::Tokuyoshi24,
    item: "fig. 3",
    title: "bounds of reflections in the space of unit roughness",
    statement: "The bounded cap bounds the reflections above the surface more tightly than the cap, so \
                that fewer reflection vectors are occluded by the surface.",
    run,
};

/// Alphas, polar angle and azimuth of the view in degrees.
const CASES: [((f64, f64), f64, f64); 6] = [
    ((0.3, 0.3), 60.0, 0.0),
    ((0.8, 0.8), 30.0, 0.0),
    ((1.0, 1.0), 0.0, 0.0),
    ((0.8, 0.4), 45.0, 40.0),
    ((1.0, 0.2), 60.0, 70.0),
    ((1.5, 1.2), 45.0, 40.0),
];

fn run(lab: &mut Lab<'_>) -> Result<Verdict> {
    let steps = lab.pick(2000, 20_000);
    let mut table = Table::new(
        "solid-angles",
        "Solid angles in the space of unit roughness, in which reflections are uniform.",
        &[
            "alpha_x",
            "alpha_y",
            "theta [deg]",
            "phi [deg]",
            "cap [sr]",
            "bounded as published [sr]",
            "bounded unclamped [sr]",
            "exact, closed form [sr]",
            "exact, from its boundary [sr]",
            "rejected by the cap [%]",
            "rejected by the bounded cap [%]",
        ],
    );
    let mut panels = Vec::new();
    let mut found = BoundaryExtremes::default();
    for (i, (alphas, theta, phi)) in CASES.into_iter().enumerate() {
        lab.step(i as f64 / CASES.len() as f64, "tracing boundaries")?;
        let view = View::of_angles(alphas, theta, phi);
        let boundary = boundary(&view, steps);
        let angles = Angles::of(&view, &boundary);
        found.add(&angles, &boundary, &view, alphas.0 == alphas.1);
        let rejected = |cap: f64| 100.0 * (1.0 - angles.exact / cap);
        table.push([
            alphas.0.into(),
            alphas.1.into(),
            theta.into(),
            phi.into(),
            angles.cap.into(),
            angles.published.into(),
            angles.unclamped.into(),
            angles.exact.into(),
            angles.traced.into(),
            rejected(angles.cap).into(),
            rejected(angles.published).into(),
        ]);
        panels.push(panel(alphas, theta, phi, &view, thinned(&boundary)));
    }
    lab.table(table)?;
    let caption = "The sphere of reflections in the space of unit roughness, unrolled so that areas are \
                   solid angles: above the blue boundary reflections leave the surface, between a \
                   cap's lower end and the boundary they are rejected.";
    lab.plot("bounds", caption, &Figure::grid(3, panels))?;
    Ok(found.verdict())
}

/// The horizon in the space of unit roughness as azimuth in `[-pi, pi)` and height, by azimuth: a
/// function of it in all [`CASES`], though not where alphas are narrow and very unequal.
fn boundary(view: &View, steps: u32) -> Vec<[f64; 2]> {
    let mut points: Vec<[f64; 2]> = (0..steps)
        .map(|step| {
            let phi = TAU * f64::from(step) / f64::from(steps);
            let o = view.stretched_reflection(Vec3 {
                x: phi.cos(),
                y: phi.sin(),
                z: 0.0,
            });
            [o.y.atan2(o.x), o.z]
        })
        .collect();
    points.sort_by(|a, b| a[0].total_cmp(&b[0]));
    // The first again a turn later, and the last a turn before.
    if let (Some(&first), Some(&last)) = (points.first(), points.last()) {
        points.insert(0, [last[0] - TAU, last[1]]);
        points.push([first[0] + TAU, first[1]]);
    }
    points
}

/// Some of the points, enough for an eye, both ends among them.
fn thinned(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let step = points.len().div_ceil(800).max(1);
    let mut some: Vec<[f64; 2]> = points.iter().copied().step_by(step).collect();
    some.extend(points.last());
    some
}

/// Solid angles of a view.
struct Angles {
    cap: f64,
    published: f64,
    unclamped: f64,
    exact: f64,
    /// Of the region above the boundary, by the trapezoidal rule.
    traced: f64,
}

impl Angles {
    fn of(view: &View, boundary: &[[f64; 2]]) -> Self {
        let cap = |bottom: f64| TAU * (1.0 - bottom);
        // Over one turn: all pairs of neighbours but the first.
        let traced = boundary[1..]
            .windows(2)
            .map(|p| (p[1][0] - p[0][0]) * (1.0 - 0.5 * (p[0][1] + p[1][1])))
            .sum();
        Self {
            cap: cap(view.cap_bottom(Sampler::Cap)),
            published: cap(view.published_bottom()),
            unclamped: cap(view.cap_bottom(Sampler::Bounded)),
            exact: view.exact_solid_angle(),
            traced,
        }
    }
}

fn panel(
    (ax, ay): (f64, f64),
    theta: f64,
    phi: f64,
    view: &View,
    boundary: Vec<[f64; 2]>,
) -> Panel {
    let degrees: Vec<[f64; 2]> = boundary
        .into_iter()
        .map(|[azimuth, height]| [azimuth.to_degrees(), height])
        .filter(|p| p[0].abs() <= 180.0)
        .collect();
    let band = degrees.iter().map(|p| [p[1], 1.0]).collect();
    let level = |label: &str, style, height| {
        Series::new(label, style, vec![[-180.0, height], [180.0, height]])
    };
    let mut series = vec![
        Series {
            band: Some(band),
            ..Series::new("reflections above the surface (exact)", 1, degrees)
        },
        level("cap", 3, view.cap_bottom(Sampler::Cap)),
        level("bounded, as published", 2, view.published_bottom()),
    ];
    if ax.min(ay) > 1.0 {
        let bottom = view.cap_bottom(Sampler::Bounded);
        series.push(level("bounded, unclamped (Specula)", 6, bottom));
    }
    Panel {
        title: format!("alpha = ({ax}, {ay}), theta = {theta} deg, phi = {phi} deg"),
        x: Axis::linear("azimuth [deg]").from_to(-180.0, 180.0),
        y: Axis::linear("height").from_to(-1.0, 1.0),
        content: Content::Lines(series),
    }
}

/// Extremes over all views.
#[derive(Default)]
struct BoundaryExtremes {
    /// Largest relative difference of the closed form from the traced boundary.
    difference: f64,
    /// Largest part of the exact region below the published bound, in height.
    below: f64,
    /// Largest distance of the lowest of an isotropic boundary from the bound, alpha at most 1.
    loose: f64,
    /// Sums of cap, bounded, exact.
    sums: [f64; 3],
    /// Number of views in which bounded is not smaller than cap.
    not_smaller: u32,
}

impl BoundaryExtremes {
    fn add(&mut self, angles: &Angles, boundary: &[[f64; 2]], view: &View, is_isotropic: bool) {
        let lowest = boundary.iter().map(|p| p[1]).fold(f64::INFINITY, f64::min);
        let bottom = view.published_bottom();
        self.difference = self
            .difference
            .max((angles.traced / angles.exact - 1.0).abs());
        self.below = self.below.max(bottom - lowest);
        if is_isotropic {
            self.loose = self.loose.max((lowest - bottom).abs());
        }
        for (sum, angle) in self
            .sums
            .iter_mut()
            .zip([angles.cap, angles.published, angles.exact])
        {
            *sum += angle / (4.0 * PI);
        }
        self.not_smaller += u32::from(angles.published >= angles.cap);
    }

    fn verdict(&self) -> Verdict {
        let [cap, bounded, exact] = self.sums;
        let rejected = |sum: f64| 100.0 * (1.0 - exact / sum);
        Verdict {
            summary: format!(
                "Over six views the reflections above the surface fill {:.0} % of the cap and {:.0} % \
                 of the bounded cap.",
                100.0 - rejected(cap),
                100.0 - rejected(bounded)
            ),
            claims: vec![
                Claim::law(
                    "The bounded cap holds all reflections above the surface",
                    "bounds them",
                    format!("none is more than {:.0e} below it", self.below.max(0.0)),
                    self.below < 1e-9,
                ),
                Claim::law(
                    "It is smaller than the cap, so fewer reflections are occluded",
                    "more tightly",
                    format!(
                        "rejected of the cap {:.1} %, of the bounded cap {:.1} %",
                        rejected(cap),
                        rejected(bounded)
                    ),
                    self.not_smaller == 0,
                ),
                Claim::law(
                    "For equal alphas up to 1 its lower end is the infimum",
                    "the infimum (eq. 6)",
                    format!("within {:.0e}", self.loose),
                    self.loose < 1e-4,
                ),
                Claim::law(
                    "The exact region's solid angle is 4 pi N / |(ax ix, ay iy, iz)| in closed form",
                    "not in the paper",
                    format!("within {:.0e} of the traced boundary", self.difference),
                    self.difference < 1e-3,
                ),
            ],
            caveat: "The paper does not give the alphas and views of its figure.".to_owned(),
        }
    }
}
