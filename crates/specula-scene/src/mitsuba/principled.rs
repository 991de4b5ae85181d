//! `principled` and `principledthin`.

use super::context::Context;
use super::element::Element;
use super::spectrum::SpectrumUse;
use crate::error::{ErrorKind, SceneError};
use crate::num::f32_of;
use crate::scene::{FloatParam, PrincipledMaterial};

impl Context<'_> {
    pub(super) fn principled(
        &mut self,
        element: &Element,
        thin: bool,
    ) -> Result<PrincipledMaterial, SceneError> {
        // The probabilities of lobes do not change the picture.
        element.ignore(&[
            "main_specular_sampling_rate",
            "clearcoat_sampling_rate",
            "diffuse_reflectance_sampling_rate",
            "specular_reflectance_sampling_rate",
            "specular_transmittance_sampling_rate",
            "diffuse_transmittance_sampling_rate",
        ]);
        let zero = FloatParam::Value(0.0);
        let thick = |context: &mut Self, name: &str| {
            if thin {
                Ok(zero)
            } else {
                context.share(element, name, 0.0)
            }
        };
        Ok(PrincipledMaterial {
            base_colour: self.colour(element, "base_color", 0.5, SpectrumUse::Reflectance)?,
            roughness: self.share(element, "roughness", 0.5)?,
            anisotropic: self.share(element, "anisotropic", 0.0)?,
            metallic: thick(self, "metallic")?,
            spec_trans: self.share(element, "spec_trans", 0.0)?,
            eta: if thin {
                f32_of(element.above_zero("eta", 1.5)?)
            } else {
                eta(element)?
            },
            spec_tint: self.share(element, "spec_tint", 0.0)?,
            sheen: self.float(element, "sheen", 0.0)?,
            sheen_tint: self.share(element, "sheen_tint", 0.0)?,
            clearcoat: thick(self, "clearcoat")?,
            clearcoat_gloss: thick(self, "clearcoat_gloss")?,
            flatness: self.share(element, "flatness", 0.0)?,
            diff_trans: if thin {
                self.float(element, "diff_trans", 0.0)?
            } else {
                zero
            },
            thin,
        })
    }
}

/// `eta`, or the index that gives a reflectance of `0.08 specular` at the normal.
fn eta(element: &Element) -> Result<f32, SceneError> {
    // Mitsuba avoids an index of exactly 1 for transmitted light.
    let lets_through = element.has("spec_trans");
    if !element.has("eta") {
        let mut specular = element.not_negative("specular", 0.5)?;
        if specular >= 12.5 {
            return Err(element.error("\"specular\": expected a number below 12.5"));
        }
        if lets_through && specular == 0.0 {
            specular = 1e-3;
        }
        return Ok(f32_of(2.0 / (1.0 - (0.08 * specular).sqrt()) - 1.0));
    }
    if element.has("specular") {
        let message = "\"eta\" and \"specular\" exclude each other";
        let place = element.place_of("specular");
        return Err(SceneError::new(ErrorKind::Parameter, &place, message));
    }
    let eta = element.above_zero("eta", 1.5)?;
    let is_one = lets_through && eta == 1.0;
    Ok(f32_of(if is_one { 1.001 } else { eta }))
}
