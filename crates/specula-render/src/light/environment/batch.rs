//! Many directions of an infinite light at once: what `Environment` does for one, in loops over batches.
//!
//! Loops without look-ups become vectors; pixels are gathered four values at a time. The table is
//! searched level by level for all batches, so that their misses of the cache overlap.

#![allow(
    clippy::needless_range_loop,
    reason = "an index below the arrays' length is what the compiler makes vectors of"
)]

use multiversion::multiversion;
use specula_bsdf::math::{rgb, vec3};
use specula_bsdf::{Rgb, Vec3};
use specula_scene::scene::EnvironmentMapping;

use super::Environment;
use super::picture::{Picture, direction_and_sine, mix, uv_and_sine};
use crate::convert::Affine;

/// Directions at once.
pub(in super::super) const LANES: usize = 64;

type Column = [f32; LANES];

/// Directions side by side, with all that is known of them on the way.
pub(in super::super) struct Bundle {
    /// Random numbers to sample by; then where in its cell a point lies.
    pub(in super::super) u: [Column; 2],
    cell: [[u32; LANES]; 2],
    /// What is sampled by at the corners of the cell.
    strengths: [Column; 4],
    uv: [Column; 2],
    direction: [Column; 3],
    sine: Column,
    radiance: [Column; 3],
    /// What is sampled by.
    strength: Column,
    /// What that becomes a density with; then the density in 1/sr.
    pub(in super::super) pdf: Column,
}

impl Bundle {
    pub(in super::super) const ZERO: Self = Self {
        u: [[0.0; LANES]; 2],
        cell: [[0; LANES]; 2],
        strengths: [[0.0; LANES]; 4],
        uv: [[0.0; LANES]; 2],
        direction: [[0.0; LANES]; 3],
        sine: [0.0; LANES],
        radiance: [[0.0; LANES]; 3],
        strength: [0.0; LANES],
        pdf: [0.0; LANES],
    };

    #[inline(always)]
    pub(in super::super) fn direction(&self, i: usize) -> Vec3<f32> {
        let [x, y, z] = &self.direction;
        vec3(x[i], y[i], z[i])
    }

    #[inline(always)]
    pub(in super::super) fn set_direction(&mut self, i: usize, w: Vec3<f32>) {
        self.direction[0][i] = w.x;
        self.direction[1][i] = w.y;
        self.direction[2][i] = w.z;
    }

    #[inline(always)]
    pub(in super::super) fn radiance(&self, i: usize) -> Rgb<f32> {
        let [r, g, b] = &self.radiance;
        rgb(r[i], g[i], b[i])
    }
}

impl Environment {
    /// Whether it is a picture: only those are done many at once.
    pub(in super::super) fn is_picture(&self) -> bool {
        self.picture.is_some()
    }

    /// The first `n` directions as [`Environment::sample`] draws them by their `u`; density 0 where it
    /// draws none.
    pub(in super::super) fn sample_all(&self, n: usize, bundle: &mut Bundle) {
        if let Some(picture) = &self.picture {
            draw(n, picture, &self.to_world, self.radiance, bundle);
        }
    }

    /// Radiance and density of the first `n` directions: [`Environment::arriving`] of each.
    pub(in super::super) fn arriving_all(&self, n: usize, bundle: &mut Bundle) {
        if let Some(picture) = &self.picture {
            look_up(n, picture, &self.to_light, self.radiance, bundle);
        }
    }
}

#[multiversion(targets(
    "x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+avx2+fma+bmi1+bmi2",
    "x86_64+avx2+fma+bmi1+bmi2"
))]
fn draw(n: usize, p: &Picture, to_world: &Affine, factor: Rgb<f32>, l: &mut Bundle) {
    let n = n.min(LANES);
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

/// Directions and sines of the points of the square.
#[inline(always)]
fn turn_to_world(n: usize, mapping: EnvironmentMapping, to_world: &Affine, l: &mut Bundle) {
    for i in 0..n {
        let (w, sine) = direction_and_sine(mapping, [l.uv[0][i], l.uv[1][i]]);
        let wi = to_world.vector(w).normalize();
        l.set_direction(i, wi);
        l.sine[i] = sine;
    }
}

#[multiversion(targets(
    "x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+avx2+fma+bmi1+bmi2",
    "x86_64+avx2+fma+bmi1+bmi2"
))]
fn look_up(n: usize, p: &Picture, to_light: &Affine, factor: Rgb<f32>, l: &mut Bundle) {
    let n = n.min(LANES);
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
fn turn_to_light(n: usize, mapping: EnvironmentMapping, to_light: &Affine, l: &mut Bundle) {
    for i in 0..n {
        let w = to_light.vector(l.direction(i)).normalize();
        let (uv, sine) = uv_and_sine(mapping, w);
        (l.uv[0][i], l.uv[1][i]) = (uv[0], uv[1]);
        l.sine[i] = sine;
    }
}

/// The picture within the cells, and the density.
#[inline(always)]
fn interpolate(n: usize, p: &Picture, factor: Rgb<f32>, l: &mut Bundle) {
    for i in 0..n {
        let (x, y) = (l.cell[0][i], l.cell[1][i]);
        let corners = p.corners([x, y]);
        let [r, g, b, strength] = mix(&corners, [l.u[0][i], l.u[1][i]]);
        l.radiance[0][i] = r;
        l.radiance[1][i] = g;
        l.radiance[2][i] = b;
        l.strength[i] = strength;
        l.pdf[i] = p.density(y);
    }
    for i in 0..n {
        let c = l.radiance(i) * factor;
        (l.radiance[0][i], l.radiance[1][i], l.radiance[2][i]) = (c.r, c.g, c.b);
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
    fn lanes_do_what_is_done_for_one() {
        for mapping in MAPPINGS {
            let sky = sky(mapping, true);
            let mut bundle = Bundle::ZERO;
            for first in (0..1000).step_by(LANES) {
                // Not a multiple of any vector's length.
                let n = LANES - 5;
                for i in 0..n {
                    let sample = first + crate::convert::id(i);
                    let u = Sampler::new([sample, 4], 0, 7).scatter(0);
                    let end = 1.0 - f32::EPSILON / 2.0;
                    bundle.u[0][i] = if sample % 37 == 3 { 0.0 } else { u[0] };
                    bundle.u[1][i] = if sample % 41 == 5 { end } else { u[1] };
                }
                let u = bundle.u;
                sky.sample_all(n, &mut bundle);
                for i in 0..n {
                    let Some((wi, radiance, pdf)) = sky.sample([u[0][i], u[1][i]]) else {
                        assert_eq!(bundle.pdf[i], 0.0);
                        continue;
                    };
                    assert!(same(bundle.pdf[i], pdf), "{mapping:?}: {pdf}");
                    assert!((bundle.direction(i) - wi).length() < 1e-6);
                    let c = bundle.radiance(i);
                    assert!(
                        same(c.r, radiance.r) && same(c.g, radiance.g) && same(c.b, radiance.b)
                    );
                }
                sky.arriving_all(n, &mut bundle);
                for i in 0..n {
                    let (radiance, pdf) = sky.arriving(bundle.direction(i));
                    assert!(same(bundle.pdf[i], pdf), "{mapping:?}: {pdf}");
                    let c = bundle.radiance(i);
                    assert!(
                        same(c.r, radiance.r) && same(c.g, radiance.g) && same(c.b, radiance.b)
                    );
                }
            }
        }
    }
}
