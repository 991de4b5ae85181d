//! `samplers.histogram`: samples on the unit disk against the quadrature of the density.

use serde_json::json;
use specula_bsdf::math::{Real, Stream};
use specula_bsdf::vndf::{Reflections, Sampler};
use statrs::function::gamma::gamma_ur;

use super::cells::{Cell, Cells};
use super::{Surface, sampler};
use crate::fields::{Fields, MOST_SAMPLES};
use crate::{Answer, AskError};

/// Most cells along a side.
const LARGEST: u32 = 256;

/// Counts and expected counts; rows from y = 1 down.
pub(super) fn histogram(mut fields: Fields) -> Result<Answer, AskError> {
    let sampler = sampler(&mut fields)?;
    let surface = Surface::of(&mut fields)?;
    let size = fields.count("size", 2, LARGEST)?;
    let count = fields.count("count", 1, MOST_SAMPLES)?;
    let seed = fields.seed()?;
    fields.end()?;

    let histogram = Histogram::new(&surface, [sampler, sampler], size, count, seed);
    let fit = histogram.chi_square();
    let value = json!({
        "rejected": histogram.rejected,
        "expectedRejected": histogram.expected_rejected,
        "chiSquare": fit.statistic,
        "degrees": fit.degrees,
        "p": fit.p,
    });
    let narrow = |values: &[f64]| -> Vec<f32> { values.iter().map(|x| f32::of(*x)).collect() };
    let n = histogram.size;
    Ok(Answer::new(value)
        .with_f32("counts", &[n, n], &narrow(&histogram.counts))
        .with_f32("expected", &[n, n], &narrow(&histogram.expected)))
}

struct Histogram {
    size: usize,
    counts: Vec<f64>,
    expected: Vec<f64>,
    rejected: u32,
    expected_rejected: f64,
}

impl Histogram {
    /// Samples of the first sampler against the density of the second.
    fn new(
        surface: &Surface,
        [sampled, claimed]: [Sampler; 2],
        size: u32,
        count: u32,
        seed: u64,
    ) -> Self {
        let edge = |i: u32| 2.0 * f64::from(i) / f64::from(size) - 1.0;
        let expected = expected(&surface.reflections(claimed), surface, size, count);
        let missing = f64::from(count) - expected.iter().sum::<f64>();
        let cells = usize::try_from(size).unwrap_or(0);
        let mut counts = vec![0.0; expected.len()];
        let mut rejected = 0;
        let mut stream = Stream::new(seed);
        let reflections = surface.reflections(sampled);
        let place = |x: f64| {
            // The number of edges at or below.
            let guess = (0.5 * (x + 1.0) * f64::from(size)).floor();
            let guess = guess.clamp(0.0, f64::from(size - 1));
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "in [0, size)"
            )]
            let i = guess as u32;
            // Rounding may put it on the other side of an edge.
            let i = if x < edge(i) { i.saturating_sub(1) } else { i };
            usize::try_from(i).unwrap_or(0)
        };
        for _ in 0..count {
            match reflections.sample([stream.next(), stream.next()]) {
                Some(wi) => counts[(cells - 1 - place(wi.y)) * cells + place(wi.x)] += 1.0,
                None => rejected += 1,
            }
        }
        Self {
            size: cells,
            counts,
            expected,
            rejected,
            expected_rejected: missing.max(0.0),
        }
    }

    /// Pearson's test, the rejected samples a cell of their own. Cells that expect fewer than five are pooled; where
    /// the pool does, too, it joins the least of the others.
    fn chi_square(&self) -> Fit {
        let rejected = (f64::from(self.rejected), self.expected_rejected);
        let cells = self
            .counts
            .iter()
            .copied()
            .zip(self.expected.iter().copied());
        let (mut kept, mut pool) = (Vec::new(), (0.0, 0.0));
        for (observed, expected) in cells.chain([rejected]) {
            if expected < 5.0 {
                pool = (pool.0 + observed, pool.1 + expected);
            } else {
                kept.push((observed, expected));
            }
        }
        if pool.1 >= 5.0 {
            kept.push(pool);
        } else if let Some(least) = kept.iter_mut().min_by(|a, b| a.1.total_cmp(&b.1)) {
            *least = (least.0 + pool.0, least.1 + pool.1);
        }
        let term = |(observed, expected): &(f64, f64)| (observed - expected).powi(2) / expected;
        let statistic: f64 = kept.iter().map(term).sum();
        let degrees = kept.len().saturating_sub(1);
        let p = match u32::try_from(degrees) {
            Ok(0) | Err(_) => 1.0,
            Ok(degrees) => gamma_ur(0.5 * f64::from(degrees), 0.5 * statistic.max(1e-300)),
        };
        Fit {
            statistic,
            degrees,
            p,
        }
    }
}

struct Fit {
    statistic: f64,
    degrees: usize,
    p: f64,
}

/// Expected counts of all cells.
fn expected(reflections: &Reflections<f64>, surface: &Surface, size: u32, count: u32) -> Vec<f64> {
    let wo = surface.wo;
    // Above, the lobe is about the mirror direction; below, only nearly vertical facets are seen, and light goes
    // nearly straight on.
    let peak = [-wo.x, -wo.y];
    let alpha = surface.alpha.x.min(surface.alpha.y);
    let width = alpha * wo.z.abs().max(alpha);
    // A tenth of the deviation of a count that is just worth a cell of its own, over some neighbours.
    let tolerance = 0.02 / f64::from(count);
    let cells = Cells::new(|wi| reflections.pdf(wi), peak, width, tolerance);
    let edge = |i: u32| 2.0 * f64::from(i) / f64::from(size) - 1.0;
    let mut expected = Vec::new();
    for row in (0..size).rev() {
        for column in 0..size {
            let x = [edge(column), edge(column + 1)];
            let y = [edge(row), edge(row + 1)];
            expected.push(f64::from(count) * cells.integral(Cell { x, y }));
        }
    }
    expected
}

#[cfg(test)]
mod tests {
    use super::*;
    use specula_bsdf::Alpha;
    use specula_bsdf::math::vec3;

    /// Samples of one sampler against the density of another: the test sees it.
    #[test]
    fn a_density_of_another_sampler_is_found_out() {
        let alpha = Alpha::isotropic(0.6);
        let surface = Surface {
            alpha,
            wo: vec3(0.6, 0.0, 0.8),
        };
        for (sampled, claimed) in [
            (Sampler::Cap, Sampler::Bounded),
            (Sampler::Exact, Sampler::Heitz),
            (Sampler::Bounded, Sampler::Exact),
        ] {
            let wrong = Histogram::new(&surface, [sampled, claimed], 32, 100_000, 1);
            let right = Histogram::new(&surface, [sampled, sampled], 32, 100_000, 1);
            let (wrong, right) = (wrong.chi_square().p, right.chi_square().p);
            assert!(wrong < 1e-6 && right > 1e-4, "{sampled}: {wrong} {right}");
        }
    }
}
