//! XML to a tree of plugins: parameters, defaults, includes, folders, aliases and ids.

use std::cell::Cell;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::Arc;

use glam::DMat4;
use roxmltree::{Node, ParsingOptions};

use super::element::{Element, Property};
use super::plain_value::plain_value;
use super::value::Value;
use super::{spectrum, transform, upgrade};
use crate::error::{ErrorKind, Place, SceneError, SourceText, Warning};
use crate::num::shorten;
use crate::problems::Problems;
use crate::read_file::Files;
use crate::search;
use crate::{Limits, LoadOptions};

/// A scene's files as a tree of plugins.
pub(super) struct Document {
    pub(super) root: Element,
    pub(super) ids: HashMap<String, Rc<Element>>,
    /// Folders that are searched for files, in this order.
    pub(super) folders: Vec<PathBuf>,
    pub(super) warnings: Vec<Warning>,
    pub(super) problems: Problems,
}

/// Reads `path` and what it includes.
pub(super) fn read(
    path: &Path,
    options: &LoadOptions,
    access: &Files,
    problems: &Problems,
) -> Result<Document, SceneError> {
    let mut reader = Reader {
        limits: &options.limits,
        access,
        problems,
        parameters: options.parameters.clone(),
        ids: HashMap::new(),
        folders: vec![folder_of(path)],
        warnings: Vec::new(),
        files: Vec::new(),
        bytes: 0,
        opened: 0,
    };
    reader.folders.extend(options.folders.iter().cloned());
    let source = SourceText::unread(path);
    let root = reader.file(path, &Place::start(&source))?;
    if root.class != "scene" {
        let message = format!("expected <scene>, found <{}>", root.class);
        return Err(SceneError::new(ErrorKind::Structure, &root.place, message));
    }
    Ok(Document {
        root,
        ids: reader.ids,
        folders: reader.folders,
        warnings: reader.warnings,
        problems: problems.clone(),
    })
}

fn folder_of(path: &Path) -> PathBuf {
    path.parent().map(Path::to_owned).unwrap_or_default()
}

/// Tags of plugins.
const CLASSES: [&str; 14] = [
    "scene",
    "bsdf",
    "emitter",
    "film",
    "integrator",
    "medium",
    "phase",
    "rfilter",
    "sampler",
    "sensor",
    "shape",
    "subsurface",
    "texture",
    "volume",
];

/// Most bytes that an attribute with parameters in it unfolds to: a parameter of two others, and those
/// of two others each, grow without bound.
const LONGEST_VALUE: usize = 1 << 20;

struct Reader<'a> {
    limits: &'a Limits,
    access: &'a Files,
    problems: &'a Problems,
    /// Names without `$`, and values.
    parameters: Vec<(String, String)>,
    ids: HashMap<String, Rc<Element>>,
    folders: Vec<PathBuf>,
    warnings: Vec<Warning>,
    /// Files that are being read, the main one first.
    files: Vec<PathBuf>,
    /// Bytes of all files so far.
    bytes: u64,
    /// Files so far, counted as often as they are included.
    opened: usize,
}

/// The file that a node belongs to.
struct File {
    source: Arc<SourceText>,
    legacy: bool,
}

impl File {
    fn place(&self, node: Node) -> Place {
        let range = node.range();
        let text = &self.source.text()[range.clone()];
        let length = text.find(['>', '\n']).map_or(text.len(), |i| i + 1);
        Place::new(&self.source, range.start, length)
    }

    fn error(&self, node: Node, kind: ErrorKind, message: impl Into<String>) -> SceneError {
        SceneError::new(kind, &self.place(node), message)
    }

    fn wrong(&self, node: Node, message: impl Into<String>) -> SceneError {
        self.error(node, ErrorKind::Parameter, message)
    }
}

/// Attributes of a node with their parameters filled in.
pub(super) type Attributes<'i> = Vec<(&'i str, String)>;

pub(super) fn attribute<'a>(attributes: &'a Attributes, name: &str) -> Option<&'a str> {
    attributes
        .iter()
        .find(|(n, _)| *n == name)
        .map(|(_, v)| v.as_str())
}

impl Reader<'_> {
    /// The element at the root of a file.
    fn file(&mut self, path: &Path, asked: &Place) -> Result<Element, SceneError> {
        if self.files.iter().any(|f| f == path) {
            let message = format!("{} includes itself", path.display());
            return Err(SceneError::new(ErrorKind::RecursiveInclude, asked, message));
        }
        if self.files.len() >= self.limits.max_depth {
            let message = format!(
                "more than {} files within files (`max_depth`)",
                self.limits.max_depth
            );
            return Err(SceneError::new(ErrorKind::Limit, asked, message));
        }
        // The scene's own file is not included.
        if self.opened > self.limits.max_files {
            let message = format!(
                "more than {} files are included (`max_files`)",
                self.limits.max_files
            );
            return Err(SceneError::new(ErrorKind::Limit, asked, message));
        }
        self.opened += 1;
        let unreadable = |message: String| {
            let message = format!("{} {message}", path.display());
            let error = SceneError::new(ErrorKind::Io, asked, message);
            match self.files.is_empty() {
                // The main file is not searched for in other folders.
                true => error,
                false => error.if_missing(hint(&self.folders, asked, path), path),
            }
        };
        let bytes = self.access.plain(path).map_err(unreadable)?;
        self.bytes += bytes.len() as u64;
        if self.bytes > self.limits.max_bytes {
            let message = format!(
                "the scene's files have more than {} bytes together (`max_bytes`)",
                self.limits.max_bytes
            );
            return Err(SceneError::new(ErrorKind::Limit, asked, message));
        }
        let source = self.text(path, bytes)?;
        let text = Arc::clone(&source);
        let options = ParsingOptions {
            // Every node takes at least three bytes.
            nodes_limit: u32::try_from(text.text().len() / 3 + 16).unwrap_or(u32::MAX),
            ..ParsingOptions::default()
        };
        let parsed = roxmltree::Document::parse_with_options(text.text(), options)
            .map_err(|e| syntax(&source, &e))?;
        let root = parsed.root_element();
        let version = root.attribute("version").unwrap_or("3.0.0");
        let file = File {
            source,
            legacy: is_legacy(version).ok_or_else(|| bad_version(&text, version, root))?,
        };
        self.files.push(path.to_owned());
        let element = self.element(&file, root, 0);
        self.files.pop();
        element
    }

    fn text(&self, path: &Path, bytes: Vec<u8>) -> Result<Arc<SourceText>, SceneError> {
        let name = path.display().to_string();
        String::from_utf8(bytes)
            .map(|text| SourceText::new(name, text.strip_prefix('\u{feff}').unwrap_or(&text)))
            .map_err(|e| {
                let valid = &e.as_bytes()[..e.utf8_error().valid_up_to()];
                let start = String::from_utf8_lossy(valid).into_owned();
                let offset = start.len();
                let source = SourceText::new(path.display().to_string(), start);
                let message = "the file is not UTF-8 text from here on";
                SceneError::new(
                    ErrorKind::Encoding,
                    &Place::new(&source, offset, 0),
                    message,
                )
            })
    }

    /// A plugin and all that is in it.
    fn element(&mut self, file: &File, node: Node, depth: usize) -> Result<Element, SceneError> {
        if depth > self.limits.max_depth {
            let message = format!(
                "more than {} elements within elements (`max_depth`)",
                self.limits.max_depth
            );
            return Err(file.error(node, ErrorKind::Limit, message));
        }
        let attributes = self.attributes(file, node)?;
        let class = class_of(node.tag_name().name());
        let mut element = Element {
            class,
            plugin: match attribute(&attributes, "type") {
                Some(plugin) => plugin.to_owned(),
                None if class == "scene" => "scene".to_owned(),
                None => {
                    let message = format!("<{class}> needs an attribute \"type\"");
                    return Err(file.wrong(node, message));
                }
            },
            id: attribute(&attributes, "id").map(str::to_owned),
            place: file.place(node),
            legacy: file.legacy,
            properties: Vec::new(),
            visited: Cell::new(false),
            referenced: Cell::new(false),
            problems: self.problems.clone(),
            damaged: Rc::default(),
        };
        for child in node.children().filter(Node::is_element) {
            if let Err(error) = self.child(file, child, &mut element, depth) {
                element.record(error)?;
                self.register_lost(file, child);
            }
        }
        if element.legacy {
            upgrade::upgrade(&mut element);
        }
        Ok(element)
    }

    fn child(
        &mut self,
        file: &File,
        node: Node,
        parent: &mut Element,
        depth: usize,
    ) -> Result<(), SceneError> {
        let attributes = self.attributes(file, node)?;
        let tag = node.tag_name().name();
        let name = attribute(&attributes, "name").unwrap_or("");
        match tag {
            "default" => return self.default(file, node, &attributes),
            "include" => return self.include(file, node, &attributes, parent),
            "path" => return self.path(file, node, &attributes),
            "alias" => return self.alias(file, node, &attributes),
            _ => {}
        }
        // A spectrum with a type is a plugin; else it holds its values itself.
        let is_plugin = CLASSES.contains(&class_of(tag))
            && (tag != "spectrum" || attribute(&attributes, "type").is_some());
        let value = if is_plugin {
            let element = self.element(file, node, depth + 1)?;
            Value::Element(self.register(element)?)
        } else if tag == "transform" {
            Value::Transform(self.transform(file, node)?)
        } else if tag == "spectrum" && attribute(&attributes, "filename").is_some() {
            let name = attribute(&attributes, "filename").unwrap_or("");
            let path = resolve(
                &self.folders,
                &folder_of(Path::new(file.source.name())),
                name,
            );
            Value::Spectrum(spectrum::from_file(&path, self.access).map_err(|m| {
                let place = file.place(node);
                let hint = hint(&self.folders, &place, &path);
                SceneError::new(ErrorKind::Spectrum, &place, m).if_missing(hint, &path)
            })?)
        } else {
            plain_value(tag, &attributes, file.legacy).map_err(|m| file.wrong(node, m))?
        };
        let is_nameless = matches!(value, Value::Element(_) | Value::Reference(_));
        if name.is_empty() && !is_nameless {
            return Err(file.wrong(node, format!("<{tag}> needs an attribute \"name\"")));
        }
        if !name.is_empty()
            && let Some(before) = parent.properties.iter().find(|p| p.name == name)
        {
            let message = format!(
                "\"{}\" is given twice; the first is at {}",
                shorten(name),
                before.place
            );
            return Err(file.error(node, ErrorKind::Duplicate, message));
        }
        parent.properties.push(Property {
            name: name.to_owned(),
            value,
            place: file.place(node),
            used: Cell::new(false),
            damaged: Rc::clone(&parent.damaged),
        });
        Ok(())
    }

    /// Defines the id of a plugin with a mistake, so that references to it are not reported.
    fn register_lost(&mut self, file: &File, node: Node) {
        let Some(id) = node.attribute("id").filter(|_| !node.has_tag_name("ref")) else {
            return;
        };
        let element = Element {
            class: class_of(node.tag_name().name()),
            plugin: node.attribute("type").unwrap_or_default().to_owned(),
            id: Some(id.to_owned()),
            place: file.place(node),
            legacy: file.legacy,
            properties: Vec::new(),
            visited: Cell::new(false),
            referenced: Cell::new(false),
            problems: self.problems.clone(),
            damaged: Rc::new(Cell::new(true)),
        };
        self.ids.entry(id.to_owned()).or_insert(Rc::new(element));
    }

    /// Defines a plugin's id.
    fn register(&mut self, element: Element) -> Result<Rc<Element>, SceneError> {
        let element = Rc::new(element);
        if let Some(id) = &element.id
            && let Some(before) = self.ids.insert(id.clone(), Rc::clone(&element))
        {
            let message = format!(
                "the id \"{}\" is given twice; the first is at {}",
                shorten(id),
                before.place
            );
            let error = SceneError::new(ErrorKind::Duplicate, &element.place, message);
            self.problems.record(error)?;
        }
        Ok(element)
    }

    fn transform(&mut self, file: &File, node: Node) -> Result<DMat4, SceneError> {
        let mut all = DMat4::IDENTITY;
        for child in node.children().filter(Node::is_element) {
            let attributes = self.attributes(file, child)?;
            let tag = child.tag_name().name();
            let one = transform::operation(tag, |name| attribute(&attributes, name));
            let one = one.ok_or_else(|| {
                let message = format!(
                    "<{}> is no operation of <transform>; expected translate, rotate, scale, \
                     lookat or matrix",
                    shorten(tag)
                );
                file.error(child, ErrorKind::Syntax, message)
            });
            let one = one.and_then(|one| one.map_err(|m| file.wrong(child, m)));
            all = self.problems.or(one, || DMat4::IDENTITY)? * all;
        }
        Ok(all)
    }

    fn default(
        &mut self,
        file: &File,
        node: Node,
        attributes: &Attributes,
    ) -> Result<(), SceneError> {
        let (Some(name), Some(value)) = (
            attribute(attributes, "name"),
            attribute(attributes, "value"),
        ) else {
            return Err(file.wrong(node, "<default> needs \"name\" and \"value\""));
        };
        if !name.is_empty() && self.parameters.iter().all(|(n, _)| n != name) {
            self.parameters.push((name.to_owned(), value.to_owned()));
        }
        Ok(())
    }

    fn include(
        &mut self,
        file: &File,
        node: Node,
        attributes: &Attributes,
        parent: &mut Element,
    ) -> Result<(), SceneError> {
        let name = attribute(attributes, "filename")
            .ok_or_else(|| file.wrong(node, "<include> needs an attribute \"filename\""))?;
        let own = folder_of(Path::new(file.source.name()));
        let beside = own.join(name);
        let path = if beside.exists() {
            beside
        } else {
            resolve(&self.folders, &own, name)
        };
        let included = self.file(&path, &file.place(node))?;
        if included.class == "scene" {
            parent.properties.extend(included.properties);
            return Ok(());
        }
        let name = attribute(attributes, "name").unwrap_or("").to_owned();
        let value = Value::Element(self.register(included)?);
        parent.properties.push(Property {
            name,
            value,
            place: file.place(node),
            used: Cell::new(false),
            damaged: Rc::clone(&parent.damaged),
        });
        Ok(())
    }

    fn path(&mut self, file: &File, node: Node, attributes: &Attributes) -> Result<(), SceneError> {
        let value = attribute(attributes, "value")
            .ok_or_else(|| file.wrong(node, "<path> needs an attribute \"value\""))?;
        let folder = resolve(
            &self.folders,
            &folder_of(Path::new(file.source.name())),
            value,
        );
        if folder.is_dir() {
            self.folders.insert(0, folder);
        } else {
            let message = format!("the folder \"{}\" does not exist", shorten(value));
            self.warnings.push(Warning::new(&file.place(node), message));
        }
        Ok(())
    }

    fn alias(
        &mut self,
        file: &File,
        node: Node,
        attributes: &Attributes,
    ) -> Result<(), SceneError> {
        let (Some(id), Some(new)) = (attribute(attributes, "id"), attribute(attributes, "as"))
        else {
            return Err(file.wrong(node, "<alias> needs \"id\" and \"as\""));
        };
        let Some(element) = self.ids.get(id).cloned() else {
            let message = format!("no plugin before this has the id \"{}\"", shorten(id));
            return Err(file.error(node, ErrorKind::UnknownName, message));
        };
        if self.ids.insert(new.to_owned(), element).is_some() {
            let message = format!("the id \"{}\" is given twice", shorten(new));
            return Err(file.error(node, ErrorKind::Duplicate, message));
        }
        Ok(())
    }

    /// The node's attributes, with every `$name` replaced; `\$` stands for a dollar.
    fn attributes<'i>(
        &self,
        file: &File,
        node: Node<'_, 'i>,
    ) -> Result<Attributes<'i>, SceneError> {
        node.attributes()
            .map(|a| {
                let value = self.substitute(a.value()).map_err(|(kind, message)| {
                    let place = Place::new(&file.source, a.range().start, a.range().len());
                    SceneError::new(kind, &place, message)
                })?;
                Ok((a.name(), value))
            })
            .collect()
    }

    fn substitute(&self, text: &str) -> Result<String, (ErrorKind, String)> {
        let mut out = String::with_capacity(text.len());
        let mut rest = text;
        while let Some(at) = rest.find('$') {
            let (before, after) = (&rest[..at], &rest[at + 1..]);
            if let Some(escaped) = before.strip_suffix('\\') {
                out.push_str(escaped);
                out.push('$');
                rest = after;
                continue;
            }
            out.push_str(before);
            // The longest name that fits: `$ab` is not `$a` followed by `b` where both are defined.
            let named = self
                .parameters
                .iter()
                .filter(|(name, _)| after.starts_with(name.as_str()))
                .max_by_key(|(name, _)| name.len());
            let Some((name, value)) = named else {
                let end = after.find(|c: char| !(c.is_alphanumeric() || c == '_'));
                let word = &after[..end.unwrap_or(after.len())];
                let message = format!("the parameter ${} has no value", shorten(word));
                return Err((ErrorKind::UnknownName, message));
            };
            out.push_str(value);
            if out.len() > LONGEST_VALUE {
                let message = format!("its parameters unfold to more than {LONGEST_VALUE} bytes");
                return Err((ErrorKind::Limit, message));
            }
            rest = &after[name.len()..];
        }
        out.push_str(rest);
        Ok(out)
    }
}

fn syntax(source: &Arc<SourceText>, error: &roxmltree::Error) -> SceneError {
    let position = error.pos();
    let line_start: usize = source
        .text()
        .split_inclusive('\n')
        .take(position.row.saturating_sub(1) as usize)
        .map(str::len)
        .sum();
    let line = &source.text()[line_start.min(source.text().len())..];
    let within = line
        .char_indices()
        .nth(position.col.saturating_sub(1) as usize)
        .map_or(0, |(i, _)| i);
    let place = Place::new(source, line_start + within, 1);
    let message: String = format!("this is not XML: {error}")
        .chars()
        .take(300)
        .collect();
    SceneError::new(ErrorKind::Syntax, &place, message)
}

fn bad_version(source: &Arc<SourceText>, version: &str, root: Node) -> SceneError {
    let place = Place::new(source, root.range().start, 1);
    let message = format!(
        "\"version\": expected numbers such as \"3.0.0\", found \"{}\"",
        shorten(version)
    );
    SceneError::new(ErrorKind::Parameter, &place, message)
}

/// Whether a version is below 2; `None` where it is none.
fn is_legacy(version: &str) -> Option<bool> {
    let major: u32 = version.split('.').next()?.trim().parse().ok()?;
    Some(major < 2)
}

/// The class of a tag; tags of the oldest dialects are named anew.
fn class_of(tag: &str) -> &'static str {
    match tag {
        "luminaire" => "emitter",
        "camera" => "sensor",
        "spectrum" => "texture",
        _ => CLASSES.into_iter().find(|c| *c == tag).unwrap_or(""),
    }
}

/// Help where a file that is named at `place` does not exist.
pub(super) fn hint(folders: &[PathBuf], place: &Place, path: &Path) -> Option<String> {
    let own = folder_of(Path::new(place.source().name()));
    let folders = folders.iter().map(PathBuf::as_path);
    search::hint(path, folders.chain([own.as_path()]))
}

/// The first folder that has a file, or the main file's folder where none has it.
pub(super) fn resolve(folders: &[PathBuf], own: &Path, name: &str) -> PathBuf {
    // Files written on Windows name their textures with backslashes.
    let portable = name.replace('\\', "/");
    for name in [name, portable.as_str()] {
        let candidates = folders
            .iter()
            .map(PathBuf::as_path)
            .chain([own, Path::new("")]);
        if let Some(found) = candidates.map(|f| f.join(name)).find(|p| p.exists()) {
            return found;
        }
    }
    own.join(name)
}
