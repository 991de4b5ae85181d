//! The list of files that were read for a scene.

use std::io::Write;
use std::path::Path;

use specula_scene::{LoadOptions, load};

use super::common::Folder;

/// A small picture.
const PNG: &[u8] = include_bytes!("../mitsuba/grey.png");

const PLY: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                   element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

const OBJ: &str = "mtllib no.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

fn packed(text: &str) -> Vec<u8> {
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    encoder.write_all(text.as_bytes()).unwrap();
    encoder.finish().unwrap()
}

/// Holds the list of a load, and of a check, against names in the folder, in order.
#[track_caller]
fn expect(folder: &Folder, scene: &Path, expected: &[&str]) {
    let expected: Vec<_> = expected.iter().map(|n| folder.path().join(n)).collect();
    let loaded = load(scene).unwrap();
    assert_eq!(loaded.files, expected);
    let report = specula_scene::check(scene, &LoadOptions::default());
    assert_eq!(report.files(), expected);
}

#[test]
fn of_pbrt() {
    let folder = Folder::new();
    folder.write("more.pbrt.gz", packed("Include \"deep.pbrt\""));
    folder.write(
        "deep.pbrt",
        "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"b.png\"\n\
         Material \"conductor\" \"spectrum eta\" \"a.spd\" \"float roughness\" 0.1\n\
         Shape \"plymesh\" \"string filename\" \"z.ply\"\nShape \"plymesh\" \"string filename\" \"a.ply.gz\"\n",
    );
    folder.write("z.ply", PLY);
    folder.write("a.ply.gz", packed(PLY));
    folder.write("a.spd", "400 1\n700 1\n");
    for name in ["a.png", "b.png", "other.png"] {
        folder.write(name, PNG);
    }
    let scene = folder.write(
        "scene.pbrt",
        "WorldBegin\nInclude \"more.pbrt.gz\"\nInclude \"deep.pbrt2\"\n\
         Texture \"u\" \"spectrum\" \"imagemap\" \"string filename\" \"a.png\"\n\
         Texture \"v\" \"float\" \"imagemap\" \"string filename\" \"b.png\"\n",
    );
    folder.write(
        "deep.pbrt2",
        "Shape \"plymesh\" \"string filename\" \"z.ply\"\n",
    );
    let expected = [
        "scene.pbrt",
        "more.pbrt.gz",
        "deep.pbrt",
        "b.png",
        "deep.pbrt2",
        "a.png",
        "a.spd",
        "z.ply",
        "a.ply.gz",
    ];
    expect(&folder, &scene, &expected);
}

#[test]
fn of_mitsuba() {
    let folder = Folder::new();
    let seed = include_bytes!("../seeds/serialized/whole.serialized");
    folder.write("mesh.serialized", &seed[1..]);
    folder.write("mesh.obj", OBJ);
    folder.write("a.spd", "400 1\n700 1\n");
    folder.write("a.png", PNG);
    folder.write(
        "more.xml",
        "<scene version=\"3.0.0\"><shape type=\"serialized\"><string name=\"filename\" value=\"mesh.serialized\"/>\
         <bsdf type=\"diffuse\"><texture type=\"bitmap\" name=\"reflectance\">\
         <string name=\"filename\" value=\"a.png\"/></texture></bsdf></shape></scene>",
    );
    let scene = folder.write(
        "scene.xml",
        "<scene version=\"3.0.0\"><sensor type=\"perspective\"/><include filename=\"more.xml\"/>\
         <emitter type=\"constant\"><spectrum name=\"radiance\" filename=\"a.spd\"/></emitter>\
         <shape type=\"obj\"><string name=\"filename\" value=\"mesh.obj\"/></shape></scene>",
    );
    let expected = [
        "scene.xml",
        "more.xml",
        "a.spd",
        "a.png",
        "mesh.serialized",
        "mesh.obj",
    ];
    expect(&folder, &scene, &expected);
}

#[test]
fn of_gltf() {
    let folder = Folder::new();
    let corners = [[0.0_f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let bytes: Vec<u8> = corners
        .iter()
        .flatten()
        .flat_map(|x| x.to_le_bytes())
        .collect();
    folder.write("a b.bin", bytes);
    folder.write("a.png", PNG);
    let scene = folder.write(
        "scene.gltf",
        r#"{"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "materials": [{"emissiveTexture": {"index": 0}, "emissiveFactor": [1, 1, 1],
            "normalTexture": {"index": 0}}],
        "textures": [{"source": 0}], "images": [{"uri": "a.png"}],
        "buffers": [{"byteLength": 36, "uri": "a%20b.bin"}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
            "min": [0, 0, 0], "max": [1, 1, 0]}]}"#,
    );
    expect(&folder, &scene, &["scene.gltf", "a b.bin", "a.png"]);
}

#[test]
fn of_meshes_alone() {
    let folder = Folder::new();
    let scene = folder.write("mesh.obj", OBJ);
    expect(&folder, &scene, &["mesh.obj"]);
    let scene = folder.write("mesh.ply.gz", packed(PLY));
    expect(&folder, &scene, &["mesh.ply.gz"]);
}

#[test]
fn of_broken_scenes_up_to_where_reading_ends() {
    let folder = Folder::new();
    folder.write("a.png", PNG);
    let scene = folder.write(
        "scene.pbrt",
        "WorldBegin\nTexture \"t\" \"float\" \"imagemap\" \"string filename\" \"a.png\"\nShape \"none\"\n\
         Shape \"plymesh\" \"string filename\" \"missing.ply\"",
    );
    load(&scene).unwrap_err();
    let report = specula_scene::check(&scene, &LoadOptions::default());
    assert_eq!(report.files(), [scene, folder.path().join("a.png")]);
}
