//! `lobes.albedo` and `lobes.samples`: what the lobe's own sampling says. Dirac deltas are included.

use serde_json::json;
use specula_bsdf::math::{Real, Stream, vec3};
use specula_bsdf::{Bsdf, Rgb, Transport, Vec3};
use specula_lobes::NamedLobe;
use specula_stat::z_test::Moments;

use crate::fields::{Fields, MOST_SAMPLES, wrong};
use crate::{Answer, AskError};

/// Most views of an albedo.
const MOST_VIEWS: u32 = 1024;
/// Most samples that are listed.
const MOST_LISTED: u32 = 1_000_000;
/// Least cosine of a view: at 0 nothing is seen.
const LEAST_COS: f64 = 1e-3;

/// Directional albedo over the view's cosine, evenly from 0 (1e-3 in its place) to 1, in the x-z plane.
///
/// All views take the same random numbers, so that the curve is smooth.
pub(super) fn albedo(mut fields: Fields) -> Result<Answer, AskError> {
    let lobe = super::lobe(&mut fields)?;
    let count = fields.count("count", 2, MOST_VIEWS)?;
    let samples = fields.count("samples", 2, MOST_SAMPLES)?;
    let seed = fields.seed()?;
    fields.end()?;
    if samples > MOST_SAMPLES / count {
        let expected = format!("at most {} for {count} views", MOST_SAMPLES / count);
        return Err(wrong("samples", &expected, &samples));
    }
    let (mut cosines, mut albedos, mut errors) = (Vec::new(), Vec::new(), Vec::new());
    for i in 0..count {
        let cos = (f64::from(i) / f64::from(count - 1)).max(LEAST_COS);
        let wo = vec3(((1.0 - cos) * (1.0 + cos)).sqrt(), 0.0, cos);
        let moments = weights(&lobe, wo, samples, &mut Stream::new(seed));
        cosines.push(f32::of(cos));
        albedos.extend(moments.map(|m| f32::of(m.mean())));
        errors.extend(moments.map(|m| f32::of(m.variance_of_mean().sqrt())));
    }
    let n = cosines.len();
    Ok(Answer::new(json!({}))
        .with_f32("cos", &[n], &cosines)
        .with_f32("albedo", &[n, 3], &albedos)
        .with_f32("error", &[n, 3], &errors))
}

/// Moments of the weights, red, green, blue; samples that failed are zeros.
pub(super) fn weights(
    lobe: &NamedLobe,
    wo: Vec3<f64>,
    samples: u32,
    stream: &mut Stream,
) -> [Moments; 3] {
    let mut moments = [Moments::default(); 3];
    for _ in 0..samples {
        let u = [stream.next(), stream.next(), stream.next()];
        let sample = lobe
            .double()
            .sample_random(wo, u, Transport::Radiance, stream);
        let weight = sample.map_or(Rgb::BLACK, |s| s.weight);
        for (moments, w) in moments.iter_mut().zip(weight.to_array()) {
            moments.push(w);
        }
    }
    moments
}

/// Samples of one view.
pub(super) fn samples(mut fields: Fields) -> Result<Answer, AskError> {
    let lobe = super::lobe(&mut fields)?;
    let wo = fields.direction("wo")?;
    let count = fields.count("count", 1, MOST_LISTED)?;
    let mut stream = Stream::new(fields.seed()?);
    fields.end()?;

    let (mut wi, mut weight, mut pdf, mut us) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let (mut failed, mut sum, mut luminance) = (0_u32, Rgb::BLACK, Moments::default());
    for _ in 0..count {
        let u: [f64; 3] = [stream.next(), stream.next(), stream.next()];
        us.extend(u.map(f32::of));
        // Random numbers of walks come from elsewhere, so that u is the same for every lobe.
        let mut walk = Stream::new(u[0].to_bits() ^ u[1].to_bits().rotate_left(32));
        let sample = lobe
            .double()
            .sample_random(wo, u, Transport::Radiance, &mut walk);
        let Some(sample) = sample else {
            failed += 1;
            wi.extend([0.0; 3]);
            weight.extend([0.0; 3]);
            pdf.push(0.0);
            luminance.push(0.0);
            continue;
        };
        wi.extend(sample.wi.cast::<f32>().to_array());
        weight.extend(sample.weight.cast::<f32>().to_array());
        pdf.push(if sample.specular {
            0.0
        } else {
            f32::of(sample.pdf)
        });
        sum += sample.weight;
        luminance.push(sample.weight.luminance());
    }
    let n = pdf.len();
    let albedo = sum.map(|s| s / f64::from(count)).to_array();
    let value = json!({"failed": failed, "albedo": albedo, "variance": luminance.variance()});
    Ok(Answer::new(value)
        .with_f32("wi", &[n, 3], &wi)
        .with_f32("weight", &[n, 3], &weight)
        .with_f32("pdf", &[n], &pdf)
        .with_f32("u", &[n, 3], &us))
}
