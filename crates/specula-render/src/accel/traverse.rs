//! Traversal of the trees by a ray, near children first; generic over the kernel.

use super::ball::Ball;
use super::curve::{CurvePart, CurveSegment};
use super::frame::{RayFrame, SLACK};
use super::instances::{self, Placement};
use super::kernel::{EntryStack, Kernel, PacketHits};
use super::node::{Child, ChildKind, Lanes, Node8, Packet8};
use super::patch::{PreparedPatch, UvHit};
use super::{Hit, Ray, quadric};
use crate::movement::Movement;

/// Everything that a ray may hit. All indices in it are valid by construction.
#[derive(Clone, Debug, Default)]
pub(super) struct Scene {
    pub(super) nodes: Vec<Node8>,
    pub(super) packets: Vec<Packet8>,
    pub(super) quadrics: Vec<quadric::PreparedQuadric>,
    pub(super) patches: Vec<PreparedPatch>,
    pub(super) curves: Vec<CurveSegment>,
    pub(super) curve_parts: Vec<CurvePart>,
    pub(super) placements: Vec<Placement>,
    /// How those move that do.
    pub(super) movements: Vec<Movement>,
    /// The root; always a node. `None`: the scene is empty.
    pub(super) root: Option<Child>,
    /// Set where `root` is that of the only, untransformed instance: its index.
    pub(super) single: Option<u32>,
}

/// The closest hit so far.
#[derive(Clone, Copy, Debug)]
pub(super) struct ClosestHit {
    hit: Hit,
    /// `hit.t` with slack: boxes beyond it are culled.
    pub(super) t_cull: f32,
    is_hit: bool,
}

impl ClosestHit {
    #[inline(always)]
    pub(super) fn new(t_max: f32) -> Self {
        Self {
            // No primitive comes before (0, 0), so that a hit at `t_max` itself never counts.
            hit: Hit {
                t: t_max,
                u: 0.0,
                v: 0.0,
                primitive: 0,
                instance: 0,
            },
            t_cull: t_max * SLACK,
            is_hit: false,
        }
    }

    /// What was the closest hit before; where there is none yet, of the index 0 and at the ray's end.
    #[inline(always)]
    pub(super) fn of(hit: Hit, is_hit: bool) -> Self {
        Self {
            t_cull: hit.t * SLACK,
            hit,
            is_hit,
        }
    }

    /// The closest hit; `None` where there is none.
    #[inline(always)]
    pub(super) fn hit(&self) -> Option<Hit> {
        self.is_hit.then_some(self.hit)
    }

    /// Replaces the closest hit by this one if it is closer, or as close and of a smaller instance or primitive;
    /// returns whether it did.
    #[inline(always)]
    fn offer(&mut self, hit: Hit) -> bool {
        let closer = hit.t < self.hit.t
            || (hit.t == self.hit.t
                && (hit.instance, hit.primitive) < (self.hit.instance, self.hit.primitive));
        if closer {
            self.hit = hit;
            self.t_cull = hit.t * SLACK;
            self.is_hit = true;
        }
        closer
    }
}

#[inline(always)]
pub(super) fn intersect<K: Kernel>(kernel: K, scene: &Scene, ray: &Ray) -> Option<Hit> {
    cast::<K, false>(kernel, scene, ray)?.hit()
}

#[inline(always)]
pub(super) fn occluded<K: Kernel>(kernel: K, scene: &Scene, ray: &Ray) -> bool {
    cast::<K, true>(kernel, scene, ray).is_some_and(|best| best.is_hit)
}

/// The closest hit; `None` where the ray cannot hit.
///
/// * `ANY`: stops at any hit.
#[inline(always)]
fn cast<K: Kernel, const ANY: bool>(kernel: K, scene: &Scene, ray: &Ray) -> Option<ClosestHit> {
    let root = scene.root?;
    let frame = RayFrame::new(ray)?;
    Some(cast_frame::<K, ANY>(kernel, scene, root, &frame))
}

/// [`cast`] of a ray that can hit.
#[inline(always)]
pub(super) fn cast_frame<K: Kernel, const ANY: bool>(
    kernel: K,
    scene: &Scene,
    root: Child,
    frame: &RayFrame,
) -> ClosestHit {
    let mut best = ClosestHit::new(frame.ray.t_max);
    if let Some(instance) = scene.single {
        let leaves = GroupLeaves { scene, instance };
        traverse_tree::<K, _, ANY>(kernel, scene, root, frame, &leaves, &mut best);
    } else {
        let leaves = TopLeaves { scene };
        traverse_tree::<K, _, ANY>(kernel, scene, root, frame, &leaves, &mut best);
    }
    best
}

/// Traverses what lies below a child and updates `best`; returns whether it changed.
#[inline(always)]
pub(super) fn visit_below<K: Kernel, const ANY: bool>(
    kernel: K,
    leaves: &GroupLeaves<'_>,
    child: Child,
    frame: &RayFrame,
    best: &mut ClosestHit,
) -> bool {
    traverse_tree::<K, _, ANY>(kernel, leaves.scene, child, frame, leaves, best)
}

/// [`intersect`] at a time, where instances move.
#[inline(always)]
pub(super) fn intersect_at<K: Kernel>(
    kernel: K,
    scene: &Scene,
    ray: &Ray,
    time: f32,
) -> Option<Hit> {
    cast_at::<K, false>(kernel, scene, ray, time)?.hit()
}

/// [`occluded`] at a time, where instances move.
#[inline(always)]
pub(super) fn occluded_at<K: Kernel>(kernel: K, scene: &Scene, ray: &Ray, time: f32) -> bool {
    cast_at::<K, true>(kernel, scene, ray, time).is_some_and(|best| best.is_hit)
}

/// [`cast`] where instances move.
#[inline(always)]
fn cast_at<K: Kernel, const ANY: bool>(
    kernel: K,
    scene: &Scene,
    ray: &Ray,
    time: f32,
) -> Option<ClosestHit> {
    let root = scene.root?;
    let frame = RayFrame::new(ray)?;
    let mut best = ClosestHit::new(ray.t_max);
    let leaves = MovingLeaves { scene, time };
    traverse_tree::<K, _, ANY>(kernel, scene, root, &frame, &leaves, &mut best);
    Some(best)
}

/// The leaves of a tree: what is done at a child that is not a node.
pub(super) trait Leaves {
    /// Intersects a leaf and updates `best`; returns whether it changed.
    fn visit<K: Kernel, const ANY: bool>(
        &self,
        kernel: K,
        leaf: Child,
        frame: &RayFrame,
        best: &mut ClosestHit,
    ) -> bool;
}

/// Traverses a tree and updates `best`; returns whether it changed.
#[inline(always)]
fn traverse_tree<K: Kernel, L: Leaves, const ANY: bool>(
    kernel: K,
    scene: &Scene,
    root: Child,
    frame: &RayFrame,
    leaves: &L,
    best: &mut ClosestHit,
) -> bool {
    // An entry is the bits of the entry distance (not negative, so they sort as it does) and below
    // them the child.
    let mut stack = kernel.stack();
    let mut top = 0;
    let mut current = root;
    let mut taken = false;
    let mut entries = Lanes::default();
    loop {
        if current.is_node() {
            let node = &scene.nodes[current.index()];
            let mut mask = kernel.boxes(node, frame, best.t_cull, &mut entries);
            if mask != 0 {
                let mut next_entry = || {
                    let lane = (mask.trailing_zeros() & 7) as usize;
                    mask &= mask - 1;
                    let child = u64::from(node.children[lane].0);
                    let entry = (u64::from(entries.0[lane].to_bits()) << 32) | child;
                    (entry, mask != 0)
                };
                let base = top;
                let (mut nearest, mut more) = next_entry();
                while more {
                    let entry;
                    (entry, more) = next_entry();
                    let farther = nearest.max(entry);
                    nearest = nearest.min(entry);
                    let mut at = top;
                    if !ANY {
                        // The farthest at the bottom.
                        while at > base && stack.get(at - 1) < farther {
                            stack.set(at, stack.get(at - 1));
                            at -= 1;
                        }
                    }
                    stack.set(at, farther);
                    top += 1;
                }
                current = child_of(nearest);
                continue;
            }
        } else if leaves.visit::<K, ANY>(kernel, current, frame, best) {
            taken = true;
            if ANY {
                return true;
            }
        }
        loop {
            if top == 0 {
                return taken;
            }
            top -= 1;
            let entry = stack.get(top);
            if ANY || f32::from_bits((entry >> 32) as u32) <= best.t_cull {
                current = child_of(entry);
                break;
            }
        }
    }
}

#[inline(always)]
pub(super) fn child_of(entry: u64) -> Child {
    Child((entry & 0xffff_ffff) as u32)
}

impl Scene {
    /// A child's sphere and its primitive, where that is one which no transform squeezes.
    #[inline(always)]
    pub(super) fn ball(&self, child: Child) -> Option<(Ball, u32)> {
        if child.kind() != ChildKind::Quadric {
            return None;
        }
        let quadric = &self.quadrics[child.index()];
        Some((quadric.ball()?, quadric.primitive))
    }

    /// The hit of a patch or a part of a curve, with its primitive.
    ///
    /// Cold, so that the traversal keeps its registers for triangles.
    #[cold]
    #[inline(never)]
    fn uv_hit(&self, leaf: Child, frame: &RayFrame) -> (UvHit, u32) {
        if leaf.kind() == ChildKind::CurvePart {
            let part = &self.curve_parts[leaf.part_index()];
            let curve = &self.curves[part.curve as usize];
            (curve.hit(part.part, &frame.ray), part.primitive)
        } else {
            let patch = &self.patches[leaf.index()];
            (patch.hit(&frame.ray, frame.axes), patch.primitive)
        }
    }
}

/// Triangles, quadrics, patches and curves.
pub(super) struct GroupLeaves<'a> {
    pub(super) scene: &'a Scene,
    pub(super) instance: u32,
}

impl Leaves for GroupLeaves<'_> {
    #[inline(always)]
    fn visit<K: Kernel, const ANY: bool>(
        &self,
        kernel: K,
        leaf: Child,
        frame: &RayFrame,
        best: &mut ClosestHit,
    ) -> bool {
        let instance = self.instance;
        if leaf.kind() == ChildKind::Packet {
            let packet = &self.scene.packets[leaf.index()];
            let mut hits = PacketHits::default();
            let mut mask = kernel.triangles(packet, frame, best.hit.t, &mut hits);
            let mut taken = false;
            while mask != 0 {
                let lane = (mask.trailing_zeros() & 7) as usize;
                mask &= mask - 1;
                taken |= best.offer(Hit {
                    t: hits.t.0[lane],
                    u: hits.u.0[lane],
                    v: hits.v.0[lane],
                    primitive: packet.primitives[lane],
                    instance,
                });
            }
            taken
        } else if leaf.kind() == ChildKind::Quadric {
            let quadric = &self.scene.quadrics[leaf.index()];
            let t = quadric.t(&frame.ray);
            t > 0.0
                && best.offer(Hit {
                    t,
                    u: 0.0,
                    v: 0.0,
                    primitive: quadric.primitive,
                    instance,
                })
        } else {
            let (hit, primitive) = self.scene.uv_hit(leaf, frame);
            hit.t > 0.0
                && best.offer(Hit {
                    t: hit.t,
                    u: hit.u,
                    v: hit.v,
                    primitive,
                    instance,
                })
        }
    }
}

/// Instances.
struct TopLeaves<'a> {
    scene: &'a Scene,
}

impl Leaves for TopLeaves<'_> {
    #[inline(always)]
    fn visit<K: Kernel, const ANY: bool>(
        &self,
        kernel: K,
        leaf: Child,
        frame: &RayFrame,
        best: &mut ClosestHit,
    ) -> bool {
        let placement = &self.scene.placements[leaf.index()];
        let (scene, instance) = (self.scene, placement.instance);
        let leaves = GroupLeaves { scene, instance };
        let own;
        let frame = if placement.identity {
            frame
        } else if let Some(moved) = RayFrame::new(&placement.enter(&frame.ray)) {
            own = moved;
            &own
        } else {
            return false;
        };
        traverse_tree::<K, _, ANY>(kernel, scene, placement.root, frame, &leaves, best)
    }
}

/// Instances at a time.
struct MovingLeaves<'a> {
    scene: &'a Scene,
    time: f32,
}

impl Leaves for MovingLeaves<'_> {
    #[inline(always)]
    fn visit<K: Kernel, const ANY: bool>(
        &self,
        kernel: K,
        leaf: Child,
        frame: &RayFrame,
        best: &mut ClosestHit,
    ) -> bool {
        let scene = self.scene;
        let placement = &scene.placements[leaf.index()];
        let Some(movement) = scene.movements.get(placement.movement as usize) else {
            return TopLeaves { scene }.visit::<K, ANY>(kernel, leaf, frame, best);
        };
        let ray = instances::enter_moving(movement, self.time, &frame.ray);
        let Some(frame) = RayFrame::new(&ray) else {
            return false;
        };
        let instance = placement.instance;
        let leaves = GroupLeaves { scene, instance };
        traverse_tree::<K, _, ANY>(kernel, scene, placement.root, &frame, &leaves, best)
    }
}
