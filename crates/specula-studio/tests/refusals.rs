//! Requests that are refused, and extreme ones that are not: none panics.

mod sessions;

use serde_json::{Value, json};
use sessions::{ask, colour, open, refused, value};
use specula_studio::Studio;

/// Requests, `#` for the number of an open render, each with words of its refusal.
const WRONG: &[(&str, &str)] = &[
    (r#"{"ask": "render.open"}"#, "scene"),
    (r#"{"ask": "render.open", "scene": "none"}"#, "scene"),
    (
        r#"{"ask": "render.open", "scene": "ball", "width": 0}"#,
        "width",
    ),
    (
        r#"{"ask": "render.open", "scene": "ball", "width": 4000000000, "height": 4000000000}"#,
        "width",
    ),
    (
        r#"{"ask": "render.open", "scene": "ball", "width": 2001, "height": 2000}"#,
        "4000000",
    ),
    (
        r#"{"ask": "render.open", "scene": "ball", "width": -1}"#,
        "-1",
    ),
    (
        r#"{"ask": "render.open", "scene": "ball", "seed": 9007199254740992}"#,
        "seed",
    ),
    (
        r#"{"ask": "render.open", "scene": "ball", "maxDepth": 1048576}"#,
        "maxDepth",
    ),
    (
        r#"{"ask": "render.open", "scene": "ball", "energy": "all"}"#,
        "energy",
    ),
    (
        r#"{"ask": "render.open", "scene": "ball", "sampler": "best"}"#,
        "sampler",
    ),
    (
        r#"{"ask": "render.open", "scene": "ball", "edits": [{"material": 99, "text": "diffuse"}]}"#,
        "edits",
    ),
    (
        r#"{"ask": "render.open", "scene": "ball", "edits": [{"material": 0, "text": "wood"}]}"#,
        "edits",
    ),
    (
        r#"{"ask": "render.open", "scene": "ball", "edits": [{"material": true, "text": "wood"}]}"#,
        "edits",
    ),
    (
        r#"{"ask": "render.open", "scene": "ball", "colour": 1}"#,
        "colour",
    ),
    (
        r#"{"ask": "render.advance", "session": #}"#,
        "seconds or samples",
    ),
    (
        r#"{"ask": "render.advance", "session": #, "seconds": 1e9}"#,
        "seconds",
    ),
    (
        r#"{"ask": "render.advance", "session": #, "seconds": -1}"#,
        "seconds",
    ),
    (
        r#"{"ask": "render.advance", "session": #, "samples": 0}"#,
        "samples",
    ),
    (
        r#"{"ask": "render.advance", "session": #, "samples": 1000000}"#,
        "samples",
    ),
    (
        r#"{"ask": "render.advance", "session": #, "samples": 1, "wants": ["beauty"]}"#,
        "beauty",
    ),
    (
        r#"{"ask": "render.pick", "session": #, "x": 24, "y": 0}"#,
        "x: ",
    ),
    (
        r#"{"ask": "render.pick", "session": #, "x": 0, "y": -1}"#,
        "y: ",
    ),
    (
        r#"{"ask": "render.pick", "session": 99999999, "x": 0, "y": 0}"#,
        "session",
    ),
    (
        r#"{"ask": "render.save", "session": #, "format": "gif"}"#,
        "gif",
    ),
    (
        r#"{"ask": "render.save", "session": #, "format": "png"}"#,
        "no samples",
    ),
    (r#"{"ask": "render.nothing"}"#, "render.nothing"),
];

/// Eye, target, up and field of view, each with the field that is refused.
const WRONG_VIEWS: &[(&str, &str)] = &[
    ("[0, 0, 0], [0, 0, 0], [0, 0, 1], 40", "camera.target"),
    ("[0, 0, 0], [0, 0, 1], [0, 0, 1], 40", "camera.up"),
    ("[1e300, 0, 0], [0, 0, 0], [0, 0, 1], 40", "camera.eye"),
    ("[1, 0, 0], [0, 0, 0], [0, 0, 1], 180", "fovDegrees"),
];

#[test]
fn wrong_requests_are_refused_with_the_fields_name() {
    let studio = Studio::default();
    let session = open(&studio, json!({}));
    for (request, words) in WRONG {
        let request = request.replace('#', &session.to_string());
        refused(&studio, serde_json::from_str(&request).unwrap(), words);
    }
    for (view, words) in WRONG_VIEWS {
        let [eye, target, up, fov]: [Value; 4] =
            serde_json::from_str(&format!("[{view}]")).unwrap();
        let camera = json!({"eye": eye, "target": target, "up": up, "fovDegrees": fov});
        let change = json!({"ask": "render.change", "session": session, "camera": camera});
        refused(&studio, change, words);
        refused(
            &studio,
            json!({"ask": "render.open", "scene": "ball", "camera": camera}),
            words,
        );
    }
    // What was refused changed nothing.
    let other = open(&studio, json!({}));
    assert_eq!(colour(&studio, session, 1), colour(&studio, other, 1));
}

#[test]
fn the_ninth_render_is_refused_until_one_is_closed() {
    let studio = Studio::default();
    let all: Vec<u64> = (0..8).map(|_| open(&studio, json!({}))).collect();
    let ninth = json!({"ask": "render.open", "scene": "ball", "width": 8, "height": 8});
    refused(&studio, ninth.clone(), "close another page");
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
