//! No request makes the studio panic, and none of these takes long.

#![allow(clippy::unwrap_used, reason = "a panic is a failed test")]

use serde_json::{Value, json};
use specula_bsdf::math::Stream;
use specula_studio::Studio;

const ASKS: [&str; 15] = [
    "lobes.kinds",
    "lobes.parse",
    "lobes.slice",
    "lobes.grid",
    "lobes.albedo",
    "lobes.samples",
    "lobes.prove",
    "lobes.walks",
    "lobes.code",
    "samplers.describe",
    "samplers.regions",
    "samplers.samples",
    "samplers.histogram",
    "samplers.compare",
    "samplers.none",
];

fn answer(request: &Value) {
    let bytes = Studio::default().answer(request.to_string().as_bytes());
    let length = u32::from_le_bytes(bytes[..4].try_into().unwrap());
    let length = usize::try_from(length).unwrap();
    let said: Value = serde_json::from_slice(&bytes[4..4 + length]).unwrap();
    assert!(
        said["value"].is_object() || said["error"].as_str().is_some_and(|e| !e.is_empty()),
        "{request}: {said}"
    );
}

/// What a field may be given.
fn values() -> Vec<Value> {
    vec![
        json!(null),
        json!(true),
        json!(false),
        json!(0),
        json!(-1),
        json!(1),
        json!(2),
        json!(7),
        json!(1e308),
        json!(-1e-308),
        json!(4_294_967_296_u64),
        json!(u64::MAX),
        json!("x"),
        json!(""),
        json!("lambert"),
        json!("conductor alpha 0.0001 Au"),
        json!("multibounce-conductor alpha 10,0.0001"),
        json!("dielectric alpha 0.001 eta 1"),
        json!("dielectric alpha 10 eta 1000"),
        json!("layered Au thickness 1e300"),
        json!("gltf ior 0"),
        json!("principled roughness 0 clearcoat 1 clearcoat_gloss 1"),
        json!("conductor alpha nan"),
        json!("conductor alpha 0.3 conductor_eta 1e300 conductor_k 1e300"),
        json!("heitz"),
        json!("cap"),
        json!("bounded"),
        json!("exact"),
        json!("rust"),
        json!("pbrt"),
        json!([]),
        json!([0, 0]),
        json!([1e-4, 10]),
        json!([10, 10]),
        json!([0.3, 0.3]),
        json!([0, 0, 1]),
        json!([0, 0, -1]),
        json!([1, 0, 0]),
        json!([1, 0, 1e-300]),
        json!([0.999_999_9, 0, -4e-4]),
        json!([1e308, 1e308, 1e308]),
        json!(["a", 1, 2]),
        json!({}),
        json!({"towards": [0, 0, 1], "angle": 1e-9}),
        json!({"angle": 4, "towards": [1, 0, 0]}),
    ]
}

#[test]
fn random_fields_have_an_answer_or_an_error() {
    let fields = [
        "lobe", "wo", "azimuth", "count", "samples", "seed", "rows", "columns", "sphere",
        "sampler", "alpha", "lamp", "size", "language",
    ];
    let values = values();
    let mut stream = Stream::new(1);
    let mut below = |n: usize| -> usize {
        let share: f64 = stream.next();
        (0..n)
            .rev()
            .find(|i| share * n as f64 >= *i as f64)
            .unwrap_or(0)
    };
    for _ in 0..30_000 {
        let mut request = json!({"ask": ASKS[below(ASKS.len())]});
        for field in fields {
            if below(3) > 0 {
                request[field] = values[below(values.len())].clone();
            }
        }
        answer(&request);
    }
}

/// Requests with all their fields, each of them extreme.
#[test]
fn extreme_requests_have_an_answer_or_an_error() {
    let views = [
        json!([0, 0, 1]),
        json!([0, 0, -1]),
        json!([1, 0, 0]),
        json!([0, -1, 0]),
        json!([1, 0, 1e-300]),
        json!([1, 1e-9, -1e-9]),
        json!([0.6, 0, 0.8]),
        json!([0.8, 0, -0.6]),
    ];
    let alphas = [
        json!([1e-4, 1e-4]),
        json!([1e-4, 10]),
        json!([10, 10]),
        json!([1, 1]),
        json!([0.3, 0.2]),
    ];
    for wo in &views {
        for alpha in &alphas {
            answer(&json!({"ask": "samplers.regions", "alpha": alpha, "wo": wo, "count": 64}));
            answer(
                &json!({"ask": "samplers.compare", "alpha": alpha, "wo": wo, "count": 100, "lamp": {}}),
            );
            for sampler in ["heitz", "cap", "bounded", "exact"] {
                for (ask, more) in [
                    ("describe", json!({})),
                    ("samples", json!({"count": 100})),
                    ("histogram", json!({"count": 1000, "size": 8})),
                ] {
                    let ask = format!("samplers.{ask}");
                    let mut request =
                        json!({"ask": ask, "sampler": sampler, "alpha": alpha, "wo": wo});
                    request
                        .as_object_mut()
                        .unwrap()
                        .extend(more.as_object().unwrap().clone());
                    answer(&request);
                }
            }
        }
        for lobe in values().iter().filter_map(Value::as_str) {
            for (ask, more) in [
                ("slice", json!({"azimuth": 1e300, "count": 16})),
                ("grid", json!({"rows": 4, "columns": 4, "sphere": false})),
                ("samples", json!({"count": 100})),
                ("prove", json!({"samples": 100})),
                ("walks", json!({"count": 10})),
            ] {
                let mut request = json!({"ask": format!("lobes.{ask}"), "lobe": lobe, "wo": wo});
                request
                    .as_object_mut()
                    .unwrap()
                    .extend(more.as_object().unwrap().clone());
                answer(&request);
            }
        }
    }
}

#[test]
fn bytes_that_are_no_request_are_errors() {
    for bytes in [
        &b""[..],
        b"{",
        b"[]",
        b"null",
        b"{\"ask\": 1}",
        b"{\"ask\": \"lobes\"}",
        &[0xff; 9],
        b"{\"ask\":\"lobes.kinds\",\"x\":1}",
    ] {
        let answer = Studio::default().answer(bytes);
        assert!(String::from_utf8_lossy(&answer).contains("\"error\""));
    }
}
