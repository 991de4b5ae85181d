//! Formats are told by content: under any name, packed, and from memory.

use std::io::Write;
use std::path::Path;

use specula_scene::{Format, LoadOptions, Loaded, check, load, load_bytes};

const SCENES: [(&str, Format); 5] = [
    (
        "Camera \"perspective\"\nWorldBegin\nShape \"sphere\"\n",
        Format::Pbrt,
    ),
    (
        "<scene version=\"3.0.0\"><sensor type=\"perspective\"/><shape type=\"sphere\"/></scene>",
        Format::Mitsuba,
    ),
    (
        r#"{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                "min": [0, 0, 0], "max": [1, 1, 0]}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}],
            "buffers": [{"byteLength": 36, "uri":
                "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}"#,
        Format::Gltf,
    ),
    ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", Format::Obj),
    (
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
         property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
         0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
        Format::Ply,
    ),
];

fn packed(text: &str) -> Vec<u8> {
    let mut to = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    to.write_all(text.as_bytes()).unwrap();
    to.finish().unwrap()
}

/// How many shapes the file itself has.
fn shapes(loaded: &Loaded) -> usize {
    let floor = loaded.scene.floor;
    let shapes = &loaded.scene.shapes;
    shapes.iter().filter(|s| Some(s.material) != floor).count()
}

#[test]
fn every_format_is_read_under_any_name_and_packed() {
    let folder = tempfile::tempdir().unwrap();
    for (text, format) in SCENES {
        for name in [
            "scene",
            "scene.txt",
            "scene.pbrt",
            "scene.xml",
            "scene.glb",
            "scene.ply",
        ] {
            for bytes in [text.as_bytes().to_vec(), packed(text)] {
                let path = folder.path().join(name);
                std::fs::write(&path, bytes).unwrap();
                let loaded = load(&path).unwrap_or_else(|e| panic!("{format:?} {name}: {e}"));
                assert_eq!(loaded.format, format, "{name}");
                assert_eq!(shapes(&loaded), 1, "{format:?} {name}");
                assert_eq!(loaded.files, std::slice::from_ref(&path));
                let report = check(&path, &LoadOptions::default());
                assert_eq!(
                    report.count(specula_scene::Severity::Error),
                    0,
                    "{format:?} {name}"
                );
            }
        }
    }
}

#[test]
fn every_format_is_read_from_memory() {
    for (text, format) in SCENES {
        for bytes in [text.as_bytes().to_vec(), packed(text)] {
            let loaded = load_bytes(Path::new("<stdin>"), bytes, &LoadOptions::default());
            let loaded = loaded.unwrap_or_else(|e| panic!("{format:?}: {e}"));
            assert_eq!((loaded.format, shapes(&loaded)), (format, 1));
            assert!(loaded.files.is_empty());
        }
    }
    let broken = load_bytes(
        Path::new("<stdin>"),
        b"Camera 7".to_vec(),
        &LoadOptions::default(),
    );
    let error = broken.unwrap_err();
    assert!(
        error.place().to_string().starts_with("<stdin>:1:"),
        "{}",
        error.place()
    );
}
