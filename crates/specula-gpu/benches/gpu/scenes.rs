//! The scenes of the comparison with other renderers.

use std::fs;
use std::path::Path;

use specula_scene::Scene;

use crate::{Result, root};

/// What makes their skies and meshes.
#[path = "../../../xtask/src/versus"]
#[allow(
    dead_code,
    unused_imports,
    reason = "the chore makes more of them, and has tests"
)]
mod chore {
    mod mesh;
    mod sky;

    use std::path::Path;

    use crate::Result;

    /// Makes a file of this name.
    pub(super) fn make(name: &str, path: &Path) -> Result<()> {
        match name {
            "sky-square.exr" => sky::write_square(path, 512, None),
            "sky-sun-square.exr" => sky::write_square(path, 2048, Some(sky::Sun::LOW)),
            _ => mesh::write_displaced_sphere(path, 1000, 1001),
        }
    }
}

/// One scene.
pub(crate) struct SceneFile {
    /// The name of `data/versus/NAME.pbrt`.
    pub(crate) name: &'static str,
    /// What it holds.
    pub(crate) title: &'static str,
    /// What it needs beside its file.
    needs: &'static [&'static str],
}

/// All scenes, the largest last.
pub(crate) const SCENES: [SceneFile; 4] = [
    SceneFile {
        name: "metal-room",
        title: "rough metal in a room of metal, one lamp",
        needs: &[],
    },
    SceneFile {
        name: "orbs-in-the-sun",
        title: "anisotropic orbs under a sky with a sun of half a degree",
        needs: &["sky-sun-square.exr"],
    },
    SceneFile {
        name: "glass-and-metal",
        title: "smooth and rough glass, rough metal, two lamps",
        needs: &[],
    },
    SceneFile {
        name: "two-million-triangles",
        title: "a displaced sphere of 2 million triangles, sky and a lamp",
        needs: &["sky-square.exr", "displaced-sphere.ply"],
    },
];

impl SceneFile {
    /// Reads the scene, with what it needs made before where that is not there.
    pub(crate) fn load(&self) -> Result<Scene> {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("versus");
        fs::create_dir_all(&folder)?;
        for need in self.needs {
            let path = folder.join(need);
            if !path.exists() {
                chore::make(need, &path)?;
            }
        }
        let name = format!("{}.pbrt", self.name);
        let file = folder.join(&name);
        fs::copy(root().join("data/versus").join(name), &file)?;
        Ok(specula_scene::load(&file)?.scene)
    }
}
