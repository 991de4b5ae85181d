//! A reflectance times a colour.

use super::{Conductor, F82Tint, Reflectance, Schlick};
use crate::math::{Real, Rgb};

/// `F = tint F'`: the factor on a metal's reflection that file formats offer artists.
///
/// Made by [`Reflectance::tinted`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tinted<T> {
    pub(crate) tint: Rgb<T>,
    pub(crate) of: Untinted<T>,
}

/// The reflectance under a tint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Untinted<T> {
    Conductor(Conductor<T>),
    Schlick(Schlick<T>),
    F82Tint(F82Tint<T>),
}

impl<T: Real> Tinted<T> {
    /// Reflectance at `cos`, in `[0, 1]`.
    #[inline(always)]
    pub fn eval(&self, cos: T) -> Rgb<T> {
        self.tint
            * match &self.of {
                Untinted::Conductor(f) => f.eval(cos),
                Untinted::Schlick(f) => f.eval(cos),
                Untinted::F82Tint(f) => f.eval(cos),
            }
    }
}

impl<T: Real> Reflectance<T> {
    /// The same reflectance times `tint`, in `[0, 1]`.
    #[inline(always)]
    #[must_use]
    pub fn tinted(self, tint: Rgb<T>) -> Self {
        let with = |of| Self::Tinted(Tinted { tint, of });
        match self {
            _ if tint == Rgb::WHITE => self,
            Self::Constant(colour) => Self::Constant(colour * tint),
            Self::Conductor(f) => with(Untinted::Conductor(f)),
            Self::Schlick(f) => with(Untinted::Schlick(f)),
            Self::F82Tint(f) => with(Untinted::F82Tint(f)),
            Self::Tinted(f) => Self::Tinted(Tinted {
                tint: f.tint * tint,
                ..f
            }),
        }
    }

    /// The same surface under a medium of index `eta` instead of vacuum, where an index is known.
    #[inline]
    #[must_use]
    pub fn under(self, eta: T) -> Self {
        match self {
            Self::Conductor(f) => Self::Conductor(f.under(eta)),
            Self::Tinted(Tinted {
                tint,
                of: Untinted::Conductor(f),
            }) => Self::Conductor(f.under(eta)).tinted(tint),
            other => other,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::rgb;

    #[test]
    fn a_tint_is_a_factor_and_tints_multiply() {
        let f0 = rgb(0.9, 0.5, 0.2);
        let metal = Conductor {
            eta: rgb(0.2, 0.9, 1.1),
            k: rgb(3.9, 2.4, 2.1),
        };
        let tint = rgb(0.5, 0.25, 1.0);
        for whole in [
            Reflectance::Constant(f0),
            Reflectance::Conductor(metal),
            Reflectance::Schlick(Schlick { f0 }),
            Reflectance::F82Tint(F82Tint::new(f0, Rgb::splat(0.7))),
        ] {
            assert_eq!(whole.tinted(Rgb::WHITE), whole);
            for i in 0..=10 {
                let cos = f64::from(i) / 10.0;
                let expected = whole.eval(cos) * tint;
                assert_eq!(whole.tinted(tint).eval(cos), expected);
                let twice = whole.tinted(tint).tinted(tint).eval(cos);
                assert!(((twice - expected * tint).max_channel()).abs() < 1e-15);
            }
        }
        let under = Reflectance::Conductor(metal).tinted(tint).under(1.5);
        assert_eq!(under.eval(0.4), metal.under(1.5).eval(0.4) * tint);
    }
}
