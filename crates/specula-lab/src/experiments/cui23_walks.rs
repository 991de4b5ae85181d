//! Walks over rough metal, as their directions alone: counted by fig. 10 of Cui et al. 2023.

use specula_bsdf::Vec3;
use specula_bsdf::math::Stream;
use specula_bsdf::vndf::VisibleNormals;

use super::cui23_segment_terms::Step;

/// Bounces without roulette, and the probability of each beyond, in evaluations.
const SURE: usize = 2;
const GOES_ON: f64 = 0.7;
/// Longest walk.
const LONGEST: usize = 64;

/// The first flights of a walk that never leaves.
pub(super) fn walk<N: VisibleNormals<f64>>(
    ndf: &N,
    wo: Vec3<f64>,
    flights: usize,
    stream: &mut Stream,
) -> Vec<Step> {
    let mut d = -wo;
    let mut path = Vec::with_capacity(flights);
    for _ in 0..flights {
        path.push(step(ndf, d));
        d = bounce(ndf, d, stream);
    }
    path
}

/// Downward flights of a path as it is sampled: it leaves with probability `G1` once it goes up
/// (algorithm 2 of the supplement).
pub(super) fn sampled<N: VisibleNormals<f64>>(
    ndf: &N,
    wo: Vec3<f64>,
    stream: &mut Stream,
) -> usize {
    let mut d = -wo;
    let mut downward = 0;
    for _ in 0..LONGEST {
        if d.z > 0.0 {
            let g1 = 1.0 / (1.0 + step(ndf, d).rate);
            if stream.next::<f64>() < g1 {
                break;
            }
        } else {
            downward += 1;
        }
        d = bounce(ndf, d, stream);
    }
    downward
}

/// Downward flights of each path that one evaluation connects (algorithm 3).
pub(super) fn evaluated<N: VisibleNormals<f64>>(
    ndf: &N,
    wo: Vec3<f64>,
    stream: &mut Stream,
) -> Vec<usize> {
    let mut d = -wo;
    let mut downward = 0;
    let mut all = Vec::new();
    for k in 0..LONGEST {
        downward += usize::from(d.z <= 0.0);
        all.push(downward);
        if k >= SURE && stream.next::<f64>() >= GOES_ON {
            break;
        }
        d = bounce(ndf, d, stream);
    }
    all
}

fn bounce<N: VisibleNormals<f64>>(ndf: &N, d: Vec3<f64>, stream: &mut Stream) -> Vec3<f64> {
    let wm = ndf.sample_wm(-d, [stream.next(), stream.next()]);
    d - wm * (2.0 * d.dot(wm))
}

fn step<N: VisibleNormals<f64>>(ndf: &N, d: Vec3<f64>) -> Step {
    let facing = ndf.lambda_cos(d) + (-d.z).max(0.0);
    Step {
        rate: facing.max(1e-24) / d.z.abs().max(1e-12),
        down: d.z <= 0.0,
    }
}
