//! Many directions of an environment light at once: what `Environment` does for one, in loops over a batch.
//!
//! Loops without look-ups become vectors; pixels are gathered four values at a time. The table is searched level
//! by level for the whole batch, so that cache misses overlap.

#![allow(
    clippy::needless_range_loop,
    reason = "an index below the arrays' length is what the compiler makes vectors of"
)]

use macro_rules_attribute::apply;
use specula_bsdf::Rgb;
use specula_bsdf::math::rgb;
use specula_scene::scene::EnvironmentMapping;

use super::Environment;
use super::picture::{Picture, direction_and_sine, mix, uv_and_sine};
use crate::convert::Affine;
use crate::simd::simd_levels;
use crate::soa;

/// Directions of a batch.
pub(in super::super) const BATCH_SIZE: usize = 64;

type Floats = soa::Floats<BATCH_SIZE>;
type Indices = soa::Column<u32, BATCH_SIZE>;
type Vectors = soa::Vectors<BATCH_SIZE>;

/// Directions, with intermediate values.
pub(in super::super) struct DirectionBatch {
    /// Random numbers; then positions of points within their cells.
    pub(in super::super) u: [Floats; 2],
    cell: [Indices; 2],
    /// Sampling weights at the corners of the cell.
    strengths: [Floats; 4],
    uv: [Floats; 2],
    pub(in super::super) direction: Vectors,
    sine: Floats,
    pub(in super::super) radiance: Vectors,
    /// Sampling weight.
    strength: Floats,
    /// Density over the sampling weight; then the density in 1/sr.
    pub(in super::super) pdf: Floats,
}

impl DirectionBatch {
    pub(in super::super) const ZERO: Self = Self {
        u: [Floats::of(0.0); 2],
        cell: [Indices::of(0); 2],
        strengths: [Floats::of(0.0); 4],
        uv: [Floats::of(0.0); 2],
        direction: Vectors::ZERO,
        sine: Floats::of(0.0),
        radiance: Vectors::ZERO,
        strength: Floats::of(0.0),
        pdf: Floats::of(0.0),
    };
}

impl Environment {
    /// Whether it is an image: only those are sampled in batches.
    pub(in super::super) fn is_image(&self) -> bool {
        self.picture.is_some()
    }

    /// [`Environment::sample`] of the first `n` elements, with their `u`; density 0 where there is no sample.
    pub(in super::super) fn sample_all(&self, n: usize, batch: &mut DirectionBatch) {
        if let Some(picture) = &self.picture {
            sample_directions(n, picture, &self.to_world, self.radiance, batch);
        }
    }

    /// Radiance and density of the first `n` directions: [`Environment::arriving`] of each.
    pub(in super::super) fn arriving_all(&self, n: usize, batch: &mut DirectionBatch) {
        if let Some(picture) = &self.picture {
            evaluate_directions(n, picture, &self.to_light, self.radiance, batch);
        }
    }
}

#[apply(simd_levels)]
fn sample_directions(
    n: usize,
    p: &Picture,
    to_world: &Affine,
    factor: Rgb<f32>,
    l: &mut DirectionBatch,
) {
    let n = n.min(BATCH_SIZE);
    p.table.sample_cells(n, &mut l.u, &mut l.cell);
    for i in 0..n {
        let corners = p.corners([l.cell[0][i], l.cell[1][i]]);
        for (strength, corner) in l.strengths.iter_mut().zip(corners) {
            strength[i] = corner[3];
        }
    }
    for i in 0..n {
        let cell = [l.cell[0][i], l.cell[1][i]];
        let [a, b, c, d] = &l.strengths;
        let u = [l.u[0][i], l.u[1][i]];
        let [x, y] = p.within(cell, [a[i], b[i], c[i], d[i]], u);
        (l.u[0][i], l.u[1][i]) = (x, y);
        l.uv[0][i] = p.axes[0].place(cell[0], x);
        l.uv[1][i] = p.axes[1].place(cell[1], y);
    }
    match p.mapping {
        EnvironmentMapping::EqualAreaOctahedral => {
            turn_to_world(n, EnvironmentMapping::EqualAreaOctahedral, to_world, l);
        }
        _ => turn_to_world(n, EnvironmentMapping::LatitudeLongitude, to_world, l),
    }
    interpolate(n, p, factor, l);
}

/// Directions, and sines, of the points of the square.
#[inline(always)]
fn turn_to_world(n: usize, mapping: EnvironmentMapping, to_world: &Affine, l: &mut DirectionBatch) {
    for i in 0..n {
        let (w, sine) = direction_and_sine(mapping, [l.uv[0][i], l.uv[1][i]]);
        let wi = to_world.vector(w).normalize();
        l.direction.set(i, wi);
        l.sine[i] = sine;
    }
}

#[apply(simd_levels)]
fn evaluate_directions(
    n: usize,
    p: &Picture,
    to_light: &Affine,
    factor: Rgb<f32>,
    l: &mut DirectionBatch,
) {
    let n = n.min(BATCH_SIZE);
    match p.mapping {
        EnvironmentMapping::EqualAreaOctahedral => {
            turn_to_light(n, EnvironmentMapping::EqualAreaOctahedral, to_light, l);
        }
        _ => turn_to_light(n, EnvironmentMapping::LatitudeLongitude, to_light, l),
    }
    for i in 0..n {
        let (cell, within) = p.cell_of([l.uv[0][i], l.uv[1][i]]);
        (l.cell[0][i], l.cell[1][i]) = (cell[0], cell[1]);
        (l.u[0][i], l.u[1][i]) = (within[0], within[1]);
    }
    interpolate(n, p, factor, l);
}

/// Points of the square, and sines, of the directions.
#[inline(always)]
fn turn_to_light(n: usize, mapping: EnvironmentMapping, to_light: &Affine, l: &mut DirectionBatch) {
    for i in 0..n {
        let w = to_light.vector(l.direction.get(i)).normalize();
        let (uv, sine) = uv_and_sine(mapping, w);
        (l.uv[0][i], l.uv[1][i]) = (uv[0], uv[1]);
        l.sine[i] = sine;
    }
}

/// The picture within the cells, and the density.
#[inline(always)]
fn interpolate(n: usize, p: &Picture, factor: Rgb<f32>, l: &mut DirectionBatch) {
    for i in 0..n {
        let (x, y) = (l.cell[0][i], l.cell[1][i]);
        let corners = p.corners([x, y]);
        let [r, g, b, strength] = mix(&corners, [l.u[0][i], l.u[1][i]]);
        l.radiance.set_colour(i, rgb(r, g, b));
        l.strength[i] = strength;
        l.pdf[i] = p.density(y);
    }
    for i in 0..n {
        l.radiance.set_colour(i, l.radiance.colour(i) * factor);
        l.pdf[i] = Picture::pdf(l.strength[i], l.pdf[i], l.sine[i]);
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{MAPPINGS, sky};
    use super::*;
    use crate::sampler::Sampler;

    fn same(a: f32, b: f32) -> bool {
        (a - b).abs() <= 1e-5 * a.abs().max(b.abs())
    }

    /// Batches and single directions, sampled and evaluated, with random numbers at the ends of their range too.
    #[test]
    fn batches_do_what_is_done_for_one() {
        for mapping in MAPPINGS {
            let sky = sky(mapping, true);
            let mut batch = DirectionBatch::ZERO;
            for first in (0..1000).step_by(BATCH_SIZE) {
                // Not a multiple of any vector's length.
                let n = BATCH_SIZE - 5;
                for i in 0..n {
                    let sample = first + crate::convert::id(i);
                    let u = Sampler::new([sample, 4], 0, 7).scatter(0);
                    let end = 1.0 - f32::EPSILON / 2.0;
                    batch.u[0][i] = if sample % 37 == 3 { 0.0 } else { u[0] };
                    batch.u[1][i] = if sample % 41 == 5 { end } else { u[1] };
                }
                let u = batch.u;
                sky.sample_all(n, &mut batch);
                for i in 0..n {
                    let Some((wi, radiance, pdf)) = sky.sample([u[0][i], u[1][i]]) else {
                        assert_eq!(batch.pdf[i], 0.0);
                        continue;
                    };
                    assert!(same(batch.pdf[i], pdf), "{mapping:?}: {pdf}");
                    assert!((batch.direction.get(i) - wi).length() < 1e-6);
                    let c = batch.radiance.colour(i);
                    assert!(
                        same(c.r, radiance.r) && same(c.g, radiance.g) && same(c.b, radiance.b)
                    );
                }
                sky.arriving_all(n, &mut batch);
                for i in 0..n {
                    let (radiance, pdf) = sky.arriving(batch.direction.get(i));
                    assert!(same(batch.pdf[i], pdf), "{mapping:?}: {pdf}");
                    let c = batch.radiance.colour(i);
                    assert!(
                        same(c.r, radiance.r) && same(c.g, radiance.g) && same(c.b, radiance.b)
                    );
                }
            }
        }
    }
}
