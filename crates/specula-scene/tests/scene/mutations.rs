//! Damaged scenes: whatever happens to the text, the answer is a valid scene or an error.

use std::path::Path;

use specula_scene::{Limits, LoadOptions, Loaded, SceneError, Severity};

use super::common::Folder;

/// Loads a scene and checks it: the two must agree.
fn load_and_check(path: &Path, limits: Limits) -> Result<Loaded, SceneError> {
    let options = LoadOptions::from(limits);
    let loaded = specula_scene::load_with(path, &options);
    let report = specula_scene::check(path, &options);
    let errors = report.count(Severity::Error);
    match &loaded {
        Ok(_) => assert_eq!(errors, 0, "{:?}", report.problems()),
        Err(error) => {
            let is_known = report.problems().iter().any(|p| {
                p.message() == error.message() && p.place().offset() == error.place().offset()
            });
            assert!(is_known || errors > 100, "{error}: {report:?}");
        }
    }
    loaded
}

const SCENE: &str = "LookAt 0 1 -5  0 0 0  0 1 0
Camera \"perspective\" \"float fov\" [ 45 ] \"float lensradius\" 0.01
Film \"rgb\" \"integer xresolution\" [ 64 ] \"integer yresolution\" [ 48 ] \"float cropwindow\" [0 1 0.2 0.8]
Sampler \"zsobol\" \"integer pixelsamples\" 4 Integrator \"path\" \"integer maxdepth\" 3
PixelFilter \"gaussian\" \"float xradius\" 1.5
WorldBegin
# a comment
LightSource \"spot\" \"point3 from\" [0 4 0] \"point3 to\" [0 0 0] \"float coneangle\" 40 \"float power\" 3
LightSource \"infinite\" \"blackbody L\" 5000 \"float scale\" 0.5
Texture \"c\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [.1 .2 .3] \"float uscale\" 20
MakeNamedMaterial \"m\" \"string type\" \"coatedconductor\" \"float conductor.roughness\" 0.1
MakeNamedMaterial \"d\" \"string type\" \"diffuse\" \"texture reflectance\" \"c\"
MakeNamedMaterial \"x\" \"string type\" \"mix\" \"string materials\" [\"m\" \"d\"] \"float amount\" .3
AttributeBegin
  Translate 1 0 0 Rotate 30 0 1 0 Scale 1 -2 1
  AreaLightSource \"diffuse\" \"spectrum L\" [400 1 500 2 700 1] \"bool twosided\" true
  NamedMaterial \"x\" Shape \"sphere\" \"float radius\" 0.5
AttributeEnd
ObjectBegin \"o\" Transform [1 0 0 0 0 1 0 0 0 0 1 0 0 0 2 1]
  Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 1] \"integer indices\" [0 1 2 2 1 3] \"point2 uv\" [0 0 1 0 0 1 1 1]
ObjectEnd
ObjectInstance \"o\" ReverseOrientation Shape \"plymesh\" \"string filename\" \"a.ply\"
";

const PLY: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
    element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

/// SplitMix64.
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % n as u64) as usize
    }

    fn mutate(&mut self, text: &[u8]) -> Vec<u8> {
        const TOKENS: [&str; 14] = [
            "nan",
            "-1",
            "0",
            "1e38",
            "1e-38",
            "[",
            "]",
            "\"",
            "99999999999",
            "Include",
            "AttributeEnd",
            "\"x\"",
            "#",
            "-1e30",
        ];
        let mut bytes = text.to_vec();
        for _ in 0..=self.below(2) {
            let at = self.below(bytes.len());
            match self.below(10) {
                0 => bytes[at] = self.below(256) as u8,
                1..=3 => bytes[at] = 32 + self.below(95) as u8,
                4 => bytes.truncate(at.max(1)),
                5 => {
                    let to = (at + self.below(40)).min(bytes.len());
                    bytes.drain(at..to);
                    if bytes.is_empty() {
                        bytes.push(b' ');
                    }
                }
                6 => {
                    let to = (at + self.below(40)).min(bytes.len());
                    let copy = bytes[at..to].to_vec();
                    let into = self.below(bytes.len());
                    bytes.splice(into..into, copy);
                }
                _ => {
                    // A whole word becomes another.
                    let blank = |b: &u8| b.is_ascii_whitespace();
                    let start = bytes[..at].iter().rposition(blank).map_or(0, |i| i + 1);
                    let end = bytes[at..]
                        .iter()
                        .position(blank)
                        .map_or(bytes.len(), |i| at + i);
                    let token = TOKENS[self.below(TOKENS.len())];
                    bytes.splice(start..end.max(start), token.bytes());
                }
            }
        }
        bytes
    }
}

fn run(mutated: &str, seed: u64, cases: usize) -> (usize, usize) {
    let folder = Folder::new();
    folder.write("a.ply", PLY);
    let mut random = Random(seed);
    let (mut whole, mut broken) = (0, 0);
    for case in 0..cases {
        let path = if mutated == "scene" {
            folder.write("scene.pbrt", random.mutate(SCENE.as_bytes()))
        } else {
            folder.write("a.ply", random.mutate(PLY.as_bytes()));
            folder.write("scene.pbrt", SCENE)
        };
        // Checks take as long again.
        let result = match case % 4 {
            0 => load_and_check(&path, Limits::default()),
            _ => specula_scene::load(&path),
        };
        match result {
            Ok(loaded) => {
                loaded
                    .scene
                    .validate()
                    .unwrap_or_else(|e| panic!("case {case}: {e}"));
                whole += 1;
            }
            Err(error) => {
                assert!(error.line() >= 1 && error.column() >= 1 && !error.message().is_empty());
                broken += 1;
            }
        }
    }
    (whole, broken)
}

#[test]
fn the_scene_itself_is_whole() {
    let folder = Folder::new();
    folder.write("a.ply", PLY);
    let loaded = folder.load(SCENE).unwrap();
    assert_eq!(loaded.scene.shapes.len(), 2);
    assert_eq!(super::common::warnings(&loaded), [""; 0]);
}

#[test]
fn damaged_scenes() {
    let (whole, broken) = run("scene", 1, 2000);
    assert!(whole > 50 && broken > 500, "{whole} whole, {broken} broken");
}

#[test]
fn damaged_meshes() {
    let (whole, broken) = run("mesh", 2, 1000);
    assert!(whole > 5 && broken > 200, "{whole} whole, {broken} broken");
}

/// Files to begin with, which fuzzing uses as well.
fn seeds(reader: &str) -> Vec<(String, Vec<u8>)> {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/seeds")
        .join(reader);
    let mut seeds: Vec<_> = std::fs::read_dir(&folder)
        .unwrap()
        .map(|entry| {
            let path = entry.unwrap().path();
            let name = path.file_name().unwrap().to_string_lossy().into_owned();
            (name, std::fs::read(&path).unwrap())
        })
        .collect();
    seeds.sort();
    assert!(!seeds.is_empty(), "the seeds of {reader} are there");
    seeds
}

/// Each seed whole, then damaged in `cases` ways; `load` is given its name and its bytes. Returns
/// how many of the damaged ones are errors.
fn damage(
    reader: &str,
    cases: usize,
    mut load: impl FnMut(&str, &[u8]) -> Result<Loaded, SceneError>,
) -> usize {
    let mut random = Random(3);
    let mut errors = 0;
    for (name, bytes) in seeds(reader) {
        load(&name, &bytes).unwrap_or_else(|e| panic!("{name}: {e}"));
        for case in 0..cases {
            match load(&name, &random.mutate(&bytes)) {
                Ok(loaded) => loaded
                    .scene
                    .validate()
                    .unwrap_or_else(|e| panic!("{name}, case {case}: {e}")),
                Err(error) => {
                    assert!(!error.message().is_empty());
                    errors += 1;
                }
            }
        }
    }
    errors
}

fn strict(folder: &Folder, scene: &str) -> Result<Loaded, SceneError> {
    specula_scene::load_with(&folder.write("scene.pbrt", scene), &Limits::strict().into())
}

#[test]
fn damaged_seeds_of_scenes() {
    let folder = Folder::new();
    let errors = damage("pbrt", 200, |_, bytes| {
        load_and_check(&folder.write("scene.pbrt", bytes), Limits::strict())
    });
    assert!(errors > 200, "{errors}");
}

#[test]
fn damaged_seeds_of_other_formats() {
    let mut random = Random(4);
    for (reader, fewest) in [("mitsuba", 50), ("gltf", 50), ("obj", 20)] {
        let folder = Folder::new();
        let mut errors = 0;
        for (name, bytes) in seeds(reader) {
            for _ in 0..100 {
                let path = folder.write(&name, random.mutate(&bytes));
                errors += usize::from(load_and_check(&path, Limits::strict()).is_err());
            }
        }
        assert!(errors > fewest, "{reader}: {errors}");
    }
}

#[test]
fn damaged_seeds_of_meshes() {
    let folder = Folder::new();
    let scene = "WorldBegin Shape \"plymesh\" \"string filename\" \"mesh.ply\"";
    let errors = damage("ply", 200, |_, bytes| {
        folder.write("mesh.ply", bytes);
        load_and_check(&folder.write("scene.pbrt", scene), Limits::strict())
    });
    assert!(errors > 200, "{errors}");
}

#[test]
fn damaged_seeds_of_measured_materials() {
    let folder = Folder::new();
    let scene = "WorldBegin Material \"measured\" \"string filename\" \"a.bsdf\" Shape \"sphere\"";
    let errors = damage("measured", 400, |_, bytes| {
        folder.write("a.bsdf", bytes);
        load_and_check(&folder.write("scene.pbrt", scene), Limits::strict())
    });
    assert!(errors > 40, "{errors}");
    // The header alone, where every byte counts.
    let mut random = Random(5);
    let (_, whole) = seeds("measured").remove(0);
    let mut errors = 0;
    for _ in 0..600 {
        let mut bytes = whole.clone();
        for _ in 0..=random.below(3) {
            let at = random.below(400);
            bytes[at] = random.below(256) as u8;
        }
        folder.write("a.bsdf", bytes);
        let loaded = load_and_check(&folder.write("scene.pbrt", scene), Limits::strict());
        errors += usize::from(loaded.is_err());
    }
    assert!(errors > 400, "{errors}");
}

#[test]
fn damaged_seeds_of_pictures() {
    let folder = Folder::new();
    let errors = damage("image", 100, |name, bytes| {
        // The first byte is for fuzzing: it chooses the format.
        folder.write(name, bytes.get(1..).unwrap_or_default());
        let texture = format!(
            "WorldBegin Texture \"t\" \"float\" \"imagemap\" \"string filename\" \"{name}\"
             LightSource \"infinite\" \"string filename\" \"{name}\" Shape \"sphere\""
        );
        strict(&folder, &texture)
    });
    assert!(errors > 100, "{errors}");
}

#[test]
fn limits_can_be_chosen() {
    let folder = Folder::new();
    let mut tight = Limits::strict();
    let path = folder.write("scene.pbrt", "WorldBegin Shape \"sphere\" \"float zmin\" 0");
    assert!(specula_scene::load_with(&path, &tight.into()).is_ok());
    tight.max_bytes = 10;
    let error = specula_scene::load_with(&path, &tight.into()).unwrap_err();
    assert!(error.message().contains("more than 10 bytes"), "{error}");
    let mut tight = Limits::strict();
    tight.max_pixels = 3;
    let (_, pfm) = seeds("image")
        .into_iter()
        .find(|s| s.0 == "rgb.pfm")
        .unwrap();
    folder.write("a.pfm", &pfm[1..]);
    let scene =
        "WorldBegin Shape \"sphere\" LightSource \"infinite\" \"string filename\" \"a.pfm\"";
    let path = folder.write("scene.pbrt", scene);
    let error = specula_scene::load_with(&path, &tight.into()).unwrap_err();
    assert!(error.message().contains("at most 3"), "{error}");
    tight.max_pixels = 4;
    assert!(specula_scene::load_with(&path, &tight.into()).is_ok());
    let blocks = "AttributeBegin ".repeat(3) + "Shape \"sphere\"" + &" AttributeEnd".repeat(3);
    assert!(strict(&folder, &format!("WorldBegin {blocks}")).is_ok());
    let blocks = "AttributeBegin ".repeat(300);
    let error = strict(&folder, &format!("WorldBegin {blocks}")).unwrap_err();
    assert!(error.message().contains("256 deep"), "{error}");
    let many: String = (0..1001)
        .map(|i| format!("Attribute \"shape\" \"float a{i}\" 1 "))
        .collect();
    let error = strict(&folder, &format!("WorldBegin {many}")).unwrap_err();
    assert!(error.message().contains("more than 1000"), "{error}");
}
