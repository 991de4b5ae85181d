//! Scenes written to a temporary folder.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use specula_scene::{Format, LoadOptions, Loaded, SceneError, load_as};

static COUNT: AtomicUsize = AtomicUsize::new(0);

/// A folder that goes when it is dropped.
pub(crate) struct Folder(PathBuf);

impl Folder {
    pub(crate) fn new() -> Self {
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let name = format!("specula-mitsuba-{}-{number}", std::process::id());
        let path = std::env::temp_dir().join(name);
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    pub(crate) fn write(&self, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
        let path = self.0.join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, bytes).unwrap();
        path
    }

    pub(crate) fn load(&self, text: impl AsRef<[u8]>) -> Result<Loaded, SceneError> {
        self.load_with(text, &LoadOptions::default())
    }

    pub(crate) fn load_with(
        &self,
        text: impl AsRef<[u8]>,
        options: &LoadOptions,
    ) -> Result<Loaded, SceneError> {
        load_as(&self.write("scene.xml", text), Format::Mitsuba, options)
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

/// What every scene of these tests has.
pub(crate) const REST: &str = r#"<sensor type="perspective"/><emitter type="constant"/>"#;

/// Loads `inside` as a scene with a camera and a light.
pub(crate) fn load(inside: &str) -> Result<Loaded, SceneError> {
    Folder::new().load(format!(
        "<scene version=\"3.0.0\">\n{inside}\n{REST}</scene>"
    ))
}

/// Loads a rectangle with something in it.
pub(crate) fn load_shape(inside: &str) -> Result<Loaded, SceneError> {
    load(&format!("<shape type=\"rectangle\">{inside}</shape>"))
}

/// Messages of the warnings.
pub(crate) fn warnings(loaded: &Loaded) -> Vec<String> {
    let all = loaded.warnings.iter().map(|w| w.message().to_owned());
    all.collect()
}
