//! How much memory acceleration structures take, by counts of primitives.

use super::CurveSegment;
use super::chunks::{CHUNK, Item};
use super::curve::{CurvePart, MOST_SPLITS};
use super::group::WAVE;
use super::instances::Placement;
use super::patch::PreparedPatch;
use super::quadric::PreparedQuadric;

/// Nodes and packets, per triangle: measured on meshes (74 where packets are full, to 103).
const TRIANGLE: usize = 104;
/// The share of the nodes that a quadric, a patch or an instance has.
const NODES_OF_LEAF: usize = 48;
/// Parts of a segment of a curve: of hair nearly all.
const PARTS: usize = 1 << MOST_SPLITS;
/// A box with its index, of each primitive of a group. Pairs of triangles share one: how many there are is not
/// known beforehand.
const ITEM: usize = size_of::<Item>();
/// Memory while a tree is built, for each item of a chunk: rounded boxes, hash table, binary trees and plans.
const BUILDING: usize = 194;
/// Memory of the trees of finished chunks, per item of a wave, until they are joined.
const WAVE_ITEM: usize = 32;

/// Bytes of acceleration structures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Predicted {
    /// Of the finished structures.
    pub(crate) finished: u64,
    /// Besides, while they are built.
    pub(crate) building: u64,
}

/// The trees over groups of so many triangles, quadrics, patches and segments of curves, and over their instances.
pub(crate) fn predicted(groups: &[[usize; 4]], instances: usize, threads: usize) -> Predicted {
    let quadric = size_of::<PreparedQuadric>() + NODES_OF_LEAF;
    let patch = size_of::<PreparedPatch>() + NODES_OF_LEAF;
    let curve = size_of::<CurveSegment>() + PARTS * (size_of::<CurvePart>() + NODES_OF_LEAF);
    let (mut finished, mut largest) = (0, 0);
    let mut building = Vec::new();
    for &[triangles, quadrics, patches, curves] in groups {
        let tree = TRIANGLE * triangles + quadric * quadrics + patch * patches + curve * curves;
        let items = triangles + quadrics + patches + PARTS * curves;
        finished += tree;
        largest = largest.max(tree);
        // In large groups as many chunks at once as there are threads, of a wave at most.
        let (at_once, wave) = if items <= 2 * CHUNK {
            (items, 0)
        } else {
            // Where triangles are paired, up to twice a chunk may be one.
            let chunks = threads.clamp(2, WAVE);
            (items.min(CHUNK * chunks), items.min(CHUNK * WAVE))
        };
        building.push(ITEM * items + BUILDING * at_once + WAVE_ITEM * wave);
    }
    // Groups are built side by side, and then copied into one that grows.
    building.sort_unstable();
    let side_by_side: usize = building.iter().rev().take(threads.max(1)).sum();
    let several = groups.iter().filter(|g| **g != [0; 4]).count() > 1;
    let copied = if several { 2 * largest } else { 0 };
    let placed = instances * (size_of::<Placement>() + NODES_OF_LEAF);
    Predicted {
        finished: (finished + placed) as u64,
        // Lists that grow are copied, and allocators do not give all of it back at once.
        building: (side_by_side + side_by_side / 4 + copied) as u64,
    }
}
