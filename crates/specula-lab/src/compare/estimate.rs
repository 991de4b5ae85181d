//! Errors of renders with their uncertainty, and efficiencies.
//!
//! With two references `r1`, `r2` whose errors are independent, the mean of `(p - r1) (p - r2)` is the
//! mean squared error of `p`, without that of the references. Its variance is
//! estimated by leaving out one group of pixels after the other (the jackknife): pixels are independent. Times
//! are uncertain by their differences between rounds; those of one round are compared, so that other load of
//! the machine cancels.

use specula_bsdf::vndf::Sampler;
use specula_render::picture::Picture;
use specula_scene::Energy;

use super::interval::{Estimate, Interval};
use super::reference::{Reference, variance_of_luminance};
use super::turns::{Entry, Round};
use crate::{Errors, Result, errors};

/// Groups of pixels.
const GROUPS: usize = 32;

/// The result of a combination.
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
    pub(super) rounds: Vec<Option<Round>>,
    /// Root of the mean squared error over time.
    pub(super) course: Vec<[f64; 2]>,
    /// How far the mean luminance is from the reference's, over the latter, and the standard error.
    pub(super) shift: [f64; 2],
}

/// The samplers of one treatment of energy against each other.
pub(super) struct Field {
    pub(super) energy: Energy,
    pub(super) samplers: Vec<Sampler>,
    /// Efficiency, `1 / (MSE x time)`, of the first index's over that of the second's. All intervals of a
    /// comparison hold together.
    pub(super) ratios: Vec<Vec<Interval>>,
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

/// Judges all entries: each by itself, and all of a treatment of energy against each other.
pub(super) fn judge(
    entries: &[Entry],
    references: &[Reference],
) -> Result<(Vec<Judged>, Vec<Field>)> {
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
            rounds: entry.rounds.clone(),
            course: entry.course.clone(),
            shift: shift(&picture, reference),
            picture,
        });
        all_sums.push(sums);
    }
    let own = |number: usize| (0..judged.len()).filter(move |&i| entries[i].reference == number);
    let pairs = |number: usize| {
        let n = own(number).count();
        n * n.saturating_sub(1) / 2
    };
    let intervals = (0..references.len()).map(pairs).sum();
    let fields = (0..references.len()).filter_map(|number| {
        let all: Vec<usize> = own(number).collect();
        let ratio = |a: usize, b: usize| {
            let errors = [&all_sums[a], &all_sums[b]];
            ratio([&judged[a], &judged[b]], errors)
                .interval(intervals)
                .exp()
        };
        Some(Field {
            energy: judged[*all.first()?].energy,
            samplers: all.iter().map(|&i| judged[i].sampler).collect(),
            ratios: square(all.len(), |a, b| ratio(all[a], all[b])),
        })
    });
    let fields = fields.collect();
    Ok((judged, fields))
}

/// A figure for every pair; below the diagonal it is one over that above.
pub(super) fn square(count: usize, above: impl Fn(usize, usize) -> Interval) -> Vec<Vec<Interval>> {
    let one = Interval {
        middle: 1.0,
        low: 1.0,
        high: 1.0,
    };
    let figure = |a: usize, b: usize| match a.cmp(&b) {
        std::cmp::Ordering::Less => above(a, b),
        std::cmp::Ordering::Equal => one,
        std::cmp::Ordering::Greater => above(b, a).inverse(),
    };
    (0..count)
        .map(|a| (0..count).map(|b| figure(a, b)).collect())
        .collect()
}

/// Logarithm of the efficiency of the first over that of the second.
fn ratio([a, b]: [&Judged; 2], [errors_a, errors_b]: [&Sums; 2]) -> Estimate {
    // NaN where an error is smaller than the reference can tell.
    let log = |group| errors_b.mse(group).ln() - errors_a.mse(group).ln();
    let errors = Estimate {
        value: log(None),
        error: jackknife(log),
        freedom: (GROUPS - 1) as f64,
    };
    let paces = Estimate::of_mean(both_rounds(a, b).map(|[x, y]| (y.pace / x.pace).ln()));
    errors.plus(Estimate {
        // The errors are those after all the time.
        value: (b.seconds / a.seconds).ln(),
        ..paces
    })
}

/// The rounds in which both had a turn.
pub(super) fn both_rounds<'a>(
    a: &'a Judged,
    b: &'a Judged,
) -> impl Iterator<Item = [Round; 2]> + 'a {
    let pairs = a.rounds.iter().zip(&b.rounds);
    pairs.filter_map(|(x, y)| Some([(*x)?, (*y)?]))
}

/// Standard error of an estimate that can be made without one group after the other.
fn jackknife(estimate: impl Fn(Option<usize>) -> f64) -> f64 {
    let each: Vec<f64> = (0..GROUPS).map(|g| estimate(Some(g))).collect();
    let mean = each.iter().sum::<f64>() / GROUPS as f64;
    let spread: f64 = each.iter().map(|e| (e - mean).powi(2)).sum();
    (spread * (GROUPS - 1) as f64 / GROUPS as f64).sqrt()
}

/// How far the mean luminance of a picture is from that of its reference, over the latter, and the standard
/// error of that.
fn shift(picture: &Picture, reference: &Reference) -> [f64; 2] {
    let n = picture.colour.len().max(1) as f64;
    let sum: f64 = picture
        .colour
        .iter()
        .map(|c| f64::from(c.luminance()))
        .sum();
    let variance: f64 = picture.variance.iter().map(variance_of_luminance).sum();
    let [mean, error] = reference.brightness();
    let error = error.hypot(variance.sqrt() / n);
    let scale = mean.abs().max(f64::MIN_POSITIVE);
    [(sum / n - mean) / scale, error / scale]
}

#[cfg(test)]
mod tests {
    use super::*;
    use specula_bsdf::Rgb;
    use specula_stat::Rng;

    fn noisy(deviation: f64, seed: u64) -> Picture {
        let mut rng = Rng::new(seed);
        // Uniform random numbers have a variance of 1/12.
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
