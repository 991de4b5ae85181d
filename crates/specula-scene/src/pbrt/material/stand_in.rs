//! Materials that are not simulated, and what is shown in their place.

use specula_bsdf::Rgb;

use super::roughness;
use crate::error::{ErrorKind, SceneError};
use crate::media::MEDIA;
use crate::num::{f32_of, shorten};
use crate::pbrt::colour::{self, Colour};
use crate::pbrt::context::{Context, Entity};
use crate::pbrt::param::ParamList;
use crate::scene::{CoatMedium, ColourParam, MaterialKind};

/// Subsurface scattering: a coat over Lambert of the albedo that the medium has from outside.
pub(super) fn subsurface(
    context: &mut Context,
    entity: &Entity,
) -> Result<MaterialKind, SceneError> {
    let params = &entity.params;
    let message = "material \"subsurface\" is not supported: light leaves where it enters, from a \
                   coated diffuse surface of the medium's albedo";
    context.warn(&entity.place, message);
    params.ignore(&["mfp", "scale"]);
    let eta = match params.find("eta") {
        Some(_) => colour::index(context, params, "eta")?,
        None => 1.33,
    };
    Ok(MaterialKind::CoatedDiffuse {
        reflectance: medium_albedo(context, params)?,
        eta,
        roughness: roughness(context, params, "")?,
        medium: CoatMedium::default(),
        // Only light that enters is lost by pbrt's interface there.
        lossless: true,
    })
}

fn medium_albedo(context: &mut Context, params: &ParamList) -> Result<ColourParam, SceneError> {
    let g = params.float("g", 0.0)?.clamp(-0.99, 0.99);
    if let Some((name, place)) = params.string("name")? {
        let Some((_, scattering, absorption)) = MEDIA.iter().find(|m| m.0 == name) else {
            let message = format!(
                "medium \"{}\" is not known: albedo 0.5 is used",
                shorten(name)
            );
            context.warn(place, message);
            return Ok(ColourParam::Value(Rgb::splat(0.5)));
        };
        return Ok(albedo_of(*absorption, *scattering));
    }
    if let Some(reflectance) = colour::albedo_or_none(context, params, "reflectance")? {
        return Ok(reflectance);
    }
    let values = |name: &str| -> Result<Option<[f64; 3]>, SceneError> {
        let given = colour::colour(context, params, name)?;
        Ok(match given.as_ref().map(Colour::under_white) {
            Some(ColourParam::Value(c)) => Some(c.to_array().map(f64::from)),
            Some(ColourParam::Texture(_)) | None => None,
        })
    };
    match (values("sigma_a")?, values("sigma_s")?) {
        (Some(a), Some(s)) => Ok(albedo_of(a, s.map(|s| s * (1.0 - g)))),
        (None, None) => {
            let (_, scattering, absorption) = MEDIA[MEDIA.len() - 1];
            Ok(albedo_of(absorption, scattering))
        }
        (a, _) => {
            let (given, missing) = match a {
                Some(_) => ("sigma_a", "sigma_s"),
                None => ("sigma_s", "sigma_a"),
            };
            let message = format!("\"{given}\" is given without a value of \"{missing}\"");
            let place = params.place_of(given);
            Err(SceneError::new(ErrorKind::Parameter, &place, message))
        }
    }
}

/// Diffuse albedo of a half space from absorption and reduced scattering.
///
/// ```text
/// R = (1 - s) (1 - 0.139 s) / (1 + 1.17 s),   s = sqrt(a / (a + s'))
/// ```
///
/// Source: van de Hulst 1980, section 14.4.2 (isotropic scattering, no boundary).
fn albedo_of(absorption: [f64; 3], scattering: [f64; 3]) -> ColourParam {
    let [r, g, b] = std::array::from_fn(|i| {
        let (a, s) = (absorption[i].max(0.0), scattering[i].max(0.0));
        let s = (a / (a + s).max(1e-300)).sqrt().min(1.0);
        f32_of((1.0 - s) * (1.0 - 0.139 * s) / (1.0 + 1.17 * s))
    });
    ColourParam::Value(Rgb { r, g, b })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn media_without_absorption_are_white_and_without_scattering_black() {
        assert_eq!(albedo_of([0.0; 3], [1.0; 3]), ColourParam::WHITE);
        let black = ColourParam::Value(Rgb::BLACK);
        assert_eq!(albedo_of([1.0; 3], [0.0; 3]), black);
        // Jensen et al. 2001, figure 5, gives skim milk the diffuse albedo (.81, .81, .69) by their
        // approximation with a boundary; without one it is brighter.
        let (_, s, a) = MEDIA[7];
        let ColourParam::Value(c) = albedo_of(a, s) else {
            panic!()
        };
        assert!(c.r > 0.81 && c.b > 0.69 && c.b < c.r, "{c:?}");
    }
}
