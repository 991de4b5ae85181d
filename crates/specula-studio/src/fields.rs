//! The fields of a request, each taken with a check: an error names the field, what was expected, and what came.

use serde_json::{Map, Value};
use specula_bsdf::Vec3;
use specula_bsdf::math::vec3;

use crate::AskError;

/// Fields that are not taken yet.
pub(crate) struct Fields(Map<String, Value>);

/// Most samples that a request may ask for.
pub(crate) const MOST_SAMPLES: u32 = 4_000_000;

impl Fields {
    pub(crate) fn new(request: Map<String, Value>) -> Self {
        Self(request)
    }

    /// All fields must have been taken.
    pub(crate) fn end(self) -> Result<(), AskError> {
        match self.0.keys().next() {
            None => Ok(()),
            Some(name) => Err(AskError::new(format!(
                "'{name}' is no field of this request"
            ))),
        }
    }

    /// A field that may be absent or null.
    fn take(&mut self, name: &str) -> Option<Value> {
        self.0.remove(name).filter(|value| !value.is_null())
    }

    fn needed(&mut self, name: &str, expected: &str) -> Result<Value, AskError> {
        let missing = || AskError::new(format!("{name}: is missing (expected {expected})"));
        self.take(name).ok_or_else(missing)
    }

    /// A text.
    pub(crate) fn text(&mut self, name: &str) -> Result<String, AskError> {
        match self.needed(name, "a text")? {
            Value::String(text) if text.len() <= 4096 => Ok(text),
            Value::String(text) => {
                let got = format!("one of {} bytes", text.len());
                Err(wrong(name, "a text of at most 4096 bytes", &got))
            }
            other => Err(wrong(name, "a text", &other)),
        }
    }

    /// `true` or `false`.
    pub(crate) fn flag(&mut self, name: &str) -> Result<bool, AskError> {
        match self.needed(name, "true or false")? {
            Value::Bool(flag) => Ok(flag),
            other => Err(wrong(name, "true or false", &other)),
        }
    }

    /// A whole number in `[low, high]`.
    pub(crate) fn count(&mut self, name: &str, low: u32, high: u32) -> Result<u32, AskError> {
        let expected = whole(low, high);
        let value = self.needed(name, &expected)?;
        in_whole(&value, u64::from(low), u64::from(high))
            .and_then(|n| u32::try_from(n).ok())
            .ok_or_else(|| wrong(name, &expected, &value))
    }

    /// A whole number in `[low, high]`; without it, the default.
    pub(crate) fn count_or(
        &mut self,
        name: &str,
        default: u32,
        [low, high]: [u32; 2],
    ) -> Result<u32, AskError> {
        match self.0.get(name) {
            None | Some(Value::Null) => {
                self.take(name);
                Ok(default)
            }
            Some(_) => self.count(name, low, high),
        }
    }

    /// The field `seed`; 0 without.
    pub(crate) fn seed(&mut self) -> Result<u64, AskError> {
        /// 2^53: integers below are exact in JSON's readers.
        const END: u64 = 1 << 53;
        let Some(value) = self.take("seed") else {
            return Ok(0);
        };
        in_whole(&value, 0, END - 1)
            .ok_or_else(|| wrong("seed", "a whole number in [0, 2^53)", &value))
    }

    /// A finite number.
    pub(crate) fn number(&mut self, name: &str) -> Result<f64, AskError> {
        let value = self.needed(name, "a number")?;
        finite(&value).ok_or_else(|| wrong(name, "a finite number", &value))
    }

    /// Finite numbers.
    pub(crate) fn numbers<const N: usize>(&mut self, name: &str) -> Result<[f64; N], AskError> {
        let expected = format!("{N} finite numbers");
        let value = self.needed(name, &expected)?;
        numbers(&value).ok_or_else(|| wrong(name, &expected, &value))
    }

    /// A unit vector, normalised.
    pub(crate) fn direction(&mut self, name: &str) -> Result<Vec3<f64>, AskError> {
        let value = self.needed(name, UNIT)?;
        unit(&value).ok_or_else(|| wrong(name, UNIT, &value))
    }

    /// Another object within this one, whose fields are named behind its own name.
    pub(crate) fn within(&mut self, name: &str) -> Result<Self, AskError> {
        match self.needed(name, "an object")? {
            Value::Object(fields) => Ok(Self(fields)),
            other => Err(wrong(name, "an object", &other)),
        }
    }

    /// Whether a field is there.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.0.get(name).is_some_and(|value| !value.is_null())
    }
}

const UNIT: &str = "a unit vector [x, y, z]";

/// What is said of a field with a wrong value.
pub(crate) fn wrong(name: &str, expected: &str, got: &impl std::fmt::Display) -> AskError {
    let mut got = got.to_string();
    if got.len() > 80 {
        let cut = (0..=80).rev().find(|i| got.is_char_boundary(*i));
        got.truncate(cut.unwrap_or(0));
        got.push_str("...");
    }
    AskError::new(format!("{name}: expected {expected}, got {got}"))
}

fn whole(low: u32, high: u32) -> String {
    format!("a whole number in [{low}, {high}]")
}

fn in_whole(value: &Value, low: u64, high: u64) -> Option<u64> {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "whole, not negative, and below 2^53"
    )]
    let of_float = |x: f64| (x.fract() == 0.0 && (0.0..9.0e15).contains(&x)).then_some(x as u64);
    let number = value
        .as_u64()
        .or_else(|| value.as_f64().and_then(of_float))?;
    (low..=high).contains(&number).then_some(number)
}

fn finite(value: &Value) -> Option<f64> {
    value.as_f64().filter(|x| x.is_finite())
}

fn numbers<const N: usize>(value: &Value) -> Option<[f64; N]> {
    let found: Option<Vec<f64>> = value.as_array()?.iter().map(finite).collect();
    found?.try_into().ok()
}

/// Vectors within 1e-3 of unit length are taken, as rounded ones are.
fn unit(value: &Value) -> Option<Vec3<f64>> {
    let [x, y, z] = numbers(value)?;
    let length = x.hypot(y).hypot(z);
    ((length - 1.0).abs() <= 1e-3).then(|| vec3(x / length, y / length, z / length))
}
