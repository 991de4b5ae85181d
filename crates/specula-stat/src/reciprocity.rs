//! Helmholtz reciprocity: exchanging `wo` and `wi` changes nothing, but for the factor eta^2 of
//! refraction.

use specula_bsdf::{Transport, Vec3};

use crate::consistency::probe;
use crate::report::Check;
use crate::rng::Rng;
use crate::subject::Subject;

/// For which pairs of directions a BSDF promises reciprocity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Domain {
    /// None: some BSDFs in use are not reciprocal.
    Nowhere,
    /// Both directions above the surface: BSDFs that reflect on one side only.
    #[default]
    Above,
    /// Any two directions: BSDFs that reflect or refract on both sides.
    Everywhere,
}

/// Options of a reciprocity test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReciprocityOptions {
    /// How many pairs of directions.
    pub pairs: u32,
    /// Largest relative difference: 1e-9 suits `f64`. Differences below 1e-13 per steradian pass
    /// too: near-zero values of f have few accurate digits.
    pub relative_tolerance: f64,
    /// Which pairs are tested.
    pub domain: Domain,
    /// Index of refraction below the surface (z < 0) over that above it.
    pub eta: f64,
    /// What the subject's `eval` carries. Importance is the adjoint of radiance: it has the
    /// inverse factor.
    pub transport: Transport,
}

impl Default for ReciprocityOptions {
    fn default() -> Self {
        Self {
            pairs: 10_000,
            relative_tolerance: 1e-9,
            domain: Domain::default(),
            eta: 1.0,
            transport: Transport::Radiance,
        }
    }
}

/// Checks over pairs of directions, half of them samples of the lobe itself, that
///
/// ```text
/// f(wo, wi) / n(wo)^2 = f(wi, wo) / n(wi)^2        radiance
/// f(wo, wi) / n(wi)^2 = f(wi, wo) / n(wo)^2        importance
/// ```
///
/// where `n(w)` is the index of the medium that `w` is in.
///
/// Pairs with a direction within 1e-6 of the horizon are left out: f is `eval` over the cosine,
/// which has no accurate digits there.
///
/// Source: Veach 1997, eq. 5.14.
#[must_use]
pub fn test(name: &str, subject: &Subject, options: &ReciprocityOptions, rng: &mut Rng) -> Check {
    let index_squared = |w: Vec3<f64>| {
        if w.z < 0.0 {
            options.eta * options.eta
        } else {
            1.0
        }
    };
    let mut worst = 0.0_f64;
    let mut failure = None;
    let mut non_zero = 0_u32;
    for k in 0..options.pairs {
        let mut wo = probe(rng);
        if options.domain == Domain::Above {
            wo.z = wo.z.abs();
        }
        let wi = if k % 2 == 0 {
            probe(rng)
        } else if let Some(sampled) = subject.sample_density(wo, rng.triple()) {
            sampled.wi
        } else {
            continue;
        };
        let is_outside = options.domain == Domain::Above && wi.z < 0.0;
        if is_outside || wo.z.abs().min(wi.z.abs()) < 1e-6 {
            continue;
        }
        let (near, far) = match options.transport {
            Transport::Radiance => (wo, wi),
            Transport::Importance => (wi, wo),
        };
        let there = subject.eval(wo, wi) * (1.0 / (wi.z.abs() * index_squared(near)));
        let back = subject.eval(wi, wo) * (1.0 / (wo.z.abs() * index_squared(far)));
        for (a, b) in there.to_array().into_iter().zip(back.to_array()) {
            let scale = a.abs().max(b.abs());
            non_zero += u32::from(scale > 0.0);
            let off = ((a - b).abs() - 1e-13) / scale.max(1e-12);
            let off = if off.is_nan() { f64::INFINITY } else { off };
            if off > options.relative_tolerance {
                failure.get_or_insert_with(|| {
                    format!("wo {wo:?}, wi {wi:?}: {there:?} there, {back:?} back")
                });
            }
            worst = worst.max(off);
        }
    }
    if non_zero == 0 {
        failure = Some("eval is zero everywhere: nothing was compared".into());
    }
    Check {
        name: format!("reciprocity {name}"),
        is_pass: failure.is_none(),
        p_value: None,
        detail: failure.unwrap_or_else(|| format!("{} pairs, within {worst:.1e}", options.pairs)),
    }
}
