//! The loops over pairs, compiled for the machine's vectors.

#![allow(
    clippy::needless_range_loop,
    reason = "an index below the arrays' length is what the compiler makes vectors of"
)]

use macro_rules_attribute::apply;
use specula_bsdf::Vec3;

use super::super::estimator;
use super::super::ray_queue::index;
use super::super::vertex_batch::{Floats, Vectors, WAVEFRONT_SIZE};
use super::Vertices;
use super::pairs::{LobeValues, Pairs};
use crate::simd::simd_levels;

/// Directions in the frames of vertices; zero where their sides of surface and frame differ.
///
/// * `n`: of the vertices.
#[apply(simd_levels)]
pub(super) fn to_local(n: usize, vertices: &Vertices, w: &Vectors, local: &mut Vectors) {
    for i in 0..n.min(WAVEFRONT_SIZE) {
        local.set(i, vertices.local(i, w.get(i)));
    }
}

/// Connects the two of each pair: geometry term, local directions, shadow ray.
///
/// * `wo`: towards the viewers of the `x`, local.
#[apply(simd_levels)]
pub(super) fn connect(x: &Vertices, y: &Vertices, wo: &Vectors, pairs: &mut Pairs) {
    for k in 0..pairs.count.min(WAVEFRONT_SIZE) {
        let (i, j) = (index(pairs.x[k]), index(pairs.y[k]));
        let (from, to) = (x.position.get(i), y.position.get(j));
        let own = (to - x.position.get(j)).length();
        // In units of the own distance: squares of lengths overflow.
        let between = (to - from) * (1.0 / own);
        let squared = between.dot(between);
        let direction = between * (1.0 / squared.sqrt());
        let cos = -y.facing.get(j).dot(direction);
        let is_pair = x.is_connectable(i, to, y.error[j])
            & (squared > 0.0)
            & (squared < f32::INFINITY)
            & (cos > 0.0);
        pairs.g[k] = if is_pair { cos / squared } else { 0.0 };
        pairs.wo_at_x.set(k, wo.get(i));
        pairs.wi_at_x.set(k, x.local(i, direction));
        pairs.wo_at_y.set(k, y.frame(j).to_local(-direction));
        let ray = estimator::shadow_ray(&x.point(i), direction, &y.point(j));
        pairs.origin.set(k, ray.origin);
        pairs.direction.set(k, ray.direction);
    }
}

/// Gathers vectors of pairs into an order.
#[apply(simd_levels)]
pub(super) fn gather(order: &[u32], from: &Vectors, to: &mut Vectors) {
    for l in 0..order.len().min(WAVEFRONT_SIZE) {
        to.set(l, from.get(index(order[l])));
    }
}

/// Gathers vectors of the paths of pairs into an order.
#[apply(simd_levels)]
pub(super) fn gather_by_path(
    order: &[u32],
    paths: &[u32; WAVEFRONT_SIZE],
    from: &Vectors,
    to: &mut Vectors,
) {
    for l in 0..order.len().min(WAVEFRONT_SIZE) {
        to.set(l, from.get(index(paths[index(order[l])])));
    }
}

/// Stores the values of lobes for the pairs.
///
/// * `wi`: the directions; zero is none.
/// * `(f, pdf)`: of the pairs.
#[apply(simd_levels)]
pub(super) fn store_values(
    order: &[u32],
    wi: &Vectors,
    values: &mut LobeValues,
    (f, pdf): (&mut Vectors, &mut Floats),
) {
    let n = order.len().min(WAVEFRONT_SIZE);
    for l in 0..n {
        let is_valid = (wi.get(l) != Vec3::ZERO) & (values.pdf[l] > 0.0);
        let or_zero = |v: f32| if is_valid { v } else { 0.0 };
        values.f.set_colour(l, values.f.colour(l).map(or_zero));
        values.pdf[l] = or_zero(values.pdf[l]);
    }
    for l in 0..n {
        let k = index(order[l]);
        f.set_colour(k, values.f.colour(l));
        pdf[k] = values.pdf[l];
    }
}

/// Densities of directions at the `x` as densities of the `y` in area measure.
///
/// * `throughput_to_x`: of the paths.
#[apply(simd_levels)]
pub(super) fn to_area_measure(throughput_to_x: &Vectors, pairs: &mut Pairs) {
    for k in 0..pairs.count.min(WAVEFRONT_SIZE) {
        let (g, f) = (pairs.g[k], pairs.f.colour(k));
        // Paths without throughput end, and never reach the point.
        let throughput = throughput_to_x.colour(index(pairs.x[k])) * f;
        let is_black = (throughput.r == 0.0) & (throughput.g == 0.0) & (throughput.b == 0.0);
        let continues = (g > 0.0) & !is_black;
        pairs.f.set_colour(k, f * g);
        pairs.p[k] = if continues { pairs.p[k] * g } else { 0.0 };
    }
}
