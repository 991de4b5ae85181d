//! All problems of pbrt scenes, glTF files and meshes in one run.

use std::path::Path;

use specula_scene::{CheckReport, LoadOptions, Severity};

use super::common::Folder;
use super::report::{self, found};

fn check(folder: &Folder, scene: &str) -> CheckReport {
    let path = folder.write("scene.pbrt", scene);
    specula_scene::check(&path, &LoadOptions::default())
}

#[track_caller]
fn expect_errors(folder: &Folder, scene: &str, expected: &[(usize, &str)]) {
    let load = folder.load(scene).unwrap_err();
    report::expect_errors(&check(folder, scene), &load, expected);
}

#[test]
fn one_run_finds_every_kind_of_mistake() {
    let folder = Folder::new();
    folder.write("bad.ply", "ply\nformat ascii 1.0\nelement vertex 3\n");
    let scene = "Camera \"perspective\" \"float fov\" 200
Sampler \"nosuch\"
Film \"rgb\" \"integer xresolution\" -4 \"flaot iso\" 100
WorldBegin
Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"missing.png\"
Texture \"u\" \"spectrum\" \"nosuch\"
MakeNamedMaterial \"m\" \"string type\" \"diffuse\" \"texture reflectance\" \"absent\"
MakeNamedMaterial \"n\" \"string type\" \"conductor\" \"float roughness\" -1 \"rgb reflectance\" [1 1]
Translate 1 2 Shape \"sphere\" \"float radius\" -1
Shpae \"plymesh\" \"string filename\" \"missing.ply\"
NamedMaterial \"nobody\"
Shape \"plymesh\" \"string filename\" \"bad.ply\"
Shape \"sphere\" \"texture alpha\" \"t\"
Material \"conductor\" \"spectrum eta\" \"nothing.spd\" \"spectrum k\" [400 1 300]
LightSource \"spot\" \"float coneangle\" 300
Shape \"sphere
Rotate 1 0 0 0
AttributeEnd
ObjectInstance \"ghost\"
LightSource \"infinite\" \"string filename\" \"missing.exr\"
Include \"missing.pbrt\"
AttributeBegin
Shape \"nosuch\"
";
    expect_errors(
        &folder,
        scene,
        &[
            (1, "\"fov\""),
            (2, "unknown sampler"),
            (3, "\"xresolution\""),
            (3, "unknown parameter type `flaot`"),
            (5, "missing.png"),
            (6, "unknown class"),
            (7, "no spectrum texture \"absent\""),
            (8, "\"roughness\""),
            (8, "multiple of 3"),
            (9, "number 3 of 3"),
            (9, "\"radius\""),
            (10, "unknown directive `Shpae`"),
            (10, "missing.ply"),
            (11, "no material \"nobody\""),
            (12, "bad.ply"),
            (13, "no float texture \"t\""),
            (14, "nothing.spd"),
            (14, "pairs of wavelength"),
            (15, "\"coneangle\""),
            (16, "not closed on its line"),
            (17, "axis of rotation"),
            (18, "`AttributeEnd` without"),
            (19, "no object \"ghost\""),
            (20, "missing.exr"),
            (21, "missing.pbrt"),
            (22, "never closed"),
            (23, "unknown shape"),
        ],
    );
}

#[test]
fn what_follows_from_a_mistake_is_not_reported() {
    let folder = Folder::new();
    // A texture, a material and a named object with mistakes, each used twice.
    expect_errors(
        &folder,
        "WorldBegin
Texture \"t\" \"spectrum\" \"imagemap\" \"strin filename\" \"a.png\"
Texture \"s\" \"spectrum\" \"scale\" \"texture tex\" \"t\"
MakeNamedMaterial \"m\" \"string type\" \"nosuch\"
MakeNamedMaterial \"x\" \"string type\" \"mix\" \"string materials\" [\"m\" \"m\"]
NamedMaterial \"x\" Shape \"sphere\"
ObjectBegin \"o\" Shape \"plymesh\" ObjectEnd
ObjectInstance \"o\" ObjectInstance \"o\"
",
        &[(2, "strin"), (4, "unknown material"), (7, "needs its")],
    );
    // Without `WorldBegin` one error is enough.
    let scene = "Shape \"sphere\"\nMaterial \"diffuse\"\nShape \"disk\"\n";
    expect_errors(&folder, scene, &[(1, "before `WorldBegin`")]);
    // A block that is not closed takes no other with it.
    let scene = "WorldBegin\nAttributeBegin\nObjectBegin \"o\"\nShape \"sphere\"\nAttributeEnd
ObjectInstance \"o\"\n";
    expect_errors(&folder, scene, &[(5, "does not close `ObjectBegin`")]);
}

#[test]
fn a_report_lists_a_hundred_errors_and_counts_the_rest() {
    let folder = Folder::new();
    let scene = "WorldBegin\n".to_owned() + &"Shape \"nosuch\"\n".repeat(130);
    let report = check(&folder, &scene);
    assert_eq!(found(&report, Severity::Error).len(), 100);
    assert_eq!(report.count(Severity::Error), 130);
    assert_eq!(report.unlisted(Severity::Error), 30);
}

#[test]
fn warnings_are_counted_and_what_is_unused_is_noted() {
    let folder = Folder::new();
    let report = check(
        &folder,
        "WorldBegin
Texture \"t\" \"spectrum\" \"constant\"
Texture \"u\" \"float\" \"constant\"
MakeNamedMaterial \"m\" \"string type\" \"diffuse\" \"texture reflectance\" \"t\"
Material \"diffuse\"
Material \"subsurface\"
LightSource \"point\" \"rgb I\" [0 0 0]
Shape \"sphere\" \"float wrong\" 1
Shape \"sphere\" \"float wrong\" 1
Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 2 0 0] \"integer indices\" [0 1 2 0 1 3]
",
    );
    assert_eq!(report.count(Severity::Error), 0);
    let warnings = found(&report, Severity::Warning);
    let unused: Vec<_> = (report.problems().iter())
        .filter(|p| p.message().contains("wrong"))
        .collect();
    assert_eq!(unused.len(), 1, "{warnings:?}");
    assert_eq!((unused[0].count(), unused[0].place().line()), (2, 8));
    let has = |line: usize, word: &str| {
        let hit = |w: &(usize, String)| w.0 == line && w.1.contains(word);
        warnings.iter().any(hit)
    };
    assert!(has(6, "subsurface"), "{warnings:?}");
    assert!(has(10, "1 triangles without area"), "{warnings:?}");
    let notes: Vec<(usize, &str)> = (report.problems().iter())
        .filter(|p| p.severity() == Severity::Note)
        .map(|p| (p.place().line(), p.kind()))
        .collect();
    let expected = [(3, "unused"), (4, "unused"), (5, "unused"), (7, "dark")];
    assert_eq!(notes, expected);
}

/// A triangle three times: with a missing picture, with an index out of range, with no picture.
const GLTF: &str = r#"{"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
"meshes": [{"primitives": [
{"attributes": {"POSITION": 0}, "material": 0},
{"attributes": {"POSITION": 0}, "indices": 1},
{"attributes": {"POSITION": 0}, "material": 1}]}],
"materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}},
{"pbrMetallicRoughness": {"baseColorTexture": {"index": 1}}}],
"textures": [{"source": 0}, {"source": 1}],
"images": [{"uri": "missing.png"},
{"uri": "data:image/png;base64,AAAA"}],
"buffers": [{"byteLength": 39, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAEJ"}],
"bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 3}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0],
"max": [1, 1, 0]}, {"bufferView": 1, "componentType": 5121, "count": 3, "type": "SCALAR"}]}"#;

#[test]
fn every_mistake_of_a_gltf_file_is_located() {
    let folder = Folder::new();
    let path = folder.write("a.gltf", GLTF);
    let report = specula_scene::check(&path, &LoadOptions::default());
    let errors = found(&report, Severity::Error);
    let lines: Vec<usize> = errors.iter().map(|e| e.0).collect();
    assert_eq!(lines, [4, 9, 10], "{errors:#?}");
    let first = specula_scene::load(&path).unwrap_err();
    assert_eq!((first.line(), first.message()), (9, errors[1].1.as_str()));
}

#[test]
fn meshes_alone_are_checked() {
    let folder = Folder::new();
    let path = folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
    let report = specula_scene::check(&path, &LoadOptions::default());
    assert_eq!(report.count(Severity::Error), 1);
    let path = folder.write("b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 2\n");
    let report = specula_scene::check(&path, &LoadOptions::default());
    assert_eq!(report.count(Severity::Error), 0);
    let warnings = found(&report, Severity::Warning);
    let has = |word: &str| warnings.iter().any(|w| w.1.contains(word));
    assert!(has("1 triangles without area"), "{warnings:?}");
}

#[test]
fn missing_scenes_are_reports_too() {
    for name in ["a.pbrt", "a.xml", "a.gltf", "a.obj", "a.ply"] {
        let report = specula_scene::check(Path::new(name), &LoadOptions::default());
        assert_eq!(report.count(Severity::Error), 1, "{name}");
    }
}

#[test]
fn files_are_looked_for_in_more_folders() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path().join("more")).unwrap();
    folder.write(
        "more/a.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
         property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
         0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
    );
    folder.write("more/b.pbrt", "Shape \"sphere\"");
    let path = folder.write(
        "scene.pbrt",
        "WorldBegin\nShape \"plymesh\" \"string filename\" \"/old/place/a.ply\"\nInclude \"b.pbrt\"\n",
    );
    let error = specula_scene::load(&path).unwrap_err();
    let help = error.help().unwrap_or_default();
    assert!(help.contains("--search"), "{error}: {help}");
    let mut options = LoadOptions::default();
    options.folders = vec![folder.path().join("more")];
    let loaded = specula_scene::load_with(&path, &options).unwrap();
    assert_eq!(loaded.scene.shapes.len(), 2);
}

#[test]
fn crossed_limits_name_their_option() {
    let folder = Folder::new();
    let path = folder.write(
        "scene.pbrt",
        "WorldBegin\nAttributeBegin AttributeBegin\nAreaLightSource \"diffuse\"\nShape \"curve\" \"point3 P\" [0 0 0 1 0 0 1 1 0 2 2 1]\n",
    );
    for (change, option) in [
        ("depth", "--limit-nesting"),
        ("bytes", "--limit-bytes"),
        ("vertices", "--limit-vertices"),
    ] {
        let mut options = LoadOptions::default();
        match change {
            "depth" => options.limits.max_depth = 0,
            "bytes" => options.limits.max_bytes = 9,
            _ => options.limits.max_vertices = 9,
        }
        let report = specula_scene::check(&path, &options);
        let named = |p: &specula_scene::Problem| p.help().is_some_and(|h| h.contains(option));
        assert!(report.problems().iter().any(named), "{option}: {report:?}");
    }
}
