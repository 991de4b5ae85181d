//! The arrays that are traversed: 8-wide nodes and packets of 8 triangles, 64-byte aligned.

use bytemuck::{Pod, Zeroable};

use super::{Bounds, triangle};

/// How many children a node has at most, and triangles a packet.
pub(super) const WIDTH: usize = 8;

/// Eight floats, a SIMD lane for each child or triangle.
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C, align(32))]
pub(super) struct Lanes(pub(super) [f32; WIDTH]);

/// A reference to a child of a node, or to the root: two bits of kind and an index of 30 bits, or three bits and one of
/// 29.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
#[repr(transparent)]
pub(super) struct Child(pub(super) u32);

/// The kinds of [`Child`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ChildKind {
    Node,
    Packet,
    Quadric,
    /// A patch in the tree of a group, an instance in that over instances: no tree has both.
    PatchOrPlacement,
    /// A part of a curve.
    CurvePart,
}

/// Bits of the kinds of 29 bits, and that by which they differ.
const PATCHES: u32 = 3 << 30;
const CURVES: u32 = 1 << 29;

impl Child {
    pub(super) fn new(kind: ChildKind, index: usize) -> Self {
        let index = u32::try_from(index).expect("counts are checked before the build");
        let (bits, most) = match kind {
            ChildKind::CurvePart => (PATCHES | CURVES, CURVES),
            ChildKind::PatchOrPlacement => (PATCHES, CURVES),
            kind => ((kind as u32) << 30, 1 << 30),
        };
        assert!(index < most, "counts are checked before the build");
        Self(bits | index)
    }

    #[inline(always)]
    pub(super) fn is_node(self) -> bool {
        self.0 < 1 << 30
    }

    #[inline(always)]
    pub(super) fn kind(self) -> ChildKind {
        match self.0 >> 30 {
            0 => ChildKind::Node,
            1 => ChildKind::Packet,
            2 => ChildKind::Quadric,
            _ if self.0 & CURVES == 0 => ChildKind::PatchOrPlacement,
            _ => ChildKind::CurvePart,
        }
    }

    /// Its index among those of its kind, but of parts of curves.
    #[inline(always)]
    pub(super) fn index(self) -> usize {
        (self.0 & ((1 << 30) - 1)) as usize
    }

    /// The index of a part of a curve.
    #[inline(always)]
    pub(super) fn part_index(self) -> usize {
        (self.0 & (CURVES - 1)) as usize
    }
}

/// A node: the boxes of up to eight children, and the children.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C, align(64))]
pub(super) struct Node8 {
    /// `min x, max x, min y, max y, min z, max z`, each over the children.
    pub(super) bounds: [Lanes; 6],
    pub(super) children: [Child; WIDTH],
    /// Up to a multiple of the alignment.
    pub(super) unused: [u32; WIDTH],
}

impl Node8 {
    /// No children: boxes that no ray hits.
    pub(super) const EMPTY: Self = Self {
        bounds: {
            let (min, max) = (
                Lanes([f32::INFINITY; WIDTH]),
                Lanes([f32::NEG_INFINITY; WIDTH]),
            );
            [min, max, min, max, min, max]
        },
        children: [Child(0); WIDTH],
        unused: [0; WIDTH],
    };

    pub(super) fn set(&mut self, lane: usize, bounds: &Bounds, child: Child) {
        for axis in 0..3 {
            self.bounds[2 * axis].0[lane] = bounds.min[axis];
            self.bounds[2 * axis + 1].0[lane] = bounds.max[axis];
        }
        self.children[lane] = child;
    }

    /// The children in occupied lanes.
    pub(super) fn occupied(&self) -> impl Iterator<Item = Child> {
        let [low, high] = [0, 1].map(|side| self.bounds[side].0);
        let lanes = (0..WIDTH).filter(move |&lane| low[lane] <= high[lane]);
        lanes.map(|lane| self.children[lane])
    }
}

/// Up to eight triangles. Empty lanes hold a point, which no ray hits.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C, align(64))]
pub(super) struct Packet8 {
    /// `vertices[corner][axis]`.
    pub(super) vertices: [[Lanes; 3]; 3],
    /// Indices within the group.
    pub(super) primitives: [u32; WIDTH],
}

impl Packet8 {
    /// No triangles.
    pub(super) const EMPTY: Self = Self {
        vertices: [[Lanes([0.0; WIDTH]); 3]; 3],
        primitives: [0; WIDTH],
    };

    pub(super) fn set(&mut self, lane: usize, corners: [[f32; 3]; 3], primitive: u32) {
        for (target, corner) in self.vertices.iter_mut().zip(corners) {
            for (lanes, x) in target.iter_mut().zip(corner) {
                lanes.0[lane] = x;
            }
        }
        self.primitives[lane] = primitive;
    }

    /// The lanes that hold triangles, as bits.
    #[inline(always)]
    pub(super) fn occupied_lanes(&self) -> u32 {
        let [a, b, _] = &self.vertices;
        let mut apart = 0;
        for lane in 0..WIDTH {
            let is_point = (a[0].0[lane] == b[0].0[lane])
                & (a[1].0[lane] == b[1].0[lane])
                & (a[2].0[lane] == b[2].0[lane]);
            apart |= u32::from(!is_point) << lane;
        }
        apart
    }

    /// The triangles in occupied lanes, with their indices.
    pub(super) fn occupied(&self) -> impl Iterator<Item = (u32, [[f32; 3]; 3])> {
        let corners = |lane: usize| {
            self.vertices
                .each_ref()
                .map(|c| c.each_ref().map(|x| x.0[lane]))
        };
        (0..WIDTH).filter_map(move |lane| {
            let corners = corners(lane);
            triangle::bounds(&corners)?;
            Some((self.primitives[lane], corners))
        })
    }
}
