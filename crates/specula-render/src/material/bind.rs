//! Every kind of material as a lobe.

use specula_bsdf::bsdf::{
    Base, Black, CoatLayer, CoatScattering, DiffuseCoat, DiffuseTransmission, Eon, Gltf,
    GltfParameters, Lambert, Layered, Lobe, Medium, Plastic, Principled, PrincipledParameters,
    RoughDielectric, SmoothConductor, SmoothDielectric, ThinDielectric, Tints,
};
use specula_bsdf::fresnel::Reflectance;
use specula_bsdf::ndf::{Beckmann, Ggx};
use specula_bsdf::{Alpha, Rgb};
use specula_scene::scene::{
    CoatMedium, ColourParam, ConductorFresnel, FloatParam, MaterialKind, MicrofacetDistribution,
    Roughness,
};
use specula_scene::{Energy, scene};

use super::Models;
use super::metal::{alpha, reflectance, regularized_alpha};
use super::rough::{conductor, dielectric};
use crate::slopes::Widening;
use crate::texture::{TextureCoordinates, Textures};

/// What takes all light and gives none.
pub(super) fn black() -> Lobe<f32> {
    Black.into()
}

/// Angle of a material's first alpha from dp/du.
pub(super) fn rotation_rad(kind: &MaterialKind) -> f32 {
    match kind {
        MaterialKind::Conductor { roughness, .. }
        | MaterialKind::Dielectric { roughness, .. }
        | MaterialKind::CoatedDiffuse { roughness, .. }
        | MaterialKind::Plastic { roughness, .. } => roughness.rotation_rad,
        // One frame for both: the coat's, unless only the metal has a direction.
        MaterialKind::CoatedConductor {
            coat_roughness,
            roughness,
            ..
        } if coat_roughness.u == coat_roughness.v => roughness.rotation_rad,
        MaterialKind::CoatedConductor { coat_roughness, .. } => coat_roughness.rotation_rad,
        MaterialKind::Gltf(g) => g.anisotropy_rotation_rad,
        _ => 0.0,
    }
}

/// Whether a material of several layers lets nothing through, whatever its textures say.
pub(super) fn is_opaque(kind: &MaterialKind) -> bool {
    const NONE: FloatParam = FloatParam::Value(0.0);
    match kind {
        MaterialKind::Principled(p) => !p.thin && p.spec_trans == NONE,
        MaterialKind::Gltf(g) => g.transmission == NONE,
        _ => false,
    }
}

/// Whether the lobe's x axis is known not to matter.
pub(super) fn is_isotropic(kind: &MaterialKind) -> bool {
    match kind {
        MaterialKind::Diffuse { .. } => true,
        MaterialKind::Conductor { roughness, .. }
        | MaterialKind::CoatedDiffuse { roughness, .. }
        | MaterialKind::Plastic { roughness, .. }
        | MaterialKind::Dielectric { roughness, .. } => roughness.u == roughness.v,
        _ => false,
    }
}

/// A colour in `[0, 1]`.
pub(super) fn albedo(
    textures: &Textures,
    parameter: ColourParam,
    place: &TextureCoordinates,
) -> Rgb<f32> {
    let colour = textures.colour(parameter, place);
    colour.map(|v| v.clamp(0.0, 1.0))
}

/// The lobe of a material that is no mix.
///
/// * `outside`: whether it is seen from the outside of its shape.
/// * `widening`: how alphas grow.
pub(super) fn lobe(
    kind: &MaterialKind,
    textures: &Textures,
    place: &TextureCoordinates,
    outside: bool,
    models: Models,
    widening: Option<&Widening>,
) -> Lobe<f32> {
    let at = PointParameters::new(textures, place, models, widening);
    match *kind {
        MaterialKind::Diffuse {
            reflectance,
            roughness,
        } => match at.unit(roughness) {
            r if r > 0.0 => Eon::new(at.albedo(reflectance), r).into(),
            _ => Lambert::new(at.albedo(reflectance)).into(),
        },
        MaterialKind::DiffuseTransmission {
            reflectance,
            transmittance,
        } => {
            // Not scaled to a sum of 1: as pbrt-v4, which lets a sheet send out twice what arrives.
            DiffuseTransmission::new(at.albedo(reflectance), at.albedo(transmittance)).into()
        }
        MaterialKind::Conductor {
            ref fresnel,
            ref roughness,
            tint,
        } => {
            let metal = reflectance(fresnel, textures, place).tinted(at.albedo(tint));
            at.conductor(roughness, metal, models)
        }
        MaterialKind::Dielectric {
            eta,
            ref roughness,
            reflection_tint,
            transmission_tint,
        } => {
            let relative = if outside { eta } else { 1.0 / eta };
            let tints = at.tints(reflection_tint, transmission_tint);
            at.glass(relative, roughness, tints, models)
        }
        MaterialKind::ThinDielectric {
            eta,
            reflection_tint,
            transmission_tint,
        } => ThinDielectric::new(eta)
            .with_tints(at.tints(reflection_tint, transmission_tint))
            .into(),
        MaterialKind::CoatedDiffuse {
            reflectance,
            eta,
            ref roughness,
            ref medium,
            lossless,
        } => {
            let albedo = at.albedo(reflectance);
            at.coated_diffuse(albedo, eta, roughness, (medium, lossless), models)
        }
        MaterialKind::CoatedConductor {
            coat_eta,
            ref coat_roughness,
            ref fresnel,
            ref roughness,
            ref medium,
        } => {
            let metal = reflectance(fresnel, textures, place);
            let base = Base::metal(at.ggx(roughness), metal);
            at.layered(coat_roughness, coat_eta, base, medium, models)
        }
        // It has one side: its back is black, as Mitsuba's.
        MaterialKind::Plastic { .. } if !outside => black(),
        MaterialKind::Plastic {
            diffuse,
            specular,
            eta,
            ref roughness,
            nonlinear,
        } => {
            let colours = [diffuse, specular].map(|c| at.albedo(c));
            at.plastic(colours, eta, roughness, nonlinear, models)
        }
        MaterialKind::Principled(ref p) => Principled::new(at.principled(p, outside)).into(),
        MaterialKind::Gltf(ref g) => Gltf::new(at.gltf(g, outside, models)).into(),
        // Shapes without a surface are dropped before; mixes nested too deeply are black.
        // Measured ones and hair are no lobes of the list.
        MaterialKind::Mix { .. } | MaterialKind::Sided(_) => black(),
        MaterialKind::Interface | MaterialKind::Measured(_) | MaterialKind::Hair(_) => black(),
    }
}

/// Whether lobes of a material differ in their alphas alone, from point to point and by normal maps, where they are rough:
/// metals and glass of one colour.
pub(super) fn differs_in_alphas(kind: &MaterialKind) -> bool {
    let is_value = |colour: &ColourParam| matches!(colour, ColourParam::Value(_));
    match kind {
        MaterialKind::Conductor { fresnel, tint, .. } => {
            let is_one_metal = match fresnel {
                ConductorFresnel::Index { eta, k } => is_value(eta) && is_value(k),
                ConductorFresnel::Reflectance(c) | ConductorFresnel::Schlick(c) => is_value(c),
                ConductorFresnel::Mirror => true,
            };
            is_one_metal && is_value(tint)
        }
        MaterialKind::Dielectric {
            reflection_tint,
            transmission_tint,
            ..
        } => is_value(reflection_tint) && is_value(transmission_tint),
        _ => false,
    }
}

/// The alphas by which the frame of a material's lobes is chosen, along its axes; 0 where it is smooth or has none.
pub(super) fn alphas(
    kind: &MaterialKind,
    textures: &Textures,
    place: &TextureCoordinates,
    models: Models,
) -> [f32; 2] {
    let at = PointParameters::new(textures, place, models, None);
    match kind {
        MaterialKind::Conductor { roughness, .. }
        | MaterialKind::Dielectric { roughness, .. }
        | MaterialKind::CoatedDiffuse { roughness, .. }
        | MaterialKind::Plastic { roughness, .. } => at.alphas(roughness),
        // As in `rotation_rad`.
        MaterialKind::CoatedConductor {
            coat_roughness,
            roughness,
            ..
        } => match at.alphas(coat_roughness) {
            [x, y] if x == y => at.alphas(roughness),
            alphas => alphas,
        },
        MaterialKind::Principled(p) => {
            principled_alphas(at.roughness(p.roughness), at.unit(p.anisotropic))
        }
        MaterialKind::Gltf(g) => gltf_alphas(at.roughness(g.roughness), at.unit(g.anisotropy)),
        _ => [0.0; 2],
    }
}

/// Alphas of glTF's base layer; the longer one is the first.
///
/// Source: `KHR_materials_anisotropy`.
fn gltf_alphas(roughness: f32, anisotropy: f32) -> [f32; 2] {
    let alpha = roughness * roughness;
    [alpha + (1.0 - alpha) * anisotropy * anisotropy, alpha]
}

/// The roughness and the anisotropy of glTF's base layer with these alphas, or the nearest that it has.
///
/// * `along`, `across`: the first is the longer one.
fn gltf_roughness([along, across]: [f32; 2]) -> [f32; 2] {
    let [along, across] = [along, across].map(|alpha| alpha.min(1.0));
    let anisotropy = ((along - across) / (1.0 - across).max(1e-6)).clamp(0.0, 1.0);
    [across, anisotropy].map(f32::sqrt)
}

/// Alphas of the principled materials' base; the longer one is the first.
///
/// Source: Burley 2012, section 5.4.
fn principled_alphas(roughness: f32, anisotropic: f32) -> [f32; 2] {
    let alpha = roughness * roughness;
    let aspect = (1.0 - 0.9 * anisotropic).sqrt();
    [alpha / aspect, alpha * aspect]
}

/// The roughness and the anisotropy of the principled materials' base with these alphas; where one is more than ten
/// times the other, the shorter one is raised.
///
/// * `along`, `across`: the first is the longer one.
fn principled_roughness([along, across]: [f32; 2]) -> [f32; 2] {
    let squared_aspect = (across / along.max(1e-9)).clamp(0.1, 1.0);
    let alpha = (along * squared_aspect.sqrt()).min(1.0);
    [alpha.sqrt(), (1.0 - squared_aspect) / 0.9]
}

/// The gloss of the principled materials' clear coat with an alpha, or the nearest that it has.
///
/// Source: Burley 2012, section 5.6.
fn coat_gloss(alpha: f32) -> f32 {
    ((0.1 - alpha) / (0.1 - 0.001)).clamp(0.0, 1.0)
}

/// Parameters at a point.
#[derive(Clone, Copy)]
pub(super) struct PointParameters<'a> {
    textures: &'a Textures,
    place: &'a TextureCoordinates,
    /// Whether it is behind a rough surface that makes it rougher.
    regularized: bool,
    /// How alphas grow by what a normal map's filter averages.
    widening: Option<&'a Widening>,
}

impl<'a> PointParameters<'a> {
    pub(super) fn new(
        textures: &'a Textures,
        place: &'a TextureCoordinates,
        models: Models,
        widening: Option<&'a Widening>,
    ) -> Self {
        Self {
            textures,
            place,
            regularized: models.regularized,
            widening,
        }
    }

    fn conductor(
        &self,
        roughness: &Roughness,
        metal: Reflectance<f32>,
        models: Models,
    ) -> Lobe<f32> {
        match self.alpha(roughness) {
            Some(alpha) => conductor(roughness, alpha, metal, models),
            None => SmoothConductor::new(metal).into(),
        }
    }

    fn alpha(&self, roughness: &Roughness) -> Option<Alpha<f32>> {
        let alpha = alpha(roughness, self.textures, self.place, self.regularized);
        match self.widening {
            Some(widening) => widening.of_rough(alpha),
            None => alpha,
        }
    }

    /// The same; 0 where the surface is smooth.
    fn alphas(&self, roughness: &Roughness) -> [f32; 2] {
        (self.alpha(roughness)).map_or([0.0; 2], |alpha| [alpha.x, alpha.y])
    }

    /// A roughness in `[0, 1]` whose square is alpha.
    fn roughness(&self, parameter: FloatParam) -> f32 {
        let roughness = self.unit(parameter);
        match self.regularized && roughness * roughness < 0.3 {
            true => regularized_alpha(roughness * roughness).sqrt(),
            false => roughness,
        }
    }

    fn unit(&self, parameter: FloatParam) -> f32 {
        self.textures.float(parameter, self.place).clamp(0.0, 1.0)
    }

    pub(super) fn albedo(&self, parameter: ColourParam) -> Rgb<f32> {
        albedo(self.textures, parameter, self.place)
    }

    fn tints(&self, reflection: ColourParam, transmission: ColourParam) -> Tints<f32> {
        Tints {
            reflection: self.albedo(reflection),
            transmission: self.albedo(transmission),
        }
    }

    /// Coats know GGX only, with height-correlated masking: Beckmann's alphas are taken for its.
    fn ggx(&self, roughness: &Roughness) -> Option<Ggx<f32>> {
        self.alpha(roughness).map(Ggx::new)
    }

    /// Lambert under a coat, in closed form where nothing scatters between them.
    fn coated_diffuse(
        &self,
        albedo: Rgb<f32>,
        eta: f32,
        roughness: &Roughness,
        (medium, lossless): (&CoatMedium, bool),
        models: Models,
    ) -> Lobe<f32> {
        if medium.scatters() {
            return self.layered(roughness, eta, Base::diffuse(albedo), medium, models);
        }
        self.diffuse_coat(eta, roughness, (medium, lossless), models)
            .over(albedo)
            .into()
    }

    /// A coat without a medium that scatters.
    pub(super) fn diffuse_coat(
        &self,
        eta: f32,
        roughness: &Roughness,
        (medium, lossless): (&CoatMedium, bool),
        models: Models,
    ) -> DiffuseCoat<f32> {
        let layer = self.coat_layer(medium, lossless, models);
        DiffuseCoat::new(self.ggx(roughness), eta, layer).with_sampler(models.sampler)
    }

    /// The layer between a coat and the Lambertian base below it.
    fn coat_layer(&self, medium: &CoatMedium, lossless: bool, models: Models) -> CoatLayer<f32> {
        CoatLayer {
            thickness: self.textures.float(medium.thickness, self.place),
            max_depth: medium.max_depth,
            scattering: match models.energy {
                Energy::None if !lossless => CoatScattering::Single,
                _ => CoatScattering::Lossless,
            },
        }
    }

    /// A coat with what is under it. Its surfaces scatter singly, whatever the treatment of energy,
    /// as pbrt-v4's.
    fn layered(
        &self,
        coat: &Roughness,
        eta: f32,
        base: Base<f32>,
        medium: &CoatMedium,
        models: Models,
    ) -> Lobe<f32> {
        let layered = Layered::new(self.ggx(coat), eta, base)
            .with_medium(Medium {
                thickness: self.textures.float(medium.thickness, self.place),
                albedo: self.albedo(medium.albedo),
                g: self.textures.float(medium.g, self.place),
            })
            .with_walks(medium.samples)
            .with_sampler(models.sampler);
        match medium.max_depth {
            Some(depth) => layered.with_max_depth(depth).into(),
            None => layered.into(),
        }
    }

    /// * `relative`: index beyond the surface over the index on the viewer's side.
    fn glass(
        &self,
        relative: f32,
        roughness: &Roughness,
        tints: Tints<f32>,
        models: Models,
    ) -> Lobe<f32> {
        match self.alpha(roughness) {
            // With equal indices nothing is bent, however rough.
            Some(alpha)
                if f64::from((relative - 1.0).abs()) >= RoughDielectric::<f32>::INDEX_MATCHED =>
            {
                dielectric(roughness, alpha, relative, tints, models)
            }
            _ => SmoothDielectric::facing(relative).with_tints(tints).into(),
        }
    }

    pub(super) fn plastic(
        &self,
        [diffuse, specular]: [Rgb<f32>; 2],
        eta: f32,
        roughness: &Roughness,
        nonlinear: bool,
        models: Models,
    ) -> Lobe<f32> {
        let masking = roughness.masking;
        let alpha = self.alpha(roughness);
        match (alpha, roughness.distribution) {
            (None, _) => Plastic::smooth(eta, diffuse, specular, nonlinear).into(),
            (Some(alpha), MicrofacetDistribution::Ggx) => {
                let ndf = Ggx::new(alpha);
                Plastic::rough(ndf, masking, eta, diffuse, specular, nonlinear)
                    .with_sampler(models.sampler)
                    .into()
            }
            (Some(alpha), MicrofacetDistribution::Beckmann) => {
                let ndf = Beckmann::new(alpha);
                Plastic::rough(ndf, masking, eta, diffuse, specular, nonlinear).into()
            }
        }
    }

    fn principled(
        &self,
        p: &scene::PrincipledMaterial,
        outside: bool,
    ) -> PrincipledParameters<f32> {
        let mut roughness = self.roughness(p.roughness);
        let mut anisotropic = self.unit(p.anisotropic);
        // Its alphas end at 0.1, that of gloss 0.
        let mut clearcoat_gloss = match self.regularized {
            true => 0.0,
            false => self.unit(p.clearcoat_gloss),
        };
        if let Some(widening) = self.widening {
            let alphas = widening.of(principled_alphas(roughness, anisotropic));
            [roughness, anisotropic] = principled_roughness(alphas);
            let coat = 0.1 + (0.001 - 0.1) * clearcoat_gloss;
            clearcoat_gloss = coat_gloss(widening.of_isotropic(coat));
        }
        PrincipledParameters {
            base_colour: self.albedo(p.base_colour),
            roughness,
            anisotropic,
            metallic: self.unit(p.metallic),
            spec_trans: self.unit(p.spec_trans),
            eta: p.eta,
            spec_tint: self.unit(p.spec_tint),
            sheen: self.unit(p.sheen),
            sheen_tint: self.unit(p.sheen_tint),
            clearcoat: self.unit(p.clearcoat),
            clearcoat_gloss,
            flatness: self.unit(p.flatness),
            diff_trans: self
                .textures
                .float(p.diff_trans, self.place)
                .clamp(0.0, 2.0),
            thin: p.thin,
            outside,
        }
    }

    fn gltf(&self, g: &scene::GltfMaterial, outside: bool, models: Models) -> GltfParameters<f32> {
        let mut roughness = self.roughness(g.roughness);
        let mut anisotropy = self.unit(g.anisotropy);
        let mut clearcoat_roughness = self.roughness(g.clearcoat_roughness);
        if let Some(widening) = self.widening {
            let alphas = widening.of(gltf_alphas(roughness, anisotropy));
            [roughness, anisotropy] = gltf_roughness(alphas);
            let coat = clearcoat_roughness * clearcoat_roughness;
            clearcoat_roughness = widening.of_own_coat(coat).sqrt().min(1.0);
        }
        GltfParameters {
            base_colour: self.albedo(g.base_colour),
            metallic: self.unit(g.metallic),
            roughness,
            anisotropy,
            ior: g.ior,
            specular: self.unit(g.specular),
            specular_colour: self
                .textures
                .colour(g.specular_colour, self.place)
                .map(|v| v.max(0.0)),
            transmission: self.unit(g.transmission),
            volume: g.volume,
            outside,
            clearcoat: self.unit(g.clearcoat),
            clearcoat_roughness,
            sheen_colour: self.albedo(g.sheen_colour),
            sheen_roughness: self.unit(g.sheen_roughness),
            compensated: models.energy != Energy::None,
        }
    }
}
