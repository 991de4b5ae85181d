//! The walk of a ray through the nodes, near children first; generic over the kernel.

use super::frame::{RayFrame, SLACK};
use super::instances::Placement;
use super::kernel::{EntryStack, Kernel, PacketHits};
use super::node::{Child, Kind, Lanes, Node8, Packet8};
use super::{Hit, Ray, quadric};

/// Everything that a ray may meet. All indices in it are valid by construction.
#[derive(Clone, Debug, Default)]
pub(super) struct Scene {
    pub(super) nodes: Vec<Node8>,
    pub(super) packets: Vec<Packet8>,
    pub(super) quadrics: Vec<quadric::Placed>,
    pub(super) placements: Vec<Placement>,
    /// Where to begin; always a node. `None`: there is nothing.
    pub(super) root: Option<Child>,
    /// Set where `root` is that of the only, untransformed instance: its index.
    pub(super) single: Option<u32>,
}

/// The closest hit so far.
#[derive(Clone, Copy, Debug)]
pub(super) struct Best {
    hit: Hit,
    /// `hit.t` with slack: boxes beyond it are culled.
    pub(super) t_cull: f32,
    found: bool,
}

impl Best {
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
            found: false,
        }
    }

    /// What was found.
    #[inline(always)]
    pub(super) fn hit(&self) -> Option<Hit> {
        self.found.then_some(self.hit)
    }

    /// Takes the hit if it is closer, or as close and of a lesser instance or primitive.
    #[inline(always)]
    fn offer(&mut self, hit: Hit) -> bool {
        let closer = hit.t < self.hit.t
            || (hit.t == self.hit.t
                && (hit.instance, hit.primitive) < (self.hit.instance, self.hit.primitive));
        if closer {
            self.hit = hit;
            self.t_cull = hit.t * SLACK;
            self.found = true;
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
    cast::<K, true>(kernel, scene, ray).is_some_and(|best| best.found)
}

/// `ANY`: stops at the first hit.
#[inline(always)]
fn cast<K: Kernel, const ANY: bool>(kernel: K, scene: &Scene, ray: &Ray) -> Option<Best> {
    let root = scene.root?;
    let frame = RayFrame::new(ray)?;
    let mut best = Best::new(ray.t_max);
    if let Some(instance) = scene.single {
        let leaves = GroupLeaves { scene, instance };
        walk::<K, _, ANY>(kernel, scene, root, &frame, &leaves, &mut best);
    } else {
        let leaves = TopLeaves { scene };
        walk::<K, _, ANY>(kernel, scene, root, &frame, &leaves, &mut best);
    }
    Some(best)
}

/// What happens at a child that is not a node.
pub(super) trait Leaves {
    /// Offers what is hit in it to `best`; says whether anything was taken.
    fn visit<K: Kernel, const ANY: bool>(
        &self,
        kernel: K,
        leaf: Child,
        frame: &RayFrame,
        best: &mut Best,
    ) -> bool;
}

#[inline(always)]
fn walk<K: Kernel, L: Leaves, const ANY: bool>(
    kernel: K,
    scene: &Scene,
    root: Child,
    frame: &RayFrame,
    leaves: &L,
    best: &mut Best,
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

/// Triangles and quadrics.
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
        best: &mut Best,
    ) -> bool {
        let instance = self.instance;
        if leaf.kind() == Kind::Packet {
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
        } else {
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
        best: &mut Best,
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
        walk::<K, _, ANY>(kernel, scene, placement.root, frame, &leaves, best)
    }
}
