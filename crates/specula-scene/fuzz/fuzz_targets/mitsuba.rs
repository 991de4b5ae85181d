//! Bytes as a Mitsuba scene: an error or a sound scene, never a panic.
#![no_main]

use libfuzzer_sys::fuzz_target;
use specula_scene::{Format, Limits, load_as};

fuzz_target!(|data: &[u8]| {
    let folder = std::env::temp_dir().join(format!("specula-fuzz-mitsuba-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join("scene.xml");
    std::fs::write(&path, data).unwrap();
    if let Ok(loaded) = load_as(&path, Format::Mitsuba, &Limits::strict().into()) {
        loaded.scene.validate().unwrap();
    }
});
