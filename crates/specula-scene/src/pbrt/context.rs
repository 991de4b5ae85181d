//! What all kinds of directives share: warnings, file names, pictures and textures by name.

use std::cell::Cell;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

use specula_bsdf::Rgb;

use super::param::{Param, ParamList, Values};
use super::v3::Names;
use crate::LoadOptions;
use crate::error::{ErrorKind, Place, SceneError, Warning};
use crate::image::{self, Content, Encoding, Image};
use crate::measured::{self, MeasuredBrdf};
use crate::num::{f32_of, shorten};
use crate::problems::{NoteKind, Problems};
use crate::read_file::Files;
use crate::scene::{FloatParam, ImageId, MeasuredId, Texture, TextureId};
use crate::search::Search;

/// A directive with a name and parameters.
#[derive(Clone, Debug)]
pub(super) struct Entity {
    pub(super) name: String,
    /// The place of the name.
    pub(super) place: Place,
    pub(super) params: ParamList,
}

impl Entity {
    /// What was read of it, or a stand-in where its mistakes are recorded.
    ///
    /// # Errors
    ///
    /// That of `read`, in an ordinary load.
    pub(super) fn or<T>(
        &self,
        read: Result<T, SceneError>,
        stand_in: impl FnOnce() -> T,
    ) -> Result<T, SceneError> {
        read.or_else(|error| {
            self.params.keep_unless_damaged(error)?;
            Ok(stand_in())
        })
    }
}

/// A picture to be read, and the first place that asks for it.
pub(super) struct ImageJob {
    path: PathBuf,
    place: Place,
    encoding: Encoding,
    content: Content,
}

impl ImageJob {
    /// Reads the picture.
    pub(super) fn read(&self, files: &Files, search: &Search) -> Result<Image, SceneError> {
        image::read(&self.path, self.encoding, self.content, files).map_err(|message| {
            SceneError::new(ErrorKind::Image, &self.place, message)
                .if_missing(search.hint(&self.path), &self.path)
        })
    }
}

/// A name of a file that is defined once and may be referred to.
pub(super) struct NamedTexture {
    id: TextureId,
    place: Place,
    used: Cell<bool>,
}

/// Textures of a kind by name.
#[derive(Default)]
pub(super) struct Textures(HashMap<String, NamedTexture>);

impl Textures {
    /// Defines a texture; `false` where its name was taken.
    pub(super) fn define(&mut self, name: String, id: TextureId, place: Place) -> bool {
        let used = Cell::new(false);
        self.0
            .insert(name, NamedTexture { id, place, used })
            .is_none()
    }

    /// The texture of a name, which then counts as used.
    fn get(&self, name: &str) -> Option<TextureId> {
        let named = self.0.get(name)?;
        named.used.set(true);
        Some(named.id)
    }

    /// Notes textures that nothing refers to.
    fn note_unused(&self, kind: &str, problems: &Problems) {
        for (name, named) in self.0.iter().filter(|(_, n)| !n.used.get()) {
            problems.note(NoteKind::Unused, &named.place, || {
                format!("nothing uses the {kind} texture \"{}\"", shorten(name))
            });
        }
    }
}

/// Shared state of the reader.
pub(super) struct Context {
    pub(super) files: Files,
    pub(super) problems: Problems,
    /// pbrt-v4 resolves every file name against the folder of the scene's main file.
    pub(super) search: Search,
    pub(super) warnings: Vec<Warning>,
    pub(super) textures: Vec<Texture>,
    pub(super) images: Vec<Image>,
    pub(super) measured: Vec<MeasuredBrdf>,
    pub(super) float_textures: Textures,
    pub(super) colour_textures: Textures,
    image_ids: HashMap<(PathBuf, String, Content), ImageId>,
    measured_ids: HashMap<PathBuf, MeasuredId>,
    /// Pictures that are asked for and not read yet.
    image_jobs: Vec<ImageJob>,
    /// The names of a file of pbrt-v3; `None` for pbrt-v4.
    pub(super) v3: Option<Names>,
}

impl Context {
    pub(super) fn new(
        main: &Path,
        options: &LoadOptions,
        files: &Files,
        problems: &Problems,
    ) -> Self {
        Self {
            files: files.clone(),
            problems: problems.clone(),
            search: Search::new(main, &options.folders),
            warnings: Vec::new(),
            textures: Vec::new(),
            images: Vec::new(),
            measured: Vec::new(),
            float_textures: Textures::default(),
            colour_textures: Textures::default(),
            image_ids: HashMap::new(),
            measured_ids: HashMap::new(),
            image_jobs: Vec::new(),
            v3: None,
        }
    }

    pub(super) fn warn(&mut self, place: &Place, message: impl Into<String>) {
        self.warnings.push(Warning::new(place, message));
    }

    pub(super) fn warn_unused(&mut self, params: &ParamList) {
        self.warnings.extend(params.unused());
    }

    pub(super) fn resolve(&self, name: &str) -> PathBuf {
        self.search.find(name)
    }

    /// The picture in a file, to be read once for each way of reading it.
    pub(super) fn image(
        &mut self,
        name: &str,
        place: &Place,
        encoding: Encoding,
        content: Content,
    ) -> ImageId {
        let path = self.resolve(name);
        let key = (path.clone(), format!("{encoding:?}"), content);
        if let Some(&id) = self.image_ids.get(&key) {
            return id;
        }
        self.files.announce(&path);
        let id = ImageId(self.images.len() + self.image_jobs.len());
        self.image_jobs.push(ImageJob {
            path,
            place: place.clone(),
            encoding,
            content,
        });
        self.image_ids.insert(key, id);
        id
    }

    /// The measured material in a file, read once.
    pub(super) fn measured(&mut self, name: &str, place: &Place) -> Result<MeasuredId, SceneError> {
        let path = self.resolve(name);
        if let Some(&id) = self.measured_ids.get(&path) {
            return Ok(id);
        }
        let brdf = measured::read(&path, &self.files).map_err(|message| {
            SceneError::new(ErrorKind::Measured, place, message)
                .if_missing(self.search.hint(&path), &path)
        })?;
        let id = MeasuredId(self.measured.len());
        self.measured.push(brdf);
        self.measured_ids.insert(path, id);
        Ok(id)
    }

    /// The pictures to be read; [`Context::images`] must get them in this order.
    pub(super) fn take_image_jobs(&mut self) -> Vec<ImageJob> {
        std::mem::take(&mut self.image_jobs)
    }

    pub(super) fn add_texture(&mut self, texture: Texture) -> TextureId {
        self.textures.push(texture);
        TextureId(self.textures.len() - 1)
    }

    /// A number or a float texture.
    pub(super) fn float(
        &self,
        params: &ParamList,
        name: &str,
        default: f32,
    ) -> Result<FloatParam, SceneError> {
        Ok(self
            .float_or_none(params, name)?
            .unwrap_or(FloatParam::Value(default)))
    }

    pub(super) fn float_or_none(
        &self,
        params: &ParamList,
        name: &str,
    ) -> Result<Option<FloatParam>, SceneError> {
        let Some(param) = params.find(name) else {
            return Ok(None);
        };
        if param.kind == "texture" {
            let id = match self.texture_named(param, &self.float_textures, "float") {
                Ok(id) => id,
                Err(error) => return params.record(error).map(|()| None),
            };
            return Ok(Some(FloatParam::Texture(id)));
        }
        if param.kind != "float" {
            let error = param.wrong_type(&["float", "texture"]);
            return params.record(error).map(|()| None);
        }
        Ok(Some(FloatParam::Value(f32_of(params.float(name, 0.0)?))))
    }

    /// A number from zero up, or a float texture.
    pub(super) fn float_from_zero_or_none(
        &self,
        params: &ParamList,
        name: &str,
    ) -> Result<Option<FloatParam>, SceneError> {
        let value = self.float_or_none(params, name)?;
        if let Some(FloatParam::Value(x)) = value
            && x < 0.0
        {
            params.float_from_zero(name, 0.0)?;
        }
        Ok(value)
    }

    /// The texture that a parameter of type `texture` names.
    pub(super) fn texture_named(
        &self,
        param: &Param,
        textures: &Textures,
        kind: &str,
    ) -> Result<TextureId, SceneError> {
        let Values::Texts(texts) = &param.values else {
            return Err(param.wrong_type(&["texture"]));
        };
        let [(name, place)] = texts.as_slice() else {
            return Err(param.wrong_type(&["texture"]));
        };
        // A colour in the place of a number, as an amount of pbrt-v3.
        let other = || {
            self.v3
                .as_ref()
                .and_then(|_| self.colour_textures.get(name))
        };
        textures.get(name).or_else(other).ok_or_else(|| {
            let message = format!(
                "no {kind} texture \"{}\" is defined before this",
                shorten(name)
            );
            SceneError::new(ErrorKind::UnknownName, place, message)
        })
    }

    /// Notes textures that nothing refers to.
    pub(super) fn note_unused_textures(&self) {
        self.float_textures.note_unused("float", &self.problems);
        self.colour_textures.note_unused("spectrum", &self.problems);
    }

    /// A texture of one value.
    pub(super) fn constant(&mut self, value: f32) -> TextureId {
        self.add_texture(Texture::Constant(Rgb::splat(value)))
    }
}
