//! Bytes as a picture; the first byte chooses the format. An error or a sound scene, never a panic.
#![no_main]

use libfuzzer_sys::fuzz_target;
use specula_scene::{Limits, load_with};

const FORMATS: [&str; 6] = ["exr", "pfm", "hdr", "png", "tga", "jpg"];

fuzz_target!(|data: &[u8]| {
    let Some((first, data)) = data.split_first() else {
        return;
    };
    let format = FORMATS[usize::from(*first) % FORMATS.len()];
    let folder = std::env::temp_dir().join(format!("specula-fuzz-image-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let picture = format!("picture.{format}");
    std::fs::write(folder.join(&picture), data).unwrap();
    let path = folder.join("scene.pbrt");
    let scene = format!(
        "WorldBegin Texture \"t\" \"float\" \"imagemap\" \"string filename\" \"{picture}\"
         LightSource \"infinite\" \"string filename\" \"{picture}\" Shape \"sphere\" \"texture alpha\" \"t\""
    );
    std::fs::write(&path, scene).unwrap();
    if let Ok(loaded) = load_with(&path, &Limits::strict()) {
        loaded.scene.validate().unwrap();
    }
});
