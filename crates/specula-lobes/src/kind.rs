//! A kind of lobe: its parameters, and lobes made of arguments.

use std::fmt;

use crate::given::{Argument, Given, same};
use crate::normal_form::normal;
use crate::{LobeError, NamedLobe, Pair, Parameter};

/// A kind of lobe.
pub struct Kind {
    /// Its name in a text.
    pub name: &'static str,
    /// One line on what it is.
    pub doc: &'static str,
    /// Parameters of its own.
    pub(crate) own: &'static [Parameter],
    /// Those of a reflectance, where it takes one.
    pub(crate) reflectance: &'static [Parameter],
    pub(crate) make: fn(Given<'_>) -> Result<Pair, String>,
}

impl fmt::Debug for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}

impl Kind {
    /// Its parameters.
    pub fn parameters(&self) -> impl Iterator<Item = &'static Parameter> {
        self.own.iter().chain(self.reflectance)
    }

    /// Whether it takes the reflectance of a metal.
    #[must_use]
    pub fn takes_metals(&self) -> bool {
        !self.reflectance.is_empty()
    }

    /// A parameter by its key.
    #[must_use]
    pub fn parameter(&self, key: &str) -> Option<&'static Parameter> {
        self.parameters().find(|p| same(p.key, key))
    }

    fn known(&self) -> String {
        let known: Vec<_> = self.parameters().map(|p| p.key).collect();
        known.join(", ")
    }

    /// What is said of a word that is no key.
    pub(crate) fn unknown(&self, word: &str) -> String {
        let known = self.known();
        format!(
            "{}: no such parameter: '{word}' (expected one of {known})",
            self.name
        )
    }

    /// Makes a lobe of this kind.
    ///
    /// # Errors
    /// Where an argument is unknown, given twice, or out of its range, or where they do not go together.
    pub fn make(&'static self, arguments: &[Argument<'_>]) -> Result<NamedLobe, LobeError> {
        for (i, argument) in arguments.iter().enumerate() {
            if self.parameter(argument.name).is_none() {
                return Err(LobeError(self.unknown(argument.name)));
            }
            if arguments[..i].iter().any(|p| same(p.name, argument.name)) {
                let problem = format!("{}: {}: is given twice", self.name, argument.name);
                return Err(LobeError(problem));
            }
        }
        let parameters = [self.own, self.reflectance];
        let given = Given {
            parameters,
            arguments,
        };
        let pair = (self.make)(given).map_err(|problem| {
            let known = self.known();
            LobeError(format!(
                "{}: {problem}; its parameters are {known}",
                self.name
            ))
        })?;
        Ok(NamedLobe {
            kind: self,
            given: normal(given),
            pair,
        })
    }
}
