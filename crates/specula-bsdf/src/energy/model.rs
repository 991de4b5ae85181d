//! Which compensation, and its factors.
//!
//! With `L = 1 - E` the loss of a white surface (`albedo`), and `F_ms` the share of the lost light
//! that a coloured one still reflects:
//!
//! ```text
//! Turquin 2019:                  f = f_ss (1 + F_ms L(wo) / E(wo))
//! Kulla and Conty 2017:          f = f_ss + F_ms L(wo) L(wi) / (pi L_avg)
//! ```
//!
//! Both reflect all light where `F = 1`. Kulla and Conty's is reciprocal; Turquin's is not, but its
//! lobe has the shape and the sampler of the single-scattering one.

use alloc::borrow::ToOwned;
use alloc::string::String;
use core::fmt;
use core::str::FromStr;

use crate::math::{Real, Rgb};

/// The colour of the light that Turquin's factor adds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum FmsVariant {
    /// `F_ms = F0`, the reflectance at normal incidence: one more bounce. Turquin 2019.
    #[default]
    NormalIncidence,
    /// The sum over all further bounces with averages in place of angles,
    ///
    /// ```text
    /// F_ms = F_avg E_avg / (1 - F_avg L_avg)
    /// ```
    ///
    /// of Kulla and Conty 2017 less one factor `F_avg`, which `f_ss` has already.
    AverageSeries,
}

/// How a rough metal compensates for the energy that single scattering loses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum EnergyModel {
    /// The single-scattering lobe scaled by view. Turquin 2019, Practical multiple scattering
    /// compensation for microfacet models.
    Turquin(FmsVariant),
    /// A second, broad lobe. Kulla and Conty 2017, Revisiting physically based shading at
    /// Imageworks.
    KullaConty,
}

impl fmt::Display for EnergyModel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Turquin(FmsVariant::NormalIncidence) => "turquin",
            Self::Turquin(FmsVariant::AverageSeries) => "turquin-series",
            Self::KullaConty => "kulla-conty",
        })
    }
}

/// A name of no energy compensation.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no such energy compensation: '{0}' (expected turquin, turquin-series or kulla-conty)")]
pub struct UnknownEnergyModel(pub String);

impl FromStr for EnergyModel {
    type Err = UnknownEnergyModel;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        match name {
            "turquin" => Ok(Self::Turquin(FmsVariant::NormalIncidence)),
            "turquin-series" => Ok(Self::Turquin(FmsVariant::AverageSeries)),
            "kulla-conty" => Ok(Self::KullaConty),
            _ => Err(UnknownEnergyModel(name.to_owned())),
        }
    }
}

/// The share of light that all bounces after the first reflect, given their average reflectance:
///
/// ```text
/// F_avg E_avg sum_k (F_avg L_avg)^k = F_avg E_avg / (1 - F_avg L_avg)
/// ```
///
/// * `loss`: `L_avg`, in `[0, 1]`.
///
/// Source: Kulla and Conty 2017.
#[inline(always)]
pub fn further_bounces<T: Real>(average: Rgb<T>, loss: T) -> Rgb<T> {
    average.map(|f| f * (T::ONE - loss) / (T::ONE - f * loss).at_least(T::TINY))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_back() {
        for name in ["turquin", "turquin-series", "kulla-conty"] {
            assert_eq!(name.parse::<EnergyModel>().unwrap().to_string(), name);
        }
        assert!("kulla".parse::<EnergyModel>().is_err());
    }

    #[test]
    fn white_walls_lose_nothing_and_the_series_is_its_sum() {
        assert_eq!(further_bounces(Rgb::splat(1.0), 0.3), Rgb::splat(1.0));
        let (f, loss): (f64, f64) = (0.6, 0.4);
        let mut sum = 0.0;
        let mut left = f;
        for _ in 0..200 {
            sum += left * (1.0 - loss);
            left *= loss * f;
        }
        assert!((further_bounces(Rgb::splat(f), loss).g - sum).abs() < 1e-15);
    }
}
