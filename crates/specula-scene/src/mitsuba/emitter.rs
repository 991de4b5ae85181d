//! `<emitter>`: lights that are not shapes, and the light of shapes.

use glam::{DMat4, DVec3, DVec4};
use specula_bsdf::Rgb;

use super::context::Context;
use super::element::Element;
use super::sensor::half_width;
use super::spectrum::SpectrumUse;
use super::texture::unknown;
use crate::error::SceneError;
use crate::image::Encoding;
use crate::num::f32_of;
use crate::scene::{
    ColourParam, Emission, EnvironmentMapping, ImageProjection, Light, Profile, SpotFalloff,
    Texture,
};

impl Context<'_> {
    /// The lights of an emitter that belongs to the scene.
    pub(super) fn lights(&mut self, element: &Element) -> Result<Vec<Light>, SceneError> {
        element.ignore(&["sampling_weight", "samples"]);
        Ok(match element.plugin.as_str() {
            "envmap" => vec![self.environment(element)?],
            "constant" => vec![Light::Infinite {
                radiance: self.even_colour(element, "radiance", 1.0, SpectrumUse::Emission)?,
                image: None,
                to_world: DMat4::IDENTITY,
            }],
            "point" => vec![Light::Point {
                position: position(element)?.to_array(),
                intensity: self.even_colour(element, "intensity", 1.0, SpectrumUse::Emission)?,
            }],
            "spot" => vec![self.spot(element)?],
            "directional" => vec![self.directional(element)?],
            "projector" => vec![self.projector(element)?],
            "sunsky" | "sun" | "sky" => self.sunsky(element)?,
            "timed_sunsky" => {
                let message = "\"timed_sunsky\" is rendered as \"sunsky\" at the default hour";
                element.properties.iter().for_each(|p| p.used.set(true));
                self.warn(&element.place, message);
                self.sunsky(element)?
            }
            "collimated" => {
                let message = "emitter \"collimated\" is a beam without width: it is left out";
                element.properties.iter().for_each(|p| p.used.set(true));
                self.warn(&element.place, message);
                Vec::new()
            }
            "area" | "directionalarea" => {
                let message = format!("{} belongs within a shape", element.title());
                return Err(element.error(message));
            }
            other => return Err(unknown("emitter", other, &element.place)),
        })
    }

    /// The emission of a shape.
    pub(super) fn emission(&mut self, element: &Element) -> Result<Emission, SceneError> {
        element.ignore(&["sampling_weight", "samples"]);
        match element.plugin.as_str() {
            "area" => {}
            "directionalarea" => {
                // Paths from the camera meet its one direction with probability 0: in Mitsuba, too,
                // only tracing particles from it shows its light.
                let message = "\"directionalarea\" lights nothing, as under Mitsuba's \"path\": only \
                               \"ptracer\" shows its beam";
                self.warn(&element.place, message);
                self.colour(element, "radiance", 1.0, SpectrumUse::Emission)?;
                return Ok(Emission {
                    radiance: ColourParam::Value(Rgb::BLACK),
                    two_sided: false,
                });
            }
            other => return Err(unknown("emitter", other, &element.place)),
        }
        Ok(Emission {
            radiance: self.colour(element, "radiance", 1.0, SpectrumUse::Emission)?,
            two_sided: false,
        })
    }

    /// A map by latitude and longitude whose first and last rows lie on the poles; y is up.
    fn environment(&mut self, element: &Element) -> Result<Light, SceneError> {
        element.ignore(&["mis_compensation", "cache"]);
        let (path, place) = self.needed_file(element, "filename")?;
        let gamma = element.number("gamma", -1.0)?;
        let encoding = if gamma == 1.0 {
            Encoding::Linear
        } else if gamma > 0.0 {
            Encoding::Gamma(f32_of(gamma))
        } else {
            Encoding::Srgb
        };
        let image = self.image(&path, &place, encoding)?;
        let scale = f32_of(element.not_negative("scale", 1.0)?);
        // The map's own azimuth runs from -z over +x about +y; the scene's from +x over +y about +z.
        let axes = DMat4::from_cols(-DVec4::Z, DVec4::X, DVec4::Y, DVec4::W);
        Ok(Light::Infinite {
            radiance: Rgb::splat(scale),
            image: Some((image, EnvironmentMapping::LatitudeLongitudePoles)),
            to_world: element.transform("to_world")? * axes,
        })
    }

    fn spot(&mut self, element: &Element) -> Result<Light, SceneError> {
        let to_world = element.transform("to_world")?;
        let cone_angle_deg = element.above_zero("cutoff_angle", 20.0)?;
        let falloff_start_deg = element.not_negative("beam_width", 0.75 * cone_angle_deg)?;
        if cone_angle_deg > 180.0 || falloff_start_deg > cone_angle_deg {
            let message = format!(
                "expected \"beam_width\" up to \"cutoff_angle\", and that up to 180 degrees, \
                 found {falloff_start_deg} and {cone_angle_deg}"
            );
            return Err(element.error(message));
        }
        let intensity = self.even_colour(element, "intensity", 1.0, SpectrumUse::Emission)?;
        if let ColourParam::Texture(texture) =
            self.colour(element, "texture", 1.0, SpectrumUse::Emission)?
        {
            if cone_angle_deg < 90.0 {
                return Ok(Light::Picture {
                    to_world,
                    intensity: ColourParam::Texture(self.times(texture, intensity)),
                    image_projection: ImageProjection::Window {
                        half: [cone_angle_deg.to_radians().tan(); 2],
                        profile: Profile::Spot {
                            cone_angle_deg,
                            falloff_start_deg,
                        },
                    },
                });
            }
            let place = element.place_of("texture");
            self.warn(
                &place,
                "the texture of a spot light of 90 degrees or more is left out",
            );
        }
        Ok(Light::Spot {
            position: to_world.transform_point3(DVec3::ZERO).to_array(),
            axis: axis(element, &to_world, DVec3::Z)?,
            intensity,
            cone_angle_deg,
            falloff_start_deg,
            falloff: SpotFalloff::LinearAngle,
        })
    }

    fn directional(&mut self, element: &Element) -> Result<Light, SceneError> {
        let along = match element.vector("direction")? {
            Some(direction) => direction,
            None => element.transform("to_world")?.transform_vector3(DVec3::Z),
        };
        Ok(Light::Distant {
            irradiance: self.even_colour(element, "irradiance", 1.0, SpectrumUse::Emission)?,
            to_light: axis(element, &DMat4::IDENTITY, -along)?,
            half_angle_deg: 0.0,
        })
    }

    /// `projector`, an inverse camera: its irradiance on the plane z = 1 is pi times its texture.
    fn projector(&mut self, element: &Element) -> Result<Light, SceneError> {
        element.ignore(&["near_clip", "far_clip"]);
        let to_world = element.transform("to_world")?;
        let irradiance = self.colour(element, "irradiance", 1.0, SpectrumUse::Emission)?;
        let scale = core::f64::consts::PI * element.not_negative("scale", 1.0)?;
        let factor = Rgb::splat(f32_of(scale));
        let aspect = self.aspect(irradiance);
        let half_width = half_width(element, aspect)?;
        // Cameras have x to the left, and the rows of pictures run down.
        let turned = DMat4::from_scale(DVec3::new(-1.0, -1.0, 1.0));
        Ok(Light::Picture {
            to_world: to_world * turned,
            intensity: match irradiance {
                ColourParam::Value(c) => ColourParam::Value(c * factor),
                ColourParam::Texture(id) => ColourParam::Texture(self.times(id, factor)),
            },
            image_projection: ImageProjection::Window {
                half: [half_width, half_width / aspect],
                profile: Profile::Irradiance,
            },
        })
    }

    /// Width over height of a texture's picture; 1 for other textures.
    fn aspect(&self, texture: ColourParam) -> f64 {
        let ColourParam::Texture(id) = texture else {
            return 1.0;
        };
        match self.textures[id.0] {
            Texture::Image { image, .. } => {
                let image = &self.images[image.0];
                f64::from(image.width) / f64::from(image.height)
            }
            Texture::Scale { a, .. } => self.aspect(ColourParam::Texture(a)),
            _ => 1.0,
        }
    }
}

fn position(element: &Element) -> Result<DVec3, SceneError> {
    match element.vector("position")? {
        Some(position) => Ok(position),
        None => Ok(element.transform("to_world")?.transform_point3(DVec3::ZERO)),
    }
}

/// A direction in the world, of length 1.
fn axis(element: &Element, to_world: &DMat4, local: DVec3) -> Result<[f64; 3], SceneError> {
    to_world
        .transform_vector3(local)
        .try_normalize()
        .map(|v| v.to_array())
        .ok_or_else(|| element.error(format!("{} has no direction", element.title())))
}
