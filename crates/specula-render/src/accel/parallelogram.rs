//! Pairs of triangles that are parallelograms, and where a point of one lies on its triangles.
//!
//! ```text
//! p = p0 + a (p1 - p0) + b (p2 - p0),   0 <= a, b <= 1
//! a = A . (p - p0),  b = B . (p - p0)                   A, B: the dual basis of the sides, in their plane
//! a + b <= 1: the triangle of p0, p1, p2, with weights 1 - a - b, a, b
//! else:       that of p3, p1, p2, with weights a + b - 1, 1 - b, 1 - a
//! ```

use glam::DVec3;
use specula_bsdf::Real;

/// By how many ulps of its coordinates a corner may be off.
const TOLERANCE: f32 = 2.0 * f32::EPSILON;
/// Least sine of the angle between two sides.
const LEAST_SINE: f64 = 0.1;

/// A triangle with its index within the group.
pub(super) type Triangle = (u32, [[f32; 3]; 3]);

/// Two triangles that are a parallelogram.
#[derive(Clone, Copy, Debug)]
pub(super) struct Parallelogram {
    /// `p0` and its neighbours `p1` and `p2`, then the corner opposite.
    pub(super) corners: [[f32; 3]; 4],
    halves: [Half; 2],
}

/// One of its triangles.
#[derive(Clone, Copy, Debug)]
struct Half {
    primitive: u32,
    /// Which of the weights belong to the triangle's second and third vertex: of its own corner, of `p1`, of `p2`.
    weights: [u8; 2],
}

/// A parallelogram, ready to tell which triangle a point lies on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    corner: [f32; 3],
    dual: [[f32; 3]; 2],
    halves: [Half; 2],
}

/// A point of a triangle: its index, and the weights of its second and third vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TrianglePoint {
    pub(super) primitive: u32,
    pub(super) u: f32,
    pub(super) v: f32,
}

impl Parallelogram {
    /// The parallelograms among triangles, by the first index of each, and the other triangles.
    pub(super) fn all(triangles: &[Triangle]) -> (Vec<Self>, Vec<Triangle>) {
        let mut left = triangles.to_vec();
        let (mut found, mut others) = (Vec::new(), Vec::new());
        while !left.is_empty() {
            let first = left.remove(0);
            let second = left
                .iter()
                .enumerate()
                .find_map(|(k, second)| Some((k, Self::of(&first, second)?)));
            if let Some((k, parallelogram)) = second {
                left.remove(k);
                found.push(parallelogram);
            } else {
                others.push(first);
            }
        }
        (found, others)
    }

    /// That of two triangles which share two corners, if it is one.
    fn of(first: &Triangle, second: &Triangle) -> Option<Self> {
        let own = |a: &Triangle, b: &Triangle| {
            let mut own = (0..3).filter(|&k| !b.1.contains(&a.1[k]));
            own.next().filter(|_| own.next().is_none())
        };
        let [k, l] = [own(first, second)?, own(second, first)?];
        let [p0, p1, p2] = [0, 1, 2].map(|i| first.1[(k + i) % 3]);
        let p3 = second.1[l];
        let corners = [p0, p1, p2, p3];
        let reach = reach(&corners);
        let [a, b, c, d] = corners.map(wide);
        let is_closed = (a + d - b - c).abs().max_element() <= f64::from(TOLERANCE * reach);
        if !is_closed || !is_open(b - a, c - a) {
            return None;
        }
        // The shared corners of the second triangle are in either order.
        let of_second = |corner: [f32; 3]| if corner == p1 { 1 } else { 2 };
        let order_of_second = [0, 1, 2].map(|i| {
            let corner = second.1[i];
            if i == l { 0 } else { of_second(corner) }
        });
        let order_of_first = [0, 1, 2].map(|i| [0, 1, 2][(i + 3 - k) % 3]);
        let half = |primitive: u32, order: [u8; 3]| Half {
            primitive,
            weights: [order[1], order[2]],
        };
        Some(Self {
            corners,
            halves: [
                half(first.0, order_of_first),
                half(second.0, order_of_second),
            ],
        })
    }

    /// Indices of its triangles.
    pub(super) fn primitives(&self) -> [u32; 2] {
        self.halves.map(|half| half.primitive)
    }

    /// What tells which triangle a point lies on.
    pub(super) fn face(&self) -> Face {
        let [p0, p1, p2] = [0, 1, 2].map(|k| wide(self.corners[k]));
        let (s, t) = (p1 - p0, p2 - p0);
        let n = s.cross(t);
        let [a, b] = [t.cross(n), n.cross(s)];
        let dual = [a / a.dot(s), b / b.dot(t)];
        Face {
            corner: self.corners[0],
            dual: dual.map(narrow),
            halves: self.halves,
        }
    }
}

impl Face {
    /// Indices of its triangles.
    pub(super) fn primitives(&self) -> [u32; 2] {
        self.halves.map(|half| half.primitive)
    }

    /// The point of its triangles that is nearest to a point of its plane, by the parallelogram's own coordinates.
    #[inline(always)]
    pub(super) fn at(&self, point: [f32; 3]) -> TrianglePoint {
        let x = [0, 1, 2].map(|k: usize| point[k] - self.corner[k]);
        let [a, b] = (self.dual).map(|row| row[0] * x[0] + row[1] * x[1] + row[2] * x[2]);
        let [a, b] = [a.clamp(0.0, 1.0), b.clamp(0.0, 1.0)];
        let beyond = (a + b) - 1.0;
        let is_second = beyond > 0.0;
        let weights = if is_second {
            [beyond, 1.0 - b, 1.0 - a, 0.0]
        } else {
            [-beyond, a, b, 0.0]
        };
        let half = &self.halves[usize::from(is_second)];
        let [u, v] = half.weights.map(|k| weights[usize::from(k) % 4]);
        TrianglePoint {
            primitive: half.primitive,
            u,
            v,
        }
    }
}

/// The largest absolute value of the coordinates.
pub(super) fn reach(points: &[[f32; 3]]) -> f32 {
    points.iter().flatten().fold(0.0, |r, x| r.max(x.abs()))
}

/// Whether two sides span a parallelogram that is neither flat nor a sliver.
fn is_open(s: DVec3, t: DVec3) -> bool {
    s.cross(t).length() > LEAST_SINE * s.length() * t.length()
}

pub(super) fn wide(p: [f32; 3]) -> DVec3 {
    DVec3::from(p.map(f64::from))
}

pub(super) fn narrow(v: DVec3) -> [f32; 3] {
    v.to_array().map(f32::of)
}
