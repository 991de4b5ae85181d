//! Bytes as the mesh of a Mitsuba scene: an error or a sound scene, never a panic. The first byte
//! chooses a whole file (0), or the stream within a file of version 4 (1) or 3 (2): mutated bytes
//! rarely survive inflation.
#![no_main]

use std::io::Write;

use flate2::Compression;
use flate2::write::ZlibEncoder;
use libfuzzer_sys::fuzz_target;
use specula_scene::{Format, Limits, load_as};

const SCENE: &str = r#"<scene version="3.0.0"><sensor type="perspective"/><emitter type="constant"/>
<shape type="serialized"><string name="filename" value="mesh.serialized"/></shape></scene>"#;

/// A file of one mesh: header, deflated stream, table of offsets, number of meshes.
fn file_of(stream: &[u8], version: u16) -> Vec<u8> {
    let mut file = vec![0x1c, 0x04];
    file.extend(version.to_le_bytes());
    let mut encoder = ZlibEncoder::new(file, Compression::fast());
    encoder.write_all(stream).unwrap();
    let mut file = encoder.finish().unwrap();
    let offset: &[u8] = if version > 3 { &[0; 8] } else { &[0; 4] };
    file.extend(offset);
    file.extend(1_u32.to_le_bytes());
    file
}

fuzz_target!(|data: &[u8]| {
    let Some((first, data)) = data.split_first() else {
        return;
    };
    let file = match first % 3 {
        0 => data.to_vec(),
        1 => file_of(data, 4),
        _ => file_of(data, 3),
    };
    let folder = std::env::temp_dir().join(format!("specula-fuzz-serialized-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("mesh.serialized"), file).unwrap();
    let path = folder.join("scene.xml");
    std::fs::write(&path, SCENE).unwrap();
    if let Ok(loaded) = load_as(&path, Format::Mitsuba, &Limits::strict().into()) {
        loaded.scene.validate().unwrap();
    }
});
