//! From a material and a point of its surface to the lobe there.

mod bind;
mod fold;
mod metal;
mod rough;

use specula_bsdf::bsdf::Lobe;
use specula_bsdf::multibounce::MisPdf;
use specula_bsdf::vndf;
use specula_scene::Energy;
use specula_scene::scene::{FloatParam, MaterialKind, Relief, ReliefRules, Scene};

use crate::options::RenderOptions;
use crate::texture::{Place, Textures};

/// All materials of a scene.
#[derive(Clone, Debug)]
pub(crate) struct Materials {
    materials: Vec<Material>,
}

/// A material, ready for hits.
#[derive(Clone, Debug)]
pub(crate) struct Material {
    kind: MaterialKind,
    models: Models,
    /// Lobes seen from the inside and from the outside, where no texture is involved.
    constant: Option<[Lobe<f32>; 2]>,
    one_sided: bool,
    /// Whether its layers let nothing through.
    opaque_layers: bool,
    /// What bends its normal, unless it bends nothing.
    pub(crate) relief: Option<Relief>,
    /// By whose rules it bends.
    pub(crate) relief_rules: ReliefRules,
    /// Angle of the lobes' x axis from dp/du towards dp/dv.
    pub(crate) rotation_rad: f32,
}

/// A material at a hit, mixes resolved.
#[derive(Clone, Copy)]
pub(crate) struct Chosen<'a> {
    pub(crate) material: &'a Material,
    one_sided: bool,
}

/// How rough surfaces scatter and are drawn.
#[derive(Clone, Copy, Debug)]
struct Models {
    sampler: vndf::Sampler,
    energy: Energy,
    mis_pdf: MisPdf,
}

/// How deep mixes may be nested.
const MOST_MIXES: u32 = 16;

impl Materials {
    /// Prepares the scene's materials.
    ///
    /// * `options`: its treatment of energy is for materials that do not choose their own.
    pub(crate) fn new(scene: &Scene, textures: &Textures, options: &RenderOptions) -> Self {
        let prepare = |material: &specula_scene::scene::Material| {
            let models = Models {
                sampler: options.vndf_sampler,
                energy: material.energy.unwrap_or(options.energy),
                mis_pdf: options.mis_pdf,
            };
            let (kind, varies) = fold::folded(&material.kind, textures);
            let nowhere = Place::default();
            let is_mix = matches!(kind, MaterialKind::Mix { .. });
            Material {
                constant: (!varies && !is_mix).then(|| {
                    [false, true]
                        .map(|outside| bind::lobe(&kind, textures, &nowhere, outside, models))
                }),
                rotation_rad: bind::rotation_rad(&kind),
                opaque_layers: bind::is_opaque(&kind),
                kind,
                models,
                one_sided: material.one_sided,
                relief_rules: material.relief_rules,
                relief: material.relief.filter(|relief| match relief {
                    // A surface moved along its normals by the same distance keeps them.
                    Relief::Height(h) => {
                        matches!(textures.fold_float(*h), FloatParam::Texture(_))
                    }
                    Relief::Normal { .. } => true,
                }),
            }
        };
        Self {
            materials: scene.materials.iter().map(prepare).collect(),
        }
    }

    /// The material at a place, one of the parts where it is a mix.
    ///
    /// * `random`: for every mix on the way, a number in `[0, 1)`.
    #[inline]
    pub(crate) fn at(
        &self,
        material: u32,
        textures: &Textures,
        place: &Place,
        random: impl Fn(u32) -> f32,
    ) -> Chosen<'_> {
        let mut material = &self.materials[material as usize];
        let mut one_sided = material.one_sided;
        for level in 0..MOST_MIXES {
            let MaterialKind::Mix { materials, amount } = material.kind else {
                break;
            };
            let second = random(level) < textures.float(amount, place);
            material = &self.materials[materials[usize::from(second)].0];
            one_sided |= material.one_sided;
        }
        Chosen {
            material,
            one_sided,
        }
    }
}

impl Chosen<'_> {
    /// The lobe as seen from one side.
    #[inline]
    pub(crate) fn lobe(&self, textures: &Textures, place: &Place, outside: bool) -> Lobe<f32> {
        if self.one_sided && !outside {
            return bind::black();
        }
        let m = self.material;
        match &m.constant {
            Some(lobes) => lobes[usize::from(outside)],
            None => bind::lobe(&m.kind, textures, place, outside, m.models),
        }
    }

    /// Whether nothing comes through the lobe: it is black where `wi.z <= 0`.
    #[inline]
    pub(crate) fn is_opaque(&self, lobe: &Lobe<f32>) -> bool {
        match lobe {
            Lobe::Lambert(_)
            | Lobe::Eon(_)
            | Lobe::SmoothConductor(_)
            | Lobe::RoughConductor(_)
            | Lobe::CoatedDiffuse(_)
            | Lobe::CoatedConductor(_)
            | Lobe::Compensated(_)
            | Lobe::MultibounceConductor(_)
            | Lobe::Black(_)
            | Lobe::RoughConductorBeckmann(_)
            | Lobe::CompensatedBeckmann(_)
            | Lobe::MultibounceConductorBeckmann(_)
            | Lobe::Plastic(_)
            | Lobe::PlasticBeckmann(_) => true,
            Lobe::Principled(_) | Lobe::Gltf(_) => self.material.opaque_layers,
            _ => false,
        }
    }
}
