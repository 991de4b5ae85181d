//! Bytes as a picture; the first byte chooses the format. An error or a sound scene, never a panic
//! that the reader does not itself turn into an error.
#![no_main]

use libfuzzer_sys::fuzz_target;
use specula_scene::{Limits, load_with};

const FORMATS: [&str; 6] = ["exr", "pfm", "hdr", "png", "tga", "jpg"];

/// The fuzzer aborts at every panic; those of the crate `exr`, which its guard turns into errors, may
/// pass.
fn let_guarded_panics_pass() {
    let abort = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        if !panic.location().is_some_and(|at| at.file().contains("/exr-")) {
            abort(panic);
        }
    }));
}

fuzz_target!(init: let_guarded_panics_pass(), |data: &[u8]| {
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
    if let Ok(loaded) = load_with(&path, &Limits::strict().into()) {
        loaded.scene.validate().unwrap();
    }
});
