//! Rays through a tree, sixteen at a time. In large trees coherent ones: camera rays of one pixel, and shadow rays of
//! neighbours to one light. In trees of a few nodes, any.
//!
//! Boxes and triangles are tested against all rays of a pack at once, one ray to a lane. Which of them go on is a set of
//! lanes. Where few are left, they go on alone, from that child. Of coherent rays only those boxes and triangles are tested
//! so that what bounds all of them reaches ([`super::frustum`]), eight of which are told at once. In large trees
//! [`super::interleaved`] is faster for rays that part early: after the first pack of such, it takes the rest of the block.
//! Tests are operation by operation those of [`super::traverse`], whose boxes cull no hit: the answers are equal bit for
//! bit.
#![allow(
    clippy::needless_range_loop,
    reason = "an index below the arrays' length is what the compiler makes vectors of"
)]

mod coherent;

use super::ball::Ball;
use super::block::RayBlock;
use super::frame::{self, AXES, FrameGroup, GROUP, SLACK, permuted};
use super::frustum::Frustum;
use super::kernel::Kernel;
use super::node::{self, Child, ChildKind, Node8, Packet8, WIDTH};
use super::pack::Column;
use super::traverse::{ClosestHit, GroupLeaves, Scene};
use super::triangle::{self, max, min};
use super::{Hit, interleaved};

/// Lanes below which rays go on alone: of incoherent ones, and of coherent ones. Measured.
const FEW: [u32; 2] = [3, 2];
/// How often rays of a pack may go on alone in a large tree, until the rest of their block is interleaved instead.
/// Measured.
const MOST_PARTED: u32 = 24;
/// Most nodes of a tree through which all rays go in packs. Measured.
pub(super) const MOST_NODES: usize = 64;

/// A set of lanes, as bits.
type Lanes = u32;

/// Children that a stack has room for from the start. Most trees need fewer, and room for the deepest would have to be cleared
/// for every block.
const USUAL_STACK: usize = 64;

/// A child that waits to be visited by rays of an incoherent pack.
struct Entry {
    /// Where each ray enters its box.
    near: Column,
    child: Child,
    lanes: Lanes,
}

/// Rays in columns, and their closest hits so far.
struct Pack<'a> {
    frames: FrameGroup<'a>,
    first: usize,
    origin: [Column; 3],
    direction: [Column; 3],
    /// See [`super::frame::RayFrame`].
    near_scale: [Column; 3],
    far_scale: [Column; 3],
    /// Of the first ray: the arrays of [`Node8::bounds`] that it reaches first, and its axes.
    near: [usize; 3],
    axes: [usize; 3],
    /// Where rays differ in that: whether directions are negative, and where they are greatest.
    negative: [[bool; GROUP]; 3],
    greatest: [u8; GROUP],
    sheared_origin: [Column; 3],
    shear: [Column; 3],
    t: Column,
    t_cull: Column,
    /// The greatest of those.
    t_most: f32,
    u: Column,
    v: Column,
    primitive: [u32; GROUP],
    hit: Lanes,
    /// How often a ray has gone on alone.
    parted: u32,
}

/// The closest hits of those of the first `n` rays of a block that are traversed so. Returns which groups of [`GROUP`] rays
/// these are, as bits.
#[inline(always)]
pub(super) fn intersect<K: Kernel>(
    kernel: K,
    scene: &Scene,
    rays: (&RayBlock, usize),
    hits: &mut [Option<Hit>],
) -> u32 {
    cast::<K, false>(kernel, scene, rays, |ray, hit| hits[ray] = hit)
}

/// Whether they hit anything, likewise.
#[inline(always)]
pub(super) fn occluded<K: Kernel>(
    kernel: K,
    scene: &Scene,
    rays: (&RayBlock, usize),
    occluded: &mut [bool],
) -> u32 {
    cast::<K, true>(kernel, scene, rays, |ray, hit| {
        occluded[ray] = hit.is_some()
    })
}

#[inline(always)]
fn cast<K: Kernel, const ANY: bool>(
    kernel: K,
    scene: &Scene,
    (rays, n): (&RayBlock, usize),
    mut done: impl FnMut(usize, Option<Hit>),
) -> u32 {
    let (Some(root), Some(instance)) = (scene.root, scene.single) else {
        return 0;
    };
    let leaves = GroupLeaves { scene, instance };
    let is_large = interleaved::gains(scene);
    let (mut stack, mut candidates) = (Vec::new(), Vec::with_capacity(USUAL_STACK));
    let mut groups = 0;
    for (nth, first) in (0..n.saturating_sub(GROUP - 1)).step_by(GROUP).enumerate() {
        let takes_any = scene.nodes.len() <= MOST_NODES;
        let same_sides = frame::lead_to_same_sides(rays, first);
        if !takes_any && !same_sides {
            continue;
        }
        let frames = FrameGroup::new(rays, first);
        let is_coherent = same_sides && frames.have_one_axis();
        if !takes_any && !is_coherent {
            continue;
        }
        let mut pack = Pack::new(frames, first);
        if is_coherent {
            pack.traverse_together::<K, ANY>(kernel, &leaves, root, &mut candidates);
        } else {
            stack.reserve(USUAL_STACK);
            pack.traverse::<K, ANY>(kernel, &leaves, root, &mut stack);
        }
        for lane in 0..GROUP {
            done(first + lane, pack.closest(lane, instance).hit());
        }
        groups |= 1 << nth;
        // Where they part early, the others of the block are likely to do so, too.
        if is_large && pack.parted > MOST_PARTED {
            break;
        }
    }
    groups
}

impl<'a> Pack<'a> {
    #[inline(always)]
    fn new(frames: FrameGroup<'a>, first: usize) -> Self {
        let greatest = frames.axis;
        let axes = AXES[usize::from(greatest[0]) % 3].map(usize::from);
        let column = |values: &[f32]| {
            let mut column = Column::ZERO;
            column.0.copy_from_slice(&values[first..first + GROUP]);
            column
        };
        let (o, d) = (&frames.rays.origin, &frames.rays.direction);
        let origin = [&o.x[..], &o.y[..], &o.z[..]].map(column);
        let direction = [&d.x[..], &d.y[..], &d.z[..]].map(column);
        let t = column(&frames.rays.t_max[..]);
        let near_scale = frames.reciprocal.map(Column);
        let mut far_scale = near_scale;
        for far in &mut far_scale {
            for lane in 0..GROUP {
                far.0[lane] *= SLACK;
            }
        }
        let negative = |c: &[f32]| usize::from(c[first].is_sign_negative());
        let near = [
            negative(&d.x[..]),
            2 + negative(&d.y[..]),
            4 + negative(&d.z[..]),
        ];
        let mut negatives = [[false; GROUP]; 3];
        for (negative, c) in negatives.iter_mut().zip([&d.x, &d.y, &d.z]) {
            for lane in 0..GROUP {
                negative[lane] = c[first + lane].is_sign_negative();
            }
        }
        let mut sheared_origin = [Column::ZERO; 3];
        let mut shear = [
            Column(frames.shear[0]),
            Column(frames.shear[1]),
            Column::ZERO,
        ];
        for lane in 0..GROUP {
            let at = |c: &[Column; 3]| [c[0].0[lane], c[1].0[lane], c[2].0[lane]];
            let [x, y, z] = permuted(greatest[lane], at(&origin));
            sheared_origin[0].0[lane] = x;
            sheared_origin[1].0[lane] = y;
            sheared_origin[2].0[lane] = z;
            shear[2].0[lane] = permuted(greatest[lane], at(&near_scale))[2];
        }
        let mut pack = Self {
            first,
            origin,
            direction,
            near_scale,
            far_scale,
            near,
            axes,
            negative: negatives,
            greatest,
            sheared_origin,
            shear,
            t,
            t_cull: Column::ZERO,
            t_most: 0.0,
            u: Column::ZERO,
            v: Column::ZERO,
            primitive: [0; GROUP],
            hit: 0,
            parted: 0,
            frames,
        };
        pack.set_cull();
        pack
    }

    #[inline(always)]
    fn set_cull(&mut self) {
        for lane in 0..GROUP {
            self.t_cull.0[lane] = self.t.0[lane] * SLACK;
        }
        self.t_most = self.t_cull.greatest();
    }

    /// The closest hit of a ray so far.
    #[inline(always)]
    fn closest(&self, lane: usize, instance: u32) -> ClosestHit {
        let is_hit = self.hit >> lane & 1 == 1;
        ClosestHit::of(
            Hit {
                t: self.t.0[lane],
                u: self.u.0[lane],
                v: self.v.0[lane],
                primitive: self.primitive[lane],
                instance: if is_hit { instance } else { 0 },
            },
            is_hit,
        )
    }

    /// Visits the tree with incoherent rays.
    #[inline(always)]
    fn traverse<K: Kernel, const ANY: bool>(
        &mut self,
        kernel: K,
        leaves: &GroupLeaves<'_>,
        root: Child,
        stack: &mut Vec<Entry>,
    ) {
        stack.clear();
        let (mut current, mut lanes) = (root, self.frames.can_hit());
        loop {
            if current.is_node() && Lanes::count_ones(lanes) >= FEW[0] {
                let node = &leaves.scene.nodes[current.index()];
                if let Some(next) = self.enter_children(kernel, node, lanes, stack) {
                    (current, lanes) = next;
                    continue;
                }
            } else {
                self.visit::<K, ANY>(kernel, leaves, current, lanes, None);
            }
            loop {
                let Some(entry) = stack.pop() else {
                    return;
                };
                lanes = entry.lanes & kernel.are_at_most(&entry.near.0, &self.t_cull.0);
                if ANY {
                    lanes &= !self.hit;
                }
                if lanes != 0 {
                    current = entry.child;
                    break;
                }
            }
        }
    }

    /// Visits a leaf, or any child with few rays.
    ///
    /// * `frustum`: of coherent rays.
    #[inline(always)]
    fn visit<K: Kernel, const ANY: bool>(
        &mut self,
        kernel: K,
        leaves: &GroupLeaves<'_>,
        child: Child,
        lanes: Lanes,
        frustum: Option<&Frustum>,
    ) {
        let scene = leaves.scene;
        if lanes.count_ones() < FEW[usize::from(frustum.is_some())] {
            self.go_alone::<K, ANY>(kernel, leaves, child, lanes);
        } else if child.kind() == ChildKind::Packet {
            let packet = &scene.packets[child.index()];
            if let Some(frustum) = frustum {
                let which = frustum.triangles(kernel, packet, self.t_most);
                self.offer_triangles::<K, ANY, true>(kernel, packet, lanes, which);
            } else {
                let which = packet.occupied_lanes();
                self.offer_triangles::<K, ANY, false>(kernel, packet, lanes, which);
            }
        } else if let Some((ball, primitive)) = scene.ball(child) {
            self.offer_ball::<K, ANY>(kernel, &ball, primitive, lanes);
        } else {
            self.go_alone::<K, ANY>(kernel, leaves, child, lanes);
        }
    }

    /// Finds the children whose boxes rays hit, pushes all but the nearest, the farthest first, and returns that.
    #[inline(always)]
    fn enter_children<K: Kernel>(
        &self,
        kernel: K,
        node: &Node8,
        lanes: Lanes,
        stack: &mut Vec<Entry>,
    ) -> Option<(Child, Lanes)> {
        let mut near = [Column::ZERO; WIDTH];
        let mut sets = [0; WIDTH];
        let mut order = [0_u64; WIDTH];
        let mut count = 0;
        for child in 0..WIDTH {
            if node.bounds[0].0[child] > node.bounds[1].0[child] {
                break;
            }
            let far = self.enter_box::<false>(node, child, &mut near[child]);
            let set = lanes & kernel.are_at_most(&near[child].0, &far.0);
            if set == 0 {
                continue;
            }
            sets[child] = set;
            // Distances are not negative: their bits are ordered as they are.
            let nearest = near[child].0[set.trailing_zeros() as usize % GROUP].to_bits();
            let key = u64::from(nearest) << 32 | child as u64;
            let mut at = count;
            while at > 0 && order[at - 1] < key {
                order[at] = order[at - 1];
                at -= 1;
            }
            order[at] = key;
            count += 1;
        }
        let (last, others) = order[..count].split_last()?;
        let index = |key: u64| (key & 0xffff_ffff) as u32 as usize % WIDTH;
        for &key in others {
            let child = index(key);
            stack.push(Entry {
                near: near[child],
                child: node.children[child],
                lanes: sets[child],
            });
        }
        let child = index(*last);
        Some((node.children[child], sets[child]))
    }

    /// Where the rays enter and leave the box of a child.
    #[inline(always)]
    fn enter_box<const COHERENT: bool>(
        &self,
        node: &Node8,
        child: usize,
        near: &mut Column,
    ) -> Column {
        let mut far = self.t_cull;
        *near = Column::ZERO;
        for axis in 0..3 {
            let side = if COHERENT { self.near[axis] } else { 2 * axis };
            let [low, high] = [side, side ^ 1].map(|side| node.bounds[side % 6].0[child]);
            let origin = &self.origin[axis].0;
            for lane in 0..GROUP {
                let turned = !COHERENT && self.negative[axis][lane];
                let (enter, leave) = if turned { (high, low) } else { (low, high) };
                let t = (enter - origin[lane]) * self.near_scale[axis].0[lane];
                near.0[lane] = max(t, near.0[lane]);
                let t = (leave - origin[lane]) * self.far_scale[axis].0[lane];
                far.0[lane] = min(t, far.0[lane]);
            }
        }
        far
    }

    /// Updates the closest hits by triangles of a packet.
    ///
    /// * `which`: as bits.
    #[inline(always)]
    fn offer_triangles<K: Kernel, const ANY: bool, const COHERENT: bool>(
        &mut self,
        kernel: K,
        packet: &Packet8,
        lanes: Lanes,
        mut which: u32,
    ) {
        let mut open = lanes;
        while which != 0 {
            let k = which.trailing_zeros() as usize % WIDTH;
            which &= which - 1;
            let [a, b, c] = &packet.vertices;
            let (a, b, c) = (
                self.sheared::<COHERENT>(a, k),
                self.sheared::<COHERENT>(b, k),
                self.sheared::<COHERENT>(c, k),
            );
            let at = |p: &[Column; 3], lane: usize| [p[0].0[lane], p[1].0[lane], p[2].0[lane]];
            let (a, b, c) = (&a, &b, &c);
            let (mut lo, mut hi) = (Column::ZERO, Column::ZERO);
            for lane in 0..GROUP {
                let [u, v, w] = triangle::edge_functions(at(a, lane), at(b, lane), at(c, lane));
                lo.0[lane] = min(u, min(v, w));
                hi.0[lane] = max(u, max(v, w));
            }
            // See `triangle::same_sign`.
            let zero = &Column::ZERO.0;
            let inside = kernel.are_at_most(zero, &lo.0) | kernel.are_at_most(&hi.0, zero);
            let inside = open & inside;
            if inside == 0 {
                continue;
            }
            let primitive = packet.primitives[k];
            let (mut t, mut u, mut v) = (Column::ZERO, Column::ZERO, Column::ZERO);
            for lane in 0..GROUP {
                let uvw = triangle::edge_functions(at(a, lane), at(b, lane), at(c, lane));
                let z = [a[2].0[lane], b[2].0[lane], c[2].0[lane]];
                let (t_of, u_of, v_of) = triangle::distance(uvw, z, self.shear[2].0[lane]);
                (t.0[lane], u.0[lane], v.0[lane]) = (t_of, u_of, v_of);
            }
            let taken = self.offer::<K, ANY>(kernel, inside, [&t, &u, &v], primitive);
            if ANY {
                open &= !taken;
                if open == 0 {
                    return;
                }
            }
        }
        if !ANY {
            self.set_cull();
        }
    }

    /// Updates the closest hits by a sphere.
    #[inline(always)]
    fn offer_ball<K: Kernel, const ANY: bool>(
        &mut self,
        kernel: K,
        ball: &Ball,
        primitive: u32,
        lanes: Lanes,
    ) {
        let (mut t, mut misses) = (Column::ZERO, Column::ZERO);
        for lane in 0..GROUP {
            let at = |c: &[Column; 3]| [c[0].0[lane], c[1].0[lane], c[2].0[lane]];
            let near = ball.approach(at(&self.origin), at(&self.direction));
            t.0[lane] = near.t();
            misses.0[lane] = if near.hits() { 0.0 } else { 1.0 };
        }
        let inside = lanes & kernel.are_at_most(&misses.0, &Column::ZERO.0);
        let zero = &Column::ZERO;
        if inside != 0 && self.offer::<K, ANY>(kernel, inside, [&t, zero, zero], primitive) != 0 {
            self.set_cull();
        }
    }

    /// Takes the hits of a primitive that are closer than those so far, or as close and of a smaller index. Returns their
    /// lanes.
    #[inline(always)]
    fn offer<K: Kernel, const ANY: bool>(
        &mut self,
        kernel: K,
        lanes: Lanes,
        [t, u, v]: [&Column; 3],
        primitive: u32,
    ) -> Lanes {
        let mut not_closer = Column::ZERO;
        for lane in 0..GROUP {
            let (t, best) = (t.0[lane], self.t.0[lane]);
            let ties = (t == best) & (primitive < self.primitive[lane]);
            let closer = (t > 0.0) & ((t < best) | ties);
            not_closer.0[lane] = if closer { 0.0 } else { 1.0 };
        }
        let closer = lanes & kernel.are_at_most(&not_closer.0, &Column::ZERO.0);
        self.hit |= closer;
        if ANY || closer == 0 {
            return closer;
        }
        for lane in 0..GROUP {
            let is_closer = closer >> lane & 1 == 1;
            let pick = |new: f32, old: f32| if is_closer { new } else { old };
            self.t.0[lane] = pick(t.0[lane], self.t.0[lane]);
            self.u.0[lane] = pick(u.0[lane], self.u.0[lane]);
            self.v.0[lane] = pick(v.0[lane], self.v.0[lane]);
            let old = self.primitive[lane];
            self.primitive[lane] = if is_closer { primitive } else { old };
        }
        closer
    }

    /// A corner of a triangle, sheared along each ray.
    #[inline(always)]
    fn sheared<const COHERENT: bool>(&self, corner: &[node::Lanes; 3], k: usize) -> [Column; 3] {
        let corner = [corner[0].0[k], corner[1].0[k], corner[2].0[k]];
        let common = self.axes.map(|axis| corner[axis % 3]);
        let (o, s) = (&self.sheared_origin, &self.shear);
        let mut sheared = [Column::ZERO; 3];
        for lane in 0..GROUP {
            let at = |c: &[Column; 3]| [c[0].0[lane], c[1].0[lane], c[2].0[lane]];
            let p = if COHERENT {
                common
            } else {
                permuted(self.greatest[lane], corner)
            };
            let [x, y, z] = triangle::shear(p, at(o), at(s));
            sheared[0].0[lane] = x;
            sheared[1].0[lane] = y;
            sheared[2].0[lane] = z;
        }
        sheared
    }

    /// Visits a child with one ray after the other.
    #[inline(always)]
    fn go_alone<K: Kernel, const ANY: bool>(
        &mut self,
        kernel: K,
        leaves: &GroupLeaves<'_>,
        child: Child,
        mut lanes: Lanes,
    ) {
        self.parted += lanes.count_ones();
        while lanes != 0 {
            let lane = lanes.trailing_zeros() as usize % GROUP;
            lanes &= lanes - 1;
            let Some(frame) = self.frames.get(self.first + lane) else {
                continue;
            };
            let mut best = self.closest(lane, leaves.instance);
            if !kernel.visit_below::<ANY>(leaves, child, &frame, &mut best) {
                continue;
            }
            let Some(hit) = best.hit() else { continue };
            self.hit |= 1 << lane;
            self.t.0[lane] = hit.t;
            self.t_cull.0[lane] = hit.t * SLACK;
            self.u.0[lane] = hit.u;
            self.v.0[lane] = hit.v;
            self.primitive[lane] = hit.primitive;
        }
    }
}
