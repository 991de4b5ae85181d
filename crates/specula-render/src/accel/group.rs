//! The tree of one group.

use super::collapse::{self, Tree};
use super::node::{Child, Kind, Node8, Packet8};
use super::traverse::Scene;
use super::{Bounds, Group, quadric, triangle};

/// A group's arrays, with indices of its own.
pub(super) struct GroupTree {
    nodes: Vec<Node8>,
    packets: Vec<Packet8>,
    quadrics: Vec<quadric::Placed>,
    tree: Tree,
    /// How many triangles can be hit.
    pub(super) triangles: usize,
}

impl GroupTree {
    /// `None` where nothing can be hit. The group has been checked.
    pub(super) fn build(group: &Group<'_>) -> Option<Self> {
        let corners = |primitive: u32| {
            group.triangles[primitive as usize].map(|v| group.positions[v as usize])
        };
        let mut items: Vec<Bounds> = Vec::with_capacity(group.triangles.len());
        let mut primitives: Vec<u32> = Vec::with_capacity(group.triangles.len());
        for (primitive, _) in (0..).zip(group.triangles) {
            if let Some(bounds) = triangle::bounds(&corners(primitive)) {
                items.push(bounds);
                primitives.push(primitive);
            }
        }
        let triangles = items.len();
        let quadrics_from = group.triangles.len();
        for (quadric, primitive) in group.quadrics.iter().zip(quadrics_from..) {
            items.push(quadric.bounds());
            primitives.push(u32::try_from(primitive).expect("counts are checked"));
        }
        if items.is_empty() {
            return None;
        }
        let (mut nodes, mut packets, mut quadrics) = (Vec::new(), Vec::new(), Vec::new());
        let is_triangle = |item: u32| (item as usize) < triangles;
        let tree = collapse::build(&items, is_triangle, &mut nodes, |leaf| {
            if !is_triangle(leaf[0]) {
                let primitive = primitives[leaf[0] as usize];
                let quadric = &group.quadrics[primitive as usize - quadrics_from];
                quadrics.push(quadric::Placed::new(quadric, primitive));
                return Child::new(Kind::Quadric, quadrics.len() - 1);
            }
            let mut packet = Packet8::EMPTY;
            for (lane, &item) in leaf.iter().enumerate() {
                let primitive = primitives[item as usize];
                packet.set(lane, corners(primitive), primitive);
            }
            packets.push(packet);
            Child::new(Kind::Packet, packets.len() - 1)
        });
        Some(Self {
            nodes,
            packets,
            quadrics,
            tree,
            triangles,
        })
    }

    /// Appends the arrays to the scene's; returns the tree with its indices there.
    pub(super) fn append(self, scene: &mut Scene) -> Tree {
        let offset = |child: Child| {
            let base = match child.kind() {
                Kind::Node => scene.nodes.len(),
                Kind::Packet => scene.packets.len(),
                Kind::Quadric => scene.quadrics.len(),
                Kind::Placement => 0,
            };
            Child::new(child.kind(), base + child.index())
        };
        let moved: Vec<Node8> = self
            .nodes
            .into_iter()
            .map(|node| Node8 {
                children: node.children.map(offset),
                ..node
            })
            .collect();
        let root = offset(self.tree.root);
        scene.nodes.extend(moved);
        scene.packets.extend(self.packets);
        scene.quadrics.extend(self.quadrics);
        Tree { root, ..self.tree }
    }
}
