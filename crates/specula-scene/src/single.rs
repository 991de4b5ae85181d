//! A mesh in a file of its own (OBJ, PLY), staged for a look at its material.

use std::path::Path;

use glam::DMat4;
use specula_bsdf::Rgb;

use crate::bounds::{self, Bounds};
use crate::error::{ErrorKind, Place, SceneError, Source, Warning};
use crate::problems::Problems;
use crate::scene::{
    ColourParam, FloatParam, Geometry, Material, MaterialId, MaterialKind, Mesh, MeshId, Scene,
    Shape,
};
use crate::{Limits, LoadOptions, Loaded, mesh, stage};

/// Size of the picture.
const RESOLUTION: [u32; 2] = [960, 960];

/// Reads a mesh with `parse`, and gives it grey paint, a camera that frames it and the built-in
/// studio's light, which a warning says.
///
/// # Errors
///
/// Where the file cannot be read, is damaged, or holds no triangle.
pub(crate) fn read(
    path: &Path,
    options: &LoadOptions,
    problems: &Problems,
    parse: impl FnOnce(&Path, &Limits) -> Result<Mesh, String>,
) -> Result<Loaded, SceneError> {
    let place = Place::start(&Source::unread(path));
    let wrong = |message: String| SceneError::new(ErrorKind::Mesh, &place, message);
    let mut mesh = parse(path, &options.limits).map_err(wrong)?;
    let cleaning = mesh::clean(&mut mesh).map_err(wrong)?;
    let material = Material::new(MaterialKind::Diffuse {
        reflectance: ColourParam::Value(Rgb::splat(0.5)),
        roughness: FloatParam::Value(0.0),
    });
    let mut scene = Scene {
        camera: stage::camera(Bounds::EMPTY, RESOLUTION),
        film: stage::film(RESOLUTION),
        settings: stage::SETTINGS,
        images: Vec::new(),
        textures: Vec::new(),
        materials: vec![material],
        meshes: vec![mesh],
        shapes: vec![Shape {
            geometry: Geometry::Mesh(MeshId(0)),
            to_world: DMat4::IDENTITY,
            material: MaterialId(0),
            emission: None,
            reverse_orientation: false,
            alpha: FloatParam::Value(1.0),
        }],
        objects: Vec::new(),
        instances: Vec::new(),
        lights: Vec::new(),
    };
    scene.camera = stage::camera(bounds::of_scene(&scene), RESOLUTION);
    stage::add_studio(&mut scene);
    scene.each_fault(|fault| {
        problems.keep(SceneError::new(
            ErrorKind::Structure,
            &place,
            fault.to_string(),
        ))
    })?;
    let message = "the file is a mesh alone: grey paint, the built-in studio's light and a camera \
                   that frames it are used (y is up)";
    let mut warnings = vec![Warning::new(&place, message)];
    let told = cleaning.messages().into_iter();
    warnings.extend(told.map(|message| Warning::new(&place, message)));
    Ok(Loaded { scene, warnings })
}
