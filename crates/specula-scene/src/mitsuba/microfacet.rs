//! Roughness and conductors.

use specula_bsdf::Rgb;
use specula_bsdf::ndf::Masking;

use super::context::Context;
use super::element::Element;
use super::metal;
use super::spectrum::SpectrumUse;
use super::texture::bad_choice;
use crate::error::{ErrorKind, SceneError};
use crate::num::shorten;
use crate::scene::{
    ColourParam, ConductorFresnel, FloatParam, MicrofacetDistribution, Roughness, RoughnessMapping,
};

impl Context<'_> {
    /// `distribution`, and `alpha` or `alpha_u` and `alpha_v`.
    pub(super) fn roughness(&mut self, element: &Element) -> Result<Roughness, SceneError> {
        // The sampling method does not change the picture.
        element.ignore(&["sample_visible"]);
        let distribution = match element.text("distribution")? {
            None | Some("beckmann") => MicrofacetDistribution::Beckmann,
            Some("ggx") => MicrofacetDistribution::Ggx,
            Some(other @ ("phong" | "as")) => {
                let message = format!("distribution \"{other}\" is read as \"beckmann\"");
                self.warn(&element.place_of("distribution"), message);
                MicrofacetDistribution::Beckmann
            }
            Some(other) => {
                return Err(bad_choice(
                    element,
                    "distribution",
                    other,
                    "beckmann or ggx",
                ));
            }
        };
        let (u, v) = if element.has("alpha_u") || element.has("alpha_v") {
            if element.has("alpha") {
                let message = "\"alpha\" excludes \"alpha_u\" and \"alpha_v\"";
                let place = element.place_of("alpha");
                return Err(SceneError::new(ErrorKind::Parameter, &place, message));
            }
            for name in ["alpha_u", "alpha_v"] {
                if !element.has(name) {
                    let message = format!("{} needs its \"{name}\", too", element.title());
                    return Err(element.error(message));
                }
            }
            (
                self.alpha(element, "alpha_u")?,
                self.alpha(element, "alpha_v")?,
            )
        } else {
            let alpha = self.alpha(element, "alpha")?;
            (alpha, alpha)
        };
        Ok(Roughness {
            u,
            v,
            mapping: RoughnessMapping::Alpha,
            distribution,
            masking: Masking::Separable,
            rotation_rad: 0.0,
        })
    }

    fn alpha(&mut self, element: &Element, name: &str) -> Result<FloatParam, SceneError> {
        let alpha = self.float(element, name, 0.1)?;
        if let FloatParam::Value(x) = alpha
            && let Some((message, most)) = RoughnessMapping::Alpha.too_wide(name, x)
        {
            self.warn(&element.place_of(name), message);
            return Ok(FloatParam::Value(most));
        }
        Ok(alpha)
    }

    /// A number in `[0, 1]`; larger ones are clamped.
    pub(super) fn share(
        &mut self,
        element: &Element,
        name: &str,
        default: f32,
    ) -> Result<FloatParam, SceneError> {
        let value = self.float(element, name, default)?;
        if let FloatParam::Value(x) = value
            && x > 1.0
        {
            let message = format!("\"{name}\": a share above 1 is taken for 1");
            self.warn(&element.place_of(name), message);
            return Ok(FloatParam::Value(1.0));
        }
        Ok(value)
    }

    /// `eta` and `k`, or `material`.
    pub(super) fn conductor(&mut self, element: &Element) -> Result<ConductorFresnel, SceneError> {
        // The 0.6 dialect's index of what is outside: air, as good as always.
        element.ignore(&["ext_eta"]);
        let default = if element.legacy { "Cu" } else { "none" };
        let material = element.text("material")?;
        if element.has("eta") || element.has("k") {
            if material.is_some() {
                let message = "\"material\" excludes \"eta\" and \"k\"";
                let place = element.place_of("material");
                return Err(SceneError::new(ErrorKind::Parameter, &place, message));
            }
            return Ok(ConductorFresnel::Index {
                eta: self.colour(element, "eta", 0.0, SpectrumUse::Unbounded)?,
                k: self.colour(element, "k", 1.0, SpectrumUse::Unbounded)?,
            });
        }
        let name = material.unwrap_or(default);
        if name == "none" {
            return Ok(ConductorFresnel::Mirror);
        }
        let Some((eta, k)) = metal::named(name) else {
            let message = format!("no metal is called \"{}\"", shorten(name));
            let place = element.place_of("material");
            return Err(SceneError::new(ErrorKind::UnknownName, &place, message)
                .with_help("expected a chemical symbol such as Al, Ag, Au, Cr, Cu, or none"));
        };
        Ok(ConductorFresnel::Index {
            eta: ColourParam::Value(eta),
            k: ColourParam::Value(k),
        })
    }

    /// Largest channel or mean value of a parameter, for weights that need not be exact.
    pub(super) fn brightness(&self, param: ColourParam) -> f32 {
        use crate::scene::Texture;
        let ColourParam::Texture(id) = param else {
            return match param {
                ColourParam::Value(c) => c.luminance(),
                ColourParam::Texture(_) => 0.5,
            };
        };
        match self.textures.get(id.0) {
            Some(Texture::Image { image, .. }) => {
                let image = &self.images[image.0];
                let mut sum = [0.0_f64; 3];
                for pixel in image.pixels.iter() {
                    for (s, v) in sum.iter_mut().zip(pixel) {
                        *s += f64::from(v);
                    }
                }
                let [r, g, b] =
                    sum.map(|s| crate::num::f32_of(s / image.pixels.len().max(1) as f64));
                Rgb { r, g, b }.luminance()
            }
            _ => 0.5,
        }
    }

    /// A parameter times a factor.
    pub(super) fn scaled_colour(&mut self, param: ColourParam, factor: f32) -> ColourParam {
        match param {
            ColourParam::Value(c) => ColourParam::Value(c.map(|x| (x * factor).min(1.0))),
            ColourParam::Texture(id) => ColourParam::Texture(self.times(id, Rgb::splat(factor))),
        }
    }

    /// A number times a factor.
    pub(super) fn scaled_float(&mut self, param: FloatParam, factor: f32) -> FloatParam {
        match param {
            FloatParam::Value(x) => FloatParam::Value(x * factor),
            FloatParam::Texture(id) => FloatParam::Texture(self.times(id, Rgb::splat(factor))),
        }
    }
}
