//! Cui et al. 2023, supplement, fig. 1: densities of multiple importance sampling, anisotropic.

use super::cui23_densities::{Case, HAPKE, Judged, LAMBERT, NORMALISED, judge, means, range};
use crate::{Claim, Experiment, Lab, Result, Source, Verdict};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    id: "cui23-supplement-fig1",
    source: Source::Cui23,
    item: "supplement, fig. 1",
    title: "densities of multiple importance sampling on anisotropic metals",
    statement: "For anisotropic metals the density is less accurate than for isotropic ones, as its \
                albedo is the mean of both alphas, but still better than single bounce and a \
                Lambertian term.",
    run,
};

/// Along and across the plane of incidence.
const ALPHAS: [[f64; 2]; 4] = [[0.1, 0.4], [0.4, 0.1], [0.2, 1.0], [1.0, 0.2]];
/// Isotropic metals of the same mean alphas, for comparison.
const ISOTROPIC: [f64; 2] = [0.25, 0.6];
const ANGLES: [f64; 2] = [30.0, 60.0];

fn run(lab: &mut Lab<'_>) -> Result<Verdict> {
    let all = ALPHAS.into_iter().chain(ISOTROPIC.map(|alpha| [alpha; 2]));
    let cases: Vec<Case> = ANGLES
        .into_iter()
        .flat_map(|theta_deg| all.clone().map(move |alpha| Case { alpha, theta_deg }))
        .collect();
    let caption = "Densities of multiple importance sampling and the lobe, F = 1, in the plane of \
                   incidence, to which the first alpha belongs; forward is to the right.";
    let judged = judge(lab, &cases, |case| !case.is_isotropic(), caption)?;
    Ok(verdict(judged))
}

fn verdict(judged: Vec<Judged>) -> Verdict {
    let (isotropic, anisotropic): (Vec<Judged>, Vec<Judged>) =
        judged.into_iter().partition(|j| j.case.is_isotropic());
    let closer = anisotropic
        .iter()
        .filter(|j| {
            j.distances[HAPKE]
                .absolute
                .is_below(j.distances[LAMBERT].absolute)
        })
        .count();
    let [lambert, hapke, specula] = means(&anisotropic, |d| d.absolute);
    let [_, hapke_isotropic, _] = means(&isotropic, |d| d.absolute);
    let [shape_lambert, shape_hapke, shape_specula] = means(&anisotropic, |d| d.of_shape);
    let [low, high] = range(&anisotropic, HAPKE, |d| d.integral);
    let [specula_low, specula_high] = range(&anisotropic, NORMALISED, |d| d.integral);
    Verdict {
        summary: format!(
            "Integral of |pdf - f cos|, mean over cases: Lambert {lambert:.2}, Hapke {hapke:.2}, \
             Specula's {specula:.2}."
        ),
        claims: vec![
            Claim::law(
                "Cui's density is closer than single bounce + Lambert",
                "better matching",
                format!(
                    "{hapke:.3} against {lambert:.3}; closer in {closer} of {} cases",
                    anisotropic.len()
                ),
                closer == anisotropic.len(),
            ),
            Claim::law(
                "Scaled to integrate to 1, its shape is closer on the mean",
                "better matching",
                format!("{shape_hapke:.3} against {shape_lambert:.3}"),
                shape_hapke < shape_lambert,
            ),
            Claim::measured(
                "It is less accurate than on isotropic metals of the same mean alpha",
                "less accurate",
                format!("{hapke:.3} against {hapke_isotropic:.3}"),
                hapke > hapke_isotropic,
            ),
            Claim::law(
                "Specula's density integrates to 1 and is closest",
                "no statement",
                format!(
                    "integrates to {specula_low:.3} to {specula_high:.3} (Cui's {low:.2} to {high:.2}); \
                     {specula:.3}, in shape {shape_specula:.3}"
                ),
                specula_low > 0.95 && specula_high < 1.05 && specula < hapke && shape_specula < shape_hapke,
            ),
        ],
        caveat:
            "With the H of the paper's eq. 15 as its derivation has it; that of the released code \
                 is misprinted. Where the plane of incidence is across the grain, Specula's density is up to \
                 twice the lobe within that plane."
                .to_owned(),
    }
}
