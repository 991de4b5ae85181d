//! Bytes as the curves of a Mitsuba scene: an error or a sound scene, never a panic. The first byte chooses their basis.
#![no_main]

use libfuzzer_sys::fuzz_target;
use specula_scene::{Format, Limits, load_as};

fuzz_target!(|data: &[u8]| {
    let folder = std::env::temp_dir().join(format!("specula-fuzz-curves-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let (basis, text) = match data {
        [first, text @ ..] if first % 2 == 0 => ("linearcurve", text),
        [_, text @ ..] => ("bsplinecurve", text),
        [] => ("linearcurve", data),
    };
    std::fs::write(folder.join("curves.txt"), text).unwrap();
    let path = folder.join("scene.xml");
    let scene = format!(
        r#"<scene version="3.0.0"><sensor type="perspective"/><emitter type="constant"/>
<shape type="{basis}"><string name="filename" value="curves.txt"/></shape></scene>"#
    );
    std::fs::write(&path, scene).unwrap();
    if let Ok(loaded) = load_as(&path, Format::Mitsuba, &Limits::strict().into()) {
        loaded.scene.validate().unwrap();
    }
});
