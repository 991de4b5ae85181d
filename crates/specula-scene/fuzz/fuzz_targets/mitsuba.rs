//! Bytes as a Mitsuba scene: an error or a sound scene, never a panic.
#![no_main]

use libfuzzer_sys::fuzz_target;
use specula_scene::{Limits, mitsuba};

fuzz_target!(|data: &[u8]| {
    let folder = std::env::temp_dir().join(format!("specula-fuzz-mitsuba-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join("scene.xml");
    std::fs::write(&path, data).unwrap();
    if let Ok(loaded) = mitsuba::read(&path, &Limits::strict(), &mitsuba::Options::default()) {
        loaded.scene.validate().unwrap();
    }
});
