//! The loops over pairs, compiled for the machine's vectors.

#![allow(
    clippy::needless_range_loop,
    reason = "an index below the arrays' length is what the compiler makes vectors of"
)]

use multiversion::multiversion;
use specula_bsdf::Vec3;

use super::super::vertex_batch::{Column, Vectors, WAVEFRONT_SIZE};
use super::super::wavefront::index;
use super::Vertices;
use super::pairs::{Found, Pairs};

/// Directions in the frames of vertices; zero where they are on different sides of surface and frame.
///
/// * `n`: of the vertices.
#[multiversion(targets(
    "x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+avx2+fma+bmi1+bmi2",
    "x86_64+avx2+fma+bmi1+bmi2"
))]
pub(super) fn turn(n: usize, vertices: &Vertices, w: &Vectors, local: &mut Vectors) {
    for i in 0..n.min(WAVEFRONT_SIZE) {
        local.set(i, vertices.local(i, w.get(i)));
    }
}

/// What lies between the two of each pair.
///
/// * `wo`: towards the viewers of the `x`, local.
#[multiversion(targets(
    "x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+avx2+fma+bmi1+bmi2",
    "x86_64+avx2+fma+bmi1+bmi2"
))]
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
        let is_pair =
            x.is_far(i, to, y.error[j]) & (squared > 0.0) & (squared < f32::INFINITY) & (cos > 0.0);
        pairs.g[k] = if is_pair { cos / squared } else { 0.0 };
        pairs.at_x[0].set(k, wo.get(i));
        pairs.at_x[1].set(k, x.local(i, direction));
        pairs.back.set(k, y.frame(j).to_local(-direction));
        let origin = x.leave(i, direction);
        pairs.origin.set(k, origin);
        pairs.along.set(k, y.leave(j, -direction) - origin);
    }
}

/// Brings what pairs have into an order.
#[multiversion(targets(
    "x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+avx2+fma+bmi1+bmi2",
    "x86_64+avx2+fma+bmi1+bmi2"
))]
pub(super) fn bring(order: &[u32], from: &Vectors, to: &mut Vectors) {
    for l in 0..order.len().min(WAVEFRONT_SIZE) {
        to.set(l, from.get(index(order[l])));
    }
}

/// Brings what the paths of pairs have into an order.
#[multiversion(targets(
    "x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+avx2+fma+bmi1+bmi2",
    "x86_64+avx2+fma+bmi1+bmi2"
))]
pub(super) fn bring_of(
    order: &[u32],
    paths: &[u32; WAVEFRONT_SIZE],
    from: &Vectors,
    to: &mut Vectors,
) {
    for l in 0..order.len().min(WAVEFRONT_SIZE) {
        to.set(l, from.get(index(paths[index(order[l])])));
    }
}

/// Brings what lobes made of directions back to the pairs.
///
/// * `wi`: the directions; zero is none.
/// * `(f, pdf)`: of the pairs.
#[multiversion(targets(
    "x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+avx2+fma+bmi1+bmi2",
    "x86_64+avx2+fma+bmi1+bmi2"
))]
pub(super) fn hand_back(
    order: &[u32],
    wi: &Vectors,
    found: &mut Found,
    (f, pdf): (&mut Vectors, &mut Column),
) {
    let n = order.len().min(WAVEFRONT_SIZE);
    for l in 0..n {
        let there = (wi.get(l) != Vec3::ZERO) & (found.pdf[l] > 0.0);
        let keep = |v: f32| if there { v } else { 0.0 };
        found.f.set_colour(l, found.f.colour(l).map(keep));
        found.pdf[l] = keep(found.pdf[l]);
    }
    for l in 0..n {
        let k = index(order[l]);
        f.set_colour(k, found.f.colour(l));
        pdf[k] = found.pdf[l];
    }
}

/// Makes of the densities of directions at the `x` those of the `y`.
///
/// * `throughput`: of the paths, up to `x`.
#[multiversion(targets(
    "x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+avx2+fma+bmi1+bmi2",
    "x86_64+avx2+fma+bmi1+bmi2"
))]
pub(super) fn weigh(throughput: &Vectors, pairs: &mut Pairs) {
    for k in 0..pairs.count.min(WAVEFRONT_SIZE) {
        let (g, f) = (pairs.g[k], pairs.f.colour(k));
        // Paths that carry nothing end, and never reach the point.
        let carries = throughput.colour(index(pairs.x[k])) * f;
        let goes_on = (g > 0.0) & !((carries.r == 0.0) & (carries.g == 0.0) & (carries.b == 0.0));
        pairs.f.set_colour(k, f * g);
        pairs.p[k] = if goes_on { pairs.p[k] * g } else { 0.0 };
    }
}
