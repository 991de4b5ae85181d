//! Simple lobes out of parameters: diffuse ones, metals, dielectrics.

use specula_bsdf::bsdf::{self, Tints};
use specula_bsdf::energy::EnergyModel;
use specula_bsdf::math::{Real, Rgb};
use specula_bsdf::multibounce::{MisPdf, MultibounceModel};
use specula_bsdf::vndf::Sampler;

use crate::given::{Distribution, Given, beckmann, ggx};
use crate::reflectance::Reflectance;
use crate::{Pair, both};

type Made = Result<Pair, String>;

pub(crate) fn lambert(given: Given<'_>) -> Made {
    let albedo = given.albedo("albedo")?;
    Ok(both!(T => bsdf::Lambert::<T>::new(albedo.cast())))
}

pub(crate) fn eon(given: Given<'_>) -> Made {
    let albedo = given.albedo("albedo")?;
    let roughness = given.number("roughness")?;
    Ok(both!(T => bsdf::Eon::<T>::new(albedo.cast(), T::of(roughness))))
}

pub(crate) fn diffuse_transmission(given: Given<'_>) -> Made {
    let reflectance = given.albedo("reflectance")?;
    let transmittance = given.albedo("transmittance")?;
    Ok(both!(T => {
        bsdf::DiffuseTransmission::<T>::new(reflectance.cast(), transmittance.cast())
    }))
}

pub(crate) fn smooth_conductor(given: Given<'_>) -> Made {
    let reflectance = Reflectance::or_white(given)?;
    Ok(both!(T => bsdf::SmoothConductor::<T>::new(reflectance.cast())))
}

/// A sampler; Beckmann has but its own.
fn sampler(given: Given<'_>, distribution: Distribution) -> Result<Sampler, String> {
    match (distribution, given.word("sampler")?) {
        (Distribution::Beckmann, Some(name)) => Err(format!(
            "sampler: '{name}' is of GGX; Beckmann's visible normals have one sampler of their own"
        )),
        _ => given.chosen("sampler"),
    }
}

pub(crate) fn conductor(given: Given<'_>) -> Made {
    let alpha = given.needed_alpha()?;
    let reflectance = Reflectance::or_white(given)?;
    let distribution = given.distribution()?;
    let sampler = sampler(given, distribution)?;
    let smith = given.masking()?;
    let lobe = match (distribution, given.named::<EnergyModel>("energy")?) {
        (Distribution::Ggx, None) => both!(T => {
            bsdf::RoughConductor::<T>::new(ggx(alpha), reflectance.cast())
                .with_masking(smith)
                .with_sampler(sampler)
        }),
        (Distribution::Ggx, Some(model)) => both!(T => {
            bsdf::Compensated::<T>::new(ggx(alpha), reflectance.cast(), model)
                .with_masking(smith)
                .with_sampler(sampler)
        }),
        (Distribution::Beckmann, None) => both!(T => {
            bsdf::RoughConductor::new(beckmann::<T>(alpha), reflectance.cast()).with_masking(smith)
        }),
        (Distribution::Beckmann, Some(model)) => both!(T => {
            bsdf::Compensated::new(beckmann::<T>(alpha), reflectance.cast(), model)
                .with_masking(smith)
        }),
    };
    Ok(lobe)
}

pub(crate) fn multibounce_conductor(given: Given<'_>) -> Made {
    let alpha = given.needed_alpha()?;
    let reflectance = Reflectance::or_white(given)?;
    let distribution = given.distribution()?;
    let model: MultibounceModel = given.chosen("model")?;
    let mis: MisPdf = given.chosen("mis_pdf")?;
    let lobe = match distribution {
        Distribution::Ggx => both!(T => {
            bsdf::MultibounceConductor::<T>::new(ggx(alpha), reflectance.cast(), model)
                .with_mis_pdf(mis)
        }),
        Distribution::Beckmann => both!(T => {
            bsdf::MultibounceConductor::new(beckmann::<T>(alpha), reflectance.cast(), model)
                .with_mis_pdf(mis)
        }),
    };
    Ok(lobe)
}

/// Tints of a dielectric, white by default.
fn shares(given: Given<'_>) -> Result<[Rgb<f64>; 2], String> {
    Ok([
        given.albedo("reflection_tint")?,
        given.albedo("transmission_tint")?,
    ])
}

/// Tints in a precision.
fn tints<T: Real>([reflection, transmission]: [Rgb<f64>; 2]) -> Tints<T> {
    Tints {
        reflection: reflection.cast(),
        transmission: transmission.cast(),
    }
}

pub(crate) fn smooth_dielectric(given: Given<'_>) -> Made {
    let eta = given.number("eta")?;
    let colours = shares(given)?;
    Ok(both!(T => {
        bsdf::SmoothDielectric::<T>::new(T::of(eta)).with_tints(tints(colours))
    }))
}

pub(crate) fn thin_dielectric(given: Given<'_>) -> Made {
    let eta = given.number("eta")?;
    let colours = shares(given)?;
    Ok(both!(T => {
        bsdf::ThinDielectric::<T>::new(T::of(eta)).with_tints(tints(colours))
    }))
}

pub(crate) fn dielectric(given: Given<'_>) -> Made {
    let alpha = given.needed_alpha()?;
    let eta = given.number("eta")?;
    let distribution = given.distribution()?;
    let sampler = sampler(given, distribution)?;
    let smith = given.masking()?;
    let colours = shares(given)?;
    let lobe = match (distribution, given.flag("compensated")?) {
        (Distribution::Ggx, false) => both!(T => {
            bsdf::RoughDielectric::<T>::new(ggx(alpha), T::of(eta))
                .with_masking(smith)
                .with_tints(tints(colours))
                .with_sampler(sampler)
        }),
        (Distribution::Ggx, true) => both!(T => {
            bsdf::CompensatedDielectric::<T>::new(ggx(alpha), T::of(eta))
                .with_masking(smith)
                .with_tints(tints(colours))
                .with_sampler(sampler)
        }),
        (Distribution::Beckmann, false) => both!(T => {
            bsdf::RoughDielectric::new(beckmann::<T>(alpha), T::of(eta))
                .with_masking(smith)
                .with_tints(tints(colours))
        }),
        (Distribution::Beckmann, true) => both!(T => {
            bsdf::CompensatedDielectric::new(beckmann::<T>(alpha), T::of(eta))
                .with_masking(smith)
                .with_tints(tints(colours))
        }),
    };
    Ok(lobe)
}

pub(crate) fn multibounce_dielectric(given: Given<'_>) -> Made {
    let alpha = given.needed_alpha()?;
    let eta = given.number("eta")?;
    let distribution = given.distribution()?;
    if let Some(name) = given.word("model")?
        && !matches!(name, "heitz" | "specula")
    {
        return Err(format!(
            "model: '{name}' is of metals (expected heitz or specula)"
        ));
    }
    let model: MultibounceModel = given.chosen("model")?;
    let mis: MisPdf = given.chosen("mis_pdf")?;
    let colours = shares(given)?;
    let lobe = match distribution {
        Distribution::Ggx => both!(T => {
            bsdf::MultibounceDielectric::<T>::new(ggx(alpha), T::of(eta), model)
                .with_mis_pdf(mis)
                .with_tints(tints(colours))
        }),
        Distribution::Beckmann => both!(T => {
            bsdf::MultibounceDielectric::new(beckmann::<T>(alpha), T::of(eta), model)
                .with_mis_pdf(mis)
                .with_tints(tints(colours))
        }),
    };
    Ok(lobe)
}
