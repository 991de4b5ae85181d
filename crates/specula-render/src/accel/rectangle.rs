//! The test of rays against rectangles across an axis.
//!
//! ```text
//! t = (z - oz) / dz,   |ox + t dx - x| <= width / 2,   |oy + t dy - y| <= height / 2
//! ```
//!
//! - The sign of `t` is exact: a ray that leaves the rectangle does not hit it again.
//! - `x` and `y` of the point that is hit are off by less than `10 u` of `|x| + |o|`, `u = 2^-24`, and the triangle's test
//!   by as much. Rectangles are larger by twice that ([`SLACK`]): no ray leaks between one and its neighbours.

use super::parallelogram::{Parallelogram, reach};

/// By which share of the coordinates of rays and corners rectangles are larger.
pub(super) const SLACK: f32 = 16.0 * f32::EPSILON;

/// A rectangle whose sides are along axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rectangle {
    /// Those of its sides, and the one across it.
    pub(super) axes: [usize; 3],
    /// Its coordinate along that.
    across: f32,
    middle: [f32; 2],
    /// Half of its sides, and [`SLACK`] of their coordinates.
    half: [f32; 2],
}

impl Rectangle {
    /// A parallelogram, if it is one.
    pub(super) fn of(parallelogram: &Parallelogram) -> Option<Self> {
        let p = &parallelogram.corners;
        let equal = |a: f32, b: f32| (a - b).abs() <= 2.0 * f32::EPSILON * reach(p);
        let z = (0..3).find(|&axis| p.iter().all(|q| equal(q[axis], p[0][axis])))?;
        let [x, y] = [(z + 1) % 3, (z + 2) % 3];
        let along = |axis: usize, from: [f32; 3], to: [f32; 3]| {
            (0..3).all(|k| k == axis || equal(from[k], to[k]))
        };
        let is_along =
            |[first, second]: [usize; 2]| along(first, p[0], p[1]) && along(second, p[0], p[2]);
        if !is_along([x, y]) && !is_along([y, x]) {
            return None;
        }
        let ends = |axis: usize| {
            let values = p.map(|q| q[axis]);
            let least = values.into_iter().fold(f32::INFINITY, f32::min);
            let most = values.into_iter().fold(f32::NEG_INFINITY, f32::max);
            [least, most]
        };
        let [sides, across] = [[x, y].map(ends), [ends(z); 2]];
        let middle = |[a, b]: [f32; 2]| 0.5 * a + 0.5 * b;
        let half = |[a, b]: [f32; 2]| (0.5 * b - 0.5 * a) + SLACK * a.abs().max(b.abs());
        Some(Self {
            axes: [x, y, z],
            across: middle(across[0]),
            middle: sides.map(middle),
            half: sides.map(half),
        })
    }

    /// `t` at which a ray meets the plane, and whether that is within the rectangle.
    ///
    /// * `o`, `d`: origin and direction, by the axes of the rectangle.
    /// * `reciprocal`: 1 over the direction's last component.
    /// * `slack`: [`SLACK`] of the first two of the origin's.
    #[inline(always)]
    pub(super) fn hit(
        &self,
        o: [f32; 3],
        d: [f32; 2],
        reciprocal: f32,
        slack: [f32; 2],
    ) -> (f32, bool) {
        let t = (self.across - o[2]) * reciprocal;
        let beyond = [0, 1].map(|k: usize| {
            let from_middle = (o[k] - self.middle[k]) + t * d[k];
            from_middle.abs() - slack[k]
        });
        (t, (beyond[0] <= self.half[0]) & (beyond[1] <= self.half[1]))
    }
}
