//! Renders as pages ask for them, beside the library's own.

mod sessions;

use serde_json::json;
use sessions::{ask, colour, floats, open, refused, value};
use specula_render::picture::read_exr;
use specula_render::{PreparedScene, RenderOptions, Renderer};
use specula_scene::builtin;
use specula_studio::{SceneFrom, Studio};

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
    // A page has no files beside the text.
    assert!(!loaded.unwrap().scene.meshes.is_empty());
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
