//! Two light samples where a camera path first hits rough metal, one of which gets a shadow ray.
//!
//! Lights are chosen without regard to the lobe: the environment or a lamp, whichever is brighter at the point.
//! Contributions off a metal differ from that by orders of magnitude. So two lights are sampled, each over twice
//! its density and with the MIS weight of that. One is chosen by chance in proportion to the contributions, and
//! stands for both (resampled importance sampling: Talbot et al. 2005, "Importance resampling for global
//! illumination", eq. 6). The rules are in `estimator`; figures in
//! `docs/decisions/light-samples-per-vertex.md`.

use specula_bsdf::bsdf::Lobe;
use specula_bsdf::{Bsdf, Rgb};

use super::{PathTracer, estimator};
use crate::sampler::Sampler;

impl PathTracer<'_> {
    /// How many lights are sampled at a vertex.
    #[inline(always)]
    pub(super) fn light_candidates(&self, lobe: &Lobe<f32>, depth: u32) -> u32 {
        let two = depth == 0 && is_rough_metal(lobe) && self.scene.lights.are_chosen();
        if two { 2 } else { 1 }
    }
}

fn is_rough_metal(lobe: &Lobe<f32>) -> bool {
    match lobe {
        Lobe::RoughConductor(_)
        | Lobe::RoughConductorBeckmann(_)
        | Lobe::Compensated(_)
        | Lobe::CompensatedBeckmann(_)
        | Lobe::MultibounceConductor(_)
        | Lobe::MultibounceConductorBeckmann(_) => !Bsdf::is_specular(lobe),
        _ => false,
    }
}

/// The random number that chooses between two candidates.
#[inline(always)]
pub(super) fn random_number(sampler: &Sampler, depth: u32) -> f32 {
    sampler.hashed([depth, 0, estimator::HASH_CANDIDATE])
}

/// One of two light samples with their contributions, scaled to stand for both.
///
/// * `u`: the random number that chooses.
pub(super) fn choose<L: Copy>(
    [first, second]: [Option<(L, Rgb<f32>)>; 2],
    u: impl FnOnce() -> f32,
) -> Option<(L, Rgb<f32>)> {
    let (Some((a, of_a)), Some((b, of_b))) = (first, second) else {
        return first.or(second);
    };
    let (is_second, scale) = estimator::choose_candidate(of_a, of_b, u());
    Some(if is_second {
        (b, of_b * scale)
    } else {
        (a, of_a * scale)
    })
}
