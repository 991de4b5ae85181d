//! Errors of renders, how well they are known, and what follows for the time that they need.
//!
//! With two references `r1`, `r2` whose errors are independent, the mean of `(p - r1) (p - r2)` is the
//! mean squared error of `p`, without the references' own. The variance of what follows from it is
//! found by leaving out one group of pixels after the other (the jackknife): pixels are independent.

use specula_bsdf::vndf::Sampler;
use specula_render::picture::Picture;
use specula_scene::Energy;

use super::reference::{Reference, variance_of_luminance};
use super::turns::Entry;
use crate::{Errors, Result, errors};

/// Groups of pixels.
const GROUPS: usize = 32;

/// What is known of a combination in the end.
pub(super) struct Judged {
    pub(super) sampler: Sampler,
    pub(super) energy: Energy,
    pub(super) label: String,
    pub(super) reference: usize,
    pub(super) picture: Picture,
    /// Against the whole reference, its error included.
    pub(super) errors: Errors,
    pub(super) mse: f64,
    pub(super) rel_mse: f64,
    pub(super) seconds: f64,
    pub(super) samples: u32,
    pub(super) rejected_share: f64,
    /// Root of the mean squared error over time.
    pub(super) course: Vec<[f64; 2]>,
    /// Efficiency, `1 / (MSE x time)`, over that of the best of the same energy, and its standard error.
    pub(super) efficiency: [f64; 2],
    /// Standard errors that the mean luminance is from the reference's.
    pub(super) z: f64,
}

/// Sums of products of errors, per group.
#[derive(Clone, Copy, Default)]
struct Sums {
    plain: [f64; GROUPS],
    relative: [f64; GROUPS],
    values: [f64; GROUPS],
}

fn sums(picture: &Picture, reference: &Reference) -> Sums {
    let [first, second] = reference.pair();
    let mut sums = Sums::default();
    let width = picture.width.max(1) as usize;
    for (i, p) in picture.colour.iter().enumerate() {
        // Neighbours are in different groups, in rows and columns.
        let group = (i % width + 13 * (i / width)) % GROUPS;
        let channels = p.to_array().into_iter().zip(first.colour[i].to_array());
        let others = second.colour[i].to_array().into_iter();
        let whole = reference.picture.colour[i].to_array();
        for (((p, a), b), r) in channels.zip(others).zip(whole) {
            let product = f64::from(p - a) * f64::from(p - b);
            if product.is_finite() {
                sums.plain[group] += product;
                sums.relative[group] += product / (f64::from(r).powi(2) + 0.01);
                sums.values[group] += 1.0;
            }
        }
    }
    sums
}

/// Sum over all groups but one.
fn without(sums: &[f64; GROUPS], group: Option<usize>) -> f64 {
    let left_out = group.map_or(0.0, |g| sums[g]);
    sums.iter().sum::<f64>() - left_out
}

impl Sums {
    fn mse(&self, without_group: Option<usize>) -> f64 {
        without(&self.plain, without_group) / without(&self.values, without_group).max(1.0)
    }
}

/// Mean squared error over pixels and channels, of a picture of the reference's size; with a rendered
/// reference it may come out below 0 where it is smaller than can be told.
pub(super) fn mse(picture: &Picture, reference: &Reference) -> f64 {
    sums(picture, reference).mse(None)
}

/// Judges all entries.
pub(super) fn judge(entries: &[Entry], references: &[Reference]) -> Result<Vec<Judged>> {
    let mut judged = Vec::new();
    let mut all_sums = Vec::new();
    for entry in entries {
        let reference = &references[entry.reference];
        let picture = entry.render.picture()?;
        let sums = sums(&picture, reference);
        let values = without(&sums.values, None).max(1.0);
        judged.push(Judged {
            sampler: entry.sampler,
            energy: entry.energy,
            label: entry.label(),
            reference: entry.reference,
            errors: errors(&reference.picture, &picture)?,
            mse: sums.mse(None),
            rel_mse: without(&sums.relative, None) / values,
            seconds: entry.render.seconds,
            samples: entry.render.samples,
            rejected_share: entry.render.scattered.rejected_share(),
            course: entry.course.clone(),
            efficiency: [f64::NAN; 2],
            z: distance(&picture, reference),
            picture,
        });
        all_sums.push((sums, pace_error(&entry.paces)));
    }
    for number in 0..references.len() {
        let own: Vec<usize> = (0..judged.len())
            .filter(|&i| judged[i].reference == number)
            .collect();
        let cost = |i: usize, group| all_sums[i].0.mse(group) * judged[i].seconds;
        let best = own
            .iter()
            .copied()
            .min_by(|&a, &b| cost(a, None).total_cmp(&cost(b, None)));
        let Some(best) = best else { continue };
        let found: Vec<(usize, [f64; 2])> = (own.iter())
            .map(|&i| {
                let ratio = |group| (cost(best, group) / cost(i, group)).ln();
                let paces = if i == best {
                    0.0
                } else {
                    all_sums[i].1.hypot(all_sums[best].1)
                };
                let error = jackknife(ratio).hypot(paces);
                let efficiency = ratio(None).exp();
                (i, [efficiency, efficiency * error])
            })
            .collect();
        for (i, efficiency) in found {
            judged[i].efficiency = efficiency;
        }
    }
    Ok(judged)
}

/// Standard error of an estimate that can be made without one group after the other.
fn jackknife(estimate: impl Fn(Option<usize>) -> f64) -> f64 {
    let each: Vec<f64> = (0..GROUPS).map(|g| estimate(Some(g))).collect();
    let mean = each.iter().sum::<f64>() / GROUPS as f64;
    let spread: f64 = each.iter().map(|e| (e - mean).powi(2)).sum();
    (spread * (GROUPS - 1) as f64 / GROUPS as f64).sqrt()
}

/// Standard error of the logarithm of the mean pace.
fn pace_error(paces: &[f64]) -> f64 {
    let n = paces.len() as f64;
    if n < 2.0 {
        return 0.0;
    }
    let logs: Vec<f64> = paces.iter().map(|p| p.ln()).collect();
    let mean = logs.iter().sum::<f64>() / n;
    let variance = logs.iter().map(|l| (l - mean).powi(2)).sum::<f64>() / (n - 1.0);
    (variance / n).sqrt()
}

/// Standard errors between the mean luminance of a picture and that of its reference.
fn distance(picture: &Picture, reference: &Reference) -> f64 {
    let n = picture.colour.len().max(1) as f64;
    let sum: f64 = picture
        .colour
        .iter()
        .map(|c| f64::from(c.luminance()))
        .sum();
    let variance: f64 = picture.variance.iter().map(variance_of_luminance).sum();
    let [mean, error] = reference.brightness();
    let error = error.hypot(variance.sqrt() / n);
    (sum / n - mean) / error.max(f64::MIN_POSITIVE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use specula_bsdf::Rgb;
    use specula_stat::Rng;

    fn noisy(deviation: f64, seed: u64) -> Picture {
        let mut rng = Rng::new(seed);
        // Uniform numbers have a variance of 1/12.
        let mut value = || 1.0 + deviation * 12.0_f64.sqrt() * (rng.uniform() - 0.5);
        #[expect(clippy::cast_possible_truncation, reason = "colours are f32")]
        let pixel = |_| Rgb::splat(value() as f32);
        Picture::from_colour(128, 128, (0..128 * 128).map(pixel).collect())
    }

    #[test]
    fn references_errors_drop_out() {
        let [a, b] = [noisy(0.5, 1), noisy(0.5, 2)];
        let reference = Reference {
            picture: a.clone(),
            halves: Some([a, b]),
            seconds: 1.0,
        };
        let found = mse(&noisy(0.1, 3), &reference);
        assert!((found - 0.01).abs() < 0.003, "{found}");
    }

    #[test]
    fn the_jackknife_knows_the_error_of_a_ratio() {
        let truth = Reference::given(noisy(0.0, 1));
        let ratio = |seed: u64| {
            let [a, b] = [
                sums(&noisy(0.2, seed), &truth),
                sums(&noisy(0.1, seed + 500), &truth),
            ];
            let log = |group| (a.mse(group) / b.mse(group)).ln();
            (log(None), jackknife(log))
        };
        let found: Vec<(f64, f64)> = (10..50).map(ratio).collect();
        let n = found.len() as f64;
        let mean = found.iter().map(|f| f.0).sum::<f64>() / n;
        let spread = (found.iter().map(|f| (f.0 - mean).powi(2)).sum::<f64>() / (n - 1.0)).sqrt();
        let told = found.iter().map(|f| f.1).sum::<f64>() / n;
        assert!((mean - 4.0_f64.ln()).abs() < 0.01, "{mean}");
        assert!((told / spread - 1.0).abs() < 0.35, "{told} for {spread}");
    }
}
