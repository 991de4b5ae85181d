//! Cui et al. 2023, fig. 8: densities of multiple importance sampling, isotropic.

use super::cui23_densities::{
    Case, Distance, Estimate, HAPKE, Judged, LAMBERT, NORMALISED, judge, means, range,
};
use crate::{Claim, Experiment, Lab, Result, Source, Verdict};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    id: "cui23-fig8",
    source: Source::Cui23,
    item: "fig. 8",
    title: "densities of multiple importance sampling against the lobe",
    statement: "Single bounce and Hapke's multiple scattering match the multiple-bounce lobe at all \
                roughnesses; single bounce and a Lambertian term fit well only at high roughness.",
    run,
};

/// Isotropic alphas; the first two are low.
const ALPHAS: [f64; 4] = [0.1, 0.2, 0.5, 1.0];
const ANGLES: [f64; 2] = [30.0, 60.0];
/// The largest alpha that counts as low.
const LOW: f64 = 0.2;

fn run(lab: &mut Lab<'_>) -> Result<Verdict> {
    let cases: Vec<Case> = ANGLES
        .into_iter()
        .flat_map(|theta_deg| {
            ALPHAS.map(|alpha| Case {
                alpha: [alpha; 2],
                theta_deg,
            })
        })
        .collect();
    let caption = "Densities of multiple importance sampling and the lobe, F = 1, in the plane of \
                   incidence; forward is to the right.";
    let judged = judge(lab, &cases, |_| true, caption)?;
    Ok(verdict(&judged))
}

fn verdict(judged: &[Judged]) -> Verdict {
    let [lambert, hapke, specula] = means(judged, |d| d.absolute);
    let [_, shape_hapke, shape_specula] = means(judged, |d| d.of_shape);
    let [[low_l, high_l], [low_h, high_h], [low, high]] =
        [LAMBERT, HAPKE, NORMALISED].map(|k| range(judged, k, |d| d.integral));
    let off = (1.0 - low).max(high - 1.0);
    let mut claims = claims_of_match(judged);
    claims.push(Claim::refuted(
        "It is a probability density",
        "called a PDF",
        format!(
            "integrates to {low_h:.2} to {high_h:.2} (single bounce + Lambert: {low_l:.2} to \
             {high_l:.2})"
        ),
        [low_h, high_h].iter().all(|i| (i - 1.0).abs() < 0.02),
    ));
    claims.push(Claim::law(
        "Specula's density integrates to 1 and is closest",
        "no statement",
        format!("integral off by {off:.1e} at most; {specula:.3}, in shape {shape_specula:.3}"),
        off < 0.05 && specula < hapke.min(lambert) && shape_specula < shape_hapke,
    ));
    Verdict {
        summary: format!(
            "Integral of |pdf - f cos|, mean over cases: Lambert {lambert:.2}, Hapke {hapke:.2}, \
             Specula's {specula:.2}."
        ),
        claims,
        caveat: "The paper's H is misprinted in its released code, where the density is negative over \
                 much of the hemisphere: the repaired one is compared. Weights of multiple importance \
                 sampling need no normalised density. The truth is the mean of evaluations instead \
                 of a histogram of samples."
            .to_owned(),
    }
}

fn claims_of_match(judged: &[Judged]) -> Vec<Claim> {
    let (low, high): (Vec<&Judged>, Vec<&Judged>) =
        judged.iter().partition(|j| j.case.alpha[0] <= LOW);
    let closer = |j: &&&Judged| {
        let [hapke, lambert] = [HAPKE, LAMBERT].map(|k| j.distances[k].absolute);
        hapke.is_below(lambert)
    };
    let mean = |list: &[&Judged], k: usize, of: fn(&Distance) -> Estimate| {
        let sum: f64 = list.iter().map(|j| of(&j.distances[k]).value).sum();
        sum / list.len() as f64
    };
    let shape = |list: &[&Judged], k: usize| mean(list, k, |d| d.of_shape);
    let whole = |list: &[&Judged], k: usize| mean(list, k, |d| d.absolute);
    let closer = low.iter().filter(closer).count();
    vec![
        Claim::law(
            "At low roughness Cui's density is closer than single bounce + Lambert",
            "particularly there",
            format!(
                "{:.3} against {:.3}; closer in {closer} of {} cases",
                whole(&low, HAPKE),
                whole(&low, LAMBERT),
                low.len()
            ),
            closer == low.len(),
        ),
        Claim::law(
            "Single bounce + Lambert fits better at high roughness than at low",
            "fits only at high roughness",
            format!(
                "difference after scaling to integrate to 1: {:.3} at alpha 0.5 and 1, {:.3} at 0.1 \
                 and 0.2",
                shape(&high, LAMBERT),
                shape(&low, LAMBERT)
            ),
            shape(&high, LAMBERT) < 0.5 * shape(&low, LAMBERT),
        ),
        Claim::refuted(
            "At high roughness Cui's density has the better shape too",
            "matches at all roughness",
            format!(
                "{:.3} against {:.3} after scaling, {:.3} against {:.3} before",
                shape(&high, HAPKE),
                shape(&high, LAMBERT),
                whole(&high, HAPKE),
                whole(&high, LAMBERT)
            ),
            shape(&high, HAPKE) < shape(&high, LAMBERT),
        ),
    ]
}
