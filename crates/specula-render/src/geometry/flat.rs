//! Surfaces for shaders.

use specula_scene::scene::FloatParam;

use super::{Geometry, GroupData, PlacedQuadric, Placement, ShapeRecord};
use crate::accel::QuadricShape;
use crate::codes;
use crate::convert::{Affine, id, narrow};
use crate::texture::{colour_parameter, float_parameter};
use crate::words::Words;

impl Geometry {
    /// Trees, groups, places and shapes; nodes and packets as they are.
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
    /// Material, whether both sides send out light, whether there are coordinates, radiance, opacity,
    /// whether it is an interface.
    fn flatten(&self, to: &mut Words) {
        to.id(self.material);
        to.flag(self.two_sided);
        to.flag(self.has_uvs);
        colour_parameter(to, self.radiance);
        float_parameter(to, self.alpha.unwrap_or(FloatParam::Value(1.0)));
        to.flag(self.is_interface);
    }
}

impl Placement {
    /// Offset of the group's record, whether it moves nothing, the group's first light, then the world
    /// from the group, its normals, and the group from the world.
    fn flatten(&self, groups: &[u32], to: &mut Words) {
        to.id(groups[self.group as usize]);
        to.flag(self.identity);
        to.id(self.first_light);
        to.affine(&self.to_world);
        to.affine(&self.normals);
        to.affine(&Affine::new(&self.inverse));
    }
}

impl GroupData {
    /// Arrays, then a record of where they are, whose place is returned.
    fn flatten(&self, to: &mut Words) -> u32 {
        let vertices = self.positions.len();
        // As for the CPU: those of meshes without any are behind the array's end.
        let begin = |to: &mut Words, there: usize| (to.place(), id(there.min(vertices)));
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
        let triangles = to.place();
        to.ids(self.triangles.iter().flatten().copied());
        let shape_of = to.place();
        to.ids(self.shape_of.iter().copied());
        let light_of = to.place();
        to.ids(self.light_of.iter().copied());
        let quadrics = to.place();
        for quadric in &self.quadrics {
            quadric.flatten(to);
        }
        let record = to.place();
        to.ids([positions, id(self.triangles.len()), triangles, shape_of]);
        to.ids([light_of, id(self.light_of.len()), quadrics]);
        for (place, count) in [normals, uvs, second_uvs, tangents, colours] {
            to.ids([place, count]);
        }
        record
    }
}

impl PlacedQuadric {
    /// Kind (sphere, disk), radius, height, whether it is turned inside out, then the group from its
    /// own space, its own from the group's, and its normals.
    fn flatten(&self, to: &mut Words) {
        let (kind, radius, height) = match self.shape {
            QuadricShape::Sphere { radius } => (codes::QUADRIC_SPHERE, radius, 0.0),
            QuadricShape::Disk { radius, height } => (codes::QUADRIC_DISK, radius, height),
        };
        to.id(kind);
        to.floats([narrow(radius), narrow(height)]);
        to.flag(self.flipped);
        to.affine(&self.forward);
        to.affine(&self.backward);
        to.affine(&self.normals);
    }
}
