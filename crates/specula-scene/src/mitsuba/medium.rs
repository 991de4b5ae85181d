//! `<medium>`: absorption by media. Scattering is not simulated.

use std::rc::Rc;

use specula_bsdf::Rgb;

use super::bsdf::Surface;
use super::context::Context;
use super::element::{Element, Property};
use super::spectrum::SpectrumUse;
use super::texture::{Role, unknown};
use crate::error::SceneError;
use crate::media::{self, Coefficients, Homogeneous};
use crate::num::{f32_of, shorten};
use crate::scene::{Material, MaterialId};

/// Integrators that render media; the last are those of the 0.6 dialect.
const SEE_MEDIA: [&str; 9] = [
    "volpath",
    "volpathmis",
    "prbvolpath",
    "volpath_simple",
    "bdpt",
    "pssmlt",
    "mlt",
    "erpt",
    "photonmapper",
];

/// A shape's media, by the place of their elements.
pub(super) type Sides = [Option<usize>; 2];

impl Context<'_> {
    /// Reads what decides whether media are rendered: the integrator's name, and the medium that the
    /// camera is in.
    pub(super) fn look_for_media(&mut self, root: &Element) -> Result<(), SceneError> {
        if let Some(sensor) = self.children(root, "sensor")?.first() {
            let medium = self.children(sensor, "medium")?.into_iter().next();
            self.camera_medium = medium.map(|m| Rc::as_ptr(&m) as usize);
        }
        let mut within = self.children(root, "integrator")?.into_iter().next();
        // Those that hold another are not deep.
        for _ in 0..self.limits.max_depth {
            let Some(element) = within else {
                break;
            };
            self.sees_media = SEE_MEDIA.contains(&element.plugin.as_str());
            within = self.children(&element, "integrator")?.into_iter().next();
        }
        Ok(())
    }

    /// A surface that bounds the media of its shape.
    pub(super) fn bounded(
        &mut self,
        element: &Element,
        surface: Surface,
    ) -> Result<Surface, SceneError> {
        let mut sides: Sides = [None; 2];
        let mut absorption = [Rgb::BLACK; 2];
        for property in &element.properties {
            let Some(medium) = self.plugin(property)?.filter(|e| e.class == "medium") else {
                continue;
            };
            property.used.set(true);
            let side = match property.name.as_str() {
                "interior" => 0,
                "exterior" => 1,
                _ => {
                    let message = "expected the name \"interior\" or \"exterior\" of a medium";
                    element.record(property.error(message))?;
                    continue;
                }
            };
            sides[side] = Some(Rc::as_ptr(&medium) as usize);
            absorption[side] = self.absorption(&medium)?;
        }
        // A medium that does not absorb has no effect.
        if sides == [None; 2] || absorption.iter().all(|a| a.is_black()) {
            return Ok(surface);
        }
        let key = (surface.material, sides);
        let material = match self.bounding.get(&key) {
            Some(id) => *id,
            None => self.add_bounding(key, absorption),
        };
        Ok(Surface {
            material,
            ..surface
        })
    }

    fn add_bounding(
        &mut self,
        key: (MaterialId, Sides),
        [inside, around]: [Rgb<f32>; 2],
    ) -> MaterialId {
        let copy = Material {
            absorption: inside,
            around: Some(around),
            ..self.materials[key.0.0].clone()
        };
        let id = self.add_material(copy);
        self.bounding.insert(key, id);
        id
    }

    /// Absorption of a medium per scene unit; black where it is empty space.
    fn absorption(&mut self, element: &Rc<Element>) -> Result<Rgb<f32>, SceneError> {
        let key = Rc::as_ptr(element) as usize;
        if let Some(absorption) = self.media.get(&key) {
            return Ok(*absorption);
        }
        let title = match &element.id {
            Some(id) => format!("medium \"{}\"", shorten(id)),
            None => element.title(),
        };
        let read = self.medium(element);
        let medium = element.or(read, || None)?;
        let (absorption, warning) = match medium {
            _ if !self.sees_media => {
                let message = "is empty space, as with Mitsuba's integrator in this file";
                (Rgb::BLACK, Some(format!("{title} {message}")))
            }
            None => {
                let message = "varies in space: it is empty space here";
                (Rgb::BLACK, Some(format!("{title} {message}")))
            }
            Some(_) if self.camera_medium == Some(key) => {
                let message = format!("the camera is in {title}, which is empty space here");
                (Rgb::BLACK, Some(message))
            }
            Some(medium) => (medium.absorption, medium.left_out(&title)),
        };
        if let Some(warning) = warning {
            self.warn(&element.place, warning);
        }
        self.media.insert(key, absorption);
        Ok(absorption)
    }

    /// A medium; `None` for one that varies in space.
    fn medium(&mut self, element: &Element) -> Result<Option<Homogeneous>, SceneError> {
        match element.plugin.as_str() {
            "homogeneous" => {}
            "heterogeneous" => {
                element.properties.iter().for_each(|p| p.used.set(true));
                return Ok(None);
            }
            other => return Err(unknown("medium", other, &element.place)),
        }
        // Parameters of free-path sampling.
        element.ignore(&["sample_emitters", "has_spectral_extinction", "strategy"]);
        let g = self.mean_cosine(element)?;
        let scale = f32_of(element.not_negative("scale", 1.0)?);
        let Some((absorption, scattering)) = self.coefficients(element)? else {
            return Ok(None);
        };
        Ok(Some(Homogeneous {
            absorption: absorption * scale,
            reduced_scattering: scattering * (scale * (1.0 - g)),
        }))
    }

    /// Absorption and scattering before `scale`; `None` where a volume varies in space.
    fn coefficients(&mut self, element: &Element) -> Result<Option<Coefficients>, SceneError> {
        let given = |name: &str| element.has(name);
        if let Some(name) = element.text("material")? {
            return media::named(name).map(Some).ok_or_else(|| {
                let message = format!("no material \"{}\" of a medium is known", shorten(name));
                element.error(message)
            });
        }
        // The 0.6 dialect's other pair.
        if given("sigma_a") || given("sigma_s") {
            let absorption = self.even(element, "sigma_a", 0.0, SpectrumUse::Unbounded)?;
            let scattering = self.even(element, "sigma_s", 0.0, SpectrumUse::Unbounded)?;
            return Ok(absorption.zip(scattering));
        }
        let extinction = self.even(element, "sigma_t", 1.0, SpectrumUse::Unbounded)?;
        let albedo = self.even(element, "albedo", 0.75, SpectrumUse::Reflectance)?;
        Ok(extinction.zip(albedo).map(|(extinction, albedo)| {
            let albedo = albedo.map(|a| a.clamp(0.0, 1.0));
            (extinction * albedo.map(|a| 1.0 - a), extinction * albedo)
        }))
    }

    /// A colour, or a volume that has one; `None` where it varies in space.
    fn even(
        &mut self,
        element: &Element,
        name: &str,
        default: f32,
        wanted: SpectrumUse,
    ) -> Result<Option<Rgb<f32>>, SceneError> {
        let Some(property) = element.find(name) else {
            return Ok(Some(Rgb::splat(default)));
        };
        let volume = match self.plugin(property)? {
            Some(volume) if volume.class == "volume" => volume,
            _ => return self.colour_of(element, property, wanted).map(Some),
        };
        if volume.plugin != "constvolume" {
            volume.properties.iter().for_each(|p| p.used.set(true));
            return Ok(None);
        }
        let Some(value) = volume.find("value") else {
            return Ok(Some(Rgb::WHITE));
        };
        self.colour_of(&volume, value, wanted).map(Some)
    }

    fn colour_of(
        &mut self,
        element: &Element,
        property: &Property,
        wanted: SpectrumUse,
    ) -> Result<Rgb<f32>, SceneError> {
        match self.value(element, property, Role::Colour(wanted))? {
            super::texture::ValueOrTexture::Value(c) => Ok(c),
            super::texture::ValueOrTexture::Texture(_) => {
                Err(property.error("expected a colour, found a texture"))
            }
        }
    }

    /// Mean cosine of the phase function, as far as it is known.
    fn mean_cosine(&mut self, element: &Element) -> Result<f32, SceneError> {
        let Some(phase) = self.children(element, "phase")?.into_iter().next() else {
            return Ok(0.0);
        };
        let g = match phase.plugin.as_str() {
            "hg" => phase.number("g", 0.8)?.clamp(-1.0, 1.0),
            _ => 0.0,
        };
        phase.properties.iter().for_each(|p| p.used.set(true));
        Ok(f32_of(g))
    }
}
