//! The models by name.

use alloc::borrow::ToOwned;
use alloc::string::String;
use core::fmt;
use core::str::FromStr;

/// Which estimator computes multiple bounces. `Metals only` means that a
/// [`Dielectric`](crate::bsdf::MultibounceDielectric) takes `StratifiedBidirectional` instead.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum MultibounceModel {
    /// Heitz et al. 2016.
    Heitz2016,
    /// Bitterli and d'Eon 2022, unidirectional. Metals only.
    BitterliDeon2022,
    /// Wang et al. 2022. Metals only.
    Wang2022 {
        /// Masking and shadowing of each bounce are correlated by its height.
        correlated: bool,
    },
    /// Cui et al. 2023. Metals only.
    Cui2023 {
        /// Paths are connected from both ends.
        bidirectional: bool,
    },
    /// Stratified bidirectional walks, Specula's own.
    #[default]
    StratifiedBidirectional,
}

impl MultibounceModel {
    /// Every model.
    pub const ALL: [Self; 7] = [
        Self::Heitz2016,
        Self::BitterliDeon2022,
        Self::Wang2022 { correlated: true },
        Self::Wang2022 { correlated: false },
        Self::Cui2023 {
            bidirectional: false,
        },
        Self::Cui2023 {
            bidirectional: true,
        },
        Self::StratifiedBidirectional,
    ];

    /// Whether its mean is that of Heitz 2016.
    #[must_use]
    pub fn is_unbiased(self) -> bool {
        !matches!(self, Self::Wang2022 { .. })
    }

    /// The name on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Heitz2016 => "heitz",
            Self::BitterliDeon2022 => "bitterli",
            Self::Wang2022 { correlated: true } => "wang",
            Self::Wang2022 { correlated: false } => "wang-uncorrelated",
            Self::Cui2023 {
                bidirectional: false,
            } => "cui",
            Self::Cui2023 {
                bidirectional: true,
            } => "cui-bidirectional",
            Self::StratifiedBidirectional => "specula",
        }
    }
}

impl fmt::Display for MultibounceModel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A name of no model.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "no such model of multiple bounces: '{0}' (expected heitz, bitterli, wang, wang-uncorrelated, \
     cui, cui-bidirectional or specula)"
)]
pub struct UnknownMultibounceModel(pub String);

impl FromStr for MultibounceModel {
    type Err = UnknownMultibounceModel;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        Self::ALL
            .into_iter()
            .find(|model| model.name() == name)
            .ok_or_else(|| UnknownMultibounceModel(name.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_back() {
        for model in MultibounceModel::ALL {
            assert_eq!(model.to_string().parse(), Ok(model));
        }
        let error = "smith".parse::<MultibounceModel>().unwrap_err().to_string();
        assert!(error.contains("'smith'"));
        for model in MultibounceModel::ALL {
            assert!(error.contains(model.name()));
        }
    }
}
