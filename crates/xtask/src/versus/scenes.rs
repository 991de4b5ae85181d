//! The scenes of the comparison, each in two forms, Mitsuba's and pbrt's, and files of a user's own.

use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};

use super::mesh;
use super::metals::Metals;
use super::sky::{self, Sun};
use crate::Result;

/// A scene that is compared, in one form or in two.
#[derive(Clone)]
pub(crate) struct Scene {
    pub(crate) name: String,
    /// What it holds.
    pub(crate) title: String,
    /// What its metals are.
    pub(crate) metals: Metals,
    /// First column and row of the detail that the sheet shows; the middle where there is none.
    pub(crate) detail: Option<[usize; 2]>,
    /// The file in Mitsuba's form.
    pub(crate) mitsuba: Option<PathBuf>,
    /// The file in pbrt's form.
    pub(crate) pbrt: Option<PathBuf>,
}

impl Scene {
    /// The scene of a file, whose extension tells its form.
    pub(crate) fn of_file(file: &Path) -> Result<Self> {
        let at = |e| format!("{}: {e}", file.display());
        let path = fs::canonicalize(file).map_err(at)?;
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        let extension = path.extension().and_then(|e| e.to_str());
        let (mitsuba, pbrt) = match extension {
            Some("xml") => (Some(path.clone()), None),
            Some("pbrt") => (None, Some(path.clone())),
            _ => return Err(format!("{}: expected a file .xml or .pbrt", file.display()).into()),
        };
        Ok(Self {
            name: name.replace(|c: char| !c.is_ascii_alphanumeric(), "-"),
            title: file.display().to_string(),
            metals: Metals::Own,
            detail: None,
            mitsuba,
            pbrt,
        })
    }

    /// A short name of its files' texts, so that references of another are not taken for its.
    pub(crate) fn key(&self) -> Result<u64> {
        let mut hasher = DefaultHasher::new();
        for file in self.mitsuba.iter().chain(&self.pbrt) {
            fs::read(file)?.hash(&mut hasher);
        }
        Ok(hasher.finish())
    }
}

/// One scene of the list.
pub(crate) struct SceneFile {
    /// The name of `data/versus/NAME.xml` and of `NAME.pbrt`.
    pub(crate) name: &'static str,
    /// What it holds.
    pub(crate) title: &'static str,
    /// First column and row of the detail that the sheet shows.
    pub(crate) detail: [usize; 2],
    /// What it needs beside its file.
    needs: &'static [&'static str],
}

/// All scenes.
pub(crate) const SCENES: [SceneFile; 4] = [
    SceneFile {
        name: "metal-room",
        title: "rough metal in a room of metal, one lamp, 12 bounces",
        detail: [90, 230],
        needs: &[],
    },
    SceneFile {
        name: "orbs-in-the-sun",
        title: "anisotropic orbs under a sky with a sun of half a degree",
        detail: [130, 250],
        needs: &["sky-sun.exr", "sky-sun-square.exr"],
    },
    SceneFile {
        name: "glass-and-metal",
        title: "smooth and rough glass, rough metal, two lamps",
        detail: [90, 230],
        needs: &[],
    },
    SceneFile {
        name: "two-million-triangles",
        title: "a displaced sphere of 2 million triangles, sky and a lamp",
        detail: [150, 150],
        needs: &["sky.exr", "sky-square.exr", "displaced-sphere.ply"],
    },
];

impl SceneFile {
    /// The scene in both forms, [prepared](Self::prepare), with these metals.
    pub(crate) fn scene(&self, root: &Path, folder: &Path, metals: Metals) -> Result<Scene> {
        let own = self.prepare(root, folder)?;
        let name = metals.name_of(self.name);
        let file = folder.join(format!("{name}.xml"));
        if metals != Metals::Own {
            for extension in ["pbrt", "xml"] {
                let text = fs::read_to_string(own.with_extension(extension))?;
                fs::write(file.with_extension(extension), metals.replace_in(&text))?;
            }
        }
        Ok(Scene {
            name,
            title: metals.title_of(self.title),
            metals,
            detail: Some(self.detail),
            pbrt: Some(file.with_extension("pbrt")),
            mitsuba: Some(file),
        })
    }

    /// Copies the scene into `folder`, makes what it needs there, and returns its file in Mitsuba's
    /// form; the other lies beside it, its extension `pbrt`.
    pub(crate) fn prepare(&self, root: &Path, folder: &Path) -> Result<PathBuf> {
        fs::create_dir_all(folder)?;
        for extension in ["pbrt", "xml"] {
            let name = format!("{}.{extension}", self.name);
            fs::copy(root.join("data/versus").join(&name), folder.join(&name))?;
        }
        for need in self.needs {
            let path = folder.join(need);
            if path.exists() {
                continue;
            }
            match *need {
                "sky.exr" => sky::write(&path, 1024, None)?,
                "sky-square.exr" => sky::write_square(&path, 512, None)?,
                "sky-sun.exr" => sky::write(&path, 2048, Some(Sun::LOW))?,
                "sky-sun-square.exr" => sky::write_square(&path, 2048, Some(Sun::LOW))?,
                _ => mesh::write_displaced_sphere(&path, 1000, 1001)?,
            }
        }
        Ok(folder.join(format!("{}.xml", self.name)))
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use std::sync::atomic::AtomicBool;

    use specula_bsdf::ndf::Masking;
    use specula_render::{PreparedScene, RenderOptions, Renderer};
    use specula_scene::scene::MaterialKind;
    use specula_stat::z_test::{equal_means, sidak};

    use super::*;
    use crate::workspace;

    /// A scene without files.
    pub(crate) fn scene() -> Scene {
        Scene {
            name: SCENES[0].name.to_owned(),
            title: SCENES[0].title.to_owned(),
            metals: Metals::Own,
            detail: None,
            mitsuba: None,
            pbrt: None,
        }
    }

    fn scratch(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("versus-{name}-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        folder
    }

    #[test]
    fn scenes_load_without_warnings() {
        let folder = scratch("scenes");
        for scene in &SCENES {
            let files = (scene.scene(&workspace::root(), &folder, Metals::Own)).unwrap();
            for file in files.mitsuba.iter().chain(&files.pbrt) {
                let loaded = specula_scene::load(file).unwrap();
                assert!(
                    loaded.warnings.is_empty(),
                    "{}: {:?}",
                    scene.name,
                    loaded.warnings
                );
                let film = &loaded.scene.film;
                assert_eq!(film.resolution, [512, 512], "{}", scene.name);
                assert!(matches!(
                    film.filter,
                    specula_scene::scene::Filter::Box { radius: [0.5, 0.5] }
                ));
            }
        }
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn files_of_a_user_have_the_form_of_their_extension() {
        let folder = scratch("files");
        let file = |name: &str, text: &str| {
            let path = folder.join(name);
            fs::write(&path, text).unwrap();
            path
        };
        let xml = Scene::of_file(&file("a room.xml", "<scene/>")).unwrap();
        assert_eq!((xml.name.as_str(), xml.pbrt.is_none()), ("a-room", true));
        let pbrt = Scene::of_file(&file("room.pbrt", "WorldBegin")).unwrap();
        assert!(pbrt.mitsuba.is_none() && pbrt.pbrt.is_some());
        assert_ne!(xml.key().unwrap(), pbrt.key().unwrap());
        let refused = |path: &Path| Scene::of_file(path).err().unwrap().to_string();
        assert!(refused(&file("room.glb", "")).ends_with("expected a file .xml or .pbrt"));
        assert!(refused(&folder.join("missing.xml")).contains("missing.xml: "));
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn pbrt_does_not_write_half_precision() {
        // What it does where the file does not say it.
        for scene in &SCENES {
            let file = workspace::root().join(format!("data/versus/{}.pbrt", scene.name));
            let text = fs::read_to_string(file).unwrap();
            let film = text.lines().find(|l| l.starts_with("Film ")).unwrap();
            assert!(film.contains(r#""bool savefp16" false"#), "{film}");
        }
    }

    /// Means of tiles and their variances, and the mean of all.
    struct Tiles {
        tiles: Vec<(f64, f64)>,
        mean: f64,
    }

    const SIDE: u32 = 48;
    const TILE: u32 = 8;

    /// A render with height-correlated masking, which only one of the two formats has.
    fn tiles(file: &Path, seed: u32) -> Tiles {
        let mut scene = specula_scene::load(file).unwrap().scene;
        for material in &mut scene.materials {
            if let MaterialKind::Conductor { roughness, .. }
            | MaterialKind::Dielectric { roughness, .. } = &mut material.kind
            {
                roughness.masking = Masking::HeightCorrelated;
            }
        }
        let options = RenderOptions {
            resolution: Some([SIDE; 2]),
            seed,
            ..RenderOptions::from_scene(&scene)
        };
        let prepared = PreparedScene::consume(scene, &options).unwrap();
        let mut renderer = Renderer::new(&prepared, options);
        renderer.render_pass(64, &AtomicBool::new(false));
        let picture = renderer.film().picture();
        let per_row = SIDE / TILE;
        let mut tiles = vec![(0.0, 0.0); (per_row * per_row) as usize];
        for (i, (colour, variance)) in (0..).zip(picture.colour.iter().zip(&picture.variance)) {
            let (x, y) = (i % SIDE, i / SIDE);
            let tile = &mut tiles[(y / TILE * per_row + x / TILE) as usize];
            let pixels = f64::from(TILE * TILE);
            tile.0 += f64::from(colour.g) / pixels;
            tile.1 += f64::from(variance.g) / (pixels * pixels);
        }
        let mean = tiles.iter().map(|t| t.0).sum::<f64>() / tiles.len() as f64;
        Tiles { tiles, mean }
    }

    /// What differs: the mean by 1 %, or a tile by more than chance.
    fn difference(a: &Tiles, b: &Tiles) -> Option<String> {
        let apart = (a.mean / b.mean - 1.0).abs();
        if apart > 0.01 {
            return Some(format!("means {} and {}", a.mean, b.mean));
        }
        let significance = sidak(1e-4, a.tiles.len());
        let pairs = a.tiles.iter().zip(&b.tiles).enumerate();
        pairs
            .filter(|(_, (a, b))| equal_means(**a, **b) < significance)
            .map(|(i, (a, b))| format!("tile {i}: {a:?} and {b:?}"))
            .next()
    }

    #[test]
    fn both_forms_of_a_scene_are_the_same_picture() {
        let folder = scratch("twins");
        for scene in &SCENES {
            let file = scene.prepare(&workspace::root(), &folder).unwrap();
            let a = tiles(&file, 1);
            let mut b = tiles(&file.with_extension("pbrt"), 2);
            assert_eq!(difference(&a, &b), None, "{}", scene.name);
            // A tile with a third more light, and a picture with two hundredths more.
            let brightest = |x: &&mut (f64, f64), y: &&mut (f64, f64)| x.0.total_cmp(&y.0);
            b.tiles.iter_mut().max_by(brightest).unwrap().0 *= 1.33;
            assert!(difference(&a, &b).is_some(), "{}", scene.name);
            let brighter = Tiles {
                mean: 1.02 * a.mean,
                tiles: a.tiles.clone(),
            };
            assert!(difference(&a, &brighter).is_some(), "{}", scene.name);
        }
        fs::remove_dir_all(folder).unwrap();
    }
}
