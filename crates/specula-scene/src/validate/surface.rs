//! Checks of textures and materials.

use glam::DMat4;
use specula_bsdf::Rgb;

use super::{Invalid, ensure, is_light};
use crate::scene::{
    Bump, CoatMedium, ColourParam, ConductorFresnel, FloatParam, GltfMaterial, HairMaterial,
    HairPigment, Interpolation, Material, MaterialKind, NoiseKind, PrincipledMaterial, Roughness,
    Scene, Texture, TextureId, TextureMapping,
};

impl Scene {
    pub(super) fn float(&self, what: &str, param: FloatParam) -> Result<(), Invalid> {
        match param {
            FloatParam::Value(x) => ensure(
                x.is_finite() && x >= 0.0,
                what,
                "a number is negative or not finite",
            ),
            FloatParam::Texture(id) => ensure(
                id.0 < self.textures.len(),
                what,
                "a texture is out of range",
            ),
        }
    }

    pub(super) fn colour(&self, what: &str, param: ColourParam) -> Result<(), Invalid> {
        match param {
            ColourParam::Value(c) => {
                ensure(is_light(c), what, "a colour is negative or not finite")
            }
            ColourParam::Texture(id) => ensure(
                id.0 < self.textures.len(),
                what,
                "a texture is out of range",
            ),
        }
    }

    fn principled(&self, what: &str, p: &PrincipledMaterial) -> Result<(), Invalid> {
        self.colour(what, p.base_colour)?;
        self.floats(
            what,
            &[
                p.roughness,
                p.anisotropic,
                p.metallic,
                p.spec_trans,
                p.spec_tint,
                p.sheen,
                p.sheen_tint,
                p.clearcoat,
                p.clearcoat_gloss,
                p.flatness,
                p.diff_trans,
            ],
        )
    }

    fn gltf(&self, what: &str, g: &GltfMaterial) -> Result<(), Invalid> {
        self.colours(what, &[g.base_colour, g.specular_colour, g.sheen_colour])?;
        self.floats(
            what,
            &[
                g.metallic,
                g.roughness,
                g.anisotropy,
                g.specular,
                g.transmission,
                g.clearcoat,
                g.clearcoat_roughness,
                g.sheen_roughness,
            ],
        )?;
        let rotation = g.anisotropy_rotation_rad;
        ensure(rotation.is_finite(), what, "its rotation is not finite")?;
        let direction = g.anisotropy_direction.map(ColourParam::Texture);
        self.colours(what, direction.as_slice())?;
        self.bump(what, g.clearcoat_bump)
    }

    fn hair(&self, what: &str, hair: &HairMaterial) -> Result<(), Invalid> {
        if let FloatParam::Value(eta) = hair.eta {
            index(what, eta)?;
        }
        self.floats(what, &[hair.eta, hair.beta_m, hair.beta_n])?;
        match hair.alpha_deg {
            FloatParam::Value(alpha) => ensure(alpha.is_finite(), what, "its tilt is not finite")?,
            texture @ FloatParam::Texture(_) => self.float(what, texture)?,
        }
        match hair.pigment {
            HairPigment::Absorption(c) | HairPigment::Reflectance(c) => self.colour(what, c),
            HairPigment::Melanin {
                eumelanin,
                pheomelanin,
            } => self.floats(what, &[eumelanin, pheomelanin]),
        }
    }

    fn coat_medium(&self, what: &str, medium: &CoatMedium) -> Result<(), Invalid> {
        self.float(what, medium.thickness)?;
        self.colour(what, medium.albedo)?;
        match medium.g {
            FloatParam::Value(g) => {
                let asymmetry = "the asymmetry of its coat's scattering is not in [-1, 1]";
                ensure(g.abs() <= 1.0, what, asymmetry)
            }
            texture @ FloatParam::Texture(_) => self.float(what, texture),
        }
    }

    fn bump(&self, what: &str, bump: Option<Bump>) -> Result<(), Invalid> {
        match bump {
            None => Ok(()),
            Some(Bump::Normal { map, scale }) => {
                ensure(
                    map.0 < self.textures.len(),
                    what,
                    "a texture is out of range",
                )?;
                ensure(scale.is_finite(), what, "its bump is not finite")
            }
            Some(Bump::Height(FloatParam::Texture(map))) => ensure(
                map.0 < self.textures.len(),
                what,
                "a texture is out of range",
            ),
            Some(Bump::Height(FloatParam::Value(x))) => {
                ensure(x.is_finite(), what, "its height is not finite")
            }
        }
    }

    fn colours(&self, what: &str, params: &[ColourParam]) -> Result<(), Invalid> {
        params.iter().try_for_each(|p| self.colour(what, *p))
    }

    fn floats(&self, what: &str, params: &[FloatParam]) -> Result<(), Invalid> {
        params.iter().try_for_each(|p| self.float(what, *p))
    }

    fn roughness(&self, what: &str, roughness: &Roughness) -> Result<(), Invalid> {
        ensure(
            roughness.rotation_rad.is_finite(),
            what,
            "its rotation is not finite",
        )?;
        self.floats(what, &[roughness.u, roughness.v])
    }

    fn fresnel(&self, what: &str, fresnel: &ConductorFresnel) -> Result<(), Invalid> {
        match *fresnel {
            ConductorFresnel::Index { eta, k } => {
                self.colour(what, eta)?;
                self.colour(what, k)
            }
            ConductorFresnel::Reflectance(c) | ConductorFresnel::Schlick(c) => self.colour(what, c),
            ConductorFresnel::Mirror => Ok(()),
        }
    }

    pub(super) fn check_texture(&self, i: usize, texture: &Texture) -> Result<(), Invalid> {
        let what = format!("texture {i}");
        ensure(
            inputs(texture).iter().flatten().all(|id| id.0 < i),
            &what,
            "it refers to a texture after it",
        )?;
        if let Texture::Image { image, .. } = texture {
            let known = image.0 < self.images.len();
            ensure(known, &what, "its image is out of range")?;
        }
        match texture {
            Texture::Image { mapping, .. }
            | Texture::Checkerboard { mapping, .. }
            | Texture::Dots { mapping, .. }
            | Texture::Bilinear { mapping, .. } => check_mapping(&what, mapping)?,
            Texture::Checkerboard3d { to_texture, .. } | Texture::Noise { to_texture, .. } => {
                check_space(&what, to_texture)?;
            }
            _ => {}
        }
        ensure(
            has_good_numbers(texture),
            &what,
            "a number is not finite or out of range",
        )
    }

    pub(super) fn check_material(&self, i: usize, material: &Material) -> Result<(), Invalid> {
        let what = &format!("material {i}");
        self.bump(what, material.bump)?;
        ensure(
            is_light(material.absorption) && material.around.is_none_or(is_light),
            what,
            "its absorption is negative or not finite",
        )?;
        self.check_kind(what, i, &material.kind)
    }

    fn check_kind(&self, what: &str, i: usize, kind: &MaterialKind) -> Result<(), Invalid> {
        match kind {
            MaterialKind::Diffuse {
                reflectance,
                roughness,
            } => {
                self.colour(what, *reflectance)?;
                self.float(what, *roughness)
            }
            MaterialKind::DiffuseTransmission {
                reflectance,
                transmittance,
            } => {
                self.colour(what, *reflectance)?;
                self.colour(what, *transmittance)
            }
            MaterialKind::ThinDielectric {
                eta: e,
                reflection_tint,
                transmission_tint,
            } => {
                index(what, *e)?;
                self.colours(what, &[*reflection_tint, *transmission_tint])
            }
            MaterialKind::Principled(p) => {
                index(what, p.eta)?;
                self.principled(what, p)
            }
            MaterialKind::Gltf(g) => {
                index(what, g.ior)?;
                self.gltf(what, g)
            }
            MaterialKind::Measured(id) => ensure(
                id.0 < self.measured.len(),
                what,
                "its measurement is out of range",
            ),
            MaterialKind::Hair(hair) => self.hair(what, hair),
            MaterialKind::Mix { materials, amount } => {
                ensure(
                    materials.iter().all(|m| m.0 < i),
                    what,
                    "it mixes a material after it",
                )?;
                self.float(what, *amount)
            }
            MaterialKind::Sided(materials) => ensure(
                materials.iter().all(|m| m.0 < i),
                what,
                "a side is a material after it",
            ),
            MaterialKind::Interface => Ok(()),
            _ => self.check_rough(what, kind),
        }
    }

    /// Materials with microfacets.
    fn check_rough(&self, what: &str, kind: &MaterialKind) -> Result<(), Invalid> {
        match kind {
            MaterialKind::Conductor {
                fresnel,
                roughness,
                tint,
            } => {
                self.colour(what, *tint)?;
                self.fresnel(what, fresnel)?;
                self.roughness(what, roughness)
            }
            MaterialKind::Dielectric {
                eta: e,
                roughness,
                reflection_tint,
                transmission_tint,
            } => {
                index(what, *e)?;
                self.colours(what, &[*reflection_tint, *transmission_tint])?;
                self.roughness(what, roughness)
            }
            MaterialKind::CoatedDiffuse {
                reflectance,
                eta: e,
                roughness,
                medium,
                lossless: _,
            } => {
                self.coat_medium(what, medium)?;
                self.colour(what, *reflectance)?;
                index(what, *e)?;
                self.roughness(what, roughness)
            }
            MaterialKind::CoatedConductor {
                coat_eta,
                coat_roughness,
                fresnel,
                roughness,
                medium,
            } => {
                self.coat_medium(what, medium)?;
                index(what, *coat_eta)?;
                self.roughness(what, coat_roughness)?;
                self.fresnel(what, fresnel)?;
                self.roughness(what, roughness)
            }
            MaterialKind::Plastic {
                diffuse,
                specular,
                eta: e,
                roughness,
                nonlinear: _,
            } => {
                index(what, *e)?;
                self.colours(what, &[*diffuse, *specular])?;
                self.roughness(what, roughness)
            }
            _ => Ok(()),
        }
    }
}

/// Checks an index of refraction against its range.
fn index(what: &str, eta: f32) -> Result<(), Invalid> {
    ensure(
        eta > 0.0 && eta.is_finite(),
        what,
        "its index is not above 0",
    )
}

/// The textures that a texture refers to.
pub(crate) fn inputs(texture: &Texture) -> [Option<TextureId>; 3] {
    match *texture {
        Texture::Constant(_)
        | Texture::Image { .. }
        | Texture::Bilinear { .. }
        | Texture::Noise { .. }
        | Texture::VertexColour => [None; 3],
        Texture::Mix { a, b, amount } => match amount {
            FloatParam::Texture(amount) => [Some(a), Some(b), Some(amount)],
            FloatParam::Value(_) => [Some(a), Some(b), None],
        },
        Texture::Scale { a, b }
        | Texture::Sum { a, b }
        | Texture::DirectionMix { a, b, .. }
        | Texture::Checkerboard {
            even: a, odd: b, ..
        }
        | Texture::Checkerboard3d {
            even: a, odd: b, ..
        }
        | Texture::Dots {
            inside: a,
            outside: b,
            ..
        } => [Some(a), Some(b), None],
        Texture::Threshold { texture, .. } => [Some(texture), None, None],
    }
}

/// Whether a texture's own numbers are finite, and its octaves few enough.
fn has_good_numbers(texture: &Texture) -> bool {
    let finite = |c: &Rgb<f32>| [c.r, c.g, c.b].iter().all(|x| x.is_finite());
    match texture {
        Texture::Constant(c) => finite(c),
        Texture::Bilinear { corners, .. } => corners.iter().all(finite),
        Texture::Image { scale, filter, .. } => {
            let anisotropy = match filter {
                Interpolation::Ewa { max_anisotropy } => *max_anisotropy,
                _ => 1.0,
            };
            scale.is_finite() && (1.0..=Interpolation::MOST_ANISOTROPY).contains(&anisotropy)
        }
        Texture::Mix {
            amount: FloatParam::Value(x),
            ..
        } => x.is_finite(),
        Texture::DirectionMix { axis, .. } => axis.iter().all(|x| x.is_finite()),
        Texture::Threshold { cutoff, .. } => cutoff.is_finite(),
        Texture::Noise {
            kind,
            octaves,
            roughness,
            ..
        } => {
            let own = match kind {
                NoiseKind::Marble { scale, variation } => {
                    scale.is_finite() && variation.is_finite()
                }
                NoiseKind::Fbm | NoiseKind::Turbulence | NoiseKind::Windy => true,
            };
            own && roughness.is_finite() && *octaves <= 64
        }
        _ => true,
    }
}

fn check_mapping(what: &str, mapping: &TextureMapping) -> Result<(), Invalid> {
    match mapping {
        TextureMapping::Uv(m) | TextureMapping::SecondUv(m) => ensure(
            m.0.iter().flatten().all(|x| x.is_finite()),
            what,
            "a number is not finite",
        ),
        TextureMapping::Planar { to_texture, s, t } => {
            ensure(
                s.iter().chain(t).all(|x| x.is_finite()),
                what,
                "a number is not finite",
            )?;
            check_space(what, to_texture)
        }
        TextureMapping::Spherical { to_texture } | TextureMapping::Cylindrical { to_texture } => {
            check_space(what, to_texture)
        }
    }
}

fn check_space(what: &str, m: &DMat4) -> Result<(), Invalid> {
    ensure(m.is_finite(), what, "its transform is not finite")
}
