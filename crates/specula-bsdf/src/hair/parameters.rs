//! What a fibre is made of.

use crate::math::{Real, Rgb, rgb};

/// The parameters of [`Hair`](super::Hair).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct HairParameters<T> {
    /// Absorption within the fibre, per its radius; negative values count as 0.
    pub sigma_a: Rgb<T>,
    /// Index of refraction of the fibre over that around it, above 0.
    pub eta: T,
    /// Longitudinal roughness, clamped to `[0.01, 1]`.
    pub beta_m: T,
    /// Azimuthal roughness, clamped to `[0.01, 1]`.
    pub beta_n: T,
    /// Tilt of the scales towards the root, in degrees. The fibre grows along x.
    pub alpha_deg: T,
}

impl<T: Real> Default for HairParameters<T> {
    /// Brown hair, as pbrt-v4's material without parameters.
    fn default() -> Self {
        Self {
            sigma_a: absorption_of_melanin(T::of(1.3), T::ZERO),
            eta: T::of(1.55),
            beta_m: T::of(0.3),
            beta_n: T::of(0.3),
            alpha_deg: T::TWO,
        }
    }
}

/// Absorption of hair with so much of its two pigments, per radius of the fibre.
///
/// ```text
/// sigma_a = eumelanin (0.419, 0.697, 1.37) + pheomelanin (0.187, 0.4, 1.05)
/// ```
///
/// * `eumelanin`: about 8 in black hair, 1.3 in brown hair, 0.3 in blond hair; negative concentrations count as 0.
///
/// Source: d'Eon et al. 2011, section 6.1.
#[must_use]
pub fn absorption_of_melanin<T: Real>(eumelanin: T, pheomelanin: T) -> Rgb<T> {
    let of = |r, g, b| rgb(T::of(r), T::of(g), T::of(b));
    of(0.419, 0.697, 1.37) * eumelanin.at_least(T::ZERO)
        + of(0.187, 0.4, 1.05) * pheomelanin.at_least(T::ZERO)
}

/// Absorption of fibres of which many together have a colour, per radius of the fibre.
///
/// ```text
/// sigma_a = (ln(C) / P(beta_n))^2,   P(b) = 5.969 - 0.215 b + 2.532 b^2 - 10.73 b^3 + 5.574 b^4 + 0.245 b^5
/// ```
///
/// * `colour`: clamped to `[1e-30, 1]`.
///
/// Source: Chiang et al. 2016, section 4.2, equation 9.
#[must_use]
pub fn absorption_of_colour<T: Real>(colour: Rgb<T>, beta_n: T) -> Rgb<T> {
    let p = albedo_polynomial(beta_n);
    colour.map(|c| (c.within(T::of(1e-30), T::ONE).ln() / p).squared())
}

/// The colour that many fibres have together: the inverse of [`absorption_of_colour`].
#[must_use]
pub fn colour_of_absorption<T: Real>(sigma_a: Rgb<T>, beta_n: T) -> Rgb<T> {
    let p = albedo_polynomial(beta_n);
    sigma_a.map(|sigma| (-sigma.safe_sqrt() * p).exp())
}

fn albedo_polynomial<T: Real>(beta_n: T) -> T {
    let b = beta_n.within(T::ZERO, T::ONE);
    let mut p = T::of(0.245);
    for c in [5.574, -10.73, 2.532, -0.215, 5.969] {
        p = p * b + T::of(c);
    }
    p
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_and_absorptions_are_inverses() {
        for beta_n in [0.0, 0.3, 1.0] {
            let colour = rgb(0.8, 0.05, 1.0);
            let back = colour_of_absorption(absorption_of_colour(colour, beta_n), beta_n);
            assert!(
                (back - colour).map(f64::abs).max_channel() < 1e-12,
                "{back:?}"
            );
        }
        // P(0) = 5.969.
        let one = absorption_of_colour(Rgb::splat((-5.969_f64).exp()), 0.0);
        assert!((one.r - 1.0).abs() < 1e-12);
        for extreme in [0.0, -1.0, f32::NAN, f32::INFINITY] {
            assert!(absorption_of_colour(Rgb::splat(extreme), extreme).is_finite());
        }
    }
}
