//! Renders as pages ask for them: beside the library's own, from one end of the request's fields to the other.

use serde_json::{Value, json};
use specula_render::picture::read_exr;
use specula_render::{PreparedScene, RenderOptions, Renderer};
use specula_scene::builtin;
use specula_studio::{Answer, AskError, SceneFrom, Studio};

fn ask(studio: &Studio, request: Value) -> Result<Answer, AskError> {
    studio.try_answer(request.to_string().as_bytes())
}

fn value(studio: &Studio, request: Value) -> Value {
    let said = request.to_string();
    let answer = ask(studio, request).unwrap_or_else(|e| panic!("{said}: {e}"));
    answer.value().clone()
}

/// Opens a render and returns its number.
fn open(studio: &Studio, more: Value) -> u64 {
    let mut request =
        json!({"ask": "render.open", "scene": "ball", "width": 24, "height": 20, "maxDepth": 4});
    merge(&mut request, more);
    value(studio, request)["session"].as_u64().unwrap()
}

fn merge(into: &mut Value, more: Value) {
    if let (Value::Object(into), Value::Object(more)) = (into, more) {
        into.extend(more);
    }
}

fn colour(studio: &Studio, session: u64, samples: u32) -> Vec<f32> {
    let request = json!({"ask": "render.advance", "session": session, "samples": samples, "wants": ["colour"]});
    let answer = ask(studio, request).unwrap();
    floats(answer.array("colour").unwrap().1)
}

fn floats(bytes: &[u8]) -> Vec<f32> {
    bytemuck::pod_collect_to_vec(bytes)
}

fn refused(studio: &Studio, request: Value, words: &str) {
    let said = request.to_string();
    let error = ask(studio, request)
        .map(|_| ())
        .expect_err(&said)
        .to_string();
    assert!(error.contains(words), "{said}: {error}");
}

#[test]
fn samples_are_those_of_the_library_however_they_are_asked_for() {
    let mut scene = builtin::orbs();
    scene.film.crop = [0, 40, 0, 24];
    let studio = Studio::default();
    studio.add_scene("given", "Given", SceneFrom::Given, scene.clone());
    let options = RenderOptions {
        resolution: Some([40, 24]),
        crop: Some([0, 40, 0, 24]),
        seed: 7,
        ..RenderOptions::from_scene(&scene)
    };
    let prepared = PreparedScene::new(&scene, &options).unwrap();
    let mut renderer = Renderer::new(&prepared, options);
    renderer.render_pass(6, &false.into());
    let expected: Vec<f32> = renderer
        .film()
        .colour()
        .iter()
        .flat_map(|c| c.to_array())
        .collect();
    for passes in [&[6][..], &[1, 2, 3]] {
        let session = open(
            &studio,
            json!({"scene": "given", "width": 40, "height": 24, "seed": 7, "maxDepth": 8}),
        );
        let mut shown = Vec::new();
        for &samples in passes {
            shown = colour(&studio, session, samples);
        }
        assert_eq!(shown, expected, "{passes:?}");
    }
}

#[test]
fn time_is_kept_and_one_sample_at_least_is_taken() {
    let studio = Studio::default();
    let session = open(&studio, json!({}));
    let told = value(
        &studio,
        json!({"ask": "render.advance", "session": session, "seconds": 0}),
    );
    assert_eq!(told["samples"], 1);
    let told = value(
        &studio,
        json!({"ask": "render.advance", "session": session, "seconds": 0.3}),
    );
    let seconds = told["seconds"].as_f64().unwrap();
    assert!(
        told["samples"].as_u64().unwrap() > 1 && seconds > 0.05 && seconds < 3.0,
        "{told}"
    );
    assert!(
        told["rays"].as_u64().unwrap() > 480 && told["invalid"] == 0,
        "{told}"
    );
    assert!(told["noise"].as_f64().unwrap() > 0.0);
}

#[test]
fn every_layer_comes_where_it_is_wanted() {
    let studio = Studio::default();
    let session = open(&studio, json!({}));
    let layers = [
        ("colour", 3),
        ("variance", 3),
        ("albedo", 3),
        ("normal", 3),
        ("depth", 1),
    ];
    let names: Vec<&str> = layers.iter().map(|l| l.0).collect();
    let request =
        json!({"ask": "render.advance", "session": session, "samples": 2, "wants": names});
    let answer = ask(&studio, request).unwrap();
    for (name, channels) in layers {
        let (shape, bytes) = answer.array(name).unwrap();
        let expected: &[usize] = if channels == 3 {
            &[20, 24, 3]
        } else {
            &[20, 24]
        };
        assert_eq!(shape, expected, "{name}");
        let values = floats(bytes);
        assert_eq!(values.len(), 20 * 24 * channels);
        assert!(
            values.iter().all(|v| v.is_finite()) && values.iter().any(|&v| v != 0.0),
            "{name}"
        );
    }
    let request = json!({"ask": "render.advance", "session": session, "samples": 1});
    assert!(ask(&studio, request).unwrap().array("colour").is_none());
}

#[test]
fn the_same_seed_is_the_same_picture_and_another_is_not() {
    let studio = Studio::default();
    let [a, b, c] = [1_u64, 1, 1 + (1 << 40)].map(|seed| {
        let session = open(&studio, json!({"seed": seed}));
        colour(&studio, session, 3)
    });
    assert_eq!(a, b);
    assert_ne!(a, c);
}

#[test]
fn another_camera_and_back_begins_anew_with_the_same_picture() {
    let studio = Studio::default();
    for scene in ["ball", "orbs", "row", "furnace"] {
        let opened = value(
            &studio,
            json!({"ask": "render.open", "scene": scene, "width": 24, "height": 20}),
        );
        let session = opened["session"].as_u64().unwrap();
        let first = colour(&studio, session, 2);
        let mut moved = opened["camera"].clone();
        moved["eye"][0] = json!(moved["eye"][0].as_f64().unwrap() + 3.0);
        let change = |camera: &Value| {
            let request = json!({"ask": "render.change", "session": session, "camera": camera});
            value(&studio, request)
        };
        assert_eq!(change(&moved)["camera"], moved);
        assert_ne!(colour(&studio, session, 2), first, "{scene}");
        assert_eq!(change(&opened["camera"])["camera"], opened["camera"]);
        assert_eq!(colour(&studio, session, 2), first, "{scene}");
        // As it was moved at once, or opened there.
        change(&moved);
        let request = json!({"ask": "render.open", "scene": scene, "width": 24, "height": 20, "camera": moved});
        let other = value(&studio, request)["session"].as_u64().unwrap();
        assert_eq!(
            colour(&studio, session, 3),
            colour(&studio, other, 3),
            "{scene}"
        );
        for id in [session, other] {
            value(&studio, json!({"ask": "render.close", "session": id}));
        }
    }
}

#[test]
fn sizes_change_without_preparing_anew() {
    let studio = Studio::default();
    let session = open(&studio, json!({}));
    colour(&studio, session, 1);
    let told = value(
        &studio,
        json!({"ask": "render.change", "session": session, "width": 30, "height": 10}),
    );
    assert_eq!([&told["width"], &told["height"]], [&json!(30), &json!(10)]);
    let other = open(&studio, json!({"width": 30, "height": 10}));
    assert_eq!(colour(&studio, session, 2), colour(&studio, other, 2));
    // One side follows the other, in the scene's proportions.
    let told = value(
        &studio,
        json!({"ask": "render.open", "scene": "orbs", "width": 96}),
    );
    assert_eq!([&told["width"], &told["height"]], [&json!(96), &json!(40)]);
}

#[test]
fn materials_change_the_picture_and_come_back() {
    let studio = Studio::default();
    let session = open(&studio, json!({}));
    let first = colour(&studio, session, 2);
    let edit = |text: &str| {
        let edits = json!([{"material": 0, "text": text}]);
        value(
            &studio,
            json!({"ask": "render.change", "session": session, "edits": edits}),
        )
    };
    let told = edit("diffuse 0.02");
    assert_eq!(told["materials"][0]["kind"], "diffuse");
    assert_eq!(told["materials"][0]["text"], "diffuse 0.02");
    assert_eq!(told["materials"][1]["text"], "diffuse 0.35");
    let dark = colour(&studio, session, 2);
    let sum = |picture: &[f32]| picture.iter().sum::<f32>();
    assert!(
        sum(&dark) < 0.97 * sum(&first),
        "{} {}",
        sum(&dark),
        sum(&first)
    );
    let told = edit("");
    assert_eq!(told["materials"][0]["text"], "conductor Au alpha 0.2");
    assert_eq!(colour(&studio, session, 2), first);
    for change in [json!({"energy": "none"}), json!({"sampler": "heitz"})] {
        let mut request = json!({"ask": "render.change", "session": session});
        merge(&mut request, change.clone());
        value(&studio, request);
        assert_ne!(colour(&studio, session, 2), first, "{change}");
    }
}

#[test]
fn what_is_picked_is_what_is_there() {
    let studio = Studio::default();
    let session = open(&studio, json!({}));
    let pick = |x: f64, y: f64| {
        value(
            &studio,
            json!({"ask": "render.pick", "session": session, "x": x, "y": y}),
        )
    };
    let hit = &pick(12.0, 10.0)["hit"];
    assert_eq!(
        [&hit["material"], &hit["name"]],
        [&json!(0), &json!("ball")]
    );
    let point: Vec<f64> = (0..3).map(|i| hit["point"][i].as_f64().unwrap()).collect();
    let radius = (point[0].powi(2) + point[1].powi(2) + (point[2] - 1.0).powi(2)).sqrt();
    assert!((radius - 1.0).abs() < 1e-4, "{hit}");
    assert!(
        (hit["distance"].as_f64().unwrap() - 5.5).abs() < 1.0,
        "{hit}"
    );
    let floor = &pick(12.0, 19.9)["hit"];
    assert_eq!(floor["name"], "floor");
    assert_eq!(floor["normal"], json!([0.0, 0.0, 1.0]));
    let opened = value(
        &studio,
        json!({"ask": "render.open", "scene": "furnace", "width": 48}),
    );
    let furnace = opened["session"].clone();
    let sky = value(
        &studio,
        json!({"ask": "render.pick", "session": furnace, "x": 0, "y": 0}),
    );
    assert_eq!(sky["hit"], Value::Null);
}

#[test]
fn a_render_beside_itself_has_no_error_and_beside_another_has() {
    let studio = Studio::default();
    let [a, b] = [1, 2].map(|seed| open(&studio, json!({"seed": seed})));
    refused(
        &studio,
        json!({"ask": "render.compare", "session": a, "reference": b}),
        "no samples",
    );
    colour(&studio, a, 2);
    colour(&studio, b, 2);
    let compare = |reference: u64| {
        ask(
            &studio,
            json!({"ask": "render.compare", "session": a, "reference": reference}),
        )
        .unwrap()
    };
    let same = compare(a);
    for name in ["rmse", "relMse", "blockRmse", "flip"] {
        assert_eq!(same.value()[name], 0.0, "{name}");
    }
    let (shape, error) = same.array("error").unwrap();
    assert!(shape == [20, 24] && floats(error).iter().all(|&e| e == 0.0));
    let other = compare(b);
    for name in ["rmse", "relMse", "blockRmse", "flip"] {
        assert!(other.value()[name].as_f64().unwrap() > 0.0, "{name}");
    }
}

#[test]
fn pictures_are_saved_and_scenes_are_written() {
    let studio = Studio::default();
    let session = open(
        &studio,
        json!({"edits": [{"material": "ball", "text": "conductor Cu alpha 0.3"}]}),
    );
    let shown = colour(&studio, session, 2);
    let save = |format: &str| {
        ask(
            &studio,
            json!({"ask": "render.save", "session": session, "format": format}),
        )
        .unwrap()
    };
    let exr = save("exr");
    assert_eq!(exr.value()["name"], "ball.exr");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ball.exr");
    std::fs::write(&path, exr.array("file").unwrap().1).unwrap();
    let read: Vec<f32> = read_exr(&path)
        .unwrap()
        .colour
        .iter()
        .flat_map(|c| c.to_array())
        .collect();
    assert_eq!(read, shown);
    assert_eq!(&save("png").array("file").unwrap().1[1..4], b"PNG");
    let text = |format: &str| {
        let told = value(
            &studio,
            json!({"ask": "render.scene", "session": session, "format": format}),
        );
        told["text"].as_str().unwrap().to_owned()
    };
    let command = text("command");
    let expected = "# ball.pbrt: the scene as pbrt-v4 has it.\nspecula render ball.pbrt --material 'ball=conductor Cu alpha 0.3' --resolution 24x20 --max-depth 4";
    assert_eq!(command, expected);
    let pbrt = text("pbrt");
    let loaded = specula_scene::load_bytes(
        "ball.pbrt".as_ref(),
        pbrt.clone().into(),
        &Default::default(),
    );
    assert!(
        pbrt.contains("conductor") && pbrt.contains("\"integer xresolution\" [ 24 ]"),
        "{pbrt}"
    );
    // Its meshes are beside the file, which a page does not have.
    let said = loaded.map(|_| ()).unwrap_err().to_string();
    assert!(said.contains("mesh-0.ply"), "{said}");
}

#[test]
fn the_ninth_render_is_refused_until_one_is_closed() {
    let studio = Studio::default();
    let all: Vec<u64> = (0..8).map(|_| open(&studio, json!({}))).collect();
    let ninth = json!({"ask": "render.open", "scene": "ball", "width": 8, "height": 8});
    refused(&studio, ninth.clone(), "close one");
    value(&studio, json!({"ask": "render.close", "session": all[3]}));
    refused(
        &studio,
        json!({"ask": "render.close", "session": all[3]}),
        "no render",
    );
    refused(
        &studio,
        json!({"ask": "render.advance", "session": all[3], "samples": 1}),
        "no render",
    );
    value(&studio, ninth);
}

#[test]
fn renders_advance_side_by_side() {
    let studio = Studio::default();
    let sessions: Vec<u64> = (0..3)
        .map(|seed| open(&studio, json!({"seed": seed})))
        .collect();
    let pictures: Vec<Vec<f32>> = std::thread::scope(|scope| {
        let run = |&id: &u64| {
            scope.spawn({
                let studio = &studio;
                move || colour(studio, id, 4)
            })
        };
        let threads: Vec<_> = sessions.iter().map(run).collect();
        threads.into_iter().map(|t| t.join().unwrap()).collect()
    });
    for (seed, picture) in (0..).zip(pictures) {
        let session = open(&studio, json!({"seed": seed}));
        assert_eq!(colour(&studio, session, 4), picture);
    }
}

#[test]
fn scenes_are_listed_added_and_removed() {
    let studio = Studio::default().with_files(true);
    let told = value(&studio, json!({"ask": "render.scenes"}));
    assert_eq!(told["opensFiles"], true);
    assert_eq!(
        told["scenes"][0],
        json!({"name": "orbs", "title": "Orbs of metal", "from": "built-in"})
    );
    studio.add_scene("mine", "Mine", SceneFrom::Dropped, builtin::orbs());
    let told = value(&studio, json!({"ask": "render.scenes"}));
    let all = told["scenes"].as_array().unwrap();
    assert_eq!(
        all.last().unwrap(),
        &json!({"name": "mine", "title": "Mine", "from": "dropped"})
    );
    let session = open(&studio, json!({"scene": "mine"}));
    assert!(studio.remove_scene("mine") && !studio.remove_scene("mine"));
    colour(&studio, session, 1);
    refused(
        &studio,
        json!({"ask": "render.open", "scene": "mine"}),
        "there is no 'mine'",
    );
}

#[test]
fn wrong_requests_are_refused_with_the_fields_name() {
    let studio = Studio::default();
    let session = open(&studio, json!({}));
    let camera = |eye: Value, target: Value, up: Value, fov: Value| json!({"eye": eye, "target": target, "up": up, "fovDegrees": fov});
    let zero = || json!([0, 0, 0]);
    let cases = [
        (json!({"ask": "render.open"}), "scene"),
        (json!({"ask": "render.open", "scene": "none"}), "scene"),
        (
            json!({"ask": "render.open", "scene": "ball", "width": 0}),
            "width",
        ),
        (
            json!({"ask": "render.open", "scene": "ball", "width": 4_000_000_000_u32, "height": 4_000_000_000_u32}),
            "width",
        ),
        (
            json!({"ask": "render.open", "scene": "ball", "width": 2001, "height": 2000}),
            "4000000",
        ),
        (
            json!({"ask": "render.open", "scene": "ball", "width": -1}),
            "-1",
        ),
        (
            json!({"ask": "render.open", "scene": "ball", "seed": 1_u64 << 53}),
            "seed",
        ),
        (
            json!({"ask": "render.open", "scene": "ball", "maxDepth": 1 << 20}),
            "maxDepth",
        ),
        (
            json!({"ask": "render.open", "scene": "ball", "energy": "all"}),
            "energy",
        ),
        (
            json!({"ask": "render.open", "scene": "ball", "sampler": "best"}),
            "sampler",
        ),
        (
            json!({"ask": "render.open", "scene": "ball", "edits": [{"material": 99, "text": "diffuse"}]}),
            "edits",
        ),
        (
            json!({"ask": "render.open", "scene": "ball", "edits": [{"material": 0, "text": "wood"}]}),
            "edits",
        ),
        (
            json!({"ask": "render.open", "scene": "ball", "edits": [{"material": true, "text": "wood"}]}),
            "edits",
        ),
        (
            json!({"ask": "render.open", "scene": "ball", "colour": 1}),
            "colour",
        ),
        (
            json!({"ask": "render.open", "scene": "ball", "camera": camera(zero(), zero(), zero(), json!(40))}),
            "camera.target",
        ),
        (
            json!({"ask": "render.change", "session": session, "camera": camera(zero(), json!([0, 0, 1]), json!([0, 0, 1]), json!(40))}),
            "camera.up",
        ),
        (
            json!({"ask": "render.change", "session": session, "camera": camera(json!([1e300, 0, 0]), zero(), zero(), json!(40))}),
            "camera.eye",
        ),
        (
            json!({"ask": "render.change", "session": session, "camera": camera(json!([1, 0, 0]), zero(), json!([0, 0, 1]), json!(180))}),
            "fovDegrees",
        ),
        (
            json!({"ask": "render.advance", "session": session}),
            "seconds or samples",
        ),
        (
            json!({"ask": "render.advance", "session": session, "seconds": 1e9}),
            "seconds",
        ),
        (
            json!({"ask": "render.advance", "session": session, "seconds": -1}),
            "seconds",
        ),
        (
            json!({"ask": "render.advance", "session": session, "samples": 0}),
            "samples",
        ),
        (
            json!({"ask": "render.advance", "session": session, "samples": 1_000_000}),
            "samples",
        ),
        (
            json!({"ask": "render.advance", "session": session, "samples": 1, "wants": ["beauty"]}),
            "beauty",
        ),
        (
            json!({"ask": "render.pick", "session": session, "x": 24, "y": 0}),
            "x: ",
        ),
        (
            json!({"ask": "render.pick", "session": session, "x": 0, "y": -1}),
            "y: ",
        ),
        (
            json!({"ask": "render.pick", "session": 1_u64 << 50, "x": 0, "y": 0}),
            "session",
        ),
        (
            json!({"ask": "render.save", "session": session, "format": "gif"}),
            "gif",
        ),
        (
            json!({"ask": "render.save", "session": session, "format": "png"}),
            "no samples",
        ),
        (json!({"ask": "render.nothing"}), "render.nothing"),
    ];
    for (request, words) in cases {
        refused(&studio, request, words);
    }
    // What was refused changed nothing.
    let other = open(&studio, json!({}));
    assert_eq!(colour(&studio, session, 1), colour(&studio, other, 1));
}

#[test]
fn extreme_views_render_without_a_panic() {
    let studio = Studio::default();
    let session = open(&studio, json!({}));
    for (eye, target, fov) in [
        ([0.0, 0.0, 1.0], [0.0, 0.0, 2.0], 178.0),
        ([1e15, 0.0, 0.0], [-1e15, 0.0, 0.0], 0.001),
        ([1e-300, 0.0, 0.0], [0.0, 1e-300, 0.0], 40.0),
        ([0.0, -1.0, 0.0], [0.0, 1.0, 0.0], 90.0),
    ] {
        let camera =
            json!({"eye": eye, "target": target, "up": [0.3, 0.2, 1.0], "fovDegrees": fov});
        let request = json!({"ask": "render.change", "session": session, "camera": camera});
        if ask(&studio, request).is_ok() {
            let picture = colour(&studio, session, 1);
            assert!(picture.iter().all(|v| v.is_finite()), "{camera}");
        }
    }
}
