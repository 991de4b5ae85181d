//! What the tests of answers share.

#![allow(clippy::unwrap_used, reason = "a panic is a failed test")]
#![allow(dead_code, reason = "each suite uses some of it")]

use serde_json::Value;
use specula_studio::{Answer, Studio};

/// The answer to a request that has one.
pub(crate) fn ask(request: &Value) -> Answer {
    let answer = Studio::default().try_answer(request.to_string().as_bytes());
    answer.unwrap_or_else(|e| panic!("{request}: {e}"))
}

/// The words of an error.
pub(crate) fn error(request: &Value) -> String {
    let answer = Studio::default().try_answer(request.to_string().as_bytes());
    answer.err().map(|e| e.to_string()).unwrap_or_default()
}

/// An array of floats.
pub(crate) fn floats(answer: &Answer, name: &str) -> Vec<f32> {
    let (shape, bytes) = answer
        .array(name)
        .unwrap_or_else(|| panic!("no array '{name}'"));
    let values: Vec<f32> = bytes
        .chunks(4)
        .map(|b| f32::from_le_bytes(b.try_into().unwrap()))
        .collect();
    assert_eq!(values.len(), shape.iter().product::<usize>(), "{name}");
    values
}
