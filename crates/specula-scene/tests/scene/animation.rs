//! glTF's animations: nodes at a time, and their motion while the shutter is open.

use std::time::Duration;

use base64::Engine;
use glam::{DMat4, DVec3};
use specula_scene::scene::{Light, Trajectory};
use specula_scene::{Exposure, LoadOptions, Loaded, Scene, SceneError, load_bytes};

/// A file whose first node moves along x from 0 to 4 in two seconds and turns about z by a right angle; a mesh is in
/// it and in its child, as are a camera and a light.
///
/// * `nodes`, `more`: further nodes, and members of the root.
fn document(changes: &[(&str, &str)]) -> String {
    let half = 0.5_f32.sqrt();
    let floats: [f32; 25] = [
        // A triangle.
        0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, // times
        0.0, 2.0, // translations
        0.0, 0.0, 0.0, 4.0, 0.0, 0.0, // rotations
        0.0, 0.0, 0.0, 1.0, 0.0, 0.0, half, half,
    ];
    let bytes: Vec<u8> = floats.iter().flat_map(|x| x.to_le_bytes()).collect();
    let data = base64::engine::general_purpose::STANDARD.encode(&bytes);
    let view = |from: usize, count: usize| {
        format!(
            r#"{{"buffer": 0, "byteOffset": {}, "byteLength": {}}}"#,
            4 * from,
            4 * count
        )
    };
    let accessor = |view: usize, count: usize, kind: &str| {
        format!(
            r#"{{"bufferView": {view}, "componentType": 5126, "count": {count}, "type": "{kind}",
                "min": [0, 0, 0], "max": [1, 1, 0]}}"#
        )
    };
    let mut text = format!(
        r#"{{"asset": {{"version": "2.0"}}, "scenes": [{{"nodes": [0]}}],
"nodes": [{{"mesh": 0, "children": [1, 2]}}, {{"mesh": 0, "translation": [0, 1, 0]}}, {{"camera": 0}}],
"cameras": [{{"type": "perspective", "perspective": {{"yfov": 1, "znear": 0.1}}}}],
"meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}}}]}}],
"buffers": [{{"byteLength": {}, "uri": "data:application/octet-stream;base64,{data}"}}],
"bufferViews": [{}, {}, {}, {}],
"accessors": [{}, {}, {}, {}],
"animations": [{{"channels": [{{"sampler": 0, "target": {{"node": 0, "path": "translation"}}}},
  {{"sampler": 1, "target": {{"node": 0, "path": "rotation"}}}}],
 "samplers": [{{"input": 1, "output": 2}}, {{"input": 1, "output": 3, "interpolation": "LINEAR"}}]}}]}}"#,
        bytes.len(),
        view(0, 9),
        view(9, 2),
        view(11, 6),
        view(17, 8),
        accessor(0, 3, "VEC3"),
        accessor(1, 2, "SCALAR")
            .replace("[0, 0, 0]", "[0]")
            .replace("[1, 1, 0]", "[2]"),
        accessor(2, 2, "VEC3").replace("[1, 1, 0]", "[4, 0, 0]"),
        accessor(3, 2, "VEC4")
            .replace("[0, 0, 0]", "[0, 0, 0, 0]")
            .replace("[1, 1, 0]", "[1, 1, 1, 1]"),
    );
    for (from, to) in changes {
        assert!(text.contains(from), "{from}");
        text = text.replacen(from, to, 1);
    }
    text
}

fn read(text: &str, exposure: Option<[f64; 2]>) -> Result<Loaded, SceneError> {
    let mut options = LoadOptions::default();
    options.exposure = exposure.map(|[time, shutter]| Exposure {
        time: Duration::from_secs_f64(time),
        shutter: Duration::from_secs_f64(shutter),
    });
    load_bytes("a.gltf".as_ref(), text.as_bytes().to_vec(), &options)
}

fn told(loaded: &Loaded) -> Vec<&str> {
    let messages = loaded.warnings.iter().map(|w| w.message());
    messages.filter(|m| !m.contains("no lights")).collect()
}

/// Where the file's first node is at a time.
fn node(time: f64) -> DMat4 {
    let s = 0.5 * time.clamp(0.0, 2.0);
    let turn = DMat4::from_rotation_z(s * core::f64::consts::FRAC_PI_2);
    DMat4::from_translation(DVec3::new(4.0 * s, 0.0, 0.0)) * turn
}

/// Both instances at a part of the exposure.
fn places(scene: &Scene, time: f64) -> Vec<DMat4> {
    let at = |i: &specula_scene::scene::ObjectInstance| match &i.motion {
        Some(motion) => Trajectory::new(&i.to_world, motion).at(time),
        None => i.to_world,
    };
    scene.instances.iter().map(at).collect()
}

#[test]
fn nodes_stand_where_they_are_at_a_time() {
    let child = DMat4::from_translation(DVec3::Y);
    for time in [0.0, 0.5, 1.3, 2.0, 7.0] {
        let loaded = read(&document(&[]), Some([time, 0.0])).unwrap();
        assert_eq!(told(&loaded), [""; 0]);
        let scene = loaded.scene;
        assert!(!scene.moves());
        let found = places(&scene, 0.0);
        assert!(
            found[0].abs_diff_eq(node(time), 1e-6),
            "{time}: {}",
            found[0]
        );
        assert!(found[1].abs_diff_eq(node(time) * child, 1e-6), "{time}");
        let eye = scene.camera.to_world.w_axis.truncate();
        assert!(
            eye.abs_diff_eq(node(time).w_axis.truncate(), 1e-6),
            "{time}: {eye}"
        );
    }
}

#[test]
fn without_a_time_nodes_stand_where_the_file_puts_them() {
    let loaded = read(&document(&[]), None).unwrap();
    let animated = "animations are left out: 1 node moves within 2.000 s; `--at SECONDS` renders a moment of them";
    assert_eq!(told(&loaded), [animated]);
    assert_eq!(places(&loaded.scene, 0.0)[0], DMat4::IDENTITY);
    let still = document(&[("\"animations\"", "\"unknown\"")]);
    assert_eq!(told(&read(&still, None).unwrap()), [""; 0]);
    let loaded = read(&still, Some([1.0, 0.0])).unwrap();
    assert_eq!(
        told(&loaded),
        ["the file has no animation: it is the same at all times"]
    );
}

#[test]
fn other_formats_have_no_animations() {
    let mut options = LoadOptions::default();
    options.exposure = Some(Exposure::default());
    let text = b"WorldBegin Shape \"sphere\"".to_vec();
    let loaded = load_bytes("a.pbrt".as_ref(), text, &options).unwrap();
    let last = loaded.warnings.last().unwrap().message();
    assert!(last.contains("only glTF files have animations"), "{last}");
}

#[test]
fn nodes_and_cameras_move_while_the_shutter_is_open() {
    let loaded = read(&document(&[]), Some([0.5, 1.0])).unwrap();
    assert_eq!(told(&loaded), [""; 0]);
    let scene = loaded.scene;
    let child = DMat4::from_translation(DVec3::Y);
    for part in [0.0, 0.25, 1.0] {
        let found = places(&scene, part);
        assert!(
            found[0].abs_diff_eq(node(0.5 + part), 1e-6),
            "{part}: {}",
            found[0]
        );
        // The child's two ends are exact; in between it runs straight.
        if part == 0.0 || part == 1.0 {
            assert!(
                found[1].abs_diff_eq(node(0.5 + part) * child, 1e-6),
                "{part}"
            );
        }
    }
    let motion = scene.camera.motion.unwrap();
    let eye = Trajectory::new(&scene.camera.to_world, &motion)
        .at(0.5)
        .w_axis
        .truncate();
    assert!(eye.abs_diff_eq(DVec3::new(2.0, 0.0, 0.0), 1e-6), "{eye}");
    // After its end nothing moves.
    assert!(
        !read(&document(&[]), Some([2.0, 1.0]))
            .unwrap()
            .scene
            .moves()
    );
}

#[test]
fn what_cannot_move_is_told() {
    let glows = [
        (
            "\"attributes\": {\"POSITION\": 0}",
            "\"attributes\": {\"POSITION\": 0}, \"material\": 0",
        ),
        (
            "\"meshes\"",
            "\"materials\": [{\"emissiveFactor\": [1, 1, 1]}], \"meshes\"",
        ),
    ];
    let loaded = read(&document(&glows), Some([0.0, 1.0])).unwrap();
    let stays =
        |what: &str| format!("{what}: it moves and emits light: it is rendered where it starts");
    assert_eq!(told(&loaded), [stays("nodes[0]"), stays("nodes[1]")]);
    assert!(loaded.scene.instances.iter().all(|i| i.motion.is_none()));

    let lit = [
        (
            "{\"camera\": 0}",
            "{\"extensions\": {\"KHR_lights_punctual\": {\"light\": 0}}}",
        ),
        (
            "\"meshes\"",
            "\"extensions\": {\"KHR_lights_punctual\": {\"lights\": [{\"type\": \"point\"}]}}, \"meshes\"",
        ),
    ];
    let loaded = read(&document(&lit), Some([1.0, 1.0])).unwrap();
    let light = "nodes[2]: the light moves; it is rendered where it starts";
    assert!(told(&loaded).contains(&light), "{:?}", told(&loaded));
    let Light::Point { position, .. } = loaded.scene.lights[0] else {
        panic!("{:?}", loaded.scene.lights)
    };
    assert!((position[0] - 2.0).abs() < 1e-6, "{position:?}");

    let weights = document(&[("\"path\": \"rotation\"", "\"path\": \"weights\"")]);
    let loaded = read(&weights, Some([1.0, 0.0])).unwrap();
    assert_eq!(
        told(&loaded),
        ["animations[0].channels[1]: nodes[0] has no morph targets"]
    );
    let twice = document(&[("\"path\": \"rotation\"", "\"path\": \"translation\"")]);
    let loaded = read(&twice, Some([1.0, 0.0])).unwrap();
    assert_eq!(
        told(&loaded),
        [
            "animations[0].channels[1]: another channel animates this part of nodes[0]: it is left out"
        ]
    );
    let fixed = document(&[(
        "{\"mesh\": 0, \"children\"",
        "{\"matrix\": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1], \"mesh\": 0, \"children\"",
    )]);
    let loaded = read(&fixed, Some([1.0, 0.0])).unwrap();
    assert_eq!(
        told(&loaded)[0],
        "animations[0].channels[0]: nodes[0] has a matrix, which cannot be animated: it stands still"
    );
    assert_eq!(places(&loaded.scene, 0.0)[0], DMat4::IDENTITY);
}

#[test]
fn damaged_keyframes_are_refused_where_they_are() {
    for (change, message) in [
        (
            ("\"output\": 3", "\"output\": 2"),
            "animations[0].samplers[1].output: expected vectors of 4 numbers",
        ),
        (
            (
                "\"interpolation\": \"LINEAR\"",
                "\"interpolation\": \"CUBICSPLINE\"",
            ),
            "animations[0].samplers[1]: expected 6 values for 2 times, found 2",
        ),
        (
            ("\"input\": 1, \"output\": 2", "\"input\": 2, \"output\": 2"),
            "animations[0].samplers[0]: expected finite times that ascend",
        ),
    ] {
        // Times 0, 4 ascend; made to fall, by their order.
        let text = document(&[change]);
        let text = text.replace("\"input\": 2, \"output\": 2", "\"input\": 0, \"output\": 0");
        let error = read(&text, Some([1.0, 0.0])).unwrap_err();
        assert!(error.message().contains(message), "{}", error.message());
        assert!(error.place().line() > 10, "{}", error.place());
        // Without a time they are not read.
        read(&text, None).unwrap();
    }
}

/// Where the first node is after half a second, and what is told, with the second of two animations changed.
fn played(
    second: impl Fn(&mut serde_json::Value),
    animation: Option<&str>,
) -> Result<(f64, Vec<String>), SceneError> {
    let mut root: serde_json::Value = serde_json::from_str(&document(&[])).unwrap();
    let mut other = root["animations"][0].clone();
    root["animations"][0]["name"] = "walk".into();
    other["name"] = "run".into();
    other["samplers"][0]["interpolation"] = "STEP".into();
    second(&mut other);
    root["animations"].as_array_mut().unwrap().push(other);
    let mut options = LoadOptions::default();
    options.exposure = Some(Exposure {
        time: Duration::from_millis(500),
        shutter: Duration::ZERO,
    });
    options.animation = animation.map(str::to_owned);
    let loaded = load_bytes("a.gltf".as_ref(), root.to_string().into_bytes(), &options)?;
    let told = told(&loaded).into_iter().map(str::to_owned).collect();
    Ok((places(&loaded.scene, 0.0)[0].w_axis.x, told))
}

#[test]
fn one_of_several_animations_is_played() {
    let same = |_: &mut serde_json::Value| {};
    let (x, told) = played(same, None).unwrap();
    assert_eq!(x, 1.0);
    let first = "several animations move the same (\"walk\", \"run\"): the first is played; \
                 `--animation NAME` plays another";
    assert_eq!(told, [first]);
    for (animation, expected) in [("walk", 1.0), ("0", 1.0), ("run", 0.0), ("1", 0.0)] {
        let none: Vec<String> = Vec::new();
        assert_eq!(played(same, Some(animation)).unwrap(), (expected, none));
    }
    let error = played(same, Some("swim")).unwrap_err().to_string();
    assert!(
        error.contains("expected one of \"walk\", \"run\""),
        "{error}"
    );
}

#[test]
fn animations_of_different_nodes_play_together() {
    let child = |other: &mut serde_json::Value| {
        for channel in other["channels"].as_array_mut().unwrap() {
            channel["target"]["node"] = 1.into();
        }
    };
    let (x, told) = played(child, None).unwrap();
    assert_eq!(x, 1.0);
    assert!(told.is_empty(), "{told:?}");
}

#[test]
fn damaged_targets_are_named() {
    for (from, to, expected) in [
        (
            "\"node\": 0, \"path\": \"rotation\"",
            "\"node\": 7, \"path\": \"rotation\"",
            "animations[0].channels[1].target.node",
        ),
        (
            "\"path\": \"rotation\"",
            "\"path\": \"rotatiom\"",
            "animations[0].channels[1].target.path",
        ),
    ] {
        let text = document(&[(from, to)]);
        for exposure in [None, Some([0.5, 0.0])] {
            let error = read(&text, exposure).unwrap_err().to_string();
            assert!(error.contains(expected), "{error}");
        }
    }
    // An extension's own paths are no mistakes.
    let pointer = document(&[
        ("\"path\": \"rotation\"", "\"path\": \"pointer\""),
        (
            "\"scenes\"",
            "\"extensionsUsed\": [\"KHR_animation_pointer\"], \"scenes\"",
        ),
    ]);
    let loaded = read(&pointer, Some([2.0, 0.0])).unwrap();
    assert!(told(&loaded)[0].contains("KHR_animation_pointer"));
    assert_eq!(places(&loaded.scene, 0.0)[0].w_axis.x, 4.0);
}
