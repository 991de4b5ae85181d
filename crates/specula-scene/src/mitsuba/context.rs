//! What all kinds of plugins share: warnings, files, references, pictures, textures, materials.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use specula_bsdf::Rgb;

use super::document::{Document, hint, resolve};
use super::element::{Element, Property};
use super::medium::Sides;
use super::texture::{Frame, Role, ValueOrTexture};
use super::value::Value;
use crate::Limits;
use crate::error::{ErrorKind, Place, SceneError, Warning};
use crate::image::{self, Content, Encoding, Image};
use crate::measured::{self, MeasuredBrdf};
use crate::num::shorten;
use crate::problems::{NoteKind, Problems};
use crate::read_file::Files;
use crate::scene::{ImageId, Material, MaterialId, MeasuredId, Texture, TextureId};

/// Shared state of the reader.
pub(super) struct Context<'a> {
    pub(super) limits: &'a Limits,
    pub(super) access: &'a Files,
    pub(super) problems: Problems,
    pub(super) warnings: Vec<Warning>,
    pub(super) images: Vec<Image>,
    pub(super) textures: Vec<Texture>,
    pub(super) materials: Vec<Material>,
    pub(super) measured: Vec<MeasuredBrdf>,
    /// Whether the integrator renders media.
    pub(super) sees_media: bool,
    /// The medium that the camera is in, by element.
    pub(super) camera_medium: Option<usize>,
    /// Absorption of media, by element.
    pub(super) media: HashMap<usize, Rgb<f32>>,
    /// Materials that bound media, by the plain material.
    pub(super) bounding: HashMap<(MaterialId, Sides), MaterialId>,
    /// Whether the integrator hides lights from the camera.
    pub(super) hide_emitters: bool,
    /// Whose surface coordinates textures are read for.
    pub(super) frame: Frame,
    /// Textures by element, role and frame.
    pub(super) built_textures: HashMap<(usize, Role, Frame), ValueOrTexture>,
    image_ids: HashMap<(PathBuf, String), ImageId>,
    measured_ids: HashMap<PathBuf, MeasuredId>,
    ids: HashMap<String, Rc<Element>>,
    folders: Vec<PathBuf>,
    depth: usize,
}

impl<'a> Context<'a> {
    /// The state after a document was read, and its root.
    pub(super) fn new(document: Document, access: &'a Files) -> (Self, Element) {
        let Document {
            root,
            ids,
            folders,
            warnings,
            problems,
        } = document;
        let context = Self {
            limits: access.limits(),
            access,
            problems,
            warnings,
            images: Vec::new(),
            textures: Vec::new(),
            materials: Vec::new(),
            measured: Vec::new(),
            sees_media: false,
            camera_medium: None,
            media: HashMap::new(),
            bounding: HashMap::new(),
            hide_emitters: false,
            frame: Frame::Mesh,
            built_textures: HashMap::new(),
            image_ids: HashMap::new(),
            measured_ids: HashMap::new(),
            ids,
            folders,
            depth: 0,
        };
        (context, root)
    }

    pub(super) fn warn(&mut self, place: &Place, message: impl Into<String>) {
        self.warnings.push(Warning::new(place, message));
    }

    /// The plugin that a property holds or refers to; `None` where it is something else.
    pub(super) fn plugin(&self, property: &Property) -> Result<Option<Rc<Element>>, SceneError> {
        match &property.value {
            Value::Element(element) => Ok(Some(Rc::clone(element))),
            Value::Reference(id) => match self.ids.get(id) {
                Some(element) => {
                    element.referenced.set(true);
                    Ok(Some(Rc::clone(element)))
                }
                None => {
                    let message = format!("no plugin has the id \"{}\"", shorten(id));
                    let error = SceneError::new(ErrorKind::UnknownName, &property.place, message);
                    property.damaged.set(true);
                    property.used.set(true);
                    self.problems.record(error).map(|()| None)
                }
            },
            _ => Ok(None),
        }
    }

    /// Plugins of a class within `element`, in the file's order; they count as used.
    pub(super) fn children(
        &self,
        element: &Element,
        class: &str,
    ) -> Result<Vec<Rc<Element>>, SceneError> {
        let mut found = Vec::new();
        for property in &element.properties {
            if let Some(child) = self.plugin(property)?
                && child.class == class
            {
                property.used.set(true);
                element.visited.set(true);
                found.push(child);
            }
        }
        Ok(found)
    }

    /// The only plugin of a class within `element`, if there is one.
    pub(super) fn child(
        &self,
        element: &Element,
        class: &str,
    ) -> Result<Option<Rc<Element>>, SceneError> {
        let found = self.children(element, class)?;
        if let [_, second, ..] = found.as_slice() {
            let message = format!("{} has more than one {class}", element.title());
            return Err(SceneError::new(
                ErrorKind::Structure,
                &second.place,
                message,
            ));
        }
        Ok(found.into_iter().next())
    }

    /// Runs `f` one level deeper; plugins that refer to each other in a ring end in an error.
    pub(super) fn deeper<T>(
        &mut self,
        element: &Element,
        f: impl FnOnce(&mut Self) -> Result<T, SceneError>,
    ) -> Result<T, SceneError> {
        if self.depth >= self.limits.max_depth {
            let message = format!(
                "{} is nested more than {} deep, or refers to itself (`max_depth`)",
                element.title(),
                self.limits.max_depth
            );
            return Err(SceneError::new(ErrorKind::Limit, &element.place, message));
        }
        self.depth += 1;
        let result = f(self);
        self.depth -= 1;
        result
    }

    /// The file that the string `name` of an element names.
    pub(super) fn file(
        &self,
        element: &Element,
        name: &str,
    ) -> Result<Option<(PathBuf, Place)>, SceneError> {
        let Some(text) = element.text(name)? else {
            return Ok(None);
        };
        let place = element.place_of(name);
        let own = Path::new(place.source().name()).parent();
        let path = resolve(&self.folders, own.unwrap_or(Path::new("")), text);
        Ok(Some((path, place)))
    }

    /// [`Context::file`], which must be given.
    pub(super) fn needed_file(
        &self,
        element: &Element,
        name: &str,
    ) -> Result<(PathBuf, Place), SceneError> {
        self.file(element, name)?
            .ok_or_else(|| element.error(format!("{} needs its \"{name}\"", element.title())))
    }

    /// The picture in a file, decoded once for each way of reading it.
    pub(super) fn image(
        &mut self,
        path: &Path,
        place: &Place,
        encoding: Encoding,
    ) -> Result<ImageId, SceneError> {
        let key = (path.to_owned(), format!("{encoding:?}"));
        if let Some(&id) = self.image_ids.get(&key) {
            return Ok(id);
        }
        let image = image::read(path, encoding, Content::Colour, self.access)
            .map_err(|message| self.file_error(ErrorKind::Image, place, path, message));
        let image = self.problems.or(image, Image::stand_in)?;
        let id = ImageId(self.images.len());
        self.images.push(image);
        self.image_ids.insert(key, id);
        Ok(id)
    }

    /// The measured material in a file, read once.
    pub(super) fn measured_in(
        &mut self,
        path: &Path,
        place: &Place,
    ) -> Result<MeasuredId, SceneError> {
        if let Some(&id) = self.measured_ids.get(path) {
            return Ok(id);
        }
        let brdf = measured::read(path, self.access)
            .map_err(|message| self.file_error(ErrorKind::Measured, place, path, message))?;
        let id = MeasuredId(self.measured.len());
        self.measured.push(brdf);
        self.measured_ids.insert(path.to_owned(), id);
        Ok(id)
    }

    pub(super) fn add_texture(&mut self, texture: Texture) -> TextureId {
        self.textures.push(texture);
        TextureId(self.textures.len() - 1)
    }

    pub(super) fn add_material(&mut self, material: Material) -> MaterialId {
        self.materials.push(material);
        MaterialId(self.materials.len() - 1)
    }

    /// The error for a file that `place` asks for, with the folders that were searched.
    pub(super) fn file_error(
        &self,
        kind: ErrorKind,
        place: &Place,
        path: &Path,
        message: String,
    ) -> SceneError {
        SceneError::new(kind, place, message).if_missing(hint(&self.folders, place, path), path)
    }

    /// Notes surfaces and textures of the scene that nothing refers to.
    pub(super) fn note_unused(&self, root: &Element) {
        let nested = root.properties.iter().filter_map(Property::nested);
        for element in nested.filter(|e| matches!(e.class, "bsdf" | "texture")) {
            if !element.referenced.get() {
                let id = element.id.as_ref();
                let id = id.map_or_else(String::new, |id| format!(", \"{}\"", shorten(id)));
                self.problems.note(NoteKind::Unused, &element.place, || {
                    format!("nothing uses the {}{id}", element.title())
                });
            }
        }
    }

    /// Warns of properties that were not used, in `element` and all that it contains.
    pub(super) fn warn_unused(&mut self, element: &Element) {
        if element.visited.get() {
            for property in element.properties.iter().filter(|p| !p.used.get()) {
                let message = if property.name.is_empty() {
                    format!("a nested plugin of {} is unused", element.title())
                } else {
                    format!(
                        "\"{}\" of {} is unused",
                        shorten(&property.name),
                        element.title()
                    )
                };
                self.warn(&property.place, message);
            }
        }
        for property in &element.properties {
            if let Some(child) = property.nested() {
                self.warn_unused(child);
            }
        }
    }
}
