//! What the classes hold: a lobe of the library's list, a fibre, or a measured material.

use specula_bsdf::bsdf::Lobe;
use specula_bsdf::hair::Hair;
use specula_bsdf::math::Real;
use specula_bsdf::measured::Measured;

/// A BSDF in one precision.
pub(crate) enum AnyLobe<T> {
    Lobe(Lobe<T>),
    Hair(Hair<T>),
    Measured(Box<Measured<T>>),
}

impl<T: Real> AnyLobe<T> {
    /// It, by what all have in common.
    pub(crate) fn as_bsdf(&self) -> &dyn specula_bsdf::Bsdf<T> {
        match self {
            Self::Lobe(lobe) => lobe,
            Self::Hair(hair) => hair,
            Self::Measured(measured) => &**measured,
        }
    }

    /// Whether samples read the second and third random number alone: there is nothing to choose from.
    pub(crate) fn takes_two_numbers(&self) -> bool {
        matches!(
            self,
            Self::Lobe(Lobe::RoughConductor(_) | Lobe::RoughConductorBeckmann(_))
                | Self::Measured(_)
        )
    }
}

impl<T> From<Lobe<T>> for AnyLobe<T> {
    fn from(lobe: Lobe<T>) -> Self {
        Self::Lobe(lobe)
    }
}

impl<T> From<Hair<T>> for AnyLobe<T> {
    fn from(hair: Hair<T>) -> Self {
        Self::Hair(hair)
    }
}

impl<T> From<Measured<T>> for AnyLobe<T> {
    fn from(measured: Measured<T>) -> Self {
        Self::Measured(Box::new(measured))
    }
}
