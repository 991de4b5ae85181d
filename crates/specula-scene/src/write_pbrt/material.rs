//! Materials, each under its name.

use specula_bsdf::ndf::Masking;
use specula_bsdf::{Bsdf, Rgb};

use super::{TextureType, WriteError, Writer, quoted};
use crate::scene::{
    Bump, CoatMedium, ColourParam, ConductorFresnel, FloatParam, GltfMaterial, HairMaterial,
    HairPigment, Material, MaterialId, MaterialKind, MeasuredId, MicrofacetDistribution,
    PrincipledMaterial, Roughness, RoughnessMapping, TextureId,
};

impl Writer<'_> {
    pub(super) fn materials(&mut self) -> Result<(), WriteError> {
        let scene = self.scene;
        for (i, material) in scene.materials.iter().enumerate() {
            if self.names.is_alias(MaterialId(i)) {
                continue;
            }
            let params = self.material(i, material)?;
            let name = quoted(self.names.of(MaterialId(i)));
            self.line(&format!("MakeNamedMaterial {name}{params}"));
        }
        Ok(())
    }

    fn material(&mut self, index: usize, material: &Material) -> Result<String, WriteError> {
        if material.one_sided {
            self.note("materials with a black back are written with two equal sides");
        }
        let mut params = self.kind(index, &material.kind)?;
        match material.bump {
            None => {}
            Some(Bump::Height(height)) => params += &self.float_param("displacement", height)?,
            Some(Bump::Normal { map, scale }) => {
                let picture = self.plain_picture(ColourParam::Texture(map));
                match picture {
                    Some((image, factor)) if scale == 1.0 && factor == Rgb::WHITE => {
                        let file = self.image(image, crate::scene::Channel::Rgb)?;
                        params += &format!(" \"string normalmap\" [ {} ]", quoted(&file));
                    }
                    _ => self.note("normal maps that are scaled or moved are left out"),
                }
            }
        }
        // A pbrt scene scatters singly unless its materials say otherwise.
        let of_scene = self.scene.settings.energy;
        let asks = of_scene != crate::Energy::None && scatters_between_facets(&material.kind);
        if let Some(energy) = material.energy.or(asks.then_some(of_scene)) {
            params += &format!(" \"string specula:energy\" [ \"{energy}\" ]");
        }
        Ok(params)
    }

    fn kind(&mut self, index: usize, kind: &MaterialKind) -> Result<String, WriteError> {
        let mut params = String::new();
        let name = match kind {
            MaterialKind::Diffuse {
                reflectance,
                roughness,
            } => {
                params += &self.diffuse(*reflectance, *roughness)?;
                "diffuse"
            }
            MaterialKind::DiffuseTransmission {
                reflectance,
                transmittance,
            } => {
                params += &self.colour_param("reflectance", *reflectance)?;
                params += &self.colour_param("transmittance", *transmittance)?;
                "diffusetransmission"
            }
            MaterialKind::Conductor {
                fresnel,
                roughness,
                tint,
            } => {
                self.untinted(&[*tint]);
                params += &self.metal("", Some(fresnel), roughness)?;
                "conductor"
            }
            MaterialKind::Dielectric {
                eta,
                roughness,
                reflection_tint,
                transmission_tint,
            } => {
                params += &self.glass(*eta, [*reflection_tint, *transmission_tint]);
                params += &self.roughness("", roughness)?;
                "dielectric"
            }
            MaterialKind::ThinDielectric {
                eta,
                reflection_tint,
                transmission_tint,
            } => {
                params += &self.glass(*eta, [*reflection_tint, *transmission_tint]);
                "thindielectric"
            }
            MaterialKind::CoatedDiffuse {
                reflectance,
                eta,
                roughness,
                medium,
                lossless,
            } => {
                self.lossless(*lossless && *roughness != Roughness::smooth());
                return self.coated_diffuse(*reflectance, *eta, roughness, medium);
            }
            MaterialKind::Plastic {
                diffuse,
                specular,
                eta,
                roughness,
                ..
            } => {
                self.note("plastic is written as coateddiffuse");
                self.untinted(&[*specular]);
                return self.coated_diffuse(*diffuse, *eta, roughness, &CoatMedium::default());
            }
            MaterialKind::CoatedConductor { .. } => return self.coated_conductor(kind),
            MaterialKind::Principled(p) => return self.principled(index, p),
            MaterialKind::Gltf(g) => return self.gltf(index, g),
            MaterialKind::Measured(id) => return self.measured(*id),
            MaterialKind::Hair(hair) => return self.hair(hair),
            MaterialKind::Mix { materials, amount } => return self.mix(*materials, *amount),
            MaterialKind::Sided(materials) => {
                self.note("sides of different materials are written as the outer one");
                return self.mix(*materials, FloatParam::Value(0.0));
            }
            MaterialKind::Interface => "interface",
        };
        Ok(typed(name, &params))
    }

    fn mix(
        &mut self,
        materials: [MaterialId; 2],
        amount: FloatParam,
    ) -> Result<String, WriteError> {
        let [a, b] = materials.map(|m| quoted(self.names.of(m)));
        let amount = self.float_param("amount", amount)?;
        let params = format!(" \"string materials\" [ {a} {b} ]{amount}");
        Ok(typed("mix", &params))
    }

    fn measured(&mut self, id: MeasuredId) -> Result<String, WriteError> {
        self.note("measured materials are written as diffuse ones of a like albedo");
        let albedo = self.scene.measured[id.0].lobe().albedo();
        let params = self.diffuse(ColourParam::Value(albedo), FloatParam::Value(0.0))?;
        Ok(typed("diffuse", &params))
    }

    fn hair(&mut self, hair: &HairMaterial) -> Result<String, WriteError> {
        if self.scene.meshes.iter().any(|m| m.is_fibre) {
            self.note(
                "fibres of hair are written as meshes, on which pbrt-v4 takes the offset across a \
                 fibre from texture coordinates",
            );
        }
        let mut params = match hair.pigment {
            HairPigment::Absorption(c) => self.colour_param("sigma_a", c)?,
            HairPigment::Reflectance(c) => self.colour_param("reflectance", c)?,
            HairPigment::Melanin {
                eumelanin,
                pheomelanin,
            } => {
                self.float_param("eumelanin", eumelanin)?
                    + &self.float_param("pheomelanin", pheomelanin)?
            }
        };
        for (name, value) in [
            ("eta", hair.eta),
            ("beta_m", hair.beta_m),
            ("beta_n", hair.beta_n),
            ("alpha", hair.alpha_deg),
        ] {
            params += &self.float_param(name, value)?;
        }
        Ok(typed("hair", &params))
    }

    fn lossless(&mut self, is_rough: bool) {
        if is_rough {
            self.note("coats that lose nothing are written as pbrt-v4's, which scatter once");
        }
    }

    fn diffuse(
        &mut self,
        reflectance: ColourParam,
        roughness: FloatParam,
    ) -> Result<String, WriteError> {
        if roughness != FloatParam::Value(0.0) {
            self.note("rough diffuse materials are written as Lambert's");
        }
        self.colour_param("reflectance", reflectance)
    }

    fn coated_conductor(&mut self, kind: &MaterialKind) -> Result<String, WriteError> {
        let MaterialKind::CoatedConductor {
            coat_eta,
            coat_roughness,
            fresnel,
            roughness,
            medium,
        } = kind
        else {
            return Ok(String::new());
        };
        let mut params = format!(" \"float interface.eta\" [ {coat_eta} ]");
        params += &self.metal("interface.", None, coat_roughness)?;
        params += &self.metal("conductor.", Some(fresnel), roughness)?;
        params += &self.coat_medium(medium)?;
        Ok(typed("coatedconductor", &params))
    }

    /// What lies under a coat. pbrt-v4's walks cannot be without a limit: they get one so far off
    /// that it is not met.
    fn coat_medium(&mut self, medium: &CoatMedium) -> Result<String, WriteError> {
        let mut params = self.float_param("thickness", medium.thickness)?;
        let depth = medium.max_depth.unwrap_or(1000);
        params += &format!(" \"integer maxdepth\" [ {depth} ]");
        if medium.samples != 1 {
            params += &format!(" \"integer nsamples\" [ {} ]", medium.samples);
        }
        if medium.scatters() {
            params += &self.colour_param("albedo", medium.albedo)?;
            params += &self.float_param("g", medium.g)?;
        }
        Ok(params)
    }

    /// A layer's Fresnel term, where it is a metal's, and its roughness.
    fn metal(
        &mut self,
        prefix: &str,
        fresnel: Option<&ConductorFresnel>,
        roughness: &Roughness,
    ) -> Result<String, WriteError> {
        let mut params = String::new();
        if let Some(fresnel) = fresnel {
            params += &self.fresnel(prefix, "reflectance", fresnel)?;
        }
        params += &self.roughness(prefix, roughness)?;
        Ok(params)
    }

    fn glass(&mut self, eta: f32, tints: [ColourParam; 2]) -> String {
        self.untinted(&tints);
        format!(" \"float eta\" [ {eta} ]")
    }

    fn untinted(&mut self, tints: &[ColourParam]) {
        if tints.iter().any(|t| *t != ColourParam::WHITE) {
            self.note("tints of metal and glass are left out");
        }
    }

    fn coated_diffuse(
        &mut self,
        reflectance: ColourParam,
        eta: f32,
        roughness: &Roughness,
        medium: &CoatMedium,
    ) -> Result<String, WriteError> {
        let mut params = self.colour_param("reflectance", reflectance)?;
        params += &format!(" \"float eta\" [ {eta} ]");
        params += &self.roughness("", roughness)?;
        params += &self.coat_medium(medium)?;
        Ok(typed("coateddiffuse", &params))
    }

    fn fresnel(
        &mut self,
        prefix: &str,
        reflectance: &str,
        fresnel: &ConductorFresnel,
    ) -> Result<String, WriteError> {
        Ok(match *fresnel {
            ConductorFresnel::Index { eta, k } => {
                let mut params = self.colour_param(&format!("{prefix}eta"), eta)?;
                params += &self.colour_param(&format!("{prefix}k"), k)?;
                params
            }
            ConductorFresnel::Reflectance(c) => self.colour_param(reflectance, c)?,
            ConductorFresnel::Schlick(c) => {
                self.note("Schlick's Fresnel term is written as the reflectance of a metal");
                self.colour_param(reflectance, c)?
            }
            ConductorFresnel::Mirror => self.colour_param(reflectance, ColourParam::WHITE)?,
        })
    }

    fn roughness(&mut self, prefix: &str, r: &Roughness) -> Result<String, WriteError> {
        if r.distribution == MicrofacetDistribution::Beckmann {
            self.note("Beckmann's distribution is written as GGX");
        }
        if r.masking == Masking::Separable {
            self.note("separable masking is written as height-correlated masking");
        }
        if r.rotation_rad != 0.0 {
            self.note("rotated anisotropy is written unrotated");
        }
        let remap = r.mapping == RoughnessMapping::Sqrt;
        let [u, v] = match r.mapping {
            RoughnessMapping::Alpha | RoughnessMapping::Sqrt => [r.u, r.v].map(AlphaParam::Plain),
            RoughnessMapping::Square => [self.squared(r.u)?, self.squared(r.v)?],
        };
        // One flag serves both layers of a coated conductor.
        let mut params = match prefix {
            "conductor." => String::new(),
            _ => format!(" \"bool remaproughness\" [ {remap} ]"),
        };
        params += &self.width(&format!("{prefix}uroughness"), u)?;
        params += &self.width(&format!("{prefix}vroughness"), v)?;
        Ok(params)
    }

    fn width(&mut self, name: &str, width: AlphaParam) -> Result<String, WriteError> {
        match width {
            AlphaParam::Plain(p) => self.float_param(name, p),
            AlphaParam::Named(texture) => {
                Ok(format!(" \"texture {name}\" [ {} ]", quoted(&texture)))
            }
        }
    }

    fn squared(&mut self, p: FloatParam) -> Result<AlphaParam, WriteError> {
        Ok(match p {
            FloatParam::Value(x) => AlphaParam::Plain(FloatParam::Value(x * x)),
            FloatParam::Texture(id) => AlphaParam::Named(self.squared_texture(id)?),
        })
    }

    /// The product of a texture and itself.
    fn squared_texture(&mut self, id: TextureId) -> Result<String, WriteError> {
        if let Some(name) = self.squared.get(&id) {
            return Ok(name.clone());
        }
        let plain = quoted(&self.texture(id, TextureType::Float)?);
        let name = format!("texture-{}-squared", id.0);
        self.line(&format!(
            "Texture {} \"float\" \"scale\" \"texture tex\" [ {plain} ] \"texture scale\" [ {plain} ]",
            quoted(&name)
        ));
        self.squared.insert(id, name.clone());
        Ok(name)
    }

    /// A part of a layered material, under a name of its own.
    fn part(
        &mut self,
        index: usize,
        part: &str,
        kind: &MaterialKind,
    ) -> Result<String, WriteError> {
        let name = self.names.part(MaterialId(index), part);
        let params = self.kind(index, kind)?;
        self.line(&format!("MakeNamedMaterial {}{params}", quoted(&name)));
        Ok(name)
    }

    /// `(1 - amount) a + amount b`, or one of them where the amount leaves no choice.
    fn between(
        &mut self,
        index: usize,
        amount: FloatParam,
        a: (&str, MaterialKind),
        b: (&str, MaterialKind),
    ) -> Result<String, WriteError> {
        match amount {
            FloatParam::Value(x) if x <= 0.0 => self.kind(index, &a.1),
            FloatParam::Value(x) if x >= 1.0 => self.kind(index, &b.1),
            _ => {
                let a = self.part(index, a.0, &a.1)?;
                let b = self.part(index, b.0, &b.1)?;
                let mut params = format!(" \"string materials\" [ {} {} ]", quoted(&a), quoted(&b));
                params += &self.float_param("amount", amount)?;
                Ok(typed("mix", &params))
            }
        }
    }

    fn gltf(&mut self, index: usize, g: &GltfMaterial) -> Result<String, WriteError> {
        let absent = |p: FloatParam| p == FloatParam::Value(0.0);
        self.note(
            "metallic-roughness materials are written as a mix of conductor and coateddiffuse",
        );
        if !absent(g.clearcoat) || !absent(g.anisotropy) {
            self.note("clear coats and anisotropy of metallic-roughness materials are left out");
        }
        if g.sheen_colour != ColourParam::Value(Rgb::BLACK) {
            self.note("sheen is left out");
        }
        let base = if absent(g.transmission) {
            coated(g.base_colour, g.ior, g.roughness)
        } else {
            self.note("transmission is written as uncoloured glass, wherever there is any");
            glass(g.ior, g.roughness, g.volume)
        };
        let metal = metal(g.base_colour, g.roughness);
        self.between(index, g.metallic, ("base", base), ("metal", metal))
    }

    fn principled(&mut self, index: usize, p: &PrincipledMaterial) -> Result<String, WriteError> {
        let absent = |p: FloatParam| p == FloatParam::Value(0.0);
        self.note("principled materials are written as a mix of conductor and coateddiffuse");
        if !(absent(p.sheen)
            && absent(p.clearcoat)
            && absent(p.anisotropic)
            && absent(p.diff_trans))
        {
            self.note("sheen, clear coat, anisotropy and diffuse transmission are left out");
        }
        let base = if absent(p.spec_trans) {
            coated(p.base_colour, p.eta, p.roughness)
        } else {
            self.note("transmission is written as uncoloured glass, wherever there is any");
            glass(p.eta, p.roughness, !p.thin)
        };
        let metal = metal(p.base_colour, p.roughness);
        self.between(index, p.metallic, ("base", base), ("metal", metal))
    }
}

fn coated(reflectance: ColourParam, eta: f32, roughness: FloatParam) -> MaterialKind {
    MaterialKind::CoatedDiffuse {
        reflectance,
        eta,
        roughness: Roughness::isotropic(roughness, RoughnessMapping::Square),
        medium: CoatMedium::default(),
        lossless: false,
    }
}

fn metal(reflectance: ColourParam, roughness: FloatParam) -> MaterialKind {
    MaterialKind::Conductor {
        fresnel: ConductorFresnel::Reflectance(reflectance),
        roughness: Roughness::isotropic(roughness, RoughnessMapping::Square),
        tint: ColourParam::WHITE,
    }
}

fn glass(eta: f32, roughness: FloatParam, volume: bool) -> MaterialKind {
    let (reflection_tint, transmission_tint) = (ColourParam::WHITE, ColourParam::WHITE);
    if volume {
        MaterialKind::Dielectric {
            eta,
            roughness: Roughness::isotropic(roughness, RoughnessMapping::Square),
            reflection_tint,
            transmission_tint,
        }
    } else {
        MaterialKind::ThinDielectric {
            eta,
            reflection_tint,
            transmission_tint,
        }
    }
}

/// The parameter of a roughness, or the name of a texture that was made for it.
enum AlphaParam {
    Plain(FloatParam),
    Named(String),
}

fn typed(name: &str, params: &str) -> String {
    format!(" \"string type\" [ \"{name}\" ]{params}")
}

/// Whether a treatment of multiple scattering changes it, in the form that pbrt knows.
fn scatters_between_facets(kind: &MaterialKind) -> bool {
    matches!(
        kind,
        MaterialKind::Conductor { .. }
            | MaterialKind::Dielectric { .. }
            | MaterialKind::CoatedDiffuse { .. }
            | MaterialKind::CoatedConductor { .. }
            | MaterialKind::Gltf(_)
    )
}
