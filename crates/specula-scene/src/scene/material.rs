//! Surfaces.

use specula_bsdf::ndf::Masking;
use specula_bsdf::{Alpha, Rgb};

use super::coat::CoatMedium;
use super::texture::{ColourParam, FloatParam};
use super::{MaterialId, MeasuredId, TextureId};
use crate::energy::Energy;

/// A material with its name, if it has one.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// The file's name for it.
    pub name: Option<String>,
    /// What it is.
    pub kind: MaterialKind,
    /// Treatment of multiple scattering, where the file chooses one; else the render's.
    pub energy: Option<Energy>,
    /// Its bump or normal map.
    pub bump: Option<Bump>,
    /// Which renderer's rules its bump map follows.
    pub bump_rules: BumpRules,
    /// Whether its back is black (Mitsuba's opaque materials without `twosided`).
    pub one_sided: bool,
    /// Absorption within the closed shapes that it bounds, per scene unit: light that entered
    /// through it loses `1 - exp(-absorption distance)` on its way. Black for none.
    pub absorption: Rgb<f32>,
    /// Absorption around them, where the file says it; else that of what light was in before it
    /// entered them.
    pub around: Option<Rgb<f32>>,
}

impl Material {
    /// A two-sided material without name, bump map and absorption.
    #[must_use]
    pub fn new(kind: MaterialKind) -> Self {
        Self {
            name: None,
            kind,
            energy: None,
            bump: None,
            bump_rules: BumpRules::Plain,
            one_sided: false,
            absorption: Rgb::BLACK,
            around: None,
        }
    }

    /// Whether it is hair, or a mix with hair in it.
    ///
    /// * `all`: the scene's materials.
    #[must_use]
    pub fn holds_hair(&self, all: &[Self]) -> bool {
        match &self.kind {
            MaterialKind::Hair(_) => true,
            MaterialKind::Mix { materials, .. } | MaterialKind::Sided(materials) => {
                let parts = materials.iter().filter_map(|m| all.get(m.0));
                parts.into_iter().any(|part| part.holds_hair(all))
            }
            _ => false,
        }
    }

    /// Whether light that passes it may enter or leave an absorbing medium.
    #[must_use]
    pub fn bounds_absorption(&self) -> bool {
        self.around.is_some() || !self.absorption.is_black()
    }
}

/// A bump or normal map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bump {
    /// Heights along the normal, in scene units.
    Height(FloatParam),
    /// Normals `2 c - 1` in the frame of dp/du, dp/dv and the shading normal; x and y are scaled
    /// first. The texture's picture must be read without a transfer curve.
    Normal {
        /// The texture of `c`.
        map: TextureId,
        /// Factor on x and y (glTF's `scale`).
        scale: f32,
    },
}

/// Whose rules a bump map follows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BumpRules {
    /// As [`Bump`] says, and nothing more.
    #[default]
    Plain,
    /// Mitsuba's: the y axis of a normal map is that of the shading normal times dp/du, whichever
    /// way v runs, and bent normals that face away from the viewer are turned back.
    Mitsuba {
        /// Whether light fades towards the horizon (Conty Estevez et al. 2019): with `n` the bent
        /// normal and `wi` in the frame of the unbent one, values are multiplied by
        /// `2 / (1 + sqrt(1 + min(tan^2(n) / 8, 1) tan^2(wi)))`.
        fades: bool,
    },
}

/// How a file's roughness becomes alpha.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RoughnessMapping {
    /// alpha = roughness.
    Alpha,
    /// alpha = sqrt(roughness): pbrt's `remaproughness`.
    Sqrt,
    /// alpha = roughness^2: glTF, OpenPBR.
    Square,
}

impl RoughnessMapping {
    /// A warning about a roughness that makes alpha larger than what is rendered, and the
    /// roughness of the largest; `None` of others.
    pub(crate) fn too_wide(self, name: &str, roughness: f32) -> Option<(String, f32)> {
        let widest = Alpha::<f64>::MAX;
        let most = crate::num::f32_of(match self {
            Self::Alpha => widest,
            Self::Sqrt => widest * widest,
            Self::Square => widest.sqrt(),
        });
        (roughness > most).then(|| {
            let message = format!(
                "\"{name}\": {roughness} is beyond the widest distribution, alpha {widest}: \
                 {most} is used"
            );
            (message, most)
        })
    }
}

/// A distribution of microfacet normals.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MicrofacetDistribution {
    /// Trowbridge and Reitz.
    #[default]
    Ggx,
    /// Beckmann and Spizzichino.
    Beckmann,
}

/// Roughness along the two tangents.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Roughness {
    /// Along dp/du.
    pub u: FloatParam,
    /// Along the other tangent.
    pub v: FloatParam,
    /// How it becomes alpha.
    pub mapping: RoughnessMapping,
    /// The distribution of microfacet normals.
    pub distribution: MicrofacetDistribution,
    /// How masking and shadowing are combined.
    pub masking: Masking,
    /// Angle of the axis of `u` from dp/du towards the other tangent, in radians.
    pub rotation_rad: f32,
}

impl Roughness {
    /// The same roughness along both tangents, of GGX with height-correlated masking.
    #[must_use]
    pub fn isotropic(width: FloatParam, mapping: RoughnessMapping) -> Self {
        Self {
            u: width,
            v: width,
            mapping,
            distribution: MicrofacetDistribution::Ggx,
            masking: Masking::HeightCorrelated,
            rotation_rad: 0.0,
        }
    }

    /// A smooth surface.
    #[must_use]
    pub fn smooth() -> Self {
        Self::isotropic(FloatParam::Value(0.0), RoughnessMapping::Alpha)
    }
}

/// A conductor's reflectance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ConductorFresnel {
    /// Complex index of refraction `eta + i k` relative to vacuum.
    Index {
        /// Real part.
        eta: ColourParam,
        /// Imaginary part.
        k: ColourParam,
    },
    /// Reflectance at normal incidence, by pbrt's rule: eta = 1 and k from it.
    Reflectance(ColourParam),
    /// Schlick's approximation from the reflectance at normal incidence to 1 (glTF).
    Schlick(ColourParam),
    /// Everything is reflected (Mitsuba's `material` `none`).
    Mirror,
}

/// The kinds of materials.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MaterialKind {
    /// Lambert, or energy-preserving Oren-Nayar where roughness is not 0.
    Diffuse {
        /// Albedo.
        reflectance: ColourParam,
        /// Oren-Nayar roughness in `[0, 1]`.
        roughness: FloatParam,
    },
    /// Lambert on both sides.
    DiffuseTransmission {
        /// Albedo of the reflected part.
        reflectance: ColourParam,
        /// Albedo of the transmitted part.
        transmittance: ColourParam,
    },
    /// Metal.
    Conductor {
        /// Its Fresnel term.
        fresnel: ConductorFresnel,
        /// Its roughness.
        roughness: Roughness,
        /// Factor on what it reflects; 1 in nature.
        tint: ColourParam,
    },
    /// Glass.
    Dielectric {
        /// Index of refraction, inside over outside.
        eta: f32,
        /// Its roughness.
        roughness: Roughness,
        /// Factor on what is reflected; 1 in nature.
        reflection_tint: ColourParam,
        /// Factor on what passes; 1 in nature.
        transmission_tint: ColourParam,
    },
    /// A thin pane: both interfaces in one surface, no refraction.
    ThinDielectric {
        /// Index of refraction of the pane.
        eta: f32,
        /// Factor on what is reflected; 1 in nature.
        reflection_tint: ColourParam,
        /// Factor on what passes; 1 in nature.
        transmission_tint: ColourParam,
    },
    /// A dielectric coat over Lambert.
    CoatedDiffuse {
        /// Albedo of the base.
        reflectance: ColourParam,
        /// Index of refraction of the coat.
        eta: f32,
        /// Roughness of the coat.
        roughness: Roughness,
        /// What lies between the two.
        medium: CoatMedium,
        /// Whether the coat loses no light that its facets scatter more than once, whatever the
        /// treatment of energy; else it does under any treatment but none.
        lossless: bool,
    },
    /// A dielectric coat over metal.
    CoatedConductor {
        /// Index of refraction of the coat.
        coat_eta: f32,
        /// Roughness of the coat.
        coat_roughness: Roughness,
        /// The metal.
        fresnel: ConductorFresnel,
        /// Roughness of the metal.
        roughness: Roughness,
        /// What lies between the two.
        medium: CoatMedium,
    },
    /// Mitsuba's `plastic` and `roughplastic`: a dielectric coat over Lambert, by their formulas.
    Plastic {
        /// Albedo of the base.
        diffuse: ColourParam,
        /// Factor on the coat's reflection.
        specular: ColourParam,
        /// Index of refraction of the coat.
        eta: f32,
        /// Roughness of the coat.
        roughness: Roughness,
        /// Whether light between coat and base takes the base's colour at every bounce.
        nonlinear: bool,
    },
    /// Mitsuba's `principled` and `principledthin` (Burley 2012 and 2015), by their formulas.
    Principled(PrincipledMaterial),
    /// glTF's metallic-roughness material with its extensions.
    Gltf(GltfMaterial),
    /// A reflection that was measured. Its x axis is dp/du.
    Measured(MeasuredId),
    /// Hair or fur: of a whole fibre along dp/du (Chiang et al. 2016).
    Hair(HairMaterial),
    /// One of two materials, chosen at random at every hit.
    Mix {
        /// Chosen with probability 1 - amount, and with probability amount.
        materials: [MaterialId; 2],
        /// Share of the second.
        amount: FloatParam,
    },
    /// One material outside, and another inside: both opaque, and each seen as from its own outside.
    Sided([MaterialId; 2]),
    /// An interface between media: rays pass straight through.
    Interface,
}

/// Parameters of Mitsuba's `principled` and `principledthin`, as they name them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrincipledMaterial {
    /// `base_color`.
    pub base_colour: ColourParam,
    /// `roughness`; alpha is its square.
    pub roughness: FloatParam,
    /// `anisotropic`.
    pub anisotropic: FloatParam,
    /// `metallic`; 0 where thin.
    pub metallic: FloatParam,
    /// `spec_trans`.
    pub spec_trans: FloatParam,
    /// `eta`, or what `specular` says.
    pub eta: f32,
    /// `spec_tint`.
    pub spec_tint: FloatParam,
    /// `sheen`.
    pub sheen: FloatParam,
    /// `sheen_tint`.
    pub sheen_tint: FloatParam,
    /// `clearcoat`; 0 where thin.
    pub clearcoat: FloatParam,
    /// `clearcoat_gloss`.
    pub clearcoat_gloss: FloatParam,
    /// `flatness`.
    pub flatness: FloatParam,
    /// `diff_trans`, where thin: a share in `[0, 2]`.
    pub diff_trans: FloatParam,
    /// Whether it is `principledthin`.
    pub thin: bool,
}

/// glTF 2.0's metallic-roughness material and its `KHR_materials_*` extensions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GltfMaterial {
    /// `baseColorFactor` times `baseColorTexture`.
    pub base_colour: ColourParam,
    /// `metallicFactor` times the blue channel.
    pub metallic: FloatParam,
    /// `roughnessFactor` times the green channel; alpha is its square.
    pub roughness: FloatParam,
    /// `anisotropyStrength`.
    pub anisotropy: FloatParam,
    /// `anisotropyRotation`, in radians.
    pub anisotropy_rotation_rad: f32,
    /// `anisotropyTexture`: the direction before it is rotated is `2 c - 1` of its red and green.
    pub anisotropy_direction: Option<TextureId>,
    /// `ior`.
    pub ior: f32,
    /// `specularFactor`.
    pub specular: FloatParam,
    /// `specularColorFactor`.
    pub specular_colour: ColourParam,
    /// `transmissionFactor`.
    pub transmission: FloatParam,
    /// Whether it has a `thicknessFactor` above 0 (`KHR_materials_volume`): light bends.
    pub volume: bool,
    /// `clearcoatFactor`.
    pub clearcoat: FloatParam,
    /// `clearcoatRoughnessFactor`.
    pub clearcoat_roughness: FloatParam,
    /// `clearcoatNormalTexture`: what bends the coat; the material's own bump map does not.
    pub clearcoat_bump: Option<Bump>,
    /// `sheenColorFactor`.
    pub sheen_colour: ColourParam,
    /// `sheenRoughnessFactor`.
    pub sheen_roughness: FloatParam,
}

/// Hair and fur, by pbrt-v4's parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HairMaterial {
    /// What it takes from light.
    pub pigment: HairPigment,
    /// Index of refraction.
    pub eta: FloatParam,
    /// Longitudinal roughness in `[0, 1]`.
    pub beta_m: FloatParam,
    /// Azimuthal roughness in `[0, 1]`.
    pub beta_n: FloatParam,
    /// Tilt of the scales, in degrees.
    pub alpha_deg: FloatParam,
}

/// What a fibre of hair takes from light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum HairPigment {
    /// Absorption per radius of the fibre.
    Absorption(ColourParam),
    /// The colour that many fibres have together.
    Reflectance(ColourParam),
    /// Concentrations of the two pigments of hair.
    Melanin {
        /// Brown to black.
        eumelanin: FloatParam,
        /// Red.
        pheomelanin: FloatParam,
    },
}
