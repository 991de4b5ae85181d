//! Rough metal and rough glass: by distribution, masking and treatment of multiple scattering.

use specula_bsdf::Alpha;
use specula_bsdf::bsdf::{
    Compensated, CompensatedDielectric, Lobe, MultibounceConductor, MultibounceDielectric,
    RoughConductor, RoughDielectric, Tints,
};
use specula_bsdf::energy::Tabulated;
use specula_bsdf::fresnel::Reflectance;
use specula_bsdf::ndf::{Beckmann, Ggx};
use specula_scene::Energy;
use specula_scene::scene::{MicrofacetDistribution, Roughness};

use super::Models;

/// A rough metal. Random walks know height-correlated masking only.
pub(super) fn conductor(
    roughness: &Roughness,
    alpha: Alpha<f32>,
    metal: Reflectance<f32>,
    models: Models,
) -> Lobe<f32> {
    match roughness.distribution {
        MicrofacetDistribution::Ggx => {
            match conductor_of(Ggx::new(alpha), roughness, metal, models) {
                Lobe::RoughConductor(lobe) => lobe.with_sampler(models.sampler).into(),
                Lobe::Compensated(lobe) => lobe.with_sampler(models.sampler).into(),
                other => other,
            }
        }
        MicrofacetDistribution::Beckmann => {
            conductor_of(Beckmann::new(alpha), roughness, metal, models)
        }
    }
}

fn conductor_of<N: Tabulated<f32>>(
    ndf: N,
    roughness: &Roughness,
    metal: Reflectance<f32>,
    models: Models,
) -> Lobe<f32>
where
    RoughConductor<f32, N>: Into<Lobe<f32>>,
    Compensated<f32, N>: Into<Lobe<f32>>,
    MultibounceConductor<f32, N>: Into<Lobe<f32>>,
{
    match models.energy {
        Energy::None => RoughConductor::new(ndf, metal)
            .with_masking(roughness.masking)
            .into(),
        Energy::Compensated(model) => Compensated::new(ndf, metal, model)
            .with_masking(roughness.masking)
            .into(),
        Energy::Multibounce(model) => MultibounceConductor::new(ndf, metal, model)
            .with_mis_pdf(models.mis_pdf)
            .into(),
    }
}

/// Rough glass. Turquin's factor is for metals: glass takes Kulla and Conty's compensation in its
/// place.
///
/// * `relative`: index beyond the surface over the index on the viewer's side.
pub(super) fn dielectric(
    roughness: &Roughness,
    alpha: Alpha<f32>,
    relative: f32,
    tints: Tints<f32>,
    models: Models,
) -> Lobe<f32> {
    match roughness.distribution {
        MicrofacetDistribution::Ggx => {
            dielectric_of(Ggx::new(alpha), roughness, relative, tints, models)
        }
        MicrofacetDistribution::Beckmann => {
            dielectric_of(Beckmann::new(alpha), roughness, relative, tints, models)
        }
    }
}

fn dielectric_of<N: Tabulated<f32>>(
    ndf: N,
    roughness: &Roughness,
    relative: f32,
    tints: Tints<f32>,
    models: Models,
) -> Lobe<f32>
where
    RoughDielectric<f32, N>: Into<Lobe<f32>>,
    CompensatedDielectric<f32, N>: Into<Lobe<f32>>,
    MultibounceDielectric<f32, N>: Into<Lobe<f32>>,
{
    match models.energy {
        // Caps whatever is chosen for metals: refraction needs all visible normals.
        Energy::None => RoughDielectric::facing(ndf, relative)
            .with_masking(roughness.masking)
            .with_tints(tints)
            .into(),
        Energy::Compensated(_) => CompensatedDielectric::facing(ndf, relative)
            .with_masking(roughness.masking)
            .with_tints(tints)
            .into(),
        Energy::Multibounce(model) => MultibounceDielectric::facing(ndf, relative, model)
            .with_mis_pdf(models.mis_pdf)
            .with_tints(tints)
            .into(),
    }
}
