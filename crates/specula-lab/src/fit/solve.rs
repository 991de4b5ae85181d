//! The parameters of the least loss.

use rayon::prelude::*;
use rmpfit::{MPConfig, MPFitter, MPPar, MPResult};
use specula_bsdf::math::Stream;
use specula_bsdf::{Bsdf, Transport};
use specula_lobes::NamedLobe;

use super::candidates::{Bounces, Candidate, FresnelModel};
use super::measurement::{Measurement, robust};
use crate::{Lab, LabError, Result};

/// Alphas that are tried to begin with.
const ALPHAS: [f64; 9] = [0.01, 0.02, 0.05, 0.1, 0.18, 0.28, 0.42, 0.6, 0.85];
/// Real parts of the index to begin with: of metals such as silver, and such as iron.
const ETAS: [f64; 2] = [0.3, 2.0];
/// Rounds in which simulated bounces are found anew for the last parameters.
const ROUNDS: u32 = 4;
/// A residual per unit of k and node, far below those of any measurement: where reflectances do not tell k and eta
/// apart, as near 1, the smaller k is taken.
const SMALL_K: f64 = 2e-5;

/// A fitted lobe.
pub(super) struct Fit {
    pub(super) candidate: Candidate,
    /// With parameters of four digits.
    pub(super) lobe: NamedLobe,
    pub(super) alpha: [f64; 2],
    pub(super) alpha_errors: [f64; 2],
    /// In the candidate's order.
    pub(super) parameters: Vec<f64>,
    /// One standard deviation each.
    pub(super) errors: Vec<f64>,
    /// Per node and channel.
    pub(super) loss: f64,
    /// Half and nine tenths of the nodes are within this share of the measurement.
    pub(super) ratios: [f64; 2],
}

/// Fits a lobe.
///
/// * `share`: of the whole work, what is done before.
pub(super) fn fit(
    candidate: &Candidate,
    measurement: &Measurement,
    share: f64,
    lab: &Lab<'_>,
) -> Result<Fit> {
    let failed = || LabError::Output(format!("{} cannot be fitted", candidate.name()));
    let mut problem = Problem::new(candidate, measurement);
    let alpha = problem.coarse_alpha().ok_or_else(failed)?;
    let f0 = problem.along_the_normal(alpha).ok_or_else(failed)?;
    let etas = match candidate.fresnel {
        FresnelModel::Index => &ETAS[..],
        FresnelModel::F82 => &ETAS[..1],
    };
    let mut solved: Option<Solution> = None;
    for &eta in etas {
        lab.step(share, &candidate.name())?;
        let start = candidate.start(alpha, f0, eta);
        if let Some(new) = problem.solve(start)
            && solved.as_ref().is_none_or(|old| new.norm < old.norm)
        {
            solved = Some(new);
        }
    }
    let mut solved = solved.ok_or_else(failed)?;
    if candidate.bounces == Bounces::All {
        let walks = lab.pick(64, 256);
        for _ in 0..ROUNDS {
            lab.step(share, &candidate.name())?;
            problem
                .simulate(&solved.parameters, walks, lab.seed())
                .ok_or_else(failed)?;
            solved = problem.solve(solved.parameters).ok_or_else(failed)?;
        }
    }
    let parameters = solved.parameters;
    let lobe = candidate.printed(&parameters).ok_or_else(failed)?;
    let alpha = candidate.alpha(&parameters);
    // Errors of logarithms are relative.
    let scale = (solved.norm / problem.number_of_points() as f64).sqrt();
    let errors: Vec<f64> = solved.errors.iter().map(|e| scale * e).collect();
    let error = |i: usize| alpha[i] * errors[i.min(candidate.alphas() - 1)];
    let mut logs = problem.logs(&parameters).ok_or_else(failed)?;
    let loss = logs.iter().map(|l| robust(*l).powi(2)).sum::<f64>() / logs.len() as f64;
    for log in &mut logs {
        *log = log.abs().exp_m1();
    }
    logs.sort_by(f64::total_cmp);
    let within = |share: f64| {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "an index"
        )]
        let i = (share * (logs.len() - 1) as f64) as usize;
        logs[i]
    };
    Ok(Fit {
        candidate: *candidate,
        lobe,
        alpha,
        alpha_errors: [error(0), error(1)],
        loss,
        ratios: [within(0.5), within(0.9)],
        parameters,
        errors,
    })
}

struct Solution {
    parameters: Vec<f64>,
    errors: Vec<f64>,
    norm: f64,
}

/// A least-squares problem.
struct Problem<'a> {
    candidate: &'a Candidate,
    measurement: &'a Measurement,
    /// Light of two and more bounces at each node; empty: none is simulated.
    more: Vec<[f64; 3]>,
    bounds: Vec<MPPar>,
    config: MPConfig,
}

impl<'a> Problem<'a> {
    fn new(candidate: &'a Candidate, measurement: &'a Measurement) -> Self {
        let bounds = (candidate.bounds().into_iter())
            .map(|[low, high]| MPPar {
                limited_low: true,
                limited_up: true,
                limit_low: low,
                limit_up: high,
                step: 1e-5,
                ..MPPar::new()
            })
            .collect();
        Self {
            candidate,
            measurement,
            more: Vec::new(),
            bounds,
            config: MPConfig {
                ftol: 1e-8,
                xtol: 1e-7,
                max_iter: 100,
                ..MPConfig::new()
            },
        }
    }

    /// Logarithms of the ratios, three for each node.
    fn logs(&self, parameters: &[f64]) -> Option<Vec<f64>> {
        let lobe = self.candidate.analytic(parameters)?;
        let lobe = lobe.double();
        let nodes = self.measurement.nodes.par_iter().enumerate();
        let logs: Vec<[f64; 3]> = nodes
            .map(|(i, node)| {
                let mut f_cos = lobe.eval(node.wo, node.wi, Transport::Radiance).to_array();
                if let Some(more) = self.more.get(i) {
                    for (value, more) in f_cos.iter_mut().zip(more) {
                        *value += more;
                    }
                }
                Measurement::logs(node, f_cos)
            })
            .collect();
        Some(logs.into_flattened())
    }

    /// Of the alphas to begin with the one whose shape is nearest: ratios that differ least from their median.
    fn coarse_alpha(&self) -> Option<f64> {
        let spread = |alpha: f64| {
            let mut logs = self.logs(&self.candidate.start(alpha, [0.8; 3], ETAS[0]))?;
            let middle = logs.len() / 2;
            let (_, &mut median, _) = logs.select_nth_unstable_by(middle, f64::total_cmp);
            Some(logs.iter().map(|l| robust(l - median).powi(2)).sum::<f64>())
        };
        let all = ALPHAS.iter().filter_map(|&a| Some((a, spread(a)?)));
        all.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(a, _)| a)
    }

    /// About the reflectance along the normal: the median ratio to that of 0.5, per channel.
    fn along_the_normal(&self, alpha: f64) -> Option<[f64; 3]> {
        let f0 = 0.5;
        let logs = self.logs(&self.candidate.start(alpha, [f0; 3], 1.0))?;
        Some([0, 1, 2].map(|channel| {
            let mut own: Vec<f64> = logs.iter().skip(channel).step_by(3).copied().collect();
            let middle = own.len() / 2;
            let (_, &mut median, _) = own.select_nth_unstable_by(middle, f64::total_cmp);
            (f0 / median.exp()).clamp(0.02, 0.98)
        }))
    }

    fn solve(&mut self, mut parameters: Vec<f64>) -> Option<Solution> {
        for (p, bound) in parameters.iter_mut().zip(&self.bounds) {
            *p = p.clamp(bound.limit_low, bound.limit_up);
        }
        let status = self.mpfit(&mut parameters).ok()?;
        Some(Solution {
            parameters,
            errors: status.xerror,
            norm: status.best_norm,
        })
    }

    /// Finds what comes from two and more bounces.
    fn simulate(&mut self, parameters: &[f64], walks: u32, seed: u64) -> Option<()> {
        let all = self.candidate.lobe(parameters)?;
        let single = self.candidate.analytic(parameters)?;
        let (all, single) = (all.double(), single.double());
        let nodes = self.measurement.nodes.par_iter().enumerate();
        self.more = nodes
            .map(|(i, node)| {
                let mut stream = Stream::new(seed ^ (i as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15));
                let mut sum = [0.0; 3];
                for _ in 0..walks {
                    let (value, _) =
                        all.eval_pdf_random(node.wo, node.wi, Transport::Radiance, &mut stream);
                    for (sum, value) in sum.iter_mut().zip(value.to_array()) {
                        *sum += value / f64::from(walks);
                    }
                }
                let once = single
                    .eval(node.wo, node.wi, Transport::Radiance)
                    .to_array();
                [0, 1, 2].map(|c| sum[c] - once[c])
            })
            .collect();
        Some(())
    }
}

impl MPFitter for Problem<'_> {
    fn eval(&mut self, parameters: &[f64], deviates: &mut [f64]) -> MPResult<()> {
        let logs = self.logs(parameters).ok_or(rmpfit::MPError::Eval)?;
        let weight = SMALL_K * (logs.len() as f64).sqrt();
        let pulls = self.candidate.k(parameters).iter().map(|k| weight * k);
        let all = logs.into_iter().map(robust).chain(pulls);
        for (deviate, residual) in deviates.iter_mut().zip(all) {
            *deviate = residual;
        }
        Ok(())
    }

    fn number_of_points(&self) -> usize {
        let pulls = match self.candidate.fresnel {
            FresnelModel::Index => 3,
            FresnelModel::F82 => 0,
        };
        3 * self.measurement.nodes.len() + pulls
    }

    fn config(&self) -> &MPConfig {
        &self.config
    }

    fn parameters(&self) -> &[MPPar] {
        &self.bounds
    }
}
