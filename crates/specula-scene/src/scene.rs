//! The scene model: plain data, the same for every format.
//!
//! Lengths are in scene units, colours linear RGB (sRGB primaries), angles in degrees where the
//! name says so. Transforms are row-times-column matrices `p_world = M * p_local`.

mod camera;
mod coat;
mod curve_mesh;
mod lens;
mod light;
mod material;
mod motion;
mod patch_mesh;
mod quadric_part;
mod shape;
mod texture;
pub(crate) mod tube;

pub use camera::{Camera, Film, Filter, Projection};
pub use coat::CoatMedium;
pub use curve_mesh::{CurveKind, CurveMesh, ribbon_normal};
pub use lens::{LensInterface, LensSystem, StopPicture};
pub use light::{EnvironmentMapping, ImageProjection, Light, Profile, SpotFalloff};
pub use material::{
    Bump, BumpRules, ConductorFresnel, GltfMaterial, HairMaterial, HairPigment, Material,
    MaterialKind, MicrofacetDistribution, PrincipledMaterial, Roughness, RoughnessMapping,
};
pub use motion::{Motion, Trajectory};
pub use patch_mesh::PatchMesh;
pub(crate) use patch_mesh::is_parallelogram;
pub use quadric_part::QuadricPart;
pub use shape::{Emission, Geometry, Mesh, Object, ObjectInstance, Shape};
pub use texture::{
    Channel, ColourParam, FloatParam, Interpolation, NoiseKind, Texture, TextureMapping, UvMapping,
    Wrap,
};

use crate::energy::Energy;
use crate::image::Image;
use crate::measured::MeasuredBrdf;

/// Index into [`Scene::images`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ImageId(pub usize);
/// Index into [`Scene::textures`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TextureId(pub usize);
/// Index into [`Scene::materials`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct MaterialId(pub usize);
/// Index into [`Scene::measured`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct MeasuredId(pub usize);
/// Index into [`Scene::meshes`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct MeshId(pub usize);
/// Index into [`Scene::patch_meshes`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct PatchMeshId(pub usize);
/// Index into [`Scene::curve_meshes`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct CurveMeshId(pub usize);
/// Index into [`Scene::objects`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ObjectId(pub usize);

/// Everything that a file describes.
///
/// Invariant: every index is in range, every number is finite, every transform is invertible;
/// textures refer only to textures before them.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The camera.
    pub camera: Camera,
    /// Size, crop and reconstruction filter of the picture.
    pub film: Film,
    /// Settings that the file asks for.
    pub settings: Settings,
    /// Decoded pictures, each stored once.
    pub images: Vec<Image>,
    /// Texture nodes.
    pub textures: Vec<Texture>,
    /// Materials.
    pub materials: Vec<Material>,
    /// Measured materials, each file stored once.
    pub measured: Vec<MeasuredBrdf>,
    /// Triangle meshes in their own space.
    pub meshes: Vec<Mesh>,
    /// Meshes of bilinear patches in their own space.
    pub patch_meshes: Vec<PatchMesh>,
    /// Curves in their own space.
    pub curve_meshes: Vec<CurveMesh>,
    /// Shapes of the world.
    pub shapes: Vec<Shape>,
    /// Groups of shapes that instances refer to.
    pub objects: Vec<Object>,
    /// Copies of objects.
    pub instances: Vec<ObjectInstance>,
    /// Lights that are not shapes.
    pub lights: Vec<Light>,
    /// Material of a floor that was added under an object whose file has no lights.
    pub floor: Option<MaterialId>,
}

impl Scene {
    /// Whether anything moves while the shutter is open.
    #[must_use]
    pub fn moves(&self) -> bool {
        self.motions().next().is_some()
    }

    /// All motions, each with the number of what moves: camera, instances, shapes, shapes of objects.
    pub(crate) fn motions(&self) -> impl Iterator<Item = (usize, &Motion)> {
        let in_objects = self.objects.iter().flat_map(|o| &o.shapes);
        let shapes = self.shapes.iter().chain(in_objects);
        std::iter::once(&self.camera.motion)
            .chain(self.instances.iter().map(|i| &i.motion))
            .chain(shapes.map(|s| &s.motion))
            .enumerate()
            .filter_map(|(i, motion)| Some((i, motion.as_ref()?)))
    }

    /// A scene without shapes and lights: what a scene made in code starts from.
    ///
    /// ```
    /// use glam::{DMat4, DVec3};
    /// use specula_scene::Scene;
    /// use specula_scene::scene::{
    ///     Camera, Film, Filter, Geometry, Material, MaterialId, MaterialKind, Settings, Shape,
    /// };
    ///
    /// let film = Film::new([320, 200], Filter::Box { radius: [0.5; 2] });
    /// let camera = Camera::look_at(DVec3::new(0.0, -5.0, 1.0), DVec3::ZERO, DVec3::Z, 40.0, &film);
    /// let mut scene = Scene::empty(camera, film, Settings::default());
    /// scene.materials.push(Material::new(MaterialKind::Interface));
    /// let sphere = Geometry::Sphere { radius: 1.0 };
    /// scene.shapes.push(Shape::new(sphere, DMat4::IDENTITY, MaterialId(0)));
    /// assert!(scene.validate().is_ok());
    /// ```
    #[must_use]
    pub fn empty(camera: Camera, film: Film, settings: Settings) -> Self {
        Self {
            camera,
            film,
            settings,
            images: Vec::new(),
            textures: Vec::new(),
            materials: Vec::new(),
            measured: Vec::new(),
            meshes: Vec::new(),
            patch_meshes: Vec::new(),
            curve_meshes: Vec::new(),
            shapes: Vec::new(),
            objects: Vec::new(),
            instances: Vec::new(),
            lights: Vec::new(),
            floor: None,
        }
    }
}

/// Settings of the renderer that the file asks for; a caller may override each.
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
    /// Treatment of multiple scattering for materials that do not specify one: none for the scenes of
    /// renderers that scatter singly (pbrt-v4, Mitsuba 3), [`Energy::DEFAULT`] for all others.
    pub energy: Energy,
}

impl Default for Settings {
    /// The settings of a scene that asks for nothing: 128 samples per pixel, paths of at most 16
    /// scattering events, [`Energy::DEFAULT`].
    fn default() -> Self {
        Self {
            max_depth: 16,
            samples_per_pixel: 128,
            hide_emitters: false,
            energy: Energy::DEFAULT,
        }
    }
}
