//! `render.gpu`: text and arrays that every WebGPU device takes.

use naga::valid::{Capabilities, ValidationFlags, Validator};
use serde_json::json;
use specula_gpu::SceneProgram;
use specula_render::{PreparedScene, RenderOptions};
use specula_scene::builtin;
use specula_studio::Studio;

/// The lengths of nodes and triangles: 6 and 3 vectors.
const SIZES: [(&str, usize); 4] = [("tables", 4), ("nodes", 96), ("packets", 48), ("words", 4)];

#[test]
fn what_a_page_gets_is_the_program_of_the_scene() {
    let studio = Studio::default();
    let ask =
        |request: serde_json::Value| studio.try_answer(request.to_string().as_bytes()).unwrap();
    let camera =
        json!({"eye": [0, -20, 8], "target": [0, 0, 2], "up": [0, 0, 1], "fovDegrees": 20});
    for (session, scene) in (1..).zip(["orbs", "ball", "row", "furnace"]) {
        let opened = ask(
            json!({"ask": "render.open", "scene": scene, "width": 64, "height": 32, "seed": 9,
            "maxDepth": 5}),
        );
        assert_eq!(opened.value()["missing"], json!([]), "{scene}");
        let answer = ask(json!({"ask": "render.gpu", "session": session}));
        let told = answer.value();
        assert_eq!([&told["width"], &told["height"]], [&json!(64), &json!(32)]);
        assert_eq!(
            [&told["settings"][0], &told["settings"][1]],
            [&json!(9), &json!(5)]
        );
        for (name, size) in SIZES {
            let (shape, bytes) = answer.array(name).unwrap();
            assert!(
                shape == [bytes.len()] && !bytes.is_empty(),
                "{scene}: {name}"
            );
            let is_whole = bytes.len() % size == 0 || *bytes == [0; 16];
            assert!(is_whole, "{scene}: {name} of {}", bytes.len());
        }
        let text = told["wgsl"].as_str().unwrap().to_owned();
        let module = naga::front::wgsl::parse_str(&text).unwrap();
        let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
        validator
            .validate(&module)
            .unwrap_or_else(|e| panic!("{scene}: {e:?}"));
        // Another camera is other words and constants: nodes and triangles stay.
        ask(json!({"ask": "render.change", "session": session, "camera": camera}));
        let moved = ask(json!({"ask": "render.gpu", "session": session}));
        assert_ne!(moved.array("words"), answer.array("words"));
        assert_eq!(moved.array("packets"), answer.array("packets"));
        assert_eq!(moved.value()["wgsl"], text, "one text for all cameras");
    }
}

#[test]
fn it_is_that_of_the_library() {
    let scene = builtin::orbs();
    let options = RenderOptions {
        resolution: Some([40, 24]),
        crop: Some([0, 40, 0, 24]),
        ..RenderOptions::from_scene(&scene)
    };
    let prepared = PreparedScene::new(&scene, &options).unwrap();
    let program = SceneProgram::new(&prepared, &options).unwrap();
    let studio = Studio::default();
    let request = json!({"ask": "render.open", "scene": "orbs", "width": 40, "height": 24});
    studio.try_answer(request.to_string().as_bytes()).unwrap();
    let request = json!({"ask": "render.gpu", "session": 1});
    let answer = studio.try_answer(request.to_string().as_bytes()).unwrap();
    assert_eq!(answer.value()["wgsl"], program.text().unwrap());
    assert_eq!(answer.value()["settings"], json!(program.settings()));
    for ((name, _), array) in SIZES.into_iter().zip(program.arrays()) {
        assert!(answer.array(name).unwrap().1 == array, "{name}");
    }
}
