//! Materials whose textures are the same everywhere, as materials without textures.

use specula_scene::scene::{
    CoatMedium, ColourParam, ConductorFresnel, FloatParam, GltfMaterial, MaterialKind,
    PrincipledMaterial, Roughness,
};

use crate::texture::Textures;

/// The material with values for textures that are constant, and whether any texture is left.
pub(super) fn folded(kind: &MaterialKind, textures: &Textures) -> (MaterialKind, bool) {
    let mut folder = Folder {
        textures,
        varies: false,
    };
    let mut kind = *kind;
    folder.kind(&mut kind);
    (kind, folder.varies)
}

struct Folder<'a> {
    textures: &'a Textures,
    varies: bool,
}

impl Folder<'_> {
    fn colour(&mut self, parameter: &mut ColourParam) {
        *parameter = self.textures.fold_colour(*parameter);
        self.varies |= matches!(parameter, ColourParam::Texture(_));
    }

    fn float(&mut self, parameter: &mut FloatParam) {
        *parameter = self.textures.fold_float(*parameter);
        self.varies |= matches!(parameter, FloatParam::Texture(_));
    }

    fn roughness(&mut self, roughness: &mut Roughness) {
        self.float(&mut roughness.u);
        self.float(&mut roughness.v);
    }

    fn coat_medium(&mut self, medium: &mut CoatMedium) {
        self.float(&mut medium.thickness);
        self.colour(&mut medium.albedo);
        self.float(&mut medium.g);
    }

    fn fresnel(&mut self, fresnel: &mut ConductorFresnel) {
        match fresnel {
            ConductorFresnel::Index { eta, k } => {
                self.colour(eta);
                self.colour(k);
            }
            ConductorFresnel::Reflectance(c) | ConductorFresnel::Schlick(c) => self.colour(c),
            ConductorFresnel::Mirror => {}
        }
    }

    fn kind(&mut self, kind: &mut MaterialKind) {
        match kind {
            MaterialKind::Diffuse {
                reflectance,
                roughness,
            } => {
                self.colour(reflectance);
                self.float(roughness);
            }
            MaterialKind::Conductor {
                fresnel,
                roughness,
                tint,
            } => {
                self.fresnel(fresnel);
                self.roughness(roughness);
                self.colour(tint);
            }
            MaterialKind::Dielectric {
                eta: _,
                roughness,
                reflection_tint,
                transmission_tint,
            } => {
                self.roughness(roughness);
                self.colour(reflection_tint);
                self.colour(transmission_tint);
            }
            MaterialKind::ThinDielectric {
                eta: _,
                reflection_tint: a,
                transmission_tint: b,
            }
            | MaterialKind::DiffuseTransmission {
                reflectance: a,
                transmittance: b,
            } => {
                self.colour(a);
                self.colour(b);
            }
            MaterialKind::CoatedDiffuse {
                reflectance,
                eta: _,
                roughness,
                medium,
                lossless: _,
            } => {
                self.coat_medium(medium);
                self.colour(reflectance);
                self.roughness(roughness);
            }
            MaterialKind::CoatedConductor {
                coat_eta: _,
                coat_roughness,
                fresnel,
                roughness,
                medium,
            } => {
                self.coat_medium(medium);
                self.roughness(coat_roughness);
                self.fresnel(fresnel);
                self.roughness(roughness);
            }
            MaterialKind::Plastic {
                diffuse,
                specular,
                eta: _,
                roughness,
                nonlinear: _,
            } => {
                self.colour(diffuse);
                self.colour(specular);
                self.roughness(roughness);
            }
            MaterialKind::Principled(p) => self.principled(p),
            MaterialKind::Gltf(g) => self.gltf(g),
            MaterialKind::Mix { amount, .. } => self.float(amount),
            MaterialKind::Interface => {}
        }
    }

    fn principled(&mut self, p: &mut PrincipledMaterial) {
        self.colour(&mut p.base_colour);
        for value in [
            &mut p.roughness,
            &mut p.anisotropic,
            &mut p.metallic,
            &mut p.spec_trans,
            &mut p.spec_tint,
            &mut p.sheen,
            &mut p.sheen_tint,
            &mut p.clearcoat,
            &mut p.clearcoat_gloss,
            &mut p.flatness,
            &mut p.diff_trans,
        ] {
            self.float(value);
        }
    }

    fn gltf(&mut self, g: &mut GltfMaterial) {
        for colour in [
            &mut g.base_colour,
            &mut g.specular_colour,
            &mut g.sheen_colour,
        ] {
            self.colour(colour);
        }
        for value in [
            &mut g.metallic,
            &mut g.roughness,
            &mut g.anisotropy,
            &mut g.specular,
            &mut g.transmission,
            &mut g.clearcoat,
            &mut g.clearcoat_roughness,
            &mut g.sheen_roughness,
        ] {
            self.float(value);
        }
    }
}
