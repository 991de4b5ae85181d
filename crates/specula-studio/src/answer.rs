//! Answers: a JSON value and arrays, in bytes.
//!
//! ```text
//! 4 bytes       length of the JSON, little-endian, a multiple of 4
//! JSON          {"value": ..., "arrays": [{"name", "type", "shape", "offset"}]} or {"error": "..."}, padded by spaces
//! arrays        each at its offset behind the JSON, little-endian, padded to 4 bytes
//! ```

use serde::Serialize;
use serde_json::{Value, json};

/// An answer to a request.
#[derive(Debug, Default)]
pub struct Answer {
    value: Value,
    arrays: Vec<Array>,
}

/// A named array.
#[derive(Debug)]
pub struct Array {
    name: &'static str,
    kind: &'static str,
    shape: Vec<usize>,
    bytes: Vec<u8>,
}

impl Answer {
    /// An answer without arrays.
    pub(crate) fn new(value: impl Serialize) -> Self {
        Self {
            value: serde_json::to_value(value).unwrap_or_default(),
            arrays: Vec::new(),
        }
    }

    /// With an array of floats; its shape's product is their number.
    pub(crate) fn with_f32(self, name: &'static str, shape: &[usize], values: &[f32]) -> Self {
        self.with(name, "f32", shape, bytemuck::cast_slice(values).to_vec())
    }

    /// With an array of integers.
    pub(crate) fn with_u32(self, name: &'static str, shape: &[usize], values: &[u32]) -> Self {
        self.with(name, "u32", shape, bytemuck::cast_slice(values).to_vec())
    }

    /// With an array of bytes.
    pub(crate) fn with_u8(self, name: &'static str, shape: &[usize], values: Vec<u8>) -> Self {
        self.with(name, "u8", shape, values)
    }

    fn with(
        mut self,
        name: &'static str,
        kind: &'static str,
        shape: &[usize],
        bytes: Vec<u8>,
    ) -> Self {
        let shape = shape.to_vec();
        self.arrays.push(Array {
            name,
            kind,
            shape,
            bytes,
        });
        self
    }

    /// The value.
    #[must_use]
    pub fn value(&self) -> &Value {
        &self.value
    }

    /// An array's shape and bytes.
    #[must_use]
    pub fn array(&self, name: &str) -> Option<(&[usize], &[u8])> {
        let found = self.arrays.iter().find(|array| array.name == name);
        found.map(|array| (array.shape.as_slice(), array.bytes.as_slice()))
    }

    /// The bytes that a page reads.
    #[must_use]
    pub fn into_bytes(self) -> Vec<u8> {
        let mut offset = 0;
        let mut listed = Vec::new();
        for Array {
            name,
            kind,
            shape,
            bytes,
        } in &self.arrays
        {
            listed.push(json!({"name": name, "type": kind, "shape": shape, "offset": offset}));
            offset += bytes.len().next_multiple_of(4);
        }
        let mut all = head(&json!({"value": self.value, "arrays": listed}));
        all.reserve(offset);
        for array in self.arrays {
            all.extend_from_slice(&array.bytes);
            all.resize(all.len().next_multiple_of(4), 0);
        }
        all
    }
}

/// The bytes of an error's words.
pub(crate) fn error_bytes(message: &str) -> Vec<u8> {
    head(&json!({"error": message}))
}

fn head(value: &Value) -> Vec<u8> {
    let mut text = value.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let length = u32::try_from(text.len()).unwrap_or(u32::MAX);
    let mut all = length.to_le_bytes().to_vec();
    all.append(&mut text);
    all
}
