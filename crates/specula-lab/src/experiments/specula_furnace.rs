//! Specula: directional albedo of every treatment of multiple scattering, over alphas and views.

use std::sync::atomic::Ordering;

use rayon::prelude::*;
use specula_bsdf::bsdf::MultibounceConductor as Walked;
use specula_bsdf::bsdf::{Compensated, RoughConductor};
use specula_bsdf::energy::{self, FmsVariant};
use specula_bsdf::fresnel::{Conductor, Reflectance};
use specula_bsdf::internal::{normalised_pdf, sample_normalised};
use specula_bsdf::math::Stream;
use specula_bsdf::multibounce;
use specula_bsdf::ndf::Ggx;
use specula_bsdf::{Alpha, Bsdf, Rgb, Transport, metals};

use super::view_grid::{self, Axes, view};
use crate::output::Table;
use crate::plot::Figure;
use crate::{Claim, Experiment, Lab, LabError, Result, Source, Verdict};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    id: "specula-furnace",
    source: Source::Specula,
    item: "furnace maps",
    title: "directional albedo of every treatment of multiple scattering",
    statement: "A white rough metal reflects all light; single scattering loses up to 69 % of it, every \
                compensation restores it, and simulated bounces lose none.",
    run,
};

/// Treatments of multiple scattering.
#[derive(Clone, Copy)]
enum Treatment {
    None,
    Compensated(energy::EnergyModel),
    /// By the model's own samples.
    Walked(multibounce::MultibounceModel),
    /// By the model's values at directions of a normalised density, where samples follow another law than
    /// values do.
    Evaluated(multibounce::MultibounceModel),
}

const TREATMENTS: [(&str, Treatment); 6] = [
    ("none", Treatment::None),
    (
        "turquin",
        Treatment::Compensated(energy::EnergyModel::Turquin(FmsVariant::NormalIncidence)),
    ),
    (
        "turquin-series",
        Treatment::Compensated(energy::EnergyModel::Turquin(FmsVariant::AverageSeries)),
    ),
    (
        "kulla-conty",
        Treatment::Compensated(energy::EnergyModel::KullaConty),
    ),
    (
        "multibounce=wang",
        Treatment::Evaluated(multibounce::MultibounceModel::Wang2022 { correlated: true }),
    ),
    (
        "multibounce=specula",
        Treatment::Walked(multibounce::MultibounceModel::StratifiedBidirectional),
    ),
];
/// Places in [`TREATMENTS`].
const NONE: usize = 0;
const WANG: usize = 4;
const SPECULA: usize = 5;

/// Directional albedos of a cell in the order of [`TREATMENTS`].
type Albedos = [Rgb<f64>; 6];
type Cells = Vec<Vec<Albedos>>;

fn run(lab: &mut Lab<'_>) -> Result<Verdict> {
    let side = lab.pick(16, 40);
    let samples = lab.pick(1024, 8192);
    let gold =
        metals::by_symbol("Au").ok_or_else(|| LabError::Output("no measured gold".to_owned()))?;
    let gold = Reflectance::Conductor(Conductor {
        eta: gold.eta.into(),
        k: gold.k.into(),
    });
    lab.step(0.0, "white metal")?;
    let white = cells(lab, Reflectance::Constant(Rgb::splat(1.0)), side, samples)?;
    lab.step(0.5, "gold")?;
    let gold = cells(lab, gold, side, samples)?;
    write(lab, "white", "F = 1", &white, |c| c.g)?;
    write(lab, "gold", "gold, mean over RGB", &gold, |c| {
        (c.r + c.g + c.b) / 3.0
    })?;
    table(lab, &white, &gold)?;
    let at = Alpha::isotropic(1.0);
    let loss = albedo(
        Treatment::None,
        Reflectance::Constant(Rgb::splat(1.0)),
        at,
        0.0,
        lab.pick(1 << 16, 1 << 20),
        lab.seed(),
    );
    Ok(verdict(&white, &gold, loss.g))
}

/// Every treatment over alphas and views, row by row.
fn cells(lab: &Lab<'_>, reflectance: Reflectance<f64>, side: u32, samples: u32) -> Result<Cells> {
    let (seed, stop) = (lab.seed(), lab.stop());
    view_grid::middles(side, 90.0)
        .into_par_iter()
        .map(|theta| {
            if stop.load(Ordering::Relaxed) {
                return Err(LabError::Stopped);
            }
            let row = view_grid::middles(side, 1.0).into_iter();
            Ok(row
                .map(|a| {
                    TREATMENTS.map(|(_, treatment)| {
                        let alpha = Alpha::isotropic(a);
                        albedo(treatment, reflectance, alpha, theta, samples, seed)
                    })
                })
                .collect())
        })
        .collect()
}

/// Point `i` of the three-dimensional R3 sequence.
fn r3(i: u32) -> [f64; 3] {
    let steps = [
        0.819_172_513_396_164_4,
        0.671_043_606_703_789_2,
        0.549_700_477_901_970_6,
    ];
    steps.map(|step| (0.5 + f64::from(i) * step).fract())
}

/// Mean weight of so many samples.
fn albedo(
    treatment: Treatment,
    reflectance: Reflectance<f64>,
    alpha: Alpha<f64>,
    theta_deg: f64,
    samples: u32,
    seed: u64,
) -> Rgb<f64> {
    let (ggx, wo) = (Ggx::new(alpha), view(theta_deg, 0.0));
    let mut stream = Stream::new(seed);
    let mut sum = Rgb::BLACK;
    for i in 0..samples {
        let [first, u, v] = r3(i);
        let sampled = match treatment {
            Treatment::None => RoughConductor::new(ggx, reflectance)
                .sample(wo, [first, u, v], Transport::Radiance)
                .map(|s| s.weight),
            Treatment::Compensated(model) => Compensated::new(ggx, reflectance, model)
                .sample(wo, [first, u, v], Transport::Radiance)
                .map(|s| s.weight),
            Treatment::Walked(model) => Walked::new(ggx, reflectance, model)
                .sample_walk(wo, [u, v], &mut stream)
                .map(|(_, weight)| weight),
            Treatment::Evaluated(model) => sample_normalised(&ggx, wo, [first, u, v]).map(|wi| {
                let metal = Walked::new(ggx, reflectance, model);
                let f_cos = metal.estimate(wo, wi, &mut stream);
                f_cos * (1.0 / normalised_pdf(&ggx, wo, wi))
            }),
        };
        if let Some(weight) = sampled {
            sum += weight;
        }
    }
    sum * (1.0 / f64::from(samples))
}

fn write(
    lab: &mut Lab<'_>,
    name: &str,
    title: &str,
    cells: &Cells,
    pick: fn(&Rgb<f64>) -> f64,
) -> Result<()> {
    let panels = (TREATMENTS.iter().enumerate())
        .map(|(i, (treatment, _))| {
            let title = format!("{treatment}, {title}");
            let label = ("albedo", [0.3, 1.1]);
            view_grid::panel(&title, Axes::Angles, label, cells, |c: &Albedos| {
                pick(&c[i])
            })
        })
        .collect();
    let caption = format!("Directional albedo over alphas and views, {title}.");
    lab.plot(name, &caption, &Figure::grid(3, panels))
}

fn table(lab: &mut Lab<'_>, white: &Cells, gold: &Cells) -> Result<()> {
    let mut table = Table::new(
        "albedos",
        "Directional albedo; of gold red, green and blue.",
        &[
            "treatment",
            "alpha",
            "theta_o [deg]",
            "F = 1",
            "gold, red",
            "gold, green",
            "gold, blue",
        ],
    );
    let side = u32::try_from(white.len()).unwrap_or(0);
    let (alphas, thetas) = (
        view_grid::middles(side, 1.0),
        view_grid::middles(side, 90.0),
    );
    for (i, (name, _)) in TREATMENTS.iter().enumerate() {
        for ((white, gold), theta) in white.iter().zip(gold).zip(&thetas) {
            for ((white, gold), alpha) in white.iter().zip(gold).zip(&alphas) {
                let (white, gold) = (white[i], gold[i]);
                table.push([
                    (*name).into(),
                    (*alpha).into(),
                    (*theta).into(),
                    white.g.into(),
                    gold.r.into(),
                    gold.g.into(),
                    gold.b.into(),
                ]);
            }
        }
    }
    lab.table(table)
}

/// Largest distance of a treatment's albedo from `truth`, over cells and channels.
fn farthest(cells: &Cells, treatment: usize, truth: impl Fn(&Albedos) -> Rgb<f64>) -> f64 {
    let distances = cells.iter().flatten().map(|c| {
        let d = c[treatment] - truth(c);
        d.map(f64::abs).max_channel()
    });
    distances.fold(0.0, f64::max)
}

/// Root mean square over cells and channels of a treatment's distance from simulated bounces.
fn typical(cells: &Cells, treatment: usize) -> f64 {
    let squares = cells.iter().flatten().map(|c| {
        let d = (c[treatment] - c[SPECULA]).map(|d| d * d);
        (d.r + d.g + d.b) / 3.0
    });
    let count = cells.iter().flatten().count().max(1);
    (squares.sum::<f64>() / count as f64).sqrt()
}

fn verdict(white: &Cells, gold: &Cells, loss: f64) -> Verdict {
    let from_one = |i: usize| farthest(white, i, |_| Rgb::splat(1.0));
    let from_specula = |i: usize| farthest(gold, i, |c| c[SPECULA]);
    let compensated = [1, 2, 3].map(from_one);
    let worst = compensated.into_iter().fold(0.0, f64::max);
    let expected = 1.0 - f64::ln(2.0);
    let list = |of: &dyn Fn(usize) -> f64, places: &[usize]| {
        let parts = places
            .iter()
            .map(|&i| format!("{} {:.3}", TREATMENTS[i].0, of(i)));
        parts.collect::<Vec<_>>().join(", ")
    };
    Verdict {
        summary: format!(
            "White metal, largest distance of the albedo from 1: {}; gold, root mean \
             square distance from simulated bounces: {}.",
            list(&from_one, &[0, 1, 2, 3, 4, 5]),
            list(&|i| typical(gold, i), &[0, 1, 2, 3, 4])
        ),
        claims: vec![
            Claim::law(
                "Single scattering at alpha 1 seen along the normal reflects 1 - ln 2",
                "0.306853",
                format!("{loss:.5}"),
                (loss - expected).abs() < 1e-3,
            ),
            Claim::law(
                "Every compensation reflects all light of a white metal",
                "1 (their purpose)",
                format!("{} away at most", list(&from_one, &[1, 2, 3])),
                worst < 0.03,
            ),
            Claim::law(
                "Simulated bounces by Specula lose nothing of a white metal",
                "weight 1, every walk",
                format!("{:.0e} away at most", from_one(SPECULA)),
                from_one(SPECULA) < 1e-6,
            ),
            Claim::measured(
                "Where Wang's lobe departs from simulated bounces, its albedo hardly does",
                "-30 to +10 % of the lobe, by design",
                format!("white metal {:.3} away from 1 at most", from_one(WANG)),
                from_one(WANG) < 0.06,
            ),
            Claim::law(
                "Of gold, every compensation is nearer to simulated bounces than single scattering is",
                "their purpose",
                list(&from_specula, &[NONE, 1, 2, 3]),
                [1, 2, 3].into_iter().all(|i| from_specula(i) < 0.6 * from_specula(NONE)),
            ),
        ],
        caveat: "Means of samples: the maps carry their noise, largest for Kulla and Conty's and the walks."
            .to_owned(),
    }
}
