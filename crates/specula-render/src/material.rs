//! From a material and a point of its surface to the lobe there.

use specula_bsdf::bsdf::{
    CoatedConductor, CoatedDiffuse, Compensated, CompensatedDielectric, DiffuseTransmission, Eon,
    Lambert, Lobe, RoughConductor, RoughDielectric, SmoothConductor, SmoothDielectric,
    ThinDielectric,
};
use specula_bsdf::fresnel::{Conductor, Reflectance};
use specula_bsdf::multibounce::{self, MisPdf};
use specula_bsdf::ndf::Ggx;
use specula_bsdf::vndf;
use specula_bsdf::{Alpha, Rgb};
use specula_scene::Energy;
use specula_scene::scene::{
    ColourParam, ConductorFresnel, FloatParam, MaterialKind, Roughness, RoughnessMapping, Scene,
};

use crate::convert::narrow;
use crate::options::RenderOptions;
use crate::texture::Textures;

/// Where a lobe is wanted.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) uv: [f32; 2],
    /// Whether it is seen from the outside of its shape.
    pub(crate) outside: bool,
}

/// All materials of a scene.
#[derive(Clone, Debug)]
pub(crate) struct Materials {
    materials: Vec<Prepared>,
}

#[derive(Clone, Debug)]
struct Prepared {
    kind: MaterialKind,
    models: Models,
    /// Lobes seen from the inside and from the outside, where no texture is involved.
    constant: Option<[Lobe<f32>; 2]>,
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
            Prepared {
                kind: material.kind,
                models,
                constant: is_constant(&material.kind).then(|| {
                    [false, true].map(|outside| {
                        let uv = [0.0; 2];
                        lobe(&material.kind, textures, Place { uv, outside }, models)
                    })
                }),
            }
        };
        Self {
            materials: scene.materials.iter().map(prepare).collect(),
        }
    }

    /// The lobe of a material at a place.
    ///
    /// * `random`: for every mix on the way, a number in `[0, 1)`.
    #[inline]
    pub(crate) fn lobe(
        &self,
        material: u32,
        textures: &Textures,
        place: Place,
        random: impl Fn(u32) -> f32,
    ) -> Lobe<f32> {
        let mut index = material as usize;
        for level in 0..MOST_MIXES {
            let MaterialKind::Mix { materials, amount } = self.materials[index].kind else {
                break;
            };
            let second = random(level) < textures.float(amount, place.uv);
            index = materials[usize::from(second)].0;
        }
        let material = &self.materials[index];
        match &material.constant {
            Some(lobes) => lobes[usize::from(place.outside)],
            None => lobe(&material.kind, textures, place, material.models),
        }
    }
}

/// Whether no texture is involved.
fn is_constant(kind: &MaterialKind) -> bool {
    let c = |p: &ColourParam| matches!(p, ColourParam::Value(_));
    let f = |p: &FloatParam| matches!(p, FloatParam::Value(_));
    let r = |r: &Roughness| f(&r.u) && f(&r.v);
    let fresnel = |x: &ConductorFresnel| match x {
        ConductorFresnel::Index { eta, k } => c(eta) && c(k),
        ConductorFresnel::Reflectance(x) => c(x),
    };
    match kind {
        MaterialKind::Diffuse {
            reflectance,
            roughness,
        } => c(reflectance) && f(roughness),
        MaterialKind::DiffuseTransmission {
            reflectance,
            transmittance,
        } => c(reflectance) && c(transmittance),
        MaterialKind::Conductor {
            fresnel: x,
            roughness,
        } => fresnel(x) && r(roughness),
        MaterialKind::Dielectric { roughness, .. } => r(roughness),
        MaterialKind::CoatedDiffuse {
            reflectance,
            roughness,
            ..
        } => c(reflectance) && r(roughness),
        MaterialKind::CoatedConductor {
            coat_roughness,
            fresnel: x,
            roughness,
            ..
        } => r(coat_roughness) && fresnel(x) && r(roughness),
        MaterialKind::ThinDielectric { .. } => true,
        MaterialKind::Mix { .. } | MaterialKind::Interface => false,
    }
}

fn lobe(kind: &MaterialKind, textures: &Textures, place: Place, models: Models) -> Lobe<f32> {
    let sampler = models.sampler;
    let albedo = |p: ColourParam| textures.colour(p, place.uv).map(|v| v.clamp(0.0, 1.0));
    let ggx = |r: &Roughness| ggx(r, textures, place.uv);
    let metal = |f: &ConductorFresnel| reflectance(f, textures, place.uv);
    match *kind {
        MaterialKind::Diffuse {
            reflectance,
            roughness,
        } => {
            let r = textures.float(roughness, place.uv).clamp(0.0, 1.0);
            if r > 0.0 {
                Eon::new(albedo(reflectance), r).into()
            } else {
                Lambert::new(albedo(reflectance)).into()
            }
        }
        MaterialKind::DiffuseTransmission {
            reflectance,
            transmittance,
        } => {
            // No more leaves than arrives: both are scaled where their sum is above 1.
            let (r, t) = (albedo(reflectance), albedo(transmittance));
            let excess = (r + t).max_channel().max(1.0);
            DiffuseTransmission::new(r / excess, t / excess).into()
        }
        MaterialKind::Conductor {
            ref fresnel,
            ref roughness,
        } => match ggx(roughness) {
            Some(ggx) => rough_conductor(ggx, metal(fresnel), models),
            None => SmoothConductor::new(metal(fresnel)).into(),
        },
        MaterialKind::Dielectric { eta, ref roughness } => {
            let relative = if place.outside { eta } else { 1.0 / eta };
            match ggx(roughness) {
                // With equal indices nothing is bent, however rough.
                Some(ggx) if (relative - 1.0).abs() > 1e-4 => {
                    rough_dielectric(ggx, relative, models)
                }
                _ => SmoothDielectric::facing(relative).into(),
            }
        }
        MaterialKind::ThinDielectric { eta } => ThinDielectric::new(eta).into(),
        MaterialKind::CoatedDiffuse {
            reflectance,
            eta,
            ref roughness,
        } => CoatedDiffuse::new(ggx(roughness), eta, albedo(reflectance))
            .with_sampler(sampler)
            .into(),
        MaterialKind::CoatedConductor {
            coat_eta,
            ref coat_roughness,
            ref fresnel,
            ref roughness,
        } => CoatedConductor::new(
            ggx(coat_roughness),
            coat_eta,
            ggx(roughness),
            metal(fresnel),
        )
        .with_sampler(sampler)
        .into(),
        // Shapes without a surface are dropped before; mixes nested too deeply are black.
        MaterialKind::Mix { .. } | MaterialKind::Interface => Lambert::new(Rgb::BLACK).into(),
    }
}

fn rough_conductor(ggx: Ggx<f32>, metal: Reflectance<f32>, models: Models) -> Lobe<f32> {
    match models.energy {
        Energy::None => RoughConductor::new(ggx, metal)
            .with_sampler(models.sampler)
            .into(),
        Energy::Compensated(model) => Compensated::new(ggx, metal, model)
            .with_sampler(models.sampler)
            .into(),
        Energy::Multibounce(model) => multibounce::Conductor::new(ggx, metal, model)
            .with_mis_pdf(models.mis_pdf)
            .into(),
    }
}

/// Turquin's factor is for metals: glass takes Kulla and Conty's compensation in its place.
fn rough_dielectric(ggx: Ggx<f32>, relative: f32, models: Models) -> Lobe<f32> {
    match models.energy {
        // Caps whatever is chosen for metals: refraction needs all visible normals.
        Energy::None => RoughDielectric::facing(ggx, relative).into(),
        Energy::Compensated(_) => CompensatedDielectric::facing(ggx, relative).into(),
        Energy::Multibounce(model) => multibounce::Dielectric::facing(ggx, relative, model)
            .with_mis_pdf(models.mis_pdf)
            .into(),
    }
}

/// The distribution of normals; `None` where the surface is smooth: both widths are below
/// [`Alpha::SPECULAR_BELOW`]. With one above, the other is raised to that bound.
fn ggx(roughness: &Roughness, textures: &Textures, uv: [f32; 2]) -> Option<Ggx<f32>> {
    let bound = narrow(Alpha::<f32>::SPECULAR_BELOW);
    let [x, y] = [roughness.u, roughness.v].map(|p| {
        let r = textures.float(p, uv).max(0.0);
        match roughness.mapping {
            RoughnessMapping::Alpha => r,
            RoughnessMapping::Sqrt => r.sqrt(),
            RoughnessMapping::Square => r * r,
        }
    });
    (x >= bound || y >= bound).then(|| Ggx::new(Alpha::clamped(x.max(bound), y.max(bound))))
}

fn reflectance(fresnel: &ConductorFresnel, textures: &Textures, uv: [f32; 2]) -> Reflectance<f32> {
    Reflectance::Conductor(match *fresnel {
        ConductorFresnel::Index { eta, k } => Conductor {
            eta: textures.colour(eta, uv).map(|v| v.max(1e-4)),
            k: textures.colour(k, uv).map(|v| v.max(0.0)),
        },
        // pbrt-v4: the k that gives this reflectance at normal incidence with eta = 1.
        ConductorFresnel::Reflectance(colour) => Conductor {
            eta: Rgb::WHITE,
            k: textures.colour(colour, uv).map(|r| {
                let r = r.clamp(0.0, 0.9999);
                2.0 * r.sqrt() / (1.0 - r).sqrt()
            }),
        },
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn roughness(u: f32, v: f32, mapping: RoughnessMapping) -> Roughness {
        Roughness {
            u: FloatParam::Value(u),
            v: FloatParam::Value(v),
            mapping,
        }
    }

    #[test]
    fn roughness_becomes_alpha_and_smooth_below_the_bound() {
        let textures = Textures::default();
        let of = |u, v, mapping| ggx(&roughness(u, v, mapping), &textures, [0.0; 2]);
        let expected = |x, y| Some(Ggx::new(Alpha::clamped(x, y)));
        assert_eq!(of(9e-4, 0.0, RoughnessMapping::Alpha), None);
        assert_eq!(of(f32::NAN, -1.0, RoughnessMapping::Alpha), None);
        assert_eq!(of(0.0, 0.3, RoughnessMapping::Alpha), expected(1e-3, 0.3));
        assert_eq!(of(0.25, 0.04, RoughnessMapping::Sqrt), expected(0.5, 0.2));
        assert_eq!(of(0.5, 0.5, RoughnessMapping::Square), expected(0.25, 0.25));
    }

    #[test]
    fn a_metal_by_reflectance_reflects_that_at_normal_incidence() {
        let colour = ColourParam::Value(Rgb::from([0.9, 0.5, 0.1]));
        let fresnel = ConductorFresnel::Reflectance(colour);
        let found = reflectance(&fresnel, &Textures::default(), [0.0; 2]).eval(1.0);
        for (found, expected) in found.to_array().into_iter().zip([0.9, 0.5, 0.1]) {
            assert!((found - expected).abs() < 1e-4, "{found} {expected}");
        }
    }
}
