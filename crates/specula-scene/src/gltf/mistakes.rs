//! All mistakes of a document at once, and the document without them.
//!
//! The crate `gltf` ends with the first value of a wrong type. What it refuses is compared here with the
//! schema: each member with a mistake is named. For a check, it is then left out, and so is what cannot
//! be without it, so that reading goes on with the rest.

use std::collections::{HashMap, HashSet};

use gltf::json::{Value, deserialize};

use super::KNOWN_EXTENSIONS;
use super::locate::Step;
use super::schema::{LIGHTS, LISTS, Member, ROOT, RootList, ValueKind};
use super::version;
use crate::error::ErrorKind;

/// Something wrong in a document.
#[derive(Debug)]
pub(super) struct Mistake {
    /// The member's place.
    pub(super) path: Vec<Step>,
    pub(super) kind: ErrorKind,
    pub(super) message: String,
    pub(super) help: Option<&'static str>,
}

/// The mistakes of a document, and what is left of it, if anything; `None` of what is no JSON.
pub(super) fn find(json: &[u8]) -> Option<(Vec<Mistake>, Option<Value>)> {
    let mut root: Value = deserialize::from_slice(json).ok()?;
    let mut search = Search::default();
    if !root.is_object() {
        search.expected("an object", &root);
        return Some((search.found, None));
    }
    if let Some((path, message)) = version::fault(root.get("asset").unwrap_or(&Value::Null)) {
        search.found.push(Mistake {
            path,
            kind: ErrorKind::Unsupported,
            message,
            help: Some("export as glTF 2.0"),
        });
        // The rest would be compared with the wrong schema.
        return Some((search.found, None));
    }
    let count = lights(&mut root).and_then(|l| l.as_array().map(Vec::len));
    search.counts.insert("lights", count.unwrap_or(0));
    for list in &LISTS {
        let count = root.get(list.name).and_then(Value::as_array);
        search.counts.insert(list.name, count.map_or(0, Vec::len));
    }
    search.extensions(&root);
    if !search.found.is_empty() {
        // Extensions change what the rest means.
        return Some((search.found, None));
    }
    search.positions(&root);
    search.value(&mut root, &ValueKind::Object(ROOT));
    for list in &LISTS {
        search.path.push(Step::Name(list.name.to_owned()));
        search.list(root.get_mut(list.name), list);
        search.path.pop();
    }
    let to_lights = ["extensions", "KHR_lights_punctual", "lights"];
    search.path = to_lights.map(|n| Step::Name(n.to_owned())).into();
    search.list(lights(&mut root), &LIGHTS);
    complete(&mut root);
    Some((search.found, Some(root)))
}

fn lights(root: &mut Value) -> Option<&mut Value> {
    let extensions = root.get_mut("extensions")?;
    extensions.get_mut("KHR_lights_punctual")?.get_mut("lights")
}

/// Makes sure that what stand-ins refer to exists, and that the crate accepts what is left.
fn complete(root: &mut Value) {
    let Some(members) = root.as_object_mut() else {
        return;
    };
    members.remove("extensionsRequired");
    let asset = members.entry("asset").or_insert(Value::Null);
    if asset.get("version").is_none() {
        *asset = deserialize::from_str(r#"{"version":"2.0"}"#).unwrap_or(Value::Null);
    }
    for list in LISTS.iter().filter(|l| l.is_data) {
        let elements = members
            .entry(list.name)
            .or_insert_with(|| Value::Array(Vec::new()));
        if let Some(elements) = elements.as_array_mut().filter(|e| e.is_empty()) {
            elements.push(stand_in(list));
        }
    }
    let accessors = members.get("accessors").cloned();
    let accessors = accessors.as_ref().and_then(Value::as_array);
    let is_whole = |primitive: &Value| {
        let position = primitive.get("attributes").and_then(|a| a.get("POSITION"));
        let accessor = accessors.zip(position.and_then(index_of));
        let accessor = accessor.and_then(|(list, index)| list.get(index));
        accessor.is_some_and(|a| ["min", "max"].iter().all(|bound| has_bound(a, bound)))
    };
    let meshes = members.get_mut("meshes").and_then(Value::as_array_mut);
    for mesh in meshes.into_iter().flatten() {
        if let Some(primitives) = mesh.get_mut("primitives").and_then(Value::as_array_mut) {
            primitives.retain(is_whole);
        }
    }
}

fn stand_in(list: &RootList) -> Value {
    deserialize::from_str(list.stand_in).unwrap_or(Value::Null)
}

#[derive(Default)]
struct Search {
    found: Vec<Mistake>,
    path: Vec<Step>,
    /// Lengths of the root's lists.
    counts: HashMap<&'static str, usize>,
    /// Elements without content.
    damaged: HashSet<(&'static str, usize)>,
}

impl Search {
    fn wrong(&mut self, message: String) -> bool {
        self.found.push(Mistake {
            path: self.path.clone(),
            kind: ErrorKind::Structure,
            message,
            help: None,
        });
        false
    }

    fn expected(&mut self, what: &str, value: &Value) -> bool {
        self.wrong(format!("expected {what}, found {}", name(value)))
    }

    /// A list of the root; the indices of its elements do not change.
    fn list(&mut self, value: Option<&mut Value>, list: &RootList) {
        let Some(value) = value else {
            return;
        };
        let Some(elements) = value.as_array_mut() else {
            self.expected("a list", value);
            *value = Value::Array(Vec::new());
            return;
        };
        for (i, element) in elements.iter_mut().enumerate() {
            self.path.push(Step::Index(i));
            if let Some(lacking) = lacks(list.name, element) {
                self.wrong(format!("expected a member {lacking}"));
            }
            let is_sound = self.value(element, &list.element);
            if !is_sound || lacks(list.name, element).is_some() {
                *element = stand_in(list);
                if list.is_data {
                    self.damaged.insert((list.name, i));
                }
            }
            self.path.pop();
        }
    }

    /// Whether a value follows the schema. Optional members with mistakes are taken
    /// away; a value is wrong where a required one is.
    fn value(&mut self, value: &mut Value, kind: &ValueKind) -> bool {
        match kind {
            ValueKind::Boolean => value.is_boolean() || self.expected("true or false", value),
            ValueKind::Number => value.is_number() || self.expected("a number", value),
            ValueKind::Text => value.is_string() || self.expected("a text", value),
            ValueKind::Integer(least, most) => {
                let within = value
                    .as_u64()
                    .is_some_and(|n| (*least..=*most).contains(&n));
                within
                    || match *most {
                        u64::MAX => self.expected("a whole number from 0", value),
                        most => {
                            let what = format!("a whole number from {least} to {most}");
                            self.expected(&what, value)
                        }
                    }
            }
            ValueKind::Numbers(count) => {
                let list = value.as_array();
                let is_sound = list.is_some_and(|l| {
                    (*count == 0 || l.len() == *count) && l.iter().all(Value::is_number)
                });
                is_sound
                    || match *count {
                        0 => self.expected("a list of numbers", value),
                        n => self.expected(&format!("a list of {n} numbers"), value),
                    }
            }
            ValueKind::Choice(numbers) => {
                let known = value.as_u64().is_some_and(|n| numbers.contains(&n));
                known || {
                    let list: Vec<String> = numbers.iter().map(u64::to_string).collect();
                    self.expected(&format!("one of {}", list.join(", ")), value)
                }
            }
            ValueKind::Word(words) => {
                let known = value.as_str().is_some_and(|w| words.contains(&w));
                known || self.expected(&format!("one of {}", words.join(", ")), value)
            }
            ValueKind::Index(list) => self.index(value, list),
            ValueKind::List(kind) => self.elements(value, kind),
            ValueKind::Object(members) => self.object(value, members),
            ValueKind::Map(kind) => self.map(value, kind),
        }
    }

    fn index(&mut self, value: &Value, list: &'static str) -> bool {
        let count = self.counts.get(list).copied().unwrap_or(0);
        match index_of(value) {
            // The element's mistake is recorded already.
            Some(i) if i < count => !self.damaged.contains(&(list, i)),
            Some(i) => {
                let known = match count {
                    1 => "there is 1".to_owned(),
                    n => format!("there are {n}"),
                };
                self.wrong(format!("`{list}` has no element {i}: {known}"))
            }
            None => self.expected(&format!("the number of an element of `{list}`"), value),
        }
    }

    fn elements(&mut self, value: &mut Value, kind: &ValueKind) -> bool {
        let Some(elements) = value.as_array_mut() else {
            return self.expected("a list", value);
        };
        let mut i = 0;
        elements.retain_mut(|element| {
            self.path.push(Step::Index(i));
            let is_sound = self.value(element, kind);
            self.path.pop();
            i += 1;
            is_sound
        });
        true
    }

    fn object(&mut self, value: &mut Value, members: &[Member]) -> bool {
        if !value.is_object() {
            return self.expected("an object", value);
        }
        let mut is_sound = true;
        for member in members {
            self.path.push(Step::Name(member.name.to_owned()));
            let found = value.get_mut(member.name);
            let is_there = found.is_some();
            let is_good = found.is_some_and(|v| self.value(v, &member.kind));
            self.path.pop();
            if !is_there && member.needed {
                self.wrong(format!("expected a member `{}`", member.name));
            }
            if !is_good {
                is_sound &= !member.needed;
                if let Some(object) = value.as_object_mut() {
                    object.remove(member.name);
                }
            }
        }
        is_sound
    }

    fn map(&mut self, value: &mut Value, kind: &ValueKind) -> bool {
        let Some(object) = value.as_object_mut() else {
            return self.expected("an object", value);
        };
        object.retain(|name, value| {
            self.path.push(Step::Name(name.to_owned()));
            let is_sound = self.value(value, kind);
            self.path.pop();
            is_sound
        });
        true
    }

    /// Positions, which every primitive needs, and their bounds.
    fn positions(&mut self, root: &Value) {
        let accessors = members(root, "accessors");
        let mut seen = HashSet::new();
        for (i, mesh) in members(root, "meshes").iter().enumerate() {
            for (j, primitive) in members(mesh, "primitives").iter().enumerate() {
                let Some(attributes) = primitive.get("attributes").and_then(Value::as_object)
                else {
                    continue;
                };
                let Some(position) = attributes.get("POSITION") else {
                    let name = |n: &str| Step::Name(n.to_owned());
                    let [meshes, primitives] = ["meshes", "primitives"].map(name);
                    self.path = vec![meshes, Step::Index(i), primitives, Step::Index(j)];
                    self.path.push(name("attributes"));
                    self.wrong("expected a member `POSITION`".to_owned());
                    continue;
                };
                let index = index_of(position).filter(|index| seen.insert(*index));
                let Some(accessor) = index.and_then(|index| accessors.get(index)) else {
                    continue;
                };
                self.path = vec![Step::Name("accessors".to_owned())];
                self.path.extend(index.map(Step::Index));
                for bound in ["min", "max"]
                    .into_iter()
                    .filter(|b| !has_bound(accessor, b))
                {
                    self.wrong(format!("positions need a `{bound}` of 3 numbers"));
                }
            }
        }
        self.path.clear();
    }

    /// Extensions that the file cannot be without.
    fn extensions(&mut self, root: &Value) {
        let required = root.get("extensionsRequired").and_then(Value::as_array);
        for (i, name) in required.into_iter().flatten().enumerate() {
            let Some(name) = name.as_str().filter(|n| !KNOWN_EXTENSIONS.contains(n)) else {
                continue;
            };
            self.found.push(Mistake {
                path: vec![Step::Name("extensionsRequired".to_owned()), Step::Index(i)],
                kind: ErrorKind::Unsupported,
                message: format!("the file requires the extension {name}, which is not supported"),
                help: Some(
                    "export without compression of meshes (Draco, meshopt) and pictures (Basis)",
                ),
            });
        }
    }
}

/// A list within an object; empty where there is none.
fn members<'a>(value: &'a Value, name: &str) -> &'a [Value] {
    let list = value.get(name).and_then(Value::as_array);
    list.map_or(&[], Vec::as_slice)
}

fn index_of(value: &Value) -> Option<usize> {
    value.as_u64().and_then(|i| usize::try_from(i).ok())
}

/// Whether an accessor has a bound of positions, or none: nothing reads it.
fn has_bound(accessor: &Value, bound: &str) -> bool {
    let numbers = members(accessor, bound);
    accessor.get(bound).is_none_or(Value::is_null)
        || numbers.len() == 3 && numbers.iter().all(Value::is_number)
}

/// What an element of a list of the root needs beyond the types of its members.
fn lacks(list: &str, element: &Value) -> Option<&'static str> {
    let has = |name: &str| element.get(name).is_some_and(|v| !v.is_null());
    let kind = element.get("type").and_then(Value::as_str);
    if !element.is_object() {
        return None;
    }
    match list {
        "accessors" if !has("bufferView") && !has("sparse") => Some("`bufferView` or `sparse`"),
        "images" if !has("bufferView") && !has("uri") => Some("`uri` or `bufferView`"),
        "cameras" if kind == Some("perspective") && !has("perspective") => Some("`perspective`"),
        "cameras" if kind == Some("orthographic") && !has("orthographic") => Some("`orthographic`"),
        "lights" if kind == Some("spot") && !has("spot") => Some("`spot`"),
        _ => None,
    }
}

/// A value, for messages.
fn name(value: &Value) -> String {
    match value {
        Value::Array(list) => format!("a list of {}", list.len()),
        Value::Object(_) => "an object".to_owned(),
        other => {
            let text = other.to_string();
            match text.char_indices().nth(40) {
                None => text,
                Some((end, _)) => format!("{}...", &text[..end]),
            }
        }
    }
}
