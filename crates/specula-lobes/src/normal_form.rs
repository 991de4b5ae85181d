//! The normal form of a lobe as text.

use std::fmt;

use crate::given::{Given, Value};
use crate::{NamedLobe, ParameterKind};

/// What is given, by the keys of the kind's parameters and in their order.
///
/// Equal alphas are one number, greys are one number, flags are words.
pub(crate) fn normal(given: Given<'_>) -> Vec<(&'static str, String)> {
    let of_parameter = |parameter: &'static crate::Parameter| {
        let value = given.get(parameter.key)?;
        let value = match (parameter.kind, value) {
            (ParameterKind::Flag, Value::One(x)) => (x == 1.0).to_string(),
            (_, Value::Word(word)) => word.replace('_', "-"),
            (_, Value::Two([x, y])) if x == y => x.to_string(),
            (_, Value::Three([x, y, z])) if x == y && y == z => x.to_string(),
            (_, Value::One(x)) => x.to_string(),
            (_, Value::Two([x, y])) => format!("{x},{y}"),
            (_, Value::Three([x, y, z])) => format!("{x},{y},{z}"),
        };
        Some((parameter.key, value))
    };
    let parameters = given.parameters.into_iter().flatten();
    parameters.filter_map(of_parameter).collect()
}

impl fmt::Display for NamedLobe {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.kind.name)?;
        let is_symbol = |key: &str, value: &str| {
            let parameter = self.kind.parameter(key);
            parameter.is_some_and(|p| p.kind == ParameterKind::Metal)
                && value.starts_with(|c: char| c.is_ascii_uppercase())
        };
        if let Some((_, symbol)) = self.given().find(|(key, value)| is_symbol(key, value)) {
            write!(f, " {symbol}")?;
        }
        for (key, value) in self.given().filter(|(key, value)| !is_symbol(key, value)) {
            write!(f, " {key} {value}")?;
        }
        Ok(())
    }
}
