//! A mesh in a file of its own (OBJ, PLY), staged for a look at its material.

use std::path::Path;

use glam::DMat4;
use specula_bsdf::Rgb;

use crate::bounds::{self, BoundingBox};
use crate::error::{ErrorKind, Place, SceneError, SourceText, Warning};
use crate::faults::Fault;
use crate::format::Format;
use crate::image::Image;
use crate::problems::Problems;
use crate::read_file::Files;
use crate::scene::{
    ColourParam, Emission, FloatParam, Geometry, Material, MaterialId, MaterialKind, Mesh, MeshId,
    Scene, Settings, Shape, Texture, TextureId,
};
use crate::{Limits, Loaded, mesh, stage};

/// Size of the picture.
const RESOLUTION: [u32; 2] = [960, 960];

/// Longest file whose text is stored to show excerpts in messages.
const LONGEST_TEXT: u64 = 16 << 20;

/// Meshes, and how they look.
pub(crate) struct Staged {
    /// Each with the number of its look.
    pub(crate) meshes: Vec<(Mesh, usize)>,
    pub(crate) looks: Vec<Look>,
    pub(crate) textures: Vec<Texture>,
    pub(crate) images: Vec<Image>,
    /// Where the looks come from, for a message.
    pub(crate) paint: &'static str,
    /// What is left out.
    pub(crate) messages: Vec<String>,
}

/// How a mesh looks.
pub(crate) struct Look {
    pub(crate) material: Material,
    pub(crate) emission: Option<Emission>,
    pub(crate) alpha: FloatParam,
}

impl Look {
    /// Matte paint.
    pub(crate) fn paint(reflectance: ColourParam) -> Self {
        Self {
            material: Material::new(MaterialKind::Diffuse {
                reflectance,
                roughness: FloatParam::Value(0.0),
            }),
            emission: None,
            alpha: FloatParam::Value(1.0),
        }
    }

    /// Grey paint.
    pub(crate) fn grey() -> Self {
        Self::paint(ColourParam::Value(Rgb::splat(0.5)))
    }
}

impl Staged {
    /// A mesh in the colours of its vertices, or in grey paint.
    pub(crate) fn of(mesh: Mesh) -> Self {
        let is_coloured = !mesh.colours.is_empty();
        let look = if is_coloured {
            Look::paint(ColourParam::Texture(TextureId(0)))
        } else {
            Look::grey()
        };
        Self {
            meshes: vec![(mesh, 0)],
            looks: vec![look],
            textures: Vec::from_iter(is_coloured.then_some(Texture::VertexColour)),
            images: Vec::new(),
            paint: if is_coloured {
                "paint of its vertices' colours"
            } else {
                "grey paint"
            },
            messages: Vec::new(),
        }
    }

    /// Makes the meshes valid; what is said of it.
    fn clean(&mut self, collects: bool) -> Result<(), Vec<Fault>> {
        for (mesh, _) in &mut self.meshes {
            let cleaning = mesh::clean_or_name(mesh, collects)?;
            self.messages.extend(cleaning.messages());
        }
        // Of several parts those without a triangle are left out.
        if self
            .meshes
            .iter()
            .any(|(mesh, _)| !mesh.triangles.is_empty())
        {
            self.meshes.retain(|(mesh, _)| !mesh.triangles.is_empty());
        }
        Ok(())
    }
}

/// Reads a mesh with `parse`, and gives it a camera that frames it, the built-in studio's light and a floor, which a
/// warning says.
///
/// # Errors
///
/// Where the file cannot be read, is damaged, or holds no triangle.
pub(crate) fn read(
    path: &Path,
    files: &Files,
    problems: &Problems,
    (format, parse): (
        Format,
        impl FnOnce(&Path, &Files, bool) -> Result<Staged, Vec<Fault>>,
    ),
) -> Result<Loaded, SceneError> {
    let place = Place::start(&SourceText::unread(path));
    let collects = problems.is_check();
    let read = parse(path, files, collects).and_then(|mut staged| {
        staged.clean(collects)?;
        Ok(staged)
    });
    let staged = match read {
        Ok(read) => read,
        Err(faults) => return Err(refuse(path, files.limits(), problems, &faults)?),
    };
    let camera = stage::camera(BoundingBox::EMPTY, RESOLUTION);
    let mut scene = Scene {
        textures: staged.textures,
        images: staged.images,
        ..Scene::empty(camera, stage::film(RESOLUTION), Settings::default())
    };
    for (mesh, look) in staged.meshes {
        let of = &staged.looks[look];
        scene.meshes.push(mesh);
        let geometry = Geometry::Mesh(MeshId(scene.meshes.len() - 1));
        scene.shapes.push(Shape {
            emission: of.emission,
            alpha: of.alpha,
            ..Shape::new(geometry, DMat4::IDENTITY, MaterialId(look))
        });
    }
    let materials = staged.looks.into_iter().map(|look| look.material);
    scene.materials.extend(materials);
    let bounds = bounds::of_scene(&scene);
    scene.camera = stage::camera(bounds, RESOLUTION);
    stage::light(&mut scene, bounds);
    scene.each_fault(|fault| {
        problems.record(SceneError::new(
            ErrorKind::Structure,
            &place,
            fault.to_string(),
        ))
    })?;
    let message = format!(
        "the file is a mesh alone: {}, the built-in studio's light, a floor and a camera that frames it are used \
         (y is up)",
        staged.paint
    );
    let mut warnings = vec![Warning::new(&place, message)];
    let told = staged.messages.into_iter();
    warnings.extend(told.map(|message| Warning::new(&place, message)));
    Ok(Loaded {
        format,
        scene,
        warnings,
        files: files.list(),
        missing: Vec::new(),
    })
}

/// Records all mistakes of a file but the last, which it returns: nothing stands in for the mesh.
///
/// # Errors
///
/// The first, in an ordinary load.
fn refuse(
    path: &Path,
    limits: &Limits,
    problems: &Problems,
    faults: &[Fault],
) -> Result<SceneError, SceneError> {
    let limits = Limits {
        max_bytes: limits.max_bytes.min(LONGEST_TEXT),
        ..*limits
    };
    let text = Files::new(limits).unpacked(path).ok();
    let text = text.and_then(|bytes| String::from_utf8(bytes).ok());
    let source = SourceText::new(path.display().to_string(), text.unwrap_or_default());
    let error = |fault: &Fault| match fault.line {
        Some(line) if !source.text().is_empty() => {
            let place = Place::of_line(&source, line);
            SceneError::new(ErrorKind::Mesh, &place, fault.message.as_str())
        }
        _ => SceneError::new(ErrorKind::Mesh, &Place::start(&source), fault.to_string()),
    };
    let Some((last, others)) = faults.split_last() else {
        let place = Place::start(&source);
        return Ok(SceneError::new(ErrorKind::Mesh, &place, "it holds no mesh"));
    };
    for fault in others {
        problems.record(error(fault))?;
    }
    Ok(error(last))
}
