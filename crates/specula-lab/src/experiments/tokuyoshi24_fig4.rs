//! Tokuyoshi and Eto 2024, fig. 4: orbs of growing roughness without and with energy compensation, sampled
//! by the cap.

use specula_bsdf::energy::{EnergyModel, FmsVariant};
use specula_bsdf::multibounce;
use specula_bsdf::vndf::Sampler;
use specula_render::picture::Picture;
use specula_scene::Energy;

use super::orb_render::{EXPOSURE_STOPS, by_sampler, errors_by_orb, own_error, reference, square};
use crate::output::{Inset, PictureComparison, Shot, Table};
use crate::plot::{Axis, Content, Figure, Panel, Series};
use crate::scenes::orbs::{self, Tessellation};
use crate::{Claim, Experiment, Lab, Result, Source, Verdict};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    id: "tokuyoshi24-fig4",
    source: Source::Tokuyoshi24,
    item: "fig. 4",
    title: "orbs of growing roughness, without and with energy compensation",
    statement: "Single scattering loses energy on rough surfaces; Kulla and Conty's and Turquin's \
                compensation bring it back, but sampled by the cap they leave fireflies there even at \
                16384 samples per pixel.",
    run,
};

/// Alphas of the orbs, from left to right.
pub(super) const ALPHAS: [f64; 5] = [0.2, 0.4, 0.6, 0.8, 1.0];

const TREATMENTS: [(&str, Energy, usize); 4] = [
    ("none", Energy::None, 4),
    (
        "Kulla-Conty",
        Energy::Compensated(EnergyModel::KullaConty),
        5,
    ),
    (
        "Turquin",
        Energy::Compensated(EnergyModel::Turquin(FmsVariant::NormalIncidence)),
        0,
    ),
    (
        "simulated bounces (Specula)",
        Energy::Multibounce(multibounce::MultibounceModel::StratifiedBidirectional),
        1,
    ),
];
const NONE: usize = 0;
const SPECULA: usize = 3;

/// The result of a treatment, by orb.
struct TreatmentResult {
    /// Mean of the reference within the orb.
    brightness: Vec<f64>,
    /// Of the cap's picture.
    rmse: Vec<f64>,
    /// Of the cap's picture, per million pixels.
    fireflies: Vec<f64>,
}

fn run(lab: &mut Lab<'_>) -> Result<Verdict> {
    let side = lab.pick(64, 128);
    let (spp, reference_spp) = lab.pick((16, 32), (48, 192));
    let alphas = ALPHAS.map(|a| (a, a));
    let scene = orbs::row(&alphas, Tessellation::FINE, side);
    let mut table = Table::new(
        "orbs",
        "Orbs sampled by the cap: mean brightness of the reference, error of the picture.",
        &[
            "treatment",
            "alpha",
            "brightness",
            "RMSE",
            "fireflies [1/million pixels]",
            "samples per pixel",
            "RMSE of the whole reference, estimated",
        ],
    );
    let mut found = Vec::new();
    for (i, (name, energy, _)) in TREATMENTS.into_iter().enumerate() {
        lab.step(0.25 * i as f64, &format!("reference, {name}"))?;
        let truth = reference(lab, &scene, energy, reference_spp)?;
        lab.step(0.25 * i as f64 + 0.2, &format!("cap, {name}"))?;
        let mut of = TreatmentResult {
            brightness: (0..)
                .zip(ALPHAS)
                .map(|(orb, _)| brightness(&truth, orb))
                .collect(),
            rmse: vec![0.0; ALPHAS.len()],
            fireflies: vec![0.0; ALPHAS.len()],
        };
        let is_compensated = matches!(energy, Energy::Compensated(_));
        let renders = if is_compensated { 2 } else { 1 };
        let mut first = None;
        for number in 0..renders {
            let shot = by_sampler(lab, &scene, Sampler::Cap, energy, spp, number)?;
            for (orb, errors) in errors_by_orb(&truth, &shot.picture)?.iter().enumerate() {
                of.rmse[orb] += errors.rmse * errors.rmse / f64::from(renders);
                of.fireflies[orb] += errors.fireflies_ppm / f64::from(renders);
            }
            first.get_or_insert(shot.picture);
        }
        of.rmse
            .iter_mut()
            .for_each(|square| *square = square.sqrt());
        for (k, alpha) in ALPHAS.into_iter().enumerate() {
            table.push([
                name.into(),
                alpha.into(),
                of.brightness[k].into(),
                of.rmse[k].into(),
                of.fireflies[k].into(),
                spp.into(),
                own_error(&truth).into(),
            ]);
        }
        found.push(of);
        if let Some(picture) = first {
            compare(lab, name, &truth, &picture, format!("{spp} spp"))?;
        }
    }
    lab.table(table)?;
    plot(lab, &found)?;
    Ok(verdict(&found))
}

/// Mean luminance within an orb.
fn brightness(picture: &Picture, orb: u32) -> f64 {
    let part = square(picture, orb);
    let sum: f64 = part.colour.iter().map(|c| f64::from(c.luminance())).sum();
    sum / part.colour.len() as f64
}

fn compare(
    lab: &mut Lab<'_>,
    name: &str,
    truth: &Picture,
    picture: &Picture,
    note: String,
) -> Result<()> {
    lab.comparison(&PictureComparison {
        name: &format!("orbs-{}", crate::output::comparison::file_name(name)),
        caption: &format!("Orbs of silver, alpha 0.2 to 1 from left to right; {name}."),
        shots: vec![Shot {
            label: "cap",
            picture,
            note,
        }],
        reference: Some(truth),
        insets: insets(truth.height),
        exposure_stops: EXPOSURE_STOPS,
    })?;
    Ok(())
}

/// The opening of the second, the fourth and the last orb.
pub(super) fn insets(side: u32) -> Vec<Inset> {
    [1, 3, 4]
        .into_iter()
        .map(|orb| Inset {
            x: orb * side + side / 4,
            y: side / 4,
            width: side / 2,
            height: 3 * side / 8,
        })
        .collect()
}

fn plot(lab: &mut Lab<'_>, found: &[TreatmentResult]) -> Result<()> {
    type Pick = fn(&TreatmentResult) -> &[f64];
    let kinds: [(&str, &str, Pick); 3] = [
        ("brightness of the reference", "mean luminance", |f| {
            &f.brightness
        }),
        ("error, sampled by the cap", "RMSE", |f| &f.rmse),
        (
            "fireflies, sampled by the cap",
            "fireflies [1/million pixels]",
            |f| &f.fireflies,
        ),
    ];
    let panels = kinds
        .into_iter()
        .map(|(title, y, pick)| {
            let highest = found.iter().flat_map(pick).copied().fold(0.0, f64::max);
            let series = found.iter().zip(TREATMENTS).map(|(f, (name, _, style))| {
                let points = ALPHAS.into_iter().zip(pick(f)).map(|(a, &v)| [a, v]);
                Series::new(name, style, points.collect())
            });
            Panel {
                title: title.to_owned(),
                x: Axis::linear("alpha").from_to(0.0, 1.0),
                y: Axis::linear(y).from_to(0.0, 1.1 * highest),
                content: Content::Lines(series.collect()),
            }
        })
        .collect();
    let caption = "Orbs over their alphas: energy, error and fireflies of each treatment.";
    lab.plot("over-alpha", caption, &Figure::grid(3, panels))
}

fn verdict(found: &[TreatmentResult]) -> Verdict {
    let last = ALPHAS.len() - 1;
    let brightness_share = |i: usize| found[i].brightness[last] / found[SPECULA].brightness[last];
    let of_first = found[NONE].brightness[0] / found[SPECULA].brightness[0];
    let growth = |i: usize| found[i].rmse[last] / found[i].rmse[0];
    let fireflies = |i: usize, orbs: std::ops::Range<usize>| -> f64 {
        let part = &found[i].fireflies[orbs];
        part.iter().sum::<f64>() / part.len() as f64
    };
    let rough = [0, 1, 2].map(|i| fireflies(i, 3..5));
    Verdict {
        summary: format!(
            "At alpha 1 single scattering has {:.0} % of the light of simulated bounces, Kulla and \
             Conty {:.0} %, Turquin {:.0} %; fireflies per million on the two roughest orbs, cap: none \
             {:.0}, Kulla and Conty {:.0}, Turquin {:.0}.",
            100.0 * brightness_share(0),
            100.0 * brightness_share(1),
            100.0 * brightness_share(2),
            rough[0],
            rough[1],
            rough[2]
        ),
        claims: vec![
            Claim::law(
                "Single scattering loses energy on rough surfaces",
                "darker",
                format!(
                    "{:.0} % of simulated bounces at alpha 1, {:.0} % at 0.2",
                    100.0 * brightness_share(0),
                    100.0 * of_first
                ),
                brightness_share(0) < 0.6 * of_first,
            ),
            Claim::law(
                "Compensation restores it",
                "compensated",
                format!(
                    "Kulla and Conty {:.0} %, Turquin {:.0} % at alpha 1",
                    100.0 * brightness_share(1),
                    100.0 * brightness_share(2)
                ),
                [1, 2].into_iter().all(|i| (0.75..1.35).contains(&brightness_share(i))),
            ),
            Claim::law(
                "With compensation, the cap's noise grows with roughness",
                "noticeable on rough surfaces",
                format!(
                    "RMSE at alpha 1 over that at 0.2: none {:.2}, Kulla and Conty {:.2}, Turquin {:.2}",
                    growth(0),
                    growth(1),
                    growth(2)
                ),
                growth(1) > 1.5 * growth(0) && growth(2) > 3.0 * growth(0),
            ),
            turquins_fireflies(rough, [0, 1, 2].map(|i| fireflies(i, 0..1))),
            Claim::measured(
                "And with Kulla and Conty's",
                "firefly noise in (b)",
                format!(
                    "alpha 0.8 and 1 per million: none {:.0}, Kulla and Conty {:.0}",
                    rough[0], rough[1]
                ),
                rough[1] > 2.0 * rough[0],
            ),
        ],
        caveat: "Orbs, light and metal of our own; far fewer samples and pixels than the paper's. Each \
                 treatment is compared with its own reference; directions are sampled by the sampler alone, and \
                 of Kulla and Conty's second lobe by the cosine, which bounds its weights."
            .to_owned(),
    }
}

/// Per million pixels of none, Kulla and Conty, Turquin, on rough orbs and on the smoothest.
fn turquins_fireflies(rough: [f64; 3], smooth: [f64; 3]) -> Claim {
    let list = |values: [f64; 3]| values.map(|v| format!("{v:.0}")).join(", ");
    Claim::law(
        "Fireflies come with Turquin's compensation, on rough surfaces",
        "firefly noise in (c), not in (a)",
        format!(
            "none, Kulla and Conty, Turquin per million: {} at alpha 0.8 and 1, {} at 0.2",
            list(rough),
            list(smooth)
        ),
        rough[2] > 2.0 * rough[0] && rough[2] > 2.0 * smooth[2],
    )
}
