//! Bytes as a mesh in PLY: an error or a sound scene, never a panic.
#![no_main]

use libfuzzer_sys::fuzz_target;
use specula_scene::{Limits, load_with};

const SCENE: &str = "WorldBegin Shape \"plymesh\" \"string filename\" \"mesh.ply\"";

fuzz_target!(|data: &[u8]| {
    let folder = std::env::temp_dir().join(format!("specula-fuzz-ply-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("mesh.ply"), data).unwrap();
    let path = folder.join("scene.pbrt");
    std::fs::write(&path, SCENE).unwrap();
    if let Ok(loaded) = load_with(&path, &Limits::strict().into()) {
        loaded.scene.validate().unwrap();
    }
});
