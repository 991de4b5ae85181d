//! From a material and a point of its surface to the lobe there.

mod bind;
mod coat;
mod flat;
mod hair;
pub(crate) mod lobes;
mod metal;
mod parameters;
mod point_lobe;
mod rough;
mod twins;

use std::sync::Arc;

pub(crate) use coat::{BaseCoat, ColouredBase};
use lobes::Sides;
pub use parameters::MaterialShader;
pub(crate) use point_lobe::PointLobe;
use specula_bsdf::bsdf::{Lambert, Lobe};
use specula_bsdf::measured::Measured;
use specula_bsdf::multibounce::MisPdf;
use specula_bsdf::vndf;
use specula_bsdf::{Bsdf, Rgb};
use specula_scene::Energy;
use specula_scene::scene::{
    Bump, BumpRules, ColourParam, FloatParam, MaterialKind, Scene, TextureId,
};

use crate::convert::id;
use crate::medium_stack::Boundary;
use crate::options::RenderOptions;
use crate::slopes::{SlopeCovariance, Widening};
use crate::texture::{TextureCoordinates, Textures};

/// All materials of a scene.
#[derive(Clone, Debug)]
pub(crate) struct Materials {
    /// Those of the scene, then the regularized ones, which paths hit behind rough surfaces only.
    materials: Vec<Material>,
    /// Of each material of the scene the one behind rough surfaces; empty without regularization.
    behind_rough: Vec<u32>,
    has_boundaries: bool,
    names: Vec<Option<String>>,
}

/// A material, ready for hits.
#[derive(Clone, Debug)]
pub(crate) struct Material {
    kind: MaterialKind,
    models: Models,
    /// Lobes seen from the inside and from the outside, where no texture is involved.
    constant: Option<[Lobe<f32>; 2]>,
    /// Where it is measured.
    measured: Option<Arc<Measured<f32>>>,
    one_sided: bool,
    /// Whether its layers let nothing through.
    opaque_layers: bool,
    /// What bends its normal, unless it bends nothing.
    pub(crate) bump: Option<Bump>,
    /// By whose rules it bends.
    pub(crate) bump_rules: BumpRules,
    /// What turns the lobes' x axis from dp/du towards dp/dv, unless nothing does.
    turn: Option<Turn>,
    /// What bends its clear coat, where that is bent otherwise than the rest.
    pub(crate) coat: Option<Coat>,
    /// What absorbs on its two sides, where that may change.
    boundary: Option<Boundary>,
    /// Where it is the same everywhere: seen from the inside, and from the outside or either side.
    plain: Option<[Plain; 2]>,
    /// Its coat, where the colour of the diffuse base below alone differs from point to point.
    coloured_base: Option<ColouredBase>,
    /// Whether its lobes' x axis does not matter, and its surfaces are as their meshes say.
    pub(crate) takes_any_tangent: bool,
    /// Whether its lobes differ in their alphas alone, where they are rough.
    differs_in_alphas: bool,
}

/// A material of one lobe, on surfaces that are as their meshes say.
#[derive(Clone, Debug)]
pub(crate) struct Plain {
    /// White, where there is a reflectance.
    pub(crate) lobe: Lobe<f32>,
    /// The albedo of the diffuse part, where it has a texture: what scales the values of Lambert's lobe, or the colour under
    /// the coat.
    pub(crate) reflectance: Option<ColourParam>,
    /// The coat over the reflectance.
    pub(crate) coat: Option<BaseCoat>,
    /// Whether many of its elements are evaluated and sampled at once; else one after the other.
    pub(crate) is_batched: bool,
    /// Whether it is another from the other side.
    pub(crate) is_sided: bool,
    /// Whether its back is black.
    pub(crate) black_inside: bool,
    pub(crate) specular: bool,
    pub(crate) isotropic: bool,
    /// Whether nothing passes it.
    pub(crate) opaque: bool,
    /// Index beyond it over the index before it, where it is batched.
    pub(crate) eta: f32,
}

/// A turn of the tangent.
#[derive(Clone, Copy, Debug)]
struct Turn {
    rotation_rad: f32,
    /// Direction before the rotation: `2 c - 1` of the red and green of a texture.
    direction: Option<TextureId>,
}

/// The bump map of a clear coat; `None`: it has the normals of the mesh.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Coat(pub(crate) Option<Bump>);

/// A material at a hit, mixes resolved.
#[derive(Clone, Copy)]
pub(crate) struct Chosen<'a> {
    pub(crate) material: &'a Material,
    /// Its index.
    pub(crate) index: u32,
    one_sided: bool,
    /// Whether it is that of a side, and seen as from its own outside.
    is_of_side: bool,
}

/// How rough surfaces scatter and are sampled.
#[derive(Clone, Copy, Debug)]
struct Models {
    sampler: vndf::Sampler,
    energy: Energy,
    mis_pdf: MisPdf,
    /// Whether they are made rougher, as behind a rough surface.
    regularized: bool,
}

/// How deep mixes may be nested.
const MOST_MIXES: u32 = 16;

impl Materials {
    /// Prepares the scene's materials.
    ///
    /// * `options`: its treatment of energy is for materials that do not choose their own.
    pub(crate) fn new(scene: &Scene, textures: &Textures, options: &RenderOptions) -> Self {
        let absorbs = scene.materials.iter().any(|m| {
            let around = m.around.unwrap_or(Rgb::BLACK);
            !(m.absorption.is_black() && around.is_black())
        });
        let prepare = |material: &specula_scene::scene::Material, regularized: bool| {
            let models = Models {
                sampler: options.vndf_sampler,
                energy: material.energy.unwrap_or(options.energy),
                mis_pdf: options.mis_pdf,
                regularized,
            };
            let (kind, varies) = parameters::folded(&material.kind, textures);
            let nowhere = TextureCoordinates::default();
            let measured = match kind {
                MaterialKind::Measured(id) => Some(Arc::clone(scene.measured[id.0].lobe())),
                _ => None,
            };
            let has_lobe = !matches!(
                kind,
                MaterialKind::Mix { .. }
                    | MaterialKind::Sided(_)
                    | MaterialKind::Measured(_)
                    | MaterialKind::Hair(_)
            );
            let mut material = Material {
                plain: None,
                coloured_base: ColouredBase::new(&kind, textures, models),
                takes_any_tangent: false,
                differs_in_alphas: bind::differs_in_alphas(&kind),
                constant: (!varies && has_lobe).then(|| {
                    [false, true]
                        .map(|outside| bind::lobe(&kind, textures, &nowhere, outside, models, None))
                }),
                measured,
                turn: turn(&kind, textures),
                coat: coat(&kind, material.bump.is_some()),
                boundary: absorbs.then(|| boundary(material)).flatten(),
                opaque_layers: bind::is_opaque(&kind),
                kind,
                models,
                one_sided: material.one_sided,
                bump_rules: material.bump_rules,
                bump: material.bump.filter(|bump| match bump {
                    // A constant height does not change normals.
                    Bump::Height(h) => {
                        matches!(textures.fold_float(*h), FloatParam::Texture(_))
                    }
                    Bump::Normal { .. } => true,
                }),
            };
            material.takes_any_tangent = !material.is_bent() && bind::is_isotropic(&material.kind);
            material.plain = material.as_plain();
            material
        };
        let materials = scene.materials.iter().map(|m| prepare(m, false));
        let materials: Vec<Material> = materials.collect();
        let mut prepared = Self {
            has_boundaries: materials.iter().any(|m| m.boundary.is_some()),
            names: scene.materials.iter().map(|m| m.name.clone()).collect(),
            materials,
            behind_rough: Vec::new(),
        };
        if options.regularize {
            prepared.add_twins(|i| prepare(&scene.materials[i], true));
        }
        prepared
    }

    /// How many there are, those behind rough surfaces among them.
    pub(crate) fn count(&self) -> usize {
        self.materials.len()
    }

    /// The file's name for one.
    pub(crate) fn name(&self, material: usize) -> Option<&str> {
        self.names.get(material)?.as_deref()
    }

    /// The lobe of a material that is the same everywhere.
    pub(crate) fn constant_lobe(&self, material: usize, outside: bool) -> Option<Lobe<f32>> {
        let lobes = self.materials.get(material)?.constant.as_ref()?;
        Some(lobes[usize::from(outside)])
    }

    /// Whether any bounds what absorbs.
    pub(crate) fn has_boundaries(&self) -> bool {
        self.has_boundaries
    }

    /// A material of one lobe, on surfaces that are as their meshes say.
    #[inline]
    pub(crate) fn plain(&self, material: u32) -> Option<&[Plain; 2]> {
        self.materials[material as usize].plain.as_ref()
    }

    /// Whether surfaces of a material are other than their meshes say: they have bump maps, or turned tangents, or
    /// chance or the side decides which material they have.
    #[inline]
    pub(crate) fn is_bent(&self, material: u32) -> bool {
        self.materials[material as usize].is_bent()
    }

    /// Whether any tangent will do for the lobes of a material.
    #[inline]
    pub(crate) fn takes_any_tangent(&self, material: u32) -> bool {
        self.materials[material as usize].takes_any_tangent
    }

    /// Whether lobes of a material differ in their alphas alone, where they are rough.
    #[inline]
    pub(crate) fn differs_in_alphas(&self, material: u32) -> bool {
        self.materials[material as usize].differs_in_alphas
    }

    /// A measured material.
    #[inline]
    pub(crate) fn measured(&self, material: u32) -> Option<&Measured<f32>> {
        self.materials[material as usize].measured.as_deref()
    }

    /// The reflectance of a plain material at a point.
    #[inline]
    pub(crate) fn reflectance(
        textures: &Textures,
        reflectance: ColourParam,
        place: &TextureCoordinates,
    ) -> Rgb<f32> {
        bind::albedo(textures, reflectance, place)
    }

    /// What absorbs on the two sides of a material's shapes, where it bounds a body.
    #[inline]
    pub(crate) fn boundary(&self, material: u32) -> Option<&Boundary> {
        self.materials[material as usize].boundary.as_ref()
    }

    /// The material at a point, one of the parts where it is a mix or has sides.
    ///
    /// * `outside`: whether it is seen from the outside of its shape.
    /// * `random`: a random number in `[0, 1)` for each level of mixes.
    #[inline]
    pub(crate) fn at(
        &self,
        material: u32,
        textures: &Textures,
        place: &TextureCoordinates,
        outside: bool,
        random: impl Fn(u32) -> f32,
    ) -> Chosen<'_> {
        let mut index = material;
        let mut material = &self.materials[index as usize];
        let mut one_sided = material.one_sided;
        let mut is_of_side = false;
        for level in 0..MOST_MIXES {
            let (materials, second) = match material.kind {
                MaterialKind::Mix { materials, amount } => {
                    (materials, random(level) < textures.float(amount, place))
                }
                MaterialKind::Sided(materials) => {
                    is_of_side = true;
                    (materials, !outside)
                }
                _ => break,
            };
            index = id(materials[usize::from(second)].0);
            material = &self.materials[index as usize];
            one_sided |= material.one_sided;
        }
        Chosen {
            material,
            index,
            one_sided,
            is_of_side,
        }
    }
}

/// What a material bounds in a scene where something absorbs: also a body that itself does not.
fn boundary(material: &specula_scene::scene::Material) -> Option<Boundary> {
    let is_clear = matches!(&material.kind, MaterialKind::Gltf(g)
        if g.volume && g.transmission != FloatParam::Value(0.0));
    (is_clear || material.bounds_absorption()).then_some(Boundary {
        inside: material.absorption,
        around: material.around,
    })
}

/// What turns the tangent of a material.
fn turn(kind: &MaterialKind, textures: &Textures) -> Option<Turn> {
    let mut turn = Turn {
        rotation_rad: bind::rotation_rad(kind),
        direction: None,
    };
    if let MaterialKind::Gltf(g) = kind
        && g.anisotropy != FloatParam::Value(0.0)
        && let Some(id) = g.anisotropy_direction
    {
        match textures.fold_colour(ColourParam::Texture(id)) {
            ColourParam::Texture(id) => turn.direction = Some(id),
            ColourParam::Value(c) => turn.rotation_rad += azimuth(c),
        }
    }
    (turn.rotation_rad != 0.0 || turn.direction.is_some()).then_some(turn)
}

/// Angle of the direction `2 c - 1`; 0 where it is none.
fn azimuth(c: Rgb<f32>) -> f32 {
    let [x, y] = [c.r, c.g].map(|v| 2.0 * v - 1.0);
    // The middle of 8 bits is not exactly 1/2.
    if x.abs().max(y.abs()) < 0.01 {
        return 0.0;
    }
    y.atan2(x)
}

/// What bends a clear coat otherwise than the rest of its material.
///
/// * `bent`: whether the rest is bent.
fn coat(kind: &MaterialKind, bent: bool) -> Option<Coat> {
    let MaterialKind::Gltf(g) = kind else {
        return None;
    };
    let there = g.clearcoat != FloatParam::Value(0.0);
    (there && (bent || g.clearcoat_bump.is_some())).then_some(Coat(g.clearcoat_bump))
}

impl Material {
    fn is_bent(&self) -> bool {
        let is_mixed = matches!(self.kind, MaterialKind::Mix { .. } | MaterialKind::Sided(_));
        self.bump.is_some() || self.turn.is_some() || self.coat.is_some() || is_mixed
    }

    /// Whether its kind has no other side.
    fn is_black_inside(&self) -> bool {
        matches!(self.kind, MaterialKind::Plastic { .. })
    }

    fn as_plain(&self) -> Option<[Plain; 2]> {
        if self.is_bent() {
            return None;
        }
        let (lobes, reflectance, coat) = match (self.constant, &self.kind, &self.coloured_base) {
            (Some(lobes), ..) => (lobes, None, None),
            (
                None,
                MaterialKind::Diffuse {
                    reflectance,
                    roughness: FloatParam::Value(roughness),
                },
                _,
            ) if *roughness <= 0.0 => {
                let white = Lambert::new(Rgb::WHITE).into();
                ([white; 2], Some(*reflectance), None)
            }
            (None, _, Some(ColouredBase { colour, coat })) => {
                let white = coat.over(Rgb::WHITE);
                if !lobes::is_batched(&white) {
                    return None;
                }
                let inside = if self.is_black_inside() {
                    bind::black()
                } else {
                    white
                };
                ([inside, white], Some(*colour), Some(*coat))
            }
            _ => return None,
        };
        let [inside, outside] = lobes;
        if matches!(outside, Lobe::Black(_)) {
            return None;
        }
        let black_inside = self.one_sided || matches!(inside, Lobe::Black(_));
        let eta = match self.kind {
            MaterialKind::Dielectric { eta, .. } => eta,
            _ => 1.0,
        };
        let seen = |lobe: Lobe<f32>, eta| Plain {
            lobe,
            reflectance,
            coat,
            is_batched: lobes::is_batched(&lobe),
            is_sided: !black_inside && inside != outside,
            black_inside,
            specular: lobe.is_specular(),
            isotropic: self.takes_any_tangent,
            opaque: self.is_opaque(lobes::sides(&lobe)),
            eta,
        };
        Some([seen(inside, 1.0 / eta), seen(outside, eta)])
    }

    /// Whether nothing comes through a lobe of it.
    #[inline]
    fn is_opaque(&self, sides: Sides) -> bool {
        match sides {
            Sides::Reflects => true,
            Sides::Transmits => false,
            Sides::Depends => self.opaque_layers,
        }
    }

    /// Angle of the lobes' x axis from dp/du towards dp/dv.
    #[inline]
    pub(crate) fn rotation_rad(
        &self,
        textures: &Textures,
        place: impl Fn() -> TextureCoordinates,
    ) -> f32 {
        match self.turn {
            None => 0.0,
            Some(Turn {
                rotation_rad,
                direction: None,
            }) => rotation_rad,
            Some(Turn {
                rotation_rad,
                direction: Some(id),
            }) => rotation_rad + azimuth(textures.colour(ColourParam::Texture(id), &place())),
        }
    }
}

impl<'a> Chosen<'a> {
    /// The lobe as seen from one side.
    #[inline]
    pub(crate) fn lobe(
        &self,
        textures: &Textures,
        place: &TextureCoordinates,
        outside: bool,
    ) -> PointLobe<'a> {
        let outside = outside || self.is_of_side;
        if self.one_sided && !outside {
            return PointLobe::Listed(bind::black());
        }
        let m = self.material;
        if let MaterialKind::Hair(hair) = &m.kind {
            return PointLobe::Hair(hair::lobe(hair, textures, place));
        }
        PointLobe::Listed(match (&m.constant, &m.measured) {
            (Some(lobes), _) => lobes[usize::from(outside)],
            (None, Some(measured)) => return PointLobe::Measured(measured),
            (None, None) => match &m.coloured_base {
                Some(base) if outside || !m.is_black_inside() => base.at(textures, place),
                _ => bind::lobe(&m.kind, textures, place, outside, m.models, None),
            },
        })
    }

    /// How alphas grow by the slopes of a normal map, and by which angle the lobe's x axis turns.
    ///
    /// * `map`, `own_coat`: as of [`Widening::new`], in the frame that the lobe has else.
    pub(crate) fn widening(
        &self,
        textures: &Textures,
        place: &TextureCoordinates,
        map: SlopeCovariance,
        own_coat: f32,
    ) -> (Widening, f32) {
        let m = self.material;
        let alphas = bind::alphas(&m.kind, textures, place, m.models);
        Widening::new(map, own_coat, alphas)
    }

    /// [`Chosen::lobe`] with alphas that have grown.
    pub(crate) fn widened_lobe(
        &self,
        textures: &Textures,
        place: &TextureCoordinates,
        outside: bool,
        widening: &Widening,
    ) -> PointLobe<'a> {
        let m = self.material;
        let outside = outside || self.is_of_side;
        match &m.measured {
            None if !self.one_sided || outside => {
                let models = m.models;
                let widening = Some(widening);
                let lobe = bind::lobe(&m.kind, textures, place, outside, models, widening);
                PointLobe::Listed(lobe)
            }
            _ => self.lobe(textures, place, outside),
        }
    }

    /// Whether nothing comes through the lobe: it is black where `wi.z <= 0`.
    #[inline]
    pub(crate) fn is_opaque(&self, lobe: &PointLobe<'_>) -> bool {
        self.material.is_opaque(lobe.sides())
    }
}
