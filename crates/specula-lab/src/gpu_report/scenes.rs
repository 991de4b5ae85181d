//! The scenes of the comparison with other renderers, and a user's own.

use std::fs;
use std::path::{Path, PathBuf};

use specula_scene::Scene;

use super::sky::Sun;
use super::{Result, mesh, sky};

/// A scene of the comparison.
struct SceneFile {
    name: &'static str,
    /// What it holds.
    title: &'static str,
    text: &'static str,
    /// What it needs beside its file.
    needs: &'static [&'static str],
}

macro_rules! scene_files {
    ($($name:literal, $title:literal, $needs:expr;)*) => {
        [$(SceneFile {
            name: $name,
            title: $title,
            text: include_str!(concat!("../../scenes/", $name, ".pbrt")),
            needs: &$needs,
        }),*]
    };
}

/// All scenes, the largest last.
static SCENES: [SceneFile; 4] = scene_files![
    "metal-room", "rough metal in a room of metal, one lamp", [];
    "orbs-in-the-sun", "anisotropic orbs under a sky with a sun of half a degree", ["sky-sun-square.exr"];
    "glass-and-metal", "smooth and rough glass, rough metal, two lamps", [];
    "two-million-triangles", "a displaced sphere of 2 million triangles, sky and a lamp",
        ["sky-square.exr", "displaced-sphere.ply"];
];

/// A scene to be rendered.
pub(super) struct Subject {
    pub(super) name: String,
    /// What it holds.
    pub(super) title: String,
    source: Source,
}

enum Source {
    Own(&'static SceneFile),
    File(PathBuf),
}

/// The scenes of the comparison, then files.
///
/// * `quick`: without the largest one.
pub(super) fn subjects(quick: bool, files: &[PathBuf]) -> Vec<Subject> {
    let count = if quick { 3 } else { SCENES.len() };
    let own = SCENES[..count].iter().map(Subject::own);
    let files = files.iter().map(|file| Subject {
        name: file
            .file_stem()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned(),
        title: file.display().to_string(),
        source: Source::File(file.clone()),
    });
    own.chain(files).collect()
}

/// The room of metal, whose paths are long.
pub(super) fn metal_room() -> Subject {
    Subject::own(&SCENES[0])
}

impl Subject {
    fn own(scene: &'static SceneFile) -> Self {
        Self {
            name: scene.name.to_owned(),
            title: scene.title.to_owned(),
            source: Source::Own(scene),
        }
    }

    /// Reads the scene.
    pub(super) fn load(&self) -> Result<Scene> {
        match &self.source {
            Source::File(file) => Ok(specula_scene::load(file)?.scene),
            Source::Own(scene) => {
                let folder = tempfile::tempdir()?;
                for need in scene.needs {
                    make(need, &folder.path().join(need))?;
                }
                let file = folder.path().join("scene.pbrt");
                fs::write(&file, scene.text)?;
                Ok(specula_scene::load(&file)?.scene)
            }
        }
    }
}

/// Makes what a scene needs.
fn make(name: &str, path: &Path) -> Result<()> {
    match name {
        "sky-square.exr" => sky::write_square(path, 512, None),
        "sky-sun-square.exr" => sky::write_square(path, 2048, Some(Sun::LOW)),
        _ => mesh::write_displaced_sphere(path, 1000, 1001),
    }
}
