//! The ray-triangle test, and why no ray leaks through a closed mesh.
//!
//! Woop, Benthin and Wald 2013 ("Watertight Ray/Triangle Intersection"), without its fallback to
//! double precision and without fused multiply-add:
//!
//! ```text
//! z = vz - oz,  x = (vx - ox) - sx z,  y = (vy - oy) - sy z       per vertex a, b, c
//! U = cx by - cy bx,  V = ax cy - ay cx,  W = bx ay - by ax,  det = U + V + W
//! hit where U, V, W have one sign (0 belongs to both) and det is not 0
//! t = (U az + V bz + W cz) / (det dz),  u = V / det,  v = W / det
//! ```
//!
//! The axes are permuted so that `dz` is the greatest component of the direction.
//!
//! - A vertex is sheared by the same operations whichever triangle it is part of, so all tests are
//!   about one projected mesh.
//! - Rounding is monotone: `cx by >= cy bx` implies the same of the rounded products. The sign of an
//!   edge function is therefore never reversed, at worst it is 0, which both sides count as inside;
//!   and exchanging an edge's vertices negates the function exactly. No point of the projected mesh
//!   is outside of all triangles. (Not covered: slivers for which all three functions round to 0.)
//! - The boxes must not cull what this test would hit. Sheared coordinates are off by at most
//!   `5 u (|h - o| + |e|)`, `h` being the point that is hit, `e` the triangle's extents, `u = 2^-24`.
//!   [`super::frame::SLACK`] covers the first part, [`PAD`] of the triangle's box the second.
//! - Triangles whose area is 0 are left out at build, since rounding can open them.

use super::Bounds;

/// By which fraction of the sum of its extents a triangle's box is padded: `8 u`.
pub(super) const PAD: f32 = 4.0 * f32::EPSILON;

/// The box of a triangle that can be hit; `None` where it has no area or is not finite.
pub(super) fn bounds(corners: &[[f32; 3]; 3]) -> Option<Bounds> {
    let [a, b, c] = corners.map(|p| p.map(f64::from));
    let e: [f64; 3] = std::array::from_fn(|i| b[i] - a[i]);
    let f: [f64; 3] = std::array::from_fn(|i| c[i] - a[i]);
    let n = [
        e[1] * f[2] - e[2] * f[1],
        e[2] * f[0] - e[0] * f[2],
        e[0] * f[1] - e[1] * f[0],
    ];
    let finite = corners.iter().flatten().all(|x| x.is_finite());
    (finite && n != [0.0; 3]).then(|| Bounds::around(corners).padded(PAD))
}

/// Whether a triangle can be hit.
pub(crate) fn has_area(corners: &[[f32; 3]; 3]) -> bool {
    bounds(corners).is_some()
}

/// `U, V, W` of sheared vertices.
///
/// This and the next two are the reference that the AVX2 kernel follows operation by operation.
#[inline(always)]
pub(super) fn edge_functions(a: [f32; 3], b: [f32; 3], c: [f32; 3]) -> [f32; 3] {
    [
        c[0] * b[1] - c[1] * b[0],
        a[0] * c[1] - a[1] * c[0],
        b[0] * a[1] - b[1] * a[0],
    ]
}

/// Whether the ray, or its backward extension, passes through the triangle.
#[inline(always)]
pub(super) fn inside([u, v, w]: [f32; 3]) -> bool {
    same_sign([u, v, w]) & ((u + v) + w != 0.0)
}

/// [`inside`] but for `det`, by which [`distance`] divides: where it is 0, there is no distance.
#[inline(always)]
pub(super) fn same_sign([u, v, w]: [f32; 3]) -> bool {
    let (lo, hi) = (min(u, min(v, w)), max(u, max(v, w)));
    (lo >= 0.0) | (hi <= 0.0)
}

/// Whether the triangle surely lies behind the ray or beyond its end, where the ray's line passes through it.
///
/// `q = det t` needs no division. Its rounding and that of `t` are below 16 u of `det farthest / dz`. Overflow decides
/// nothing.
///
/// * `farthest`: a bound on the absolute values of `z`.
#[inline(always)]
pub(super) fn is_apart(
    [u, v, w]: [f32; 3],
    z: [f32; 3],
    shear_z: f32,
    (t_max, farthest): (f32, f32),
) -> bool {
    const SLACK: f32 = 16.0 * f32::EPSILON;
    let det = (u + v) + w;
    let sum = ((u * z[0] + v * z[1]) + w * z[2]) * shear_z;
    let q = if det < 0.0 { -sum } else { sum };
    let det = det.abs();
    let slack = (det * (SLACK * farthest) + f32::MIN_POSITIVE) * shear_z.abs();
    let behind = (q < -slack) & (q > f32::MIN);
    let beyond = (q > t_max * (det * (1.0 + SLACK)) + slack) & (q < f32::MAX);
    behind | beyond
}

/// `(t, u, v)` from `U, V, W` and the vertices' sheared z; `shear_z` is `1 / dz`.
#[inline(always)]
pub(super) fn distance([u, v, w]: [f32; 3], z: [f32; 3], shear_z: f32) -> (f32, f32, f32) {
    // Divided one by one: the products with z, or 1 / det, may overflow.
    let det = (u + v) + w;
    let (u, v, w) = (u / det, v / det, w / det);
    let t = ((u * z[0] + v * z[1]) + w * z[2]) * shear_z;
    (t, v, w)
}

/// Shears one vertex along the ray.
#[inline(always)]
pub(super) fn shear(p: [f32; 3], origin: [f32; 3], shear: [f32; 3]) -> [f32; 3] {
    let z = p[2] - origin[2];
    [
        (p[0] - origin[0]) - shear[0] * z,
        (p[1] - origin[1]) - shear[1] * z,
        z,
    ]
}

/// The lesser; the second where either is NaN (as the instruction `minps` does).
#[inline(always)]
pub(super) fn min(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// The greater; the second where either is NaN (as the instruction `maxps` does).
#[inline(always)]
pub(super) fn max(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}
