//! Tokuyoshi and Eto 2024, fig. 6: an orb with backfacing shading normals, 16 samples per pixel, by
//! sampler over equal and anisotropic alpha.

use specula_render::picture::Picture;

use super::coarse_orb::{self, ENERGY, SPP, backfacing_share, black_pixels, squares_by_stripe};
use super::orb_render::{EXPOSURE_STOPS, SAMPLERS, mean_and_error, own_error, reference};
use crate::output::{Inset, PictureComparison, Shot, Table};
use crate::plot::{Axis, Content, Figure, Panel, Series};
use crate::{Claim, Experiment, Lab, Result, Source, Verdict, errors};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    id: "tokuyoshi24-fig6",
    source: Source::Tokuyoshi24,
    item: "fig. 6",
    title: "an orb with backfacing shading normals by sampler",
    statement: "The bounded cap reduces the error especially at higher roughness and lower anisotropy, \
                insignificantly at alpha 0.2, and handles backfacing shading normals.",
    run,
};

/// Equal alphas, then unequal ones.
const ALPHAS: [(f64, f64); 7] = [
    (0.2, 0.2),
    (0.4, 0.4),
    (0.6, 0.6),
    (0.8, 0.8),
    (0.8, 0.4),
    (0.8, 0.2),
    (0.8, 0.1),
];
/// Those that are shown as pictures.
const SHOWN: [(f64, f64); 4] = [(0.2, 0.2), (0.8, 0.8), (0.8, 0.4), (0.8, 0.1)];

/// Errors for a pair of alphas.
struct AlphaErrors {
    /// Cap, bounded, exact.
    rmse: [f64; 3],
    /// Over the cap's: bounded, exact, each with its standard error.
    ratios: [(f64, f64); 2],
}

fn run(lab: &mut Lab<'_>) -> Result<Verdict> {
    let side = lab.pick(80, 160);
    let count = lab.pick(2, 4);
    let reference_spp = lab.pick(48, 384);
    let mut table = Table::new(
        "errors",
        "Root mean squared errors, 16 samples per pixel.",
        &[
            "alpha_x",
            "alpha_y",
            "sampler",
            "RMSE",
            "RMSE / cap",
            "standard error of the quotient",
        ],
    );
    let mut found = Vec::new();
    // Of single renders by cap, bounded, exact; of references.
    let mut black = [0; 4];
    for (i, alphas) in ALPHAS.into_iter().enumerate() {
        let share = i as f64 / ALPHAS.len() as f64;
        let scene = coarse_orb::scene(alphas, side);
        let mut renders = Vec::new();
        for (sampler, name, _) in SAMPLERS {
            lab.step(share, &format!("{name}, alpha {alphas:?}"))?;
            renders.push(coarse_orb::renders(lab, &scene, sampler, count)?);
        }
        for (sum, pictures) in black.iter_mut().zip(&renders) {
            *sum += pictures.iter().map(black_pixels).sum::<u32>();
        }
        let of = AlphaErrors::of(&renders);
        for (k, (_, name, _)) in SAMPLERS.into_iter().enumerate() {
            let (ratio, error) = if k == 0 { (1.0, 0.0) } else { of.ratios[k - 1] };
            table.push([
                alphas.0.into(),
                alphas.1.into(),
                name.into(),
                of.rmse[k].into(),
                ratio.into(),
                error.into(),
            ]);
        }
        if SHOWN.contains(&alphas) {
            lab.step(share, &format!("reference, alpha {alphas:?}"))?;
            let truth = reference(lab, &scene, ENERGY, reference_spp)?;
            black[3] += black_pixels(&truth);
            compare(lab, alphas, &renders, &truth)?;
        }
        found.push(of);
    }
    lab.table(table)?;
    plot(lab, &found)?;
    let backfacing = backfacing_share(&coarse_orb::scene(ALPHAS[0], side));
    Ok(verdict(&found, backfacing, black))
}

impl AlphaErrors {
    /// * `renders`: of cap, bounded, exact.
    fn of(renders: &[Vec<Picture>]) -> Self {
        let rmse = [0, 1, 2].map(|k| coarse_orb::rmse(&renders[k]));
        let [cap, bounded, exact] = [0, 1, 2].map(|k| squares_by_stripe(&renders[k]));
        let ratio = |k: usize, other: &[f64]| {
            let quotients: Vec<f64> = (other.iter().zip(&cap))
                .map(|(a, b)| (a / b).sqrt())
                .collect();
            (rmse[k] / rmse[0], mean_and_error(&quotients).1)
        };
        Self {
            rmse,
            ratios: [ratio(1, &bounded), ratio(2, &exact)],
        }
    }
}

fn compare(
    lab: &mut Lab<'_>,
    (ax, ay): (f64, f64),
    renders: &[Vec<Picture>],
    truth: &Picture,
) -> Result<()> {
    let mut shots = Vec::new();
    for (pictures, (_, label, _)) in renders.iter().zip(SAMPLERS) {
        let picture = &pictures[0];
        shots.push(Shot {
            label,
            picture,
            note: format!("{SPP} spp, RMSE {:.4}", errors(truth, picture)?.rmse),
        });
    }
    let side = truth.height;
    let inset = |x: u32, y: u32| Inset {
        x: x * side / 16,
        y: y * side / 16,
        width: side / 5,
        height: side / 5,
    };
    lab.comparison(&PictureComparison {
        name: &format!("orb-{ax}-{ay}"),
        caption: &format!(
            "An orb of silver, alpha ({ax}, {ay}), Turquin's compensation; the reference's own RMSE is \
             about {:.4}.",
            own_error(truth)
        ),
        shots,
        reference: Some(truth),
        insets: vec![inset(6, 6), inset(10, 2)],
        exposure_stops: EXPOSURE_STOPS,
    })?;
    Ok(())
}

fn plot(lab: &mut Lab<'_>, found: &[AlphaErrors]) -> Result<()> {
    let panel = |title: &str, x: &str, pick: fn((f64, f64)) -> Option<f64>| {
        let series = SAMPLERS.iter().enumerate().map(|(k, &(_, name, style))| {
            let points = ALPHAS.iter().zip(found);
            let points = points.filter_map(|(&w, f)| Some([pick(w)?, f.rmse[k]]));
            Series::new(name, style, points.collect())
        });
        let highest = found.iter().flat_map(|f| f.rmse).fold(0.0, f64::max);
        Panel {
            title: title.to_owned(),
            x: Axis::linear(x).from_to(0.0, 1.0),
            y: Axis::linear("RMSE").from_to(0.0, 1.1 * highest),
            content: Content::Lines(series.collect()),
        }
    };
    let panels = vec![
        panel("equal alphas", "alpha", |(x, y)| (x == y).then_some(x)),
        panel("alpha_x = 0.8", "alpha_y", |(x, y)| (x == 0.8).then_some(y)),
    ];
    let caption = "Error over the alphas, Turquin's compensation, 16 samples per pixel.";
    lab.plot("errors", caption, &Figure::grid(2, panels))
}

fn verdict(
    found: &[AlphaErrors],
    backfacing: f64,
    [cap, bounded, exact, truth]: [u32; 4],
) -> Verdict {
    let at = |alphas: (f64, f64), k: usize| {
        let place = ALPHAS.iter().position(|&w| w == alphas);
        place.map_or((f64::NAN, f64::NAN), |i| found[i].ratios[k])
    };
    let text = |(ratio, error): (f64, f64)| format!("{ratio:.2} +- {error:.2}");
    let equal = [0.2, 0.4, 0.6, 0.8].map(|a| at((a, a), 0));
    let unequal = [0.4, 0.2, 0.1].map(|y| at((0.8, y), 0));
    Verdict {
        summary: format!(
            "RMSE of the bounded cap over the cap's at alpha 0.2, 0.4, 0.6, 0.8: {}; of the exact sampler \
             at 0.8: {}.",
            equal.map(text).join(", "),
            text(at((0.8, 0.8), 1))
        ),
        claims: vec![
            Claim::law(
                "The bounded cap reduces the error at high roughness",
                "especially at alpha 0.8",
                format!("{} at 0.8", text(equal[3])),
                equal[3].0 < 0.92,
            ),
            Claim::law(
                "At low roughness the difference is insignificant",
                "insignificant at alpha 0.2",
                format!("{} at 0.2", text(equal[0])),
                (0.9..1.1).contains(&equal[0].0),
            ),
            Claim::law(
                "Of unequal alphas it reduces the error most at low anisotropy",
                "especially lower anisotropy",
                format!(
                    "alpha_x 0.8, alpha_y 0.8, 0.4, 0.2, 0.1: {}, {}",
                    text(equal[3]),
                    unequal.map(text).join(", ")
                ),
                equal[3].0 < unequal[2].0 - 0.04,
            ),
            Claim::law(
                "Backfacing shading normals are not black",
                "supported (section 4)",
                format!(
                    "{:.1} % of the faces towards the viewer have them; black pixels of the references: \
                     {truth} (where all 16 samples end: cap {cap}, bounded {bounded}, exact {exact})",
                    100.0 * backfacing
                ),
                backfacing > 0.003 && truth == 0,
            ),
            Claim::law(
                "The exact sampler is no worse than the cap",
                "not in the paper",
                format!(
                    "{} at (0.8, 0.8), {} at (0.8, 0.1)",
                    text(at((0.8, 0.8), 1)),
                    text(at((0.8, 0.1), 1))
                ),
                at((0.8, 0.8), 1).0 < 1.05 && at((0.8, 0.1), 1).0 < 1.1,
            ),
        ],
        caveat: "An orb and light of our own. Errors in the table are those of renders that are \
                 independent of each other; directions are sampled by the sampler alone."
            .to_owned(),
    }
}
