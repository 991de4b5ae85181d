//! Parameters as they are given, and the values that are read from them.

use std::fmt::Display;
use std::str::FromStr;

use specula_bsdf::Alpha;
use specula_bsdf::math::{Real, Rgb, rgb};
use specula_bsdf::ndf::{Beckmann, Ggx, Masking};

/// The range of shares.
pub(super) const SHARE: [f64; 2] = [0.0, 1.0];
/// The range of what has no upper end.
pub(super) const ANY: [f64; 2] = [0.0, f64::MAX];
/// Indices of refraction that lobes take.
pub(super) const ETA: [f64; 2] = [1e-3, 1e3];
/// Those of coats.
pub(super) const COAT_ETA: [f64; 2] = [1.0, 3.0];

/// A value: a word, or one to three numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Value<'a> {
    Word(&'a str),
    One(f64),
    Two([f64; 2]),
    Three([f64; 3]),
}

impl<'a> Value<'a> {
    /// `0.3`, `0.1,0.4`, `0.8,0.2,0.1`, or a word.
    pub(crate) fn of_text(text: &'a str) -> Self {
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

/// A name with its value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Parameter<'a> {
    pub(crate) name: &'a str,
    pub(crate) value: Value<'a>,
}

/// Whether names are the same: hyphens and underscores are.
pub(super) fn same(a: &str, b: &str) -> bool {
    let plain = |c: char| if c == '-' { '_' } else { c };
    a.chars().map(plain).eq(b.chars().map(plain))
}

/// A number that must be in a range, ends included.
pub(super) fn in_range(key: &str, value: f64, [low, high]: [f64; 2]) -> Result<f64, String> {
    if value >= low && value <= high {
        Ok(value)
    } else if high == f64::MAX {
        Err(format!("{key}: expected {low} or more, got {value}"))
    } else {
        Err(format!(
            "{key}: expected a number in [{low}, {high}], got {value}"
        ))
    }
}

/// What is given of a lobe. Whatever is not has its default.
#[derive(Clone, Copy)]
pub(super) struct Given<'a>(pub(super) &'a [Parameter<'a>]);

impl<'a> Given<'a> {
    pub(super) fn get(self, key: &str) -> Option<Value<'a>> {
        self.0.iter().find(|p| same(p.name, key)).map(|p| p.value)
    }

    /// A number in a range.
    pub(super) fn number(self, key: &str, default: f64, range: [f64; 2]) -> Result<f64, String> {
        match self.get(key) {
            None => Ok(default),
            Some(Value::One(x)) => in_range(key, x, range),
            Some(other) => Err(format!("{key}: expected a number, got {}", other.said())),
        }
    }

    /// A number in `[0, 1]`.
    pub(super) fn share(self, key: &str, default: f64) -> Result<f64, String> {
        self.number(key, default, SHARE)
    }

    /// A whole number, if it is given.
    pub(super) fn count(self, key: &str) -> Result<Option<u32>, String> {
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
    pub(super) fn flag(self, key: &str, default: bool) -> Result<bool, String> {
        match self.get(key) {
            None => Ok(default),
            Some(Value::Word("true")) => Ok(true),
            Some(Value::Word("false")) => Ok(false),
            Some(Value::One(x)) if x == 0.0 || x == 1.0 => Ok(x == 1.0),
            Some(other) => Err(format!(
                "{key}: expected true or false, got {}",
                other.said()
            )),
        }
    }

    /// A colour in linear sRGB with channels in a range, if it is given; one number is a grey.
    pub(super) fn colour(self, key: &str, range: [f64; 2]) -> Result<Option<Rgb<f64>>, String> {
        let channels = match self.get(key) {
            None => return Ok(None),
            Some(Value::One(grey)) => [grey; 3],
            Some(Value::Three(channels)) => channels,
            Some(other) => {
                return Err(format!(
                    "{key}: expected a colour (one number, or three), got {}",
                    other.said()
                ));
            }
        };
        for channel in channels {
            in_range(key, channel, range)?;
        }
        let [r, g, b] = channels;
        Ok(Some(rgb(r, g, b)))
    }

    /// A colour with channels in `[0, 1]`.
    pub(super) fn albedo(self, key: &str, default: f64) -> Result<Rgb<f64>, String> {
        Ok(self.colour(key, SHARE)?.unwrap_or(Rgb::splat(default)))
    }

    /// Alphas, one or those along x and y, if they are given.
    pub(super) fn alpha(self, key: &str) -> Result<Option<Alpha<f64>>, String> {
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
    pub(super) fn needed_alpha(self) -> Result<Alpha<f64>, String> {
        self.alpha("alpha")?.ok_or_else(|| {
            "alpha: is missing (expected one number in [1e-4, 10], or two)".to_owned()
        })
    }

    /// A word, if it is given.
    pub(super) fn word(self, key: &str) -> Result<Option<&'a str>, String> {
        match self.get(key) {
            None => Ok(None),
            Some(Value::Word(word)) => Ok(Some(word)),
            Some(other) => Err(format!("{key}: expected a name, got {}", other.said())),
        }
    }

    /// A value by its name, if it is given.
    pub(super) fn named<N: FromStr<Err: Display>>(self, key: &str) -> Result<Option<N>, String> {
        let parsed = self.word(key)?.map(str::parse);
        parsed.transpose().map_err(|e: N::Err| e.to_string())
    }

    /// The distribution of normals, GGX by default.
    pub(super) fn distribution(self) -> Result<Distribution, String> {
        match self.word("distribution")? {
            None | Some("ggx") => Ok(Distribution::Ggx),
            Some("beckmann") => Ok(Distribution::Beckmann),
            Some(name) => Err(format!(
                "no such distribution: '{name}' (expected ggx or beckmann)"
            )),
        }
    }

    /// How shadowing and masking go together.
    pub(super) fn masking(self, default: Masking) -> Result<Masking, String> {
        match self.word("masking")? {
            None => Ok(default),
            Some(name) if same(name, "height-correlated") => Ok(Masking::HeightCorrelated),
            Some("separable") => Ok(Masking::Separable),
            Some(name) => Err(format!(
                "no such masking: '{name}' (expected height-correlated or separable)"
            )),
        }
    }
}

/// A distribution of normals.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Distribution {
    Ggx,
    Beckmann,
}

/// Alphas in a precision.
fn cast<T: Real>(alpha: Alpha<f64>) -> Alpha<T> {
    Alpha::clamped(T::of(alpha.x), T::of(alpha.y))
}

/// GGX in a precision.
pub(super) fn ggx<T: Real>(alpha: Alpha<f64>) -> Ggx<T> {
    Ggx::new(cast(alpha))
}

/// Beckmann in a precision.
pub(super) fn beckmann<T: Real>(alpha: Alpha<f64>) -> Beckmann<T> {
    Beckmann::new(cast(alpha))
}
