//! The test of rays against closed boxes, turned and sheared as they may be.
//!
//! ```text
//! a = N . (o - p0),  b = N . (o - p7)                 N: the dual basis of the edges; p0, p7: opposite corners
//! low: t = -a / (N . d),  high: t = -b / (N . d)      per pair of faces
//! enter = max of the nearer ones,  exit = min of the farther ones
//! t = enter where it is above 0, else exit; a hit where enter <= exit and t > 0
//! ```
//!
//! - Distances to a face are computed from a corner of it: their sign is right beyond `5 u` of its diagonal, and rays leave
//!   faces by more (`offset.rs`).
//! - Whether a ray passes the box at all is asked of a box whose faces are moved out by [`SLACK`]: no ray leaks between
//!   boxes that touch, or a box and its neighbours. Where it passes that one alone, beside an edge, it hits the moved face.

use super::parallelogram::{Parallelogram, narrow, reach, wide};

/// By which share of the coordinates faces are moved out.
const SLACK: f32 = 16.0 * f32::EPSILON;
/// Least volume, over the product of the edges' lengths.
const LEAST_VOLUME: f64 = 0.1;

/// By which share of the least coordinates of a face, of those that are its greatest, corners may be off.
const TOLERANCE: f32 = 2.0 * f32::EPSILON;
/// The corners of each face, by the bits of their indices.
const FACES: [[usize; 4]; 6] = [
    [0, 2, 4, 6],
    [1, 3, 5, 7],
    [0, 1, 4, 5],
    [2, 3, 6, 7],
    [0, 1, 2, 3],
    [4, 5, 6, 7],
];

/// A closed box of six parallelograms.
#[derive(Clone, Copy, Debug)]
pub(super) struct Parallelepiped {
    /// Two opposite ones.
    corners: [[f32; 3]; 2],
    dual: [[f32; 3]; 3],
    /// [`SLACK`] over the distance of each pair of faces.
    scale: [f32; 3],
    /// By which pairs of faces are moved out, for rays from the first corner.
    slack: [f32; 3],
}

/// Where a ray hits a box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct BoxHit {
    /// Not above 0 where it misses.
    pub(super) t: f32,
    /// Twice the pair of faces, and one more for that of the second corner.
    pub(super) face: u32,
}

impl Parallelepiped {
    /// The boxes among parallelograms with the indices of their faces, and the indices of the other parallelograms.
    pub(super) fn all(faces: &[Parallelogram]) -> (Vec<(Self, [usize; 6])>, Vec<usize>) {
        let mut left: Vec<usize> = (0..faces.len()).collect();
        let (mut found, mut others) = (Vec::new(), Vec::new());
        while !left.is_empty() {
            if let Some((solid, own)) = Self::with_first(faces, &left) {
                left.retain(|k| !own.contains(k));
                found.push((solid, own));
            } else {
                others.push(left.remove(0));
            }
        }
        (found, others)
    }

    /// The box that the first of some faces belongs to.
    fn with_first(faces: &[Parallelogram], some: &[usize]) -> Option<(Self, [usize; 6])> {
        let [p0, p1, p2, p3] = faces[*some.first()?].corners;
        // The third neighbour of the first corner, by another face that has one of the two.
        let third = |face: &[[f32; 3]; 4]| {
            let k = face.iter().position(|p| *p == p0)?;
            let neighbours = [face[k ^ 1], face[k ^ 2]];
            let is_known = |p: &[f32; 3]| *p == p1 || *p == p2;
            let third = neighbours.into_iter().find(|p| !is_known(p))?;
            (neighbours.iter().any(is_known) && !face.contains(&p3)).then_some(third)
        };
        let p4 = some[1..].iter().find_map(|&k| third(&faces[k].corners))?;
        let opposite = |of: [f32; 3], near: [f32; 3], beside: [f32; 3]| {
            some.iter().find_map(|&k| {
                let face = &faces[k].corners;
                let is_it = [of, near, beside].iter().all(|p| face.contains(p));
                let at = is_it.then(|| face.iter().position(|p| *p == of))??;
                Some(face[at ^ 3])
            })
        };
        let p5 = opposite(p0, p1, p4)?;
        let p6 = opposite(p0, p2, p4)?;
        let p7 = opposite(p1, p3, p5)?;
        let corners = [p0, p1, p2, p3, p4, p5, p6, p7];
        let mut own = [0; 6];
        for (own, set) in own.iter_mut().zip(FACES) {
            let wanted = set.map(|k: usize| corners[k]);
            let is_it = |k: &usize| {
                let face = &faces[*k].corners;
                wanted.iter().all(|p| face.contains(p)) && face.iter().all(|p| wanted.contains(p))
            };
            *own = *some.iter().find(|k| is_it(k))?;
        }
        Some((Self::new(corners)?, own))
    }

    /// * `p`: its corners; the bits of an index tell by which edges a corner is apart from the first.
    fn new(p: [[f32; 3]; 8]) -> Option<Self> {
        let from = wide(p[0]);
        let [x, y, z] = [p[1], p[2], p[4]].map(|p| wide(p) - from);
        let volume = x.dot(y.cross(z));
        if volume.abs() < LEAST_VOLUME * x.length() * y.length() * z.length() {
            return None;
        }
        let (least, _) = reaches(&p);
        let is_off = |(i, corner): (u32, &[f32; 3])| {
            let edges = [x, y, z].into_iter().enumerate();
            let ideal = edges.fold(from, |at, (k, edge)| at + f64::from(i >> k & 1) * edge);
            (wide(*corner) - ideal).abs().max_element() > f64::from(TOLERANCE * least)
        };
        if (0..).zip(&p).any(is_off) {
            return None;
        }
        let dual = [y.cross(z), z.cross(x), x.cross(y)].map(|v| v / volume);
        let size = |v: glam::DVec3| v.abs().max_element();
        let scale = dual.map(|v| specula_bsdf::Real::of(f64::from(SLACK) * size(v)));
        let (_, reach) = reaches(&p);
        Some(Self {
            corners: [p[0], p[7]],
            dual: dual.map(narrow),
            scale,
            slack: scale.map(|s: f32| s * reach),
        })
    }

    /// Where a ray hits it.
    #[inline(always)]
    pub(super) fn hit(&self, o: [f32; 3], d: [f32; 3]) -> BoxHit {
        let [p, q] = self
            .corners
            .map(|corner| [0, 1, 2].map(|k: usize| o[k] - corner[k]));
        let reach = p[0].abs() + p[1].abs() + p[2].abs();
        let dot = |a: [f32; 3], b: [f32; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        // Of the box, and of the one that is larger; where a ray enters that and leaves the box.
        let (mut enter, mut exit) = (f32::NEG_INFINITY, f32::INFINITY);
        let (mut enter_larger, mut exit_larger) = (f32::NEG_INFINITY, f32::INFINITY);
        let (mut entered, mut left) = (0, 0);
        for k in 0..3_u8 {
            let row = self.dual[usize::from(k)];
            let scale = 1.0 / dot(row, d);
            let (low, high) = (-dot(row, p) * scale, -dot(row, q) * scale);
            let is_back = scale < 0.0;
            let (near, far) = if is_back { (high, low) } else { (low, high) };
            let moved =
                (self.slack[usize::from(k)] + self.scale[usize::from(k)] * reach) * scale.abs();
            let [near_larger, far_larger] = [near - moved, far + moved];
            let back = u32::from(is_back);
            let face = 2 * u32::from(k);
            let (enters, leaves) = (near_larger > enter_larger, far < exit);
            entered = if enters { face + back } else { entered };
            enter_larger = if enters { near_larger } else { enter_larger };
            enter = if near > enter { near } else { enter };
            left = if leaves { face + 1 - back } else { left };
            exit = if leaves { far } else { exit };
            exit_larger = if far_larger < exit_larger {
                far_larger
            } else {
                exit_larger
            };
        }
        let passes_box = enter <= exit;
        let first = if passes_box { enter } else { enter_larger };
        let is_outside = first > 0.0;
        let passes = (enter_larger <= exit_larger) & (exit > 0.0) & (is_outside | passes_box);
        let t = if is_outside { first } else { exit };
        BoxHit {
            t: if passes { t } else { -1.0 },
            face: if is_outside { entered } else { left },
        }
    }
}

/// The least and the greatest of the faces' largest absolute coordinates.
fn reaches(corners: &[[f32; 3]; 8]) -> (f32, f32) {
    let of_faces = FACES.map(|face| reach(&face.map(|k| corners[k])));
    let least = of_faces.into_iter().fold(f32::INFINITY, f32::min);
    (least, of_faces.into_iter().fold(0.0, f32::max))
}
