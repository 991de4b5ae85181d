//! The parameters of each kind of material: which shader reads them, which of them have textures, and their order in
//! a shader's words.
//!
//! A kind of material has a row in [`material_shader_table`](crate::material_shader_table), an arm of
//! `Material::shader`, of `Folder::kind` and of `Material::parameters`.

use specula_bsdf::Rgb;
use specula_bsdf::internal::shader_codes;
use specula_scene::Energy;
use specula_scene::scene::{
    CoatMedium, ColourParam, ConductorFresnel, FloatParam, GltfMaterial, HairMaterial, HairPigment,
    MaterialId, MaterialKind, MicrofacetDistribution, PrincipledMaterial, Roughness,
    RoughnessMapping,
};

use super::Material;
use crate::codes;
use crate::convert::id;
use crate::texture::{Textures, colour_parameter};
use crate::words::Words;

/// Hands the kinds of material that shaders distinguish to the macro `callback!`.
///
/// ```text
/// /// documentation
/// Variant = code, ["the module of specula-gpu/wgsl"];
/// ```
///
/// [`MaterialShader`] is made of these rows, and in `specula-gpu` the list of modules, the codes as constants and the
/// switch between them.
#[doc(hidden)]
#[macro_export]
macro_rules! material_shader_table {
    ($callback:ident) => {
        $callback! {
            /// Lambert, or Oren-Nayar where it is rough.
            Diffuse = 0, ["material_diffuse"];
            /// Diffuse on both sides.
            DiffuseTransmission = 1, ["material_diffuse_transmission"];
            /// Metal with single scattering.
            Conductor = 2, ["material_conductor"];
            /// Metal with compensated energy.
            CompensatedConductor = 3, ["material_compensated_conductor"];
            /// Metal whose bounces are simulated.
            MultibounceConductor = 4, ["material_multibounce_conductor"];
            /// Glass with single scattering.
            Dielectric = 5, ["material_dielectric"];
            /// Glass with compensated energy.
            CompensatedDielectric = 6, ["material_compensated_dielectric"];
            /// Glass whose bounces are simulated.
            MultibounceDielectric = 7, ["material_multibounce_dielectric"];
            /// A thin pane.
            ThinDielectric = 8, ["material_thin_dielectric"];
            /// Lambert under a coat.
            CoatedDiffuse = 9, ["material_coated_diffuse"];
            /// A walk between a coat and what is under it.
            Layered = 10, ["material_layered"];
            /// Mitsuba's plastics.
            Plastic = 11, ["material_plastic"];
            /// Mitsuba's principled.
            Principled = 12, ["material_principled"];
            /// glTF's metallic-roughness.
            Gltf = 13, ["material_gltf"];
            /// One of two materials by chance, or by the side; it has no module, as it is one of the others.
            Mix = 14, [];
            /// No surface; paths pass it, so that it has no module.
            Interface = 15, [];
            /// A measured material.
            Measured = 16, ["material_measured"];
            /// Hair; no shader renders it, so that it has no module.
            Hair = 17, [];
        }
    };
}

macro_rules! define_material_shader {
    ($($(#[$doc:meta])* $name:ident = $code:literal, [$($module:literal)?];)*) => {
        /// What a material is to shaders; its code is the first word of the material's record.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        #[non_exhaustive]
        #[repr(u32)]
        pub enum MaterialShader {
            $($(#[$doc])* $name = $code,)*
        }

        impl MaterialShader {
            /// All of them.
            pub const ALL: &'static [Self] = &[$(Self::$name),*];

            /// Its module in `specula-gpu/wgsl`; `None` for mixes, interfaces and hair.
            #[must_use]
            pub const fn module(self) -> Option<&'static str> {
                match self {
                    $(Self::$name => {
                        const MODULE: &[&str] = &[$($module)?];
                        MODULE.first().copied()
                    })*
                }
            }
        }
    };
}

material_shader_table!(define_material_shader);

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
            MaterialKind::Hair(hair) => self.hair(hair),
            MaterialKind::Mix { amount, .. } => self.float(amount),
            MaterialKind::Sided(_) | MaterialKind::Interface | MaterialKind::Measured(_) => {}
        }
    }

    fn hair(&mut self, hair: &mut HairMaterial) {
        match &mut hair.pigment {
            HairPigment::Absorption(c) | HairPigment::Reflectance(c) => self.colour(c),
            HairPigment::Melanin {
                eumelanin,
                pheomelanin,
            } => {
                self.float(eumelanin);
                self.float(pheomelanin);
            }
        }
        for value in [
            &mut hair.eta,
            &mut hair.beta_m,
            &mut hair.beta_n,
            &mut hair.alpha_deg,
        ] {
            self.float(value);
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

impl Material {
    /// What it is to shaders.
    pub(super) fn shader(&self) -> MaterialShader {
        use MaterialShader as S;
        let energy = |[none, compensated, simulated]: [S; 3]| match self.models.energy {
            Energy::None => none,
            Energy::Compensated(_) => compensated,
            Energy::Multibounce(_) => simulated,
        };
        match &self.kind {
            MaterialKind::Diffuse { .. } => S::Diffuse,
            MaterialKind::DiffuseTransmission { .. } => S::DiffuseTransmission,
            MaterialKind::Conductor { .. } => energy([
                S::Conductor,
                S::CompensatedConductor,
                S::MultibounceConductor,
            ]),
            MaterialKind::Dielectric { .. } => energy([
                S::Dielectric,
                S::CompensatedDielectric,
                S::MultibounceDielectric,
            ]),
            MaterialKind::ThinDielectric { .. } => S::ThinDielectric,
            MaterialKind::CoatedDiffuse { medium, .. } if !medium.scatters() => S::CoatedDiffuse,
            MaterialKind::CoatedDiffuse { .. } | MaterialKind::CoatedConductor { .. } => S::Layered,
            MaterialKind::Plastic { .. } => S::Plastic,
            MaterialKind::Principled(_) => S::Principled,
            MaterialKind::Gltf(_) => S::Gltf,
            MaterialKind::Mix { .. } | MaterialKind::Sided(_) => S::Mix,
            MaterialKind::Interface => S::Interface,
            MaterialKind::Measured(_) => S::Measured,
            MaterialKind::Hair(_) => S::Hair,
        }
    }

    /// What the kind has.
    pub(super) fn parameters(&self) -> Parameters {
        let mut to = Parameters {
            regularized: self.models.regularized,
            ..Parameters::default()
        };
        match self.kind {
            MaterialKind::Diffuse {
                reflectance,
                roughness,
            } => to.colours([reflectance]).floats([roughness]),
            MaterialKind::DiffuseTransmission {
                reflectance,
                transmittance,
            } => to.colours([reflectance, transmittance]),
            MaterialKind::Conductor {
                ref fresnel,
                ref roughness,
                tint,
            } => to.roughness(roughness).fresnel(fresnel).colours([tint]),
            MaterialKind::Dielectric {
                eta,
                ref roughness,
                reflection_tint,
                transmission_tint,
            } => to
                .roughness(roughness)
                .number(eta)
                .colours([reflection_tint, transmission_tint]),
            MaterialKind::ThinDielectric {
                eta,
                reflection_tint,
                transmission_tint,
            } => to.number(eta).colours([reflection_tint, transmission_tint]),
            MaterialKind::CoatedDiffuse {
                reflectance,
                eta,
                ref roughness,
                ref medium,
                lossless,
            } => {
                let lossless = lossless || self.models.energy != Energy::None;
                to.roughness(roughness)
                    .number(eta)
                    .coated_diffuse(reflectance, medium, lossless)
            }
            MaterialKind::Plastic {
                diffuse,
                specular,
                eta,
                ref roughness,
                nonlinear,
            } => to
                .roughness(roughness)
                .number(eta)
                .colours([diffuse, specular])
                .flag(nonlinear),
            MaterialKind::Mix { materials, amount } => to.mix(materials, amount, false),
            MaterialKind::Sided(materials) => to.mix(materials, FloatParam::Value(0.0), true),
            MaterialKind::CoatedConductor {
                coat_eta,
                ref coat_roughness,
                ref fresnel,
                ref roughness,
                ref medium,
            } => to
                .roughness(coat_roughness)
                .number(coat_eta)
                .medium(medium)
                .roughness(roughness)
                .fresnel(fresnel),
            MaterialKind::Principled(ref p) => to.principled(p),
            MaterialKind::Gltf(ref g) => to.gltf(g, self.models.energy != Energy::None),
            MaterialKind::Interface | MaterialKind::Measured(_) | MaterialKind::Hair(_) => &mut to,
        };
        to
    }
}

/// Parameters of a material: those that may have a texture, which shaders look up in one loop, and the
/// words behind them.
#[derive(Default)]
pub(super) struct Parameters {
    textured: Vec<ColourParam>,
    plain: Vec<u32>,
    /// Whether alphas are made larger, as behind a rough surface.
    regularized: bool,
    /// What is among them.
    codes: ParameterCodes,
}

/// Codes of materials' parameters, each code once.
#[derive(Default)]
pub(super) struct ParameterCodes {
    distributions: Vec<u32>,
    maskings: Vec<u32>,
    metals: Vec<u32>,
    compensations: Vec<u32>,
    conductor_bounces: Vec<u32>,
    dielectric_bounces: Vec<u32>,
}

impl ParameterCodes {
    /// Adds those of a material.
    ///
    /// * `energy`: the code of its model of energy.
    pub(super) fn add(&mut self, shader: MaterialShader, energy: u32, parameters: &Parameters) {
        let other = &parameters.codes;
        self.distributions.extend(&other.distributions);
        self.maskings.extend(&other.maskings);
        self.metals.extend(&other.metals);
        match shader {
            MaterialShader::CompensatedConductor => self.compensations.push(energy),
            MaterialShader::MultibounceConductor => self.conductor_bounces.push(energy),
            MaterialShader::MultibounceDielectric => self.dielectric_bounces.push(energy),
            _ => {}
        }
    }

    /// Constants that say which code is the only one; [`codes::NONE`] where there are several.
    pub(super) fn flatten(&self, to: &mut Words) {
        let only = |codes: &[u32]| match codes {
            [first, rest @ ..] if rest.iter().all(|code| code == first) => *first,
            _ => codes::NONE,
        };
        for (name, codes) in [
            ("ONLY_DISTRIBUTION", &self.distributions),
            ("ONLY_MASKING", &self.maskings),
            ("ONLY_METAL", &self.metals),
            ("ONLY_COMPENSATION", &self.compensations),
            ("ONLY_CONDUCTOR_BOUNCES", &self.conductor_bounces),
            ("ONLY_DIELECTRIC_BOUNCES", &self.dielectric_bounces),
        ] {
            to.constant(name, only(codes));
        }
    }
}

impl Parameters {
    fn colours<const N: usize>(&mut self, colours: [ColourParam; N]) -> &mut Self {
        self.textured.extend(colours);
        self
    }

    /// Grey colours.
    fn floats<const N: usize>(&mut self, floats: [FloatParam; N]) -> &mut Self {
        self.colours(floats.map(|float| match float {
            FloatParam::Value(v) => ColourParam::Value(Rgb::splat(v)),
            FloatParam::Texture(id) => ColourParam::Texture(id),
        }))
    }

    pub(super) fn id(&mut self, word: u32) -> &mut Self {
        self.plain.push(word);
        self
    }

    fn mix(&mut self, parts: [MaterialId; 2], amount: FloatParam, by_side: bool) -> &mut Self {
        let [first, second] = parts.map(|m| id(m.0));
        self.floats([amount]).id(first).id(second).flag(by_side)
    }

    fn flag(&mut self, flag: bool) -> &mut Self {
        self.id(u32::from(flag))
    }

    fn number(&mut self, x: f32) -> &mut Self {
        self.id(x.to_bits())
    }

    /// Two roughnesses; what they are, distribution, masking.
    fn roughness(&mut self, roughness: &Roughness) -> &mut Self {
        let mapping = match roughness.mapping {
            RoughnessMapping::Alpha => codes::ROUGHNESS_ALPHA,
            RoughnessMapping::Sqrt => codes::ROUGHNESS_SQRT,
            RoughnessMapping::Square => codes::ROUGHNESS_SQUARE,
        };
        let regularized = match self.regularized {
            true => codes::ROUGHNESS_REGULARIZED,
            false => 0,
        };
        let distribution = match roughness.distribution {
            MicrofacetDistribution::Ggx => shader_codes::DISTRIBUTION_GGX,
            MicrofacetDistribution::Beckmann => shader_codes::DISTRIBUTION_BECKMANN,
        };
        let masking = shader_codes::masking(roughness.masking);
        self.codes.distributions.push(distribution);
        self.codes.maskings.push(masking);
        self.floats([roughness.u, roughness.v])
            .id(mapping + regularized)
            .id(distribution)
            .id(masking)
    }

    /// Two colours; what they are.
    fn fresnel(&mut self, fresnel: &ConductorFresnel) -> &mut Self {
        let none = ColourParam::Value(Rgb::WHITE);
        let (kind, colours) = match *fresnel {
            ConductorFresnel::Index { eta, k } => (codes::METAL_INDEX, [eta, k]),
            ConductorFresnel::Reflectance(colour) => (codes::METAL_REFLECTANCE, [colour, none]),
            ConductorFresnel::Schlick(colour) => (codes::METAL_SCHLICK, [colour, none]),
            ConductorFresnel::Mirror => (codes::METAL_MIRROR, [none; 2]),
        };
        self.codes.metals.push(kind);
        self.colours(colours).id(kind)
    }

    /// Thickness, albedo, asymmetry; most events, walks.
    fn medium(&mut self, medium: &CoatMedium) -> &mut Self {
        self.floats([medium.thickness])
            .colours([medium.albedo])
            .floats([medium.g])
            .id(medium.max_depth.unwrap_or(u32::MAX))
            .id(medium.samples)
    }

    /// In closed form where nothing scatters under the coat.
    fn coated_diffuse(
        &mut self,
        reflectance: ColourParam,
        medium: &CoatMedium,
        lossless: bool,
    ) -> &mut Self {
        if medium.scatters() {
            return self.medium(medium).colours([reflectance]);
        }
        self.colours([reflectance])
            .flag(lossless)
            .floats([medium.thickness])
            .id(medium.max_depth.unwrap_or(u32::MAX))
    }

    fn principled(&mut self, p: &PrincipledMaterial) -> &mut Self {
        let regularized = self.regularized;
        self.colours([p.base_colour])
            .floats([p.roughness, p.anisotropic, p.metallic, p.spec_trans])
            .floats([p.spec_tint, p.sheen, p.sheen_tint, p.clearcoat])
            .floats([p.clearcoat_gloss, p.flatness, p.diff_trans])
            .number(p.eta)
            .flag(p.thin)
            .flag(regularized)
    }

    fn gltf(&mut self, g: &GltfMaterial, compensated: bool) -> &mut Self {
        let regularized = self.regularized;
        self.colours([g.base_colour, g.specular_colour, g.sheen_colour])
            .floats([g.metallic, g.roughness, g.anisotropy, g.specular])
            .floats([g.transmission, g.clearcoat, g.clearcoat_roughness])
            .floats([g.sheen_roughness])
            .number(g.ior)
            .id((codes::GLTF_VOLUME * u32::from(g.volume))
                | (codes::GLTF_COMPENSATED * u32::from(compensated)))
            .flag(regularized)
    }

    pub(super) fn flatten(&self, to: &mut Words) {
        to.id(id(self.textured.len()));
        for &colour in &self.textured {
            colour_parameter(to, colour);
        }
        to.ids(self.plain.iter().copied());
    }
}
