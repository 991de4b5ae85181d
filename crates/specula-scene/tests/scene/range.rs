//! Numbers beyond what they may be, and what a scene cannot be without.

use specula_scene::scene::{FloatParam, MaterialKind, Projection};
use specula_scene::{ErrorKind, LoadOptions, Loaded, Severity, check};

use super::common::{Folder, load_world, warnings};

/// The load of a file, the messages of whose warnings a check has, too.
#[track_caller]
fn both(folder: &Folder, name: &str) -> Loaded {
    let path = folder.path().join(name);
    let loaded = specula_scene::load(&path).unwrap();
    let report = check(&path, &LoadOptions::default());
    assert_eq!(report.count(Severity::Error), 0, "{:?}", report.problems());
    for warning in &loaded.warnings {
        let same = |p: &specula_scene::Problem| {
            p.message() == warning.message() && p.place().line() == warning.line()
        };
        assert!(report.problems().iter().any(same), "{warning}");
    }
    loaded
}

#[test]
fn the_widest_alpha_is_said() {
    for (params, most) in [
        ("\"float roughness\" 1e9", 100.0),
        ("\"float vroughness\" 1e9", 100.0),
        (
            "\"float roughness\" 1e9 \"bool remaproughness\" false",
            10.0,
        ),
    ] {
        let folder = Folder::new();
        folder.write(
            "scene.pbrt",
            format!("WorldBegin\nMaterial \"conductor\" {params}\nShape \"sphere\""),
        );
        let loaded = both(&folder, "scene.pbrt");
        let found = warnings(&loaded);
        assert!(
            found.len() == 1 && found[0].contains("roughness\": 1000000000"),
            "{found:?}"
        );
        let warning = loaded.warnings.iter().find(|w| w.message() == found[0]);
        assert_eq!(
            warning.map(|w| (w.line(), w.column() > 20)),
            Some((2, true))
        );
        let MaterialKind::Conductor { roughness, .. } = loaded.scene.materials[0].kind else {
            panic!("{:?}", loaded.scene.materials)
        };
        assert_eq!(roughness.v, FloatParam::Value(most));
    }
    // Wide, and sound.
    let loaded = load_world("Material \"dielectric\" \"float roughness\" 2").unwrap();
    assert_eq!(warnings(&loaded), [""; 0]);
}

#[test]
fn pbrts_own_camera_is_said() {
    let folder = Folder::new();
    folder.write(
        "scene.pbrt",
        "WorldBegin\nLightSource \"infinite\"\nShape \"sphere\"",
    );
    let loaded = both(&folder, "scene.pbrt");
    let [warning] = &loaded.warnings[..] else {
        panic!("{:?}", loaded.warnings)
    };
    assert!(warning.message().contains("no `Camera`"), "{warning}");
    let camera = &loaded.scene.camera;
    assert_eq!(camera.to_world, glam::DMat4::IDENTITY);
    assert_eq!(camera.projection, Projection::Perspective { fov_deg: 90.0 });
    folder.write(
        "scene.pbrt",
        "Camera \"perspective\"\nWorldBegin\nLightSource \"infinite\"\nShape \"sphere\"",
    );
    assert!(both(&folder, "scene.pbrt").warnings.is_empty());
}

#[test]
fn views_and_sizes_that_are_none_are_errors() {
    for (text, line, part) in [
        (
            "LookAt 0 0 0  0 1 0  0 1 0\nWorldBegin\nShape \"sphere\"",
            1,
            "across the view",
        ),
        (
            "LookAt 0 0 0  0 0 0  0 1 0\nWorldBegin\nShape \"sphere\"",
            1,
            "apart from the eye",
        ),
        ("WorldBegin\nRotate 90 0 0 0\nShape \"sphere\"", 2, "axis"),
        (
            "WorldBegin\nShape \"sphere\" \"float radius\" -1",
            2,
            "above 0",
        ),
        (
            "WorldBegin\nShape \"sphere\" \"float radius\" nan",
            2,
            "finite",
        ),
        (
            "WorldBegin\nShape \"disk\" \"float innerradius\" -1",
            2,
            "not negative",
        ),
        ("WorldBegin\nShape \"cylinder\" \"float zmin\" 1", 2, "zmin"),
        (
            "Film \"rgb\" \"integer xresolution\" -5\nWorldBegin\nShape \"sphere\"",
            1,
            "xresolution",
        ),
        (
            "WorldBegin\nScale 0 1 1 LightSource \"point\"\nShape \"sphere\"",
            2,
            "cannot be inverted",
        ),
        (
            "Scale 0 1 1\nCamera \"perspective\"\nWorldBegin\nShape \"sphere\"",
            2,
            "cannot be inverted",
        ),
        ("WorldBegin\nScale 0 1 0\nShape \"sphere\"", 3, "no area"),
        (
            "Camera \"perspective\" \"float fov\" 0\nWorldBegin\nShape \"sphere\"",
            1,
            "fov",
        ),
        (
            "WorldBegin\nLightSource \"distant\" \"point3 from\" [1 1 1] \"point3 to\" [1 1 1]\nShape \"sphere\"",
            2,
            "same point",
        ),
        (
            "WorldBegin\nMaterial \"coateddiffuse\" \"float g\" 3\nShape \"sphere\"",
            2,
            "\"g\"",
        ),
        (
            "WorldBegin\nLightSource \"spot\" \"float coneangle\" -20\nShape \"sphere\"",
            2,
            "coneangle",
        ),
    ] {
        let error = super::common::load(text).unwrap_err();
        assert!(error.message().contains(part), "{text}: {error}");
        assert_eq!(error.line(), line, "{text}: {error}");
    }
}

#[test]
fn a_channel_that_is_no_picture_is_named() {
    use exr::prelude::{AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer};
    use exr::prelude::{LayerAttributes, WritableImage};
    let folder = Folder::new();
    for (name, is_sound) in [("foo.X", false), ("Y", true), ("layer.Z", true)] {
        let channel = AnyChannel::new(name, FlatSamples::F32(vec![0.5; 4]));
        let layer = Layer::new(
            (2, 2),
            LayerAttributes::named("layer"),
            Encoding::UNCOMPRESSED,
            AnyChannels::sort(vec![channel].into()),
        );
        let path = folder.path().join("a.exr");
        Image::from_layer(layer).write().to_file(path).unwrap();
        let result = folder.load(
            "WorldBegin\nTexture \"t\" \"float\" \"imagemap\" \"string filename\" \"a.exr\"\n\
             Shape \"sphere\" \"texture alpha\" \"t\"",
        );
        match result {
            Ok(_) => assert!(is_sound, "{name}"),
            Err(error) => {
                assert!(!is_sound, "{name}: {error}");
                assert_eq!((error.kind(), error.line()), (ErrorKind::Image, 2));
                assert!(error.message().contains("found \"foo.X\""), "{error}");
            }
        }
    }
}

/// A triangle in glTF, with members of its root, its material and its node.
fn gltf(root: &str, material: &str, node: &str) -> String {
    format!(
        r#"{{"asset": {{"version": "2.0"}}, "scenes": [{{"nodes": [0, 1]}}],
"nodes": [{{"mesh": 0{node}}}, {{"camera": 0}}],
"meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}, "material": 0}}]}}],
"materials": [{{{material}}}], "cameras": [{{"type": "perspective", "perspective": {{"yfov": 1, "znear": 0.1}}}}],
"buffers": [{{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}}],
"bufferViews": [{{"buffer": 0, "byteLength": 36}}], "accessors": [{{"bufferView": 0, "componentType": 5126,
"count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}}]{root}}}"#
    )
}

#[test]
fn numbers_beyond_the_ranges_of_gltf_are_clamped_and_said() {
    let folder = Folder::new();
    let material = r#""pbrMetallicRoughness": {"roughnessFactor": -3, "metallicFactor": 7,
"baseColorFactor": [0.5, 2, 0.5, 1]}, "extensions": {"KHR_materials_ior": {"ior": 0.5},
"KHR_materials_clearcoat": {"clearcoatFactor": 1.5}}, "emissiveFactor": [-1, 2, 0]"#;
    folder.write(
        "a.gltf",
        gltf("", material, r#", "rotation": [0, 0, 0, 0]"#),
    );
    let loaded = both(&folder, "a.gltf");
    let MaterialKind::Gltf(g) = loaded.scene.materials[0].kind else {
        panic!("{:?}", loaded.scene.materials)
    };
    assert_eq!(g.roughness, FloatParam::Value(0.0));
    assert_eq!(g.metallic, FloatParam::Value(1.0));
    assert_eq!(g.ior, 1.0);
    let shape = &loaded.scene.shapes[0];
    assert_eq!(shape.to_world, glam::DMat4::IDENTITY);
    for (path, line, part) in [
        (
            "materials[0].pbrMetallicRoughness.roughnessFactor",
            4,
            "found -3: 0 is used",
        ),
        (
            "materials[0].pbrMetallicRoughness.metallicFactor",
            4,
            "found 7: 1 is used",
        ),
        (
            "materials[0].pbrMetallicRoughness.baseColorFactor",
            5,
            "found 2: 1 is used",
        ),
        (
            "materials[0].extensions.KHR_materials_ior.ior",
            5,
            "found 0.5: 1 is used",
        ),
        (
            "materials[0].extensions.KHR_materials_clearcoat.clearcoatFactor",
            6,
            "found 1.5",
        ),
        ("materials[0].emissiveFactor", 6, "found -1: 0 is used"),
        ("nodes[0].rotation", 2, "not turned"),
    ] {
        let warning = loaded
            .warnings
            .iter()
            .find(|w| w.message().starts_with(path));
        let warning = warning.unwrap_or_else(|| panic!("{path}: {:?}", loaded.warnings));
        assert!(warning.message().contains(part), "{warning}");
        assert_eq!(warning.line(), line, "{warning}");
    }
    // One more: what glows is no lamp.
    assert_eq!(loaded.warnings.len(), 8, "{:?}", loaded.warnings);
    // A rotation of another length is that of length 1.
    let half = r#", "rotation": [0, 0, 3, 3]"#;
    folder.write("b.gltf", gltf("", "", half));
    let loaded = both(&folder, "b.gltf");
    let turned = loaded.scene.shapes[0]
        .to_world
        .transform_vector3(glam::DVec3::X);
    assert!(turned.abs_diff_eq(glam::DVec3::Y, 1e-6), "{turned}");
    assert!(
        loaded
            .warnings
            .iter()
            .any(|w| w.message().contains("scaled to 1"))
    );
    // All at their defaults, and a volume without end.
    let plain = r#""extensions": {"KHR_materials_volume": {"thicknessFactor": 1}}"#;
    folder.write("c.gltf", gltf("", plain, ""));
    let loaded = both(&folder, "c.gltf");
    assert_eq!(loaded.warnings.len(), 1, "no light: {:?}", loaded.warnings);
}

#[test]
fn other_versions_of_gltf_are_errors() {
    let folder = Folder::new();
    let plain = gltf("", "", "");
    for (asset, part) in [
        (
            r#"{"version": "1.0"}"#,
            "asset.version: expected \"2.0\", found \"1.0\"",
        ),
        (
            r#"{"version": "2.1", "minVersion": "2.1"}"#,
            "asset.minVersion",
        ),
    ] {
        let path = folder.write("a.gltf", plain.replace(r#"{"version": "2.0"}"#, asset));
        let error = specula_scene::load(&path).unwrap_err();
        assert!(error.message().contains(part), "{error}");
        assert_eq!((error.line(), error.column() > 10), (1, true));
        assert!(error.help().is_some());
        let report = check(&path, &LoadOptions::default());
        assert_eq!(report.count(Severity::Error), 1);
        assert_eq!(report.problems()[0].message(), error.message());
    }
    // What version 1 has objects for.
    let path = folder.write(
        "a.gltf",
        r#"{"asset": {"version": "1.0"}, "meshes": {"a": {}}}"#,
    );
    let error = specula_scene::load(&path).unwrap_err();
    assert!(error.message().contains("asset.version"), "{error}");
}

#[test]
fn cameras_without_a_view_are_errors() {
    let folder = Folder::new();
    let plain = gltf("", "", "");
    for (view, part) in [
        (r#""perspective": {"yfov": 0, "znear": 0.1}"#, "yfov"),
        (r#""perspective": {"yfov": 4, "znear": 0.1}"#, "yfov"),
    ] {
        let path = folder.write(
            "a.gltf",
            plain.replace(r#""perspective": {"yfov": 1, "znear": 0.1}"#, view),
        );
        let error = specula_scene::load(&path).unwrap_err();
        assert!(
            error.message().starts_with("cameras[0]") && error.message().contains(part),
            "{error}"
        );
        assert_eq!(error.line(), 4);
        let report = check(&path, &LoadOptions::default());
        assert_eq!(report.count(Severity::Error), 1);
    }
}
