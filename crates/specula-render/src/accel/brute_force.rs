//! Small scenes: sixteen rays at a time against every primitive.
//!
//! Below a few dozen primitives a tree costs more than it saves. Rays are sorted by the axis in which
//! their direction is greatest, so that the triangle test permutes the coordinates of all alike, and stored as
//! structures of arrays. The loops over [`PACK`] rays are compiled to SIMD instructions. Triangles that share corners
//! are tested together: each corner is sheared once. Distances are computed for those that the line of any ray of the
//! pack passes through.
//!
//! Operation by operation the same as the traversal, whose boxes cull no hit: the answers are equal bit
//! for bit, but for slivers in rooms that are a million of their own sizes away from the origin: rounding lets rays
//! beside them hit. Primitives come in ascending order, so that of equal distances the first stays.
#![allow(
    clippy::needless_range_loop,
    reason = "an index below the arrays' length is what the compiler makes vectors of"
)]

use core::ops::{Index, IndexMut};

use macro_rules_attribute::apply;
use specula_bsdf::Vec3;

use super::clusters::{CORNERS, Cluster, Plane};
use super::frame::{AXES, greatest_axis};
use super::node::ChildKind;
use super::patch::PreparedPatch;
use super::quadric::{self, Approach, PreparedQuadric};
use super::traverse::Scene;
use super::triangle;
use super::{Bounds, Hit, QuadricShape, Ray};
use crate::simd::simd_levels;

/// Rays of a pack.
const PACK: usize = 16;
/// Most rays that are sorted together.
const BATCH: usize = 512;
/// Most triangles of a small scene, a quadric counting as [`QUADRIC`] of them, a patch as [`PATCH`]. Measured in rooms with
/// boxes and spheres: at twice as many the tree is as fast.
const MOST: usize = 64;
/// Triangles that take as long as a quadric.
const QUADRIC: usize = 3;
/// Triangles that take as long as a patch, whose lanes are tested one after the other.
const PATCH: usize = 8;

/// One component of each ray of a pack: one cache line.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
struct Column([f32; PACK]);

impl Column {
    const ZERO: Self = Self([0.0; PACK]);
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

/// The primitives of a small scene.
#[derive(Clone, Debug)]
pub(super) struct SmallScene {
    /// All triangles, ascending.
    clusters: Vec<Cluster>,
    /// The same for shadow rays, which cross few planes, in more clusters.
    occluders: Vec<Cluster>,
    /// Of the triangles, then of the quadrics, then of the patches, ascending.
    primitives: Vec<u32>,
    quadrics: Vec<PreparedQuadric>,
    /// How many triangles there are.
    first_quadric: u32,
    patches: Vec<PreparedPatch>,
    /// How many triangles and quadrics there are.
    first_patch: u32,
    instance: u32,
}

impl SmallScene {
    /// `None` where the scene is empty, too large, or anything but one untransformed instance.
    pub(super) fn new(scene: &Scene) -> Option<Self> {
        let instance = scene.single?;
        if scene.packets.len() + scene.quadrics.len() + scene.patches.len() > MOST {
            return None;
        }
        let mut triangles: Vec<(u32, [[f32; 3]; 3])> = Vec::new();
        let mut quadrics: Vec<PreparedQuadric> = Vec::new();
        let mut patches: Vec<PreparedPatch> = Vec::new();
        let mut pending = vec![scene.root?];
        while let Some(child) = pending.pop() {
            match child.kind() {
                ChildKind::Node => pending.extend(scene.nodes[child.index()].occupied()),
                ChildKind::Packet => triangles.extend(scene.packets[child.index()].occupied()),
                ChildKind::Quadric => quadrics.push(scene.quadrics[child.index()]),
                ChildKind::PatchOrPlacement => patches.push(scene.patches[child.index()]),
                // Of which there are many.
                ChildKind::CurvePart => return None,
            }
        }
        if triangles.len() + QUADRIC * quadrics.len() + PATCH * patches.len() > MOST {
            return None;
        }
        triangles.sort_unstable_by_key(|t| t.0);
        quadrics.sort_unstable_by_key(|q| q.primitive);
        patches.sort_unstable_by_key(|p| p.primitive);
        let bounds = (triangles.iter())
            .map(|(_, corners)| Bounds::around(corners))
            .fold(Bounds::EMPTY, |all, own| all.union(&own));
        Some(Self {
            clusters: Cluster::all(&triangles, |_| None),
            occluders: Cluster::all(&triangles, |corners| Plane::of(corners, &bounds)),
            primitives: triangles
                .iter()
                .map(|t| t.0)
                .chain(quadrics.iter().map(|q| q.primitive))
                .chain(patches.iter().map(|p| p.primitive))
                .collect(),
            first_quadric: crate::convert::id(triangles.len()),
            first_patch: crate::convert::id(triangles.len() + quadrics.len()),
            quadrics,
            patches,
            instance,
        })
    }

    /// The closest hits of the rays, in order.
    pub(super) fn intersect(&self, rays: &[Ray], hits: &mut Vec<Option<Hit>>) {
        hits.clear();
        hits.resize(rays.len(), None);
        for (rays, hits) in rays.chunks(BATCH).zip(hits.chunks_mut(BATCH)) {
            closest(self, rays, hits);
        }
    }

    /// Whether the rays hit anything, in order.
    pub(super) fn occluded(&self, rays: &[Ray], occluded: &mut Vec<bool>) {
        occluded.clear();
        occluded.resize(rays.len(), false);
        for (rays, occluded) in rays.chunks(BATCH).zip(occluded.chunks_mut(BATCH)) {
            any(self, rays, occluded);
        }
    }
}

/// Rays that can hit, by the axes in which their directions are greatest.
struct Order {
    rays: [u16; BATCH],
    /// Where those of each axis end.
    ends: [usize; 3],
}

impl Order {
    #[inline(always)]
    fn new(rays: &[Ray]) -> Self {
        const NEVER: u8 = 3;
        let mut axes = [NEVER; BATCH];
        for (ray, axis) in rays.iter().zip(&mut axes) {
            *axis = greatest_axis(ray).unwrap_or(NEVER);
        }
        let count = |wanted: u8| axes.iter().filter(|&&axis| axis == wanted).count();
        let [x, y, z] = [0, 1, 2].map(count);
        let mut next = [0, x, x + y, x + y + z];
        let mut order = [0; BATCH];
        for (i, axis) in (0..=u16::MAX).zip(&axes[..rays.len()]) {
            let place = &mut next[usize::from(*axis)];
            order[*place] = i;
            *place += 1;
        }
        Self {
            rays: order,
            ends: [x, x + y, x + y + z],
        }
    }

    /// The packs of rays of each axis.
    #[inline(always)]
    fn packs(&self) -> impl Iterator<Item = (usize, &[u16])> {
        let begins = [0, self.ends[0], self.ends[1]];
        (0..3).flat_map(move |axis| {
            let rays = &self.rays[begins[axis]..self.ends[axis]];
            rays.chunks(PACK).map(move |pack| (axis, pack))
        })
    }
}

/// Rays as a structure of arrays, and their closest hits so far.
struct Pack {
    origin: [Column; 3],
    direction: [Column; 3],
    /// In the order of the shear.
    sheared_origin: [Column; 3],
    /// See [`super::frame::RayFrame`].
    shear: [Column; 3],
    t: Column,
    u: Column,
    v: Column,
    /// Index in the list of triangles, then of quadrics, then of patches.
    place: [u32; PACK],
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
type Sheared = [[Column; 3]; CORNERS];

/// No triangle, quadric or patch.
const NOTHING: u32 = u32::MAX;

impl Pack {
    #[inline(always)]
    fn new(rays: &[Ray], pack: &[u16], axis: usize) -> Self {
        let (mut origin, mut direction) = ([Column::ZERO; 3], [Column([1.0; PACK]); 3]);
        let mut t = Column([ENDED; PACK]);
        for (lane, &i) in pack.iter().enumerate() {
            let ray = &rays[usize::from(i)];
            let (o, d) = (ray.origin.to_array(), ray.direction.to_array());
            for k in 0..3 {
                origin[k][lane] = o[k];
                direction[k][lane] = d[k];
            }
            t[lane] = ray.t_max;
        }
        let [x, y, z] = [(axis + 1) % 3, (axis + 2) % 3, axis];
        let mut shear = [Column::ZERO; 3];
        for lane in 0..PACK {
            let dz = direction[z][lane];
            shear[0][lane] = direction[x][lane] / dz;
            shear[1][lane] = direction[y][lane] / dz;
            shear[2][lane] = 1.0 / dz;
        }
        Self {
            origin,
            direction,
            sheared_origin: [origin[x], origin[y], origin[z]],
            shear,
            t,
            u: Column::ZERO,
            v: Column::ZERO,
            place: [NOTHING; PACK],
        }
    }

    /// Updates the hits by a cluster of triangles.
    ///
    /// * `place`: index of the first triangle.
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
            reached |= u64::from(some != 0) << (k % MOST);
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
            self.t[lane] = if closer { t } else { self.t[lane] };
            self.u[lane] = if closer { u } else { self.u[lane] };
            self.v[lane] = if closer { v } else { self.v[lane] };
            self.place[lane] = if closer { place } else { self.place[lane] };
        }
    }

    /// Ends the rays that a triangle occludes; see [`Self::end`].
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
            self.end(lane, occluded);
        }
    }

    /// Ends a ray if something occludes it: nothing lies before its new end.
    #[inline(always)]
    fn end(&mut self, lane: usize, occluded: bool) {
        self.t[lane] = if occluded { ENDED } else { self.t[lane] };
        self.place[lane] = if occluded { 0 } else { self.place[lane] };
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
                    let near = Approach::new(o(lane), d(lane), radius);
                    is_hit[lane] = u32::from(near.hits());
                    some |= is_hit[lane];
                }
                if some == 0 {
                    return;
                }
                for lane in 0..PACK {
                    let near = Approach::new(o(lane), d(lane), radius);
                    t[lane] = near.t(o(lane), radius);
                }
            }
        }
        for lane in 0..PACK {
            let closer = (is_hit[lane] != 0) & (t[lane] > 0.0) & (t[lane] < self.t[lane]);
            if ANY {
                self.end(lane, closer);
                continue;
            }
            self.t[lane] = if closer { t[lane] } else { self.t[lane] };
            self.u[lane] = if closer { 0.0 } else { self.u[lane] };
            self.v[lane] = if closer { 0.0 } else { self.v[lane] };
            self.place[lane] = if closer { place } else { self.place[lane] };
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
            if ANY {
                self.end(lane, closer);
            } else if closer {
                self.t[lane] = hit.t;
                self.u[lane] = hit.u;
                self.v[lane] = hit.v;
                self.place[lane] = place;
            }
        }
    }

    /// Updates the hits by all primitives: the closest ones, or just whether there are any.
    #[inline(always)]
    fn offer_all<const ANY: bool>(
        &mut self,
        small: &SmallScene,
        axis: usize,
        sheared: &mut Sheared,
    ) {
        let mut place = 0;
        let clusters = if ANY {
            &small.occluders
        } else {
            &small.clusters
        };
        for cluster in clusters {
            self.offer_cluster::<ANY>(cluster, axis, place, sheared);
            place += crate::convert::id(cluster.triangles.len());
        }
        for (place, quadric) in (small.first_quadric..).zip(&small.quadrics) {
            self.offer_quadric::<ANY>(quadric, place);
        }
        for (place, patch) in (small.first_patch..).zip(&small.patches) {
            self.offer_patch::<ANY>(patch, AXES[axis], place);
        }
    }
}

#[apply(simd_levels)]
fn closest(small: &SmallScene, rays: &[Ray], hits: &mut [Option<Hit>]) {
    let mut sheared = [[Column::ZERO; 3]; CORNERS];
    for (axis, members) in Order::new(rays).packs() {
        let mut pack = Pack::new(rays, members, axis);
        pack.offer_all::<false>(small, axis, &mut sheared);
        for (lane, &i) in members.iter().enumerate() {
            hits[usize::from(i)] = (pack.place[lane] != NOTHING).then(|| Hit {
                t: pack.t[lane],
                u: pack.u[lane],
                v: pack.v[lane],
                primitive: small.primitives[pack.place[lane] as usize],
                instance: small.instance,
            });
        }
    }
}

#[apply(simd_levels)]
fn any(small: &SmallScene, rays: &[Ray], occluded: &mut [bool]) {
    let mut sheared = [[Column::ZERO; 3]; CORNERS];
    for (axis, members) in Order::new(rays).packs() {
        let mut pack = Pack::new(rays, members, axis);
        pack.offer_all::<true>(small, axis, &mut sheared);
        for (lane, &i) in members.iter().enumerate() {
            occluded[usize::from(i)] = pack.place[lane] != NOTHING;
        }
    }
}
