//! Bytes as a glTF file, JSON or binary: an error or a sound scene, never a panic.
#![no_main]

use libfuzzer_sys::fuzz_target;
use specula_scene::{Limits, load_with};

fuzz_target!(|data: &[u8]| {
    let name = format!("specula-fuzz-{}.glb", std::process::id());
    let path = std::env::temp_dir().join(name);
    std::fs::write(&path, data).unwrap();
    if let Ok(loaded) = load_with(&path, &Limits::strict().into()) {
        loaded.scene.validate().unwrap();
    }
});
