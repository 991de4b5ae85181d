//! The medium between a coat and its base.

use specula_bsdf::Rgb;

use super::texture::{ColourParam, FloatParam};

/// The medium between a coat and its base, and how far light is followed in it: parameters of
/// pbrt-v4's layered materials.
///
/// The default is no medium, and light that is followed until it leaves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoatMedium {
    /// Optical thickness, from 0 up: of light that crosses the medium at the cosine `mu`, the share
    /// `exp(-thickness / mu)` passes; the rest is absorbed or, where `albedo` is not black, scattered.
    pub thickness: FloatParam,
    /// Events after which light that has not left is lost: an event is the base, the coat from
    /// within, or a scattering by the medium. `None`: no limit.
    pub max_depth: Option<u32>,
    /// Walks that are averaged where a renderer estimates the material's value (pbrt's `nsamples`):
    /// noise only.
    pub samples: u32,
    /// Single-scattering albedo of the medium; black for a medium that only absorbs.
    pub albedo: ColourParam,
    /// Asymmetry of the medium's scattering (Henyey and Greenstein's), in `[-1, 1]`.
    pub g: FloatParam,
}

impl Default for CoatMedium {
    fn default() -> Self {
        Self {
            thickness: FloatParam::Value(0.0),
            max_depth: None,
            samples: 1,
            albedo: ColourParam::Value(Rgb::BLACK),
            g: FloatParam::Value(0.0),
        }
    }
}

impl CoatMedium {
    /// Whether light is scattered between coat and base.
    #[must_use]
    pub fn scatters(&self) -> bool {
        self.albedo != ColourParam::Value(Rgb::BLACK)
    }
}
