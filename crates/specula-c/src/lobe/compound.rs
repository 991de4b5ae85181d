//! Lobes of several, out of parameters: coats, layers, plastics, principled, glTF.

use specula_bsdf::bsdf::{
    self, Base, CoatLayer, CoatScattering, GltfParameters, Medium, PrincipledParameters,
};
use specula_bsdf::math::{Real, Rgb};
use specula_bsdf::ndf::Masking;

use super::given::{ANY, COAT_ETA, Distribution, ETA, Given, SHARE, beckmann, ggx};
use super::reflectance::Reflectance;
use super::{LobeHandle, both};

type Made = Result<LobeHandle, String>;

pub(super) fn coated_diffuse(given: Given<'_>) -> Made {
    let alpha = given.alpha("alpha")?;
    let eta = given.number("eta", 1.5, COAT_ETA)?;
    let albedo = given.albedo("albedo", 0.5)?;
    let thickness = given.number("thickness", 0.0, ANY)?;
    let max_depth = given.count("max_depth")?;
    let scattering = match given.word("scattering")? {
        None | Some("lossless") => CoatScattering::Lossless,
        Some("single") => CoatScattering::Single,
        Some(name) => {
            return Err(format!(
                "no such scattering: '{name}' (expected lossless or single)"
            ));
        }
    };
    Ok(both!(T => {
        let layer = CoatLayer {
            thickness: T::of(thickness),
            max_depth,
            scattering,
        };
        bsdf::CoatedDiffuse::<T>::over_layer(alpha.map(ggx), T::of(eta), albedo.cast(), layer)
    }))
}

pub(super) fn layered(given: Given<'_>) -> Made {
    let alpha = given.alpha("alpha")?;
    let eta = given.number("eta", 1.5, COAT_ETA)?;
    let base_alpha = given.alpha("base_alpha")?;
    let diffuse = given.colour("albedo", SHARE)?;
    let metal = Reflectance::given(given)?;
    if diffuse.is_some() == metal.is_some() {
        return Err(
            "expected the base's albedo (diffuse) or its reflectance (metal), one of the two"
                .to_owned(),
        );
    }
    if diffuse.is_some() && base_alpha.is_some() {
        return Err("base_alpha: a diffuse base has none".to_owned());
    }
    let thickness = given.number("thickness", 0.0, ANY)?;
    let scattered = given.albedo("medium_albedo", 0.0)?;
    let g = given.number("g", 0.0, [-0.99, 0.99])?;
    Ok(both!(T => {
        let base = match metal {
            Some(metal) => Base::<T>::metal(base_alpha.map(ggx), metal.cast()),
            None => Base::diffuse(diffuse.unwrap_or(Rgb::BLACK).cast()),
        };
        let medium = Medium {
            thickness: T::of(thickness),
            albedo: scattered.cast(),
            g: T::of(g),
        };
        bsdf::Layered::<T>::new(alpha.map(ggx), T::of(eta), base).with_medium(medium)
    }))
}

pub(super) fn plastic(given: Given<'_>) -> Made {
    let alpha = given.alpha("alpha")?;
    let eta = given.number("eta", 1.49, COAT_ETA)?;
    let diffuse = given.albedo("diffuse", 0.5)?;
    let specular = given.albedo("specular", 1.0)?;
    let nonlinear = given.flag("nonlinear", false)?;
    let smith = given.masking(Masking::Separable)?;
    let lobe = match (alpha, given.distribution()?) {
        (None, _) => both!(T => {
            bsdf::Plastic::<T>::smooth(T::of(eta), diffuse.cast(), specular.cast(), nonlinear)
        }),
        (Some(alpha), Distribution::Ggx) => both!(T => {
            let (diffuse, specular) = (diffuse.cast(), specular.cast());
            let ndf = ggx::<T>(alpha);
            bsdf::Plastic::rough(ndf, smith, T::of(eta), diffuse, specular, nonlinear)
        }),
        (Some(alpha), Distribution::Beckmann) => both!(T => {
            let (diffuse, specular) = (diffuse.cast(), specular.cast());
            let ndf = beckmann::<T>(alpha);
            bsdf::Plastic::rough(ndf, smith, T::of(eta), diffuse, specular, nonlinear)
        }),
    };
    Ok(lobe)
}

pub(super) fn principled(given: Given<'_>) -> Made {
    let base = given.albedo("base_color", 0.5)?;
    let roughness = given.share("roughness", 0.5)?;
    let anisotropic = given.share("anisotropic", 0.0)?;
    let metallic = given.share("metallic", 0.0)?;
    let spec_trans = given.share("spec_trans", 0.0)?;
    let eta = given.number("eta", 1.5, ETA)?;
    let spec_tint = given.share("spec_tint", 0.0)?;
    let sheen = given.share("sheen", 0.0)?;
    let sheen_tint = given.share("sheen_tint", 0.0)?;
    let clearcoat = given.share("clearcoat", 0.0)?;
    let clearcoat_gloss = given.share("clearcoat_gloss", 0.0)?;
    let flatness = given.share("flatness", 0.0)?;
    let diff_trans = given.number("diff_trans", 0.0, [0.0, 2.0])?;
    let thin = given.flag("thin", false)?;
    let outside = given.flag("outside", true)?;
    Ok(both!(T => bsdf::Principled::<T>::new(PrincipledParameters {
        base_colour: base.cast(),
        roughness: T::of(roughness),
        anisotropic: T::of(anisotropic),
        metallic: T::of(metallic),
        spec_trans: T::of(spec_trans),
        eta: T::of(eta),
        spec_tint: T::of(spec_tint),
        sheen: T::of(sheen),
        sheen_tint: T::of(sheen_tint),
        clearcoat: T::of(clearcoat),
        clearcoat_gloss: T::of(clearcoat_gloss),
        flatness: T::of(flatness),
        diff_trans: T::of(diff_trans),
        thin,
        outside,
    })))
}

pub(super) fn gltf(given: Given<'_>) -> Made {
    let base = given.albedo("base_color", 1.0)?;
    let metallic = given.share("metallic", 1.0)?;
    let roughness = given.share("roughness", 1.0)?;
    let anisotropy = given.share("anisotropy", 0.0)?;
    let ior = given.number("ior", 1.5, [0.0, 1e3])?;
    let specular = given.share("specular", 1.0)?;
    let specular_colour = given.colour("specular_color", ANY)?.unwrap_or(Rgb::WHITE);
    let transmission = given.share("transmission", 0.0)?;
    let volume = given.flag("volume", false)?;
    let outside = given.flag("outside", true)?;
    let clearcoat = given.share("clearcoat", 0.0)?;
    let clearcoat_roughness = given.share("clearcoat_roughness", 0.0)?;
    let sheen = given.albedo("sheen_color", 0.0)?;
    let sheen_roughness = given.share("sheen_roughness", 0.0)?;
    let compensated = given.flag("compensated", false)?;
    Ok(both!(T => bsdf::Gltf::<T>::new(GltfParameters {
        base_colour: base.cast(),
        metallic: T::of(metallic),
        roughness: T::of(roughness),
        anisotropy: T::of(anisotropy),
        ior: T::of(ior),
        specular: T::of(specular),
        specular_colour: specular_colour.cast(),
        transmission: T::of(transmission),
        volume,
        outside,
        clearcoat: T::of(clearcoat),
        clearcoat_roughness: T::of(clearcoat_roughness),
        sheen_colour: sheen.cast(),
        sheen_roughness: T::of(sheen_roughness),
        compensated,
    })))
}
