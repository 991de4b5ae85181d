//! Requests of the tests.
#![allow(
    clippy::unwrap_used,
    dead_code,
    unreachable_pub,
    reason = "of tests, of which none needs all"
)]

use serde_json::{Value, json};
use specula_studio::{Answer, AskError, Studio};

pub fn ask(studio: &Studio, request: Value) -> Result<Answer, AskError> {
    studio.try_answer(request.to_string().as_bytes())
}

pub fn value(studio: &Studio, request: Value) -> Value {
    let said = request.to_string();
    let answer = ask(studio, request).unwrap_or_else(|e| panic!("{said}: {e}"));
    answer.value().clone()
}

/// Opens a render and returns its number.
pub fn open(studio: &Studio, more: Value) -> u64 {
    let mut request =
        json!({"ask": "render.open", "scene": "ball", "width": 24, "height": 20, "maxDepth": 4});
    merge(&mut request, more);
    value(studio, request)["session"].as_u64().unwrap()
}

pub fn merge(into: &mut Value, more: Value) {
    if let (Value::Object(into), Value::Object(more)) = (into, more) {
        into.extend(more);
    }
}

pub fn colour(studio: &Studio, session: u64, samples: u32) -> Vec<f32> {
    let request = json!({"ask": "render.advance", "session": session, "samples": samples, "wants": ["colour"]});
    let answer = ask(studio, request).unwrap();
    floats(answer.array("colour").unwrap().1)
}

pub fn floats(bytes: &[u8]) -> Vec<f32> {
    bytemuck::pod_collect_to_vec(bytes)
}

pub fn refused(studio: &Studio, request: Value, words: &str) {
    let said = request.to_string();
    let error = ask(studio, request)
        .map(|_| ())
        .expect_err(&said)
        .to_string();
    assert!(error.contains(words), "{said}: {error}");
}
