//! Bytes as the library of materials of an OBJ file: a sound scene, never a panic.
#![no_main]

use libfuzzer_sys::fuzz_target;
use specula_scene::{Format, Limits, load_as};

fuzz_target!(|data: &[u8]| {
    let folder = std::env::temp_dir().join(format!("specula-fuzz-library-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("a.mtl"), data).unwrap();
    std::fs::write(folder.join("a.pfm"), b"PF\n1 1\n-1.0\n\0\0\0\x3f\0\0\0\x3f\0\0\x80\x3f").unwrap();
    let path = folder.join("a.obj");
    let mesh = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 1 2 3\n";
    std::fs::write(&path, mesh).unwrap();
    let loaded = load_as(&path, Format::Obj, &Limits::strict().into()).unwrap();
    loaded.scene.validate().unwrap();
});
