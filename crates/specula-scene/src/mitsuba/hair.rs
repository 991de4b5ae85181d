//! Mitsuba 3's `hair`, which is of pbrt-v4's form, and the shapes that are its fibres.

use specula_bsdf::Rgb;

use super::context::Context;
use super::element::Element;
use super::spectrum::SpectrumUse;
use crate::error::SceneError;
use crate::num::f32_of;
use crate::scene::{ColourParam, FloatParam, HairMaterial, HairPigment};

/// A warning about hair on other shapes than curves.
pub(super) const NO_FIBRE: &str = "bsdf \"hair\" is meant for shape \"bsplinecurve\": here every \
                                   hit is one of a fibre along dp/du";

/// How deep wrappers around hair are looked into.
const MOST_WRAPPERS: usize = 8;

/// Whether a shape's material is hair.
pub(super) fn is_of_hair(context: &Context, shape: &Element) -> Result<bool, SceneError> {
    let mut inner = context.children(shape, "bsdf")?;
    for _ in 0..MOST_WRAPPERS {
        let [bsdf] = inner.as_slice() else {
            return Ok(false);
        };
        match bsdf.plugin.as_str() {
            "hair" => return Ok(!bsdf.legacy),
            "twosided" | "mask" | "bumpmap" | "normalmap" => {
                inner = context.children(&bsdf.clone(), "bsdf")?;
            }
            _ => return Ok(false),
        }
    }
    Ok(false)
}

impl Context<'_> {
    pub(super) fn hair(&mut self, element: &Element) -> Result<HairMaterial, SceneError> {
        // What `scale` scales is not there, or the others follow from it.
        element.ignore(&["scale"]);
        let roughness = |name: &str| -> Result<FloatParam, SceneError> {
            let x = element.number(name, 0.3)?;
            if !(0.0..=1.0).contains(&x) {
                let message = format!("\"{name}\": expected a number from 0 to 1, found {x}");
                element.record(element.error(message))?;
            }
            Ok(FloatParam::Value(f32_of(x.clamp(0.0, 1.0))))
        };
        let concentration = |name: &str, default: f64| -> Result<FloatParam, SceneError> {
            let x = element.not_negative(name, default)?;
            Ok(FloatParam::Value(f32_of(x)))
        };
        let pigment = if element.has("sigma_a") {
            if element.has("eumelanin") || element.has("pheomelanin") {
                let message = "\"sigma_a\" and concentrations of melanin exclude each other";
                element.record(element.error(message))?;
            }
            let scale = f32_of(element.not_negative("scale", 1.0)?);
            let sigma_a = self.colour(element, "sigma_a", 0.0, SpectrumUse::Unbounded)?;
            HairPigment::Absorption(match sigma_a {
                ColourParam::Value(c) => ColourParam::Value(c * scale),
                ColourParam::Texture(id) => ColourParam::Texture(self.times(id, Rgb::splat(scale))),
            })
        } else {
            HairPigment::Melanin {
                eumelanin: concentration("eumelanin", 1.3)?,
                pheomelanin: concentration("pheomelanin", 0.2)?,
            }
        };
        Ok(HairMaterial {
            pigment,
            eta: FloatParam::Value(self.relative_index(element, "amber")?),
            beta_m: roughness("longitudinal_roughness")?,
            beta_n: roughness("azimuthal_roughness")?,
            alpha_deg: FloatParam::Value(f32_of(element.number("scale_tilt", 2.0)?)),
        })
    }
}
