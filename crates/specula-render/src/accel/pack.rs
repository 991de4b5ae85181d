//! A pack of sixteen rays, and what its hits are updated by.
//!
//! The loops over [`PACK`] rays are compiled to SIMD instructions of the function that calls them.
#![allow(
    clippy::needless_range_loop,
    reason = "an index below the arrays' length is what the compiler makes vectors of"
)]

use core::ops::{Index, IndexMut};

use specula_bsdf::Vec3;

use super::Ray;
use super::ball::{Approach, Ball};
use super::block::{BLOCK, RayBlock};
use super::brute_force::SmallScene;
use super::clusters::{CORNERS, Cluster, Plane, TRIANGLES};
use super::frame::AXES;
use super::parallelepiped::Parallelepiped;
use super::patch::PreparedPatch;
use super::quadric::{self, PreparedQuadric, QuadricShape};
use super::rectangle::{self, Rectangle};
use super::triangle;

/// Rays of a pack.
pub(super) const PACK: usize = 16;

/// One component of each ray of a pack: one cache line.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(super) struct Column(pub(super) [f32; PACK]);

/// Values combined to one, half by half: few operations wait for one another.
macro_rules! reduced {
    ($values:expr, $combine:path) => {{
        let (values, mut eight, mut four) = (&$values, [0.0; 8], [0.0; 4]);
        for lane in 0..8 {
            eight[lane] = $combine(values[lane], values[lane + 8]);
        }
        for lane in 0..4 {
            four[lane] = $combine(eight[lane], eight[lane + 4]);
        }
        let [a, b, c, d] = four;
        $combine($combine(a, c), $combine(b, d))
    }};
}

impl Column {
    pub(super) const ZERO: Self = Self([0.0; PACK]);

    /// The greatest of its values.
    #[inline(always)]
    pub(super) fn greatest(&self) -> f32 {
        reduced!(self.0, triangle::max)
    }

    /// The least of its values.
    #[inline(always)]
    pub(super) fn least(&self) -> f32 {
        reduced!(self.0, triangle::min)
    }
}

impl Index<usize> for Column {
    type Output = f32;

    #[inline(always)]
    fn index(&self, lane: usize) -> &f32 {
        &self.0[lane]
    }
}

impl IndexMut<usize> for Column {
    #[inline(always)]
    fn index_mut(&mut self, lane: usize) -> &mut f32 {
        &mut self.0[lane]
    }
}

/// Rays as a structure of arrays, and their closest hits so far.
pub(super) struct Pack {
    origin: [Column; 3],
    direction: [Column; 3],
    /// 1 over each component of the directions.
    reciprocal: [Column; 3],
    /// In the order of the shear.
    sheared_origin: [Column; 3],
    /// See [`super::frame::RayFrame`].
    shear: [Column; 3],
    pub(super) t: Column,
    /// As of [`super::Hit`], where a triangle or a patch is hit.
    pub(super) u: Column,
    pub(super) v: Column,
    /// What is hit, by its place in the small scene.
    pub(super) place: [u32; PACK],
}

/// Directions whose greatest component is 1 or -1.
struct Unit {
    direction: [Column; 3],
    /// Squares of their lengths, and 1 over them.
    square: [Column; 2],
    /// 1 over the greatest components, as they were.
    scale: Column,
}

/// The vector in a lane.
#[inline(always)]
fn at(columns: &[Column; 3], lane: usize) -> [f32; 3] {
    [columns[0][lane], columns[1][lane], columns[2][lane]]
}

#[inline(always)]
fn set(columns: &mut [Column; 3], lane: usize, values: [f32; 3]) {
    for k in 0..3 {
        columns[k][lane] = values[k];
    }
}

/// Where rays end of which nothing more is asked: nothing is hit.
const ENDED: f32 = -1.0;

/// A cluster's corners, sheared.
pub(super) type Sheared = [[Column; 3]; CORNERS];

/// No primitive.
pub(super) const NOTHING: u32 = u32::MAX;

/// Takes a hit of a ray, if it is closer than the closest so far. Where any counts it ends the ray: nothing lies before
/// its new end.
#[inline(always)]
fn take<const ANY: bool>(
    (closest, places): (&mut Column, &mut [u32; PACK]),
    lane: usize,
    is_closer: bool,
    t: f32,
    place: u32,
) {
    let end = if ANY { ENDED } else { t };
    closest[lane] = if is_closer { end } else { closest[lane] };
    places[lane] = if is_closer { place } else { places[lane] };
}

impl Pack {
    /// Of no ray.
    pub(super) const NONE: Self = Self {
        origin: [Column::ZERO; 3],
        direction: [Column([1.0; PACK]); 3],
        reciprocal: [Column([1.0; PACK]); 3],
        sheared_origin: [Column::ZERO; 3],
        shear: [Column::ZERO; 3],
        t: Column([ENDED; PACK]),
        u: Column::ZERO,
        v: Column::ZERO,
        place: [NOTHING; PACK],
    };

    /// Scratch memory for corners.
    pub(super) const NOTHING_SHEARED: Sheared = [[Column::ZERO; 3]; CORNERS];

    /// Of one ray.
    #[inline(always)]
    pub(super) fn of(ray: &Ray) -> Self {
        let mut pack = Self::NONE;
        pack.set(0, ray);
        pack
    }

    /// Takes rays of a block, by their indices.
    #[inline(always)]
    pub(super) fn gather(&mut self, rays: &RayBlock, members: &[u16]) {
        self.forget();
        for (lane, &i) in members.iter().take(PACK).enumerate() {
            self.set(lane, &rays.get(usize::from(i) % BLOCK));
        }
    }

    /// Takes the rays of a block from one on.
    #[inline(always)]
    pub(super) fn load(&mut self, rays: &RayBlock, from: usize) {
        let from = from.min(BLOCK - PACK);
        self.forget();
        let columns = (self.origin.iter_mut())
            .chain(&mut self.direction)
            .chain([&mut self.t]);
        let (o, d) = (&rays.origin, &rays.direction);
        let values = [&o.x, &o.y, &o.z, &d.x, &d.y, &d.z, &rays.t_max];
        for (column, values) in columns.zip(values) {
            column.0.copy_from_slice(&values[from..from + PACK]);
        }
    }

    /// Leaves no ray. What is prepared for rays, and where hits lie, is written before it is read.
    #[inline(always)]
    fn forget(&mut self) {
        self.t = Column([ENDED; PACK]);
        self.place = [NOTHING; PACK];
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, ray: &Ray) {
        set(&mut self.origin, lane, ray.origin.to_array());
        set(&mut self.direction, lane, ray.direction.to_array());
        self.t[lane] = ray.t_max;
    }

    /// Prepares the tests of rectangles.
    #[inline(always)]
    fn prepare_reciprocals(&mut self) {
        for (reciprocal, direction) in self.reciprocal.iter_mut().zip(&self.direction) {
            for lane in 0..PACK {
                reciprocal[lane] = 1.0 / direction[lane];
            }
        }
    }

    /// Prepares the tests of triangles.
    ///
    /// * `axis`: in which directions are greatest.
    #[inline(always)]
    fn prepare_shear(&mut self, axis: usize) {
        let [x, y, z] = [(axis + 1) % 3, (axis + 2) % 3, axis];
        let d = &self.direction;
        for lane in 0..PACK {
            let dz = d[z][lane];
            self.shear[0][lane] = d[x][lane] / dz;
            self.shear[1][lane] = d[y][lane] / dz;
            self.shear[2][lane] = 1.0 / dz;
        }
        self.sheared_origin = [x, y, z].map(|k| self.origin[k]);
    }

    /// Updates the hits by a cluster of triangles.
    ///
    /// * `place`: that of the first triangle.
    /// * `sheared`: scratch memory for corners.
    #[inline(always)]
    fn offer_cluster<const ANY: bool>(
        &mut self,
        cluster: &Cluster,
        axis: usize,
        place: u32,
        sheared: &mut Sheared,
    ) {
        if ANY
            && let Some(plane) = &cluster.plane
            && !self.crosses(plane, cluster.reach[axis])
        {
            return;
        }
        let (o, s) = (&self.sheared_origin, &self.shear);
        for (corner, p) in cluster.corners[axis].iter().zip(&mut *sheared) {
            for lane in 0..PACK {
                set(p, lane, triangle::shear(*corner, at(o, lane), at(s, lane)));
            }
        }
        // Which triangles the line of any ray passes through: to branch at each would be to guess each.
        let mut reached = 0_u64;
        for (k, corners) in cluster.triangles.iter().enumerate() {
            let p = corners.map(|c| &sheared[usize::from(c) % CORNERS]);
            let mut some = 0;
            for lane in 0..PACK {
                let [a, b, c] = p.map(|corner| at(corner, lane));
                some |= u32::from(triangle::same_sign(triangle::edge_functions(a, b, c)));
            }
            reached |= u64::from(some != 0) << (k % TRIANGLES);
        }
        while reached != 0 {
            let k = reached.trailing_zeros();
            reached &= reached - 1;
            let corners = cluster.triangles[k as usize];
            let p = corners.map(|c| &sheared[usize::from(c) % CORNERS]);
            if ANY {
                self.occlude(p, cluster.reach[axis]);
            } else {
                self.offer(p, place + k);
            }
        }
    }

    /// Whether any ray may pass from one side of a plane to the other before its end.
    ///
    /// The rounding of a triangle's distance moves its point by less than `16 u` of `farthest` along any axis, as the
    /// direction is greatest along z.
    ///
    /// * `reach`: as for [`Self::occlude`].
    #[inline(always)]
    fn crosses(&self, plane: &Plane, reach: f32) -> bool {
        const SLACK: f32 = 16.0 * f32::EPSILON;
        let [from, to] = plane.range;
        let (o, d) = (&self.origin[plane.axis], &self.direction[plane.axis]);
        let mut some = 0;
        for lane in 0..PACK {
            let (o, t) = (o[lane], self.t[lane]);
            let end = o + d[lane] * t;
            let farthest = reach + self.sheared_origin[2][lane].abs();
            let slack = SLACK * (farthest + o.abs() + end.abs());
            // An infinite end is on the side that the ray leads to, and none where it leads to neither.
            let [below, above] = [end + slack < from, end - slack > to];
            let [below, above] = [
                below | (end == f32::NEG_INFINITY),
                above | (end == f32::INFINITY),
            ];
            let stays = ((o < from) & below) | ((o > to) & above) | (t <= 0.0);
            some |= u32::from(!stays);
        }
        some != 0
    }

    /// Updates the closest hits by a triangle.
    ///
    /// * `p`: its corners, sheared.
    #[inline(always)]
    fn offer(&mut self, p: [&[Column; 3]; 3], place: u32) {
        let dz = &self.shear[2];
        for lane in 0..PACK {
            let [a, b, c] = p.map(|corner| at(corner, lane));
            let weights = triangle::edge_functions(a, b, c);
            let (t, u, v) = triangle::distance(weights, [a[2], b[2], c[2]], dz[lane]);
            let closer = triangle::same_sign(weights) & (t > 0.0) & (t < self.t[lane]);
            self.u[lane] = if closer { u } else { self.u[lane] };
            self.v[lane] = if closer { v } else { self.v[lane] };
            take::<false>((&mut self.t, &mut self.place), lane, closer, t, place);
        }
    }

    /// Ends the rays that a triangle occludes; see [`take`].
    ///
    /// Most triangles that the lines of shadow rays pass through lie behind or beyond them, which is told before
    /// anything is divided.
    ///
    /// * `p`: as for [`Self::offer`].
    /// * `reach`: bound on the absolute values of the corners' coordinates z.
    #[inline(always)]
    fn occlude(&mut self, p: [&[Column; 3]; 3], reach: f32) {
        let mut some = 0;
        for lane in 0..PACK {
            let [a, b, c] = p.map(|corner| at(corner, lane));
            let weights = triangle::edge_functions(a, b, c);
            let farthest = reach + self.sheared_origin[2][lane].abs();
            let z = [a[2], b[2], c[2]];
            let apart =
                triangle::is_apart(weights, z, self.shear[2][lane], (self.t[lane], farthest));
            some |= u32::from(triangle::same_sign(weights) & !apart);
        }
        if some == 0 {
            return;
        }
        for lane in 0..PACK {
            let [a, b, c] = p.map(|corner| at(corner, lane));
            let weights = triangle::edge_functions(a, b, c);
            let (t, _, _) = triangle::distance(weights, [a[2], b[2], c[2]], self.shear[2][lane]);
            let occluded = triangle::same_sign(weights) & (t > 0.0) & (t < self.t[lane]);
            take::<true>((&mut self.t, &mut self.place), lane, occluded, t, 0);
        }
    }

    /// Updates the hits by a rectangle.
    #[inline(always)]
    fn offer_rectangle<const ANY: bool>(
        &mut self,
        rectangle: &Rectangle,
        slack: &[Column; 3],
        place: u32,
    ) {
        let [x, y, z] = rectangle.axes;
        let o = [x, y, z].map(|axis| &self.origin[axis]);
        let d = [x, y].map(|axis| &self.direction[axis]);
        let slack = [x, y].map(|axis| &slack[axis]);
        let reciprocal = &self.reciprocal[z];
        for lane in 0..PACK {
            let (t, inside) = rectangle.hit(
                [o[0][lane], o[1][lane], o[2][lane]],
                [d[0][lane], d[1][lane]],
                reciprocal[lane],
                [slack[0][lane], slack[1][lane]],
            );
            let closer = inside & (t > 0.0) & (t < self.t[lane]);
            take::<ANY>((&mut self.t, &mut self.place), lane, closer, t, place);
        }
    }

    /// Updates the hits by a box.
    ///
    /// * `place`: that of its first face.
    #[inline(always)]
    fn offer_box<const ANY: bool>(&mut self, solid: &Parallelepiped, place: u32) {
        for lane in 0..PACK {
            let hit = solid.hit(at(&self.origin, lane), at(&self.direction, lane));
            let closer = (hit.t > 0.0) & (hit.t < self.t[lane]);
            take::<ANY>(
                (&mut self.t, &mut self.place),
                lane,
                closer,
                hit.t,
                place + hit.face,
            );
        }
    }

    /// Updates the hits by a sphere.
    #[inline(always)]
    fn offer_ball<const ANY: bool>(&mut self, ball: &Ball, unit: &Unit, place: u32) {
        let [square, over_square] = &unit.square;
        for lane in 0..PACK {
            let (o, d) = (at(&self.origin, lane), at(&unit.direction, lane));
            let t = ball.t(o, d, [square[lane], over_square[lane]]) * unit.scale[lane];
            let closer = (t > 0.0) & (t < self.t[lane]);
            take::<ANY>((&mut self.t, &mut self.place), lane, closer, t, place);
        }
    }

    /// Updates the hits by a quadric.
    #[inline(always)]
    fn offer_quadric<const ANY: bool>(&mut self, quadric: &PreparedQuadric, place: u32) {
        let [mut o, mut d] = [[[0.0; PACK]; 3]; 2];
        for lane in 0..PACK {
            let origin = [0, 1, 2].map(|k| f64::from(self.origin[k][lane]));
            let direction = [0, 1, 2].map(|k| f64::from(self.direction[k][lane]));
            let (origin, direction) = quadric.enter(origin, direction);
            for k in 0..3 {
                o[k][lane] = origin[k];
                d[k][lane] = direction[k];
            }
        }
        let (o, d) = (
            |lane: usize| [0, 1, 2].map(|k: usize| o[k][lane]),
            |lane: usize| [0, 1, 2].map(|k: usize| d[k][lane]),
        );
        let mut t = [0.0; PACK];
        let mut is_hit = [1_u32; PACK];
        match quadric.shape() {
            QuadricShape::Disk { radius, height } => {
                for lane in 0..PACK {
                    t[lane] = quadric::disk(o(lane), d(lane), radius, height);
                }
            }
            QuadricShape::Part(part) => {
                for lane in 0..PACK {
                    t[lane] = quadric::part_distance(o(lane), d(lane), &part);
                }
            }
            QuadricShape::Sphere { radius } => {
                let mut some = 0;
                for lane in 0..PACK {
                    let near = Approach::new(o(lane), d(lane), radius * radius);
                    is_hit[lane] = u32::from(near.hits());
                    some |= is_hit[lane];
                }
                if some == 0 {
                    return;
                }
                for lane in 0..PACK {
                    t[lane] = Approach::new(o(lane), d(lane), radius * radius).t();
                }
            }
        }
        for lane in 0..PACK {
            let closer = (is_hit[lane] != 0) & (t[lane] > 0.0) & (t[lane] < self.t[lane]);
            take::<ANY>((&mut self.t, &mut self.place), lane, closer, t[lane], place);
        }
    }

    /// Updates the hits by a patch.
    ///
    /// * `axes`: of the rays' directions, the greatest last.
    #[inline(always)]
    fn offer_patch<const ANY: bool>(&mut self, patch: &PreparedPatch, axes: [u8; 3], place: u32) {
        for lane in 0..PACK {
            if self.t[lane] <= 0.0 {
                continue;
            }
            let ray = Ray {
                origin: Vec3::from(at(&self.origin, lane)),
                direction: Vec3::from(at(&self.direction, lane)),
                t_max: self.t[lane],
            };
            let hit = patch.hit(&ray, axes);
            let closer = (hit.t > 0.0) & (hit.t < self.t[lane]);
            if closer {
                (self.u[lane], self.v[lane]) = (hit.u, hit.v);
                take::<ANY>((&mut self.t, &mut self.place), lane, closer, hit.t, place);
            }
        }
    }

    /// By how much rectangles are larger along each axis, for the rays' origins.
    #[inline(always)]
    fn slack(&self) -> [Column; 3] {
        let mut slack = [Column::ZERO; 3];
        for (slack, origin) in slack.iter_mut().zip(&self.origin) {
            for lane in 0..PACK {
                slack[lane] = rectangle::SLACK * origin[lane].abs();
            }
        }
        slack
    }

    /// The rays' directions, scaled.
    #[inline(always)]
    fn unit(&self) -> Unit {
        let mut unit = Unit {
            direction: [Column::ZERO; 3],
            square: [Column::ZERO; 2],
            scale: Column::ZERO,
        };
        for lane in 0..PACK {
            let d = at(&self.direction, lane);
            let [x, y, z] = d.map(f32::abs);
            let scale = 1.0 / triangle::max(x, triangle::max(y, z));
            let d = d.map(|c| c * scale);
            set(&mut unit.direction, lane, d);
            let square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
            unit.square[0][lane] = square;
            unit.square[1][lane] = 1.0 / square;
            unit.scale[lane] = scale;
        }
        unit
    }

    /// Updates the hits by all primitives: the closest ones, or just whether there are any.
    #[inline(always)]
    pub(super) fn offer_all<const ANY: bool>(
        &mut self,
        small: &SmallScene,
        axis: usize,
        sheared: &mut Sheared,
    ) {
        let places = &small.places;
        if !small.clusters.is_empty() {
            self.prepare_shear(axis);
        }
        if !small.rectangles.is_empty() {
            self.prepare_reciprocals();
            let slack = self.slack();
            for (place, rectangle) in (0..).zip(&small.rectangles) {
                self.offer_rectangle::<ANY>(rectangle, &slack, place);
            }
        }
        for (nth, solid) in (0..).zip(&small.boxes) {
            self.offer_box::<ANY>(solid, places.boxes + 6 * nth);
        }
        if !small.balls.is_empty() {
            let unit = self.unit();
            for (place, ball) in (places.balls..).zip(&small.balls) {
                self.offer_ball::<ANY>(ball, &unit, place);
            }
        }
        let mut place = places.triangles;
        let clusters = if ANY {
            &small.occluders
        } else {
            &small.clusters
        };
        for cluster in clusters {
            self.offer_cluster::<ANY>(cluster, axis, place, sheared);
            place += crate::convert::id(cluster.triangles.len());
        }
        for (place, quadric) in (places.quadrics..).zip(&small.quadrics) {
            self.offer_quadric::<ANY>(quadric, place);
        }
        for (place, patch) in (places.patches..).zip(&small.patches) {
            self.offer_patch::<ANY>(patch, AXES[axis], place);
        }
    }
}
