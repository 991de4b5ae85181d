//! What acceleration structures of other makers are built from.

use crate::accel::{Bounds, Quadric, has_area};
use crate::convert::narrow;
use crate::geometry::{GroupData, Placement};
use crate::prepared::PreparedScene;

/// Triangles and quadrics in a space of their own, numbered as hits number them: triangles first.
#[derive(Clone, Debug)]
pub struct FlatGroup<'a> {
    /// Vertices, all finite.
    pub positions: &'a [[f32; 3]],
    /// Triangles, as indices of vertices. Those without area are one vertex thrice: they keep their
    /// number and cannot be hit.
    pub triangles: Vec<[u32; 3]>,
    /// A box around each sphere and disk, a little larger than it.
    pub boxes: Vec<Bounds>,
}

/// A group's place in the world; its index is the instance of hits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlatInstance {
    /// Index of the group.
    pub group: u32,
    /// The world's space from the group's: three rows of a matrix of four columns.
    pub to_world: [[f32; 4]; 3],
}

impl PreparedScene {
    /// Groups of shapes and their places in the world: two levels, never more.
    pub fn groups(&self) -> (Vec<FlatGroup<'_>>, Vec<FlatInstance>) {
        let groups = self.geometry.groups.iter().map(group).collect();
        let instances = self.geometry.placements.iter().map(instance).collect();
        (groups, instances)
    }
}

fn group(data: &GroupData) -> FlatGroup<'_> {
    let triangle = |&triangle: &[u32; 3]| {
        let corners = triangle.map(|v| data.positions[v as usize]);
        match has_area(&corners) {
            true => triangle,
            false => [triangle[0]; 3],
        }
    };
    let quadric = |q: &crate::geometry::PlacedQuadric| {
        let (shape, to_group) = (q.shape, q.to_group);
        Quadric { shape, to_group }.bounds()
    };
    FlatGroup {
        positions: &data.positions,
        triangles: data.triangles.iter().map(triangle).collect(),
        boxes: data.quadrics.iter().map(quadric).collect(),
    }
}

fn instance(placement: &Placement) -> FlatInstance {
    let row = |i: usize| placement.transform.row(i).to_array().map(narrow);
    FlatInstance {
        group: placement.group,
        to_world: [row(0), row(1), row(2)],
    }
}
