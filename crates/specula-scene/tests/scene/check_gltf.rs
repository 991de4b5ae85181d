//! All mistakes of glTF documents in one run, each where it stands.

use std::path::Path;

use specula_scene::{CheckReport, LoadOptions, SceneError, Severity};

use super::common::Folder;

fn check(path: &Path) -> CheckReport {
    specula_scene::check(path, &LoadOptions::default())
}

/// Lines, columns and messages of the errors.
fn errors(report: &CheckReport) -> Vec<(usize, usize, String)> {
    let errors = report.problems().iter();
    errors
        .filter(|p| p.severity() == Severity::Error)
        .map(|p| (p.place().line(), p.place().column(), p.message().to_owned()))
        .collect()
}

#[track_caller]
fn expect(report: &CheckReport, load: &SceneError, expected: &[(usize, usize, &str)]) {
    let found = errors(report);
    let places: Vec<_> = found.iter().map(|e| (e.0, e.1)).collect();
    let wanted: Vec<_> = expected.iter().map(|e| (e.0, e.1)).collect();
    assert_eq!(places, wanted, "{found:#?}");
    for ((_, _, message), (_, _, word)) in found.iter().zip(expected) {
        assert!(message.contains(word), "{word}: {message}");
    }
    assert_eq!(found[0].2, load.message());
}

/// A document that uses most of what is read, with a triangle in the buffer.
const SOUND: &str = r#"{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
"nodes": [{"mesh": 0, "children": [1, 2], "translation": [1, 2, 3]}, {"camera": 0, "rotation": [0, 0, 0, 1]},
{"scale": [1, 1, 1], "extensions": {"KHR_lights_punctual": {"light": 0}}}],
"extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "color": [1, 1, 1], "intensity": 5,
"spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.5}}]}},
"cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0, "mode": 4}]}],
"materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 0},
"baseColorFactor": [1, 1, 1, 1], "roughnessFactor": 0.5}, "alphaMode": "MASK", "emissiveFactor": [0, 0, 1],
"extensions": {"KHR_materials_ior": {"ior": 1.4}}}],
"textures": [{"source": 0, "sampler": 0}], "samplers": [{"magFilter": 9729, "wrapS": 10497}],
"images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR4nGP43+BwAgAGyQKIgvZT8AAAAABJRU5ErkJggg=="}],
"buffers": [{"byteLength": 39, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAEC"}],
"bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 3}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0],
"max": [1, 1, 0]}, {"bufferView": 1, "componentType": 5121, "count": 3, "type": "SCALAR"}],
"skins": [{"joints": [1]}], "animations": [{"channels": [{"sampler": 0, "target": {"node": 0, "path": "scale"}}],
"samplers": [{"input": 0, "output": 0}]}]}"#;

/// The sound document with some texts replaced, each of which it holds once.
fn with(changes: &[(&str, &str)]) -> String {
    let mut text = SOUND.to_owned();
    for (from, to) in changes {
        assert_eq!(text.matches(from).count(), 1, "{from}");
        text = text.replace(from, to);
    }
    text
}

/// Mistakes all over, and where they are reported.
const CHANGES: [(&str, &str); 14] = [
    ("\"translation\": [1, 2, 3]", "\"translation\": [1, 2]"),
    ("{\"light\": 0}", "{\"light\": 1}"),
    ("\"intensity\": 5", "\"intensity\": \"bright\""),
    ("\"yfov\": 1, ", ""),
    ("\"material\": 0", "\"material\": 9"),
    ("\"roughnessFactor\": 0.5", "\"roughnessFactor\": null"),
    ("\"MASK\"", "\"MSAK\""),
    ("\"ior\": 1.4", "\"ior\": []"),
    ("\"sampler\": 0}]", "\"sampler\": -1}]"),
    ("\"wrapS\": 10497", "\"wrapS\": 3"),
    ("\"uri\": \"data:image", "\"url\": \"data:image"),
    ("\"componentType\": 5126", "\"componentType\": 5127"),
    ("\"joints\": [1]", "\"joints\": 1"),
    ("\"path\": \"scale\"", "\"path\": \"size\""),
];

const EXPECTED: [(usize, usize, &str); 14] = [
    (
        2,
        58,
        "nodes[0].translation: expected a list of 3 numbers, found a list of 2",
    ),
    (3, 70, "lights` has no element 1: there is 1"),
    (
        4,
        101,
        "lights[0].intensity: expected a number, found \"bright\"",
    ),
    (6, 52, "cameras[0].perspective: expected a member `yfov`"),
    (
        7,
        86,
        "primitives[0].material: `materials` has no element 9: there is 1",
    ),
    (9, 53, "roughnessFactor: expected a number, found null"),
    (9, 73, "expected one of OPAQUE, MASK, BLEND, found \"MSAK\""),
    (
        10,
        45,
        "KHR_materials_ior.ior: expected a number, found a list of 0",
    ),
    (
        11,
        39,
        "textures[0].sampler: expected the number of an element of `samplers`, found -1",
    ),
    (11, 87, "samplers[0].wrapS: expected one of 33071"),
    (12, 12, "images[0]: expected a member `uri` or `bufferView`"),
    (15, 50, "accessors[0].componentType: expected one of 5120"),
    (17, 22, "skins[0].joints: expected a list, found 1"),
    (17, 101, "path: expected one of translation"),
];

#[test]
fn every_mistake_of_the_schema_has_its_line_and_column() {
    let folder = Folder::new();
    let path = folder.write("sound.gltf", SOUND);
    specula_scene::load(&path).unwrap();
    assert_eq!(errors(&check(&path)), []);
    let path = folder.write("a.gltf", with(&CHANGES));
    let load = specula_scene::load(&path).unwrap_err();
    expect(&check(&path), &load, &EXPECTED);
}

#[test]
fn places_of_a_binary_file_are_those_of_its_json() {
    let folder = Folder::new();
    let mut json = with(&CHANGES);
    while !json.len().is_multiple_of(4) {
        json.push(' ');
    }
    let length = |n: usize| u32::try_from(n).unwrap().to_le_bytes();
    let mut bytes = b"glTF\x02\0\0\0".to_vec();
    bytes.extend(length(20 + json.len()));
    bytes.extend(length(json.len()));
    bytes.extend(b"JSON");
    bytes.extend(json.bytes());
    let path = folder.write("a.glb", &bytes);
    let load = specula_scene::load(&path).unwrap_err();
    let report = check(&path);
    expect(&report, &load, &EXPECTED);
    let name = report.problems()[0].place().source().name().to_owned();
    assert!(name.ends_with("a.glb (JSON chunk)"), "{name}");
    let path = folder.write("cut.glb", &bytes[..bytes.len() - 1]);
    let report = check(&path);
    assert!(errors(&report)[0].2.contains("cut off"), "{report:?}");
}

#[test]
fn broken_files_and_what_the_schema_forbids_are_one_report() {
    let folder = Folder::new();
    folder.write("broken.png", [0x89, b'P', b'N', b'G', 1, 2, 3]);
    let broken = "{\"uri\": \"broken.png\", \"ignored\": \"";
    let path = folder.write(
        "a.gltf",
        with(&[
            ("\"mode\": 4", "\"mode\": 7"),
            ("{\"uri\": \"data:image/png;base64,", broken),
            (
                "{\"byteLength\": 39, \"uri\": \"data",
                "{\"byteLength\": 39, \"uri\": \"no.bin\", \"x\": \"",
            ),
            (
                "\"indices\": 1, ",
                "\"indices\": 1, \"material\": 0}, {\"attributes\": {\"POSITION\": 0}, ",
            ),
        ]),
    );
    let load = specula_scene::load(&path).unwrap_err();
    let expected = [
        (7, 145, "primitives[1].mode"),
        (12, 12, "broken.png"),
        (13, 13, "buffers[0]: cannot be read"),
    ];
    expect(&check(&path), &load, &expected);
}

#[test]
fn what_follows_from_a_mistake_is_not_reported() {
    let folder = Folder::new();
    for (from, to, place) in [
        // A buffer, a view and an accessor, without which there is no triangle.
        ("\"byteLength\": 39", "\"byteLength\": -1", (13, 28)),
        (
            "{\"buffer\": 0, \"byteLength\": 36}",
            "{\"buffer\": 1, \"byteLength\": 36}",
            (14, 28),
        ),
        ("\"type\": \"VEC3\"", "\"type\": \"VEC5\"", (15, 76)),
        ("\"version\": \"2.0\"", "\"version\": 2", (1, 23)),
        (
            "{\"primitives\": [",
            "{\"primitives\": {\"a\": 1}, \"b\": [",
            (7, 27),
        ),
    ] {
        let path = folder.write("a.gltf", with(&[(from, to)]));
        let load = specula_scene::load(&path).unwrap_err();
        expect(&check(&path), &load, &[(place.0, place.1, "")]);
    }
}

#[test]
fn extensions_without_which_nothing_can_be_told_come_alone() {
    let folder = Folder::new();
    let required =
        "\"extensionsRequired\": [\"KHR_lights_punctual\", \"KHR_draco_mesh_compression\"]";
    let text = with(&[("\"scene\": 0", required), ("\"mode\": 4", "\"mode\": 7")]);
    let path = folder.write("a.gltf", text);
    let load = specula_scene::load(&path).unwrap_err();
    assert!(load.help().unwrap_or_default().contains("Draco"));
    expect(
        &check(&path),
        &load,
        &[(1, 77, "KHR_draco_mesh_compression")],
    );
}

/// Every number of the document becomes a text: where that is refused, it is named where it stands.
#[test]
fn each_number_is_named_where_it_stands() {
    let folder = Folder::new();
    let mut in_text = false;
    let mut refused = 0;
    for (at, c) in SOUND.char_indices() {
        in_text ^= c == '"';
        let is_first = !SOUND[..at].ends_with(|b: char| b.is_ascii_digit() || b == '.');
        if in_text || !c.is_ascii_digit() || !is_first {
            continue;
        }
        let end = at + SOUND[at..].find([',', '}', ']']).unwrap();
        let text = format!("{}\"?\"{}", &SOUND[..at], &SOUND[end..]);
        let path = folder.write("a.gltf", &text);
        let report = check(&path);
        let Err(load) = specula_scene::load(&path) else {
            assert_eq!(errors(&report), []);
            continue;
        };
        refused += 1;
        let found = errors(&report);
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!(found[0].2, load.message());
        // Lists of numbers are named as one.
        let place = report.problems()[0].place();
        let named = &text[place.offset()..][..place.length()];
        let is_bound = load.message().contains("positions need");
        assert!(
            is_bound || named.contains("\"?\"") && named.len() < 20,
            "{named}"
        );
    }
    assert!(refused > 50, "{refused}");
}

#[test]
fn thousands_of_mistakes_take_no_time() {
    let folder = Folder::new();
    let nodes = "{\"mesh\": 7}, ".repeat(20_000);
    let text = with(&[(
        "\"nodes\": [{\"mesh\"",
        &format!("\"nodes\": [{nodes}{{\"mesh\""),
    )]);
    let report = check(&folder.write("a.gltf", text));
    assert_eq!(report.count(Severity::Error), 20_000);
    assert_eq!(errors(&report).len(), 100);
}
