//! Parameters as they are given, and the values that are read from them.

use std::fmt::Display;
use std::str::FromStr;

use specula_bsdf::Alpha;
use specula_bsdf::math::{Real, Rgb, rgb};
use specula_bsdf::ndf::{Beckmann, Ggx, Masking};

use crate::parameter::{NO_END, Parameter};

/// A value: a word, or one to three numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value<'a> {
    /// A word.
    Word(&'a str),
    /// A number, or a grey.
    One(f64),
    /// Alphas along x and y.
    Two([f64; 2]),
    /// A colour in linear sRGB.
    Three([f64; 3]),
}

impl<'a> Value<'a> {
    /// `0.3`, `0.1,0.4`, `0.8,0.2,0.1`, or a word.
    #[must_use]
    pub fn of_text(text: &'a str) -> Self {
        let numbers: Result<Vec<f64>, _> = text.split(',').map(|n| n.trim().parse()).collect();
        match numbers.as_deref() {
            Ok(&[x]) => Self::One(x),
            Ok(&[x, y]) => Self::Two([x, y]),
            Ok(&[x, y, z]) => Self::Three([x, y, z]),
            _ => Self::Word(text),
        }
    }

    fn said(self) -> String {
        match self {
            Self::Word(word) => format!("'{word}'"),
            Self::One(x) => x.to_string(),
            Self::Two([x, y]) => format!("{x},{y}"),
            Self::Three([x, y, z]) => format!("{x},{y},{z}"),
        }
    }
}

/// A parameter's name with a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Argument<'a> {
    /// The parameter's key; hyphens and underscores are the same.
    pub name: &'a str,
    /// Its value.
    pub value: Value<'a>,
}

/// Whether names are the same: hyphens and underscores are.
pub(crate) fn same(a: &str, b: &str) -> bool {
    let plain = |c: char| if c == '-' { '_' } else { c };
    a.chars().map(plain).eq(b.chars().map(plain))
}

/// A number that must be in a range, ends included.
pub(crate) fn in_range(key: &str, value: f64, [low, high]: [f64; 2]) -> Result<f64, String> {
    if value >= low && value <= high {
        Ok(value)
    } else if high == NO_END {
        Err(format!("{key}: expected {low} or more, got {value}"))
    } else {
        Err(format!(
            "{key}: expected a number in [{low}, {high}], got {value}"
        ))
    }
}

/// What is given of a lobe. Whatever is not has the default of its parameter.
#[derive(Clone, Copy)]
pub(crate) struct Given<'a> {
    /// What may be given.
    pub(crate) parameters: [&'static [Parameter]; 2],
    pub(crate) arguments: &'a [Argument<'a>],
}

impl<'a> Given<'a> {
    pub(crate) fn get(self, key: &str) -> Option<Value<'a>> {
        let mut arguments = self.arguments.iter();
        arguments.find(|a| same(a.name, key)).map(|a| a.value)
    }

    fn parameter(self, key: &str) -> Option<&'static Parameter> {
        let mut parameters = self.parameters.into_iter().flatten();
        parameters.find(|p| same(p.key, key))
    }

    /// What is given, or the default.
    fn or_default(self, key: &str) -> Option<Value<'a>> {
        let default = || self.parameter(key)?.default.map(Value::of_text);
        self.get(key).or_else(default)
    }

    /// The range of a parameter.
    fn range(self, key: &str) -> [f64; 2] {
        let parameter = self.parameter(key);
        parameter
            .and_then(|p| p.kind.range())
            .unwrap_or([0.0, NO_END])
    }

    /// A number in its range.
    pub(crate) fn number(self, key: &str) -> Result<f64, String> {
        match self.or_default(key) {
            Some(Value::One(x)) => in_range(key, x, self.range(key)),
            Some(other) => Err(format!("{key}: expected a number, got {}", other.said())),
            None => Err(format!("{key}: is missing (expected a number)")),
        }
    }

    /// A whole number, if it is given.
    pub(crate) fn count(self, key: &str) -> Result<Option<u32>, String> {
        let expected = |got: String| Err(format!("{key}: expected a whole number, got {got}"));
        match self.get(key) {
            None => Ok(None),
            Some(Value::One(x)) if x.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&x) =>
            {
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "whole, and in the range"
                )]
                Ok(Some(x as u32))
            }
            Some(other) => expected(other.said()),
        }
    }

    /// Whether something is so: `true`, `false`, 1 or 0.
    pub(crate) fn flag(self, key: &str) -> Result<bool, String> {
        match self.or_default(key) {
            Some(Value::Word("true")) => Ok(true),
            None | Some(Value::Word("false")) => Ok(false),
            Some(Value::One(x)) if x == 0.0 || x == 1.0 => Ok(x == 1.0),
            Some(other) => Err(format!(
                "{key}: expected true or false, got {}",
                other.said()
            )),
        }
    }

    /// A colour in linear sRGB with channels in its range, if it is given; one number is a grey.
    pub(crate) fn colour(self, key: &str) -> Result<Option<Rgb<f64>>, String> {
        self.get(key)
            .map(|value| self.channels(key, value))
            .transpose()
    }

    /// A colour that is given, or its default.
    pub(crate) fn albedo(self, key: &str) -> Result<Rgb<f64>, String> {
        match self.or_default(key) {
            Some(value) => self.channels(key, value),
            None => Err(format!("{key}: is missing (expected a colour)")),
        }
    }

    fn channels(self, key: &str, value: Value<'_>) -> Result<Rgb<f64>, String> {
        let channels = match value {
            Value::One(grey) => [grey; 3],
            Value::Three(channels) => channels,
            other => {
                return Err(format!(
                    "{key}: expected a colour (one number, or three), got {}",
                    other.said()
                ));
            }
        };
        for channel in channels {
            in_range(key, channel, self.range(key))?;
        }
        let [r, g, b] = channels;
        Ok(rgb(r, g, b))
    }

    /// Alphas, one or those along x and y, if they are given.
    pub(crate) fn alpha(self, key: &str) -> Result<Option<Alpha<f64>>, String> {
        let [x, y] = match self.get(key) {
            None => return Ok(None),
            Some(Value::One(alpha)) => [alpha; 2],
            Some(Value::Two(alphas)) => alphas,
            Some(other) => {
                return Err(format!(
                    "{key}: expected one number or two, got {}",
                    other.said()
                ));
            }
        };
        let alpha = Alpha::new(x, y).map_err(|e| format!("{key}: {e}"))?;
        Ok(Some(alpha))
    }

    /// Alphas that a lobe cannot do without.
    pub(crate) fn needed_alpha(self) -> Result<Alpha<f64>, String> {
        self.alpha("alpha")?.ok_or_else(|| {
            "alpha: is missing (expected one number in [1e-4, 10], or two)".to_owned()
        })
    }

    /// A word, if it is given.
    pub(crate) fn word(self, key: &str) -> Result<Option<&'a str>, String> {
        match self.get(key) {
            None => Ok(None),
            Some(Value::Word(word)) => Ok(Some(word)),
            Some(other) => Err(format!("{key}: expected a name, got {}", other.said())),
        }
    }

    /// A value by its name, if it is given.
    pub(crate) fn named<N: FromStr<Err: Display>>(self, key: &str) -> Result<Option<N>, String> {
        let parsed = self.word(key)?.map(str::parse);
        parsed.transpose().map_err(|e: N::Err| e.to_string())
    }

    /// A value by its name, given or the default.
    pub(crate) fn chosen<N: FromStr<Err: Display> + Default>(self, key: &str) -> Result<N, String> {
        match self.or_default(key) {
            Some(Value::Word(word)) => word.parse().map_err(|e: N::Err| e.to_string()),
            Some(other) => Err(format!("{key}: expected a name, got {}", other.said())),
            None => Ok(N::default()),
        }
    }

    /// The distribution of normals, GGX by default.
    pub(crate) fn distribution(self) -> Result<Distribution, String> {
        match self.word("distribution")? {
            None | Some("ggx") => Ok(Distribution::Ggx),
            Some("beckmann") => Ok(Distribution::Beckmann),
            Some(name) => Err(format!(
                "no such distribution: '{name}' (expected ggx or beckmann)"
            )),
        }
    }

    /// How shadowing and masking go together.
    pub(crate) fn masking(self) -> Result<Masking, String> {
        match self.or_default("masking") {
            Some(Value::Word(name)) if same(name, "height-correlated") => {
                Ok(Masking::HeightCorrelated)
            }
            Some(Value::Word("separable")) => Ok(Masking::Separable),
            Some(Value::Word(name)) => Err(format!(
                "no such masking: '{name}' (expected height-correlated or separable)"
            )),
            Some(other) => Err(format!("masking: expected a name, got {}", other.said())),
            None => Ok(Masking::HeightCorrelated),
        }
    }
}

/// A distribution of normals.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Distribution {
    Ggx,
    Beckmann,
}

/// Alphas in a precision.
fn cast<T: Real>(alpha: Alpha<f64>) -> Alpha<T> {
    Alpha::clamped(T::of(alpha.x), T::of(alpha.y))
}

/// GGX in a precision.
pub(crate) fn ggx<T: Real>(alpha: Alpha<f64>) -> Ggx<T> {
    Ggx::new(cast(alpha))
}

/// Beckmann in a precision.
pub(crate) fn beckmann<T: Real>(alpha: Alpha<f64>) -> Beckmann<T> {
    Beckmann::new(cast(alpha))
}
