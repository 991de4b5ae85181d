//! Bytes as the mesh of a Mitsuba scene: an error or a sound scene, never a panic.
#![no_main]

use libfuzzer_sys::fuzz_target;
use specula_scene::{Format, Limits, load_as};

const SCENE: &str = r#"<scene version="3.0.0"><sensor type="perspective"/><emitter type="constant"/>
<shape type="obj"><string name="filename" value="mesh.obj"/></shape></scene>"#;

fuzz_target!(|data: &[u8]| {
    let folder = std::env::temp_dir().join(format!("specula-fuzz-obj-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("mesh.obj"), data).unwrap();
    let path = folder.join("scene.xml");
    std::fs::write(&path, SCENE).unwrap();
    if let Ok(loaded) = load_as(&path, Format::Mitsuba, &Limits::strict().into()) {
        loaded.scene.validate().unwrap();
    }
});
