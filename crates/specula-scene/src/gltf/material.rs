//! Materials: metallic-roughness with its extensions.

use std::collections::HashMap;

use gltf::json::Value;
use gltf::material::AlphaMode;
use specula_bsdf::Rgb;

use super::Reader;
use super::texture::{MOST_SETS, Meaning};
use super::texture_ref::{TextureRef, number, numbers};
use crate::error::SceneError;
use crate::scene::{
    Bump, Channel, ColourParam, Emission, FloatParam, GltfMaterial, Material, MaterialId,
    MaterialKind, Texture,
};

/// A primitive's material, emission and opacity.
#[derive(Clone, Copy, Debug)]
pub(super) struct Appearance {
    pub(super) material: MaterialId,
    pub(super) emission: Option<Emission>,
    pub(super) alpha: FloatParam,
    /// The sets of coordinates that its textures use.
    pub(super) sets: [Option<u32>; MOST_SETS],
    /// Whether it uses the tangents of meshes.
    pub(super) tangents: bool,
}

/// Appearances by material (none: the default one) and by whether the mesh has colours.
pub(super) type Appearances = HashMap<(Option<usize>, bool), Appearance>;

/// Most indices of refraction that are taken for glass: `KHR_materials_ior` has 0 for infinity.
const MAX_IOR: f32 = 100.0;

impl Reader<'_> {
    /// The appearance of a material on a mesh, with or without colours.
    pub(super) fn look(
        &mut self,
        material: &gltf::Material<'_>,
        coloured: bool,
    ) -> Result<Appearance, SceneError> {
        let key = (material.index(), coloured);
        if let Some(look) = self.looks.get(&key) {
            return Ok(*look);
        }
        let look = self.read_look(material, coloured)?;
        self.looks.insert(key, look);
        Ok(look)
    }

    fn read_look(
        &mut self,
        material: &gltf::Material<'_>,
        coloured: bool,
    ) -> Result<Appearance, SceneError> {
        let what = material.index().map_or_else(
            || "the default material".to_owned(),
            |i| format!("materials[{i}]"),
        );
        // Textures of directions decide which coordinates tangents follow.
        let tangents = tangent_set(material);
        self.sets = tangents.into_iter().collect();
        let (mut base, factor, picture) = self.base_colour(&what, material)?;
        if coloured {
            let colours = self.add_texture(Texture::VertexColour);
            base = ColourParam::Texture(match base {
                ColourParam::Value(c) => self.scaled(colours, c),
                ColourParam::Texture(a) => self.add_texture(Texture::Scale { a, b: colours }),
            });
        }
        let emission = self.emission(material, base)?;
        // Without a strength, screens and labels glow; lamps have one.
        self.has_lamps |=
            emission.is_some() && material.emissive_strength().is_some_and(|s| s > 1.0);
        let alpha = self.alpha(material, factor, picture)?;
        let kind = if material.unlit() {
            self.warn("unlit materials emit with their base colour");
            MaterialKind::Diffuse {
                reflectance: ColourParam::Value(Rgb::BLACK),
                roughness: FloatParam::Value(0.0),
            }
        } else {
            MaterialKind::Gltf(self.metallic_roughness(material, base)?)
        };
        let bump = match (normal_map(material), material.normal_texture()) {
            (Some(reference), Some(normal)) => Some(Bump::Normal {
                map: self.texture(reference, Meaning::Data(Channel::Rgb))?,
                scale: normal.scale(),
            }),
            _ => None,
        };
        self.materials.push(Material {
            name: material.name().map(str::to_owned),
            bump,
            absorption: absorption(material),
            ..Material::new(kind)
        });
        if self.sets.is_empty() {
            // Tangents without textures follow the first.
            self.sets.push(0);
        }
        Ok(Appearance {
            material: MaterialId(self.materials.len() - 1),
            emission,
            alpha,
            sets: [0, 1].map(|i| self.sets.get(i).copied()),
            tangents: tangents.is_some() || anisotropic(material),
        })
    }

    /// The base colour, the factor on its alpha, and its texture.
    fn base_colour(
        &mut self,
        what: &str,
        material: &gltf::Material<'_>,
    ) -> Result<(ColourParam, f32, Option<TextureRef>), SceneError> {
        let pbr = material.pbr_metallic_roughness();
        let (mut factor, mut texture) = (pbr.base_color_factor(), pbr.base_color_texture());
        if let Some(old) = material.pbr_specular_glossiness() {
            self.warn(format!(
                "{what}: specular-glossiness is taken for a rough dielectric of its diffuse colour"
            ));
            (factor, texture) = (old.diffuse_factor(), old.diffuse_texture());
        }
        let [r, g, b, a] = factor.map(unit);
        let reference = texture.as_ref().map(TextureRef::of);
        let base = self.colour(Rgb { r, g, b }, reference)?;
        Ok((base, a, reference))
    }

    fn emission(
        &mut self,
        material: &gltf::Material<'_>,
        base: ColourParam,
    ) -> Result<Option<Emission>, SceneError> {
        let radiance = if material.unlit() {
            base
        } else {
            let strength = material.emissive_strength().unwrap_or(1.0).max(0.0);
            let factor = Rgb::from(material.emissive_factor().map(|x| x.max(0.0))) * strength;
            if factor == Rgb::BLACK {
                return Ok(None);
            }
            let reference = material.emissive_texture().as_ref().map(TextureRef::of);
            self.colour(factor, reference)?
        };
        Ok(Some(Emission {
            radiance,
            two_sided: material.double_sided(),
        }))
    }

    fn alpha(
        &mut self,
        material: &gltf::Material<'_>,
        factor: f32,
        picture: Option<TextureRef>,
    ) -> Result<FloatParam, SceneError> {
        let mode = material.alpha_mode();
        if mode == AlphaMode::Opaque {
            return Ok(FloatParam::Value(1.0));
        }
        let alpha = self.float(factor.min(1.0), picture, Meaning::Alpha)?;
        if mode == AlphaMode::Blend {
            return Ok(alpha);
        }
        let cutoff = material.alpha_cutoff().unwrap_or(0.5);
        Ok(match alpha {
            FloatParam::Value(a) => FloatParam::Value(if a >= cutoff { 1.0 } else { 0.0 }),
            FloatParam::Texture(texture) => {
                FloatParam::Texture(self.add_texture(Texture::Threshold { texture, cutoff }))
            }
        })
    }

    fn metallic_roughness(
        &mut self,
        material: &gltf::Material<'_>,
        base_colour: ColourParam,
    ) -> Result<GltfMaterial, SceneError> {
        let pbr = material.pbr_metallic_roughness();
        let map = pbr
            .metallic_roughness_texture()
            .as_ref()
            .map(TextureRef::of);
        let old = material.pbr_specular_glossiness();
        let (metallic, roughness) = match &old {
            Some(old) => (0.0, 1.0 - old.glossiness_factor().clamp(0.0, 1.0)),
            None => (pbr.metallic_factor(), pbr.roughness_factor()),
        };
        let map = map.filter(|_| old.is_none());
        let anisotropy = extension(material, "KHR_materials_anisotropy");
        let clearcoat = extension(material, "KHR_materials_clearcoat");
        let sheen = extension(material, "KHR_materials_sheen");
        let (specular, specular_colour) = self.specular(material)?;
        let transmission = material.transmission();
        let transmission_map = transmission
            .as_ref()
            .and_then(|t| t.transmission_texture().as_ref().map(TextureRef::of));
        let blue = Meaning::Data(Channel::Blue);
        let [red, green] = [Channel::Red, Channel::Green].map(Meaning::Data);
        let sheen_colour = numbers::<3>(sheen, "sheenColorFactor").unwrap_or([0.0; 3]);
        let has_sheen = sheen_colour.iter().any(|x| *x > 0.0);
        let ior = material.ior().unwrap_or(1.5);
        Ok(GltfMaterial {
            base_colour,
            metallic: self.float(unit(metallic), map, blue)?,
            roughness: self.float(unit(roughness), map, green)?,
            anisotropy: self.float(
                factor(anisotropy, "anisotropyStrength"),
                TextureRef::in_json(anisotropy, "anisotropyTexture"),
                blue,
            )?,
            anisotropy_rotation_rad: number(anisotropy, "anisotropyRotation").unwrap_or(0.0),
            anisotropy_direction: match TextureRef::in_json(anisotropy, "anisotropyTexture") {
                Some(reference) if anisotropic(material) => {
                    Some(self.texture(reference, Meaning::Data(Channel::Rgb))?)
                }
                _ => None,
            },
            // 0 stands for infinity.
            ior: if ior == 0.0 {
                MAX_IOR
            } else {
                ior.clamp(1.0, MAX_IOR)
            },
            specular,
            specular_colour,
            transmission: self.float(
                unit(
                    transmission
                        .as_ref()
                        .map_or(0.0, |t| t.transmission_factor()),
                ),
                transmission_map,
                red,
            )?,
            volume: material
                .volume()
                .is_some_and(|v| v.thickness_factor() > 0.0),
            clearcoat: self.float(
                factor(clearcoat, "clearcoatFactor"),
                TextureRef::in_json(clearcoat, "clearcoatTexture"),
                red,
            )?,
            clearcoat_roughness: self.float(
                factor(clearcoat, "clearcoatRoughnessFactor"),
                TextureRef::in_json(clearcoat, "clearcoatRoughnessTexture"),
                green,
            )?,
            clearcoat_bump: self.coat_bump(clearcoat)?,
            sheen_colour: self.colour(
                Rgb::from(sheen_colour.map(unit)),
                TextureRef::in_json(sheen, "sheenColorTexture").filter(|_| has_sheen),
            )?,
            sheen_roughness: self.float(
                factor(sheen, "sheenRoughnessFactor"),
                TextureRef::in_json(sheen, "sheenRoughnessTexture").filter(|_| has_sheen),
                Meaning::Alpha,
            )?,
        })
    }

    /// Strength and colour of `KHR_materials_specular`.
    fn specular(
        &mut self,
        material: &gltf::Material<'_>,
    ) -> Result<(FloatParam, ColourParam), SceneError> {
        let Some(specular) = material.specular() else {
            return Ok((FloatParam::Value(1.0), ColourParam::WHITE));
        };
        let map = specular.specular_texture().as_ref().map(TextureRef::of);
        let strength = self.float(unit(specular.specular_factor()), map, Meaning::Alpha)?;
        let map = specular
            .specular_color_texture()
            .as_ref()
            .map(TextureRef::of);
        let factor = Rgb::from(specular.specular_color_factor().map(|x| x.max(0.0)));
        Ok((strength, self.colour(factor, map)?))
    }

    /// The normal map of the clear coat.
    fn coat_bump(&mut self, clearcoat: &Value) -> Result<Option<Bump>, SceneError> {
        let Some(reference) = TextureRef::in_json(clearcoat, COAT_NORMALS)
            .filter(|_| factor(clearcoat, "clearcoatFactor") > 0.0)
        else {
            return Ok(None);
        };
        let scale = clearcoat.get(COAT_NORMALS).and_then(|t| number(t, "scale"));
        Ok(Some(Bump::Normal {
            map: self.texture(reference, Meaning::Data(Channel::Rgb))?,
            scale: scale.unwrap_or(1.0),
        }))
    }
}

/// The name of the clear coat's normal map.
const COAT_NORMALS: &str = "clearcoatNormalTexture";

/// The normal map of the base.
fn normal_map(material: &gltf::Material<'_>) -> Option<TextureRef> {
    let normal = material.normal_texture()?;
    let plain = TextureRef::plain(normal.texture().index(), normal.tex_coord());
    Some(plain.transformed(normal.extension_value("KHR_texture_transform")))
}

/// The set of coordinates of the first texture whose values are directions.
fn tangent_set(material: &gltf::Material<'_>) -> Option<u32> {
    let in_extension =
        |name: &str, member: &str| TextureRef::in_json(extension(material, name), member);
    normal_map(material)
        .or_else(|| in_extension("KHR_materials_anisotropy", "anisotropyTexture"))
        .or_else(|| in_extension("KHR_materials_clearcoat", COAT_NORMALS))
        .map(|reference| reference.set)
}

/// Whether the surface has a direction.
fn anisotropic(material: &gltf::Material<'_>) -> bool {
    let anisotropy = extension(material, "KHR_materials_anisotropy");
    factor(anisotropy, "anisotropyStrength") > 0.0
}

/// Absorption within a body, per scene unit: light falls to `attenuationColor` over
/// `attenuationDistance`.
fn absorption(material: &gltf::Material<'_>) -> Rgb<f32> {
    let Some(volume) = material.volume().filter(|v| v.thickness_factor() > 0.0) else {
        return Rgb::BLACK;
    };
    let distance = volume.attenuation_distance();
    if !(distance.is_finite() && distance > 0.0) {
        return Rgb::BLACK;
    }
    // Black would absorb without bound.
    let colour = volume.attenuation_color().map(|c| c.clamp(1e-6, 1.0));
    Rgb::from(colour.map(|c| (-c.ln() / distance).clamp(0.0, 1e30)))
}

/// An extension's object; `null` where there is none.
fn extension<'a>(material: &'a gltf::Material<'_>, name: &str) -> &'a Value {
    material.extension_value(name).unwrap_or(&Value::Null)
}

fn unit(x: f32) -> f32 {
    x.clamp(0.0, 1.0)
}

/// A number of an extension in `[0, 1]`; 0 where there is none.
fn factor(object: &Value, name: &str) -> f32 {
    unit(number(object, name).unwrap_or(0.0))
}
