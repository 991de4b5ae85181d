//! Geometry as words for shaders.

use specula_scene::scene::FloatParam;

use super::{Geometry, GroupData, PlacedQuadric, Placement, ShapeRecord};
use crate::accel::QuadricShape;
use crate::codes;
use crate::convert::{Affine, id, narrow};
use crate::layout;
use crate::texture::{colour_parameter, float_parameter};
use crate::words::Words;

impl Geometry {
    /// Writes acceleration structure, groups, instances and shapes; returns nodes and packets as bytes.
    pub(crate) fn flatten(&self, to: &mut Words) -> (&[u8], &[u8]) {
        let arrays = self.accel.flatten(to);
        let places: Vec<u32> = self.groups.iter().map(|g| g.flatten(to)).collect();
        to.begin("INSTANCES");
        for placement in &self.placements {
            placement.flatten(&places, to);
        }
        to.begin("SHAPES");
        for shape in &self.shapes {
            shape.flatten(to);
        }
        to.constant("HAS_PASSABLE", u32::from(self.has_passable));
        arrays
    }
}

impl ShapeRecord {
    /// Material, whether both sides emit, whether there are texture coordinates, radiance, opacity, whether it is an
    /// interface.
    fn flatten(&self, to: &mut Words) {
        let record = to.offset();
        to.id(self.material);
        to.flag(self.two_sided);
        to.flag(self.has_uvs);
        colour_parameter(to, self.radiance);
        float_parameter(to, self.alpha.unwrap_or(FloatParam::Value(1.0)));
        to.flag(self.is_interface);
        to.field(record, layout::SHAPE_SIZE);
    }
}

impl Placement {
    /// Offset of the group's record, whether the transform is the identity, index of the group's first light, then
    /// affine maps: group to world, of normals, world to group.
    fn flatten(&self, groups: &[u32], to: &mut Words) {
        let record = to.offset();
        to.id(groups[self.group as usize]);
        to.flag(self.identity);
        to.id(self.first_light);
        to.affine(&self.pose.to_world);
        to.affine(&self.pose.normals);
        to.affine(&Affine::new(&self.pose.inverse));
        to.field(record, layout::INSTANCE_SIZE);
    }
}

impl GroupData {
    /// Arrays, then a record of their offsets, whose own offset is returned.
    fn flatten(&self, to: &mut Words) -> u32 {
        let vertices = self.positions.len();
        // As on the CPU: vertices of meshes without such values lie behind the end of the array.
        let begin = |to: &mut Words, there: usize| (to.offset(), id(there.min(vertices)));
        let positions = begin(to, vertices).0;
        to.floats(self.positions.iter().flatten().copied());
        let normals = begin(to, self.normals.len());
        to.floats(self.normals.iter().flatten().copied());
        let uvs = begin(to, self.uvs.len());
        to.floats(self.uvs.iter().flatten().copied());
        let second_uvs = begin(to, self.second_uvs.len());
        to.floats(self.second_uvs.iter().flatten().copied());
        let tangents = begin(to, self.tangents.len());
        to.floats(self.tangents.iter().flatten().copied());
        let colours = begin(to, self.colours.len());
        to.floats(self.colours.iter().flatten().copied());
        let triangles = to.offset();
        to.ids(self.triangles.iter().flatten().copied());
        let shape_of = to.offset();
        to.ids(self.shape_of.iter().copied());
        let light_of = to.offset();
        to.ids(self.light_of.iter().copied());
        let quadrics = to.offset();
        for quadric in &self.quadrics {
            quadric.flatten(to);
        }
        let record = to.offset();
        let triangle_count = id(self.triangles.len());
        for (field, word) in [
            (layout::GROUP_POSITIONS, positions),
            (layout::GROUP_TRIANGLE_COUNT, triangle_count),
            (layout::GROUP_TRIANGLES, triangles),
            (layout::GROUP_SHAPE_OF, shape_of),
        ] {
            to.field(record, field);
            to.id(word);
        }
        to.field(record, layout::GROUP_LIGHT_OF);
        to.ids([light_of, id(self.light_of.len())]);
        to.field(record, layout::GROUP_QUADRICS);
        to.id(quadrics);
        for (field, (place, count)) in [
            (layout::GROUP_NORMALS, normals),
            (layout::GROUP_UVS, uvs),
            (layout::GROUP_SECOND_UVS, second_uvs),
            (layout::GROUP_TANGENTS, tangents),
            (layout::GROUP_COLOURS, colours),
        ] {
            to.field(record, field);
            to.ids([place, count]);
        }
        record
    }
}

impl PlacedQuadric {
    /// Kind (sphere, disk), radius, height, whether it is inside out, then affine maps: own space to group, group to own
    /// space, of normals.
    fn flatten(&self, to: &mut Words) {
        let (kind, radius, height) = match self.shape {
            QuadricShape::Sphere { radius } => (codes::QUADRIC_SPHERE, radius, 0.0),
            QuadricShape::Disk { radius, height } => (codes::QUADRIC_DISK, radius, height),
            // Named among what is missing.
            QuadricShape::Part(_) => (codes::QUADRIC_DISK, 0.0, 0.0),
        };
        let record = to.offset();
        to.id(kind);
        to.floats([narrow(radius), narrow(height)]);
        to.flag(self.flipped);
        to.affine(&self.forward);
        to.affine(&self.backward);
        to.affine(&self.normals);
        to.field(record, layout::QUADRIC_SIZE);
    }
}
