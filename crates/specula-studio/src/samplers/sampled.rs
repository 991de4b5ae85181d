//! `samplers.samples`: reflections, their normals, and what they are in the stretched space.

use serde_json::json;
use specula_bsdf::Vec3;
use specula_bsdf::math::{Real, Stream};
use specula_bsdf::vndf::Sampler;
use specula_bsdf::vndf::heitz;

use super::{Surface, sampler};
use crate::fields::Fields;
use crate::{Answer, AskError};

/// Most samples that are listed.
const MOST_LISTED: u32 = 1_000_000;

/// Samples of one view; `pdf` is 0 below the horizon.
pub(super) fn samples(mut fields: Fields) -> Result<Answer, AskError> {
    let sampler = sampler(&mut fields)?;
    let surface = Surface::of(&mut fields)?;
    let count = fields.count("count", 1, MOST_LISTED)?;
    let mut stream = Stream::new(fields.seed()?);
    fields.end()?;

    let reflections = surface.reflections(sampler);
    let (mut all_wi, mut all_wm, mut all_stretched) = (Vec::new(), Vec::new(), Vec::new());
    let (mut pdf, mut accepted) = (Vec::new(), Vec::new());
    for _ in 0..count {
        let u = [stream.next(), stream.next()];
        let wi = reflections.sample_direction(u);
        let wm = match sampler {
            Sampler::Heitz => heitz::sample_wm(surface.alpha, surface.wo, u),
            _ => normal(surface.wo, wi),
        };
        all_wi.extend(wi.to_array().map(f32::of));
        all_wm.extend(wm.to_array().map(f32::of));
        all_stretched.extend(surface.reflection_of(wm).to_array().map(f32::of));
        pdf.push(f32::of(reflections.pdf(wi)));
        accepted.push(u8::from(wi.z > 0.0));
    }
    let n = pdf.len();
    let kept = accepted.iter().filter(|a| **a == 1).count();
    Ok(Answer::new(json!({"accepted": kept, "rejected": n - kept}))
        .with_f32("wi", &[n, 3], &all_wi)
        .with_f32("wm", &[n, 3], &all_wm)
        .with_f32("stretched", &[n, 3], &all_stretched)
        .with_f32("pdf", &[n], &pdf)
        .with_u8("accepted", &[n], accepted))
}

/// The normal that reflects one to the other.
pub(super) fn normal(wo: Vec3<f64>, wi: Vec3<f64>) -> Vec3<f64> {
    let half = wo + wi;
    half * (1.0 / half.length().max(f64::MIN_POSITIVE))
}
