//! Bytes as a pbrt-v4 scene: an error or a sound scene, never a panic.
#![no_main]

use libfuzzer_sys::fuzz_target;
use specula_scene::{Limits, load_with};

fuzz_target!(|data: &[u8]| {
    let folder = std::env::temp_dir().join(format!("specula-fuzz-pbrt-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join("scene.pbrt");
    std::fs::write(&path, data).unwrap();
    if let Ok(loaded) = load_with(&path, &Limits::strict().into()) {
        loaded.scene.validate().unwrap();
    }
});
