//! Scenes: read from files, or built in.

use std::ffi::CString;
use std::path::Path;

use specula_scene::{Scene, SceneError, Warning};

use crate::failure::{Failure, Status};

/// A scene: shapes, materials, lights and a camera. `specula_scene_free` frees it.
pub struct SceneHandle {
    pub(crate) scene: Scene,
    pub(crate) name: String,
    pub(crate) warnings: Vec<CString>,
}

impl SceneHandle {
    /// Reads a scene of any format.
    pub(crate) fn load(path: &str) -> Result<Self, Failure> {
        let path = Path::new(path);
        let loaded = specula_scene::load(path).map_err(|e| unreadable(&e))?;
        let said = |w: &Warning| {
            let text = format!("{}: {}", w.place(), w.message());
            CString::new(text.replace('\0', "\u{fffd}")).unwrap_or_default()
        };
        Ok(Self {
            warnings: loaded.warnings.iter().map(said).collect(),
            scene: loaded.scene,
            name: (path.file_stem().unwrap_or_default().to_string_lossy()).into_owned(),
        })
    }

    /// The built-in scene.
    pub(crate) fn builtin() -> Self {
        Self {
            scene: specula_scene::builtin::orbs(),
            name: "orbs".to_owned(),
            warnings: Vec::new(),
        }
    }
}

fn unreadable(error: &SceneError) -> Failure {
    let help = error.help().map_or_else(String::new, |h| format!(" ({h})"));
    Failure::new(
        Status::Unreadable,
        format!("{}: {}{help}", error.place(), error.message()),
    )
}
