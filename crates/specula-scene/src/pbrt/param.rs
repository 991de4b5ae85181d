//! Parameter lists: `"type name" [ values ]`.

mod edit;

use std::cell::Cell;
use std::rc::Rc;

use super::token::{Token, TokenKind, Tokens, describe};
use super::unknown;
use crate::error::{ErrorKind, Place, SceneError, Warning};
use crate::num::shorten;
use crate::problems::Problems;
use crate::spectrum::ColourSpace;

/// Values of one parameter.
#[derive(Clone, Debug)]
pub(super) enum Values {
    Numbers(Vec<f64>),
    Texts(Vec<(String, Place)>),
    Bools(Vec<bool>),
}

/// One parameter.
#[derive(Clone, Debug)]
pub(super) struct Param {
    /// Its type, with old names replaced (`color` is `rgb`, `point` is `point3`).
    pub(super) kind: &'static str,
    pub(super) name: String,
    pub(super) values: Values,
    pub(super) place: Place,
    /// The colour space of its RGB values: `ColorSpace` where it was read.
    pub(super) space: ColourSpace,
    used: Cell<bool>,
}

/// Types, and how many numbers make one value (0: not numbers).
const TYPES: &[(&str, &str, usize)] = &[
    ("integer", "integer", 1),
    ("float", "float", 1),
    ("point2", "point2", 2),
    ("vector2", "vector2", 2),
    ("point3", "point3", 3),
    ("point", "point3", 3),
    ("vector3", "vector3", 3),
    ("vector", "vector3", 3),
    ("normal3", "normal", 3),
    ("normal", "normal", 3),
    ("rgb", "rgb", 3),
    ("color", "rgb", 3),
    ("blackbody", "blackbody", 1),
    ("spectrum", "spectrum", 1),
    ("bool", "bool", 0),
    ("string", "string", 0),
    ("texture", "texture", 0),
];

/// The parameters of one directive. Lookups mark a parameter as used; [`ParamList::unused`] tells
/// which were not.
#[derive(Clone, Debug, Default)]
pub(super) struct ParamList {
    own: Vec<Rc<Param>>,
    /// From `Attribute`: looked up after `own`, and never reported as unused.
    inherited: Vec<Rc<Param>>,
    problems: Problems,
    /// Whether a mistake was recorded: others may follow from it.
    damaged: Cell<bool>,
}

impl ParamList {
    /// Reads parameters up to the next directive; RGB values are in `space`.
    pub(super) fn read(tokens: &mut Tokens<'_>, space: ColourSpace) -> Result<Self, SceneError> {
        let mut list = Self {
            problems: tokens.problems.clone(),
            ..Self::default()
        };
        loop {
            let (next, start) = tokens.look();
            let param = match next.map(|token| token.map(|t| &t.kind)) {
                Ok(Some(TokenKind::Text(_))) => read_param(tokens, space),
                Ok(_) => return Ok(list),
                Err(error) => Err(error),
            };
            match param {
                Ok(param) if list.own.iter().any(|p| p.name == param.name) => {
                    let message = format!("parameter \"{}\" is given twice", param.name);
                    list.record(SceneError::new(ErrorKind::Duplicate, &param.place, message))?;
                }
                Ok(param) => list.own.push(Rc::new(param)),
                Err(error) => {
                    let mistake = error.place().clone();
                    list.record(error)?;
                    tokens.recover(&mistake, &start, |kind| match kind {
                        TokenKind::Text(text) => is_declaration(text),
                        TokenKind::Word(word) => unknown::is_directive(word),
                        TokenKind::Open | TokenKind::Close => false,
                    });
                }
            }
        }
    }

    /// Records a mistake in one of the parameters.
    ///
    /// # Errors
    ///
    /// The mistake, in an ordinary load.
    pub(super) fn record(&self, error: SceneError) -> Result<(), SceneError> {
        self.damaged.set(true);
        self.problems.record(error)
    }

    /// Records a mistake in what the parameters describe, unless it may follow from one before.
    ///
    /// # Errors
    ///
    /// The mistake, in an ordinary load.
    pub(super) fn keep_unless_damaged(&self, error: SceneError) -> Result<(), SceneError> {
        if self.damaged.get() && self.problems.is_check() {
            return Ok(());
        }
        self.record(error)
    }

    pub(super) fn with_inherited(mut self, inherited: &[Rc<Param>]) -> Self {
        self.inherited = inherited.to_vec();
        self
    }

    pub(super) fn into_own(self) -> Vec<Rc<Param>> {
        self.own
    }

    /// The parameter of that name, marked as used.
    pub(super) fn find(&self, name: &str) -> Option<&Param> {
        // The last `Attribute` wins.
        let param = self
            .own
            .iter()
            .find(|p| p.name == name)
            .or_else(|| self.inherited.iter().rev().find(|p| p.name == name))?;
        param.used.set(true);
        Some(param)
    }

    /// Marks parameters that change nothing here as used.
    pub(super) fn ignore(&self, names: &[&str]) {
        for name in names {
            self.find(name);
        }
    }

    /// Warnings about parameters that were not used; each is given once.
    pub(super) fn unused(&self) -> impl Iterator<Item = Warning> {
        self.own.iter().filter(|p| !p.used.replace(true)).map(|p| {
            Warning::new(
                &p.place,
                format!("unused parameter \"{} {}\"", p.kind, p.name),
            )
        })
    }

    /// Numbers of a parameter of one of the `kinds`.
    pub(super) fn numbers(&self, name: &str, kinds: &[&str]) -> Result<Option<&[f64]>, SceneError> {
        let Some(param) = self.find(name) else {
            return Ok(None);
        };
        match &param.values {
            Values::Numbers(numbers) if kinds.contains(&param.kind) => Ok(Some(numbers)),
            _ => self.record(param.wrong_type(kinds)).map(|()| None),
        }
    }

    /// Exactly `N` numbers.
    pub(super) fn array<const N: usize>(
        &self,
        name: &str,
        kinds: &[&str],
    ) -> Result<Option<[f64; N]>, SceneError> {
        let Some(numbers) = self.numbers(name, kinds)? else {
            return Ok(None);
        };
        match <[f64; N]>::try_from(numbers) {
            Ok(array) => Ok(Some(array)),
            Err(_) => {
                let place = self.place_of(name);
                let message = format!("\"{name}\": expected {N} numbers, found {}", numbers.len());
                let error = SceneError::new(ErrorKind::Parameter, &place, message);
                self.record(error).map(|()| None)
            }
        }
    }

    pub(super) fn float(&self, name: &str, default: f64) -> Result<f64, SceneError> {
        Ok(self.array::<1>(name, &["float"])?.map_or(default, |[x]| x))
    }

    pub(super) fn integer(&self, name: &str, default: i64) -> Result<i64, SceneError> {
        // Read as i32, so the cast is exact.
        #[expect(
            clippy::cast_possible_truncation,
            reason = "integers are read within i32"
        )]
        Ok(self
            .array::<1>(name, &["integer"])?
            .map_or(default, |[x]| x as i64))
    }

    /// A number that must exceed `limit`.
    pub(super) fn float_above(
        &self,
        name: &str,
        default: f64,
        limit: f64,
    ) -> Result<f64, SceneError> {
        let x = self.float(name, default)?;
        if x > limit {
            return Ok(x);
        }
        let message = format!("\"{name}\": expected a number above {limit}, found {x}");
        self.record(self.wrong(name, message))?;
        Ok(default)
    }

    /// A number that must not be negative.
    pub(super) fn float_from_zero(&self, name: &str, default: f64) -> Result<f64, SceneError> {
        let x = self.float(name, default)?;
        if x >= 0.0 {
            return Ok(x);
        }
        let message = format!("\"{name}\": expected a number that is not negative, found {x}");
        self.record(self.wrong(name, message))?;
        Ok(default)
    }

    /// An integer within `range`.
    pub(super) fn integer_within(
        &self,
        name: &str,
        default: u32,
        range: std::ops::RangeInclusive<u32>,
    ) -> Result<u32, SceneError> {
        let x = self.integer(name, i64::from(default))?;
        match u32::try_from(x) {
            Ok(x) if range.contains(&x) => Ok(x),
            _ => {
                let (low, high) = (range.start(), range.end());
                let message =
                    format!("\"{name}\": expected an integer from {low} to {high}, found {x}");
                self.record(self.wrong(name, message))?;
                Ok(default)
            }
        }
    }

    pub(super) fn bool(&self, name: &str, default: bool) -> Result<bool, SceneError> {
        let Some(param) = self.find(name) else {
            return Ok(default);
        };
        match &param.values {
            Values::Bools(values) if values.len() == 1 => Ok(values[0]),
            _ => self.record(param.wrong_type(&["bool"])).map(|()| default),
        }
    }

    /// Strings of a parameter of type `kind`.
    pub(super) fn texts(&self, name: &str, kind: &str) -> Result<&[(String, Place)], SceneError> {
        let Some(param) = self.find(name) else {
            return Ok(&[]);
        };
        match &param.values {
            Values::Texts(texts) if param.kind == kind => Ok(texts),
            _ => {
                self.record(param.wrong_type(&[kind]))?;
                Ok(&[])
            }
        }
    }

    pub(super) fn string(&self, name: &str) -> Result<Option<(&str, &Place)>, SceneError> {
        match self.texts(name, "string")? {
            [] => Ok(None),
            [(text, place)] => Ok(Some((text, place))),
            [_, (_, place), ..] => {
                let message = format!("\"{name}\": expected one string");
                let error = SceneError::new(ErrorKind::Parameter, place, message);
                self.record(error).map(|()| None)
            }
        }
    }

    /// The error for a value of the parameter `name`.
    fn wrong(&self, name: &str, message: String) -> SceneError {
        SceneError::new(ErrorKind::Parameter, &self.place_of(name), message)
    }

    /// The parameter's place; call it only for one that exists.
    pub(super) fn place_of(&self, name: &str) -> Place {
        match self.find(name) {
            Some(param) => param.place.clone(),
            None => Place::start(&crate::error::SourceText::new("", "")),
        }
    }
}

impl Param {
    pub(super) fn wrong_type(&self, expected: &[&str]) -> SceneError {
        let message = format!(
            "\"{}\": expected one value of type {}, found \"{}\"",
            self.name,
            expected.join(", "),
            self.kind
        );
        SceneError::new(ErrorKind::Parameter, &self.place, message)
    }
}

/// Whether a string reads as `type name`: behind a mistake, the next parameter begins there.
fn is_declaration(text: &str) -> bool {
    let mut words = text.split([' ', '\t']).filter(|w| !w.is_empty());
    let is_type = |word: &str| TYPES.iter().any(|(name, ..)| *name == word);
    words.next().is_some_and(is_type) && words.next().is_some() && words.next().is_none()
}

fn read_param(tokens: &mut Tokens<'_>, space: ColourSpace) -> Result<Param, SceneError> {
    let (declaration, place) = tokens.expect_text("a parameter")?;
    let bad = |message: String| SceneError::new(ErrorKind::Syntax, &place, message);
    let mut words = declaration.split([' ', '\t']).filter(|w| !w.is_empty());
    let (Some(kind), Some(name), None) = (words.next(), words.next(), words.next()) else {
        let found = shorten(&declaration);
        return Err(bad(format!(
            "expected \"type name\" of a parameter, found \"{found}\""
        )));
    };
    let Some(&(_, kind, group)) = TYPES.iter().find(|(n, ..)| *n == kind) else {
        return Err(bad(format!("unknown parameter type `{}`", shorten(kind)))
            .with_help("expected integer, float, point2, vector2, point3, vector3, normal, rgb, blackbody, spectrum, bool, string or texture"));
    };
    let values = read_values(tokens, kind, name)?;
    if let Values::Numbers(numbers) = &values
        && group > 1
        && !numbers.len().is_multiple_of(group)
    {
        let found = numbers.len();
        return Err(bad(format!(
            "\"{kind} {name}\": expected a multiple of {group} numbers, found {found}"
        )));
    }
    Ok(Param {
        kind,
        name: name.to_owned(),
        values,
        place,
        space,
        used: Cell::new(false),
    })
}

fn read_values(tokens: &mut Tokens<'_>, kind: &str, name: &str) -> Result<Values, SceneError> {
    let what = format!("a value of \"{kind} {name}\"");
    let first = tokens.expect(&what)?;
    let mut values = Values::Numbers(Vec::new());
    if first.kind != TokenKind::Open {
        add_value(tokens, first, kind, &what, &mut values, true)?;
        return Ok(values);
    }
    let open = tokens.place(&first);
    if !matches!(kind, "string" | "texture" | "bool" | "spectrum")
        && let Some(numbers) = tokens.numbers(kind == "integer")
    {
        return Ok(Values::Numbers(numbers));
    }
    let mut empty = true;
    let mut add = |tokens: &Tokens<'_>, token: Token<'_>| -> Result<(), SceneError> {
        add_value(tokens, token, kind, &what, &mut values, empty)?;
        empty = false;
        Ok(())
    };
    loop {
        match tokens.next()? {
            Some(Token {
                kind: TokenKind::Close,
                ..
            }) => return Ok(values),
            Some(token) => add(tokens, token)?,
            None => {
                let message = format!("`[` of \"{kind} {name}\" is never closed; expected `]`");
                return Err(SceneError::new(ErrorKind::Syntax, &open, message));
            }
        }
    }
}

fn add_value(
    tokens: &Tokens<'_>,
    token: Token<'_>,
    kind: &str,
    what: &str,
    values: &mut Values,
    first: bool,
) -> Result<(), SceneError> {
    let wrong = |expected: &str| {
        let message = format!(
            "expected {expected} as {what}, found {}",
            describe(&token.kind)
        );
        SceneError::new(ErrorKind::Syntax, &tokens.place(&token), message)
    };
    match (kind, &token.kind) {
        ("string" | "texture", TokenKind::Text(text)) | ("spectrum", TokenKind::Text(text)) => {
            if first {
                *values = Values::Texts(Vec::new());
            }
            let Values::Texts(texts) = values else {
                return Err(wrong("a number"));
            };
            texts.push((text.clone().into_owned(), tokens.place(&token)));
        }
        ("string" | "texture", _) => return Err(wrong("a string in quotes")),
        ("bool", kind) => {
            // `"true"` in quotes is accepted, as older files have it.
            let value = match kind {
                TokenKind::Word("true") => true,
                TokenKind::Word("false") => false,
                TokenKind::Text(t) if t == "true" => true,
                TokenKind::Text(t) if t == "false" => false,
                _ => return Err(wrong("true or false")),
            };
            if first {
                *values = Values::Bools(Vec::new());
            }
            if let Values::Bools(bools) = values {
                bools.push(value);
            }
        }
        _ => {
            let number = tokens.number(&token, "a number")?;
            if kind == "integer" && (number.fract() != 0.0 || number.abs() > f64::from(i32::MAX)) {
                return Err(wrong("an integer"));
            }
            let Values::Numbers(numbers) = values else {
                return Err(wrong("a string in quotes"));
            };
            numbers.push(number);
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::SourceText;

    fn read(text: &str) -> Result<ParamList, SceneError> {
        let source = SourceText::new("t", text);
        let mut tokens = Tokens::new(&source, Problems::default());
        ParamList::read(&mut tokens, ColourSpace::Srgb)
    }

    #[test]
    fn values_have_their_types() {
        let list =
            read("\"float a\" 2 \"bool b\" true \"string s\" [\"x\"] \"point p\" [1 2 3]").unwrap();
        assert_eq!(list.float("a", 0.0).unwrap(), 2.0);
        assert!(list.bool("b", false).unwrap());
        assert_eq!(list.string("s").unwrap().unwrap().0, "x");
        assert_eq!(
            list.array::<3>("p", &["point3"]).unwrap(),
            Some([1.0, 2.0, 3.0])
        );
        assert_eq!(list.unused().count(), 0);
        assert_eq!(list.float("missing", 7.0).unwrap(), 7.0);
    }

    #[test]
    fn what_nobody_reads_is_reported() {
        let list = read("\"float a\" 2\n\"float b\" 3").unwrap();
        list.float("a", 0.0).unwrap();
        let unused: Vec<_> = list.unused().collect();
        assert_eq!(unused.len(), 1);
        assert_eq!(
            (unused[0].line(), unused[0].message()),
            (2, "unused parameter \"float b\"")
        );
    }

    #[test]
    fn mistakes_are_located() {
        for (text, column) in [
            ("\"float a\" [1 \"x\"]", 14),
            ("\"flaot a\" 1", 1),
            ("\"float\" 1", 1),
            ("\"rgb a\" [1 2]", 1),
            ("\"integer a\" 1.5", 13),
            ("\"float a\" [1", 11),
            ("\"float a\" 1 \"float a\" 2", 13),
            ("\"bool a\" 1", 10),
            ("\"float a\" nan", 11),
        ] {
            let error = read(text).unwrap_err();
            assert_eq!(error.column(), column, "{text}: {error}");
        }
    }
}
