//! The rules of the path estimator: weights, Russian roulette, light candidates, rays.
//!
//! Pure scalar functions, each rule once. `integrator` calls them for a single vertex; the loops over batches call
//! them for every element, where they compile to the machine's vectors. Conditions are therefore written without
//! branches. Constants are public, and written in front of shaders (`flatten`).

use specula_bsdf::{Rgb, Vec3};

use crate::accel::Ray;
use crate::offset::SurfacePoint;
use crate::options::Strategy;
use crate::words::Words;

/// Scattering events of a path before Russian roulette begins.
pub const ROULETTE_FROM: u32 = 3;
/// Probability of survival over the largest channel of the throughput, where it is neither clamped nor 1.
pub const ROULETTE_SCALE: f32 = 2.0;
/// Least probability of survival.
pub const ROULETTE_LEAST: f32 = 0.05;
/// Probability of survival from which on roulette is not played.
pub const ROULETTE_BELOW: f32 = 0.95;

/// Scattering events of a path from which on its light is indirect. Light of the first visible surface is never
/// clamped.
pub const INDIRECT_FROM: u32 = 2;

/// Share of a shadow ray that is traced: not its very end, which is on the light.
pub const SHADOW_RAY_END: f32 = 1.0 - 1e-4;
/// Most surfaces that a ray passes: cut-outs, hidden lights, boundaries of media.
pub const MOST_PASSES: u32 = 4096;

/// Purpose of the random stream with which a lobe is sampled, as of `Sampler::stream`.
pub const STREAM_SCATTER: u32 = 1;
/// Purpose of the hash that chooses between two light candidates, as of `Sampler::hashed`.
pub const HASH_CANDIDATE: u32 = 3;

/// Purpose of the random stream with which a lobe is evaluated towards a light candidate.
#[inline(always)]
pub const fn stream_of_candidate(candidate: u32) -> u32 {
    2 * candidate
}

/// The constants above, for shaders.
pub(crate) fn flatten(to: &mut Words) {
    to.constant("ROULETTE_FROM", ROULETTE_FROM);
    to.float_constant("ROULETTE_SCALE", ROULETTE_SCALE);
    to.float_constant("ROULETTE_LEAST", ROULETTE_LEAST);
    to.float_constant("ROULETTE_BELOW", ROULETTE_BELOW);
    to.constant("INDIRECT_FROM", INDIRECT_FROM);
    to.float_constant("SHADOW_RAY_END", SHADOW_RAY_END);
    to.constant("MOST_PASSES", MOST_PASSES);
    to.constant("STREAM_SCATTER", STREAM_SCATTER);
    to.constant("HASH_CANDIDATE", HASH_CANDIDATE);
}

/// Weight by the power heuristic (Veach 1997, 9.2.4) with exponent 3/2.
///
/// ```text
/// w = 1 / (1 + r^(3/2))
/// ```
///
/// * `ratio`: `r`, the other strategy's density over this one's. A ratio, as squares of densities overflow.
#[inline(always)]
fn power_heuristic(ratio: f32) -> f32 {
    1.0 / (1.0 + ratio * ratio.sqrt())
}

/// MIS weight of a direction that was sampled with density `pdf` and could have been with density `other_pdf`.
#[inline(always)]
pub(crate) fn mis_weight(strategy: Strategy, pdf: f32, other_pdf: f32) -> f32 {
    let ratio = other_pdf / pdf;
    match strategy {
        Strategy::Balance => 1.0 / (1.0 + ratio),
        Strategy::Power => 1.0 / (1.0 + ratio * ratio),
        Strategy::Mis | Strategy::LightsOnly | Strategy::BsdfOnly => power_heuristic(ratio),
    }
}

/// MIS weight of a light sample.
///
/// * `delta`: whether no lobe's direction can find the light.
/// * `light_pdf`, `lobe_pdf`: densities of its direction.
#[inline(always)]
pub(crate) fn light_weight(strategy: Strategy, delta: bool, light_pdf: f32, lobe_pdf: f32) -> f32 {
    let weight = mis_weight(strategy, light_pdf, lobe_pdf);
    if delta | (strategy == Strategy::LightsOnly) {
        1.0
    } else {
        weight
    }
}

/// MIS weight of emission that a ray met by chance.
///
/// * `lobe_pdf`: density with which the ray's direction was sampled; `None` where no light sample could have
///   found it, as for camera rays and perfect mirrors.
/// * `light_pdf`: density with which light sampling takes that direction.
#[inline(always)]
pub(crate) fn emission_weight(
    strategy: Strategy,
    lobe_pdf: Option<f32>,
    light_pdf: impl FnOnce() -> f32,
) -> f32 {
    match (lobe_pdf, strategy) {
        (None, _) | (_, Strategy::BsdfOnly) => 1.0,
        (_, Strategy::LightsOnly) => 0.0,
        (Some(pdf), _) => mis_weight(strategy, pdf, light_pdf()),
    }
}

/// Contribution of a light sample, should nothing occlude it: `throughput f |cos| radiance weight / pdf`.
#[inline(always)]
pub(crate) fn light_contribution(
    throughput: Rgb<f32>,
    f_cos: Rgb<f32>,
    radiance: Rgb<f32>,
    weight: f32,
    pdf: f32,
) -> Rgb<f32> {
    throughput * f_cos * (radiance * (weight / pdf))
}

/// A contribution to a path's radiance, scaled so that no channel exceeds `bound` where it is indirect.
///
/// * `events`: how many times the light was scattered on its way to the camera.
#[inline(always)]
pub(crate) fn clamp_indirect(contribution: Rgb<f32>, events: u32, bound: f32) -> Rgb<f32> {
    let largest = contribution.max_channel();
    if events >= INDIRECT_FROM && largest > bound {
        contribution * (bound / largest)
    } else {
        contribution
    }
}

/// Whether a direction is on the same side of the shading normal and of the surface. Others carry nothing, so
/// that light does not leak.
///
/// * `cos_shading`: cosine to the shading normal, which is on the viewer's side.
/// * `cos_facing`: cosine to the geometric normal on the viewer's side.
#[inline(always)]
pub(crate) fn sides_agree(cos_shading: f32, cos_facing: f32) -> bool {
    cos_shading * cos_facing > 0.0
}

/// Product of the squared relative indices of a path (pbrt's eta scale) after one more transmission.
#[inline(always)]
pub(crate) fn eta_scale_after(eta_scale: f32, eta: f32) -> f32 {
    eta_scale * (eta * eta)
}

/// Probability with which a path survives Russian roulette.
///
/// * `largest`: largest channel of its throughput, times its eta scale.
#[inline(always)]
fn survival_probability(largest: f32) -> f32 {
    (ROULETTE_SCALE * largest).clamp(ROULETTE_LEAST, 1.0)
}

/// Whether a path that was just scattered goes on, and its throughput if so.
///
/// * `depth`: scattering events before this one.
/// * `throughput`: with the weight of this one.
/// * `u`: uniform in `[0, 1)`.
#[inline(always)]
pub(crate) fn russian_roulette(
    depth: u32,
    throughput: Rgb<f32>,
    eta_scale: f32,
    u: f32,
) -> (bool, Rgb<f32>) {
    let largest = throughput.max_channel() * eta_scale;
    let probability = survival_probability(largest);
    let is_played = (depth >= ROULETTE_FROM) & (probability < ROULETTE_BELOW);
    let survives = (largest > 0.0) & (!is_played | (u < probability));
    let scale = if is_played { 1.0 / probability } else { 1.0 };
    (survives, throughput * scale)
}

/// The ray that leaves a surface in a direction.
#[inline(always)]
pub(crate) fn spawn_ray(from: &SurfacePoint, direction: Vec3<f32>) -> Ray {
    Ray {
        origin: from.ray_origin(direction),
        direction,
        t_max: f32::INFINITY,
    }
}

/// The ray from a surface to a point of another one, whose length is 1.
///
/// * `wi`: direction to that point.
#[inline(always)]
pub(crate) fn shadow_ray(from: &SurfacePoint, wi: Vec3<f32>, to: &SurfacePoint) -> Ray {
    let origin = from.ray_origin(wi);
    Ray {
        origin,
        direction: to.ray_origin(-wi) - origin,
        t_max: SHADOW_RAY_END,
    }
}

/// The random numbers of one of several light candidates.
///
/// The choice of light is sampled in the lower half of its random numbers for the first candidate and in the upper
/// half for the second, and the points on lights half a period apart: both together are as even as one was.
///
/// * `u`: as of `Sampler::light`.
/// * `candidate`: which one, of `count`.
#[inline(always)]
pub(crate) fn candidate_random_numbers(u: [f32; 4], candidate: u32, count: u32) -> [f32; 4] {
    if count == 1 {
        return u;
    }
    let [choice, x, y, finer] = u;
    if candidate == 0 {
        [0.5 * choice, x, y, 0.5 * finer]
    } else {
        [0.5 * choice + 0.5, opposite(x), opposite(y), 0.5 * finer]
    }
}

/// Half a period on, within `[0, 1)`.
#[inline(always)]
fn opposite(u: f32) -> f32 {
    if u < 0.5 { u + 0.5 } else { u - 0.5 }
}

/// Density of a lobe's direction per light candidate: what MIS compares with the density of one light sample.
#[inline(always)]
pub(crate) fn pdf_per_candidate(pdf: f32, candidates: u32) -> f32 {
    if candidates == 2 { 0.5 * pdf } else { pdf }
}

/// Chooses one of two light candidates in proportion to their contributions: whether that is the second, and what
/// its contribution is to be scaled by (resampled importance sampling: Talbot et al. 2005, eq. 6).
///
/// * `first`, `second`: contributions without visibility.
/// * `u`: uniform in `[0, 1)`.
#[inline(always)]
pub(crate) fn choose_candidate(first: Rgb<f32>, second: Rgb<f32>, u: f32) -> (bool, f32) {
    let [first, second] = [first.mean(), second.mean()];
    let both = first + second;
    let is_second = u * both >= first;
    let chosen = if is_second { second } else { first };
    let scale = if chosen > 0.0 { both / chosen } else { 0.0 };
    (is_second, scale)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::Sampler;
    use specula_bsdf::math::rgb;

    #[test]
    fn weights_of_two_strategies_add_up_to_one() {
        for strategy in [Strategy::Mis, Strategy::Balance, Strategy::Power] {
            for (a, b) in [(1.0_f32, 1.0), (0.2, 7.0), (1e-3, 1e6), (4.0, 0.0)] {
                let sum = mis_weight(strategy, a, b) + mis_weight(strategy, b, a);
                assert!((sum - 1.0).abs() < 1e-6, "{strategy:?} {a} {b}: {sum}");
            }
        }
        let weight = mis_weight(Strategy::Mis, 1.0, 4.0);
        assert!((weight - 1.0 / 9.0).abs() < 1e-7, "{weight}");
    }

    #[test]
    fn one_strategy_alone_has_weight_one() {
        for pdf in [0.1, 10.0] {
            assert_eq!(light_weight(Strategy::LightsOnly, false, 1.0, pdf), 1.0);
            assert_eq!(light_weight(Strategy::Mis, true, 1.0, pdf), 1.0);
            let emission = |strategy, lobe_pdf| emission_weight(strategy, lobe_pdf, || 1.0);
            assert_eq!(emission(Strategy::LightsOnly, Some(pdf)), 0.0);
            assert_eq!(emission(Strategy::BsdfOnly, Some(pdf)), 1.0);
            assert_eq!(emission(Strategy::Mis, None), 1.0);
        }
    }

    #[test]
    fn roulette_keeps_the_mean_of_the_throughput() {
        const COUNT: u32 = 1 << 12;
        for (depth, largest, eta_scale) in [
            (ROULETTE_FROM - 1, 0.1_f32, 1.0_f32),
            (ROULETTE_FROM, 0.1, 1.0),
            (ROULETTE_FROM, 0.001, 1.0),
            (ROULETTE_FROM, 0.9, 1.0),
            (ROULETTE_FROM, 0.1, 2.25),
        ] {
            let throughput = rgb(largest, 0.5 * largest, 0.0);
            let (mut sum, mut survivors) = (0.0, 0);
            for i in 0..COUNT {
                let u = (i as f32 + 0.5) / COUNT as f32;
                let (survives, scaled) = russian_roulette(depth, throughput, eta_scale, u);
                if survives {
                    sum += scaled.r / COUNT as f32;
                    survivors += 1;
                }
            }
            let expected = (2.0 * largest * eta_scale).clamp(0.05, 1.0);
            let plays = depth >= 3 && expected < 0.95;
            let share = survivors as f32 / COUNT as f32;
            let expected = if plays { expected } else { 1.0 };
            assert!((share - expected).abs() < 1e-3, "{largest}: {share}");
            assert!((sum / largest - 1.0).abs() < 0.01, "{largest}: {sum}");
        }
        for nothing in [0.0, f32::NAN] {
            assert!(!russian_roulette(0, rgb(nothing, nothing, nothing), 1.0, 0.0).0);
        }
    }

    #[test]
    fn clamping_holds_indirect_light_only_and_preserves_hue() {
        let c = rgb(4.0, 8.0, 2.0);
        assert_eq!(clamp_indirect(c, 1, 1.0), c);
        assert_eq!(clamp_indirect(c, 2, 8.0), c);
        assert_eq!(clamp_indirect(c, 2, f32::INFINITY), c);
        assert_eq!(clamp_indirect(c, 2, 4.0), rgb(2.0, 4.0, 1.0));
        // What is not finite stays so, and is reported.
        assert!(!clamp_indirect(rgb(f32::NAN, 0.0, 0.0), 2, 1.0).is_finite());
        assert!(!clamp_indirect(rgb(f32::INFINITY, 0.0, 0.0), 2, 1.0).is_finite());
    }

    #[test]
    fn the_chosen_candidate_stands_for_both_on_average() {
        const COUNT: u32 = 1 << 14;
        let black = Rgb::BLACK;
        for (a, b) in [
            (rgb(0.1_f32, 0.2, 0.3), rgb(5.0, 1.0, 0.0)),
            (rgb(2.0, 2.0, 0.0), rgb(0.0, 0.0, 4.0)),
            (rgb(3.0, 1.0, 2.0), black),
            (black, rgb(0.5, 0.0, 0.0)),
            (black, black),
        ] {
            let mut sum = Rgb::BLACK;
            for i in 0..COUNT {
                let u = (i as f32 + 0.5) / COUNT as f32;
                let (is_second, scale) = choose_candidate(a, b, u);
                let chosen = if is_second { b } else { a } * scale;
                let both = a.mean() + b.mean();
                assert!(
                    (chosen.mean() - both).abs() <= 1e-5 * both,
                    "{a:?} {b:?} {u}"
                );
                sum += chosen;
            }
            let mean = sum * (1.0 / COUNT as f32);
            let difference = (mean - (a + b)).map(f32::abs).max_channel();
            assert!(
                difference < 1e-3 * (a + b).max_channel().max(1e-6),
                "{a:?} {b:?}"
            );
        }
    }

    /// The choices of both candidates of `2^k` samples have one in each of `2^(k+1)` intervals, and their points
    /// are as even as those of one.
    #[test]
    fn random_numbers_of_two_candidates_are_even() {
        let n: u32 = 64;
        let cell = |x: f32, parts: u32| crate::convert::floor_index(x * parts as f32);
        let mut choices = vec![0; 2 * n as usize];
        let mut cells = [[0; 64]; 2];
        for i in 0..n {
            let u = Sampler::new([3, 4], i, 5).light(0);
            for candidate in [0, 1] {
                let v = candidate_random_numbers(u, candidate, 2);
                assert!(v.iter().all(|x| (0.0..1.0).contains(x)), "{v:?}");
                choices[cell(v[0], 2 * n)] += 1;
                cells[candidate as usize][8 * cell(v[1], 8) + cell(v[2], 8)] += 1;
            }
            assert_eq!(candidate_random_numbers(u, 0, 1), u);
        }
        assert!(choices.iter().all(|c| *c == 1), "{choices:?}");
        assert!(cells.iter().flatten().all(|c| *c == 1), "{cells:?}");
    }
}
