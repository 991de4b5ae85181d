//! The test of rays against curves, in double precision.
//!
//! Pharr, Jakob and Humphreys (Physically Based Rendering, 4th edition, 6.7) cut a curve into chords until these are
//! near enough to it, and test each. Here it is the curve itself, seen along the ray, which is the limit of their test:
//! the ray meets it at minima of the distance of at most half the width. With `q` the curve across the ray:
//!
//! ```text
//! q(s) . q'(s) = 0, from below:   g(s) = sum_k g_k B_k^5(s)
//! g_k = sum_{i + j = k} C(3, i) C(2, j) / C(5, k) q_i . 3 (q_{j+1} - q_j)
//! |q(s)| <= w(s) / 2,   of ribbons |n(s) . d| w(s) / 2,   t = z(s) / |d|
//! ```
//!
//! - Coefficients in Bernstein's basis change their signs at least as often as `g` has roots, by an even number
//!   (Descartes' rule). Intervals are halved until there is one change, which brackets one root, or none
//!   (Lane and Riesenfeld 1981, "Bounds on a Polynomial").
//! - A part of a segment is tested as the whole: parts overlap by [`BEYOND`], so that no ray leaks between them, and
//!   neither between segments that continue each other. At its ends a curve is cut off at right angles, as in pbrt-v4.
//! - A hit is a point of the ray within half the width of the centre line, and so within the box of its part.
//! - `v` grows towards `d x c'`, as in pbrt-v4, whichever side of a ribbon is seen.
//! - Comparisons with what is not a number fail: such roots are no hits.

use core::ops::{Add, Mul, Sub};

use glam::{DVec2, DVec3};
use specula_bsdf::Real;
use specula_scene::scene::ribbon_normal;

use super::patch::UvHit;
use super::triangle::PAD;
use super::{Bounds, Ray};
use crate::convert::{narrow, widen3};

/// How often segments are halved at most.
pub(super) const MOST_SPLITS: u32 = 3;
/// Segments are halved where the boxes of both halves have at most this share of the whole one's area. Measured.
const SPLIT: f64 = 0.75;
/// How far beyond the ends of its range a part is hit, in `u`.
const BEYOND: f64 = 1.0 / 67_108_864.0;
/// Intervals that are shorter have one root, whatever the signs say.
const SHORTEST: f64 = 1.0 / 1_048_576.0;
/// Intervals that are still to be checked: as many as halvings down to [`SHORTEST`], and one.
const WAITING: usize = 22;
/// Steps towards a root, which halve an interval at least.
const MOST_STEPS: usize = 50;
/// Where the search for a root ends, in parts of a range.
const ROOT: f64 = 1e-10;

/// A cubic Bezier segment whose width grows evenly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveSegment {
    /// Control points.
    pub controls: [[f32; 3]; 4],
    /// Width at both ends.
    pub width_at_ends: [f32; 2],
    /// What it looks like.
    pub shape: CurveShape,
}

/// What a segment looks like: see [`CurveKind`](specula_scene::scene::CurveKind).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CurveShape {
    /// It faces every ray.
    Flat,
    /// As [`Self::Flat`], with the normals of a cylinder.
    Cylinder,
    /// It has these unit normals at its ends.
    Ribbon([[f32; 3]; 2]),
}

/// A part of a segment, as a leaf of a tree.
#[derive(Clone, Copy, Debug)]
pub(super) struct CurvePart {
    /// Index of the segment.
    pub(super) curve: u32,
    /// Index within the group.
    pub(super) primitive: u32,
    /// Which part: 1 for the whole; those of part `i` are `2 i` and `2 i + 1`.
    pub(super) part: u32,
}

impl CurveSegment {
    fn points(&self) -> [DVec3; 4] {
        self.controls.map(|p| DVec3::from(p.map(f64::from)))
    }

    fn width(&self, u: f64) -> f64 {
        let [from, to] = self.width_at_ends.map(f64::from);
        (1.0 - u) * from + u * to
    }

    /// Appends the parts that it is tested by, with their boxes. None where it is not finite or has no extents.
    pub(super) fn parts(&self, add: &mut impl FnMut(Bounds, u32)) {
        let points = self.points();
        let is_finite = points.iter().all(|p| p.is_finite());
        let has_width = self
            .width_at_ends
            .iter()
            .all(|w| (0.0..f32::INFINITY).contains(w))
            && self.width_at_ends.iter().any(|w| *w > 0.0);
        let has_length = points[1..].iter().any(|p| *p != points[0]);
        if is_finite && has_width && has_length {
            self.split(1, self.bounds(1), add);
        }
    }

    fn split(&self, part: u32, bounds: Bounds, add: &mut impl FnMut(Bounds, u32)) {
        if part < 1 << MOST_SPLITS {
            let halves = [2 * part, 2 * part + 1].map(|half| (half, self.bounds(half)));
            let area: f64 = halves.iter().map(|(_, b)| b.half_area()).sum();
            if area <= SPLIT * bounds.half_area() {
                for (half, bounds) in halves {
                    self.split(half, bounds, add);
                }
                return;
            }
        }
        add(bounds, part);
    }

    /// The box of a part.
    fn bounds(&self, part: u32) -> Bounds {
        let range = range(part);
        let half = 0.5 * self.width(range[0]).max(self.width(range[1]));
        let points = within(&self.points(), part);
        let least = points.into_iter().fold(DVec3::INFINITY, DVec3::min) - half;
        let most = points.into_iter().fold(DVec3::NEG_INFINITY, DVec3::max) + half;
        let bounds = Bounds {
            min: least.to_array().map(narrow),
            max: most.to_array().map(narrow),
        };
        bounds.padded(PAD)
    }

    /// The first hit of a ray within a part.
    ///
    /// Cold, so that the traversal keeps its registers for triangles.
    #[cold]
    #[inline(never)]
    pub(super) fn hit(&self, part: u32, ray: &Ray) -> UvHit {
        let range = range(part);
        let direction = widen3(ray.direction);
        let length = direction.length();
        let z = direction / length;
        let x = z.any_orthonormal_vector();
        let y = z.cross(x);
        let origin = widen3(ray.origin);
        let points = self.points().map(|p| p - origin);
        let across = within(&points.map(|p| DVec2::new(p.dot(x), p.dot(y))), part);
        let mut first = UvHit::NONE;
        if self.is_beside(&across, range) {
            return first;
        }
        minima(foot_points(&across), |s| {
            let u = (range[0] + (range[1] - range[0]) * s).clamp(0.0, 1.0);
            let [beside, along] = at(&across, s);
            let width = match self.shape {
                CurveShape::Flat | CurveShape::Cylinder => self.width(u),
                CurveShape::Ribbon(ends) => self.width(u) * ribbon_normal(ends, u).dot(z).abs(),
            };
            let distance = beside.length();
            let t = f32::of(at(&points, u)[0].dot(z) / length);
            if distance <= 0.5 * width && t > 0.0 && (t < first.t || first.t.is_nan()) {
                let side = distance.copysign(-along.perp_dot(beside));
                let v = (0.5 + side / width).clamp(0.0, 1.0);
                let [u, v] = [u, v].map(f32::of);
                first = UvHit { t, u, v };
            }
        });
        first
    }

    /// Whether the ray passes beside the hull of a part, seen along the chord.
    fn is_beside(&self, across: &[DVec2; 4], range: [f64; 2]) -> bool {
        let half = 0.5 * self.width(range[0]).max(self.width(range[1]));
        let chord = across[3] - across[0];
        let reach = half * half * chord.length_squared();
        let sides = across.map(|p| chord.perp_dot(p));
        let is_one_side = sides.iter().all(|s| *s > 0.0) || sides.iter().all(|s| *s < 0.0);
        is_one_side && sides.iter().all(|s| s * s > reach)
    }
}

/// The range of `u` of a part.
const fn range(part: u32) -> [f64; 2] {
    let depth = if part == 0 { 0 } else { part.ilog2() };
    let step = 1.0 / (1_u32 << depth) as f64;
    let first = part as f64 * step - 1.0;
    [first - BEYOND, first + step + BEYOND]
}

/// A vector, or a number.
trait Weighted: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<f64, Output = Self> {}

impl<T: Copy + Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T>> Weighted for T {}

#[inline(always)]
fn mix<T: Weighted>(a: T, b: T, x: f64) -> T {
    a * (1.0 - x) + b * x
}

/// The coefficients of a Bezier polynomial on both sides of `x`, by de Casteljau's algorithm.
#[inline(always)]
fn halves<const N: usize>(mut b: [f64; N], x: f64) -> [[f64; N]; 2] {
    let mut left = b;
    for (level, kept) in left.iter_mut().enumerate().skip(1) {
        for i in 0..N - level {
            b[i] = mix(b[i], b[i + 1], x);
        }
        *kept = b[0];
    }
    [left, b]
}

/// What each control point adds to those of a part, by the parts' numbers.
static WEIGHTS: [[[f64; 4]; 4]; 1 << (MOST_SPLITS + 1)] = {
    let mut weights = [[[0.0; 4]; 4]; 1 << (MOST_SPLITS + 1)];
    let mut part: u32 = 1;
    while part < 1 << (MOST_SPLITS + 1) {
        weights[part as usize] = weights_within(range(part));
        part += 1;
    }
    weights
};

/// Control point `j` of the part in a range is the curve's polar form of `from`, `3 - j` times, and `to`, `j` times
/// (Ramshaw 1989, "Blossoms are polar forms"): weights are the coefficients of the product of `(1 - t) + t x`.
const fn weights_within([from, to]: [f64; 2]) -> [[f64; 4]; 4] {
    let mut weights = [[0.0; 4]; 4];
    let mut j = 0;
    while j < 4 {
        let mut product = [1.0, 0.0, 0.0, 0.0];
        let mut factor = 0;
        while factor < 3 {
            let t = if factor < 3 - j { from } else { to };
            let mut i = 3;
            while i > 0 {
                product[i] = (1.0 - t) * product[i] + t * product[i - 1];
                i -= 1;
            }
            product[0] *= 1.0 - t;
            factor += 1;
        }
        weights[j] = product;
        j += 1;
    }
    weights
}

/// The control points of a part.
#[inline(always)]
fn within<T: Weighted>(&[a, b, c, d]: &[T; 4], part: u32) -> [T; 4] {
    let weights = &WEIGHTS[part as usize & (WEIGHTS.len() - 1)];
    weights.map(|[wa, wb, wc, wd]| (a * wa + b * wb) + (c * wc + d * wd))
}

/// A point of a curve and a third of its derivative.
#[inline(always)]
fn at<T: Weighted>(&[a, b, c, d]: &[T; 4], u: f64) -> [T; 2] {
    let (ab, bc, cd) = (mix(a, b, u), mix(b, c, u), mix(c, d, u));
    let (abc, bcd) = (mix(ab, bc, u), mix(bc, cd, u));
    [mix(abc, bcd, u), bcd - abc]
}

/// Coefficients of a third of `q . q'`, whose roots are the nearest and farthest points.
fn foot_points(&[a, b, c, d]: &[DVec2; 4]) -> [f64; 6] {
    let [e, f, g] = [b - a, c - b, d - c];
    [
        a.dot(e),
        (2.0 * a.dot(f) + 3.0 * b.dot(e)) / 5.0,
        (a.dot(g) + 6.0 * b.dot(f) + 3.0 * c.dot(e)) / 10.0,
        (3.0 * b.dot(g) + 6.0 * c.dot(f) + d.dot(e)) / 10.0,
        (3.0 * c.dot(g) + 2.0 * d.dot(f)) / 5.0,
        d.dot(g),
    ]
}

/// Calls `found` with every place in `[0, 1]` where a polynomial goes from below 0 to 0 or above.
fn minima(g: [f64; 6], mut found: impl FnMut(f64)) {
    match Changes::of(&g) {
        Changes::None => {}
        Changes::One => found(root(&g)),
        Changes::Several => each_of_several(g, &mut found),
    }
}

/// How often coefficients go from below 0 to 0 or above, or back.
enum Changes {
    /// Never, or from above to below.
    None,
    /// Once, from below.
    One,
    Several,
}

impl Changes {
    fn of(g: &[f64; 6]) -> Self {
        // 0 counts as above, so that a root between two intervals is in one of them.
        let is_below = g.map(|x| x < 0.0);
        match (is_below.windows(2).filter(|w| w[0] != w[1])).count() {
            0 => Self::None,
            1 if is_below[0] => Self::One,
            1 => Self::None,
            _ => Self::Several,
        }
    }
}

/// [`minima`] where there may be several.
fn each_of_several(g: [f64; 6], found: &mut impl FnMut(f64)) {
    let mut waiting = [(g, 0.0, 1.0); WAITING];
    let mut count = 1;
    while count > 0 {
        count -= 1;
        let (g, first, length) = waiting[count];
        match Changes::of(&g) {
            Changes::None => {}
            Changes::One => found(first + length * root(&g)),
            Changes::Several if length > SHORTEST => {
                let half = 0.5 * length;
                let [left, right] = halves(g, 0.5);
                waiting[count] = (right, first + half, half);
                waiting[count + 1] = (left, first, half);
                count += 2;
            }
            Changes::Several => {
                if g[0] < 0.0 && g[5] >= 0.0 {
                    found(first + 0.5 * length);
                }
            }
        }
    }
}

/// The only root in `[0, 1]` of a polynomial that is below 0 before it: Newton's steps, where they stay within what is
/// known, else halvings.
fn root(g: &[f64; 6]) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    let mut x = g[0] / (g[0] - g[5]);
    for _ in 0..MOST_STEPS {
        let [left, right] = halves(*g, x);
        let value = right[0];
        if value < 0.0 {
            low = x;
        } else {
            high = x;
        }
        // Of either side whichever is longer.
        let slope = match x > 0.5 {
            true => 5.0 * (value - left[4]) / x,
            false => 5.0 * (right[1] - value) / (1.0 - x),
        };
        let next = x - value / slope;
        let next = match next > low && next < high {
            true => next,
            false => 0.5 * (low + high),
        };
        let step = (next - x).abs();
        x = next;
        if step <= ROOT {
            break;
        }
    }
    x
}
