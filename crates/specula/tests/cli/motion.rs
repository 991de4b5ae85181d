//! What moves: the moment and the shutter of a render, and what `info` says of them.

use std::path::Path;

use crate::common::{run, specula, stderr, succeed};

/// A sphere and a camera that move, and an instance that stands still.
const MOVING: &str = r#"
LookAt 0 -4 1  0 0 0  0 0 1
ActiveTransform EndTime Translate 0.2 0 0 ActiveTransform All
Camera "perspective" "float fov" 40 "float shutteropen" 0 "float shutterclose" 1
Film "rgb" "integer xresolution" 24 "integer yresolution" 16
WorldBegin
LightSource "infinite" "rgb L" [0.7 0.8 1.0]
AttributeBegin
ActiveTransform EndTime Translate 1 0 0 ActiveTransform All
Shape "sphere" "float radius" 0.5
AttributeEnd
ObjectBegin "o"
Shape "sphere" "float radius" 0.2
ObjectEnd
ObjectInstance "o"
"#;

/// Writes a glTF file whose only triangle moves by 1 along x within two seconds.
fn write_animated(folder: &Path) {
    let numbers: [f32; 17] = [
        -0.5, -0.5, 0.0, 0.5, -0.5, 0.0, 0.0, 0.5, 0.0, // corners
        0.0, 2.0, // times
        0.0, 0.0, 0.0, 1.0, 0.0, 0.0, // translations
    ];
    let data: Vec<u8> = numbers.iter().flat_map(|x| x.to_le_bytes()).collect();
    std::fs::write(folder.join("a.bin"), data).unwrap();
    let text = r#"{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
"nodes": [{"mesh": 0}, {"camera": 0, "translation": [0, 0, 3]}],
"cameras": [{"type": "perspective", "perspective": {"yfov": 1, "aspectRatio": 1, "znear": 0.1}}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
"buffers": [{"byteLength": 68, "uri": "a.bin"}],
"bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 8},
 {"buffer": 0, "byteOffset": 44, "byteLength": 24}],
"accessors": [
 {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [-0.5, -0.5, 0], "max": [0.5, 0.5, 0]},
 {"bufferView": 1, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [2]},
 {"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3"}],
"animations": [{"channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],
 "samplers": [{"input": 1, "output": 2}]}]}"#;
    std::fs::write(folder.join("a.gltf"), text).unwrap();
}

/// Renders the animated file; returns the difference between the pictures of two sets of options.
fn differ(folder: &Path, options: [&[&str]; 2]) -> bool {
    for (k, options) in options.into_iter().enumerate() {
        let name = format!("{k}.exr");
        let render = [
            "render",
            "a.gltf",
            "--spp",
            "4",
            "--resolution",
            "16x16",
            "-o",
            &name,
        ];
        succeed(folder, &[&render, options].concat());
    }
    let compare = [
        "compare",
        "0.exr",
        "1.exr",
        "--metric",
        "mae",
        "--fail-above",
        "0",
    ];
    run(folder, &compare).0 != Some(0)
}

/// What `info` prints.
fn info(folder: &Path, arguments: &[&str]) -> String {
    let output = specula(folder)
        .arg("info")
        .args(arguments)
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn info_says_what_moves() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("a.pbrt"), MOVING).unwrap();
    write_animated(folder);
    let said = info(folder, &["a.pbrt"]);
    assert!(said.contains("motion    1 shape, the camera\n"), "{said}");
    let said = info(folder, &["a.gltf"]);
    assert!(said.contains("1 node moves within 2.000 s"), "{said}");
    assert!(!said.contains("\n  motion"), "{said}");
    let said = info(folder, &["a.gltf", "--at", "0.5", "--shutter", "1s"]);
    assert!(said.contains("motion    1 shape\n"), "{said}");
}

#[test]
fn animations_are_rendered_at_a_moment_and_over_a_time() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    write_animated(folder);
    assert!(differ(folder, [&["--at", "0"], &["--at", "2"]]));
    assert!(!differ(folder, [&["--at", "1"], &["--frame", "24"]]));
    assert!(!differ(
        folder,
        [&["--at", "1"], &["--frame", "12", "--fps", "12"]]
    ));
    assert!(differ(
        folder,
        [&["--at", "1"], &["--at", "1", "--shutter", "500ms"]]
    ));
    // Nothing moves afterwards.
    assert!(!differ(
        folder,
        [&["--at", "2"], &["--at", "3", "--shutter", "1s"]]
    ));
}

#[test]
fn moments_that_are_none_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    write_animated(folder);
    for options in [
        &["--at", "-1"][..],
        &["--at", "soon"],
        &["--shutter", "-2s"],
        &["--at", "1", "--frame", "3"],
        &["--frame", "3", "--fps", "0"],
    ] {
        let (code, said) = run(
            folder,
            &[&["render", "a.gltf", "-o", "no.exr"], options].concat(),
        );
        assert_eq!(code, Some(2), "{options:?}: {said}");
        assert!(!folder.join("no.exr").exists());
    }
}
