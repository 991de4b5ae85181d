//! The lobes of a material: one for each treatment of energy, one for each
//! sampler.

use specula_bsdf::bsdf::Lobe;
use specula_bsdf::energy::{EnergyModel, FmsVariant};
use specula_bsdf::math::Stream;
use specula_bsdf::vndf::Sampler;
use specula_bsdf::{Bsdf, Rgb, Transport, Vec3, multibounce};
use specula_render::{PreparedScene, RenderOptions};
use specula_scene::scene::{
    ColourParam, ConductorFresnel, FloatParam, Material, MaterialKind, Roughness, RoughnessMapping,
};
use specula_scene::{Energy, Scene, builtin};

use crate::{LabError, Result};

/// Treatments that are shown, with the styles of their lines.
const ENERGIES: [(Energy, usize); 4] = [
    (Energy::None, 4),
    (
        Energy::Compensated(EnergyModel::Turquin(FmsVariant::NormalIncidence)),
        0,
    ),
    (Energy::Compensated(EnergyModel::KullaConty), 5),
    (
        Energy::Multibounce(multibounce::MultibounceModel::StratifiedBidirectional),
        1,
    ),
];
/// In the order of their years.
const SAMPLERS: [Sampler; 4] = [
    Sampler::Heitz,
    Sampler::Cap,
    Sampler::Bounded,
    Sampler::Exact,
];

/// A lobe with its name and style.
pub(super) struct Named {
    pub(super) name: String,
    pub(super) style: usize,
    pub(super) lobe: Lobe<f32>,
    /// The same with white in place of all colours.
    pub(super) white: Lobe<f32>,
}

/// All lobes of a material.
pub(super) struct Variants {
    /// By treatment of energy, those that make a difference; the first is without.
    pub(super) energies: Vec<Named>,
    /// By sampler, those that make a difference.
    pub(super) samplers: Vec<Named>,
    /// Index below the surface over the one above it.
    pub(super) eta: f64,
    /// The narrower of the alphas of its microfacets.
    pub(super) sharpness: f64,
    /// Whether the alphas differ.
    pub(super) is_anisotropic: bool,
}

impl Variants {
    /// # Errors
    ///
    /// Where the material has textures.
    pub(super) fn new(kind: &MaterialKind) -> Result<Self> {
        let white_kind = white(kind);
        let mut scene = bare();
        let mut both = |options: &RenderOptions| -> Result<[Lobe<f32>; 2]> {
            let own = lobe(&mut scene, kind, options)?;
            Ok([own, lobe(&mut scene, &white_kind, options)?])
        };
        let mut energies: Vec<Named> = Vec::new();
        for (energy, style) in ENERGIES {
            let [lobe, white] = both(&RenderOptions {
                energy,
                ..RenderOptions::default()
            })?;
            add(&mut energies, energy.to_string(), style, [lobe, white]);
        }
        let mut samplers = Vec::new();
        for sampler in SAMPLERS {
            let lobes = both(&RenderOptions {
                vndf_sampler: sampler,
                ..RenderOptions::default()
            })?;
            let style = crate::compare::style(sampler);
            add(&mut samplers, sampler.to_string(), style, lobes);
        }
        if let [only] = &mut samplers[..] {
            "its own".clone_into(&mut only.name);
        }
        let alphas = alphas(kind);
        Ok(Self {
            energies,
            samplers,
            eta: match kind {
                MaterialKind::Dielectric { eta, .. } => f64::from(*eta),
                _ => 1.0,
            },
            sharpness: alphas.map_or(0.5, |[a, b]| a.min(b)),
            is_anisotropic: alphas.is_some_and(|[a, b]| a != b),
        })
    }

    /// Whether there is nothing but Dirac deltas.
    pub(super) fn is_specular(&self) -> bool {
        self.energies[0].lobe.is_specular()
    }

    /// Whether some values are estimates.
    pub(super) fn is_stochastic(&self) -> bool {
        self.energies.iter().any(|n| is_stochastic(&n.lobe))
    }

    /// Whether light comes through.
    pub(super) fn lets_pass(&self) -> bool {
        matches!(
            self.energies[0].lobe,
            Lobe::RoughDielectric(_) | Lobe::SmoothDielectric(_)
        )
    }
}

pub(super) fn is_stochastic(lobe: &Lobe<f32>) -> bool {
    Bsdf::<f32>::is_stochastic(lobe)
}

/// Adds a lobe unless an equal one is there under another name.
fn add(all: &mut Vec<Named>, name: String, style: usize, [lobe, white]: [Lobe<f32>; 2]) {
    if all.iter().all(|n| n.lobe != lobe) {
        all.push(Named {
            name,
            style,
            lobe,
            white,
        });
    }
}

/// A scene without anything in it.
pub(super) fn bare() -> Scene {
    let mut scene = builtin::orbs();
    scene.shapes.clear();
    scene.meshes.clear();
    scene.lights.clear();
    scene.textures.clear();
    scene.images.clear();
    scene
}

/// The lobe that the renderer binds, seen from the outside.
pub(super) fn lobe(
    scene: &mut Scene,
    kind: &MaterialKind,
    options: &RenderOptions,
) -> Result<Lobe<f32>> {
    scene.materials = vec![Material::new(*kind)];
    PreparedScene::new(scene, options)?
        .lobe(0, true)
        .ok_or_else(|| LabError::Material("a material with textures has no lobe of its own".into()))
}

/// The material with a reflectance of 1.
fn white(kind: &MaterialKind) -> MaterialKind {
    let mut kind = *kind;
    match &mut kind {
        MaterialKind::Conductor { fresnel, .. } | MaterialKind::CoatedConductor { fresnel, .. } => {
            *fresnel = ConductorFresnel::Mirror;
        }
        MaterialKind::Diffuse { reflectance, .. }
        | MaterialKind::CoatedDiffuse { reflectance, .. } => *reflectance = ColourParam::WHITE,
        _ => {}
    }
    kind
}

/// Alphas of the microfacets, where there are any.
pub(super) fn alphas(kind: &MaterialKind) -> Option<[f64; 2]> {
    let roughness: &Roughness = match kind {
        MaterialKind::Conductor { roughness, .. }
        | MaterialKind::Dielectric { roughness, .. }
        | MaterialKind::CoatedDiffuse { roughness, .. }
        | MaterialKind::CoatedConductor { roughness, .. } => roughness,
        _ => return None,
    };
    let value = |parameter| match parameter {
        FloatParam::Value(v) => Some(f64::from(v)),
        FloatParam::Texture(_) => None,
    };
    let both = [value(roughness.u)?, value(roughness.v)?];
    Some(match roughness.mapping {
        RoughnessMapping::Alpha => both,
        _ => both.map(|r| r * r),
    })
}

/// A direction by its angle from the normal and its azimuth, degrees.
pub(super) fn direction(theta_deg: f64, azimuth_deg: f64) -> Vec3<f32> {
    crate::direction::direction(theta_deg, azimuth_deg).cast()
}

/// `f |cos theta_i|`: the mean over `walks` where it is an estimate.
pub(super) fn f_cos(lobe: &Lobe<f32>, wo: Vec3<f32>, wi: Vec3<f32>, walks: u32) -> Rgb<f64> {
    if !is_stochastic(lobe) {
        return lobe.eval(wo, wi, Transport::Radiance).cast();
    }
    let mut stream = Stream::new(1);
    let mut sum = Rgb::BLACK;
    for _ in 0..walks {
        let (value, _) = lobe.eval_pdf_random(wo, wi, Transport::Radiance, &mut stream);
        sum += value.cast();
    }
    sum * (1.0 / f64::from(walks))
}
