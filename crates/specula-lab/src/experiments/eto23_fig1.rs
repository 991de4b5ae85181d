//! Eto and Tokuyoshi 2023, fig. 1: the horizon of reflections in the space of unit roughness, and the
//! caps that bound it.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, TAU};

use specula_bsdf::vndf::Sampler;

use super::stretched_bounds::View;
use crate::output::Table;
use crate::plot::{Axis, Content, Figure, Panel, Series};
use crate::{Claim, Experiment, Lab, Result, Source, Verdict};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    id: "eto23-fig1",
    source: Source::Eto23,
    item: "fig. 1",
    title: "bounds of the spherical cap over the azimuth of the reflection",
    statement: "The bounded cap bounds the projected horizon of reflections more tightly than the cap; \
                where both alphas exceed 1 the published bound is limited to 0.",
    run,
};

/// Two values along x and y.
type Pair = (f64, f64);

/// Panels: name, alphas, x and y of the view.
const CASES: [(&str, Pair, Pair); 4] = [
    ("a", (0.7, 0.4), (0.3, 0.0)),
    ("b", (0.7, 0.8), (0.3, 0.6)),
    ("c", (1.5, 0.2), (-0.2, 0.8)),
    ("d", (1.6, 1.3), (-0.2, 0.3)),
];

fn run(lab: &mut Lab<'_>) -> Result<Verdict> {
    let steps = lab.pick(360, 3600);
    let mut table = Table::new(
        "bounds",
        "Lowest heights of reflections in the space of unit roughness.",
        &[
            "panel",
            "phi [deg]",
            "horizon",
            "cap",
            "bounded, as published",
            "bounded, unclamped",
        ],
    );
    let mut panels = Vec::new();
    let mut found = BoundExtremes::default();
    for (i, (name, alphas, xy)) in CASES.into_iter().enumerate() {
        lab.step(0.25 * i as f64, "projecting horizons")?;
        let view = View::of_xy(alphas, xy);
        let bottoms = Bottoms::of(&view);
        let (mut curve, mut lowest) = (Vec::new(), f64::INFINITY);
        for step in 0..=steps {
            let phi = TAU * f64::from(step) / f64::from(steps);
            let height = view.projected_bound(phi);
            found.compare_definition(&view, phi, height);
            lowest = lowest.min(height);
            curve.push([phi.to_degrees(), height]);
            table.push([
                name.into(),
                phi.to_degrees().into(),
                height.into(),
                bottoms.cap.into(),
                bottoms.published.into(),
                bottoms.unclamped.into(),
            ]);
        }
        found.add(&bottoms, lowest, alphas.0.min(alphas.1) > 1.0);
        panels.push(panel(name, alphas, xy, curve, &bottoms));
    }
    lab.table(table)?;
    let caption = "The horizon of reflections in the space of unit roughness over the azimuth of the \
                   reflection, with the lower ends of the caps.";
    lab.plot("bounds", caption, &Figure::grid(2, panels))?;
    Ok(found.verdict())
}

/// Lower ends of the caps of a view.
struct Bottoms {
    cap: f64,
    published: f64,
    unclamped: f64,
}

impl Bottoms {
    fn of(view: &View) -> Self {
        Self {
            cap: view.cap_bottom(Sampler::Cap),
            published: view.published_bottom(),
            unclamped: view.cap_bottom(Sampler::Bounded),
        }
    }
}

fn panel(
    name: &str,
    (ax, ay): (f64, f64),
    (x, y): (f64, f64),
    curve: Vec<[f64; 2]>,
    bottoms: &Bottoms,
) -> Panel {
    let level = |label: &str, style, height| {
        Series::new(label, style, vec![[0.0, height], [360.0, height]])
    };
    let mut series = vec![
        Series::new("horizon of reflections", 0, curve),
        level("cap", 3, bottoms.cap),
        level("bounded, as published", 2, bottoms.published),
    ];
    if ax.min(ay) > 1.0 {
        series.push(level("bounded, unclamped (Specula)", 6, bottoms.unclamped));
    }
    Panel {
        title: format!("({name}) alpha = ({ax}, {ay}), i = ({x}, {y})"),
        x: Axis::linear("azimuth of the reflection [deg]").from_to(0.0, 360.0),
        y: Axis::linear("height in the unit-roughness space"),
        content: Content::Lines(series),
    }
}

/// Extremes of the bounds, over all panels.
struct BoundExtremes {
    /// Largest difference of eq. 1 from its definition at pi/2 and at the printed 2/pi.
    differences: [f64; 2],
    /// Smallest distance of the horizon above the bounded cap, as published and unclamped.
    above: [f64; 2],
    /// Smallest gain of the bounded cap over the cap.
    gain: f64,
    /// Where both alphas exceed 1: the published bound, Specula's, the horizon's lowest.
    wide: [f64; 3],
}

impl Default for BoundExtremes {
    fn default() -> Self {
        Self {
            differences: [0.0; 2],
            above: [f64::INFINITY; 2],
            gain: f64::INFINITY,
            wide: [0.0; 3],
        }
    }
}

impl BoundExtremes {
    fn compare_definition(&mut self, view: &View, phi: f64, height: f64) {
        for (largest, theta) in self.differences.iter_mut().zip([FRAC_PI_2, FRAC_2_PI]) {
            *largest = largest.max((view.projected_height(theta, phi) - height).abs());
        }
    }

    fn add(&mut self, bottoms: &Bottoms, lowest: f64, is_wide: bool) {
        for (above, bottom) in self
            .above
            .iter_mut()
            .zip([bottoms.published, bottoms.unclamped])
        {
            *above = above.min(lowest - bottom);
        }
        self.gain = self.gain.min(bottoms.published - bottoms.cap);
        if is_wide {
            self.wide = [bottoms.published, bottoms.unclamped, lowest];
        }
    }

    fn verdict(&self) -> Verdict {
        let [at_half_pi, at_two_over_pi] = self.differences;
        let [published, unclamped, lowest] = self.wide;
        Verdict {
            summary: format!(
                "The bounded cap lies between the cap and the horizon in all four panels; in (d) the \
                 published bound is {published:.2} where the horizon's lowest is {lowest:.3}, and that of Specula \
                 without the clamp {unclamped:.3}."
            ),
            claims: vec![
                Claim::law(
                    "Eq. 1 is the horizon of reflections projected into the space of unit roughness",
                    "o^_z(2/pi, phi), a misprint of pi/2",
                    format!(
                        "differs from the definition by {at_half_pi:.0e} at pi/2, by up to \
                         {at_two_over_pi:.2} at 2/pi"
                    ),
                    at_half_pi < 1e-12 && at_two_over_pi > 0.1,
                ),
                Claim::law(
                    "The bounded cap bounds the horizon from below",
                    "bounds it",
                    format!("the horizon is at least {:.1e} above it", self.above[0]),
                    self.above[0] >= -1e-12,
                ),
                Claim::law(
                    "It does so more tightly than the cap",
                    "more tightly",
                    format!("higher by at least {:.3}", self.gain),
                    self.gain > 0.0,
                ),
                Claim::law(
                    "Where both alphas exceed 1 the bound is limited to 0, looser than the infimum",
                    "-k i^_z = 0 (2024, section 3.2.2)",
                    format!("panel (d): bound {published:.3}, infimum {lowest:.3}"),
                    published.abs() < 1e-12 && lowest > 0.05,
                ),
                Claim::law(
                    "Specula's bound without the clamp stays below the horizon and is tighter there",
                    "not in the paper",
                    format!(
                        "at least {:.1e} below it; {unclamped:.3} in (d)",
                        self.above[1]
                    ),
                    self.above[1] >= -1e-12 && unclamped > published,
                ),
            ],
            caveat: "The supplement prints theta = 2/pi for pi/2 in eq. 1.".to_owned(),
        }
    }
}
