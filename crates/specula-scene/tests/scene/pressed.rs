//! Transforms that cannot be inverted: what keeps area is rendered flat, the rest is left out.

use specula_scene::ErrorKind;
use specula_scene::scene::Geometry;

use super::common::{Folder, load, load_world, warnings};

const QUAD: &str = "Shape \"trianglemesh\" \"point3 P\" [0 0 1 1 0 2 1 1 3 0 1 4] \"integer indices\" [0 1 2 0 2 3]";

#[test]
fn a_helper_of_a_modeller_is_left_out_and_the_rest_stays() {
    // pbrt-v4-scenes, transparent-machines.
    let flat = "ConcatTransform [ -0 -0 0 0 0 1 0 0 -1.2246469e-16 0 -1 0 2637.5637 -70.63508 8.852083 1 ]";
    let edge =
        "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 1 1 0] \"integer indices\" [0 1 2]";
    let loaded = load_world(&format!("AttributeBegin {flat}\n{edge}\nAttributeEnd")).unwrap();
    assert_eq!(loaded.scene.shapes.len(), 1, "the sphere");
    let left = "the transform presses the shape to no area: it is left out";
    assert_eq!(warnings(&loaded), [left]);
    assert_eq!(
        (loaded.warnings[1].line(), loaded.warnings[1].column()),
        (3, 7)
    );
    let error = load(format!("WorldBegin\n{flat}\n{edge}")).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::EmptyScene);
    assert!(error.message().contains(left), "{error}");
}

#[test]
fn what_keeps_area_is_flat() {
    let loaded = load(format!(
        "WorldBegin\nTranslate 0 0 5 Scale 2 2 0\n\
         AreaLightSource \"diffuse\" Shape \"sphere\"\n{QUAD}\n\
         Shape \"disk\" \"float height\" 7 Shape \"cylinder\"\nIdentity Scale 0 1 1 Shape \"disk\""
    ))
    .unwrap();
    let scene = &loaded.scene;
    let kinds: Vec<bool> = scene
        .shapes
        .iter()
        .map(|s| matches!(s.geometry, Geometry::Disk { .. }))
        .collect();
    assert_eq!(
        kinds,
        [true, false, true],
        "the cylinder is a circle, the last disk a line"
    );
    assert!(
        scene.shapes[0].emission.unwrap().two_sided,
        "both halves of the sphere emit"
    );
    let disk = scene.shapes[0].to_world;
    assert_eq!(disk.w_axis.to_array(), [0.0, 0.0, 5.0, 1.0]);
    let sides = [disk.x_axis, disk.y_axis].map(|axis| axis.length());
    assert_eq!(sides, [2.0, 2.0]);
    assert!(
        scene.meshes[0].positions.iter().any(|p| p[2] != 5.0),
        "the file's own"
    );
    assert!(
        scene
            .meshes
            .last()
            .unwrap()
            .positions
            .iter()
            .all(|p| p[2] == 5.0)
    );
    assert!(scene.validate().is_ok());
    let flat = "the transform presses the shape flat: it is rendered flat";
    let gone = "the transform presses the shape to no area: it is left out";
    assert_eq!(warnings(&loaded), [flat, flat, flat, gone, gone]);
}

#[test]
fn instances_are_pressed_whole() {
    let loaded = load(format!(
        "WorldBegin\nObjectBegin \"a\" {QUAD} Shape \"sphere\" ObjectEnd\n\
         ObjectInstance \"a\"\nScale 1 1 0 ObjectInstance \"a\"\nScale 0 1 1 ObjectInstance \"a\""
    ))
    .unwrap();
    assert_eq!(
        (loaded.scene.instances.len(), loaded.scene.shapes.len()),
        (1, 2)
    );
    assert_eq!(loaded.scene.meshes.len(), 2);
    assert_eq!(warnings(&loaded).len(), 4);
}

#[test]
fn cameras_lights_and_textures_need_an_inverse() {
    for (text, line) in [
        (
            "Scale 1 1 0\nCamera \"perspective\"\nWorldBegin Shape \"sphere\"",
            2,
        ),
        (
            "WorldBegin\nScale 1 1 0\nLightSource \"point\" Shape \"sphere\"",
            3,
        ),
        (
            "WorldBegin Scale 1 1 0\nTexture \"a\" \"float\" \"windy\" Shape \"sphere\"",
            2,
        ),
        (
            "WorldBegin Scale 1 1 0\nTexture \"a\" \"float\" \"dots\" \"string mapping\" \"planar\"",
            2,
        ),
    ] {
        let error = load(text).unwrap_err();
        assert_eq!(
            (error.kind(), error.line()),
            (ErrorKind::Transform, line),
            "{text}: {error}"
        );
        assert!(error.message().contains("cannot be inverted"), "{error}");
    }
    // Coordinates of the surface need none.
    load_world("Scale 1 1 0 Texture \"a\" \"float\" \"dots\" Identity").unwrap();
}

#[test]
fn a_node_of_gltf_is_pressed() {
    let folder = Folder::new();
    let file = |scale: &str| {
        format!(
            r#"{{"asset": {{"version": "2.0"}}, "scenes": [{{"nodes": [0, 1]}}],
"nodes": [{{"mesh": 0}}, {{"mesh": 0, "scale": {scale}}}],
"meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}}}]}}],
"buffers": [{{"byteLength": 36, "uri": "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}}],
"bufferViews": [{{"buffer": 0, "byteLength": 36}}],
"accessors": [{{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0],
"max": [1, 1, 0]}}]}}"#
        )
    };
    for (scale, part, shapes) in [("[2, 2, 0]", "flat", 3), ("[2, 0, 2]", "no area", 2)] {
        let path = folder.write("a.gltf", file(scale));
        let loaded = specula_scene::load(&path).unwrap();
        assert_eq!(loaded.scene.shapes.len(), shapes, "{scale}, with the floor");
        let warning = loaded
            .warnings
            .iter()
            .find(|w| w.message().contains("presses"))
            .unwrap();
        assert!(warning.message().starts_with("nodes[1]: "), "{warning}");
        assert!(warning.message().contains(part), "{warning}");
        assert_eq!(warning.line(), 2);
    }
}

/// Hierarchies over boxes without area would take for ever.
#[test]
fn specks_are_left_out() {
    for text in [
        "Scale 1e-30 1e-30 1e-30 Shape \"sphere\" \"float zmax\" .5",
        "Shape \"sphere\" \"float radius\" 1e-25",
        "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1e-20 0 0 0 1e-20 0] \"integer indices\" [0 1 2]",
    ] {
        let loaded = load_world(&format!("AttributeBegin {text} AttributeEnd")).unwrap();
        assert_eq!(loaded.scene.shapes.len(), 1, "{text}");
        let said = warnings(&loaded);
        assert!(
            said.iter().any(|w| w.contains("too small to have area")),
            "{text}: {said:?}"
        );
    }
}
