//! The test of rays against bilinear patches, in double precision.
//!
//! Reshetov 2019 ("Cool Patches: A Geometric Approach to Ray/Bilinear Patch Intersections", Ray Tracing Gems, chapter
//! 8), seen along the ray: corners are sheared as those of triangles are ([`super::triangle`]), so that the ray becomes
//! the axis z.
//!
//! ```text
//! A(u) = (1 - u) p00 + u p10,   B(u) = (1 - u) p01 + u p11                    the ends of the line at u
//! Ax By - Ay Bx = 0:   a u^2 + b u + c = 0                                    the line meets the ray
//! c = p00 x p01,   a + b + c = p10 x p11,   a = (p10 - p00) x (p11 - p01)
//! v = -A . (B - A) / |B - A|^2,   t = ((1 - v) Az + v Bz) / dz
//! ```
//!
//! Both roots come from `q` and `c / q`, neither of which cancels. The equation for v, with corners exchanged, has the
//! same discriminant. The first `t` above 0 is the hit.
//!
//! - A vertex is sheared by the same operations whichever patch it is part of.
//! - What lies within [`BEYOND`] of an edge is on the patch, and is moved to the edge. Neighbours overlap by more than
//!   the rounding of `u` and `v`, also of a double root, where the ray touches the patch: no ray leaks between them.
//! - Parallelograms have `a = 0`, up to rounding: one root is the hit, the other is far away or not a number.
//! - A ray that passes as near to a corner hits it. Where two corners are one, all lines meet there, or one has no
//!   length, and the roots say nothing.
//! - Comparisons with what is not a number fail: such roots are no hits.

use specula_bsdf::Real;

use super::triangle::{self, PAD};
use super::{Bounds, Ray};

/// How far beyond an edge a patch is hit, in `u` or `v`: the root of the rounding of doubles, and less than that of
/// coordinates.
const BEYOND: f64 = 1.0 / 67_108_864.0;

/// A patch, ready to be intersected.
#[derive(Clone, Copy, Debug)]
pub(super) struct PreparedPatch {
    /// `p00`, `p10`, `p01`, `p11`.
    corners: [[f32; 3]; 4],
    /// Index within the group.
    pub(super) primitive: u32,
}

/// Where a ray hits a patch or a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct UvHit {
    /// Not above 0 where it misses.
    pub(super) t: f32,
    /// In `[0, 1]`, as `v`.
    pub(super) u: f32,
    pub(super) v: f32,
}

impl UvHit {
    /// A miss.
    pub(super) const NONE: Self = Self {
        t: f32::NAN,
        u: 0.0,
        v: 0.0,
    };
}

/// The box of a patch that can be hit; `None` where it has no area or is not finite.
pub(super) fn bounds(corners: &[[f32; 3]; 4]) -> Option<Bounds> {
    let [a, b, c, d] = *corners;
    let any = [[a, b, c], [a, b, d], [a, c, d], [b, c, d]];
    let spans = any.iter().any(triangle::has_area);
    let is_finite = corners.iter().flatten().all(|x| x.is_finite());
    (spans && is_finite).then(|| Bounds::around(corners).padded(PAD))
}

impl PreparedPatch {
    pub(super) fn new(corners: [[f32; 3]; 4], primitive: u32) -> Self {
        Self { corners, primitive }
    }

    /// The first hit of a ray.
    ///
    /// * `axes`: of the ray's direction, the greatest last.
    ///
    /// Cold, so that the traversal keeps its registers for triangles.
    #[cold]
    #[inline(never)]
    pub(super) fn hit(&self, ray: &Ray, axes: [u8; 3]) -> UvHit {
        let permuted = |p: [f32; 3]| axes.map(|axis| f64::from(p[usize::from(axis)]));
        let (o, d) = (
            permuted(ray.origin.to_array()),
            permuted(ray.direction.to_array()),
        );
        let scale = 1.0 / d[2];
        let shear = [d[0] * scale, d[1] * scale];
        let sheared = self.corners.map(|p| {
            let p = permuted(p);
            let z = p[2] - o[2];
            [
                (p[0] - o[0]) - shear[0] * z,
                (p[1] - o[1]) - shear[1] * z,
                z,
            ]
        });
        first_hit(sheared, scale)
    }
}

/// The first hit above z = 0 on the axis z.
///
/// * `scale`: `t` over z.
fn first_hit([p00, p10, p01, p11]: [[f64; 3]; 4], scale: f64) -> UvHit {
    let mut first = UvHit::NONE;
    let mut offer = |uv: [f64; 2], z: f64| {
        let t = f32::of(z * scale);
        if t > 0.0 && (t < first.t || first.t.is_nan()) {
            let [u, v] = uv.map(f32::of);
            first = UvHit { t, u, v };
        }
    };
    let diagonals = [minus(p11, p00), minus(p10, p01)];
    let size = dot(diagonals[0], diagonals[0]) + dot(diagonals[1], diagonals[1]);
    let corners = [
        ([0.0, 0.0], p00),
        ([1.0, 0.0], p10),
        ([0.0, 1.0], p01),
        ([1.0, 1.0], p11),
    ];
    for (uv, p) in corners {
        if dot(p, p) <= BEYOND * BEYOND * size {
            offer(uv, p[2]);
        }
    }
    let (of_u, of_v) = (
        equation([p00, p10, p01, p11]),
        equation([p00, p01, p10, p11]),
    );
    // Those of both are equal; that of the lesser terms loses less by cancellation.
    let magnitude = |[a, b, c]: [f64; 3]| b * b + 4.0 * (a * c).abs();
    let [a, b, c] = if magnitude(of_v) < magnitude(of_u) {
        of_v
    } else {
        of_u
    };
    let discriminant = b * b - 4.0 * a * c;
    let [a, b, c] = of_u;
    // Not a number where there is no root.
    let q = -0.5 * (b + discriminant.sqrt().copysign(b));
    for u in [q / a, c / q] {
        let Some(u) = within(u) else { continue };
        let (from, to) = (mix(p00, p10, u), mix(p01, p11, u));
        let along = minus(to, from);
        let Some(v) = within(-dot(from, along) / dot(along, along)) else {
            continue;
        };
        offer([u, v], mix(from, to, v)[2]);
    }
    first
}

/// Coefficients `a`, `b`, `c` of the equation for u.
fn equation([p00, p10, p01, p11]: [[f64; 3]; 4]) -> [f64; 3] {
    let c = cross(p00, p01);
    let a = cross(minus(p10, p00), minus(p11, p01));
    [a, cross(p10, p11) - a - c, c]
}

/// A coordinate on the patch; `None` where it is beyond, or not a number.
fn within(x: f64) -> Option<f64> {
    (-BEYOND..=1.0 + BEYOND)
        .contains(&x)
        .then(|| x.clamp(0.0, 1.0))
}

fn cross(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// Across the axis z, as [`cross`].
fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Exact at both ends.
fn mix(a: [f64; 3], b: [f64; 3], x: f64) -> [f64; 3] {
    [0, 1, 2].map(|k: usize| (1.0 - x) * a[k] + x * b[k])
}
