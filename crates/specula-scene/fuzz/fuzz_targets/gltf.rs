//! Bytes as a glTF file, JSON or binary: an error or a sound scene, never a panic.
#![no_main]

use std::time::Duration;

use libfuzzer_sys::fuzz_target;
use specula_scene::{Exposure, Limits, LoadOptions, load_with};

fuzz_target!(|data: &[u8]| {
    let name = format!("specula-fuzz-{}.glb", std::process::id());
    let path = std::env::temp_dir().join(name);
    std::fs::write(&path, data).unwrap();
    let mut options = LoadOptions::from(Limits::strict());
    // A moment of its animations, of files of odd length.
    options.exposure = (data.len() % 2 == 1).then(|| Exposure {
        time: Duration::from_millis(500),
        shutter: Duration::from_millis(100),
    });
    if let Ok(loaded) = load_with(&path, &options) {
        loaded.scene.validate().unwrap();
    }
});
