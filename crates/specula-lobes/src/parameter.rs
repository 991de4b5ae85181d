//! Parameters as data: what may be given of a kind of lobe.

use specula_bsdf::Alpha;

/// No upper end of a range.
pub(crate) const NO_END: f64 = f64::MAX;

/// A parameter of a kind of lobe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// Its name in a text.
    pub key: &'static str,
    /// What its values are.
    pub kind: ParameterKind,
    /// Its value where it is not given, as a text has it; `None`: there is none.
    pub default: Option<&'static str>,
    /// One line on what it means.
    pub doc: &'static str,
}

/// What the values of a parameter are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ParameterKind {
    /// A number in a range, ends included.
    Number {
        /// Least value.
        low: f64,
        /// Greatest value; `f64::MAX` where there is no end.
        high: f64,
    },
    /// A whole number, 0 or more.
    Count,
    /// Alphas in `[1e-4, 10]`: one, or those along x and y.
    Alpha,
    /// A colour in linear sRGB, its channels in a range: three numbers, or one for a grey.
    Colour {
        /// Least channel.
        low: f64,
        /// Greatest channel; `f64::MAX` where there is no end.
        high: f64,
    },
    /// One of these words.
    Choice(&'static [&'static str]),
    /// `true` or `false`.
    Flag,
    /// The reflectance of a conductor: the symbol of a measured metal, or a colour.
    Metal,
}

impl ParameterKind {
    /// The range of numbers, of channels, or of alphas.
    #[must_use]
    pub fn range(self) -> Option<[f64; 2]> {
        match self {
            Self::Number { low, high } | Self::Colour { low, high } => Some([low, high]),
            Self::Count => Some([0.0, u32::MAX.into()]),
            Self::Alpha => Some([Alpha::<f64>::MIN, Alpha::<f64>::MAX]),
            Self::Metal => Some([0.0, 1.0]),
            Self::Choice(_) | Self::Flag => None,
        }
    }

    /// The words of a choice; none of other kinds.
    #[must_use]
    pub fn choices(self) -> &'static [&'static str] {
        match self {
            Self::Choice(words) => words,
            _ => &[],
        }
    }
}
