//! Measurements of lobes: albedo, rejected samples, and tests of the samplers.

use rayon::prelude::*;
use specula_bsdf::bsdf::Lobe;
use specula_bsdf::math::{Stream, vec3};
use specula_bsdf::{Bsdf, Rgb, Transport, Vec3};
use specula_stat::chi_square::{self, ChiSquare, ChiSquareOptions};
use specula_stat::furnace;
use specula_stat::quadrature::{Peak, Quadrature};
use specula_stat::z_test::Moments;
use specula_stat::{Rng, Subject};

use super::VIEWS_DEG;
use super::lobes::{Named, Variants, direction, is_stochastic};
use crate::{Lab, Result};

/// Steps of the angle of view, degrees.
const STEP_DEG: f64 = 5.0;
/// The last angle, which is nearly grazing.
const LAST_DEG: f64 = 89.0;

/// Albedo of a lobe by a treatment of energy, at an angle of view.
pub(super) struct Reflected {
    pub(super) energy: String,
    pub(super) style: usize,
    pub(super) theta_deg: f64,
    /// Albedo.
    pub(super) own: [f64; 3],
    /// With white in place of all colours.
    pub(super) white: [f64; 3],
    /// Standard error of the latter, at most.
    pub(super) error: f64,
}

/// Rejection and variance of a sampler at an angle of view.
pub(super) struct Trial {
    pub(super) sampler: String,
    pub(super) style: usize,
    pub(super) theta_deg: f64,
    /// Share of samples.
    pub(super) rejected: f64,
    /// Of the luminance of the weight; a rejected sample counts as 0.
    pub(super) variance: f64,
    pub(super) mean: f64,
}

/// A sampler against its density, and its weights against the lobe.
pub(super) struct Fit {
    pub(super) sampler: String,
    pub(super) theta_deg: f64,
    pub(super) chi_square: ChiSquare,
    /// `None` where there is nothing to test.
    pub(super) furnace_p: Option<f64>,
}

/// Angles of view, degrees.
fn angles() -> Vec<f64> {
    let steps = (0..18).map(|i| STEP_DEG * f64::from(i));
    steps.chain([LAST_DEG]).collect()
}

/// Weights of samples in `side * side` strata; the moments per channel, of the luminance, and the share
/// that was rejected.
///
/// * `transport`: importance counts energy; radiance is squeezed by refraction.
fn sample_strata(
    lobe: &Lobe<f32>,
    wo: Vec3<f32>,
    transport: Transport,
    side: u32,
    rng: &mut Rng,
) -> ([Moments; 3], Moments, f64) {
    let mut channels = [Moments::default(); 3];
    let (mut luminance, mut rejected) = (Moments::default(), 0_u32);
    let mut stream = Stream::new(rng.bits());
    for i in 0..side * side {
        let [u0, u1, u2] = rng.triple();
        let stratum = |place: u32, u: f64| (f64::from(place) + u) / f64::from(side);
        #[expect(clippy::cast_possible_truncation, reason = "clamped below 1")]
        let u = [u0, stratum(i % side, u1), stratum(i / side, u2)]
            .map(|u| (u as f32).min(1.0 - f32::EPSILON / 2.0));
        let sample = lobe.sample_random(wo, u, transport, &mut stream);
        rejected += u32::from(sample.is_none());
        let weight: Rgb<f64> = sample.map_or(Rgb::BLACK, |s| s.weight.cast());
        for (moments, value) in channels.iter_mut().zip(weight.to_array()) {
            moments.push(value);
        }
        luminance.push(weight.luminance());
    }
    let share = f64::from(rejected) / f64::from(side * side);
    (channels, luminance, share)
}

/// Albedo of every treatment of energy over the angle of view.
pub(super) fn reflected(variants: &Variants, lab: &Lab<'_>) -> Result<Vec<Reflected>> {
    let side = lab.pick(128, 512);
    let mut rng = Rng::new(lab.seed());
    let mut all = Vec::new();
    for (i, named) in variants.energies.iter().enumerate() {
        let share = i as f64 / variants.energies.len() as f64;
        for theta_deg in angles() {
            lab.step(0.2 + 0.2 * share, "albedo")?;
            let wo = direction(theta_deg, 0.0);
            let mut of = |lobe| sample_strata(lobe, wo, Transport::Importance, side, &mut rng).0;
            let [own, white] = [of(&named.lobe), of(&named.white)];
            let errors = white.map(|m| m.variance_of_mean().sqrt());
            all.push(Reflected {
                energy: named.name.clone(),
                style: named.style,
                theta_deg,
                own: own.map(|m| m.mean()),
                white: white.map(|m| m.mean()),
                error: errors.into_iter().fold(0.0, f64::max),
            });
        }
    }
    Ok(all)
}

/// Rejection and variance of every sampler over the angle of view, where single scattering is sampled.
pub(super) fn samplers(variants: &Variants, lab: &Lab<'_>) -> Result<Vec<Trial>> {
    let side = lab.pick(128, 512);
    let mut rng = Rng::new(lab.seed().wrapping_add(1));
    let mut all = Vec::new();
    for named in &variants.samplers {
        for theta_deg in angles() {
            lab.step(0.4, "samplers")?;
            let wo = direction(theta_deg, 0.0);
            let (_, luminance, rejected) =
                sample_strata(&named.lobe, wo, Transport::Radiance, side, &mut rng);
            all.push(Trial {
                sampler: named.name.clone(),
                style: named.style,
                theta_deg,
                rejected,
                variance: luminance.variance(),
                mean: luminance.mean(),
            });
        }
    }
    Ok(all)
}

/// Every sampler against its density.
pub(super) fn fits(variants: &Variants, lab: &Lab<'_>) -> Result<Vec<Fit>> {
    let mut all = Vec::new();
    // The density of a lobe that is estimated is not that of its samples.
    if variants.is_specular() || is_stochastic(&variants.samplers[0].lobe) {
        return Ok(all);
    }
    let count = variants.samplers.len() as f64;
    for (i, named) in variants.samplers.iter().enumerate() {
        lab.step(0.5 + 0.5 * i as f64 / count, "chi-square")?;
        let (samples, seed) = (lab.pick(20_000, 200_000), lab.seed());
        let views = VIEWS_DEG.par_iter();
        let fits = views.map(|&theta_deg| fit(named, theta_deg, variants, samples, seed));
        all.extend(fits.collect::<Vec<Fit>>());
    }
    Ok(all)
}

fn fit(named: &Named, theta_deg: f64, variants: &Variants, samples: u32, seed: u64) -> Fit {
    let subject = Subject::from_bsdf(&named.lobe, Transport::Radiance);
    // Off the axes, where nothing is symmetric.
    let wo: Vec3<f64> = direction(theta_deg, 20.0).cast();
    let name = format!("{} {theta_deg} {seed}", named.name);
    let mut rng = Rng::from_name(&name);
    let eta = variants.eta;
    let edges: Vec<f64> = [1.0, eta, 1.0 / eta]
        .iter()
        .flat_map(|e| [wo.z * e, -wo.z * e])
        .collect();
    let peaks = peaks(wo, variants);
    let chi_square = chi_square::test(
        |u| subject.sample_density(wo, u).map(|sampled| sampled.wi),
        |wi| subject.pdf(wo, wi),
        &mut rng,
        &ChiSquareOptions {
            samples,
            cos_theta_edges: edges.clone(),
            peaks: peaks.clone(),
            ..ChiSquareOptions::default()
        },
    );
    let quadrature = Quadrature {
        relative_tolerance: 1e-4,
        absolute_tolerance: 1e-6,
        peaks,
        ..Quadrature::default()
    };
    let albedo = furnace::albedo(&subject, wo, &edges, &quadrature);
    let furnace_p = furnace::test("", &subject, wo, &albedo, samples, 1e-3, &mut rng).p_value;
    Fit {
        sampler: named.name.clone(),
        theta_deg,
        chi_square,
        furnace_p,
    }
}

/// Where the lobe is sharp: about the mirror direction and the refracted one.
fn peaks(wo: Vec3<f64>, variants: &Variants) -> Vec<Peak> {
    let width = variants.sharpness.max(1e-3);
    let mut peaks = vec![Peak {
        direction: vec3(-wo.x, -wo.y, wo.z),
        width,
    }];
    if variants.eta != 1.0 {
        let (x, y) = (-wo.x / variants.eta, -wo.y / variants.eta);
        let z = -(1.0 - x * x - y * y).max(0.0).sqrt();
        let width = width * (variants.eta - 1.0).abs().min(1.0);
        for direction in [vec3(x, y, z).normalize(), -wo] {
            peaks.push(Peak { direction, width });
        }
    }
    peaks
}
