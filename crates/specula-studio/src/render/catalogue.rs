//! The scenes that can be rendered: built in, given to the program, dropped on a page.

use std::sync::Arc;

use serde::Serialize;
use serde_json::{Value, json};
use specula_scene::{Loaded, Scene};

use super::scenes;
use crate::AskError;

/// Where a scene comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SceneFrom {
    /// It is part of the program.
    BuiltIn,
    /// It was given to the program when it was started.
    Given,
    /// It was dropped on a page, or opened from it.
    Dropped,
}

/// A scene with what is to be said about it.
#[derive(Clone, Debug)]
pub struct GivenScene {
    /// The scene; it must satisfy [`Scene::validate`].
    pub scene: Scene,
    /// Warnings of its reader, in words.
    pub warnings: Vec<String>,
}

impl From<Scene> for GivenScene {
    fn from(scene: Scene) -> Self {
        let warnings = Vec::new();
        Self { scene, warnings }
    }
}

impl From<Loaded> for GivenScene {
    fn from(loaded: Loaded) -> Self {
        let said = |w: &specula_scene::Warning| format!("{}: {w}", w.place());
        Self {
            warnings: loaded.warnings.iter().map(said).collect(),
            scene: loaded.scene,
        }
    }
}

/// The scenes by name.
#[derive(Debug)]
pub(crate) struct Catalogue {
    entries: Vec<Entry>,
    pub(crate) opens_files: bool,
}

#[derive(Debug)]
struct Entry {
    name: String,
    title: String,
    from: SceneFrom,
    source: Source,
}

#[derive(Debug)]
enum Source {
    /// Made when it is opened first.
    Made(fn() -> Scene),
    Kept(Arc<GivenScene>),
}

/// A scene with its name.
#[derive(Clone, Debug)]
pub(super) struct Named {
    pub(super) name: String,
    pub(super) from: SceneFrom,
    pub(super) given: Arc<GivenScene>,
}

impl Default for Catalogue {
    fn default() -> Self {
        let built_in = |&(name, title, make): &scenes::BuiltIn| Entry {
            name: name.to_owned(),
            title: title.to_owned(),
            from: SceneFrom::BuiltIn,
            source: Source::Made(make),
        };
        Self {
            entries: scenes::BUILT_IN.iter().map(built_in).collect(),
            opens_files: false,
        }
    }
}

impl Catalogue {
    /// Adds a scene, in the place of one of the same name.
    pub(crate) fn add(&mut self, name: &str, title: &str, from: SceneFrom, given: GivenScene) {
        self.remove(name);
        self.entries.push(Entry {
            name: name.to_owned(),
            title: title.to_owned(),
            from,
            source: Source::Kept(Arc::new(given)),
        });
    }

    /// Removes a scene; returns whether there was one of this name.
    pub(crate) fn remove(&mut self, name: &str) -> bool {
        let before = self.entries.len();
        self.entries.retain(|e| e.name != name);
        self.entries.len() < before
    }

    /// The answer to `render.scenes`.
    pub(super) fn list(&self) -> Value {
        let item = |e: &Entry| json!({"name": e.name, "title": e.title, "from": e.from});
        let scenes: Vec<Value> = self.entries.iter().map(item).collect();
        json!({"scenes": scenes, "opensFiles": self.opens_files})
    }

    /// The scene of a name.
    pub(super) fn scene(&mut self, name: &str) -> Result<Named, AskError> {
        let names = || {
            let all: Vec<&str> = self.entries.iter().map(|e| e.name.as_str()).collect();
            AskError::new(format!(
                "scene: there is no '{name}' (there are {})",
                all.join(", ")
            ))
        };
        let Some(place) = self.entries.iter().position(|e| e.name == name) else {
            return Err(names());
        };
        let entry = &mut self.entries[place];
        let given = match &entry.source {
            Source::Kept(given) => given.clone(),
            Source::Made(make) => {
                let given = Arc::new(GivenScene::from(make()));
                entry.source = Source::Kept(given.clone());
                given
            }
        };
        Ok(Named {
            name: entry.name.clone(),
            from: entry.from,
            given,
        })
    }
}
