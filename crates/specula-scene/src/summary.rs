//! Counts and sizes of a scene.

use std::collections::BTreeMap;

use crate::bounds::{self, BoundingBox};
use crate::scene::{
    Camera, EnvironmentMapping, Film, Geometry, ImageProjection, Light, MaterialKind, NoiseKind,
    QuadricPart, Scene, Settings, Shape, Texture,
};

/// A picture's name and size.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ImageSummary {
    /// Name of its file.
    pub name: String,
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

/// Counts and sizes of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// Triangles that are stored: each mesh once.
    pub triangles: u64,
    /// Triangles with repetition: each mesh as often as shapes and instances refer to it.
    pub triangles_shown: u64,
    /// Meshes that are stored.
    pub meshes: usize,
    /// Shapes by geometry, those of objects once: `mesh`, `sphere`, `disk`.
    pub shapes: BTreeMap<&'static str, usize>,
    /// Objects that instances may show.
    pub objects: usize,
    /// Instances of objects.
    pub instances: usize,
    /// Materials by kind, in pbrt-v4's words.
    pub materials: BTreeMap<&'static str, usize>,
    /// Texture nodes by class, in pbrt-v4's words.
    pub textures: BTreeMap<&'static str, usize>,
    /// Pictures.
    pub images: Vec<ImageSummary>,
    /// Lights by kind; `area` counts shapes that emit.
    pub lights: BTreeMap<&'static str, usize>,
    /// Bounds of all shapes in world space, but of a floor that is not the file's ([`Scene::floor`]).
    pub bounds: BoundingBox,
    /// The camera.
    pub camera: Camera,
    /// The film.
    pub film: Film,
    /// Settings that the file asks for.
    pub settings: Settings,
}

impl Summary {
    /// Counts what is in a valid scene.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        let mesh_triangles = |shape: &Shape| match shape.geometry {
            Geometry::Mesh(id) => scene.meshes[id.0].triangles.len() as u64,
            Geometry::Sphere { .. }
            | Geometry::Disk { .. }
            | Geometry::QuadricPart(_)
            | Geometry::Patches(_)
            | Geometry::Curves(_) => 0,
        };
        let in_object = |i: usize| {
            scene.objects[i]
                .shapes
                .iter()
                .map(mesh_triangles)
                .sum::<u64>()
        };
        let all_shapes = || {
            scene
                .objects
                .iter()
                .flat_map(|o| &o.shapes)
                .chain(&scene.shapes)
        };
        let mut lights = counts(scene.lights.iter().map(light_kind));
        let emitting = all_shapes().filter(|s| s.emission.is_some()).count();
        if emitting > 0 {
            lights.insert("area", emitting);
        }
        Self {
            triangles: scene.meshes.iter().map(|m| m.triangles.len() as u64).sum(),
            triangles_shown: scene.shapes.iter().map(mesh_triangles).sum::<u64>()
                + scene
                    .instances
                    .iter()
                    .map(|i| in_object(i.object.0))
                    .sum::<u64>(),
            meshes: scene.meshes.len(),
            shapes: counts(all_shapes().map(shape_kind)),
            objects: scene.objects.len(),
            instances: scene.instances.len(),
            materials: counts(scene.materials.iter().map(|m| material_kind(&m.kind))),
            textures: counts(scene.textures.iter().map(texture_kind)),
            images: scene
                .images
                .iter()
                .map(|i| ImageSummary {
                    name: i.name.clone(),
                    width: i.width,
                    height: i.height,
                })
                .collect(),
            lights,
            bounds: bounds::of_file(scene),
            camera: scene.camera.clone(),
            film: scene.film.clone(),
            settings: scene.settings.clone(),
        }
    }
}

fn counts(names: impl Iterator<Item = &'static str>) -> BTreeMap<&'static str, usize> {
    let mut counts = BTreeMap::new();
    for name in names {
        *counts.entry(name).or_insert(0) += 1;
    }
    counts
}

fn shape_kind(shape: &Shape) -> &'static str {
    match shape.geometry {
        Geometry::Mesh(_) => "mesh",
        Geometry::Sphere { .. } => "sphere",
        Geometry::Disk { .. } => "disk",
        Geometry::QuadricPart(QuadricPart::Sphere { .. }) => "partial sphere",
        Geometry::QuadricPart(QuadricPart::Cylinder { .. }) => "cylinder",
        Geometry::QuadricPart(QuadricPart::Disk { .. }) => "partial disk",
        Geometry::Patches(_) => "patch mesh",
        Geometry::Curves(_) => "curves",
    }
}

/// The kind of a material, in pbrt-v4's words where it has one.
#[must_use]
pub fn material_kind(kind: &MaterialKind) -> &'static str {
    match kind {
        MaterialKind::Diffuse { .. } => "diffuse",
        MaterialKind::DiffuseTransmission { .. } => "diffusetransmission",
        MaterialKind::Conductor { .. } => "conductor",
        MaterialKind::Dielectric { .. } => "dielectric",
        MaterialKind::ThinDielectric { .. } => "thindielectric",
        MaterialKind::CoatedDiffuse { .. } => "coateddiffuse",
        MaterialKind::CoatedConductor { .. } => "coatedconductor",
        MaterialKind::Plastic { .. } => "plastic",
        MaterialKind::Principled(_) => "principled",
        MaterialKind::Gltf(_) => "metallic-roughness",
        MaterialKind::Measured(_) => "measured",
        MaterialKind::Hair(_) => "hair",
        MaterialKind::Mix { .. } => "mix",
        MaterialKind::Sided(_) => "two-sided",
        MaterialKind::Interface => "interface",
    }
}

fn texture_kind(texture: &Texture) -> &'static str {
    match texture {
        Texture::Constant(_) => "constant",
        Texture::Image { .. } => "imagemap",
        Texture::Scale { .. } => "scale",
        Texture::Mix { .. } => "mix",
        Texture::Checkerboard { .. } | Texture::Checkerboard3d { .. } => "checkerboard",
        Texture::Bilinear { .. } => "bilinear",
        Texture::Dots { .. } => "dots",
        Texture::Noise { kind, .. } => match kind {
            NoiseKind::Fbm => "fbm",
            NoiseKind::Turbulence => "turbulence",
            NoiseKind::Windy => "windy",
            NoiseKind::Marble { .. } => "marble",
        },
        Texture::Sum { .. } => "sum",
        Texture::DirectionMix { .. } => "directionmix",
        Texture::Threshold { .. } => "threshold",
        Texture::VertexColour => "vertex colour",
    }
}

fn light_kind(light: &Light) -> &'static str {
    match light {
        Light::Infinite { image: None, .. } => "infinite, constant",
        Light::Infinite {
            image: Some((_, mapping)),
            ..
        } => match mapping {
            EnvironmentMapping::EqualAreaOctahedral => "infinite, equal-area picture",
            EnvironmentMapping::LatitudeLongitude | EnvironmentMapping::LatitudeLongitudePoles => {
                "infinite, latitude-longitude picture"
            }
        },
        Light::Portal { .. } => "infinite, through a portal",
        Light::Distant { .. } => "distant",
        Light::Point { .. } => "point",
        Light::Spot { .. } => "spot",
        Light::Picture {
            image_projection: ImageProjection::Sphere,
            ..
        } => "goniometric",
        Light::Picture {
            image_projection: ImageProjection::Window { .. },
            ..
        } => "projection",
    }
}
