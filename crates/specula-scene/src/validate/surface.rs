//! Checks of textures and materials.

use glam::DMat4;
use specula_bsdf::Rgb;

use super::{Invalid, ensure, is_light};
use crate::scene::{
    ColourParam, ConductorFresnel, FloatParam, Material, MaterialKind, NoiseKind, Relief,
    Roughness, Scene, Texture, TextureMapping,
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
        let before = |ids: &[usize]| {
            ensure(
                ids.iter().all(|j| *j < i),
                &what,
                "it refers to a texture after it",
            )
        };
        match texture {
            Texture::Constant(c) => ensure(
                [c.r, c.g, c.b].iter().all(|x| x.is_finite()),
                &what,
                "it is not finite",
            ),
            Texture::Image {
                image,
                mapping,
                scale,
                ..
            } => {
                ensure(
                    image.0 < self.images.len(),
                    &what,
                    "its image is out of range",
                )?;
                ensure(scale.is_finite(), &what, "its scale is not finite")?;
                check_mapping(&what, mapping)
            }
            Texture::Scale { a, b } => before(&[a.0, b.0]),
            Texture::Mix { a, b, amount } => {
                before(&[a.0, b.0])?;
                match amount {
                    FloatParam::Texture(id) => before(&[id.0]),
                    FloatParam::Value(x) => {
                        ensure(x.is_finite(), &what, "its amount is not finite")
                    }
                }
            }
            Texture::Checkerboard { even, odd, mapping } => {
                before(&[even.0, odd.0])?;
                check_mapping(&what, mapping)
            }
            Texture::Dots {
                inside,
                outside,
                mapping,
            } => {
                before(&[inside.0, outside.0])?;
                check_mapping(&what, mapping)
            }
            Texture::Checkerboard3d {
                even,
                odd,
                to_texture,
            } => {
                before(&[even.0, odd.0])?;
                check_space(&what, to_texture)
            }
            Texture::Bilinear { corners, mapping } => {
                let finite = |c: &Rgb<f32>| [c.r, c.g, c.b].iter().all(|x| x.is_finite());
                ensure(corners.iter().all(finite), &what, "it is not finite")?;
                check_mapping(&what, mapping)
            }
            Texture::Noise {
                kind,
                octaves,
                roughness,
                to_texture,
            } => {
                let marble = match kind {
                    NoiseKind::Marble { scale, variation } => {
                        scale.is_finite() && variation.is_finite()
                    }
                    NoiseKind::Fbm | NoiseKind::Turbulence | NoiseKind::Windy => true,
                };
                ensure(
                    marble && roughness.is_finite() && *octaves <= 64,
                    &what,
                    "a number is out of range",
                )?;
                check_space(&what, to_texture)
            }
            Texture::Sum { a, b } => before(&[a.0, b.0]),
            Texture::DirectionMix { a, b, axis } => {
                before(&[a.0, b.0])?;
                ensure(
                    axis.iter().all(|x| x.is_finite()),
                    &what,
                    "its axis is not finite",
                )
            }
            Texture::Threshold { texture, cutoff } => {
                before(&[texture.0])?;
                ensure(cutoff.is_finite(), &what, "its cutoff is not finite")
            }
            Texture::VertexColour => Ok(()),
        }
    }

    pub(super) fn check_material(&self, i: usize, material: &Material) -> Result<(), Invalid> {
        let what = &format!("material {i}");
        match material.relief {
            None => {}
            Some(Relief::Height(FloatParam::Texture(map)) | Relief::Normal { map, .. }) => ensure(
                map.0 < self.textures.len(),
                what,
                "a texture is out of range",
            )?,
            Some(Relief::Height(FloatParam::Value(x))) => {
                ensure(x.is_finite(), what, "its height is not finite")?;
            }
        }
        self.check_kind(what, i, &material.kind)
    }

    fn check_kind(&self, what: &str, i: usize, kind: &MaterialKind) -> Result<(), Invalid> {
        let eta = |eta: f32| {
            ensure(
                eta > 0.0 && eta.is_finite(),
                what,
                "its index is not above 0",
            )
        };
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
                eta(*e)?;
                self.colours(what, &[*reflection_tint, *transmission_tint])?;
                self.roughness(what, roughness)
            }
            MaterialKind::ThinDielectric {
                eta: e,
                reflection_tint,
                transmission_tint,
            } => {
                eta(*e)?;
                self.colours(what, &[*reflection_tint, *transmission_tint])
            }
            MaterialKind::CoatedDiffuse {
                reflectance,
                eta: e,
                roughness,
            } => {
                self.colour(what, *reflectance)?;
                eta(*e)?;
                self.roughness(what, roughness)
            }
            MaterialKind::CoatedConductor {
                coat_eta,
                coat_roughness,
                fresnel,
                roughness,
            } => {
                eta(*coat_eta)?;
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
                eta(*e)?;
                self.colours(what, &[*diffuse, *specular])?;
                self.roughness(what, roughness)
            }
            MaterialKind::Principled(p) => {
                eta(p.eta)?;
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
            MaterialKind::Gltf(g) => {
                eta(g.ior)?;
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
                )
            }
            MaterialKind::Mix { materials, amount } => {
                ensure(
                    materials.iter().all(|m| m.0 < i),
                    what,
                    "it mixes a material after it",
                )?;
                self.float(what, *amount)
            }
            MaterialKind::Interface => Ok(()),
        }
    }
}

fn check_mapping(what: &str, mapping: &TextureMapping) -> Result<(), Invalid> {
    match mapping {
        TextureMapping::Uv(m) => ensure(
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
