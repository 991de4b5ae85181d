//! Files that do not exist: all of them in one error, or stand-ins and warnings.

use specula_scene::scene::{ColourParam, MaterialKind, Texture};
use specula_scene::{
    CheckReport, ErrorKind, LoadOptions, Missing, SceneError, Severity, check, load_with,
};

use super::common::{Folder, warnings};

const SCENE: &str = r#"Camera "perspective"
WorldBegin
Texture "a" "spectrum" "imagemap" "string filename" "a.png"
Texture "b" "spectrum" "imagemap" "string filename" "a.png"
Texture "h" "float" "imagemap" "string filename" "alpha.png"
Include "materials.pbrt"
Material "diffuse" "texture reflectance" "a" "string normalmap" "normal.png"
Shape "sphere" "texture alpha" "h"
NamedMaterial "elsewhere"
Shape "plymesh" "string filename" "b.ply"
Shape "plymesh" "string filename" "b.ply"
Material "conductor" "spectrum eta" "n.spd" "spectrum k" "k.spd"
Shape "disk"
"#;

fn standing_in() -> LoadOptions {
    let mut options = LoadOptions::default();
    options.missing = Missing::StandIn;
    options
}

fn lines(error: &SceneError) -> Vec<(String, usize)> {
    let name = |path: &std::path::Path| path.file_name().unwrap().to_string_lossy().into_owned();
    error
        .missing()
        .iter()
        .map(|f| (name(f.path()), f.place().line()))
        .collect()
}

#[test]
fn one_error_names_all_with_their_places() {
    let folder = Folder::new();
    let error = folder.load(SCENE).unwrap_err();
    let expected = [
        ("materials.pbrt", 6),
        ("a.png", 3),
        ("alpha.png", 5),
        ("normal.png", 7),
        ("n.spd", 12),
        ("k.spd", 12),
        ("b.ply", 10),
    ];
    let mut found = lines(&error);
    found.sort();
    let mut wanted = expected.map(|(name, line)| (name.to_owned(), line));
    wanted.sort();
    assert_eq!(found, wanted);
    let message = error.message();
    assert!(
        message.starts_with("7 files that the scene names are missing:"),
        "{message}"
    );
    for (name, line) in expected {
        let at = format!("scene.pbrt:{line}:");
        assert!(
            message.lines().any(|l| l.contains(name) && l.contains(&at)),
            "{name}: {message}"
        );
    }
    let help = error.help().unwrap();
    assert!(
        help.contains("--search FOLDER") && help.contains("--missing stand-in"),
        "{help}"
    );
}

#[test]
fn one_missing_file_has_an_error_of_its_own() {
    let folder = Folder::new();
    let error = folder
        .load("WorldBegin Shape \"sphere\"\nShape \"plymesh\" \"string filename\" \"b.ply\"")
        .unwrap_err();
    assert_eq!((error.kind(), error.line()), (ErrorKind::Mesh, 2));
    assert_eq!(lines(&error), [("b.ply".to_owned(), 2)]);
    assert!(error.message().contains("cannot be read"), "{error}");
    // A file that is there and broken is another matter.
    folder.write("b.ply", "ply\n");
    let error = folder
        .load("WorldBegin\nShape \"plymesh\" \"string filename\" \"b.ply\"")
        .unwrap_err();
    assert!(error.missing().is_empty());
    // So is the scene itself.
    let error =
        specula_scene::load_with(&folder.path().join("none.pbrt"), &standing_in()).unwrap_err();
    assert!(
        error.missing().is_empty() && error.kind() == ErrorKind::Io,
        "{error}"
    );
}

#[test]
fn stand_ins_make_a_scene() {
    let folder = Folder::new();
    let path = folder.write("scene.pbrt", SCENE);
    let loaded = load_with(&path, &standing_in()).unwrap();
    assert!(loaded.scene.validate().is_ok());
    assert_eq!(loaded.scene.shapes.len(), 2, "the sphere and the disk");
    assert_eq!(loaded.missing.len(), 7);
    let said = warnings(&loaded);
    let about = |part: &str| said.iter().filter(|w| w.contains(part)).count();
    assert_eq!(
        about("is missing: a grey checker stands in for it"),
        3,
        "{said:#?}"
    );
    assert_eq!(about("b.ply is missing: its shapes are left out"), 1);
    assert_eq!(
        about("materials.pbrt is missing: what it holds is left out"),
        1
    );
    assert_eq!(about("is missing: the default stands in for it"), 2);
    assert_eq!(
        about("no material \"elsewhere\" is defined: a missing file may have it"),
        1
    );
    let sphere = &loaded.scene.shapes[0];
    let material = &loaded.scene.materials[sphere.material.0];
    assert_eq!(material.bump, None, "a checker is no normal map");
    assert!(matches!(
        sphere.alpha,
        specula_scene::scene::FloatParam::Value(1.0)
    ));
    let MaterialKind::Diffuse {
        reflectance: ColourParam::Texture(id),
        ..
    } = material.kind
    else {
        panic!("{:?}", material.kind)
    };
    let Texture::Image { image, .. } = loaded.scene.textures[id.0] else {
        panic!("{:?}", loaded.scene.textures[id.0])
    };
    let checker = &loaded.scene.images[image.0].pixels;
    assert_eq!((checker.rgb(0), checker.rgb(8)), ([0.25; 3], [0.5; 3]));
}

fn counts(report: &CheckReport) -> [usize; 2] {
    [Severity::Error, Severity::Warning].map(|s| report.count(s))
}

#[test]
fn a_check_lists_them_as_errors_or_as_warnings() {
    let folder = Folder::new();
    let path = folder.write("scene.pbrt", SCENE);
    let report = check(&path, &LoadOptions::default());
    // The name that is defined nowhere is one more.
    assert_eq!(report.count(Severity::Error), 8, "{:#?}", report.problems());
    let report = check(&path, &standing_in());
    assert_eq!(counts(&report)[0], 0, "{:#?}", report.problems());
    assert!(counts(&report)[1] >= 8);
    // A scene that is wrong beside has its error, and the warnings.
    let path = folder.write("scene.pbrt", SCENE.replace("\"disk\"", "\"dish\""));
    let report = check(&path, &standing_in());
    assert_eq!(counts(&report)[0], 1, "{:#?}", report.problems());
    assert!(counts(&report)[1] >= 8);
}

#[test]
fn a_name_that_is_wrong_stays_an_error_where_no_include_is_missing() {
    let folder = Folder::new();
    let text = "WorldBegin\nTexture \"a\" \"spectrum\" \"imagemap\" \"string filename\" \"a.png\"\n\
                NamedMaterial \"none\" Shape \"sphere\"";
    let error = load_with(&folder.write("scene.pbrt", text), &standing_in()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::UnknownName);
}

#[test]
fn files_of_gltf() {
    let folder = Folder::new();
    let path = folder.write(
        "a.gltf",
        r#"{"asset": {"version": "2.0"}, "scenes": [{"nodes": [0, 1]}], "nodes": [{"mesh": 0}, {"mesh": 1}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]},
{"primitives": [{"attributes": {"POSITION": 1, "NORMAL": 1}}]}],
"materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "normalTexture": {"index": 0}}],
"textures": [{"source": 0}], "images": [{"uri": "a.png"}],
"buffers": [{"byteLength": 36, "uri": "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"},
{"byteLength": 36, "uri": "b.bin"}],
"bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 1, "byteLength": 36}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0],
"max": [1, 1, 0]}, {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0],
"max": [1, 1, 0]}]}"#,
    );
    let error = specula_scene::load(&path).unwrap_err();
    assert_eq!(
        lines(&error),
        [("a.png".to_owned(), 5), ("b.bin".to_owned(), 7)]
    );
    let loaded = load_with(&path, &standing_in()).unwrap();
    assert_eq!(loaded.missing.len(), 2);
    assert_eq!(loaded.scene.meshes.len(), 1);
    assert!(loaded.scene.validate().is_ok());
}

#[test]
fn a_missing_lens_leaves_a_camera() {
    let folder = Folder::new();
    let text = "LookAt 0 -4 0 0 0 0 0 0 1 Camera \"realistic\" \"string lensfile\" \"lens.dat\"\n\
                WorldBegin Shape \"sphere\"";
    let path = folder.write("scene.pbrt", text);
    assert_eq!(
        lines(&specula_scene::load(&path).unwrap_err()),
        [("lens.dat".to_owned(), 1)]
    );
    let loaded = load_with(&path, &standing_in()).unwrap();
    let perspective = specula_scene::scene::Projection::Perspective { fov_deg: 90.0 };
    assert_eq!(loaded.scene.camera.projection, perspective);
}
