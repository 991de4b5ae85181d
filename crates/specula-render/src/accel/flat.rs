//! The acceleration structure for shaders.

use glam::DAffine3;

use super::{Accel, QuadricShape, instances, quadric};
use crate::codes::{self, NONE};
use crate::convert::{id, narrow3};
use crate::words::Words;

impl Accel {
    /// Nodes and packets as they are; the root, quadrics and placements as words.
    ///
    /// A quadric: kind (sphere, disk), radius, height, index within the group, affine map from the group's space to its
    /// own. A placement: root, instance, whether it is the identity, affine map from the world to the group's space.
    pub(crate) fn flatten(&self, to: &mut Words) -> (&[u8], &[u8]) {
        let scene = &self.scene;
        to.constant("TREE_ROOT", scene.root.map_or(NONE, |root| root.0));
        to.constant("LONE_INSTANCE", scene.single.unwrap_or(NONE));
        to.constant("TREE_DEPTH", id(self.stats.depth));
        to.constant("QUADRIC_COUNT", id(scene.quadrics.len()));
        to.begin("QUADRICS");
        for quadric in &scene.quadrics {
            flatten_quadric(quadric, to);
        }
        to.constant("PLACEMENT_COUNT", id(scene.placements.len()));
        to.begin("PLACEMENTS");
        for placement in &scene.placements {
            flatten_placement(placement, to);
        }
        (
            bytemuck::cast_slice(&scene.nodes),
            bytemuck::cast_slice(&scene.packets),
        )
    }
}

fn flatten_quadric(quadric: &quadric::PreparedQuadric, to: &mut Words) {
    let (kind, radius, height) = match quadric.shape() {
        QuadricShape::Sphere { radius } => (codes::QUADRIC_SPHERE, radius, 0.0),
        QuadricShape::Disk { radius, height } => (codes::QUADRIC_DISK, radius, height),
        // Named among what is missing.
        QuadricShape::Part(_) => (codes::QUADRIC_DISK, 0.0, 0.0),
    };
    to.id(kind);
    to.floats([radius, height].map(crate::convert::narrow));
    to.id(quadric.primitive);
    affine(quadric.own_space(), to);
}

fn flatten_placement(placement: &instances::Placement, to: &mut Words) {
    to.id(placement.root.0);
    to.id(placement.instance);
    to.flag(placement.identity);
    affine(placement.group_space(), to);
}

fn affine(m: &DAffine3, to: &mut Words) {
    let columns = [m.matrix3.x_axis, m.matrix3.y_axis, m.matrix3.z_axis];
    for column in columns.into_iter().chain([m.translation]) {
        to.vector(narrow3(column));
    }
}
