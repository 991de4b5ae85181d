//! The tree of one group.

use rayon::prelude::*;

use super::chunks::{self, Item};
use super::collapse::{self, Tree};
use super::kernel::MAX_DEPTH;
use super::node::{Child, ChildKind, Node8, Packet8};
use super::traverse::Scene;
use super::{Bounds, Group, quadric, triangle};

/// A group's arrays, with indices of its own, and their tree.
pub(super) struct GroupTree {
    arrays: Arrays,
    tree: Tree,
    /// How many triangles can be hit.
    pub(super) triangles: usize,
}

/// The arrays that are traversed.
#[derive(Default)]
struct Arrays {
    nodes: Vec<Node8>,
    leaves: Leaves,
}

#[derive(Default)]
struct Leaves {
    packets: Vec<Packet8>,
    quadrics: Vec<quadric::PreparedQuadric>,
}

/// Levels of the tree over the parts of chunks, and of each part: balanced trees over
/// [`MOST_PARTS`] items and over a chunk have no more.
const LEVELS: usize = MAX_DEPTH / 2;
/// Most parts of all chunks together, where there are fewer chunks than that.
const MOST_PARTS: usize = 1 << 17;
/// Most parts of a chunk. They are the items of the tree over all chunks, which is better with more of them.
const PARTS: usize = 256;
/// How many chunks are built at the same time, which bounds the memory.
pub(super) const WAVE: usize = 16;
/// Items from which on reinsertion, which takes most of the time, has less effort.
const LARGE: usize = 1_000_000;
/// Effort of reinsertion in large groups.
const EFFORT_IF_LARGE: f32 = 0.05;

impl GroupTree {
    /// `None` where nothing can be hit. The group has been checked.
    pub(super) fn build(group: &Group<'_>) -> Option<Self> {
        let mut items = items(group);
        let triangles = items.iter().filter(|item| is_triangle(group, item)).count();
        let mut arrays = Arrays::default();
        let tree = match items.len() {
            0 => return None,
            n if n <= 2 * chunks::CHUNK => {
                let Arrays { nodes, leaves } = &mut arrays;
                collapse::build(
                    &bounds(&items),
                    |item| is_triangle(group, &items[item as usize]),
                    nodes,
                    |leaf| leaves.write(group, &items, leaf),
                )
            }
            _ => in_chunks(group, &mut items, &mut arrays),
        };
        Some(Self {
            arrays,
            tree,
            triangles,
        })
    }

    /// Appends the arrays to the scene's; returns the tree with its indices there.
    pub(super) fn append(self, scene: &mut Scene) -> Tree {
        let mut arrays = Arrays {
            nodes: std::mem::take(&mut scene.nodes),
            leaves: Leaves {
                packets: std::mem::take(&mut scene.packets),
                quadrics: std::mem::take(&mut scene.quadrics),
            },
        };
        let offset = arrays.append(self.arrays);
        scene.nodes = arrays.nodes;
        scene.packets = arrays.leaves.packets;
        scene.quadrics = arrays.leaves.quadrics;
        offset.tree(self.tree)
    }
}

/// Everything in a group that can be hit.
fn items(group: &Group<'_>) -> Vec<Item> {
    let triangles = group.triangles.par_iter().with_min_len(1 << 14);
    let item = |(primitive, indices): (usize, &[u32; 3])| Item {
        // An empty box marks a triangle that cannot be hit.
        bounds: triangle::bounds(&indices.map(|v| group.positions[v as usize]))
            .unwrap_or(Bounds::EMPTY),
        primitive: u32::try_from(primitive).expect("counts are checked"),
    };
    let mut items: Vec<Item> = triangles.enumerate().map(item).collect();
    items.retain(|item| item.bounds != Bounds::EMPTY);
    let quadrics = (group.triangles.len()..).zip(group.quadrics);
    items.extend(quadrics.map(|(primitive, quadric)| Item {
        bounds: quadric.bounds(),
        primitive: u32::try_from(primitive).expect("counts are checked"),
    }));
    items
}

fn is_triangle(group: &Group<'_>, item: &Item) -> bool {
    (item.primitive as usize) < group.triangles.len()
}

fn bounds(items: &[Item]) -> Vec<Bounds> {
    items.iter().map(|item| item.bounds).collect()
}

/// The tree of a large group.
fn in_chunks(group: &Group<'_>, items: &mut [Item], arrays: &mut Arrays) -> Tree {
    // As much as is needed in practice, so that arrays need not grow; pages are not touched before they are used.
    arrays.nodes.reserve(items.len() / 9);
    arrays.leaves.packets.reserve(items.len() / 3);
    let effort = if items.len() > LARGE {
        EFFORT_IF_LARGE
    } else {
        collapse::EFFORT
    };
    let chunks = chunks::split(items);
    let parts = (MOST_PARTS / chunks.len()).clamp(1, PARTS);
    let mut trees = Vec::new();
    for wave in chunks.chunks(WAVE) {
        let built: Vec<_> = wave
            .par_iter()
            .map(|chunk| {
                let mut arrays = Arrays::default();
                let Arrays { nodes, leaves } = &mut arrays;
                let trees = collapse::build_parts(
                    &bounds(chunk),
                    parts,
                    (LEVELS, effort),
                    |item| is_triangle(group, &chunk[item as usize]),
                    nodes,
                    |leaf| leaves.write(group, chunk, leaf),
                );
                (arrays, trees)
            })
            .collect();
        for (chunk, parts) in built {
            let offset = arrays.append(chunk);
            trees.extend(parts.into_iter().map(|tree| offset.tree(tree)));
        }
    }
    collapse::join(&trees, LEVELS, &mut arrays.nodes)
}

impl Leaves {
    /// A leaf of one item, or of up to 8 triangles.
    fn write(&mut self, group: &Group<'_>, items: &[Item], leaf: &[u32]) -> Child {
        let first = &items[leaf[0] as usize];
        if !is_triangle(group, first) {
            let quadric = &group.quadrics[first.primitive as usize - group.triangles.len()];
            let placed = quadric::PreparedQuadric::new(quadric, first.primitive);
            self.quadrics.push(placed);
            return Child::new(ChildKind::Quadric, self.quadrics.len() - 1);
        }
        let mut primitives = [0; 8];
        for (primitive, &item) in primitives.iter_mut().zip(leaf) {
            *primitive = items[item as usize].primitive;
        }
        let primitives = &mut primitives[..leaf.len()];
        // In the order of the input, which chunks do not preserve.
        primitives.sort_unstable();
        let mut packet = Packet8::EMPTY;
        for (lane, &primitive) in primitives.iter().enumerate() {
            let indices = group.triangles[primitive as usize];
            packet.set(
                lane,
                indices.map(|v| group.positions[v as usize]),
                primitive,
            );
        }
        self.packets.push(packet);
        Child::new(ChildKind::Packet, self.packets.len() - 1)
    }
}

/// Where arrays begin within others.
struct Offset([usize; 4]);

impl Offset {
    fn child(&self, child: Child) -> Child {
        let kind = child.kind();
        Child::new(kind, self.0[kind as usize] + child.index())
    }

    fn tree(&self, tree: Tree) -> Tree {
        Tree {
            root: self.child(tree.root),
            ..tree
        }
    }
}

impl Arrays {
    /// Appends other arrays.
    fn append(&mut self, other: Self) -> Offset {
        let offset = Offset([
            self.nodes.len(),
            self.leaves.packets.len(),
            self.leaves.quadrics.len(),
            0,
        ]);
        if self.nodes.capacity() == 0 && offset.0 == [0; 4] {
            *self = other;
            return offset;
        }
        self.nodes.extend(other.nodes.into_iter().map(|node| Node8 {
            children: node.children.map(|child| offset.child(child)),
            ..node
        }));
        self.leaves.packets.extend(other.leaves.packets);
        self.leaves.quadrics.extend(other.leaves.quadrics);
        offset
    }
}
