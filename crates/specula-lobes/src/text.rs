//! Lobes as a line of text: `conductor Au alpha 0.3`.

use crate::given::{Argument, Value};
use crate::kind::Kind;
use crate::reflectance::symbols;
use crate::{LobeError, NamedLobe, ParameterKind};

/// Reads a lobe: the kind, then keys with their values, between white space, in any order.
///
/// * Alphas along x and y: `alpha 0.1,0.4`, or `alpha 0.1 0.4`. Colours: `0.8,0.2,0.1`, or `0.8 0.2 0.1`, or one
///   number for a grey.
/// * Where a reflectance is taken, a metal's symbol may stand alone, and behind the kind a colour.
///
/// # Errors
/// Where there is no such kind or parameter, or as [`Kind::make`].
pub fn parse(text: &str) -> Result<NamedLobe, LobeError> {
    let mut words = Words(text.split_whitespace().collect());
    words.0.reverse();
    let kind = Kind::named(words.next().unwrap_or_default())?;
    let mut arguments = Vec::new();
    if kind.takes_metals() && words.number().is_some() {
        let name = "reflectance";
        let value = words.value(ParameterKind::Metal).unwrap_or(Value::One(1.0));
        arguments.push(Argument { name, value });
    }
    while let Some(word) = words.next() {
        if let Some(parameter) = kind.parameter(word) {
            let value = words.value(parameter.kind).ok_or_else(|| {
                LobeError(format!("{}: {word}: expected a value after it", kind.name))
            })?;
            arguments.push(Argument { name: word, value });
            continue;
        }
        if !kind.takes_metals() {
            return Err(LobeError(kind.unknown(word)));
        }
        if !symbols().contains(&word) {
            let known = symbols().join(", ");
            return Err(LobeError(format!(
                "{}, or a metal: {known}",
                kind.unknown(word)
            )));
        }
        let (name, value) = ("reflectance", Value::Word(word));
        arguments.push(Argument { name, value });
    }
    kind.make(&arguments)
}

/// Words that are left, the last one first.
struct Words<'a>(Vec<&'a str>);

impl<'a> Words<'a> {
    fn next(&mut self) -> Option<&'a str> {
        self.0.pop()
    }

    /// The next word as a number, which it leaves there.
    fn number(&self) -> Option<f64> {
        self.numbers(1).map(|[x, ..]| x)
    }

    /// The next words, as many numbers: the first of them, and the others where there are so many.
    fn numbers(&self, count: usize) -> Option<[f64; 2]> {
        let mut found = [0.0; 2];
        for (i, slot) in found.iter_mut().take(count).enumerate() {
            let word = self.0.get(self.0.len().checked_sub(1 + i)?)?;
            *slot = word.parse().ok()?;
        }
        Some(found)
    }

    /// A value: a word, and the numbers behind it that belong to it.
    fn value(&mut self, kind: ParameterKind) -> Option<Value<'a>> {
        let value = Value::of_text(self.next()?);
        let Value::One(x) = value else {
            return Some(value);
        };
        let more = match kind {
            ParameterKind::Alpha => 1,
            ParameterKind::Colour { .. } | ParameterKind::Metal => 2,
            _ => return Some(value),
        };
        let Some([y, z]) = self.numbers(more) else {
            return Some(value);
        };
        self.0.truncate(self.0.len() - more);
        Some(match more {
            1 => Value::Two([x, y]),
            _ => Value::Three([x, y, z]),
        })
    }
}
