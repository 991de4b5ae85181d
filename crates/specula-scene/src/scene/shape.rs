//! Shapes and instances.

use glam::DMat4;

use super::motion::Motion;
use super::quadric_part::QuadricPart;
use super::texture::{ColourParam, FloatParam};
use super::{CurveMeshId, MaterialId, MeshId, ObjectId, PatchMeshId};

/// A triangle mesh. Optional attributes are empty or one per vertex.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Vertices.
    pub positions: Vec<[f32; 3]>,
    /// Shading normals, not necessarily unit.
    pub normals: Vec<[f32; 3]>,
    /// Surface coordinates.
    pub uvs: Vec<[f32; 2]>,
    /// A second set of them, for [`TextureMapping::SecondUv`](super::TextureMapping::SecondUv).
    pub second_uvs: Vec<[f32; 2]>,
    /// Tangents that stand in for dp/du, and the sign of `normal x tangent`, with which it is the
    /// direction of dp/dv: of normal maps and anisotropic surfaces (glTF's `TANGENT`).
    pub tangents: Vec<[f32; 4]>,
    /// Linear RGB, for [`Texture::VertexColour`](super::Texture::VertexColour).
    pub colours: Vec<[f32; 3]>,
    /// Triangles, as indices of vertices.
    pub triangles: Vec<[u32; 3]>,
    /// Whether it is a tube around a fibre of [hair](super::MaterialKind::Hair): as hair scatters as a whole fibre
    /// where a ray enters it, rays within pass.
    pub is_fibre: bool,
}

/// A shape's geometry in its own space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Geometry {
    /// Triangles.
    Mesh(MeshId),
    /// A full sphere about the origin.
    Sphere {
        /// Radius.
        radius: f32,
    },
    /// A full disk perpendicular to z.
    Disk {
        /// Radius.
        radius: f32,
        /// Its z.
        height: f32,
    },
    /// A part of a sphere or of a disk, or a cylinder.
    QuadricPart(QuadricPart),
    /// Bilinear patches.
    Patches(PatchMeshId),
    /// Curves.
    Curves(CurveMeshId),
}

/// Emission of a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emission {
    /// Radiance.
    pub radiance: ColourParam,
    /// Whether both sides emit; else the side of the surface normal.
    pub two_sided: bool,
}

/// A shape in the world, or in an object.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// Geometry in its own space.
    pub geometry: Geometry,
    /// Its space to the world's (or the object's).
    pub to_world: DMat4,
    /// How it moves from there; `None` where it does not. What moves does not emit.
    pub motion: Option<Motion>,
    /// Its surface.
    pub material: MaterialId,
    /// Its emission.
    pub emission: Option<Emission>,
    /// Whether the file reverses the surface normal (the flip of a mirroring transform is *not*
    /// in it: the renderer adds it, as pbrt does).
    pub reverse_orientation: bool,
    /// Opacity: 0 lets rays pass.
    pub alpha: FloatParam,
}

impl Shape {
    /// An opaque shape that emits no light.
    #[must_use]
    pub fn new(geometry: Geometry, to_world: DMat4, material: MaterialId) -> Self {
        Self {
            geometry,
            to_world,
            motion: None,
            material,
            emission: None,
            reverse_orientation: false,
            alpha: FloatParam::Value(1.0),
        }
    }
}

/// A named group of shapes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Object {
    /// The file's name for it.
    pub name: String,
    /// Its shapes; `Shape::to_world` leads to the object's space.
    pub shapes: Vec<Shape>,
}

/// An instance of an object.
#[derive(Clone, Debug, PartialEq)]
pub struct ObjectInstance {
    /// The object.
    pub object: ObjectId,
    /// The object's space to the world's.
    pub to_world: DMat4,
    /// How it moves from there; `None` where it does not. What moves does not emit.
    pub motion: Option<Motion>,
}
