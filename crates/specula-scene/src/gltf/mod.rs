//! Reader of glTF 2.0: `.gltf` with its files, and `.glb`.
//!
//! The crate `gltf` parses and validates the document; numbers are read from its buffers here, with
//! every range checked, since a file's promises about its own bytes cannot be trusted. Errors and
//! warnings name the element by its path within the document.
//!
//! | glTF | here |
//! |---|---|
//! | cameras look along -z | a mirroring of z ahead of the node's transform |
//! | texture coordinates run down the picture | meshes hold `(u, 1 - v)` |
//! | light intensities are photometric | taken as they are: candela for W/sr, lux for W/m^2 |
//! | attenuation by distance | absorption `-ln(colour) / distance` of the closed body |
//! | faces are culled from behind unless `doubleSided` | both sides are seen: light passes no wall |
//!
//! A file without lights gets the built-in studio's and a floor, a file without a camera one that
//! frames everything; warnings say so. Surfaces that emit are lights where their strength is above 1.

mod accessor;
mod animation;
mod buffers;
mod container;
mod deform;
mod features;
mod light;
mod locate;
mod material;
mod mesh;
mod mistakes;
mod node;
mod precheck;
mod range;
mod schema;
mod texture;
mod texture_ref;
mod version;

use std::path::Path;
use std::sync::Arc;

pub(crate) use features::FEATURES;

use crate::error::{ErrorKind, MissingFile, Place, SceneError, SourceText, Warning};
use crate::image::Image;
use crate::problems::Problems;
use crate::read_file::Files;
use crate::scene::{Light, Material, Mesh, Object, Shape, Texture, TextureId};
use crate::search::Search;
use crate::{Exposure, Limits, LoadOptions, Loaded};

/// Extensions that a file may require.
const KNOWN_EXTENSIONS: [&str; 16] = [
    "EXT_texture_webp",
    // Marks which triangles belong to one polygon, which does not change the picture.
    "FB_ngon_encoding",
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
];

/// What is wrong with a buffer, and the file that it would be in where that is missing.
type LostBuffer = (String, Vec<MissingFile>);

/// The state of the reader.
struct Reader<'a> {
    document: &'a gltf::Document,
    limits: &'a Limits,
    exposure: Option<Exposure>,
    animation: Option<&'a str>,
    files: &'a Files,
    problems: &'a Problems,
    search: Search,
    place: Place,
    /// Bytes, or what is wrong with them.
    buffers: Vec<Result<Vec<u8>, LostBuffer>>,
    warnings: Vec<Warning>,
    images: Vec<Image>,
    textures: Vec<Texture>,
    materials: Vec<Material>,
    meshes: Vec<Mesh>,
    objects: Vec<Object>,
    shapes: Vec<Shape>,
    lights: Vec<Light>,
    animations: animation::Animations,
    decoded: texture::Decoded,
    looks: material::Appearances,
    /// Sets of coordinates that the material being read uses.
    sets: Vec<u32>,
    /// How many vertices were deformed.
    deformed: u64,
    /// Whether a surface emits more than a screen can show.
    has_lamps: bool,
}

/// Reads the scene in `path` and all that it refers to.
///
/// # Errors
///
/// Where a file cannot be read or is damaged, or requires an extension that is not known here.
pub(crate) fn read(
    path: &Path,
    options: &LoadOptions,
    files: &Files,
    problems: &Problems,
) -> Result<Loaded, SceneError> {
    let source = SourceText::unread(path);
    let start = Place::start(&source);
    let bytes = files
        .unpacked(path)
        .map_err(|message| SceneError::new(ErrorKind::Io, &start, message))?;
    parse_into(path, &bytes, options, files, problems)
}

#[cfg(test)]
fn parse(path: &Path, bytes: &[u8], limits: &Limits) -> Result<Loaded, SceneError> {
    let options = LoadOptions {
        limits: *limits,
        ..LoadOptions::default()
    };
    parse_into(
        path,
        bytes,
        &options,
        &Files::new(*limits),
        &Problems::default(),
    )
}

/// Reads a scene that is already in memory; `path` is for messages, and names the folder of files
/// that it refers to.
fn parse_into(
    path: &Path,
    bytes: &[u8],
    options: &LoadOptions,
    files: &Files,
    problems: &Problems,
) -> Result<Loaded, SceneError> {
    let parts = container::split(bytes).map_err(|message| {
        let start = Place::start(&SourceText::unread(path));
        let message = format!("not valid glTF 2.0: {message}");
        SceneError::new(ErrorKind::Structure, &start, message)
    })?;
    let source = source(path, bytes, &parts);
    let document = match document(parts.json, &source) {
        Ok(document) => document,
        Err(error) => mend(parts.json, &source, problems, error)?,
    };
    let mut reader = Reader {
        document: &document,
        limits: &options.limits,
        exposure: options.exposure,
        animation: options.animation.as_deref(),
        files,
        problems,
        search: Search::new(path, &options.folders),
        place: Place::start(&source),
        buffers: Vec::new(),
        warnings: Vec::new(),
        images: Vec::new(),
        textures: Vec::new(),
        materials: Vec::new(),
        meshes: Vec::new(),
        objects: Vec::new(),
        shapes: Vec::new(),
        lights: Vec::new(),
        animations: animation::Animations::default(),
        decoded: texture::Decoded::default(),
        looks: material::Appearances::default(),
        sets: Vec::new(),
        deformed: 0,
        has_lamps: false,
    };
    reader.warn_of_extensions();
    reader.warn_of_ranges();
    reader.buffers = reader.read_buffers(parts.binary.map(<[u8]>::to_vec))?;
    reader.assemble()
}

/// The document's text, for excerpts; places in a binary file are those of its JSON chunk.
fn source(path: &Path, bytes: &[u8], parts: &container::ContainerParts<'_>) -> Arc<SourceText> {
    let is_binary = parts.json.len() < bytes.len();
    let chunk = if is_binary { " (JSON chunk)" } else { "" };
    let text = core::str::from_utf8(parts.json).unwrap_or_default();
    SourceText::new(format!("{}{chunk}", path.display()), text)
}

/// The document, if the crate accepts it.
fn document(json: &[u8], source: &Arc<SourceText>) -> Result<gltf::Document, SceneError> {
    let root = gltf::json::Root::from_slice(json)
        .map_err(|e| damaged(gltf::Error::Deserialize(e), source))?;
    checked(root, source)
}

fn checked(
    mut root: gltf::json::Root,
    source: &Arc<SourceText>,
) -> Result<gltf::Document, SceneError> {
    precheck::precheck(&mut root).map_err(|message| {
        let message = format!("not valid glTF 2.0: {message}");
        SceneError::new(ErrorKind::Structure, &Place::start(source), message)
    })?;
    let asset = gltf::json::serialize::to_value(&root.asset).unwrap_or_default();
    if let Some((path, message)) = version::fault(&asset) {
        let message = format!("{}: {message}", locate::written(&path));
        let start = Place::start(source);
        return Err(SceneError::new(ErrorKind::Unsupported, &start, message));
    }
    gltf::Document::from_json(root).map_err(|e| damaged(e, source))
}

/// Most mistakes of a document whose places are searched for.
const MOST_PLACES: usize = 2 * crate::problems::MOST;

/// Records all mistakes of a document that the crate refuses; returns what is left of it.
///
/// * `error`: the crate's, for what the schema does not know.
fn mend(
    json: &[u8],
    source: &Arc<SourceText>,
    problems: &Problems,
    error: SceneError,
) -> Result<gltf::Document, SceneError> {
    let Some((mistakes, rest)) = mistakes::find(json) else {
        return Err(error);
    };
    let start = Place::start(source);
    let mut errors: Vec<SceneError> = Vec::new();
    for (i, mistake) in mistakes.into_iter().enumerate() {
        let found = match i < MOST_PLACES {
            true => locate::find(source.text(), &mistake.path),
            false => None,
        };
        let place = found.map_or_else(|| start.clone(), |r| Place::new(source, r.start, r.len()));
        let message = format!("{}: {}", locate::written(&mistake.path), mistake.message);
        let error = SceneError::new(mistake.kind, &place, message);
        errors.push(error.with_hint(mistake.help.map(str::to_owned)));
    }
    let located = errors.len().min(MOST_PLACES);
    errors[..located].sort_by_key(|e| e.place().offset());
    let Some(last) = errors.pop() else {
        return Err(error);
    };
    for error in errors {
        problems.record(error)?;
    }
    let left = rest.and_then(|rest| gltf::json::deserialize::from_value(rest).ok());
    match left.and_then(|root| checked(root, source).ok()) {
        Some(document) => problems.record(last).map(|()| document),
        None => Err(last),
    }
}

/// The crate's error, at its line where it has one.
fn damaged(error: gltf::Error, source: &Arc<SourceText>) -> SceneError {
    let start = Place::start(source);
    match error {
        gltf::Error::Deserialize(e) => {
            let line_start = source
                .text()
                .split_inclusive('\n')
                .take(e.line().saturating_sub(1))
                .map(str::len)
                .sum::<usize>();
            let place = Place::new(source, line_start + e.column().saturating_sub(1), 1);
            SceneError::new(ErrorKind::Syntax, &place, format!("not glTF 2.0: {e}"))
        }
        gltf::Error::Validation(errors) => {
            let list: Vec<String> = errors
                .iter()
                .take(5)
                .map(|(path, e)| format!("{}: {e}", path.as_str()))
                .collect();
            let more = match errors.len().checked_sub(list.len()) {
                Some(n) if n > 0 => format!(" (and {n} more)"),
                _ => String::new(),
            };
            let message = format!("not valid glTF 2.0: {}{more}", list.join("; "));
            SceneError::new(ErrorKind::Structure, &start, message)
        }
        other => SceneError::new(
            ErrorKind::Structure,
            &start,
            format!("not glTF 2.0: {other}"),
        ),
    }
}

impl Reader<'_> {
    fn error(&self, kind: ErrorKind, message: impl Into<String>) -> SceneError {
        let message = message.into();
        SceneError::new(kind, &self.place_of(&message), message)
    }

    /// The place of the element that a message begins with.
    fn place_of(&self, message: &str) -> Place {
        let source = self.place.shared_source();
        if self.problems.is_full() {
            // Where there are many, their places would take long.
            return self.place.clone();
        }
        match locate::locate(source.text(), message) {
            Some(range) => Place::new(source, range.start, range.len()),
            None => self.place.clone(),
        }
    }

    /// A warning, once for each message.
    fn warn(&mut self, message: impl Into<String>) {
        let message = message.into();
        if self.warnings.iter().all(|w| w.message() != message) {
            // Where there are many, their places would take long.
            let place = match self.warnings.len() < 100 {
                true => self.place_of(&message),
                false => self.place.clone(),
            };
            self.warnings.push(Warning::new(&place, message));
        }
    }

    fn add_texture(&mut self, texture: Texture) -> TextureId {
        self.textures.push(texture);
        TextureId(self.textures.len() - 1)
    }

    fn warn_of_extensions(&mut self) {
        let document = self.document;
        for name in document.extensions_used() {
            if !KNOWN_EXTENSIONS.contains(&name) {
                self.warn(format!("extension {name} is not supported and is left out"));
            }
        }
    }
}

#[cfg(test)]
mod tests;
