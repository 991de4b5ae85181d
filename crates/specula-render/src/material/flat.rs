//! Materials for shaders.
//!
//! A record is its head, how many parameters may have a texture, these, then the kind's other words.

use specula_bsdf::Rgb;
use specula_bsdf::ndf::Masking;
use specula_scene::Energy;
use specula_scene::scene::{
    BumpRules, CoatMedium, ColourParam, ConductorFresnel, FloatParam, GltfMaterial, MaterialKind,
    MicrofacetDistribution, PrincipledMaterial, Roughness, RoughnessMapping,
};

use super::{Material, Materials};
use crate::bump;
use crate::convert::id;
use crate::flat::{Flattening, LobeKind, Words};
use crate::texture::colour_parameter;

impl Materials {
    /// Records, then a table of their places.
    pub(crate) fn flatten(&self, to: &mut Flattening) {
        let mut places = Vec::with_capacity(self.materials.len());
        for material in &self.materials {
            places.push(to.words.place());
            material.flatten(to);
        }
        to.words.begin("MATERIALS");
        to.words.ids(places);
        to.words.begin("BEHIND_ROUGH");
        to.words.ids(self.behind_rough.iter().copied());
        to.words
            .constant("REGULARIZES", u32::from(self.are_regularized()));
        to.words.begin("BUMPS");
        for material in &self.materials {
            material.flatten_bumps(&mut to.words);
        }
        to.words.begin("BOUNDARIES");
        for material in &self.materials {
            material.flatten_boundary(&mut to.words);
        }
        to.words
            .constant("HAS_BOUNDARIES", u32::from(self.has_boundaries));
        let turns = |m: &Material| m.turn.is_some_and(|t| t.direction.is_some());
        to.words.constant(
            "HAS_DIRECTIONS",
            u32::from(self.materials.iter().any(turns)),
        );
        let bent = self.materials.iter().filter(|m| m.is_bent()).count();
        to.words.constant("BUMP_COUNT", id(bent));
        // A render has one sampler and one density for simulated bounces.
        let models = self.materials.first().map(|m| m.models);
        to.words
            .constant("SAMPLER", models.map_or(0, |m| m.sampler as u32));
        to.words
            .constant("BOUNCES_PDF", models.map_or(0, |m| m.mis_pdf as u32));
    }
}

impl Material {
    /// The head: kind, whether it has one side, whether layers let nothing through, rotation, whether
    /// tangents do not matter, model of energy, texture of directions.
    fn flatten(&self, to: &mut Flattening) {
        let rotation_rad = self.turn.map_or(0.0, |t| t.rotation_rad);
        let direction = self.turn.and_then(|t| t.direction);
        let kind = self.lobe_kind();
        to.uses(kind);
        let words = &mut to.words;
        words.ids([kind as u32, u32::from(self.one_sided)]);
        words.flag(self.opaque_layers);
        words.number(rotation_rad);
        words.flag(self.is_plain_and_isotropic());
        words.id(energy_code(self.models.energy));
        words.id(direction.map_or(u32::MAX, |texture| id(texture.0)));
        self.parameters().flatten(words);
    }

    /// 7 words: whether it bounds what absorbs (1), and whether what is around it is known (2); then what
    /// absorbs inside, and around.
    fn flatten_boundary(&self, to: &mut Words) {
        let known = self
            .boundary
            .map_or(0, |b| 1 + u32::from(b.around.is_some()));
        let colour = |c: Option<Rgb<f32>>| c.unwrap_or(Rgb::BLACK);
        to.id(known);
        to.colour(colour(self.boundary.map(|b| b.inside)));
        to.colour(colour(self.boundary.and_then(|b| b.around)));
    }

    /// 9 words: the bump map, whether the clear coat is bent otherwise, its bump.
    fn flatten_bumps(&self, to: &mut Words) {
        bump::flatten(self.bump.as_ref(), self.bump_rules, to);
        to.flag(self.coat.is_some());
        let coat = self.coat.and_then(|c| c.0);
        bump::flatten(coat.as_ref(), BumpRules::Plain, to);
    }

    fn is_bent(&self) -> bool {
        self.bump.is_some() || self.coat.is_some()
    }

    fn lobe_kind(&self) -> LobeKind {
        use LobeKind as K;
        let energy = |[none, compensated, simulated]: [K; 3]| match self.models.energy {
            Energy::None => none,
            Energy::Compensated(_) => compensated,
            Energy::Multibounce(_) => simulated,
        };
        match &self.kind {
            MaterialKind::Diffuse { .. } => K::Diffuse,
            MaterialKind::DiffuseTransmission { .. } => K::DiffuseTransmission,
            MaterialKind::Conductor { .. } => energy([
                K::Conductor,
                K::CompensatedConductor,
                K::MultibounceConductor,
            ]),
            MaterialKind::Dielectric { .. } => energy([
                K::Dielectric,
                K::CompensatedDielectric,
                K::MultibounceDielectric,
            ]),
            MaterialKind::ThinDielectric { .. } => K::ThinDielectric,
            MaterialKind::CoatedDiffuse { medium, .. } if !medium.scatters() => K::CoatedDiffuse,
            MaterialKind::CoatedDiffuse { .. } | MaterialKind::CoatedConductor { .. } => K::Layered,
            MaterialKind::Plastic { .. } => K::Plastic,
            MaterialKind::Principled(_) => K::Principled,
            MaterialKind::Gltf(_) => K::Gltf,
            MaterialKind::Mix { .. } => K::Mix,
            MaterialKind::Interface => K::Interface,
        }
    }

    /// What the kind has.
    fn parameters(&self) -> Parameters {
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
            MaterialKind::Mix { materials, amount } => {
                let [first, second] = materials.map(|m| id(m.0));
                to.floats([amount]).id(first).id(second)
            }
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
            MaterialKind::Interface => &mut to,
        };
        to
    }
}

/// Parameters of a material: those that may have a texture, which shaders look up in one loop, and the
/// words behind them.
#[derive(Default)]
struct Parameters {
    textured: Vec<ColourParam>,
    plain: Vec<u32>,
    /// Whether alphas are made larger, as behind a rough surface.
    regularized: bool,
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

    fn id(&mut self, word: u32) -> &mut Self {
        self.plain.push(word);
        self
    }

    fn flag(&mut self, flag: bool) -> &mut Self {
        self.id(u32::from(flag))
    }

    fn number(&mut self, x: f32) -> &mut Self {
        self.id(x.to_bits())
    }

    /// Two alphas; what they are (4 more where they are made larger), distribution, masking.
    fn roughness(&mut self, roughness: &Roughness) -> &mut Self {
        let mapping = match roughness.mapping {
            RoughnessMapping::Alpha => 0,
            RoughnessMapping::Sqrt => 1,
            RoughnessMapping::Square => 2,
        };
        let larger = 4 * u32::from(self.regularized);
        self.floats([roughness.u, roughness.v])
            .id(mapping + larger)
            .id(match roughness.distribution {
                MicrofacetDistribution::Ggx => 0,
                MicrofacetDistribution::Beckmann => 1,
            })
            .id(match roughness.masking {
                Masking::HeightCorrelated => 0,
                Masking::Separable => 1,
            })
    }

    /// Two colours; what they are.
    fn fresnel(&mut self, fresnel: &ConductorFresnel) -> &mut Self {
        let none = ColourParam::Value(Rgb::WHITE);
        let (kind, colours) = match *fresnel {
            ConductorFresnel::Index { eta, k } => (0, [eta, k]),
            ConductorFresnel::Reflectance(colour) => (1, [colour, none]),
            ConductorFresnel::Schlick(colour) => (2, [colour, none]),
            ConductorFresnel::Mirror => (3, [none; 2]),
        };
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
            .id(u32::from(g.volume) | u32::from(compensated) << 1)
            .flag(regularized)
    }

    fn flatten(&self, to: &mut Words) {
        to.id(id(self.textured.len()));
        for &colour in &self.textured {
            colour_parameter(to, colour);
        }
        to.ids(self.plain.iter().copied());
    }
}

/// The number of a kind's model, as the shader library counts them.
fn energy_code(energy: Energy) -> u32 {
    use specula_bsdf::energy::{EnergyModel, FmsVariant};
    use specula_bsdf::multibounce::MultibounceModel;
    match energy {
        Energy::None | Energy::Compensated(EnergyModel::Turquin(FmsVariant::NormalIncidence)) => 0,
        Energy::Compensated(EnergyModel::Turquin(FmsVariant::AverageSeries)) => 1,
        Energy::Compensated(EnergyModel::KullaConty) => 2,
        Energy::Multibounce(model) => match model {
            MultibounceModel::Heitz2016 => 0,
            MultibounceModel::BitterliDeon2022 => 1,
            MultibounceModel::Wang2022 { correlated: true } => 2,
            MultibounceModel::Wang2022 { correlated: false } => 3,
            MultibounceModel::Cui2023 {
                bidirectional: false,
            } => 4,
            MultibounceModel::Cui2023 {
                bidirectional: true,
            } => 5,
            _ => 6,
        },
    }
}
