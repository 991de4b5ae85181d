//! The tree of one group.

use rayon::prelude::*;

use super::chunks::{self, Item};
use super::collapse::{self, Tree};
use super::kernel::MAX_DEPTH;
use super::node::{Child, ChildKind, Node8, Packet8};
use super::traverse::Scene;
use super::{Bounds, CurveSegment, Group, curve, patch, quadric, triangle};
use crate::huge_pages;

/// A group's arrays, with indices of its own, and their tree.
pub(super) struct GroupTree {
    arrays: Arrays,
    tree: Tree,
    curves: Vec<CurveSegment>,
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
    patches: Vec<patch::PreparedPatch>,
    curve_parts: Vec<curve::CurvePart>,
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
/// Items from which on reinsertion has less effort.
const LARGE: usize = 500_000;
/// Effort of reinsertion in large groups.
const EFFORT_IF_LARGE: f32 = 0.05;
/// Two triangles are one item where the box around them has at most this share of their boxes' areas: half of it,
/// where both have the same box.
const PAIRED: f64 = 0.75;
/// Nodes or packets that a thread copies at least.
const COPIED: usize = 1 << 12;
/// Triangles that are paired at a time.
const BLOCK: usize = 1 << 14;

impl GroupTree {
    /// `None` where nothing can be hit. The group has been checked.
    pub(super) fn build(group: &Group<'_>) -> Option<Self> {
        let mut items = items(group);
        let triangles = items.iter().map(|item| triangles(group, item)).sum();
        let mut arrays = Arrays::default();
        let tree = match items.len() {
            0 => return None,
            n if n <= 2 * chunks::CHUNK => {
                arrays.reserve(n.min(group.triangles.len()));
                let Arrays { nodes, leaves } = &mut arrays;
                collapse::build(
                    &bounds(&items),
                    |item| self::triangles(group, &items[item as usize]),
                    nodes,
                    |leaf| leaves.write(group, &items, leaf),
                )
            }
            _ => in_chunks(group, &mut items, &mut arrays),
        };
        Some(Self {
            arrays,
            tree,
            curves: group.curves.to_vec(),
            triangles,
        })
    }

    /// Appends the arrays to the scene's; returns the tree with its indices there.
    pub(super) fn append(mut self, scene: &mut Scene) -> Tree {
        let first_curve = crate::convert::id(scene.curves.len());
        for part in &mut self.arrays.leaves.curve_parts {
            part.curve += first_curve;
        }
        scene.curves.append(&mut self.curves);
        let mut arrays = Arrays {
            nodes: std::mem::take(&mut scene.nodes),
            leaves: Leaves {
                packets: std::mem::take(&mut scene.packets),
                quadrics: std::mem::take(&mut scene.quadrics),
                patches: std::mem::take(&mut scene.patches),
                curve_parts: std::mem::take(&mut scene.curve_parts),
            },
        };
        let offset = arrays.append(self.arrays);
        scene.nodes = arrays.nodes;
        scene.packets = arrays.leaves.packets;
        scene.quadrics = arrays.leaves.quadrics;
        scene.patches = arrays.leaves.patches;
        scene.curve_parts = arrays.leaves.curve_parts;
        offset.tree(self.tree)
    }
}

/// Everything in a group that can be hit. Two triangles in a row that lie in nearly one box, as those of a
/// quadrilateral, are one item: they share a packet anyway, and trees over half the items take half the time.
fn items(group: &Group<'_>) -> Vec<Item> {
    let mut items: Vec<Item> = bytemuck::zeroed_vec(group.triangles.len());
    let blocks = items.par_chunks_mut(BLOCK).enumerate();
    blocks.for_each(|(block, items)| pair(group, block * BLOCK, items));
    items.retain(|item| item.count > 0);
    // Where triangles are paired, half of it is free.
    items.shrink_to_fit();
    let quadrics = (group.triangles.len()..).zip(group.quadrics);
    items.extend(quadrics.map(|(primitive, quadric)| Item {
        bounds: quadric.bounds(),
        primitive: u32::try_from(primitive).expect("counts are checked"),
        count: 1,
    }));
    let first_patch = group.triangles.len() + group.quadrics.len();
    let patches = (first_patch..).zip(0..group.patches.len());
    items.extend(patches.filter_map(|(primitive, i)| {
        Some(Item {
            bounds: patch::bounds(&patch_corners(group, i))?,
            primitive: u32::try_from(primitive).expect("counts are checked"),
            count: 1,
        })
    }));
    let first_curve = first_patch + group.patches.len();
    for (primitive, curve) in (first_curve..).zip(group.curves) {
        let primitive = u32::try_from(primitive).expect("counts are checked");
        curve.parts(&mut |bounds, part| {
            items.push(Item {
                bounds,
                primitive,
                count: part,
            });
        });
    }
    items
}

fn patch_corners(group: &Group<'_>, patch: usize) -> [[f32; 3]; 4] {
    group.patches[patch].map(|v| group.positions[v as usize])
}

/// Writes the items of a block of triangles, from `first` on; those without an item stay zero.
fn pair(group: &Group<'_>, first: usize, items: &mut [Item]) {
    // Where the item before is that may take a second triangle, and the half of its area.
    let mut before: Option<(usize, f64)> = None;
    for i in 0..items.len() {
        let corners = group.triangles[first + i].map(|v| group.positions[v as usize]);
        let Some(bounds) = triangle::bounds(&corners) else {
            before = None;
            continue;
        };
        let area = bounds.half_area();
        if let Some((at, other)) = before {
            let both = items[at].bounds.union(&bounds);
            if both.half_area() <= PAIRED * (area + other) {
                items[at].bounds = both;
                items[at].count = 2;
                before = None;
                continue;
            }
        }
        items[i] = Item {
            bounds,
            primitive: u32::try_from(first + i).expect("counts are checked"),
            count: 1,
        };
        before = Some((i, area));
    }
}

/// How many triangles an item has; 0 for others.
fn triangles(group: &Group<'_>, item: &Item) -> usize {
    match (item.primitive as usize) < group.triangles.len() {
        true => item.count as usize,
        false => 0,
    }
}

fn bounds(items: &[Item]) -> Vec<Bounds> {
    items.iter().map(|item| item.bounds).collect()
}

/// The tree of a large group.
fn in_chunks(group: &Group<'_>, items: &mut [Item], arrays: &mut Arrays) -> Tree {
    arrays.reserve(items.len());
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
                arrays.reserve(chunk.len());
                let Arrays { nodes, leaves } = &mut arrays;
                let trees = collapse::build_parts(
                    &bounds(chunk),
                    parts,
                    (LEVELS, effort),
                    |item| triangles(group, &chunk[item as usize]),
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
        if triangles(group, first) == 0 {
            let index = first.primitive as usize - group.triangles.len();
            return self.write_other(group, first, index);
        }
        let mut primitives = [0; 8];
        let mut count = 0;
        for &item in leaf {
            let item = &items[item as usize];
            for primitive in item.primitive..item.primitive + item.count {
                primitives[count] = primitive;
                count += 1;
            }
        }
        let primitives = &mut primitives[..count];
        // In the order of the input, which chunks do not preserve.
        primitives.sort_unstable();
        let index = self.packets.len();
        // Filled where it lies: it is large.
        self.packets.push(Packet8::EMPTY);
        let packet = &mut self.packets[index];
        for (lane, &primitive) in primitives.iter().enumerate() {
            let indices = group.triangles[primitive as usize];
            packet.set(
                lane,
                indices.map(|v| group.positions[v as usize]),
                primitive,
            );
        }
        Child::new(ChildKind::Packet, index)
    }

    /// A leaf of what is no triangle.
    ///
    /// * `index`: that of the primitive behind the triangles.
    fn write_other(&mut self, group: &Group<'_>, item: &Item, index: usize) -> Child {
        let primitive = item.primitive;
        if let Some(quadric) = group.quadrics.get(index) {
            let placed = quadric::PreparedQuadric::new(quadric, primitive);
            self.quadrics.push(placed);
            return Child::new(ChildKind::Quadric, self.quadrics.len() - 1);
        }
        let index = index - group.quadrics.len();
        if index < group.patches.len() {
            let corners = patch_corners(group, index);
            let patch = patch::PreparedPatch::new(corners, primitive);
            self.patches.push(patch);
            return Child::new(ChildKind::PatchOrPlacement, self.patches.len() - 1);
        }
        self.curve_parts.push(curve::CurvePart {
            curve: crate::convert::id(index - group.patches.len()),
            primitive,
            part: item.count,
        });
        Child::new(ChildKind::CurvePart, self.curve_parts.len() - 1)
    }
}

/// Where arrays begin within others.
struct Offset([usize; 5]);

impl Offset {
    fn child(&self, child: Child) -> Child {
        let kind = child.kind();
        let index = match kind {
            ChildKind::CurvePart => child.part_index(),
            _ => child.index(),
        };
        Child::new(kind, self.0[kind as usize] + index)
    }

    fn tree(&self, tree: Tree) -> Tree {
        Tree {
            root: self.child(tree.root),
            ..tree
        }
    }
}

impl Arrays {
    /// Makes room for as much as items of triangles need in practice, so that arrays need not grow; pages are not
    /// touched before they are used.
    fn reserve(&mut self, items: usize) {
        self.nodes.reserve(items / 9);
        self.leaves.packets.reserve(items / 2);
        huge_pages::advise(&self.nodes);
        huge_pages::advise(&self.leaves.packets);
    }

    /// Appends other arrays.
    fn append(&mut self, other: Self) -> Offset {
        let offset = Offset([
            self.nodes.len(),
            self.leaves.packets.len(),
            self.leaves.quadrics.len(),
            self.leaves.patches.len(),
            self.leaves.curve_parts.len(),
        ]);
        if self.nodes.capacity() == 0 && offset.0 == [0; 5] {
            *self = other;
            return offset;
        }
        let moved = |node: &Node8| Node8 {
            children: node.children.map(|child| offset.child(child)),
            ..*node
        };
        // In parallel: most of the time is the system's, which clears the pages.
        let nodes = other.nodes.par_iter().with_min_len(COPIED);
        self.nodes.par_extend(nodes.map(moved));
        let packets = other.leaves.packets.par_iter().with_min_len(COPIED);
        self.leaves.packets.par_extend(packets);
        self.leaves.quadrics.extend(other.leaves.quadrics);
        self.leaves.patches.extend(other.leaves.patches);
        self.leaves.curve_parts.extend(other.leaves.curve_parts);
        offset
    }
}
