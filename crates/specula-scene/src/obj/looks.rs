//! How the parts of an OBJ file look: materials of its libraries as this renderer's.
//!
//! | library | here |
//! |---|---|
//! | `Ns` | alpha `sqrt(2 / (Ns + 2))`: the GGX lobe about as wide as Blinn and Phong's (Walter et al. 2007) |
//! | `Ks` | reflectance 0.08 `Ks` at normal incidence over `Kd`, so that 0.5 is that of an index of 1.5 |
//! | `Kd` 0, `Ks` above 0.1 | metal of reflectance `Ks` |
//! | `Pr`, `Pm` | roughness and metallic of glTF's material, with `Kd` as base colour |
//! | `illum` 4, 6, 7, 9 | smooth glass of index `Ni`, coloured by `Tf` |
//! | `d`, `map_d` | opacity |
//! | `map_Bump` | a normal map where its colours are those of one |

use std::collections::HashMap;

use specula_bsdf::Rgb;

use super::library::{LibraryMaterial, Map};
use crate::image::{self, Content, Encoding, Image};
use crate::num::{f32_of, shortened};
use crate::read_file::Files;
use crate::scene::{
    Bump, Channel, ColourParam, Emission, FloatParam, GltfMaterial, ImageId, Interpolation,
    Material, MaterialKind, Roughness, Texture, TextureId, TextureMapping, UvMapping, Wrap,
};
use crate::search::Search;
use crate::single::Look;

/// What looks are made of.
pub(super) struct Looks<'a> {
    pub(super) files: &'a Files,
    pub(super) search: &'a Search,
    pub(super) textures: Vec<Texture>,
    pub(super) images: Vec<Image>,
    pub(super) messages: Vec<String>,
    /// Pictures that were read, or could not be.
    read: HashMap<(String, bool, Content), Option<ImageId>>,
}

/// What of a picture is used.
#[derive(Clone, Copy, PartialEq)]
enum Use {
    Colour,
    Number,
    Alpha,
    Normal,
}

impl<'a> Looks<'a> {
    pub(super) fn new(files: &'a Files, search: &'a Search) -> Self {
        Self {
            files,
            search,
            textures: Vec::new(),
            images: Vec::new(),
            messages: Vec::new(),
            read: HashMap::new(),
        }
    }

    fn add(&mut self, texture: Texture) -> TextureId {
        self.textures.push(texture);
        TextureId(self.textures.len() - 1)
    }

    /// The look of a material.
    pub(super) fn look(&mut self, from: &LibraryMaterial) -> Look {
        let rgb = |[r, g, b]: [f32; 3]| Rgb { r, g, b };
        let base = self.colour(from.maps.diffuse.as_ref(), rgb(from.diffuse), from);
        let emission = (from.emission != [0.0; 3] || from.maps.emission.is_some()).then(|| {
            let factor = match from.emission {
                [0.0, 0.0, 0.0] => Rgb::WHITE,
                own => rgb(own),
            };
            Emission {
                radiance: self.colour(from.maps.emission.as_ref(), factor, from),
                two_sided: true,
            }
        });
        let is_glass = matches!(from.model, 4 | 6 | 7 | 9);
        let kind = if is_glass {
            let filter = from
                .filter
                .map_or(Rgb::WHITE, |f| rgb(f.map(|x| x.min(1.0))));
            MaterialKind::Dielectric {
                eta: if from.ior > 1.0 { from.ior } else { 1.5 },
                roughness: Roughness::smooth(),
                reflection_tint: ColourParam::WHITE,
                transmission_tint: ColourParam::Value(filter),
            }
        } else {
            self.opaque(from, base)
        };
        let alpha = if is_glass {
            FloatParam::Value(1.0)
        } else {
            self.opacity(from)
        };
        let bump = self.bump(from);
        Look {
            material: Material {
                name: Some(from.name.clone()),
                bump,
                ..Material::new(kind)
            },
            emission,
            alpha,
        }
    }

    /// A surface that nothing passes.
    fn opaque(&mut self, from: &LibraryMaterial, base: ColourParam) -> MaterialKind {
        let [r, g, b] = from.specular;
        let most = r.max(g).max(b);
        let is_physical = from.roughness.is_some()
            || from.metallic.is_some()
            || from.maps.roughness.is_some()
            || from.maps.metallic.is_some();
        if !is_physical && (most == 0.0 || from.model < 2) {
            return MaterialKind::Diffuse {
                reflectance: base,
                roughness: FloatParam::Value(0.0),
            };
        }
        let alpha = (2.0 / (f64::from(from.exponent) + 2.0)).sqrt();
        let is_black = from.maps.diffuse.is_none() && from.diffuse == [0.0; 3];
        let is_metal = !is_physical && is_black && most > 0.1;
        let specular = Rgb { r, g, b };
        let (base_colour, specular_colour) = if is_metal {
            (ColourParam::Value(specular), Rgb::WHITE)
        } else {
            // Physically based ones are as glTF's, unless they say more.
            let scale = if is_physical && most == 0.0 {
                Rgb::WHITE
            } else {
                specular * 2.0
            };
            (base, scale)
        };
        // A picture alone is the whole value.
        let factor = |value: Option<f32>, map: &Option<Map>, default: f32| {
            value.unwrap_or(if map.is_some() { 1.0 } else { default })
        };
        let roughness = factor(from.roughness, &from.maps.roughness, f32_of(alpha.sqrt()));
        let metallic = factor(from.metallic, &from.maps.metallic, f32::from(is_metal));
        MaterialKind::Gltf(GltfMaterial {
            base_colour,
            metallic: self.float(from.maps.metallic.as_ref(), metallic, from),
            roughness: self.float(from.maps.roughness.as_ref(), roughness, from),
            anisotropy: FloatParam::Value(0.0),
            anisotropy_rotation_rad: 0.0,
            anisotropy_direction: None,
            ior: 1.5,
            specular: FloatParam::Value(1.0),
            specular_colour: ColourParam::Value(specular_colour),
            transmission: FloatParam::Value(0.0),
            volume: false,
            clearcoat: FloatParam::Value(0.0),
            clearcoat_roughness: FloatParam::Value(0.0),
            clearcoat_bump: None,
            sheen_colour: ColourParam::Value(Rgb::BLACK),
            sheen_roughness: FloatParam::Value(0.0),
        })
    }

    fn opacity(&mut self, from: &LibraryMaterial) -> FloatParam {
        let Some(map) = &from.maps.opacity else {
            return FloatParam::Value(from.opacity);
        };
        let of_colours = from
            .maps
            .diffuse
            .as_ref()
            .is_some_and(|d| d.file == map.file);
        let use_ = if of_colours { Use::Alpha } else { Use::Number };
        match self.texture(map, use_, from) {
            Some(texture) => FloatParam::Texture(self.scaled(texture, Rgb::splat(from.opacity))),
            None => FloatParam::Value(from.opacity),
        }
    }

    fn bump(&mut self, from: &LibraryMaterial) -> Option<Bump> {
        let map = from.maps.normal.as_ref().or(from.maps.bump.as_ref())?;
        let id = self.picture(map, Use::Normal, from)?;
        if from.maps.normal.is_none() && !holds_normals(&self.images[id.0]) {
            self.messages.push(format!(
                "material \"{}\": map_Bump has heights of unknown unit: it is left out",
                shortened(from.name.as_bytes())
            ));
            return None;
        }
        let texture = image_texture(id, map, Channel::Rgb);
        Some(Bump::Normal {
            map: self.add(texture),
            scale: map.strength,
        })
    }

    fn colour(
        &mut self,
        map: Option<&Map>,
        factor: Rgb<f32>,
        from: &LibraryMaterial,
    ) -> ColourParam {
        match map.and_then(|map| self.texture(map, Use::Colour, from)) {
            // Programs write black beside a picture.
            Some(texture) if factor.is_black() => ColourParam::Texture(texture),
            Some(texture) => ColourParam::Texture(self.scaled(texture, factor)),
            None => ColourParam::Value(factor),
        }
    }

    fn float(&mut self, map: Option<&Map>, factor: f32, from: &LibraryMaterial) -> FloatParam {
        match map.and_then(|map| self.texture(map, Use::Number, from)) {
            Some(texture) => FloatParam::Texture(self.scaled(texture, Rgb::splat(factor))),
            None => FloatParam::Value(factor),
        }
    }

    fn scaled(&mut self, a: TextureId, factor: Rgb<f32>) -> TextureId {
        if factor == Rgb::WHITE {
            return a;
        }
        let b = self.add(Texture::Constant(factor));
        self.add(Texture::Scale { a, b })
    }

    fn texture(&mut self, map: &Map, use_: Use, from: &LibraryMaterial) -> Option<TextureId> {
        let id = self.picture(map, use_, from)?;
        let channel = match use_ {
            Use::Colour | Use::Normal => Channel::Rgb,
            Use::Number | Use::Alpha => Channel::Red,
        };
        let texture = image_texture(id, map, channel);
        Some(self.add(texture))
    }

    /// A picture; one that cannot be read is left out, which a message says.
    fn picture(&mut self, map: &Map, use_: Use, from: &LibraryMaterial) -> Option<ImageId> {
        let is_colour = use_ == Use::Colour;
        let content = if use_ == Use::Alpha {
            Content::Alpha
        } else {
            Content::Colour
        };
        let key = (map.file.clone(), is_colour, content);
        if let Some(known) = self.read.get(&key) {
            return *known;
        }
        let encoding = if is_colour {
            Encoding::Srgb
        } else {
            Encoding::Linear
        };
        let path = self.search.find(&map.file);
        let found = match image::read(&path, encoding, content, self.files) {
            Ok(image) => {
                self.images.push(image);
                Some(ImageId(self.images.len() - 1))
            }
            Err(message) => {
                let name = shortened(from.name.as_bytes());
                self.messages
                    .push(format!("material \"{name}\": {message}: it is left out"));
                None
            }
        };
        self.read.insert(key, found);
        found
    }
}

/// Whether colours are about those of normals along z.
fn holds_normals(image: &Image) -> bool {
    let count = f64::from(image.width) * f64::from(image.height);
    let mut sum = [0.0_f64; 3];
    for pixel in image.pixels.iter() {
        for (sum, x) in sum.iter_mut().zip(pixel) {
            *sum += f64::from(x);
        }
    }
    let [r, g, b] = sum.map(|s| s / count.max(1.0));
    b > 0.7 && (r - 0.5).abs() < 0.2 && (g - 0.5).abs() < 0.2
}

fn image_texture(image: ImageId, map: &Map, channel: Channel) -> Texture {
    let wrap = if map.clamps {
        Wrap::Clamp
    } else {
        Wrap::Repeat
    };
    let ([sx, sy], [ox, oy]) = (map.scale, map.offset);
    Texture::Image {
        image,
        mapping: TextureMapping::Uv(UvMapping([[sx, 0.0, ox], [0.0, sy, oy]])),
        wrap: [wrap; 2],
        filter: Interpolation::Bilinear,
        invert: false,
        scale: 1.0,
        channel,
    }
}
