//! Spectra, and their way to linear sRGB.
//!
//! Scene files speak of wavelengths (measured metals, glasses, lamps); the renderer of linear RGB
//! with sRGB primaries and a D65 white. What a spectrum is decides how it is converted:
//!
//! | spectrum | function | rule |
//! |---|---|---|
//! | reflectance | [`reflectance_to_rgb`] | under D65; reflectance 1 is `(1, 1, 1)` |
//! | emission | [`illuminant_to_rgb`], [`blackbody_to_rgb`] | scaled to luminance 1; D65 is `(1, 1, 1)` |
//! | complex index of a metal | [`conductor_index_to_rgb`] | the RGB reflectance is matched, not the index |
//! | index of a glass | [`Spectrum::value`] at [`D_LINE_NM`] | one index, no dispersion |

mod blackbody;
mod cie_1931;
mod colour;
mod colour_space;
mod conductor;
mod dispersion;
mod fluorescent;
mod illuminants;
mod many;
mod measured;
mod named;
mod observe;
mod piecewise;
mod spd;

pub use blackbody::blackbody_to_rgb;
pub use colour::{illuminant_to_rgb, reflectance_to_rgb};
pub(crate) use colour_space::{COLOUR_SPACES, ColourSpace, Primaries, white_balance};
pub use conductor::{ConductorFit, conductor_index_to_rgb, fit_conductor};
pub use dispersion::D_LINE_NM;
pub(crate) use many::SpectraToRgb;
pub use named::{NAMES, named};
pub(crate) use observe::{Weight, observe};
pub use piecewise::{Spectrum, SpectrumError};
pub use spd::{SpdError, SpdErrorKind, parse_spd};
