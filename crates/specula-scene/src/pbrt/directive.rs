//! The directives of a pbrt-v4 file and the stack of attributes.

use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::DMat4;

use super::context::{Context, Entity};
use super::medium::MediumEntity;
use super::param::ParamList;
use super::shape::ShapeEntity;
use super::state::{ATTRIBUTE_TARGETS, State};
use super::token::{TokenKind, Tokens, describe};
use super::unknown;
use super::v3;
use crate::LoadOptions;
use crate::error::{ErrorKind, Place, SceneError, SourceText};
use crate::num::shorten;
use crate::problems::Problems;
use crate::read_file::Files;
use crate::spectrum::{COLOUR_SPACES, ColourSpace};
use crate::transform::check_transform;

/// Most parameters that `Attribute` may set at a time: every later directive searches them.
const MAX_ATTRIBUTES: usize = 1000;

/// A material of the file, read once all textures are known.
pub(super) struct MaterialEntity {
    pub(super) name: Option<String>,
    pub(super) entity: Entity,
}

/// A group of shapes.
pub(super) struct ObjectEntity {
    pub(super) name: String,
    pub(super) shapes: Vec<ShapeEntity>,
}

/// A copy of an object.
pub(super) struct InstanceEntity {
    pub(super) name: String,
    pub(super) place: Place,
    pub(super) to_world: DMat4,
    /// That of the end, where it moves.
    pub(super) end: Option<DMat4>,
}

/// Directives before `WorldBegin`.
pub(super) const OPTIONS: [&str; 6] = [
    "Camera",
    "Film",
    "PixelFilter",
    "Sampler",
    "Integrator",
    "Accelerator",
];

/// Options that `Option` may set. They control pbrt's sampling, statistics and coordinates, and change no
/// picture here; `forcediffuse` alone would.
pub(super) const PBRT_OPTIONS: [&str; 11] = [
    "disablepixeljitter",
    "disabletexturefiltering",
    "disablewavelengthjitter",
    "displacementedgescale",
    "forcediffuse",
    "msereferenceimage",
    "msereferenceout",
    "pixelstats",
    "rendercoordsys",
    "seed",
    "wavefront",
];

/// Reads directives and stores what they describe.
pub(super) struct Reader {
    pub(super) context: Context,
    pub(super) options: HashMap<&'static str, Entity>,
    /// At the start, and at the end where it moves.
    pub(super) camera_to_world: (DMat4, Option<DMat4>),
    /// Times of start and end of what moves.
    pub(super) times: [f64; 2],
    pub(super) materials: Vec<MaterialEntity>,
    pub(super) named_materials: HashMap<String, usize>,
    pub(super) shapes: Vec<ShapeEntity>,
    pub(super) objects: Vec<ObjectEntity>,
    object_names: HashSet<String>,
    pub(super) instances: Vec<InstanceEntity>,
    /// Lights that are not shapes, with their space.
    pub(super) lights: Vec<(Entity, DMat4)>,
    /// End of the main file.
    pub(super) end: Place,
    pub(super) state: State,
    /// Saved states with the directive and the place that saved them.
    pub(super) stack: Vec<(&'static str, Place, State)>,
    pub(super) in_world: bool,
    /// Whether a check met the world's directives before `WorldBegin`.
    is_early: bool,
    /// Whether a check gave up reading.
    stopped: bool,
    pub(super) in_object: bool,
    pub(super) coordinate_systems: HashMap<String, [DMat4; 2]>,
    pub(super) media: Vec<MediumEntity>,
    pub(super) camera_medium: Option<usize>,
    /// Files being read, the outermost first.
    reading: Vec<PathBuf>,
    files: usize,
    /// Bytes of all files so far.
    bytes: u64,
}

impl Reader {
    pub(super) fn new(
        main: &Path,
        options: &LoadOptions,
        files: &Files,
        problems: &Problems,
    ) -> Self {
        Self {
            context: Context::new(main, options, files, problems),
            options: HashMap::new(),
            camera_to_world: (DMat4::IDENTITY, None),
            times: [0.0, 1.0],
            materials: Vec::new(),
            named_materials: HashMap::new(),
            shapes: Vec::new(),
            objects: Vec::new(),
            object_names: HashSet::new(),
            instances: Vec::new(),
            lights: Vec::new(),
            end: Place::start(&SourceText::unread(main)),
            state: State::new(),
            stack: Vec::new(),
            in_world: false,
            is_early: false,
            stopped: false,
            in_object: false,
            coordinate_systems: HashMap::new(),
            media: Vec::new(),
            camera_medium: None,
            reading: Vec::new(),
            files: 0,
            bytes: 0,
        }
    }

    /// Reads the main file.
    pub(super) fn read_main(&mut self, path: &Path) -> Result<(), SceneError> {
        self.end = self.read_file(path, None)?;
        if self.stopped {
            return Ok(());
        }
        let problems = &self.context.problems;
        for (directive, place, _) in self.stack.iter().rev() {
            let message = format!("`{directive}` is never closed");
            problems.record(SceneError::new(ErrorKind::Structure, place, message))?;
        }
        if !self.in_world && !self.is_early {
            let message = "the file ends without `WorldBegin`";
            let error = SceneError::new(ErrorKind::Structure, &self.end, message)
                .with_help("lights, materials and shapes stand after `WorldBegin`");
            problems.record(error)?;
        }
        Ok(())
    }

    /// Reads a file; `from` is where another includes it. Returns the place of its end.
    fn read_file(&mut self, path: &Path, from: Option<&Place>) -> Result<Place, SceneError> {
        let unread = Place::start(&SourceText::unread(path));
        let place = from.unwrap_or(&unread);
        let unreadable = |message: String| {
            SceneError::new(
                ErrorKind::Io,
                place,
                format!("{} {message}", path.display()),
            )
            .if_missing(from.and_then(|_| self.context.search.hint(path)), path)
        };
        let identity = match (path.canonicalize(), from) {
            (Ok(identity), _) => identity,
            // A scene that was given in memory.
            (Err(_), None) => path.to_owned(),
            (Err(e), Some(_)) => return Err(unreadable(format!("cannot be read: {e}"))),
        };
        if self.reading.contains(&identity) {
            let message = format!("{} includes itself", path.display());
            let chain: Vec<_> = self
                .reading
                .iter()
                .map(|p| p.display().to_string())
                .collect();
            return Err(SceneError::new(ErrorKind::RecursiveInclude, place, message)
                .with_help(format!("files being read: {}", chain.join(" → "))));
        }
        self.files += 1;
        let deepest = self.context.files.limits().max_depth;
        if self.reading.len() > deepest {
            let message = format!("files are included more than {deepest} deep (`max_depth`)");
            return Err(SceneError::new(ErrorKind::Limit, place, message));
        }
        // The scene's own file is not included.
        let most = self.context.files.limits().max_files;
        if self.files > most.saturating_add(1) {
            let message = format!("more than {most} files are included (`max_files`)");
            return Err(SceneError::new(ErrorKind::Limit, place, message));
        }
        let bytes = self.context.files.unpacked(path).map_err(unreadable)?;
        self.bytes += bytes.len() as u64;
        let most = self.context.files.limits().max_bytes;
        if self.bytes > most {
            let message =
                format!("the scene's files have more than {most} bytes together (`max_bytes`)");
            return Err(SceneError::new(ErrorKind::Limit, place, message));
        }
        let source = decode(path, bytes)?;
        if from.is_none()
            && let Some(place) = v3::find(&source)
        {
            self.context.turn_v3(&place);
        }
        self.reading.push(identity);
        let mut tokens = Tokens::new(&source, self.context.problems.clone());
        while !self.stopped {
            let start = tokens.look().1;
            match self.next_directive(&mut tokens) {
                Ok(true) => {}
                Ok(false) => break,
                Err(error) => {
                    let mistake = error.place().clone();
                    // What is too large for a render is too large for a check.
                    let is_limit = error.kind() == ErrorKind::Limit;
                    self.context.problems.record(error)?;
                    self.stopped |= is_limit;
                    tokens.recover(
                        &mistake,
                        &start,
                        |kind| matches!(kind, TokenKind::Word(w) if unknown::is_directive(w)),
                    );
                }
            }
        }
        self.reading.pop();
        Ok(tokens.end())
    }

    /// Follows the next directive; `false` at the end of the file.
    fn next_directive(&mut self, tokens: &mut Tokens<'_>) -> Result<bool, SceneError> {
        let Some(token) = tokens.next()? else {
            return Ok(false);
        };
        let place = tokens.place(&token);
        let TokenKind::Word(word) = token.kind else {
            let message = format!("expected a directive, found {}", describe(&token.kind));
            return Err(SceneError::new(ErrorKind::Syntax, &place, message));
        };
        match self.directive(word, &place, tokens) {
            Err(error) if error.kind() == ErrorKind::UnknownDirective => {
                let Some(meant) = unknown::meant(word) else {
                    return Err(error);
                };
                self.context.problems.record(error)?;
                self.directive(meant, &place, tokens)?;
            }
            other => other?,
        }
        Ok(true)
    }

    fn directive(
        &mut self,
        word: &str,
        place: &Place,
        tokens: &mut Tokens<'_>,
    ) -> Result<(), SceneError> {
        if self.transform_directive(word, place, tokens)?
            || self.block_directive(word, place, tokens)?
        {
            return Ok(());
        }
        if let Some(&option) = OPTIONS.iter().find(|o| **o == word) {
            let entity = self.entity(tokens, word)?;
            return self.option(option, place, entity);
        }
        match word {
            "Option" => {
                self.pbrt_option(tokens)?;
            }
            "ColorSpace" => {
                let (name, place) = tokens.expect_text("the name of a colour space")?;
                let Some(space) = ColourSpace::named(&name) else {
                    let message = format!("unknown colour space \"{}\"", shorten(&name));
                    let expected = format!("expected one of {}", COLOUR_SPACES.join(", "));
                    let error = SceneError::new(ErrorKind::Parameter, &place, message);
                    return Err(error.with_help(expected));
                };
                self.state.space = space;
            }
            "Include" | "Import" => {
                let (name, place) = tokens.expect_text("a file name")?;
                let path = self.context.resolve(&name);
                let saved = self.state.clone();
                self.read_file(&path, Some(&place))?;
                if word == "Import" {
                    self.state = saved;
                }
            }
            "Attribute" => {
                let (target, place) = tokens.expect_text("what the attribute is for")?;
                let params = ParamList::read(tokens, self.state.space)?.into_own();
                let Some(i) = ATTRIBUTE_TARGETS.iter().position(|t| *t == target) else {
                    let expected = ATTRIBUTE_TARGETS.join(", ");
                    let message =
                        format!("expected one of {expected}, found \"{}\"", shorten(&target));
                    return Err(SceneError::new(ErrorKind::Syntax, &place, message));
                };
                let attributes = &mut self.state.attributes[i];
                attributes.extend(params);
                if attributes.len() > MAX_ATTRIBUTES {
                    let message = format!("more than {MAX_ATTRIBUTES} attributes for \"{target}\"");
                    return Err(SceneError::new(ErrorKind::Limit, &place, message));
                }
            }
            _ => return self.world_directive(word, place, tokens),
        }
        Ok(())
    }

    /// `Option`, which controls pbrt itself.
    fn pbrt_option(&mut self, tokens: &mut Tokens<'_>) -> Result<(), SceneError> {
        let (name, place) = tokens.expect_text("the name of an option")?;
        let value = tokens.expect("the value of an option")?;
        let on = value.kind == TokenKind::Word("true");
        // A bracket would begin a list of values.
        if value.kind == TokenKind::Open {
            while tokens.expect("`]`")?.kind != TokenKind::Close {}
        }
        // pbrt-v4 compares names without their case and separators.
        let plain: String = name.chars().filter(|c| !"_-".contains(*c)).collect();
        match plain.to_ascii_lowercase().as_str() {
            "forcediffuse" if on => self.context.warn(
                &place,
                "\"forcediffuse\" is ignored: materials are not replaced",
            ),
            other if PBRT_OPTIONS.contains(&other) => {}
            _ => {
                let message = format!("unknown option \"{}\" is ignored", shorten(&name));
                self.context.warn(&place, message);
            }
        }
        Ok(())
    }

    fn block_directive(
        &mut self,
        word: &str,
        place: &Place,
        tokens: &mut Tokens<'_>,
    ) -> Result<bool, SceneError> {
        match word {
            "WorldBegin" => {
                if self.in_world {
                    return Err(SceneError::new(
                        ErrorKind::Structure,
                        place,
                        "a second `WorldBegin`",
                    ));
                }
                self.in_world = true;
                self.state.transforms = [DMat4::IDENTITY; 2];
                self.state.active = [true; 2];
                self.coordinate_systems
                    .insert("world".to_owned(), [DMat4::IDENTITY; 2]);
            }
            "WorldEnd" if self.context.v3.is_some() => {}
            "WorldEnd" => {
                let message = "`WorldEnd` belongs to older versions of pbrt and does nothing";
                self.context.warn(place, message);
            }
            "AttributeBegin" => self.push("AttributeBegin", place)?,
            "AttributeEnd" => self.pop("AttributeBegin", word, place)?,
            "TransformBegin" => self.push("TransformBegin", place)?,
            "TransformEnd" => self.pop("TransformBegin", word, place)?,
            "ObjectBegin" => {
                let (name, place) = tokens.expect_text("the name of an object")?;
                self.expect_world(word, &place)?;
                let name = self.defined(v3::Kind::Object, name);
                let problems = &self.context.problems;
                if self.in_object {
                    let message = "`ObjectBegin` within an object";
                    problems.record(SceneError::new(ErrorKind::Structure, &place, message))?;
                }
                if !self.object_names.insert(name.clone()) {
                    let message = format!("object \"{}\" is defined twice", shorten(&name));
                    problems.record(SceneError::new(ErrorKind::Duplicate, &place, message))?;
                }
                self.push("ObjectBegin", &place)?;
                self.in_object = true;
                self.objects.push(ObjectEntity {
                    name,
                    shapes: Vec::new(),
                });
            }
            "ObjectEnd" => self.pop("ObjectBegin", word, place)?,
            _ => return Ok(false),
        }
        Ok(true)
    }

    fn push(&mut self, directive: &'static str, place: &Place) -> Result<(), SceneError> {
        // Blocks nest deeper than files do.
        let deepest = self.context.files.limits().max_depth.saturating_mul(16);
        if self.stack.len() >= deepest {
            let message = format!("blocks are nested more than {deepest} deep (`max_depth`)");
            return Err(SceneError::new(ErrorKind::Limit, place, message));
        }
        self.stack
            .push((directive, place.clone(), self.state.clone()));
        Ok(())
    }

    fn pop(&mut self, begin: &str, end: &str, place: &Place) -> Result<(), SceneError> {
        let message = match self.stack.last() {
            Some((directive, ..)) if *directive == begin => None,
            Some((directive, opened, _)) => {
                Some(format!("`{end}` does not close `{directive}` of {opened}"))
            }
            None => Some(format!("`{end}` without `{begin}`")),
        };
        if let Some(message) = message {
            let error = SceneError::new(ErrorKind::Structure, place, message);
            self.context.problems.record(error)?;
        }
        // Blocks within that are still open end here; where nothing was opened, nothing ends.
        if let Some(i) = self.stack.iter().rposition(|(d, ..)| *d == begin) {
            self.stack.truncate(i + 1);
            if let Some((.., state)) = self.stack.pop() {
                self.state = state;
            }
        }
        self.in_object = self.stack.iter().any(|(d, ..)| *d == "ObjectBegin");
        Ok(())
    }

    fn option(
        &mut self,
        word: &'static str,
        place: &Place,
        entity: Entity,
    ) -> Result<(), SceneError> {
        if self.in_world {
            let message = format!("`{word}` after `WorldBegin`; expected it before");
            return Err(SceneError::new(ErrorKind::Structure, place, message));
        }
        if word == "Camera" {
            for m in &self.state.transforms {
                check_transform(m).map_err(|m| SceneError::new(ErrorKind::Transform, place, m))?;
            }
            let inverse = self.state.transforms.map(|m| m.inverse());
            self.camera_to_world = (inverse[0], self.state.end().map(|_| inverse[1]));
            self.camera_medium = self.state.media[1];
            self.coordinate_systems.insert("camera".to_owned(), inverse);
        }
        self.options.insert(word, entity);
        Ok(())
    }

    pub(super) fn entity(
        &mut self,
        tokens: &mut Tokens<'_>,
        word: &str,
    ) -> Result<Entity, SceneError> {
        let (name, place) = tokens.expect_text(&format!("the name after `{word}`"))?;
        let params = ParamList::read(tokens, self.state.space)?;
        let mut entity = Entity {
            name,
            place,
            params,
        };
        self.context.upgraded(word, &mut entity);
        Ok(entity)
    }

    /// The name of a thing that is defined; of pbrt-v3's, another where it was defined before.
    pub(super) fn defined(&mut self, kind: v3::Kind, mut name: String) -> String {
        if let Some(names) = &mut self.context.v3 {
            names.define(kind, &mut name);
        }
        name
    }

    /// The name of a thing that is used.
    pub(super) fn used(&self, kind: v3::Kind, mut name: String) -> String {
        if let Some(names) = &self.context.v3 {
            names.newest(kind, &mut name);
        }
        name
    }

    pub(super) fn expect_world(&mut self, word: &str, place: &Place) -> Result<(), SceneError> {
        if self.in_world || self.is_early {
            return Ok(());
        }
        let message = format!("`{word}` before `WorldBegin`; expected it after");
        let error = SceneError::new(ErrorKind::Structure, place, message);
        self.context.problems.record(error)?;
        // Once is enough for all that follows.
        self.is_early = true;
        Ok(())
    }
}

/// Text of a file, which must be UTF-8.
fn decode(path: &Path, bytes: Vec<u8>) -> Result<Arc<SourceText>, SceneError> {
    let name = path.display().to_string();
    match String::from_utf8(bytes) {
        Ok(text) if text.contains('\0') => {
            let at = text.find('\0').unwrap_or(0);
            let place = Place::new(&SourceText::new(name, printable(&text)), at, 1);
            Err(SceneError::new(
                ErrorKind::Encoding,
                &place,
                "the file holds binary data; expected UTF-8 text",
            ))
        }
        Ok(text) => Ok(SourceText::new(name, text)),
        Err(error) => {
            let at = error.utf8_error().valid_up_to();
            let text = printable(&String::from_utf8_lossy(error.as_bytes()));
            let place = Place::new(&SourceText::new(name, text), at, 1);
            let message = "the file is not UTF-8 text; expected a pbrt-v4 scene";
            Err(SceneError::new(ErrorKind::Encoding, &place, message))
        }
    }
}

/// Text without control characters, byte for byte as long: an excerpt of binary data must not control
/// the terminal that shows it.
fn printable(text: &str) -> String {
    let visible = |c: char| {
        if c.is_ascii_control() && c != '\n' {
            '.'
        } else {
            c
        }
    };
    text.chars().map(visible).collect()
}
