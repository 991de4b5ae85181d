//! Tokuyoshi and Eto 2024, fig. 10: orbs of growing roughness with energy compensation, sampled by the
//! cap, the bounded cap and the exact sampler.

use specula_bsdf::energy::{EnergyModel, FmsVariant};
use specula_render::picture::Picture;
use specula_scene::{Energy, Scene};

use super::orb_render::{
    EXPOSURE_STOPS, SAMPLERS, by_sampler, errors_by_orb, mean_and_error, own_error, reference,
};
use super::tokuyoshi24_fig4::{ALPHAS, insets};
use crate::output::comparison::file_name;
use crate::output::{PictureComparison, Shot, Table};
use crate::plot::{Axis, Content, Figure, Panel, Series};
use crate::scenes::orbs::{self, Tessellation};
use crate::{Claim, Experiment, Lab, Result, Source, Verdict};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    id: "tokuyoshi24-fig10",
    source: Source::Tokuyoshi24,
    item: "fig. 10",
    title: "fireflies of energy compensation by sampler",
    statement: "The bounded cap significantly reduces the cap's firefly noise with Kulla and Conty's and \
                with Turquin's compensation, and suits Turquin's better.",
    run,
};

const MODELS: [(&str, EnergyModel); 2] = [
    ("Kulla-Conty", EnergyModel::KullaConty),
    ("Turquin", EnergyModel::Turquin(FmsVariant::NormalIncidence)),
];
const CAP: usize = 0;
const BOUNDED: usize = 1;
const EXACT: usize = 2;

/// Errors of a sampler, by orb and render.
#[derive(Default)]
struct SamplerErrors {
    /// Mean squared errors.
    squares: [Vec<f64>; ALPHAS.len()],
    /// Fireflies per million pixels.
    fireflies: [Vec<f64>; ALPHAS.len()],
}

impl SamplerErrors {
    fn rmse(&self, orb: usize) -> f64 {
        mean_and_error(&self.squares[orb]).0.sqrt()
    }

    /// Per million pixels over the two roughest orbs, where most are: mean and standard error.
    fn rough_fireflies(&self) -> (f64, f64) {
        let [.., a, b] = &self.fireflies;
        let both: Vec<f64> = a.iter().zip(b).map(|(a, b)| 0.5 * (a + b)).collect();
        mean_and_error(&both)
    }
}

fn run(lab: &mut Lab<'_>) -> Result<Verdict> {
    let side = lab.pick(56, 128);
    let (spp, reference_spp) = lab.pick((4, 40), (48, 320));
    let renders = lab.pick(4, 2);
    let alphas = ALPHAS.map(|a| (a, a));
    let scene = orbs::row(&alphas, Tessellation::FINE, side);
    let mut table = Table::new(
        "orbs",
        "Errors of each orb.",
        &[
            "compensation",
            "sampler",
            "alpha",
            "RMSE",
            "fireflies [1/million pixels]",
            "samples per pixel",
            "RMSE of the whole reference, estimated",
        ],
    );
    let mut found = Vec::new();
    for (i, (name, model)) in MODELS.into_iter().enumerate() {
        let energy = Energy::Compensated(model);
        lab.step(0.5 * i as f64, &format!("reference, {name}"))?;
        let truth = reference(lab, &scene, energy, reference_spp)?;
        let of_model = measure(lab, &scene, (name, energy), &truth, (spp, renders))?;
        for (of, (_, sampler, _)) in of_model.iter().zip(SAMPLERS) {
            for (orb, alpha) in ALPHAS.into_iter().enumerate() {
                table.push([
                    name.into(),
                    sampler.into(),
                    alpha.into(),
                    of.rmse(orb).into(),
                    mean_and_error(&of.fireflies[orb]).0.into(),
                    spp.into(),
                    own_error(&truth).into(),
                ]);
            }
        }
        found.push(of_model);
    }
    lab.table(table)?;
    plot(lab, &found)?;
    Ok(verdict(&found, spp))
}

/// Renders by every sampler, some of each; writes the first of each beside each other.
fn measure(
    lab: &mut Lab<'_>,
    scene: &Scene,
    (name, energy): (&str, Energy),
    truth: &Picture,
    (spp, renders): (u32, u32),
) -> Result<Vec<SamplerErrors>> {
    let mut found = Vec::new();
    let mut first = Vec::new();
    for (sampler, sampler_name, _) in SAMPLERS {
        let mut of = SamplerErrors::default();
        for number in 0..renders {
            lab.step(0.5, &format!("{sampler_name}, {name}"))?;
            let shot = by_sampler(lab, scene, sampler, energy, spp, number)?;
            for (orb, errors) in errors_by_orb(truth, &shot.picture)?.into_iter().enumerate() {
                of.squares[orb].push(errors.rmse * errors.rmse);
                of.fireflies[orb].push(errors.fireflies_ppm);
            }
            if number == 0 {
                first.push((sampler_name, shot));
            }
        }
        found.push(of);
    }
    let shots = first.iter().map(|(label, shot)| Shot {
        label,
        picture: &shot.picture,
        note: format!("{spp} spp, {:.1} s", shot.seconds),
    });
    lab.comparison(&PictureComparison {
        name: &format!("orbs-{}", file_name(name)),
        caption: &format!("Orbs of silver, alpha 0.2 to 1 from left to right; {name}."),
        shots: shots.collect(),
        reference: Some(truth),
        insets: insets(truth.height),
        exposure_stops: EXPOSURE_STOPS,
    })?;
    Ok(found)
}

fn plot(lab: &mut Lab<'_>, found: &[Vec<SamplerErrors>]) -> Result<()> {
    type Pick = fn(&SamplerErrors, usize) -> f64;
    let all = || {
        let found = found.iter().flatten();
        found.flat_map(|f| (0..ALPHAS.len()).map(move |orb| (f, orb)))
    };
    let fireflies: Pick = |f, orb| mean_and_error(&f.fireflies[orb]).0;
    let least = all()
        .map(|(f, orb)| f.rmse(orb))
        .fold(f64::INFINITY, f64::min);
    let greatest = all().map(|(f, orb)| f.rmse(orb)).fold(0.0, f64::max);
    let most = all().map(|(f, orb)| fireflies(f, orb)).fold(1.0, f64::max);
    let kinds: [(Axis, Pick); 2] = [
        (
            Axis::logarithmic("RMSE").from_to(0.8 * least, 1.25 * greatest),
            SamplerErrors::rmse,
        ),
        (
            Axis::linear("fireflies [1/million pixels]").from_to(0.0, 1.1 * most),
            fireflies,
        ),
    ];
    let mut panels = Vec::new();
    for (y, pick) in kinds {
        for (of_model, (model, _)) in found.iter().zip(MODELS) {
            let series = of_model.iter().zip(SAMPLERS).map(|(of, (_, name, style))| {
                let points = ALPHAS.into_iter().enumerate();
                let points = points.map(|(orb, alpha)| [alpha, pick(of, orb)]);
                Series::new(name, style, points.collect())
            });
            panels.push(Panel {
                title: model.to_owned(),
                x: Axis::linear("alpha").from_to(0.0, 1.0),
                y: y.clone(),
                content: Content::Lines(series.collect()),
            });
        }
    }
    let caption = "Error and fireflies over the alpha of the orbs.";
    lab.plot("over-alpha", caption, &Figure::grid(2, panels))
}

fn verdict(found: &[Vec<SamplerErrors>], spp: u32) -> Verdict {
    let last = ALPHAS.len() - 1;
    let ratio = |model: usize, sampler: usize, orb: usize| {
        found[model][sampler].rmse(orb) / found[model][CAP].rmse(orb)
    };
    // Of the orbs of alpha 0.6 and more: geometric mean over the cap's.
    let gain = |model: usize, sampler: usize| {
        let rough = 2..ALPHAS.len();
        let logs = rough.clone().map(|orb| ratio(model, sampler, orb).ln());
        (logs.sum::<f64>() / rough.len() as f64).exp()
    };
    let fireflies =
        |model: usize| [CAP, BOUNDED, EXACT].map(|s| found[model][s].rough_fireflies().0);
    let list = |values: [f64; 3]| format!("{:.0}, {:.0}, {:.0}", values[0], values[1], values[2]);
    let [kulla_conty, turquin] = [0, 1].map(fireflies);
    let fewer = |of: [f64; 3]| of[BOUNDED] < 0.5 * of[CAP];
    let rmse = |sampler: usize| {
        format!(
            "Kulla and Conty {:.2}, Turquin {:.2} of the cap's at alpha 1",
            ratio(0, sampler, last),
            ratio(1, sampler, last)
        )
    };
    Verdict {
        summary: format!(
            "Fireflies per million on the two roughest orbs (cap, bounded, exact): Kulla and Conty {}, \
             Turquin {}; RMSE of the bounded cap at alpha 1: {}.",
            list(kulla_conty),
            list(turquin),
            rmse(BOUNDED)
        ),
        claims: vec![
            Claim::law(
                "The bounded cap has fewer fireflies than the cap with Turquin's compensation",
                "significantly reduces",
                list(turquin),
                fewer(turquin),
            ),
            Claim::measured(
                "So it has with Kulla and Conty's",
                "significantly reduces",
                list(kulla_conty),
                fewer(kulla_conty),
            ),
            Claim::law(
                "Its error is smaller on the roughest orb",
                "less noise",
                rmse(BOUNDED),
                ratio(0, BOUNDED, last) < 0.9 && ratio(1, BOUNDED, last) < 0.9,
            ),
            suits_turquin([gain(0, BOUNDED), gain(1, BOUNDED)]),
            is_quieter([0, 1].map(|model: usize| found[model][BOUNDED].rmse(last))),
            Claim::measured(
                "The exact sampler is no worse than the bounded cap",
                "not in the paper",
                format!(
                    "RMSE over the bounded cap's, alpha 0.6 to 1, geometric mean: Turquin {:.2}, Kulla \
                     and Conty {:.2}",
                    gain(1, EXACT) / gain(1, BOUNDED),
                    gain(0, EXACT) / gain(0, BOUNDED)
                ),
                (0..2).all(|m| gain(m, EXACT) < 1.1 * gain(m, BOUNDED)),
            ),
        ],
        caveat: format!(
            "Orbs, light and metal of our own, {spp} samples per pixel for the paper's 16384: more \
             fireflies in fewer pixels. Directions are sampled by the sampler alone, and of Kulla and \
             Conty's second lobe by the cosine, which the paper does not say that it does."
        ),
    }
}

/// * `gains`: RMSE of the bounded cap over the cap's by model.
fn suits_turquin([kulla_conty, turquin]: [f64; 2]) -> Claim {
    Claim::measured(
        "The bounded cap lowers Turquin's error more than Kulla and Conty's",
        "more suitable for Turquin's model",
        format!(
            "RMSE over the cap's, alpha 0.6 to 1, geometric mean: Turquin {turquin:.2}, Kulla and Conty \
             {kulla_conty:.2}"
        ),
        turquin < kulla_conty,
    )
}

/// * `rmse`: of the bounded cap by model.
fn is_quieter([kulla_conty, turquin]: [f64; 2]) -> Claim {
    Claim::measured(
        "With the bounded cap, Turquin's compensation has less noise than Kulla and Conty's",
        "less noise (section 6)",
        format!("RMSE at alpha 1: Turquin {turquin:.3}, Kulla and Conty {kulla_conty:.3}"),
        turquin < kulla_conty,
    )
}
