//! Alphas of a distribution of microfacet normals.

use crate::math::{Real, Vec3, vec3};

/// Alphas `(alpha_x, alpha_y)` along the tangents, each in `[1e-4, 10]`.
///
/// This is the alpha of the formulas, not an artist's roughness. A renderer treats a surface as
/// smooth where both alphas lie below [`Alpha::SPECULAR_BELOW`].
///
/// [`Alpha::new`] and [`Alpha::clamped`] hold the range. Values written to the fields are not
/// checked: outside of the range lobes stay free of panics, but not of infinities.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Alpha<T> {
    /// Along the local x.
    pub x: T,
    /// Along the local y.
    pub y: T,
}

/// An alpha outside `[1e-4, 10]`, or NaN.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("alpha must lie in [1e-4, 10], not ({x}, {y})")]
#[non_exhaustive]
pub struct AlphaError {
    /// What was given for the local x.
    pub x: f64,
    /// What was given for the local y.
    pub y: f64,
}

impl<T: Real> Alpha<T> {
    /// Below this in both directions a renderer uses the smooth lobe instead: the highlight is
    /// narrower than f32 directions resolve.
    pub const SPECULAR_BELOW: f64 = 1e-3;
    /// Smallest alpha.
    pub const MIN: f64 = 1e-4;
    /// Largest alpha.
    pub const MAX: f64 = 10.0;

    /// Both alphas, checked.
    ///
    /// # Errors
    /// Where an alpha is outside `[1e-4, 10]` or NaN.
    pub fn new(x: T, y: T) -> Result<Self, AlphaError> {
        // f32 rounds 1e-4 down: compare in the type itself.
        let fits = |a: T| a >= T::of(Self::MIN) && a <= T::of(Self::MAX);
        if fits(x) && fits(y) {
            Ok(Self { x, y })
        } else {
            Err(AlphaError {
                x: x.to_f64(),
                y: y.to_f64(),
            })
        }
    }

    /// The nearest alphas in `[1e-4, 10]`; NaN becomes 1e-4.
    #[inline(always)]
    pub fn clamped(x: T, y: T) -> Self {
        let fit = |a: T| a.at_least(T::of(Self::MIN)).at_most(T::of(Self::MAX));
        Self {
            x: fit(x),
            y: fit(y),
        }
    }

    /// The same alpha in both directions, clamped.
    #[inline(always)]
    pub fn isotropic(a: T) -> Self {
        Self::clamped(a, a)
    }

    /// `(alpha_x x, alpha_y y, z)`, not normalised: takes a direction to the configuration of unit
    /// roughness (the hemisphere configuration of Heitz 2018), and a normal of that configuration
    /// back.
    #[inline(always)]
    pub fn stretch(self, w: Vec3<T>) -> Vec3<T> {
        vec3(self.x * w.x, self.y * w.y, w.z)
    }
}

/// Checked as by [`Alpha::new`].
#[cfg(feature = "serde")]
impl<'de, T: Real + serde::Deserialize<'de>> serde::Deserialize<'de> for Alpha<T> {
    fn deserialize<D: serde::Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        /// The same fields, not yet checked.
        #[derive(serde::Deserialize)]
        #[serde(rename = "Alpha")]
        struct Unchecked<T> {
            x: T,
            y: T,
        }
        let Unchecked { x, y } = Unchecked::deserialize(from)?;
        Self::new(x, y).map_err(serde::de::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_range_is_held_and_nan_is_refused() {
        assert!(Alpha::new(1e-4_f32, 10.0).is_ok());
        assert!(Alpha::new(9e-5_f64, 1.0).is_err());
        assert!(Alpha::new(f32::NAN, 1.0).is_err());
        assert!(Alpha::new(-0.1_f64, 0.5).is_err());
        let c = Alpha::clamped(f32::NAN, 20.0);
        assert_eq!((c.x, c.y), (1e-4, 10.0));
    }
}
