//! Tokuyoshi and Eto 2024, fig. 5: lobes and densities over the angle of reflection, seen along the
//! normal.

use std::f64::consts::{FRAC_PI_2, PI};

use specula_bsdf::bsdf::{Compensated, RoughConductor};
use specula_bsdf::energy::{EnergyModel, FmsVariant};
use specula_bsdf::fresnel::Reflectance;
use specula_bsdf::ndf::Ggx;
use specula_bsdf::vndf::{Reflections, Sampler};
use specula_bsdf::{Alpha, Bsdf, Rgb, Transport, Vec3};

use crate::output::Table;
use crate::plot::{Axis, Content, Figure, Panel, Series};
use crate::{Claim, Experiment, Lab, Result, Source, Verdict};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    id: "tokuyoshi24-fig5",
    source: Source::Tokuyoshi24,
    item: "fig. 5",
    title: "lobes and densities over the angle of reflection",
    statement: "Seen along the normal, the density of spherical caps is at least the single-scattering \
                lobe but can be below the energy-compensated lobes; the bounded density is above it \
                everywhere in the upper hemisphere, and closer to the compensated lobes.",
    run,
};

/// Alphas, a panel each.
const ALPHAS: [f64; 3] = [0.4, 0.7, 1.0];

/// Values at one angle, in the order of [`NAMES`].
type Values = [f64; 6];

const NAMES: [(&str, usize); 6] = [
    ("single scattering f cos", 4),
    ("Turquin f cos", 0),
    ("Kulla-Conty f cos", 5),
    ("cap pdf", 3),
    ("bounded pdf", 2),
    ("exact pdf", 1),
];

fn run(lab: &mut Lab<'_>) -> Result<Verdict> {
    let steps = lab.pick(90, 360);
    let mut table = Table::new(
        "lobes",
        "Values along a meridian seen along the normal, F = 1.",
        &[
            "alpha",
            "theta_i [deg]",
            "single scattering [1/sr]",
            "Turquin [1/sr]",
            "Kulla-Conty [1/sr]",
            "cap pdf [1/sr]",
            "bounded pdf [1/sr]",
            "exact pdf [1/sr]",
        ],
    );
    let mut panels = Vec::new();
    let mut found = DensityExtremes::default();
    for alpha in ALPHAS {
        lab.step(0.3 * alpha, "evaluating lobes")?;
        let mut lines: [Vec<[f64; 2]>; 6] = Default::default();
        for i in 0..=2 * steps {
            let theta = FRAC_PI_2 * (f64::from(i) / f64::from(steps) - 1.0);
            let values = values(alpha, theta);
            found.add(&values);
            for (line, value) in lines.iter_mut().zip(values) {
                line.push([theta * 180.0 / PI, value]);
            }
            let [single, turquin, kulla_conty, cap, bounded, exact] = values.map(Into::into);
            let angle = (theta * 180.0 / PI).into();
            table.push([
                alpha.into(),
                angle,
                single,
                turquin,
                kulla_conty,
                cap,
                bounded,
                exact,
            ]);
        }
        let series = (lines.into_iter().zip(NAMES))
            .map(|(points, (name, style))| Series::new(name, style, points))
            .collect();
        panels.push(Panel {
            title: format!("alpha = {alpha}"),
            x: Axis::linear("theta_i [deg]").from_to(-90.0, 90.0),
            y: Axis::linear("f cos theta, pdf [1/sr]"),
            content: Content::Lines(series),
        });
    }
    lab.table(table)?;
    let caption = "Lobes and densities of reflections seen along the normal, F = 1.";
    lab.plot("lobes", caption, &Figure::grid(3, panels))?;
    Ok(found.verdict())
}

fn values(alpha: f64, theta: f64) -> Values {
    let wo = Vec3 {
        x: 0.0,
        y: 0.0,
        z: 1.0,
    };
    let wi = Vec3 {
        x: theta.sin(),
        y: 0.0,
        z: theta.cos(),
    };
    let alpha = Alpha::isotropic(alpha);
    let ggx = Ggx::new(alpha);
    let white = Reflectance::Constant(Rgb::splat(1.0));
    let f_cos = |f: Rgb<f64>| f.r;
    let pdf = |sampler| Reflections::new(alpha, wo, sampler).pdf(wi);
    let compensated =
        |model| f_cos(Compensated::new(ggx, white, model).eval(wo, wi, Transport::Radiance));
    [
        f_cos(RoughConductor::new(ggx, white).eval(wo, wi, Transport::Radiance)),
        compensated(EnergyModel::Turquin(FmsVariant::NormalIncidence)),
        compensated(EnergyModel::KullaConty),
        pdf(Sampler::Cap),
        pdf(Sampler::Bounded),
        pdf(Sampler::Exact),
    ]
}

/// Extremes over all alphas and angles.
#[derive(Default)]
struct DensityExtremes {
    /// Largest excess of the single-scattering lobe over the cap's density, relative.
    over_cap: f64,
    /// Largest quotient of Turquin's lobe and each density: cap, bounded, exact.
    weights: [f64; 3],
    /// Directions in which the bounded density is below the cap's.
    below: u32,
    /// Sum of distances from Turquin's lobe: cap, bounded, exact.
    distances: [f64; 3],
}

impl DensityExtremes {
    fn add(&mut self, values: &Values) {
        let [single, turquin, _, cap, bounded, exact] = *values;
        if cap <= 0.0 {
            return;
        }
        self.over_cap = self.over_cap.max(single / cap - 1.0);
        self.below += u32::from(bounded < cap * (1.0 - 1e-12));
        for (i, density) in [cap, bounded, exact].into_iter().enumerate() {
            self.weights[i] = self.weights[i].max(turquin / density);
            self.distances[i] += (density - turquin).abs();
        }
    }

    /// By how much the lobe is above the cap's density.
    fn excess(&self) -> String {
        if self.over_cap > 0.0 {
            format!(
                "the lobe is above it by {:.1e} of it at most",
                self.over_cap
            )
        } else {
            "the lobe does not exceed it".to_owned()
        }
    }

    fn verdict(&self) -> Verdict {
        let [cap, bounded, exact] = self.weights;
        let [far, nearer, nearest] = self.distances.map(|d| d / self.distances[0]);
        Verdict {
            summary: format!(
                "Largest weight under Turquin's compensation: cap {cap:.2}, bounded {bounded:.2}, \
                 exact {exact:.2}."
            ),
            claims: vec![
                Claim::law(
                    "The cap's density is at least the single-scattering lobe",
                    "equal or higher",
                    self.excess(),
                    self.over_cap < 1e-12,
                ),
                Claim::law(
                    "The cap's density can be below the energy-compensated lobe",
                    "weights above 1",
                    format!("largest weight {cap:.3}"),
                    cap > 1.0,
                ),
                Claim::law(
                    "The bounded density is above the cap's in the upper hemisphere",
                    "everywhere",
                    format!("below it in {} directions", self.below),
                    self.below == 0,
                ),
                Claim::law(
                    "It is closer to the compensated lobe",
                    "closer",
                    format!("mean distance, cap {far:.2}: bounded {nearer:.2}, exact {nearest:.2}"),
                    nearer < far,
                ),
            ],
            caveat: String::new(),
        }
    }
}
