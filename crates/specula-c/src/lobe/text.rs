//! Lobes as a line of text: `conductor Au alpha 0.3`.

use super::LobeHandle;
use super::given::{Parameter, Value};
use super::kinds::Kind;
use super::reflectance::symbols;

/// Reads a lobe: the kind, then keys with their values, and a metal's symbol alone where a reflectance is taken.
pub(crate) fn parse(text: &str) -> Result<LobeHandle, String> {
    let mut words = text.split_whitespace();
    let kind = Kind::named(words.next().unwrap_or_default())?;
    let mut parameters = Vec::new();
    while let Some(word) = words.next() {
        if kind.has(word) {
            let value = words
                .next()
                .ok_or_else(|| format!("{}: {word}: expected a value after it", kind.name))?;
            let value = Value::of_text(value);
            parameters.push(Parameter { name: word, value });
            continue;
        }
        if !kind.is_metal {
            return Err(kind.unknown(word));
        }
        if !symbols().contains(&word) {
            let known = symbols().join(", ");
            return Err(format!("{}, or a metal: {known}", kind.unknown(word)));
        }
        let value = Value::Word(word);
        parameters.push(Parameter {
            name: "reflectance",
            value,
        });
    }
    kind.make(&parameters)
}
