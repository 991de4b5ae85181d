//! Scenes written to a temporary folder.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use specula_scene::{Loaded, SceneError};

static COUNT: AtomicUsize = AtomicUsize::new(0);

/// A folder that goes when it is dropped.
pub(crate) struct Folder(PathBuf);

impl Folder {
    pub(crate) fn new() -> Self {
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let name = format!("specula-scene-{}-{number}", std::process::id());
        let path = std::env::temp_dir().join(name);
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    pub(crate) fn write(&self, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
        let path = self.0.join(name);
        fs::write(&path, bytes).unwrap();
        path
    }

    pub(crate) fn load(&self, text: impl AsRef<[u8]>) -> Result<Loaded, SceneError> {
        specula_scene::load(&self.write("scene.pbrt", text))
    }

    pub(crate) fn path(&self) -> &Path {
        &self.0
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // A folder that stays behind in the temporary folder fails no test.
        drop(fs::remove_dir_all(&self.0));
    }
}

/// Loads a scene that refers to no files.
pub(crate) fn load(text: impl AsRef<[u8]>) -> Result<Loaded, SceneError> {
    Folder::new().load(text)
}

/// Loads `world` after `WorldBegin`, with a sphere so that the scene is not empty.
pub(crate) fn load_world(world: &str) -> Result<Loaded, SceneError> {
    load(format!("WorldBegin\n{world}\nShape \"sphere\"\n"))
}

/// Messages of the warnings, without those about darkness and about the default camera.
pub(crate) fn warnings(loaded: &Loaded) -> Vec<String> {
    let all = loaded.warnings.iter().map(|w| w.message().to_owned());
    all.filter(|w| !w.contains("no light") && !w.contains("no `Camera`"))
        .collect()
}
