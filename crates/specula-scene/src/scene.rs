//! The scene as the artist wrote it: one model for every format, plain data.
//!
//! Lengths are in scene units, colours linear RGB (sRGB primaries), angles in degrees where the
//! name says so. Transforms are row-times-column matrices `p_world = M * p_local`.

mod camera;
mod coat;
mod light;
mod material;
mod shape;
mod texture;

pub use camera::{Camera, Film, Filter, Projection};
pub use coat::CoatMedium;
pub use light::{EnvironmentMapping, ImageProjection, Light, Profile, SpotFalloff};
pub use material::{
    Bump, BumpRules, ConductorFresnel, Distribution, Gltf, Material, MaterialKind, Principled,
    Roughness, RoughnessMapping,
};
pub use shape::{Emission, Geometry, Instance, Mesh, Object, Shape};
pub use texture::{
    Channel, ColourParam, FloatParam, Interpolation, NoiseKind, Texture, TextureMapping, UvMapping,
    Wrap,
};

use crate::energy::Energy;
use crate::image::Image;

/// Index into [`Scene::images`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ImageId(pub usize);
/// Index into [`Scene::textures`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TextureId(pub usize);
/// Index into [`Scene::materials`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct MaterialId(pub usize);
/// Index into [`Scene::meshes`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct MeshId(pub usize);
/// Index into [`Scene::objects`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ObjectId(pub usize);

/// Everything that a file describes.
///
/// Invariant: every index is in range, every number is finite, every transform is invertible;
/// textures refer only to textures before them.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Where pictures are taken from.
    pub camera: Camera,
    /// Size, crop and reconstruction filter of the picture.
    pub film: Film,
    /// What the file asks of the renderer.
    pub settings: Settings,
    /// Decoded pictures, each stored once.
    pub images: Vec<Image>,
    /// Texture nodes.
    pub textures: Vec<Texture>,
    /// Materials.
    pub materials: Vec<Material>,
    /// Triangle meshes in their own space.
    pub meshes: Vec<Mesh>,
    /// Shapes of the world.
    pub shapes: Vec<Shape>,
    /// Groups of shapes that instances refer to.
    pub objects: Vec<Object>,
    /// Copies of objects.
    pub instances: Vec<Instance>,
    /// Lights that are not shapes.
    pub lights: Vec<Light>,
    /// Material of the floor that is not the file's: it was put under an object without light.
    pub floor: Option<MaterialId>,
}

/// What the file asks of the renderer; the command line may override each.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Longest path, in scattering events counted as pbrt counts `maxdepth`
    /// (0: emission seen directly only).
    pub max_depth: u32,
    /// Samples per pixel.
    pub samples_per_pixel: u32,
    /// Whether lights are hidden from the camera: its rays pass shapes that emit until they meet
    /// one that does not, and see no light from infinity (Mitsuba's `hide_emitters`).
    pub hide_emitters: bool,
    /// Treatment of multiple scattering where a material does not say it itself: none for the scenes of
    /// renderers that scatter singly (pbrt-v4, Mitsuba 3), [`Energy::DEFAULT`] for all others.
    pub energy: Energy,
}
