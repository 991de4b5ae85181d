//! Bytes as the lens file of a camera: an error or a sound scene, never a panic.
#![no_main]

use libfuzzer_sys::fuzz_target;
use specula_scene::{Format, Limits, load_as};

fuzz_target!(|data: &[u8]| {
    let folder = std::env::temp_dir().join(format!("specula-fuzz-lens-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("lens.dat"), data).unwrap();
    let path = folder.join("scene.pbrt");
    let scene = "Camera \"realistic\" \"string lensfile\" \"lens.dat\"\nWorldBegin\n";
    std::fs::write(&path, scene).unwrap();
    if let Ok(loaded) = load_as(&path, Format::Pbrt, &Limits::strict().into()) {
        loaded.scene.validate().unwrap();
    }
});
