//! `lobes.slice` and `lobes.grid`: values and densities over directions.
//!
//! In double precision, without Dirac deltas. Where a lobe is stochastic, a value is the mean of several estimates,
//! each with random numbers of its own; the density is never random.

use std::f64::consts::PI;

use serde_json::json;
use specula_bsdf::batch::{Colours, Directions, LobeBatches};
use specula_bsdf::bsdf::Lobe;
use specula_bsdf::math::{Real, vec3};
use specula_bsdf::{Transport, Vec3};

use crate::fields::{Fields, MOST_SAMPLES, wrong};
use crate::{Answer, AskError};

/// Estimates of a value, where none are asked for.
const ESTIMATES: u32 = 16;
/// Most directions of a slice.
const LONGEST_SLICE: u32 = 4096;
/// Most rows and columns of a grid.
const LARGEST_GRID: [u32; 2] = [512, 1024];

/// A plane through the normal: `theta` from -pi to pi, both ends included.
pub(super) fn slice(mut fields: Fields) -> Result<Answer, AskError> {
    let lobe = super::lobe(&mut fields)?;
    let wo = fields.direction("wo")?;
    let azimuth = fields.number("azimuth")?;
    let count = fields.count("count", 2, LONGEST_SLICE)?;
    let estimates = Estimates::of(&mut fields, count)?;
    fields.end()?;

    let (sin_phi, cos_phi) = azimuth.sin_cos();
    let thetas: Vec<f64> = steps(-PI, PI, count).collect();
    let directions = thetas.iter().map(|theta| {
        let (sin, cos) = theta.sin_cos();
        vec3(sin * cos_phi, sin * sin_phi, cos)
    });
    let (f_cos, pdf) = estimates.values(lobe.double(), wo, directions.collect());
    let n = thetas.len();
    Ok(Answer::new(json!({}))
        .with_f32("theta", &[n], &narrow(&thetas))
        .with_f32("f_cos", &[n, 3], &f_cos)
        .with_f32("pdf", &[n], &pdf))
}

/// All directions: rows in theta from the normal on, columns in phi from 0 to 2 pi, ends included.
pub(super) fn grid(mut fields: Fields) -> Result<Answer, AskError> {
    let lobe = super::lobe(&mut fields)?;
    let wo = fields.direction("wo")?;
    let rows = fields.count("rows", 2, LARGEST_GRID[0])?;
    let columns = fields.count("columns", 2, LARGEST_GRID[1])?;
    let is_sphere = fields.flag("sphere")?;
    let estimates = if lobe.is_stochastic() {
        Estimates::of(&mut fields, rows * columns)?
    } else {
        Estimates::of(&mut fields, 1)?
    };
    fields.end()?;

    let last = if is_sphere { PI } else { 0.5 * PI };
    let thetas: Vec<f64> = steps(0.0, last, rows).collect();
    let phis: Vec<f64> = steps(0.0, 2.0 * PI, columns).collect();
    let mut directions = Vec::with_capacity(thetas.len() * phis.len());
    for theta in &thetas {
        let (sin_theta, cos_theta) = theta.sin_cos();
        for phi in &phis {
            let (sin_phi, cos_phi) = phi.sin_cos();
            directions.push(vec3(sin_theta * cos_phi, sin_theta * sin_phi, cos_theta));
        }
    }
    let (f_cos, pdf) = estimates.values(lobe.double(), wo, directions);
    let (rows, columns) = (thetas.len(), phis.len());
    Ok(Answer::new(json!({}))
        .with_f32("theta", &[rows], &narrow(&thetas))
        .with_f32("phi", &[columns], &narrow(&phis))
        .with_f32("f_cos", &[rows, columns, 3], &f_cos)
        .with_f32("pdf", &[rows, columns], &pdf))
}

/// `count` numbers from one end to the other, both included.
fn steps(first: f64, last: f64, count: u32) -> impl Iterator<Item = f64> {
    let step = (last - first) / f64::from(count - 1);
    (0..count).map(move |i| {
        if i + 1 == count {
            last
        } else {
            first + step * f64::from(i)
        }
    })
}

fn narrow(values: &[f64]) -> Vec<f32> {
    values.iter().map(|x| f32::of(*x)).collect()
}

/// How often a random value is estimated, and with which random numbers.
struct Estimates {
    samples: u32,
    seed: u64,
}

impl Estimates {
    /// The fields `samples` and `seed`, for so many values.
    fn of(fields: &mut Fields, values: u32) -> Result<Self, AskError> {
        let samples = fields.count_or("samples", ESTIMATES, [1, MOST_SAMPLES])?;
        let most = MOST_SAMPLES / values.max(1);
        if samples > most.max(1) && samples != ESTIMATES {
            let expected = format!("at most {} for {values} directions", most.max(1));
            return Err(wrong("samples", &expected, &samples));
        }
        let seed = fields.seed()?;
        Ok(Self { samples, seed })
    }

    /// `f cos` and the density at each direction.
    fn values(&self, lobe: &Lobe<f64>, wo: Vec3<f64>, wi: Vec<Vec3<f64>>) -> (Vec<f32>, Vec<f32>) {
        use specula_bsdf::Bsdf;
        let n = wi.len();
        let samples = if lobe.is_stochastic() {
            self.samples
        } else {
            1
        };
        let wo: Directions<Vec<f64>> = wi.iter().map(|_| wo).collect();
        let wi: Directions<Vec<f64>> = wi.into_iter().collect();
        let (mut sums, mut pdf) = (vec![[0.0_f64; 3]; n], vec![0.0; n]);
        let mut f_cos = Colours::zeroed(n);
        for i in 0..samples {
            // Seeds are below 2^53, estimates few: no two meet.
            let seed = self.seed.wrapping_mul(0x9e37_79b9).wrapping_add(i.into());
            let batches = LobeBatches::new(lobe, Transport::Radiance, seed);
            let (wo, wi) = (wo.as_slices(), wi.as_slices());
            let done = batches.eval_pdf(0, wo, wi, f_cos.as_mut_slices(), &mut pdf);
            debug_assert!(done.is_ok(), "{done:?}");
            for (sum, ((r, g), b)) in sums
                .iter_mut()
                .zip(f_cos.r.iter().zip(&f_cos.g).zip(&f_cos.b))
            {
                for (sum, channel) in sum.iter_mut().zip([r, g, b]) {
                    *sum += channel;
                }
            }
        }
        let scale = 1.0 / f64::from(samples);
        let means = sums.iter().flatten().map(|sum| f32::of(sum * scale));
        (means.collect(), narrow(&pdf))
    }
}
