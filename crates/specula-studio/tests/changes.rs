//! Renders that are changed, and what is where in them.

mod sessions;

use serde_json::{Value, json};
use sessions::{colour, merge, open, value};
use specula_studio::Studio;

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
