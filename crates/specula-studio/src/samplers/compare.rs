//! `samplers.compare`: all samplers on one white metal under one light.

use serde_json::{Value, json};
use specula_bsdf::bsdf::RoughConductor;
use specula_bsdf::fresnel::Reflectance;
use specula_bsdf::math::Stream;
use specula_bsdf::ndf::Ggx;
use specula_bsdf::vndf::Sampler;
use specula_bsdf::{Bsdf, Rgb, Transport, Vec3};
use specula_stat::z_test::Moments;

use super::Surface;
use crate::fields::{Fields, MOST_SAMPLES, wrong};
use crate::{Answer, AskError};

const SAMPLERS: [Sampler; 4] = [
    Sampler::Heitz,
    Sampler::Cap,
    Sampler::Bounded,
    Sampler::Exact,
];

/// A light as an estimator sees it: radiance 1 everywhere, or within a disk of directions.
enum Lamp {
    Everywhere,
    Disk { towards: Vec3<f64>, cos: f64 },
}

impl Lamp {
    fn of(fields: &mut Fields) -> Result<Self, AskError> {
        let mut lamp = fields.within("lamp")?;
        if !lamp.has("towards") && !lamp.has("angle") {
            lamp.end()?;
            return Ok(Self::Everywhere);
        }
        let towards = lamp.direction("towards")?;
        let angle = lamp.number("angle")?;
        lamp.end()?;
        if !(angle > 0.0 && angle <= std::f64::consts::PI) {
            return Err(wrong("angle", "radians in (0, pi]", &angle));
        }
        let cos = angle.cos();
        Ok(Self::Disk { towards, cos })
    }

    fn radiance(&self, wi: Vec3<f64>) -> f64 {
        match self {
            Self::Everywhere => 1.0,
            Self::Disk { towards, cos } => f64::from(u8::from(wi.dot(*towards) >= *cos)),
        }
    }
}

/// A row for each sampler; all take the same random numbers.
pub(super) fn compare(mut fields: Fields) -> Result<Answer, AskError> {
    let surface = Surface::of(&mut fields)?;
    let lamp = Lamp::of(&mut fields)?;
    let count = fields.count("count", 2, MOST_SAMPLES / 4)?;
    let seed = fields.seed()?;
    fields.end()?;
    if surface.wo.z <= 0.0 {
        let expected = "a view above the horizon (of others no light is estimated)";
        return Err(wrong("wo", expected, &format!("z {}", surface.wo.z)));
    }
    let rows = SAMPLERS.map(|sampler| row(&surface, &lamp, sampler, count, seed));
    Ok(Answer::new(json!({ "rows": rows })))
}

fn row(surface: &Surface, lamp: &Lamp, sampler: Sampler, count: u32, seed: u64) -> Value {
    let white = Reflectance::Constant(Rgb::WHITE);
    let lobe = RoughConductor::new(Ggx::new(surface.alpha), white).with_sampler(sampler);
    let mut stream = Stream::new(seed);
    let (mut accepted, mut moments) = (0_u32, Moments::default());
    for _ in 0..count {
        let u = [0.5, stream.next(), stream.next()];
        let sample = lobe.sample(surface.wo, u, Transport::Radiance);
        accepted += u32::from(sample.is_some());
        moments.push(sample.map_or(0.0, |s| s.weight.g * lamp.radiance(s.wi)));
    }
    json!({
        "sampler": sampler.to_string(),
        "acceptance": f64::from(accepted) / f64::from(count),
        "mean": moments.mean(),
        "error": moments.variance_of_mean().sqrt(),
        "variance": moments.variance(),
        "nanoseconds": nanoseconds(surface, sampler),
    })
}

/// There is no clock.
#[cfg(target_arch = "wasm32")]
fn nanoseconds(_surface: &Surface, _sampler: Sampler) -> Option<f64> {
    None
}

/// What a sample takes in single precision, scalar: the fastest of several rounds, as others use the machine, too.
#[cfg(not(target_arch = "wasm32"))]
fn nanoseconds(surface: &Surface, sampler: Sampler) -> Option<f64> {
    use std::hint::black_box;
    use std::time::Instant;

    /// Samples of a round.
    const ROUND: u32 = 8192;

    let alpha = specula_bsdf::Alpha::<f32>::clamped(
        specula_bsdf::Real::of(surface.alpha.x),
        specula_bsdf::Real::of(surface.alpha.y),
    );
    let (ggx, wo) = (Ggx::new(alpha), surface.wo.cast::<f32>());
    let mut stream = Stream::new(1);
    let us: Vec<[f32; 2]> = (0..ROUND).map(|_| [stream.next(), stream.next()]).collect();
    let rounds = (0..5).map(|_| {
        let start = Instant::now();
        for u in &us {
            black_box(ggx.sample_reflection(sampler, black_box(wo), *u));
        }
        start.elapsed().as_secs_f64() * 1e9 / f64::from(ROUND)
    });
    rounds.reduce(f64::min)
}
