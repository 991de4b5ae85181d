//! How many reflections rounding puts below the surface.

use std::thread;

use specula_bsdf::math::{Real, Stream, Vec3, vec3};
use specula_bsdf::{Alpha, vndf};

use crate::Result;

/// Samples per width and view.
const PER_VIEW: u64 = 50;

/// What was sampled.
#[derive(Clone, Copy, Default)]
struct Count {
    sampled: u64,
    rejected: u64,
    /// No unit vector, or of no positive finite density.
    broken: u64,
}

/// Samples `count` reflections in f32, alphas log-uniform in `[1e-3, 8]`, views over the hemisphere,
/// near grazing and near the normal.
pub(super) fn run(count: u64) -> Result<()> {
    let threads = thread::available_parallelism().map_or(1, |n| n.get() as u64);
    let counts: Vec<[Count; 2]> = thread::scope(|scope| {
        let workers: Vec<_> = (0..threads)
            .map(|seed| scope.spawn(move || sample(seed, count.div_ceil(threads))))
            .collect();
        workers.into_iter().filter_map(|w| w.join().ok()).collect()
    });
    let mut failed = counts.len() as u64 != threads;
    for (i, name) in ["equal alphas", "unequal alphas"].into_iter().enumerate() {
        let sum = |f: fn(&Count) -> u64| counts.iter().map(|c| f(&c[i])).sum::<u64>();
        let (sampled, rejected) = (sum(|c| c.sampled), sum(|c| c.rejected));
        let broken = sum(|c| c.broken);
        let rate = rejected as f64 / sampled as f64;
        println!(
            "{name:<15} {sampled:>11} sampled, {rejected} below the surface ({rate:.1e}), {broken} broken"
        );
        failed |= rate > 1e-6 || broken > 0;
    }
    if failed {
        return Err("more than one in 10^6 is below the surface, or some are broken".into());
    }
    Ok(())
}

/// A fifth of the samples with isotropic alpha, the rest with unequal ones.
fn sample(seed: u64, count: u64) -> [Count; 2] {
    let mut stream = Stream::new(0x5eed ^ (seed << 32));
    let mut counts = [Count::default(); 2];
    for round in 0..count.div_ceil(PER_VIEW) {
        let log_uniform = |u: f32| (1e-3_f32.ln() + u * 8e3_f32.ln()).exp();
        let width = log_uniform(stream.next());
        let unequal = round % 5 != 0;
        let other = if unequal {
            log_uniform(stream.next())
        } else {
            width
        };
        let alpha = Alpha::clamped(width, other);
        let wo = view(&mut stream);
        let counted = &mut counts[usize::from(unequal)];
        for _ in 0..PER_VIEW {
            let wi = vndf::exact::sample_direction(alpha, wo, [stream.next(), stream.next()]);
            counted.sampled += 1;
            if wi.z > 0.0 {
                let pdf = vndf::exact::reflection_pdf(alpha, wo, wi);
                let sound = (wi.length() - 1.0).abs() < 1e-5 && pdf > 0.0 && pdf.is_finite();
                counted.broken += u64::from(!sound);
            } else {
                counted.rejected += 1;
                counted.broken += u64::from(!wi.is_finite());
            }
        }
    }
    counts
}

/// Uniform over the hemisphere, within a tiny angle of grazing, or of the normal.
fn view(stream: &mut Stream) -> Vec3<f32> {
    let (which, u, turn): (f32, f32, f32) = (stream.next(), stream.next(), stream.next());
    let tiny = (1e-7_f32.ln() * u).exp();
    let z = match (3.0 * which).floor() {
        0.0 => u.max(1e-30),
        1.0 => tiny,
        _ => (1.0 - tiny * tiny).sqrt(),
    };
    let (y, x) = turn.sin_cos_turns();
    let sine = ((1.0 - z) * (1.0 + z)).sqrt();
    vec3(sine * x, sine * y, z)
}
