//! `<bsdf>`: dispatch by plugin, and the simple plugins.

use std::rc::Rc;

use specula_bsdf::Rgb;

use super::context::Context;
use super::element::Element;
use super::layered::Wrappers;
use super::spectrum::SpectrumUse;
use super::texture::unknown;
use crate::error::{ErrorKind, SceneError};
use crate::num::f32_of;
use crate::scene::{
    ColourParam, ConductorFresnel, FloatParam, Material, MaterialId, MaterialKind,
    MicrofacetDistribution, Roughness, RoughnessMapping,
};

/// A blend of two references to one blend doubles what is within: a chain of them would never end.
const MOST_MATERIALS: usize = 1 << 17;

/// A material with the opacity of the masks around it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Surface {
    pub(super) material: MaterialId,
    pub(super) alpha: FloatParam,
}

/// A diffuse grey.
pub(super) fn grey(reflectance: f32) -> MaterialKind {
    MaterialKind::Diffuse {
        reflectance: ColourParam::Value(Rgb::splat(reflectance)),
        roughness: FloatParam::Value(0.0),
    }
}

impl Context<'_> {
    /// The surface that a `<bsdf>` describes.
    pub(super) fn surface(&mut self, element: &Rc<Element>) -> Result<Surface, SceneError> {
        self.wrapped(element, Wrappers::default())
    }

    /// The surface of a plugin within its wrappers.
    pub(super) fn wrapped(
        &mut self,
        element: &Rc<Element>,
        wraps: Wrappers,
    ) -> Result<Surface, SceneError> {
        if self.materials.len() >= MOST_MATERIALS {
            let message = "the scene's bsdfs unfold into more than 131072 materials";
            return Err(SceneError::new(ErrorKind::Limit, &element.place, message));
        }
        let read = self.deeper(element, |context| {
            if let Some(surface) = context.layered(element, wraps)? {
                return Ok(surface);
            }
            let kind = context.kind(element)?;
            Ok(context.finish(element, kind, wraps))
        });
        element.or(read, || self.finish(element, grey(0.5), wraps))
    }

    /// Adds a material with its wrappers applied.
    pub(super) fn finish(
        &mut self,
        element: &Element,
        kind: MaterialKind,
        wraps: Wrappers,
    ) -> Surface {
        let mut bump = wraps.bump.filter(|_| kind != MaterialKind::Interface);
        if let MaterialKind::Mix { materials, .. } = kind {
            // A bump map belongs to the parts of a mix.
            let bump = bump.take();
            for part in materials {
                let part = &mut self.materials[part.0];
                part.bump = part.bump.or(bump);
                part.bump_rules = wraps.bump_rules;
                part.one_sided &= !wraps.two_sided;
            }
        }
        let material = Material {
            name: element.id.clone(),
            bump,
            bump_rules: wraps.bump_rules,
            one_sided: !wraps.two_sided && is_opaque(&kind),
            ..Material::new(kind)
        };
        Surface {
            material: self.add_material(material),
            alpha: wraps.alpha,
        }
    }

    /// A plugin that is one material.
    fn kind(&mut self, element: &Element) -> Result<MaterialKind, SceneError> {
        let white = |context: &mut Self, name: &str| {
            context.colour(element, name, 1.0, SpectrumUse::Reflectance)
        };
        Ok(match element.plugin.as_str() {
            "diffuse" => MaterialKind::Diffuse {
                reflectance: self.colour(element, "reflectance", 0.5, SpectrumUse::Reflectance)?,
                roughness: FloatParam::Value(0.0),
            },
            "roughdiffuse" => self.rough_diffuse(element)?,
            "difftrans" => MaterialKind::DiffuseTransmission {
                reflectance: ColourParam::Value(Rgb::BLACK),
                transmittance: self.colour(
                    element,
                    "transmittance",
                    0.5,
                    SpectrumUse::Reflectance,
                )?,
            },
            plugin @ ("conductor" | "roughconductor") => MaterialKind::Conductor {
                fresnel: self.conductor(element)?,
                roughness: if plugin == "conductor" {
                    smooth()
                } else {
                    self.roughness(element)?
                },
                tint: white(self, "specular_reflectance")?,
            },
            plugin @ ("dielectric" | "roughdielectric") => MaterialKind::Dielectric {
                eta: self.relative_index(element, "bk7")?,
                roughness: if plugin == "dielectric" {
                    smooth()
                } else {
                    self.roughness(element)?
                },
                reflection_tint: white(self, "specular_reflectance")?,
                transmission_tint: white(self, "specular_transmittance")?,
            },
            "thindielectric" => MaterialKind::ThinDielectric {
                eta: self.relative_index(element, "bk7")?,
                reflection_tint: white(self, "specular_reflectance")?,
                transmission_tint: white(self, "specular_transmittance")?,
            },
            plugin @ ("plastic" | "roughplastic" | "pplastic") => self.plastic(element, plugin)?,
            plugin @ ("principled" | "principledthin") => {
                MaterialKind::Principled(self.principled(element, plugin == "principledthin")?)
            }
            "phong" | "ward" => self.phong(element)?,
            "null" => MaterialKind::Interface,
            other @ ("polarizer" | "retarder" | "circular") => {
                let message =
                    format!("bsdf \"{other}\" is not seen without polarization: light passes");
                element.properties.iter().for_each(|p| p.used.set(true));
                self.warn(&element.place, message);
                MaterialKind::Interface
            }
            "measured" => self.measured(element)?,
            "hair" if !element.legacy => MaterialKind::Hair(self.hair(element)?),
            other @ ("measured_polarized" | "hair" | "irawan" | "hk") => {
                let message =
                    format!("bsdf \"{other}\" is not supported: diffuse grey of 0.5 stands in");
                element.properties.iter().for_each(|p| p.used.set(true));
                self.warn(&element.place, message);
                grey(0.5)
            }
            other => return Err(unknown("bsdf", other, &element.place)),
        })
    }

    /// A measured reflection; grey where its file is missing or damaged and reading goes on.
    fn measured(&mut self, element: &Element) -> Result<MaterialKind, SceneError> {
        let (path, place) = self.needed_file(element, "filename")?;
        let read = self.measured_in(&path, &place).map(MaterialKind::Measured);
        let problems = self.problems.clone();
        problems.or(read, || grey(0.5))
    }

    fn rough_diffuse(&mut self, element: &Element) -> Result<MaterialKind, SceneError> {
        element.ignore(&["use_fast_approx"]);
        let message = "\"roughdiffuse\" is rendered as energy-preserving Oren-Nayar";
        self.warn(&element.place, message);
        Ok(MaterialKind::Diffuse {
            reflectance: self.colour(element, "reflectance", 0.5, SpectrumUse::Reflectance)?,
            roughness: match self.float(element, "alpha", 0.2)? {
                FloatParam::Value(alpha) => FloatParam::Value(alpha.min(1.0)),
                texture => texture,
            },
        })
    }

    fn plastic(&mut self, element: &Element, plugin: &str) -> Result<MaterialKind, SceneError> {
        if plugin == "pplastic" {
            self.warn(
                &element.place,
                "\"pplastic\" is rendered as \"roughplastic\"",
            );
        }
        Ok(MaterialKind::Plastic {
            diffuse: self.colour(
                element,
                "diffuse_reflectance",
                0.5,
                SpectrumUse::Reflectance,
            )?,
            specular: self.colour(
                element,
                "specular_reflectance",
                1.0,
                SpectrumUse::Reflectance,
            )?,
            eta: self.relative_index(element, "polypropylene")?,
            roughness: if plugin == "plastic" {
                smooth()
            } else {
                self.roughness(element)?
            },
            nonlinear: element.boolean("nonlinear", false)?,
        })
    }

    /// The 0.6 dialect's `phong` and `ward`: Lambert, and a mirror with Beckmann's roughness.
    ///
    /// A Phong lobe of exponent n about the mirrored direction is one of exponent 4n about the
    /// normal, as wide as Beckmann's with `alpha^2 = 2 / (4n + 2)`. The two are chosen at random in
    /// proportion to their luminances, so that the albedo near the normal is the file's.
    fn phong(&mut self, element: &Element) -> Result<MaterialKind, SceneError> {
        let message = format!(
            "bsdf \"{}\" is approximated by a diffuse and a rough mirror part",
            element.plugin
        );
        self.warn(&element.place, message);
        element.ignore(&["variant"]);
        let diffuse = self.colour(
            element,
            "diffuse_reflectance",
            0.5,
            SpectrumUse::Reflectance,
        )?;
        let specular = self.colour(
            element,
            "specular_reflectance",
            0.2,
            SpectrumUse::Reflectance,
        )?;
        let [u, v] = if element.plugin == "ward" {
            let alpha = if element.has("alpha") {
                "alpha"
            } else {
                "alpha_u"
            };
            let second = if element.has("alpha") {
                "alpha"
            } else {
                "alpha_v"
            };
            [
                self.float(element, alpha, 0.1)?,
                self.float(element, second, 0.1)?,
            ]
        } else {
            let exponent = element.not_negative("exponent", 30.0)?;
            [FloatParam::Value(f32_of((2.0 / (4.0 * exponent + 2.0)).sqrt())); 2]
        };
        let (d, s) = (self.brightness(diffuse), self.brightness(specular));
        let share = if d + s > 0.0 { s / (d + s) } else { 0.0 };
        if share <= 0.0 || share >= 1.0 {
            return Ok(if share <= 0.0 {
                MaterialKind::Diffuse {
                    reflectance: diffuse,
                    roughness: FloatParam::Value(0.0),
                }
            } else {
                rough_mirror(u, v, specular)
            });
        }
        let reflectance = self.scaled_colour(diffuse, 1.0 / (1.0 - share));
        let tint = self.scaled_colour(specular, 1.0 / share);
        let one_sided = |kind| Material {
            one_sided: true,
            ..Material::new(kind)
        };
        let base = self.add_material(one_sided(MaterialKind::Diffuse {
            reflectance,
            roughness: FloatParam::Value(0.0),
        }));
        let gloss = self.add_material(one_sided(rough_mirror(u, v, tint)));
        Ok(MaterialKind::Mix {
            materials: [base, gloss],
            amount: FloatParam::Value(share),
        })
    }
}

fn rough_mirror(u: FloatParam, v: FloatParam, tint: ColourParam) -> MaterialKind {
    MaterialKind::Conductor {
        fresnel: ConductorFresnel::Mirror,
        roughness: Roughness {
            u,
            v,
            distribution: MicrofacetDistribution::Beckmann,
            ..smooth()
        },
        tint,
    }
}

/// A smooth surface, with Mitsuba's masking.
pub(super) fn smooth() -> Roughness {
    Roughness {
        masking: specula_bsdf::ndf::Masking::Separable,
        mapping: RoughnessMapping::Alpha,
        ..Roughness::smooth()
    }
}

/// Whether Mitsuba's plugin is black from behind.
fn is_opaque(kind: &MaterialKind) -> bool {
    matches!(
        kind,
        MaterialKind::Diffuse { .. }
            | MaterialKind::Conductor { .. }
            | MaterialKind::Plastic { .. }
            | MaterialKind::CoatedDiffuse { .. }
            | MaterialKind::CoatedConductor { .. }
            | MaterialKind::Measured(_)
    )
}
