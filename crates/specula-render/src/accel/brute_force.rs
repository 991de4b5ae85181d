//! Small scenes: sixteen rays at a time against every primitive.
//!
//! Below a few dozen primitives a tree costs more than it saves. Rays are stored as structures of arrays (`pack.rs`).
//!
//! - Pairs of triangles that are [rectangles](super::rectangle) across an axis are tested as such, and six pairs that
//!   are a [box](super::parallelepiped) as one; spheres that no transform squeezes [in single precision](super::ball).
//!   Single rays take the same way where a scene has any of them.
//! - Other triangles that share corners are tested together: each corner is sheared once. Distances are computed for
//!   those that the line of any ray of the pack passes through. For them rays are sorted by the axis in which their
//!   direction is greatest, so that the test permutes the coordinates of all alike.
//!
//! Tests of those triangles, and of other quadrics and patches, are operation by operation those of the traversal, whose
//! boxes cull no hit: the answers are equal bit for bit, but for slivers in rooms that are a million of their own sizes
//! away from the origin: rounding lets rays beside them hit. Primitives of one kind come in ascending order, so that of
//! equal distances the first stays.

use macro_rules_attribute::apply;

use super::ball::Ball;
use super::block::{BLOCK, RayBlock};
use super::clusters::{Cluster, Plane};
use super::frame::greatest_axis;
use super::node::ChildKind;
use super::pack::{NOTHING, PACK, Pack};
use super::parallelepiped::Parallelepiped;
use super::parallelogram::{Face, Parallelogram, Triangle};
use super::patch::PreparedPatch;
use super::quadric::PreparedQuadric;
use super::rectangle::Rectangle;
use super::traverse::Scene;
use super::{Bounds, Hit, Ray};
use crate::convert::id;
use crate::simd::simd_levels;
use crate::soa::{Column, Floats};

/// Most time that a small scene takes, in that of a rectangle. Measured in rooms with rectangles, boxes and spheres: at a
/// third more the tree is as fast.
const MOST: usize = 160;
/// Rectangles that take as long as another triangle.
const TRIANGLE: usize = 2;
/// As long as a box.
const BOX: usize = 5;
/// As long as a sphere that no transform squeezes.
const BALL: usize = 3;
/// As long as another quadric.
const QUADRIC: usize = 6;
/// As long as a patch, whose lanes are tested one after the other.
const PATCH: usize = 16;

/// The primitives of a small scene.
#[derive(Clone, Debug)]
pub(super) struct SmallScene {
    pub(super) rectangles: Vec<Rectangle>,
    pub(super) boxes: Vec<Parallelepiped>,
    /// Of the rectangles, then six of each box.
    faces: Vec<Face>,
    /// All other triangles, ascending.
    pub(super) clusters: Vec<Cluster>,
    /// The same for shadow rays, which cross few planes, in more clusters.
    pub(super) occluders: Vec<Cluster>,
    pub(super) balls: Vec<Ball>,
    pub(super) quadrics: Vec<PreparedQuadric>,
    pub(super) patches: Vec<PreparedPatch>,
    /// Indices of the primitives from the triangles on.
    primitives: Vec<u32>,
    pub(super) places: Places,
    instance: u32,
}

/// Where each kind of primitive begins; rectangles begin at 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Places {
    /// Their faces.
    pub(super) boxes: u32,
    pub(super) triangles: u32,
    pub(super) balls: u32,
    pub(super) quadrics: u32,
    pub(super) patches: u32,
}

/// What a block of rays hits.
#[derive(Clone, Debug)]
pub(crate) struct SmallHits {
    pub(crate) t: Floats<BLOCK>,
    /// Barycentric weights, where a triangle or a patch is hit.
    u: Floats<BLOCK>,
    v: Floats<BLOCK>,
    /// What is hit, by its place; or [`NOTHING`].
    pub(crate) place: Column<u32, BLOCK>,
}

impl SmallHits {
    pub(super) const NONE: Self = Self {
        t: Floats::of(0.0),
        u: Floats::of(0.0),
        v: Floats::of(0.0),
        place: Column::of(NOTHING),
    };
}

/// What the leaves of a tree hold, by the indices of primitives.
#[derive(Default)]
struct Leaves {
    triangles: Vec<Triangle>,
    quadrics: Vec<PreparedQuadric>,
    patches: Vec<PreparedPatch>,
}

impl Leaves {
    /// `None` where there are curves.
    fn of(scene: &Scene) -> Option<Self> {
        let mut leaves = Self::default();
        let mut pending = vec![scene.root?];
        while let Some(child) = pending.pop() {
            match child.kind() {
                ChildKind::Node => pending.extend(scene.nodes[child.index()].occupied()),
                ChildKind::Packet => {
                    (leaves.triangles).extend(scene.packets[child.index()].occupied());
                }
                ChildKind::Quadric => leaves.quadrics.push(scene.quadrics[child.index()]),
                ChildKind::PatchOrPlacement => leaves.patches.push(scene.patches[child.index()]),
                // Of which there are many.
                ChildKind::CurvePart => return None,
            }
        }
        leaves.triangles.sort_unstable_by_key(|t| t.0);
        leaves.quadrics.sort_unstable_by_key(|q| q.primitive);
        leaves.patches.sort_unstable_by_key(|p| p.primitive);
        Some(leaves)
    }
}

impl SmallScene {
    /// `None` where the scene is empty, too large, or anything but one untransformed instance.
    pub(super) fn new(scene: &Scene) -> Option<Self> {
        let instance = scene.single?;
        if scene.packets.len() + scene.quadrics.len() + scene.patches.len() > MOST {
            return None;
        }
        let Leaves {
            triangles,
            quadrics,
            patches,
        } = Leaves::of(scene)?;
        let bounds = (triangles.iter())
            .map(|(_, corners)| Bounds::around(corners))
            .fold(Bounds::EMPTY, |all, own| all.union(&own));
        let Solids {
            rectangles,
            boxes,
            faces,
            triangles,
        } = Solids::of(&triangles);
        let (balls, quadrics): (Vec<_>, Vec<_>) =
            (quadrics.into_iter()).partition(|q| q.ball().is_some());
        let time = rectangles.len()
            + BOX * boxes.len()
            + TRIANGLE * triangles.len()
            + BALL * balls.len()
            + QUADRIC * quadrics.len()
            + PATCH * patches.len();
        if time > MOST {
            return None;
        }
        let boxes_from = id(rectangles.len());
        let triangles_from = id(faces.len());
        let balls_from = triangles_from + id(triangles.len());
        let quadrics_from = balls_from + id(balls.len());
        let places = Places {
            boxes: boxes_from,
            triangles: triangles_from,
            balls: balls_from,
            quadrics: quadrics_from,
            patches: quadrics_from + id(quadrics.len()),
        };
        Some(Self {
            rectangles,
            boxes,
            faces,
            clusters: Cluster::all(&triangles, |_| None),
            occluders: Cluster::all(&triangles, |corners| Plane::of(corners, &bounds)),
            primitives: (triangles.iter().map(|t| t.0))
                .chain(balls.iter().map(|q| q.primitive))
                .chain(quadrics.iter().map(|q| q.primitive))
                .chain(patches.iter().map(|p| p.primitive))
                .collect(),
            balls: balls.iter().filter_map(PreparedQuadric::ball).collect(),
            quadrics,
            patches,
            places,
            instance,
        })
    }

    /// Whether some of its primitives are tested otherwise than in the tree.
    pub(super) fn has_own_tests(&self) -> bool {
        !self.faces.is_empty() || !self.balls.is_empty()
    }

    /// The primitives of each place, one of them twice where there is one, and the instance.
    pub(super) fn primitives(&self) -> (Vec<[u32; 2]>, u32) {
        let faces = self.faces.iter().map(Face::primitives);
        let others = self.primitives.iter().map(|&p| [p; 2]);
        (faces.chain(others).collect(), self.instance)
    }

    /// The closest hits of the rays, in order.
    pub(super) fn intersect(&self, rays: &[Ray], hits: &mut Vec<Option<Hit>>) {
        hits.clear();
        let mut found = SmallHits::NONE;
        for rays in rays.chunks(BLOCK) {
            self.intersect_block(&RayBlock::of(rays), rays.len(), &mut found);
            hits.extend((0..).zip(rays).map(|(k, ray)| self.hit(&found, k, ray)));
        }
    }

    /// The closest hits of the first `n` rays of a block.
    pub(super) fn intersect_block(&self, rays: &RayBlock, n: usize, hits: &mut SmallHits) {
        closest(self, rays, n, hits);
    }

    /// Whether the rays hit anything, in order.
    pub(super) fn occluded(&self, rays: &[Ray], occluded: &mut Vec<bool>) {
        occluded.clear();
        occluded.resize(rays.len(), false);
        for (rays, occluded) in rays.chunks(BLOCK).zip(occluded.chunks_mut(BLOCK)) {
            any(self, &RayBlock::of(rays), occluded);
        }
    }

    /// Whether the first rays of a block hit anything.
    pub(super) fn occluded_block(&self, rays: &RayBlock, occluded: &mut [bool]) {
        any(self, rays, occluded);
    }

    /// [`Self::intersect`] of one ray.
    #[inline(never)]
    pub(super) fn intersect_one(&self, ray: &Ray) -> Option<Hit> {
        let mut pack = Pack::of(ray);
        let axis = greatest_axis(ray)?;
        closest_of_pack(self, &mut pack, usize::from(axis));
        self.hit_at(pack.place[0], [pack.t[0], pack.u[0], pack.v[0]], ray)
    }

    /// [`Self::occluded`] of one ray.
    #[inline(never)]
    pub(super) fn occluded_one(&self, ray: &Ray) -> bool {
        let mut pack = Pack::of(ray);
        let Some(axis) = greatest_axis(ray) else {
            return false;
        };
        any_of_pack(self, &mut pack, usize::from(axis));
        pack.place[0] != NOTHING
    }

    /// The hit of a ray of a block.
    #[inline(always)]
    pub(super) fn hit(&self, hits: &SmallHits, k: usize, ray: &Ray) -> Option<Hit> {
        self.hit_at(hits.place[k], [hits.t[k], hits.u[k], hits.v[k]], ray)
    }

    #[inline(always)]
    fn hit_at(&self, place: u32, [t, u, v]: [f32; 3], ray: &Ray) -> Option<Hit> {
        if place == NOTHING {
            return None;
        }
        let instance = self.instance;
        if let Some(face) = self.faces.get(place as usize) {
            let on = face.at((ray.origin + ray.direction * t).to_array());
            return Some(Hit {
                t,
                u: on.u,
                v: on.v,
                primitive: on.primitive,
                instance,
            });
        }
        let has_coordinates = (place < self.places.balls) | (place >= self.places.patches);
        let coordinate = |c: f32| if has_coordinates { c } else { 0.0 };
        Some(Hit {
            t,
            u: coordinate(u),
            v: coordinate(v),
            primitive: self.primitives[(place - self.places.triangles) as usize],
            instance,
        })
    }

    /// Whether rays are sorted by the axes of their directions.
    #[inline(always)]
    fn sorts(&self) -> bool {
        !self.clusters.is_empty() || !self.patches.is_empty()
    }
}

/// Triangles, as what they are tested as.
struct Solids {
    rectangles: Vec<Rectangle>,
    boxes: Vec<Parallelepiped>,
    faces: Vec<Face>,
    triangles: Vec<Triangle>,
}

impl Solids {
    fn of(triangles: &[Triangle]) -> Self {
        let (parallelograms, mut triangles_left) = Parallelogram::all(triangles);
        let (boxes, others) = Parallelepiped::all(&parallelograms);
        let (mut rectangles, mut faces) = (Vec::new(), Vec::new());
        for parallelogram in others.into_iter().map(|k| &parallelograms[k]) {
            if let Some(rectangle) = Rectangle::of(parallelogram) {
                rectangles.push(rectangle);
                faces.push(parallelogram.face());
            } else {
                let is_own = |t: &&Triangle| parallelogram.primitives().contains(&t.0);
                triangles_left.extend(triangles.iter().filter(is_own));
            }
        }
        triangles_left.sort_unstable_by_key(|t| t.0);
        for (_, own) in &boxes {
            faces.extend(own.map(|k| parallelograms[k].face()));
        }
        Self {
            rectangles,
            boxes: boxes.into_iter().map(|(solid, _)| solid).collect(),
            faces,
            triangles: triangles_left,
        }
    }
}

/// Rays that can hit, by the axes in which their directions are greatest.
struct Order {
    rays: [u16; BLOCK],
    /// Where those of each axis end.
    ends: [usize; 3],
}

impl Order {
    /// That of the first `n` rays.
    #[inline(always)]
    fn new(rays: &RayBlock, n: usize) -> Self {
        const NEVER: u8 = 3;
        let mut axes = [NEVER; BLOCK];
        for (k, axis) in axes[..n].iter_mut().enumerate() {
            *axis = greatest_axis(&rays.get(k)).unwrap_or(NEVER);
        }
        let count = |wanted: u8| axes.iter().filter(|&&axis| axis == wanted).count();
        let [x, y, z] = [0, 1, 2].map(count);
        let mut next = [0, x, x + y, x + y + z];
        let mut order = [0; BLOCK];
        for (i, axis) in (0..=u16::MAX).zip(&axes[..n]) {
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

#[apply(simd_levels)]
fn closest(small: &SmallScene, rays: &RayBlock, n: usize, hits: &mut SmallHits) {
    let n = n.min(BLOCK);
    let (mut pack, mut sheared) = (Pack::NONE, Pack::NOTHING_SHEARED);
    if small.sorts() {
        hits.place[..n].fill(NOTHING);
        for (axis, members) in Order::new(rays, n).packs() {
            pack.gather(rays, members);
            pack.offer_all::<false>(small, axis, &mut sheared);
            for (lane, &i) in members.iter().enumerate() {
                let i = usize::from(i) % BLOCK;
                hits.t[i] = pack.t[lane];
                hits.u[i] = pack.u[lane];
                hits.v[i] = pack.v[lane];
                hits.place[i] = pack.place[lane];
            }
        }
        return;
    }
    for from in (0..n).step_by(PACK) {
        pack.load(rays, from);
        pack.offer_all::<false>(small, 0, &mut sheared);
        hits.t[from..from + PACK].copy_from_slice(&pack.t.0);
        hits.place[from..from + PACK].copy_from_slice(&pack.place);
    }
}

#[apply(simd_levels)]
fn any(small: &SmallScene, rays: &RayBlock, occluded: &mut [bool]) {
    let (mut pack, mut sheared) = (Pack::NONE, Pack::NOTHING_SHEARED);
    if small.sorts() {
        occluded.fill(false);
        for (axis, members) in Order::new(rays, occluded.len().min(BLOCK)).packs() {
            pack.gather(rays, members);
            pack.offer_all::<true>(small, axis, &mut sheared);
            for (lane, &i) in members.iter().enumerate() {
                occluded[usize::from(i)] = pack.place[lane] != NOTHING;
            }
        }
        return;
    }
    for (nth, occluded) in occluded.chunks_mut(PACK).take(BLOCK / PACK).enumerate() {
        pack.load(rays, nth * PACK);
        pack.offer_all::<true>(small, 0, &mut sheared);
        for (occluded, place) in occluded.iter_mut().zip(&pack.place) {
            *occluded = *place != NOTHING;
        }
    }
}

#[apply(simd_levels)]
fn closest_of_pack(small: &SmallScene, pack: &mut Pack, axis: usize) {
    pack.offer_all::<false>(small, axis, &mut Pack::NOTHING_SHEARED.clone());
}

#[apply(simd_levels)]
fn any_of_pack(small: &SmallScene, pack: &mut Pack, axis: usize) {
    pack.offer_all::<true>(small, axis, &mut Pack::NOTHING_SHEARED.clone());
}
